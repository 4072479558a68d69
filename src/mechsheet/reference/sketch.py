"""How far positions lie from a rough sketch: the measure by which the first position is chosen."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from livesheet.said import say
from mechsheet.diagnostics import MechanismError

from ..model import Joint, Link, Mechanism
from . import geometry
from .expressions import number
from .geometry import Array
from .system import System

Pose = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class Entry:
    """One entry of a sketch, and the block whose solution decides it.

    kind    "point" (target x, y), "angle" or "displacement" (target, 0), "pose" (target x, y, theta), "side" (target +1 or
            -1; name: the link that is driven, the one on it, the one on the ground)
    """

    kind: str
    name: str
    target: tuple[float, ...]
    block: int


class Sketched:
    """A sketch, or rough poses, asked block by block.

    at       the driver value that the sketch shows, as the system has it;  started  True for rough poses
    """

    def __init__(self, system: System, start: Mapping[str, Pose] | None) -> None:
        self.system = system
        self.started = start is not None
        self._done = _deciding_blocks(system)
        self.entries = tuple(self._poses(start) if start else self._sketch())
        at = None if start else system.mechanism.sketch.at
        scale = system.scale if system.mechanism.driver.joint else 1.0
        self.at = None if at is None else number(at, system.dimensions) / scale

    def _poses(self, start: Mapping[str, Pose]) -> list[Entry]:
        origin, scale = self.system.origin, self.system.scale
        found = []
        for name, (x, y, theta) in start.items():
            if name not in self.system.bodies:
                raise MechanismError(say('the start names "{name}", which is no link', name=name))
            body = self.system.bodies[name]
            if body:
                target = ((x - origin[0]) / scale, (y - origin[1]) / scale, theta)
                found.append(Entry("pose", name, target, max(self._done[3 * body : 3 * body + 3])))
        return found

    def _sketch(self) -> list[Entry]:
        system, mechanism = self.system, self.system.mechanism
        angles = {link.angle_symbol: link.name for link in mechanism.links[1:]}
        joints = {joint.symbol: joint for joint in mechanism.joints}
        found = []
        for point, quantities in mechanism.sketch.points.items():
            x, y = (number(quantity, system.dimensions) for quantity in quantities)
            target = ((x - system.origin[0]) / system.scale, (y - system.origin[1]) / system.scale)
            found.append(Entry("point", point, target, self._settled(self._owner(point))))
        for symbol, quantity in mechanism.sketch.symbols.items():
            value = number(quantity, system.dimensions)
            if symbol in angles:
                theta = system.column(angles[symbol]) + 2
                found.append(Entry("angle", angles[symbol], (value,), self._done[theta]))
            elif symbol in joints:
                joint = joints[symbol]
                block = max(self._settled(self._owner(joint.point)), self._settled(joint.on))
                found.append(Entry("displacement", symbol, (value / system.scale,), block))
            elif symbol not in mechanism.driven_symbols:
                raise MechanismError(say('the sketch names "{symbol}", which is no variable', symbol=symbol))
        return found + self._side()

    def _side(self) -> list[Entry]:
        """The assembly that a synthesis finds for a four-bar: on which side of the way from its crank's pin to the other
        pivot the joint of coupler and rocker lies.
        """
        mechanism = self.system.mechanism
        task = mechanism.synthesis
        if task is None or not task.mode:
            return []
        side = self.system.dimensions[task.results["mode"]]
        chain = _four_bar(mechanism)
        if chain is None or not np.isfinite(side):
            return []
        return [Entry("side", " ".join(chain), (side,), self._settled(chain[2]))]

    def _owner(self, point: str) -> str:
        """The link of a point whose position is known first."""
        owners = [link.name for link in self.system.mechanism.links if point in link.points]
        if not owners:
            raise MechanismError(say('the sketch names "{point}", which is no point', point=point))
        return min(owners, key=self._settled)

    def _settled(self, link: str) -> int:
        first = self.system.column(link)
        return max(self._done[first : first + 3])

    def away(self, values: Array) -> Array:
        """How far each driver value (m,) is from that of the rough poses; how late it comes, where there are none.

        Of a sketch that says which driver value it shows (`at`), how far from that.
        """
        driver = self.system.mechanism.driver
        if self.at is not None:
            off = values - self.at
            return np.asarray(np.abs(off if driver.joint else off - 2 * np.pi * np.round(off / (2 * np.pi))))
        rough = np.zeros((1, self.system.columns))
        known = {self.system.mechanism.ground.name}
        for entry in self.entries:
            if entry.kind == "pose":
                first = self.system.column(entry.name)
                rough[0, first : first + 3] = entry.target
                known.add(entry.name)
        joint = next((joint for joint in self.system.mechanism.joints if joint.name == driver.joint), None)
        base = driver.relative_to or self.system.mechanism.ground.name
        needed = {joint.link, joint.on} if joint else {driver.link, base}
        if len(known) == 1 or not needed <= known:
            return np.arange(len(values), dtype=float)
        if joint:
            return np.asarray(np.abs(values - displacement(self.system, joint, rough)))
        turned = rough[0, self.system.column(driver.link) + 2] - rough[0, self.system.column(base) + 2]
        off = values - turned
        return np.asarray(np.round(np.abs(off - 2 * np.pi * np.round(off / (2 * np.pi))), 9))

    def rough(self, state: Array) -> Array:
        """States (m, columns) with the links as the rough poses have them."""
        found = state.copy()
        for entry in self.entries:
            if entry.kind == "pose":
                first = self.system.column(entry.name)
                found[:, first : first + 3] = entry.target
        return found

    def about(self, block: int) -> bool:
        """Whether an entry is decided by this block."""
        return any(entry.block == block for entry in self.entries)

    def cost(self, block: int, states: Array) -> Array:
        """Sum of squared distances (m,) of states (m, columns) from the entries that this block decides; NaN is far."""
        total = np.zeros(len(states))
        for entry in self.entries:
            if entry.block == block:
                total += self._distance(entry, states)
        return np.where(np.isfinite(total), total, np.inf)

    def _distance(self, entry: Entry, states: Array) -> Array:
        if entry.kind == "displacement":
            joint = next(j for j in self.system.mechanism.joints if j.symbol == entry.name)
            along = displacement(self.system, joint, states, self._owner(joint.point))
            return np.asarray((along - entry.target[0]) ** 2)
        if entry.kind == "point":
            place = point_positions(self.system, self._owner(entry.name), entry.name, states)
            return np.asarray(np.sum((place - np.array(entry.target)) ** 2, axis=1))
        if entry.kind == "side":
            return self._off_side(entry, states)
        first = self.system.column(entry.name)
        turned = (2 * np.sin((states[:, first + 2] - entry.target[-1]) / 2)) ** 2
        if entry.kind == "angle":
            return np.asarray(turned)
        return np.asarray(np.sum((states[:, first : first + 2] - np.array(entry.target[:2])) ** 2, axis=1) + turned)

    def _off_side(self, entry: Entry, states: Array) -> Array:
        """1 for states on the other side, 0 else."""
        crank, coupler, rocker = (
            next(k for k in self.system.mechanism.links if k.name == n) for n in entry.name.split(" ")
        )
        a = point_positions(self.system, crank.name, _shared(crank, coupler)[0], states)
        b = point_positions(self.system, rocker.name, _shared(coupler, rocker)[0], states)
        b0 = point_positions(self.system, rocker.name, _shared(rocker, self.system.mechanism.ground)[0], states)
        way, arm = b0 - a, b - a
        return np.asarray(((way[:, 0] * arm[:, 1] - way[:, 1] * arm[:, 0]) * entry.target[0] < 0).astype(float))

    def turn(self, column: int) -> float | None:
        """The wished value of an angle's column, if there is one: it names the turn that the angle starts in."""
        for entry in self.entries:
            if entry.kind in ("angle", "pose") and self.system.column(entry.name) + 2 == column:
                return entry.target[-1]
        return None


def _shared(first: Link, second: Link) -> list[str]:
    """Points that two links have in common."""
    return [point for point in first.points if point in second.points]


def _four_bar(mechanism: Mechanism) -> tuple[str, str, str] | None:
    """Names of crank, coupler and rocker, where these make a loop with the ground."""
    driven = [link for link in mechanism.links if link.name == mechanism.driver.link]
    for crank in driven:
        others = [link for link in mechanism.links if link not in (crank, mechanism.ground)]
        for coupler, rocker in itertools.permutations(others, 2):
            if _shared(crank, coupler) and _shared(coupler, rocker) and _shared(rocker, mechanism.ground):
                return crank.name, coupler.name, rocker.name
    return None


def _deciding_blocks(system: System) -> list[int]:
    """For each column of the state the block that solves it; -1 for what is fixed."""
    done = [-1] * system.columns
    for i, block in enumerate(system.blocks):
        for column in block.columns:
            done[column] = i
    return done


def point_positions(system: System, link: str, point: str, states: Array) -> Array:
    """Places (m, 2) of a link's point, in the system's own lengths from its own origin."""
    first = system.column(link)
    x, y = system.points[link][point] / system.scale
    return _moved(system, first, states, x, y)


def _moved(system: System, first: int, states: Array, x: float, y: float) -> Array:
    """Places (m, 2) of (x, y) in the frame of the body whose columns begin at `first`."""
    c, s = np.cos(states[:, first + 2]), np.sin(states[:, first + 2])
    moved = states[:, first : first + 2] + np.stack([c * x - s * y, s * x + c * y], axis=1)
    return np.asarray(moved - system.origin / system.scale if first == 0 else moved)


def displacement(system: System, joint: Joint, states: Array, link: str = "") -> Array:
    """Displacement (m,) of a sliding joint, in the system's own lengths; `link` is another link that has its point."""
    first = system.column(joint.on)
    x, y = geometry.through(joint, system.points, system.dimensions) / system.scale
    theta = states[:, first + 2]
    line = _moved(system, first, states, x, y)
    direction = theta + number(joint.angle, system.dimensions)
    away = point_positions(system, link or joint.link, joint.point, states) - line
    return np.asarray(np.cos(direction) * away[:, 0] + np.sin(direction) * away[:, 1])

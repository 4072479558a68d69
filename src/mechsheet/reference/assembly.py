"""Which assembly a sweep starts from: the one nearest to the sketch, and how far positions lie from that."""

from __future__ import annotations

import itertools
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from livesheet.said import say
from mechsheet.diagnostics import MechanismError

from ..model import Link, Mechanism
from . import branches, newton
from .expressions import number
from .geometry import Array, whole_turns
from .solution import displacement, point_positions
from .system import Block, System

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
            return np.asarray(np.abs(off if driver.joint else off - whole_turns(off)))
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
        return np.asarray(np.round(np.abs(off - whole_turns(off)), 9))

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
        crank, coupler, rocker = map(self.system.mechanism.link, entry.name.split(" "))
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


_BEAM = 16
_TOGETHER = 32
_FLAT = 1e-6
_ASIDE = 1e-3
_OPEN = 1e6


def start_row(sketched: Sketched, block: Block, state: Array, value: Array) -> tuple[int | None, Array]:
    """The row whose assembly the sketch shows, and all the block's solutions there (s, columns); None without any.

    That is the first row in which the block closes; rough poses show the row whose driver value they have.
    """
    row = int(np.argmin(sketched.away(value)))
    candidates = branches.solutions(block, state[row : row + 1], value[row : row + 1])[0]
    if sketched.started and block.geared:
        candidates = _with_rough(sketched, block, state[row : row + 1], value[row : row + 1], candidates)
    if len(candidates):
        return row, candidates
    rows = np.arange(len(state))
    if not block.large:
        # Both branches exist in the same rows, so either finds them.
        rows = np.flatnonzero(branches.sweep(block, state, value, 1.0).exists)
    rows = rows[np.argsort(sketched.away(value[rows]), kind="stable")]
    for first in range(0, len(rows), _TOGETHER):
        part = rows[first : first + _TOGETHER]
        for row, candidates in zip(part, branches.solutions(block, state[part], value[part]), strict=True):
            if len(candidates):
                return int(row), candidates
    return None, candidates


def _with_rough(sketched: Sketched, block: Block, state: Array, value: Array, candidates: Array) -> Array:
    """The solutions, and before them the one that the rough poses lead to, in its own turns."""
    guess = state.copy()
    columns = list(block.columns)
    guess[:, columns] = sketched.rough(state)[:, columns]
    found, miss = newton.polish(block, newton.placed(block, guess, value), value)
    if miss[0] > newton.CLOSED:
        return candidates
    others = [each[None, :] for each in candidates if not newton.same_position(block, each[None, :], found)[0]]
    return np.concatenate([found, *others])


def branch(
    built: System, sketched: Sketched, index: int, first: int, candidates: Array, state: Array, value: Array
) -> float:
    """Sign of the branch that holds, in row `first`, the candidate nearest to the sketch.

    At a dead centre, where both branches meet, the sketch itself tells them apart, or the next row that exists does.
    """
    block = built.blocks[index]
    chosen = choose(built, sketched, index, candidates, value[first])
    det = newton.determinant(block, chosen, value[first : first + 1])[0]
    if abs(det) > _FLAT:
        return float(np.sign(det))
    side = _side(built, sketched, index, chosen, value[first : first + 1])
    if side:
        return side
    for i in (*range(first + 1, len(state)), *reversed(range(first))):
        candidates = branches.solutions(block, state[i : i + 1], value[i : i + 1])[0]
        if len(candidates):
            chosen = choose(built, sketched, index, candidates, value[i])
            det = newton.determinant(block, chosen, value[i : i + 1])[0]
            if abs(det) > _FLAT:
                return float(np.sign(det))
    return 1.0


def _side(built: System, sketched: Sketched, index: int, centre: Array, value: Array) -> float:
    """Sign of the branch on that side of a dead centre (1, columns) on which the sketch lies; 0 when it says nothing."""
    block = built.blocks[index]
    _, change = newton.weakest(block, centre, value)
    sides = np.repeat(centre, 2, axis=0)
    sides[:, list(block.columns)] += _ASIDE * np.array([[1.0], [-1.0]]) * change
    costs = sketched.cost(index, sides)
    if not abs(costs[0] - costs[1]) > _ASIDE * 1e-6:
        return 0.0
    nearer = sides[np.argmin(costs)][None, :]
    return float(np.sign(newton.determinant(block, nearer, value)[0]))


def choose(built: System, sketched: Sketched, index: int, candidates: Array, value: float) -> Array:
    """The candidate (1, columns) nearest to the sketch; of equals the one of positive determinant.

    The sketch may say something about this block, and about those that stand on it: of these the best assemblies count.
    """
    if len(candidates) == 1:
        return candidates
    block = built.blocks[index]
    last = max((wish.block for wish in sketched.entries), default=-1)
    costs = sketched.cost(index, candidates)
    if last > index:
        further = [
            _further(built, sketched, candidates[i : i + 1], value, index + 1, last + 1) for i in range(len(candidates))
        ]
        depths = np.array([depth for depth, _ in further])
        if not sketched.about(index):
            costs = np.array([cost for _, cost in further]) + _OPEN * (last + 1 - depths)
        elif depths.min() == depths.max():
            costs = costs + np.array([cost for _, cost in further])
    dets = newton.determinant(block, candidates, np.full(len(candidates), value))
    nearest = np.flatnonzero(costs <= np.min(costs) * (1 + 1e-9) + 1e-20)
    best = nearest[np.argmax(dets[nearest])]
    return candidates[best : best + 1]


def _further(built: System, sketched: Sketched, state: Array, value: float, index: int, stop: int) -> tuple[int, float]:
    """(the block up to which blocks from `index` to before `stop` close, how far the best assembly is from the sketch)."""
    depth, states = assembled(built, state, value, index, stop, sketched, _BEAM)
    cost = np.zeros(len(states))
    for i in range(index, depth):
        cost += sketched.cost(i, states)
    return depth, float(np.min(cost))


def assembled(
    built: System, state: Array, value: float, index: int, stop: int, sketched: Sketched | None, width: int
) -> tuple[int, Array]:
    """The block up to which blocks from `index` to before `stop` close, and the assemblies (m, columns) up to there.

    Where there are more than `width`, the nearest to the sketch.
    """
    states, cost = state, np.zeros(len(state))
    for i in range(index, stop):
        grown = branches.solutions(built.blocks[i], states, np.full(len(states), value))
        if not any(len(part) for part in grown):
            return i, states
        cost = np.repeat(cost, [len(part) for part in grown])
        states = np.concatenate(grown)
        if sketched is not None:
            cost = cost + sketched.cost(i, states)
        keep = np.argsort(cost, kind="stable")[:width]
        states, cost = states[keep], cost[keep]
    return stop, states

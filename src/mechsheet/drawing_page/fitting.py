"""The dimensions of what was dragged: one point lies somewhere else, all others stay.

Every link that has the point is asked for the numbers of its places (input dimensions, plain numbers in coordinates) with
which it fits the new positions, wherever it lies; a sliding joint at it for the line on which they are. These are equations,
solved by Gauss-Newton steps; of all that solves them, what is nearest to the numbers before (least squares). Plain
numbers change only where the dimensions alone do not do it: the 0 of `B = ["a3", 0]` stays 0, and a3 becomes the distance.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import Symbol
from mechsheet.description.parts import Parts
from mechsheet.description.text.index import Path
from mechsheet.drawing_page.positions import Point, Pose, line_of, local_points
from mechsheet.drawing_page.reading import followed, read_by_guide, reads_of
from mechsheet.kinematics.dimensions import dimension_order
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import (
    Cartesian,
    Distances,
    Driver,
    GivenPoint,
    Joint,
    Label,
    Link,
    Mechanism,
    Polar,
    Quantity,
)

STEPS = 15
"""Of Gauss and Newton, at most."""

CLOSED = 1e-9
"""Equations that miss by less than this part of the size are solved."""

NEARLY = 1e-5
"""So far dimensions alone may miss before plain numbers are taken, too."""

STIFF = 30.0
"""What a plain number costs to change, in terms of a dimension."""

FREE = 1e-3
"""What the place of a link costs: next to nothing."""

WAY, MOST_WAYS = 0.08, 16
"""A point is led to where it was dragged in ways of about this part of the size, at most so many."""

PROBE = 1e-6
"""The step of numerical differentiation, as a part of the size."""


@dataclass(frozen=True, slots=True)
class Fit:
    """What fits the drawing.

    dimensions  input dimension -> its new value, internal units;  plain: path of a plain number -> its new value
    poses       where the links lie then that have the point, or slide on one that has it
    missed      how far it misses what was drawn, as a part of the size
    """

    dimensions: Mapping[str, float]
    plain: Mapping[Path, float]
    poses: Mapping[str, Pose]
    missed: float


def fitted(parts: Parts, places: Mapping[str, Point], moved: str, before: Mapping[str, Pose], size: float) -> Fit:
    """The numbers with which the point `moved` is where `places` has it, as all others are.

    places  of all points, in the ground's frame;  before: where the links lay;  size: of the mechanism, a length
    """
    task = _Task(parts, places, moved, before, size)
    first = task.led(task.inputs)
    if first.missed <= NEARLY or not task.plain:
        return first
    second = task.led((*task.inputs, *task.plain))
    return second if second.missed < first.missed else first


class _Task:
    """The equations of one drag. Plain numbers have names of their own: `#0`, `#1` ..."""

    def __init__(
        self, parts: Parts, places: Mapping[str, Point], moved: str, before: Mapping[str, Pose], size: float
    ) -> None:
        self.parts, self.places, self.moved, self.size = parts, places, moved, size
        self.ground = parts.links[0]
        self.numbers = dict(parts.numbers)
        self.paths: dict[str, Path] = {}
        self.angular: set[str] = {dim.symbol for dim in parts.dimensions if dim.unit.kind == "angle"}
        self.before = before
        self.start = self._first_place()
        self.links = [self._opened(link) for link in parts.links if moved in link.points]
        names = {link.name for link in self.links}
        beside = {
            end
            for joint in parts.joints
            if joint.kind == "prismatic" and {joint.link, joint.on} & names
            for end in (joint.link, joint.on)
        }
        self.links += [link for link in parts.links[1:] if link.name in beside - names]
        self.moving = [link for link in self.links if link.name != self.ground.name]
        self.joints = [
            self._opened_joint(parts.orders[joint.name], joint)
            for joint in parts.joints
            if joint.point == moved or joint.through == moved or {joint.link, joint.on} & names
        ]
        used = {name for link in self.links if moved in link.points for name in reads_of(link, parts)}
        used |= followed({name for joint in self.joints for name in read_by_guide(joint)}, parts)
        self.inputs = tuple(
            dim.symbol
            for dim in parts.dimensions
            if dim.symbol in used and isinstance(dim.value, float) and math.isfinite(dim.value)
        )
        self.plain = tuple(self.paths)
        bare = Mechanism(
            "", Label(""), Label(""), "", parts.angle_unit, parts.dimensions, (), (),
            Driver("", parts.angle_unit),
        )  # fmt: skip
        formulas = {dim.symbol: dim.value for dim in parts.dimensions if dim.derived}
        self.derived = [(name, formulas[name]) for name in dimension_order(bare) if name in formulas]

    def _first_place(self) -> Point:
        """Where the point was: as the first link that has it lies."""
        for link in self.parts.links_at(self.moved):
            own = local_points(link, self.parts.numbers)[self.moved]
            if all(map(math.isfinite, own)):
                return self.before[link.name].of(own)
        return self.places[self.moved]

    # --- plain numbers get names ---------------------------------------------------------------------------------------

    def _named(self, quantity: Quantity, path: Path, angle: bool = False) -> Quantity:
        if not isinstance(quantity, float | int) or not math.isfinite(quantity):
            return quantity
        name = f"#{len(self.paths)}"
        self.paths[name] = path
        self.numbers[name] = float(quantity)
        if angle:
            self.angular.add(name)
        return Symbol(name)

    def _opened(self, link: Link) -> Link:
        """The link with names for the plain numbers of the point that was moved."""
        path: Path = ("links", link.name, "points", self.moved)
        return replace(link, points={**link.points, self.moved: self._place(link.points[self.moved], path)})

    def _place(self, place: GivenPoint, path: Path) -> GivenPoint:
        match place:
            case Cartesian(x, y):
                return Cartesian(self._named(x, (*path, 0)), self._named(y, (*path, 1)))
            case Polar(r, angle):
                return Polar(self._named(r, (*path, "r")), self._named(angle, (*path, "angle"), True))
            case Distances(first, one, second, two, side):
                ends = (*path, "distances")
                return Distances(
                    first, self._named(one, (*ends, first)), second, self._named(two, (*ends, second)), side
                )

    def _opened_joint(self, place: int, joint: Joint) -> Joint:
        """The joint with names for the plain numbers of its line, where these are written."""
        path: Path = ("joints", place)
        through = joint.through
        if isinstance(through, tuple):
            through = (
                self._named(through[0], (*path, "through", 0)),
                self._named(through[1], (*path, "through", 1)),
            )
        return replace(joint, through=through, angle=self._named(joint.angle, (*path, "angle"), True))

    # --- the equations -------------------------------------------------------------------------------------------------

    def _values(self, names: tuple[str, ...], x: NDArray[np.float64]) -> dict[str, float]:
        found = dict(self.numbers)
        for name, value in zip(names, x, strict=False):
            found[name] = float(value) * (1.0 if name in self.angular else self.size)
        for name, node in self.derived:
            try:
                found[name] = number(node, found)
            except (KeyError, ArithmeticError, ValueError):
                found.setdefault(name, math.nan)
        return found

    def _missed(self, names: tuple[str, ...], x: NDArray[np.float64]) -> NDArray[np.float64]:
        """What every equation misses, as a part of the size. `x`: the numbers, then turn and place of each moving link."""
        values = self._values(names, x)
        poses = self._poses(len(names), x)
        found: list[float] = []
        for link in self.links:
            own = local_points(link, values)
            for point in link.points if link.name in poses else (self.moved,):
                there, wanted = poses.get(link.name, Pose()).of(own[point]), self.places[point]
                found += [there[0] - wanted[0], there[1] - wanted[1]]
        for joint in self.joints:
            found += self._joint_missed(joint, values, poses)
        return np.array(found) / self.size

    def _poses(self, count: int, x: NDArray[np.float64]) -> dict[str, Pose]:
        """Where the links lie, from what stands behind `count` numbers."""
        rows = x[count:].reshape(-1, 3) * (1.0, self.size, self.size)
        return {link.name: Pose(*map(float, row)) for link, row in zip(self.moving, rows, strict=True)}

    def _joint_missed(self, joint: Joint, values: Mapping[str, float], poses: Mapping[str, Pose]) -> list[float]:
        """How far the point is from the line; of a prismatic joint also how far the link is turned from it, as a length."""
        place, direction = line_of(joint, poses.get(joint.on) or self.before[joint.on], values)
        x, y = self.places[str(joint.through)] if place is None else place
        px, py = self.places[joint.point]
        found = [(py - y) * math.cos(direction) - (px - x) * math.sin(direction)]
        if joint.kind == "prismatic":
            own = (poses.get(joint.link) or self.before[joint.link]).turn
            found.append(math.sin((own - direction - number(joint.orientation, values)) / 2) * 2 * self.size)
        return found

    def led(self, names: tuple[str, ...]) -> Fit:
        """The numbers of these names that fit best, the point led to its place in short ways: no link turns over.

        It ends where a length would become 0: beyond, the same drawing would need a negative one.
        """
        start = [self.numbers[name] / (1.0 if name in self.angular else self.size) for name in names]
        for link in self.moving:
            pose = self.before[link.name]
            start += [pose.turn, pose.x / self.size, pose.y / self.size]
        x = np.array(start, float)
        lengths = [
            n for n, name in enumerate(names) if name not in self.angular and not name.startswith("#") and x[n] > 0
        ]
        target = self.places[self.moved]
        ways = min(MOST_WAYS, max(1, math.ceil(math.dist(target, self.start) / (WAY * self.size))))
        found: Fit | None = None
        for way in range(1, ways + 1):
            part = way / ways
            there = tuple(a + part * (b - a) for a, b in zip(self.start, target, strict=True))
            self.places = {**self.places, self.moved: (there[0], there[1])}
            fit, x = self._solved(names, x)
            if found is not None and np.any(x[lengths] <= 0):
                break
            found = fit
        self.places = {**self.places, self.moved: target}
        if found is None:
            raise ValueError("no way leads anywhere")
        return found

    def _solved(self, names: tuple[str, ...], x: NDArray[np.float64]) -> tuple[Fit, NDArray[np.float64]]:
        cost = np.array(
            [STIFF if name.startswith("#") else 1.0 for name in names] + [FREE] * (3 * len(self.moving)), dtype=float
        )
        missed = self._missed(names, x)
        for _ in range(STEPS):
            if not len(x) or not np.all(np.isfinite(missed)) or np.max(np.abs(missed), initial=0.0) <= CLOSED:
                break
            slopes = np.column_stack(
                [(self._missed(names, x + PROBE * row) - missed) / PROBE for row in np.eye(len(x))]
            )
            if not np.all(np.isfinite(slopes)):
                break
            step = np.linalg.lstsq(slopes / cost, -missed, rcond=1e-9)[0] / cost
            x, missed, worked = self._shortened(names, x, step, missed)
            if not worked:
                break
        values = self._values(names, x)
        fit = Fit(
            {name: values[name] for name in names if not name.startswith("#")},
            {self.paths[name]: values[name] for name in names if name.startswith("#")},
            self._poses(len(names), x),
            float(np.max(np.abs(missed), initial=0.0)) if np.all(np.isfinite(missed)) else math.inf,
        )
        return fit, x

    def _shortened(
        self, names: tuple[str, ...], x: NDArray[np.float64], step: NDArray[np.float64], missed: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], bool]:
        """The step, or a part of it: what does not bring it nearer is too long."""
        before = float(np.sum(missed**2))
        for _ in range(8):
            found = self._missed(names, x + step)
            if np.all(np.isfinite(found)) and float(np.sum(found**2)) < before:
                return x + step, found, True
            step = step / 2
        return x, missed, False

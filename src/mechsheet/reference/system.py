"""The constraints of a mechanism on its link poses, as numbers: residuals and Jacobian, block by block.

The state of m positions is an array (m, columns): x, y, theta of every body, then the values of further drivers, which are
given. Bodies are the links in the order of the model, the ground (fixed at zero) first, then one massless point for each
multiple joint. Lengths are divided by `scale` and counted from `origin`, so that everything is of the order of one.

Which unknowns are solved together, and in which order, is the block triangular form of the equations' sparsity pattern
(Dulmage and Mendelsohn). Only the pattern counts, never a number: the blocks are the same in every position of a mechanism.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal, TypeAlias

import numpy as np

from livesheet.said import say
from mechsheet.diagnostics import MechanismError

from ..model import FurtherDriver, Gear, Joint, Mechanism, Rack
from . import geometry
from .expressions import number
from .geometry import Array

Kind: TypeAlias = Literal["meet x", "meet y", "line", "displacement", "angle"]

# Which of (x, y, theta of body; x, y, theta of `on`) stand in each kind of equation, whatever the numbers are.
_SLOTS: Mapping[Kind, tuple[int, ...]] = {
    "meet x": (0, 2, 3, 5),
    "meet y": (1, 2, 4, 5),
    "line": (0, 1, 2, 3, 4, 5),
    "displacement": (0, 1, 2, 3, 4, 5),
    "angle": (2, 5),
}


@dataclass(frozen=True, slots=True)
class Equation:
    """One scalar condition between a body and the body `on`; `of`: the point or the sliding joint that it belongs to.

    meet x, meet y  `point` of the body coincides with `place` of `on`
    line            `point` lies on the line of `on` through `place` in the direction `angle`
    displacement    signed distance along that line from `place` to `point` = `offset` (+ driver value when `driven`)
    angle           angle of the body - angle of `on` = `angle` (+ driver value when `driven`)

    terms   (column of the state, factor): what is added to the right side, of gears, racks and further drivers
    """

    kind: Kind
    body: int
    on: int
    point: tuple[float, float] = (0.0, 0.0)
    place: tuple[float, float] = (0.0, 0.0)
    angle: float = 0.0
    driven: bool = False
    of: str = field(default="", compare=False)
    offset: float = 0.0
    terms: tuple[tuple[int, float], ...] = ()


@dataclass(frozen=True, slots=True)
class Block:
    """Equations solved together for the state's `columns`.

    coordinates  columns of all points that its equations read
    slots   for each equation the pairs (slot of its gradient, position in `columns`)
    reach   length of the lever that each unknown angle turns here, 1 for a coordinate: dividing a column of the Jacobian
            by it makes short links count like long ones
    linear  no product of unknowns: one solution, no assembly mode
    large   more than one loop, or a loop with a gear inside: more than two solutions, so that the sign of the determinant
            alone names none
    """

    equations: tuple[Equation, ...]
    columns: tuple[int, ...]
    coordinates: tuple[int, ...]
    slots: tuple[tuple[tuple[int, int], ...], ...]
    reach: tuple[float, ...]
    linear: bool
    large: bool

    @property
    def angles(self) -> tuple[int, ...]:
        """Positions in `columns` of the unknown angles."""
        return tuple(i for i, column in enumerate(self.columns) if column % 3 == 2)

    @property
    def geared(self) -> tuple[int, ...]:
        """Positions in `columns` of the unknown angles that gears tie to each other: there whole turns count."""
        tied: set[int] = set()
        for each in self.equations:
            if each.terms:
                tied |= {column for column, _ in each.terms} | {3 * each.body + 2, 3 * each.on + 2}
        return () if self.linear else tuple(i for i in self.angles if self.columns[i] in tied)

    @property
    def free_angles(self) -> list[int]:
        """The unknown angles as columns of the state, where a turn more changes nothing."""
        geared = self.geared
        return [self.columns[i] for i in self.angles if i not in geared]


@dataclass(frozen=True, slots=True)
class System:
    """A mechanism in numbers: bodies by name, blocks in the order of solution."""

    mechanism: Mechanism
    dimensions: Mapping[str, float]
    points: geometry.PointsByLink
    bodies: Mapping[str, int]
    blocks: tuple[Block, ...]
    columns: int
    scale: float
    origin: Array
    finite: bool
    given: int = 0

    @property
    def equations(self) -> list[Equation]:
        """All of them, in the order of solution."""
        return [equation for block in self.blocks for equation in block.equations]

    @property
    def unknown(self) -> list[int]:
        """Columns of what they are solved for, in the same order."""
        return [column for block in self.blocks for column in block.columns]

    @property
    def prescribed(self) -> range:
        """Columns of the values of further drivers."""
        return range(self.columns - self.given, self.columns)

    @property
    def read_by_ties(self) -> frozenset[int]:
        """Columns that gears, racks and further drivers read: there whole turns of an angle count."""
        return frozenset(column for block in self.blocks for each in block.equations for column, _ in each.terms)

    def column(self, link: str) -> int:
        """First column (x) of a link in the state."""
        return 3 * self.bodies[link]

    def local(self, link: str, xy: Array) -> tuple[float, float]:
        """A place in a link's frame in the system's own lengths; the ground's frame counts from `origin`."""
        return _local(self.bodies[link], xy, self.scale, self.origin)


def system(mechanism: Mechanism, dimensions: Mapping[str, float]) -> System:
    """The constraint system for the given values of all dimensions.

    Raises MechanismError when there are not as many conditions as unknowns, or when they fall on the wrong links.
    """
    located = geometry.points_in_links(mechanism, dimensions)
    bodies = {link.name: i for i, link in enumerate(mechanism.links)}
    size = geometry.size(mechanism, dimensions)
    scale = 2.0 ** round(math.log2(size))  # a power of two: dividing by it rounds nothing
    origin = _origin(mechanism, dimensions, located)
    builder = _Builder(mechanism, dimensions, located, bodies, scale, origin)
    builder.count_points()
    count = len(bodies) + builder.points
    equations = builder.equations(3 * count)
    unknown = [c for c in range(3, 3 * count) if c < 3 * len(bodies) or c % 3 != 2]
    if len(equations) != len(unknown):
        raise MechanismError(
            say(
                "{unknown} unknown coordinates of links and {conditions} conditions from joints and drivers: "
                "the mobility is not the number of drivers",
                unknown=len(unknown),
                conditions=len(equations),
            )
        )
    pattern = [[c for c in _columns(e) if c in set(unknown)] for e in equations]
    parts = blocks(pattern)
    if parts is None:
        raise MechanismError(say("joints and driver hold some links more than once and leave others loose"))
    return System(
        mechanism=mechanism,
        dimensions=dimensions,
        points=located,
        bodies=bodies,
        blocks=tuple(_block([equations[i] for i in rows], columns) for rows, columns in parts),
        columns=3 * count + len(mechanism.drivers),
        given=len(mechanism.drivers),
        scale=scale,
        origin=origin,
        finite=all(
            np.all(np.isfinite([*e.point, *e.place, e.angle, e.offset, *(factor for _, factor in e.terms)]))
            for e in equations
        ),
    )


def _origin(mechanism: Mechanism, dimensions: Mapping[str, float], located: geometry.PointsByLink) -> Array:
    """A place in the middle of what is fixed: counted from there, a far-off ground costs no digits."""
    ground = mechanism.ground.name
    shared = {p for link in mechanism.links[1:] for p in link.points}
    marks = [xy for point, xy in located[ground].items() if point in shared]
    marks += [geometry.through(j, located, dimensions) for j in mechanism.joints if j.on == ground]
    middle = np.mean(marks, axis=0) if marks else np.zeros(2)
    return middle if np.all(np.isfinite(middle)) else np.zeros(2)


def _local(body: int, xy: Array, scale: float, origin: Array) -> tuple[float, float]:
    x, y = (xy - origin if body == 0 else xy) / scale
    return float(x), float(y)


class _Builder:
    """Turns joints and driver into equations; `points` counts the massless points it needed."""

    def __init__(
        self,
        mechanism: Mechanism,
        dimensions: Mapping[str, float],
        located: geometry.PointsByLink,
        bodies: Mapping[str, int],
        scale: float,
        origin: Array,
    ) -> None:
        self.mechanism, self.dimensions, self.located = mechanism, dimensions, located
        self.bodies, self.scale, self.origin = bodies, scale, origin
        self.points = 0
        self._holders: dict[str, tuple[int, tuple[float, float]]] = {}

    def count_points(self) -> None:
        """Find out which points need bodies of their own."""
        self._met = self._meetings()

    def equations(self, given: int) -> list[Equation]:
        """All of them; `given`: the first column of the values of further drivers."""
        found = self._met
        driver = self.mechanism.driver
        for joint in self.mechanism.joints:
            found += self._sliding(joint, driven=joint.name == driver.joint)
        if driver.link:
            on = driver.relative_to or self.mechanism.ground.name
            found.append(Equation("angle", self.bodies[driver.link], self.bodies[on], driven=True))
        for column, other in enumerate(self.mechanism.drivers, given):
            found.append(self._further(other, column))
        for order, relation in enumerate(self.mechanism.relations):
            found.append(self._rack(relation, order) if isinstance(relation, Rack) else self._gear(relation, order))
        return found

    def _further(self, driver: FurtherDriver, column: int) -> Equation:
        """A further driver's condition, its value in a column of the state."""
        if driver.joint:
            joint = next(joint for joint in self.mechanism.joints if joint.name == driver.joint)
            return replace(self._along(joint), of=joint.name, terms=((column, 1.0),))
        on = driver.relative_to or self.mechanism.ground.name
        name = f"driver {driver.symbol}"
        return Equation("angle", self.bodies[driver.link], self.bodies[on], of=name, terms=((column, 1.0),))

    def _gear(self, gear: Gear, order: int) -> Equation:
        """angle(link) - angle(arm) = phase + ratio (angle(on) - angle(arm))"""
        link, on, arm = (self.bodies[name] for name in gear.turning)
        ratio, phase = (number(node, self.dimensions) for node in (gear.ratio, gear.phase))
        terms = ((3 * on + 2, ratio), (3 * arm + 2, -ratio))
        return Equation("angle", link, arm, angle=phase, of=f"relation {order}", terms=terms)

    def _rack(self, rack: Rack, order: int) -> Equation:
        """displacement = phase + radius (angle(link) - angle(arm))"""
        joint = next(joint for joint in self.mechanism.joints if joint.symbol == rack.joint)
        radius, phase = (number(node, self.dimensions) / self.scale for node in (rack.radius, rack.phase))
        terms = tuple((3 * self.bodies[name] + 2, sign * radius) for name, sign in ((rack.link, 1), (rack.arm, -1)))
        return replace(self._along(joint), of=f"relation {order}", offset=phase, terms=terms)

    def _along(self, joint: Joint) -> Equation:
        """The displacement of a sliding joint."""
        body, point = self._holders[joint.point]
        on = self.bodies[joint.on]
        place = self._local(on, geometry.through(joint, self.located, self.dimensions))
        return Equation("displacement", body, on, point, place, number(joint.angle, self.dimensions), of=joint.name)

    def _local(self, body: int, xy: Array) -> tuple[float, float]:
        return _local(body, xy, self.scale, self.origin)

    def _meetings(self) -> list[Equation]:
        """k links that share a point meet k - 1 times.

        A point that several groups may need is a body of its own (or the ground's), because a meeting with a
        link that is solved late would hide that the place is known early.
        """
        sliding = {joint.point for joint in self.mechanism.joints}
        shared: dict[str, list[int]] = {}
        for link in self.mechanism.links:
            for point in link.points:
                shared.setdefault(point, []).append(self.bodies[link.name])
        links = self.mechanism.links
        found: list[Equation] = []
        for point, owners in shared.items():
            spots = [self._local(body, self.located[links[body].name][point]) for body in owners]
            if owners[0] != 0 and len(owners) > 1 and (len(owners) > 2 or point in sliding):
                self._holders[point] = (len(links) + self.points, (0.0, 0.0))
                self.points += 1
                rest = list(zip(owners, spots, strict=True))
            else:
                self._holders[point] = (owners[0], spots[0])
                rest = list(zip(owners[1:], spots[1:], strict=True))
            on, place = self._holders[point]
            for body, spot in rest:
                found += [Equation("meet x", body, on, spot, place, of=point)]
                found += [Equation("meet y", body, on, spot, place, of=point)]
        return found

    def _sliding(self, joint: Joint, driven: bool) -> list[Equation]:
        body, point = self._holders[joint.point]
        on = self.bodies[joint.on]
        place = self._local(on, geometry.through(joint, self.located, self.dimensions))
        angle = number(joint.angle, self.dimensions)
        found = [Equation("line", body, on, point, place, angle, of=joint.name)]
        if joint.kind == "prismatic":
            kept = angle + number(joint.orientation, self.dimensions)
            found.append(Equation("angle", self.bodies[joint.link], on, angle=kept, of=joint.name))
        if driven:
            found.append(replace(self._along(joint), driven=True))
        return found


def _own_columns(equation: Equation) -> list[int]:
    """Of its two bodies; a place that it does not read may be found later."""
    starts = (3 * equation.body, 3 * equation.on)
    return [starts[slot // 3] + slot % 3 for slot in _SLOTS[equation.kind]]


def _columns(equation: Equation) -> list[int]:
    return _own_columns(equation) + [column for column, _ in equation.terms]


def _slots(equation: Equation) -> tuple[int, ...]:
    """The entries of its gradient that belong to its columns."""
    return (*_SLOTS[equation.kind], *range(6, 6 + len(equation.terms)))


def _is_linear(equation: Equation, columns: Sequence[int]) -> bool:
    """Whether the unknown `columns` stand in it linearly: no unknown angle turns a place."""
    own = _own_columns(equation)
    return equation.kind == "angle" or not any(column % 3 == 2 and column in columns for column in own)


def _block(equations: Sequence[Equation], columns: Sequence[int]) -> Block:
    place = {column: i for i, column in enumerate(columns)}
    slots = tuple(
        tuple(
            (slot, place[column])
            for slot, column in zip(_slots(equation), _columns(equation), strict=True)
            if column in place
        )
        for equation in equations
    )
    kinds = [equation.kind for equation in equations]
    angles = sum(column % 3 == 2 for column in columns)
    # A loop equation has two unknowns for each loop: angles less those tied to others, and displacements less the driven.
    loop_unknowns = angles - kinds.count("angle") + kinds.count("line") - kinds.count("displacement")
    return Block(
        equations=tuple(equations),
        columns=tuple(columns),
        coordinates=tuple(sorted({c for e in equations for c in _own_columns(e) if c % 3 != 2})),
        slots=slots,
        reach=tuple(_reach(equations, column) for column in columns),
        linear=all(_is_linear(equation, columns) for equation in equations),
        large=loop_unknowns > 2 or any(column in columns for each in equations for column, _ in each.terms),
    )


def _reach(equations: Sequence[Equation], column: int) -> float:
    """Farthest point of a body that meets another. The lever of a slide changes with the position: it counts as 1."""
    if column % 3 != 2:
        return 1.0
    body = column // 3
    touching = [equation for equation in equations if body in (equation.body, equation.on)]
    if any(equation.kind in ("line", "displacement") for equation in touching):
        return 1.0
    levers = [math.hypot(*(e.point if e.body == body else e.place)) for e in touching if e.kind != "angle"]
    return max((lever for lever in levers if lever > 0), default=1.0)


def residual(equation: Equation, state: Array, value: Array) -> tuple[Array, tuple[Array | float, ...]]:
    """Residual (m,) of one equation at `state` (m, columns), driver `value` (m,), and its gradient by slot.

    With rho = R(theta) point, rho' = R(theta_on) place, v = p - p', t and n the line's direction and normal:
    meet    p - p'                  by theta: z x rho,        by theta_on: -z x rho'
    line    n . v                   by theta: n . (z x rho),  by theta_on: -t . v - n . (z x rho')
    displacement  t . v - value     by theta: t . (z x rho),  by theta_on:  n . v - t . (z x rho')
    Behind these the gradient by each of the equation's terms.
    """
    given: Array | float = value if equation.driven else 0.0
    for column, factor in equation.terms:
        given = given + factor * state[:, column]
    found, gradient = _own_residual(equation, state, given)
    return found, (*gradient, *(-factor for _, factor in equation.terms))


def _own_residual(equation: Equation, state: Array, given: Array | float) -> tuple[Array, tuple[Array | float, ...]]:
    """Without the gradient by its terms; `given`: the driver's value and the terms."""
    a, b = 3 * equation.body, 3 * equation.on
    if equation.kind == "angle":
        return state[:, a + 2] - state[:, b + 2] - equation.angle - given, (0.0, 0.0, 1.0, 0.0, 0.0, -1.0)
    rx, ry = _turned(equation.point, state[:, a + 2])
    qx, qy = _turned(equation.place, state[:, b + 2])
    vx = state[:, a] + rx - state[:, b] - qx
    vy = state[:, a + 1] + ry - state[:, b + 1] - qy
    if equation.kind == "meet x":
        return vx, (1.0, 0.0, -ry, -1.0, 0.0, qy)
    if equation.kind == "meet y":
        return vy, (0.0, 1.0, rx, 0.0, -1.0, -qx)
    direction = state[:, b + 2] + equation.angle
    tx, ty = np.cos(direction), np.sin(direction)
    along, across = tx * vx + ty * vy, tx * vy - ty * vx
    if equation.kind == "line":
        return across, (-ty, tx, ty * ry + tx * rx, ty, -tx, -along - ty * qy - tx * qx)
    return along - equation.offset - given, (tx, ty, ty * rx - tx * ry, -tx, -ty, across - ty * qx + tx * qy)


def _turned(point: tuple[float, float], angle: Array) -> tuple[Array | float, Array | float]:
    x, y = point
    if x == 0 and y == 0:
        return 0.0, 0.0
    c, s = np.cos(angle), np.sin(angle)
    return c * x - s * y, s * x + c * y


def linearised(block: Block, state: Array, value: Array) -> tuple[Array, Array]:
    """Residuals (m, k) and Jacobian (m, k, k) of a block at `state` (m, columns)."""
    k = len(block.columns)
    residuals = np.empty((len(state), k))
    jacobian = np.zeros((len(state), k, k))
    for i, (equation, slots) in enumerate(zip(block.equations, block.slots, strict=True)):
        residuals[:, i], gradient = residual(equation, state, value)
        for slot, position in slots:
            jacobian[:, i, position] += gradient[slot]
    return residuals, jacobian


# --- which unknowns are solved together, in order --------------------------------------------------------------------


Pattern = Sequence[Sequence[int]]
"""For each equation the unknowns that stand in it."""


def matching(pattern: Pattern) -> list[int] | None:
    """For each equation an unknown of its own, or None when there is none (augmenting paths, in the order given)."""
    owner: dict[int, int] = {}

    def claim(equation: int, tried: set[int]) -> bool:
        for unknown in pattern[equation]:
            if unknown not in tried:
                tried.add(unknown)
                if unknown not in owner or claim(owner[unknown], tried):
                    owner[unknown] = equation
                    return True
        return False

    if not all(claim(equation, set()) for equation in range(len(pattern))):
        return None
    chosen = [0] * len(pattern)
    for unknown, equation in owner.items():
        chosen[equation] = unknown
    return chosen


def blocks(pattern: Pattern) -> list[tuple[list[int], list[int]]] | None:
    """Irreducible diagonal blocks (equations, unknowns), each after those it needs; None when none exists.

    Equations and unknowns inside a block ascend, so that the sign of the block's determinant is well defined.
    """
    chosen = matching(pattern)
    if chosen is None:
        return None
    equation_of = {unknown: equation for equation, unknown in enumerate(chosen)}
    needs = [[equation_of[unknown] for unknown in unknowns] for unknowns in pattern]
    return [(sorted(part), sorted(chosen[equation] for equation in part)) for part in _components(needs)]


def _components(needs: Sequence[Sequence[int]]) -> list[list[int]]:
    """Strongly connected components, each after those it needs (Tarjan 1972, without recursion)."""
    index: dict[int, int] = {}
    low: dict[int, int] = {}
    stack: list[int] = []
    on_stack: set[int] = set()
    found: list[list[int]] = []
    for root in range(len(needs)):
        if root in index:
            continue
        work = [(root, 0)]
        while work:
            node, position = work.pop()
            if position == 0:
                index[node] = low[node] = len(index)
                stack.append(node)
                on_stack.add(node)
            else:
                low[node] = min(low[node], low[needs[node][position - 1]])
            for place in range(position, len(needs[node])):
                other = needs[node][place]
                if other not in index:
                    work += [(node, place + 1), (other, 0)]
                    break
                if other in on_stack:
                    low[node] = min(low[node], index[other])
            else:
                if low[node] == index[node]:
                    cut = stack.index(node)
                    found.append(stack[cut:])
                    on_stack.difference_update(stack[cut:])
                    del stack[cut:]
    return found

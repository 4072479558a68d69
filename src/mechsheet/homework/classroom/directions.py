"""From which line of a link its angle counts, and where its points lie, without the frame in which a description has them.

The angle of a link is that of its frame's x axis. Where two of its points lie along the axis, it is the direction from one
to the other; else the direction between two points less a quarter of a turn, or less what the description says; of a link
with one point that of the line along which it slides. Of a wheel with one point the relation to the others says it.

An angle is said as a person says it, `plus β + 90°`, not `less (−β − π/2)` (`spoken`): a sum, what is added before what is
taken off; its numbers are one, in degrees where the description's angles are.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Node, Number, Unary, symbols
from livesheet.formula.scalar import evaluate
from mechsheet import reference
from mechsheet.homework.agreement import DEGREE
from mechsheet.homework.expected_values import Truth, truth_of
from mechsheet.model import Cartesian, Distances, Joint, Link, Mechanism, Polar, Quantity
from mechsheet.units import DEG

QUARTER = 90
OTHERWISE = 1.013
"""The dimensions are changed by this factor, and more from one to the next: what stays the same does not depend on them."""
ALIKE = 1e-7
"""Angles that differ by less are one [rad]."""


@dataclass(frozen=True, slots=True)
class Direction:
    """A link's angle = direction from `start` to `end` less `less`; a node, or quarters of a turn in degrees.

    joint  instead of two points the line of a sliding joint
    """

    start: str = ""
    end: str = ""
    less: Node | int = 0
    joint: Joint | None = None


class Directions:
    """The directions of a mechanism's links by name; None for a wheel with one point, whose angle is no direction."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.mechanism = mechanism
        self.states = list(_states(mechanism))
        self.of: dict[str, Direction | None] = {link.name: self._of(link) for link in mechanism.whole_links}

    def _of(self, link: Link) -> Direction | None:
        pairs = list(itertools.permutations(link.points, 2))
        turned = {pair: self._quarters(link, *pair) for pair in pairs}
        for wanted in ((0,), (QUARTER, -QUARTER)):
            for pair in pairs:
                quarters = turned[pair]
                if quarters is not None and quarters in wanted:
                    return Direction(*pair, quarters)
        for start, end in pairs:
            one, other = link.points[start], link.points[end]
            if isinstance(one, Distances) or isinstance(other, Distances) or not self._apart(start, end):
                continue
            if isinstance(other, Polar) and _at_origin(link, start):
                return Direction(start, end, al.as_node(other.angle))
            dx, dy = (al.sub(b, a) for a, b in zip(_cartesian(one), _cartesian(other), strict=True))
            return Direction(start, end, Call("ATAN2", (dx, dy)))
        slides = [joint for joint in self.mechanism.joints if link.name in (joint.link, joint.on)]
        for joint in slides:
            if joint.kind == "prismatic" or joint.on == link.name:
                return Direction(less=_from_line(joint, link), joint=joint)
        return None

    def _quarters(self, link: Link, start: str, end: str) -> int | None:
        """By how many degrees, -90, 0, 90 or 180, the way between two points is turned against the link's axis."""
        found = set()
        for state in self.states:
            dx, dy = (state.columns[f"{end}.{axis}"] - state.columns[f"{start}.{axis}"] for axis in "xy")
            row = int(np.flatnonzero(state.exists)[0])
            if math.hypot(dx[row], dy[row]) <= ALIKE * state.size:
                return None
            turned = (
                math.remainder(math.atan2(dy[row], dx[row]) - _angle(state, link, row), math.tau) / DEGREE / QUARTER
            )
            if abs(turned - round(turned)) * QUARTER * DEGREE > ALIKE:
                return None
            found.add(QUARTER * (round(turned) % 4))
        (quarters, *others) = found
        return None if others else quarters - 360 if quarters == 3 * QUARTER else quarters

    def _apart(self, start: str, end: str) -> bool:
        state = self.states[0]
        row = int(np.flatnonzero(state.exists)[0])
        gap = [state.columns[f"{end}.{axis}"][row] - state.columns[f"{start}.{axis}"][row] for axis in "xy"]
        return math.hypot(*gap) > ALIKE * state.size

    def place(self, link: Link, place: Cartesian | Polar) -> tuple[str, str, tuple[Node, Node]]:
        """A place of a link's frame as (from, to, (how far along the way from the one to the other, how far to the left of
        it)); without `to` along the direction in which the link's angle counts."""
        known = self.of[link.name]
        x, y = _cartesian(place)
        if known is None or not known.start:
            return next(iter(link.points), ""), "", (x, y)
        start = link.points[known.start]
        if not isinstance(start, Distances):
            base = _cartesian(start)
            x, y = al.sub(x, base[0]), al.sub(y, base[1])
        turned = {0: (x, y), QUARTER: (y, al.neg(x)), -QUARTER: (al.neg(y), x)}
        if isinstance(known.less, int):
            return known.start, known.end, turned[known.less]
        return known.start, "", (x, y)

    def turned(self, link: Link, place: Cartesian | Polar) -> Quantity | None:
        """By which angle the way to a place is turned against the line of its link, where the description has it so."""
        known = self.of[link.name]
        if known is None or not isinstance(place, Polar) or not known.start or not _at_origin(link, known.start):
            return None
        quarters = known.less if isinstance(known.less, int) else 0
        if isinstance(place.angle, float):
            return place.angle - quarters * DEGREE
        return al.sub(place.angle, al.call("RADIANS", al.number(float(quarters)))) if quarters else place.angle


def _states(mechanism: Mechanism) -> Iterator[Truth]:
    """The mechanism with its own dimensions, and with others, in the rows that it has."""
    given = reference.dimension_values(mechanism)
    values = reference.driver_values(mechanism, given)
    own = truth_of(mechanism, {}, values)
    if own is None:
        return
    yield own
    inputs = [dim.symbol for dim in mechanism.free_dimensions]
    for factor in (OTHERWISE, 1 / OTHERWISE):
        changed = {symbol: given[symbol] * factor ** (1 + number / 7) for number, symbol in enumerate(inputs)}
        other = truth_of(mechanism, changed, values, own.poses)
        if other is not None and (other.exists & own.exists).any():
            yield other


def _angle(state: Truth, link: Link, row: int) -> float:
    column = state.columns.get(link.angle_symbol)
    return 0.0 if column is None else float(column[row])  # the ground has none


def _cartesian(place: Cartesian | Polar) -> tuple[Node, Node]:
    """The coordinates of a place in its frame."""
    if isinstance(place, Cartesian):
        return al.as_node(place.x), al.as_node(place.y)
    r, angle = al.as_node(place.r), al.as_node(place.angle)
    return al.mul(r, al.call("COS", angle)), al.mul(r, al.call("SIN", angle))


def _at_origin(link: Link, name: str) -> bool:
    place = link.points[name]
    return not isinstance(place, Distances) and all(map(al.is_zero, _cartesian(place)))


def _from_line(joint: Joint, link: Link) -> Node:
    """The angle of a sliding joint's line less that of a link on either side of it."""
    angle, orientation = al.as_node(joint.angle), al.as_node(joint.orientation)
    return angle if joint.on == link.name else al.neg(orientation)


# --- angles as they are said -----------------------------------------------------------------------------------------


READABLE = 4
"""Decimals of a number of degrees: a person draws no finer, and marks allow a hundred times more."""


@dataclass(frozen=True, slots=True)
class SpokenAngle:
    """A sum of angles: `plus` and `minus` are its terms without their signs, those with symbols first."""

    plus: tuple[Node, ...] = ()
    minus: tuple[Node, ...] = ()

    @property
    def negative(self) -> bool:
        """Whether nothing is added."""
        return not self.plus

    @property
    def terms(self) -> int:
        """How many there are; none for an angle of 0."""
        return len(self.plus) + len(self.minus)

    def negated(self) -> SpokenAngle:
        """The same angle the other way round."""
        return replace(self, plus=self.minus, minus=self.plus)

    @property
    def node(self) -> Node:
        """As a formula."""
        total: Node = al.ZERO
        for term in self.plus:
            total = al.add(total, term)
        for term in self.minus:
            total = al.sub(total, term)
        return total


def spoken(angle: Node, in_degrees: bool) -> SpokenAngle:
    """An angle in radians as a sum; `in_degrees`: its numbers are said in degrees."""
    ways: dict[int, list[Node]] = {1: [], -1: []}
    constant = 0.0
    for sign, term in _terms(angle, 1):
        if in_degrees and not symbols(term):
            constant += sign * evaluate(term, {})
        else:
            ways[sign].append(term)
    degrees = round(DEG.to_shown(constant), READABLE)
    if degrees:
        ways[1 if degrees > 0 else -1].append(al.call("RADIANS", Number(abs(degrees))))
    return SpokenAngle(tuple(ways[1]), tuple(ways[-1]))


def _terms(node: Node, sign: int) -> list[tuple[int, Node]]:
    """The terms of a sum with their signs; the sign of a product is that of its first factor."""
    match node:
        case Number(value) if value < 0:
            return [(-sign, Number(-value))]
        case Unary("-", operand):
            return _terms(operand, -sign)
        case Binary("+" | "-" as op, left, right):
            return [*_terms(left, sign), *_terms(right, sign if op == "+" else -sign)]
        case Binary("*" | "/" as op, left, right):
            inside = _terms(left, sign)
            return [(inside[0][0], Binary(op, inside[0][1], right))] if len(inside) == 1 else [(sign, node)]
    return [(sign, node)]

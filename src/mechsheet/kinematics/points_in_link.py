"""Places in the frame of a link, as formulas: where each point lies, and the straight arm from one point to another.

An arm is (length, angle from the link's x axis). Lengths between joints are kept positive: a dimension that is one is
noted as such (the workbook insists on it), anything else gets a derived constant of its own, SQRT(u^2 + v^2).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass

from livesheet import portable
from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Call, Node, Symbol, TriangleAngle
from livesheet.formula.scalar import evaluate
from livesheet.said import Words
from mechsheet.kinematics.equations import Condition
from mechsheet.kinematics.ledger import Ledger
from mechsheet.model import Cartesian, Distances, GivenPoint, Link, Polar, Quantity
from mechsheet.units import ANGLE, LENGTH
from mechsheet.words.equations import link_words, phrase

Point = tuple[float, float]
"""(u, v) in a link's frame, in the length unit."""


def angle_of(quantity: Quantity) -> Angle:
    """An angle of the model as a formula."""
    return al.right_angle(quantity) if isinstance(quantity, float) else Angle(quantity)


def number(quantity: Quantity, dimensions: Mapping[str, float]) -> float:
    """The value of a quantity of the model."""
    return quantity if isinstance(quantity, float | int) else evaluate(quantity, dimensions)


def number_points(link: Link, dimensions: Mapping[str, float]) -> dict[str, Point]:
    """(u, v) of every point of a link in its own frame, in the order of the description.

    dimensions  by symbol, in internal units

    Distances that make no triangle give a point on the line of the two others. Raises as `evaluate`, and ZeroDivisionError
    where these two are one place.
    """
    found: dict[str, Point] = {}

    def locate(point: str) -> Point:
        if point not in found:
            found[point] = _number_point(link.points[point], dimensions, locate)
        return found[point]

    return {point: locate(point) for point in link.points}


def _number_point(given: GivenPoint, dimensions: Mapping[str, float], locate: Callable[[str], Point]) -> Point:
    match given:
        case Cartesian(x, y):
            return number(x, dimensions), number(y, dimensions)
        case Polar(r, angle):
            turn = number(angle, dimensions)
            return number(r, dimensions) * portable.cos(turn), number(r, dimensions) * portable.sin(turn)
        case Distances(first, first_distance, second, second_distance, side):
            (x1, y1), (x2, y2) = locate(first), locate(second)
            a, b = number(first_distance, dimensions), number(second_distance, dimensions)
            base = portable.hypot(x2 - x1, y2 - y1)
            along = (a * a - b * b + base * base) / (2 * base)
            across = math.sqrt(max(0.0, a * a - along * along)) * (1 if side == "left" else -1)
            c, s = (x2 - x1) / base, (y2 - y1) / base
            return x1 + along * c - across * s, y1 + along * s + across * c


@dataclass(frozen=True, slots=True)
class PointInLink:
    """A place (or a difference of two) in a link's frame: (u, v), and as (r, angle) where that is simple (r may be < 0)."""

    u: Node
    v: Node
    polar: tuple[Node, Angle] | None = None

    @property
    def is_zero(self) -> bool:
        """True for the frame's origin."""
        return al.is_zero(self.u) and al.is_zero(self.v)

    def __neg__(self) -> PointInLink:
        polar = (self.polar[0], self.polar[1] + Angle(degrees=180)) if self.polar else None
        return PointInLink(al.neg(self.u), al.neg(self.v), polar)

    def __sub__(self, other: PointInLink) -> PointInLink:
        if other.is_zero:
            return self
        if self.is_zero:
            return -other
        return cartesian(al.sub(self.u, other.u), al.sub(self.v, other.v))

    def __add__(self, other: PointInLink) -> PointInLink:
        return self - (-other)

    def turned(self, angle: Angle) -> tuple[Node, Node]:
        """(x, y) of the vector after its frame has been turned by `angle`: r cos(angle + a), or u cos - v sin."""
        if self.polar:
            r, own = self.polar
            return al.mul(r, al.cos(angle + own)), al.mul(r, al.sin(angle + own))
        c, s = al.cos(angle), al.sin(angle)
        return (
            al.sub(al.mul(self.u, c), al.mul(self.v, s)),
            al.add(al.mul(self.u, s), al.mul(self.v, c)),
        )


ORIGIN = PointInLink(al.ZERO, al.ZERO)


def cartesian(u: Node, v: Node) -> PointInLink:
    """The place (u, v); on an axis it is polar as well."""
    if al.is_zero(v):
        return PointInLink(u, v, (u, Angle()))
    if al.is_zero(u):
        return PointInLink(u, v, (v, Angle(degrees=90)))
    return PointInLink(u, v)


def polar(r: Node, angle: Angle) -> PointInLink:
    """The place at distance r in the direction `angle`."""
    return PointInLink(al.mul(r, al.cos(angle)), al.mul(r, al.sin(angle)), (r, angle))


class PointsInLink:
    """The places of a link's points; the constants they need are written into the ledger."""

    def __init__(self, link: Link, ledger: Ledger) -> None:
        self.link = link
        self.words = link_words(link)
        self.ledger = ledger
        self._points: dict[str, PointInLink] = {}
        self._offsets: dict[str, PointInLink] = {}
        self._lengths: dict[frozenset[str], Node] = {}

    def point(self, point: str) -> PointInLink:
        """The place of a point."""
        if point not in self._points:
            given = self.link.points[point]
            match given:
                case Cartesian(x, y):
                    self._points[point] = cartesian(al.as_node(x), al.as_node(y))
                case Polar(r, angle):
                    label = phrase("direction_in_link", point=point, link=self.words)
                    hoisted = self.ledger.hoist_angle(f"beta_{point}", angle_of(angle), label)
                    self._points[point] = polar(al.as_node(r), hoisted)
                case Distances():
                    self._points[point] = self._from_distances(point, given)
        return self._points[point]

    def way(self, start: str, end: str) -> PointInLink:
        """The vector from one point to another; a point given by distances lies at its offset from the first of them."""
        for point, base in ((end, start), (start, end)):
            given = self.link.points[point]
            if isinstance(given, Distances) and given.first == base:
                self.point(point)
                return self._offsets[point] if point == end else -self._offsets[point]
        return self.point(end) - self.point(start)

    def note_length(self, start: str, end: str) -> str:
        """The two points are joints, and the link has no others: where a dimension is their distance, it is a length.

        Its symbol is returned if it cannot be one, since it is not greater than 0; else "".
        """
        way = self.way(start, end)
        if not way.polar:
            return ""
        length = way.polar[0] if isinstance(way.polar[0], Symbol) else al.neg(way.polar[0])
        if not isinstance(length, Symbol) or self.ledger.is_positive(length):
            return ""
        return length.name if length.name in self.ledger.dimensions else ""

    def known_length(self, first: str, second: str) -> Node | None:
        """The distance of two points where the description gives it as such."""
        return self._lengths.get(frozenset((first, second)))

    def _arm(self, start: str, end: str) -> tuple[Node, Angle]:
        """Length (> 0) and direction of the arm from one point to another."""
        label = phrase("length_in_link", start=start, end=end, link=self.words)
        return arm_of(self.ledger, self.way(start, end), self.known_length(start, end), f"{start}{end}", label)

    def _from_distances(self, point: str, given: Distances) -> PointInLink:
        """By the law of cosines: from the first point, turned from the line to the second by the angle between them."""
        ledger, n = self.ledger, self.link.number
        b, c = al.as_node(given.first_distance), al.as_node(given.second_distance)
        self._lengths[frozenset((point, given.first))] = b
        self._lengths[frozenset((point, given.second))] = c
        a, line = self._arm(given.first, given.second)
        ledger.is_positive(b)
        ledger.is_positive(c)
        words = phrase("angle_in_link", name=f"{given.second}{given.first}{point}", link=self.words)
        closes = triangle_closes(ledger, a, b, c)
        gamma = ledger.hoist(f"gamma{n}", TriangleAngle(c, a, b), ANGLE, words, exists=[closes])
        turned = Angle(gamma) if given.side == "left" else Angle(al.neg(gamma))
        offset = polar(b, line + turned)
        self._offsets[point] = offset
        start = self.point(given.first)
        if start.is_zero:
            return offset
        # in cells of its own: places that are given by this one would repeat its formula, and theirs in turn
        label = phrase("place_in_link", point=point, link=self.words)
        u = ledger.hoist(f"u_{point}", al.add(start.u, offset.u), LENGTH, label)
        v = ledger.hoist(f"v_{point}", al.add(start.v, offset.v), LENGTH, label)
        return cartesian(u, v)


def arm_of(ledger: Ledger, way: PointInLink, known: Node | None, name: str, label: Words) -> tuple[Node, Angle]:
    """Length (> 0) and direction of a vector in a link's frame."""
    if way.polar:
        r, angle = way.polar
        if ledger.is_positive(r):
            return ledger.hoist(name, r, LENGTH, label), ledger.hoist_angle(f"beta_{name}", angle, label)
        if ledger.is_positive(al.neg(r)):
            turned = angle + Angle(degrees=180)
            return ledger.hoist(name, al.neg(r), LENGTH, label), ledger.hoist_angle(f"beta_{name}", turned, label)
    u = ledger.hoist(f"u_{name}", way.u, LENGTH, label)
    v = ledger.hoist(f"v_{name}", way.v, LENGTH, label)
    length = known or ledger.hoist(name, al.sqrt(al.add(al.square(u), al.square(v))), LENGTH, label)
    if known is not None:
        ledger.is_positive(known)
    if ledger.is_constant(u) and ledger.is_constant(v):
        return length, Angle(ledger.hoist(f"beta_{name}", al.atan2(u, v), ANGLE, label))
    return length, Angle(ledger.direction(f"beta_{name}", u, v, label))


def triangle_closes(ledger: Ledger, a: Node, b: Node, c: Node) -> Condition:
    """Three sides form a triangle, rounding aside: the smaller of a + b - c and c - |a - b| is by how much they reach each
    other, or (negative) miss."""
    margin = Call("MIN", (al.sub(al.add(a, b), c), al.sub(c, Call("ABS", (al.sub(a, b),)))))
    return Condition(margin, al.neg(ledger.tolerance), reach=True)

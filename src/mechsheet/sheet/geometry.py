"""Where points stand in their links, and how long links are, straight from the description.

The equations have forms of their own for this (angles of triangles, directions of arms). The checks must not share them,
so here every place is (u, v) in its link's frame, as the drawing gives it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TypeAlias

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from mechsheet.kinematics.equations import LinkPose
from mechsheet.kinematics.ledger import CLOSING
from mechsheet.kinematics.points_in_link import angle_of
from mechsheet.model import Cartesian, Distances, Link, Polar
from mechsheet.sheet.columns.lowering import Assignments
from mechsheet.sheet.quoted import formula

UV: TypeAlias = tuple[Node, Node]
Known: TypeAlias = Mapping[str, UV]
"""Places of points by name."""

NOTHING_KNOWN: Known = {}


def base_point(link: Link) -> str:
    """The first point of a link that is given by coordinates, from which its others are laid off; "" without points."""
    placed = [point for point, given in link.points.items() if not isinstance(given, Distances)]
    return next(iter([*placed, *link.points]), "")


def place(link: Link, point: str, known: Known = NOTHING_KNOWN) -> UV:
    """(u, v) of a point in its link's frame, over dimensions.

    known  places that stand in cells already: a point given by its distances from them is laid off from those cells
    """
    given = link.points[point]
    match given:
        case Cartesian(x, y):
            return al.as_node(x), al.as_node(y)
        case Polar(r, angle):
            length, direction = al.as_node(r), angle_of(angle)
            return al.mul(length, al.cos(direction)), al.mul(length, al.sin(direction))
        case Distances():
            return _by_distances(given, *(_known_place(link, name, known) for name in (given.first, given.second)))


def _known_place(link: Link, point: str, known: Known) -> UV:
    return known[point] if point in known else place(link, point, known)


def _by_distances(given: Distances, first: UV, second: UV) -> UV:
    """Where two circles meet: along the line from the first point to the second, then across it to the side given.

    along = (b^2 - c^2 + d^2) / (2 d),   across = sqrt((b+c+d)(b+c-d)(d+b-c)(d-b+c)) / (2 d)    (twice the area over d)
    """
    u, v = first
    way_u, way_v = al.sub(second[0], u), al.sub(second[1], v)
    b, c = al.as_node(given.first_distance), al.as_node(given.second_distance)
    d = al.sqrt(al.add(al.square(way_u), al.square(way_v)))
    along = al.div(al.add(al.sub(al.square(b), al.square(c)), al.square(d)), al.mul(al.TWO, d))
    product = al.mul(
        al.mul(al.add(al.add(b, c), d), al.sub(al.add(b, c), d)),
        al.mul(al.sub(al.add(d, b), c), al.add(al.sub(d, b), c)),
    )
    across = formula("SQRT(MAX(0,product))/(2*d)", product=product, d=d)
    if given.side == "right":
        across = al.neg(across)
    return (
        al.add(u, al.div(al.sub(al.mul(along, way_u), al.mul(across, way_v)), d)),
        al.add(v, al.div(al.add(al.mul(along, way_v), al.mul(across, way_u)), d)),
    )


def distance(link: Link, start: str, end: str, known: Known = NOTHING_KNOWN) -> Node:
    """The distance of two points of a link: as given, or from their places."""
    for point, other in ((start, end), (end, start)):
        given = link.points[point]
        if isinstance(given, Distances):
            if given.first == other:
                return al.as_node(given.first_distance)
            if given.second == other:
                return al.as_node(given.second_distance)
    for point, other in ((start, end), (end, start)):
        given = link.points[point]
        if isinstance(given, Polar) and _known_place(link, other, known) == (al.ZERO, al.ZERO):
            return formula("ABS(length)", length=al.as_node(given.r))
    (u0, v0), (u1, v1) = (_known_place(link, point, known) for point in (start, end))
    return al.sqrt(al.add(al.square(al.sub(u1, u0)), al.square(al.sub(v1, v0))))


def length_in_cells(link: Link, start: str, end: str, poses: Mapping[str, LinkPose]) -> Node:
    """The distance of two points of a link, over dimensions and the cells that the equations have.

    Points that are laid off from points which are laid off themselves are read where they stand: written out, each level
    would be twenty times as long as the one before.
    """
    laid_off = {point: given for point, given in link.points.items() if isinstance(given, Distances)}
    deep = [point for point, given in laid_off.items() if given.first in laid_off or given.second in laid_off]
    return distance(link, start, end, {point: poses[link.name].places[point] for point in deep})


def largest_length(equations: Assignments) -> Node:
    """The largest length given, over cells: that of which the tolerance is a part (`CLOSING`)."""
    return al.div(Symbol(equations.tolerance), al.number(CLOSING))


def measured_pairs(link: Link) -> tuple[tuple[str, str], ...]:
    """Pairs of points to lay a ruler on: those whose distance the description gives, and each other point with the base."""
    base = base_point(link)
    pairs: dict[frozenset[str], tuple[str, str]] = {}
    for point, given in link.points.items():
        for other in (given.first, given.second) if isinstance(given, Distances) else (base,):
            if point != other:
                pairs.setdefault(frozenset((other, point)), (other, point))
    return tuple(pairs.values())

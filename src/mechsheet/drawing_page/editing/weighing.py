"""Masses of links by their shapes: bars, discs, plates. Centre and moment of inertia follow the dimensions."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Node, Symbol
from livesheet.formula.printer import print_formula
from mechsheet.description.scope import symbol_fault
from mechsheet.description.text.numbers import METRES, labels_of
from mechsheet.description.text.rewrite import with_last_key
from mechsheet.description.text.source import Source
from mechsheet.drawing_page.editing.sheet import Sheet, free_symbol, noted, quoted_key, rounded, said, with_length
from mechsheet.drawing_page.positions import local_points
from mechsheet.drawing_page.questions import Impossible, Refusal
from mechsheet.drawing_page.reading import number_in_unit, own_units
from mechsheet.model import Cartesian, Distances, Link, Polar

Vector = tuple[Node, Node]


@dataclass(frozen=True, slots=True)
class Weighed:
    """A body.

    center   in the link's frame, or a point of the link by its name
    squares  what the mass is multiplied with for the moment of inertia, times `parts`; 0 where it has none
    """

    center: str | Vector
    squares: Node = al.ZERO
    parts: int = 1


def weigh(sheet: Sheet, name: str, size: str, shape: str) -> Sheet:
    """The sheet with a mass for a link, spread over a shape of `SHAPES`; gravity comes with the first one."""
    weighed = sheet.moving(name, "load_moving")
    if not weighed.points:
        raise Impossible("load_moving")
    if shape not in SHAPES:
        raise Refusal(f'no shape is called "{shape}"')
    if not _without_mass(sheet, name):
        raise Impossible("there_already", name=f"[links.{name}] mass")
    metric = sheet.parts.length_unit in METRES
    _, unit = own_units(sheet.source)
    symbol = f"m_{name}" if not symbol_fault(f"m_{name}") else f"m_link{weighed.number}"
    symbol = free_symbol(sheet.parts, symbol)
    source = sheet.source
    value = number_in_unit(source, size, unit)
    label = said(sheet, "label.mass", link=name)
    source = with_length(
        source, symbol, value, label, f', unit = "{unit if unit in labels_of(sheet.parts.length_unit) else 1}"'
    )
    sheet, body = SHAPES[shape](sheet.again(source, {}), weighed)
    source = sheet.source
    path = ("links", name)
    source = with_last_key(source, path, "mass", noted(sheet, f'"{symbol}"', "mass", unit=unit))
    center = quoted_key(body.center) if isinstance(body.center, str) else _written(body.center)
    if len(weighed.points) > 1:
        source = with_last_key(source, path, "center", noted(sheet, center, "center"))
    inertia = al.div(al.mul(Symbol(symbol), body.squares), al.number(body.parts))
    in_metre = round(1 / METRES.get(sheet.parts.length_unit, 1.0))
    if in_metre != 1:
        inertia = al.div(inertia, Binary("^", al.number(in_metre), al.TWO))
    source = with_last_key(source, path, "inertia", noted(sheet, _text(inertia), "inertia"))
    if "gravity" not in source.data.get("dynamics", {}) and metric:
        source = with_last_key(source, ("dynamics",), "gravity", "9.81")
    return sheet.again(source, {})


def weigh_all(sheet: Sheet) -> Sheet:
    """The sheet with a mass for every moving link that has none, each of them a bar."""
    before = sheet.source
    for moving in sheet.parts.links[1:]:
        if _without_mass(sheet, moving.name):
            sheet = weigh(sheet, moving.name, "1", "bar" if len(moving.points) > 1 else "point")
    if sheet.source is before:
        raise Impossible("there_already", name="mass")
    return sheet


def _without_mass(sheet: Sheet, name: str) -> bool:
    """Whether a link can be given one: it has none, and a heading under which it can be written."""
    links = sheet.source.data.get("links")
    own = links.get(name) if isinstance(links, dict) else None
    return isinstance(own, dict) and "mass" not in own


# --- shapes -----------------------------------------------------------------------------------------------------------


def _bar(sheet: Sheet, link: Link) -> tuple[Sheet, Weighed]:
    """A slender bar between the link's two points that are farthest apart."""
    first, second = _ends(sheet, link)
    return sheet, Weighed(_mean(link, first, second), _square_of(link, first, second), 12)


def _disc(sheet: Sheet, link: Link) -> tuple[Sheet, Weighed]:
    """A disc about the link's pin on the ground, else about its first point; its radius is a dimension."""
    middle = next((point for point in link.points if point in sheet.ground.points), next(iter(link.points)))
    symbol, source = _own_length(sheet, link, "r", "label.radius")
    return sheet.again(source, {}), Weighed(middle, al.square(Symbol(symbol)), 2)


def _plate(sheet: Sheet, link: Link) -> tuple[Sheet, Weighed]:
    """A triangle of the link's first three points; of two points a rectangle along them, whose width is a dimension."""
    if len(link.points) > 2:
        a, b, c = list(link.points)[:3]
        sides = al.total([_square_of(link, a, b), _square_of(link, b, c), _square_of(link, a, c)])
        return sheet, Weighed(_mean(link, a, b, c), sides, 36)
    first, second = _ends(sheet, link)
    symbol, source = _own_length(sheet, link, "b", "label.width")
    both = al.add(_square_of(link, first, second), al.square(Symbol(symbol)))
    return sheet.again(source, {}), Weighed(_mean(link, first, second), both, 12)


def _point(sheet: Sheet, link: Link) -> tuple[Sheet, Weighed]:
    """All of it in the middle between the link's points."""
    first, *others = link.points
    return sheet, Weighed(_mean(link, first, *others) if others else first)


SHAPES: dict[str, Callable[[Sheet, Link], tuple[Sheet, Weighed]]] = {
    "bar": _bar,
    "disc": _disc,
    "plate": _plate,
    "point": _point,
}
"""Shapes of a link, in the order of the page's list."""


def _ends(sheet: Sheet, link: Link) -> tuple[str, str]:
    """The two points of a link that are farthest apart. Raises Impossible where it has one alone."""
    places = local_points(link, sheet.parts.numbers)
    pairs = [(a, b) for a in places for b in places if a < b]
    if not pairs:
        raise Impossible("bar_ends")
    first, second = max(pairs, key=lambda pair: math.dist(places[pair[0]], places[pair[1]]))
    first, second = sorted((first, second), key=list(link.points).index)
    return first, second


def _own_length(sheet: Sheet, link: Link, letter: str, key: str) -> tuple[str, Source]:
    """A new length of a link, a quarter of its own size; its symbol, and the text with it."""
    places = list(local_points(link, sheet.parts.numbers).values())
    size = max((math.dist(a, b) for a in places for b in places), default=0.0) or 40.0
    symbol = free_symbol(sheet.parts, f"{letter}_{link.number}")
    length = rounded(size / 4, max(0, sheet.digits - 2))
    return symbol, with_length(sheet.source, symbol, length, said(sheet, key, link=link.name))


def place_in(link: Link, point: str) -> Vector:
    """Where a point lies in its link's frame, over the dimensions."""
    match link.points[point]:
        case Cartesian(x, y):
            return al.as_node(x), al.as_node(y)
        case Polar(r, angle):
            turn = al.as_node(angle)
            return al.mul(al.as_node(r), al.call("COS", turn)), al.mul(al.as_node(r), al.call("SIN", turn))
        case Distances(first, first_distance, second, second_distance, side):
            (x1, y1), (x2, y2) = place_in(link, first), place_in(link, second)
            a, b = al.as_node(first_distance), al.as_node(second_distance)
            dx, dy = al.sub(x2, x1), al.sub(y2, y1)
            base = al.add(al.square(dx), al.square(dy))
            along = al.div(al.add(al.sub(al.square(a), al.square(b)), base), al.mul(al.number(2), base))
            across = al.sqrt(al.sub(al.div(al.square(a), base), al.square(along)))
            across = across if side == "left" else al.neg(across)
            x = al.sub(al.add(x1, al.mul(along, dx)), al.mul(across, dy))
            return x, al.add(al.add(y1, al.mul(along, dy)), al.mul(across, dx))


def _mean(link: Link, *points: str) -> Vector:
    places = [place_in(link, point) for point in points]
    x, y = (al.div(al.total(part), al.number(len(points))) for part in zip(*places, strict=True))
    return x, y


def _square_of(link: Link, first: str, second: str) -> Node:
    """The square of the distance of two points."""
    start, end = place_in(link, first), place_in(link, second)
    given = link.points[second]
    if isinstance(given, Polar) and all(map(al.is_zero, start)):
        return al.square(al.as_node(given.r))
    return al.total([al.square(al.sub(b, a)) for a, b in zip(start, end, strict=True)])


def _written(place: Vector) -> str:
    return f"[{', '.join(_text(part) for part in place)}]"


def _text(node: Node) -> str:
    """A number, or an expression in quotes."""
    value = al.value_of(node)
    return rounded(value, 9) if value is not None else f'"{print_formula(node, "description")}"'

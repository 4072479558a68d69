"""What acts on the links, by the mouse: forces, torques, springs and dampers, in [[loads]]."""

from __future__ import annotations

import math
from itertools import count
from typing import Any

from livesheet.formula.names import folded
from mechsheet.description.text.numbers import METRES
from mechsheet.drawing_page.editing.links import new_pin
from mechsheet.drawing_page.editing.sheet import Sheet, free_symbol, in_frame, line, quoted_key, rounded
from mechsheet.drawing_page.positions import Point, Pose
from mechsheet.drawing_page.questions import Impossible, Refusal, end, point_in, text_in
from mechsheet.drawing_page.reading import number_in_unit, own_units
from mechsheet.model import Link

DIGITS = 6
"""Of a component of a force that was drawn."""

ROUND, NEAR = math.radians(15.0), math.radians(3.0)
"""An arrow that is drawn so near to a multiple of a round angle has that."""


def force(sheet: Sheet, tail: Any, to: Point, size: str) -> Sheet:
    """A force of this size where an arrow begins, in its direction.

    tail  {"point": …}: at a point of a moving link; {"link": …, "at": …}: at a place of that link
    """
    begun = end(tail)
    if "link" in begun:
        loaded = sheet.moving(text_in(begun, "link"), "load_moving")
        start = point_in(begun, "at")
        place = in_frame(start, sheet.drawn.poses.get(loaded.name, Pose()))
        where = f"[{', '.join(rounded(part, sheet.digits) for part in place)}]"
    else:
        point = text_in(begun, "point", "")
        if point not in sheet.drawn.places:
            raise Impossible("load_moving")
        loaded, start, where = _loaded(sheet, point), sheet.drawn.places[point], quoted_key(point)
    unit, _ = own_units(sheet.source)
    strength = float(number_in_unit(sheet.source, size, unit))
    x, y = _direction(start, to)
    parts = ", ".join(f"{part:.{DIGITS}g}" for part in (strength * x + 0.0, strength * y + 0.0))
    lines = [
        line(sheet, "name", f'"{_free_name(sheet, "P")}"'),
        line(sheet, "link", quoted_key(loaded.name)),
        line(sheet, "point", where),
        line(sheet, "force", f"[{parts}]", unit=unit),
    ]
    return sheet.with_entry("loads", lines)


def _direction(start: Point, to: Point) -> Point:
    """The unit vector of an arrow."""
    angle = math.atan2(to[1] - start[1], to[0] - start[0])
    if math.dist(start, to) == 0:
        raise Impossible("arrow")
    whole = round(angle / ROUND) * ROUND
    angle = whole if abs(angle - whole) < NEAR else angle
    return round(math.cos(angle), 12), round(math.sin(angle), 12)


def _loaded(sheet: Sheet, point: str) -> Link:
    """The moving link that a load at a point acts on: of several the last one, and not the driven one."""
    driven = sheet.parts.driver.link if sheet.parts.driver else ""
    moving = [each for each in sheet.parts.links_at(point) if each is not sheet.ground]
    if not moving:
        raise Impossible("load_moving")
    return next((each for each in reversed(moving) if each.name != driven), moving[-1])


def torque(sheet: Sheet, name: str, size: str) -> Sheet:
    """A torque on a link, counter-clockwise where it is positive."""
    sheet.moving(name, "load_moving")
    length = sheet.parts.length_unit
    unit = f"{own_units(sheet.source)[0]} {'m' if length in METRES else length}"
    value = number_in_unit(sheet.source, size, unit)
    lines = [
        line(sheet, "name", f'"{_free_name(sheet, "M")}"'),
        line(sheet, "link", quoted_key(name)),
        line(sheet, "torque", value, unit=unit),
    ]
    return sheet.with_entry("loads", lines)


def between(sheet: Sheet, key: str, ends: Any, size: str) -> Sheet:
    """A spring or a damper between two points: `key` is "stiffness" or "damping", `size` its value.

    An end that is a place is a new point of the ground. The spring is free of force as it is drawn.
    """
    if not isinstance(ends, list) or len(ends) != 2:
        raise Refusal("it begins and ends")
    points = []
    for given in map(end, ends):
        if "at" in given:
            sheet, point = new_pin(sheet, given)
        else:
            point = text_in(given, "point")
        points.append(point)
    first, second = points
    owners = [{link.name for link in sheet.parts.links_at(point)} for point in points]
    if first == second or not all(owners) or owners[0] & owners[1]:
        raise Impossible("spring_apart")
    per = " s" if key == "damping" else ""
    unit = f"{own_units(sheet.source)[0]}{per}/{sheet.parts.length_unit}"
    value = number_in_unit(sheet.source, size, unit)
    lines = [
        line(sheet, "name", f'"{_free_name(sheet, "K" if key == "stiffness" else "D")}"'),
        line(sheet, "between", f"[{quoted_key(first)}, {quoted_key(second)}]"),
        line(sheet, key, value, unit=unit),
    ]
    if key == "stiffness":
        length = math.dist(sheet.drawn.places[first], sheet.drawn.places[second])
        lines.append(line(sheet, "free_length", rounded(length, sheet.digits)))
    return sheet.with_entry("loads", lines)


def _free_name(sheet: Sheet, wanted: str) -> str:
    loads = sheet.source.data.get("loads")
    listed = loads if isinstance(loads, list) else []
    used = {folded(str(load.get("name", f"L{n}"))) for n, load in enumerate(listed, 1) if isinstance(load, dict)}
    names = (wanted if n == 1 else f"{wanted}{n}" for n in count(1))
    return next(name for name in names if folded(name) not in used and free_symbol(sheet.parts, name) == name)

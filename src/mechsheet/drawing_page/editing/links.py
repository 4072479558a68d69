"""Ground pins, links of two points, further points of a link, each with dimensions of its own; and other names for them."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

from livesheet.formula.names import folded
from mechsheet.description.scope import symbol_fault
from mechsheet.description.text.index import key_text
from mechsheet.description.text.rewrite import Renamed, renamed, with_last_key, with_table, without_key
from mechsheet.description.text.source import Source
from mechsheet.drawing_page.editing.sheet import (
    Sheet,
    end_of,
    free_link,
    free_point,
    free_symbol,
    in_frame,
    rounded,
    sketched,
    with_length,
)
from mechsheet.drawing_page.positions import Pose
from mechsheet.drawing_page.questions import Impossible, Refusal
from mechsheet.model import Link

FURTHER = (("a", "alpha"), ("b", "gamma"), ("c", "delta"), ("d", "epsilon"), ("e", "zeta"), ("f", "eta"))
"""Dimensions of a link's points from the second on: a distance and an angle, with the link's number behind."""

ALIGNED = 1e-6
"""Directions that differ by less [rad] are one."""


def ground_pin(sheet: Sheet, end: Any) -> Sheet:
    """A point of the ground: a new one, or one that is there and shall be fixed where it is."""
    name, place, new = end_of(sheet, end)
    if name in sheet.ground.points:
        raise Impossible("fixed_already", point=name)
    if new:
        name = free_point(sheet.parts, sheet.drawn.places, fixed=True)
    source = sheet.source
    written = []
    first = not sheet.ground.points
    for axis, value in zip("xy", place, strict=True):
        text = rounded(value, sheet.digits)
        if not first and float(text) != 0:  # the first pin is where the sheet has it; what is further is a dimension
            symbol = free_symbol(sheet.parts, f"{axis}_{name}")
            source = with_last_key(source, ("dimensions",), symbol, f'{{ value = {text}, label = "{axis}, {name}" }}')
            text = f'"{symbol}"'
        written.append(text)
    source = _with_point(source, sheet.ground.name, name, f"[{', '.join(written)}]")
    return sheet.again(without_key(source, ("assembly", name)), {name: place})


def new_pin(sheet: Sheet, end: dict[str, Any]) -> tuple[Sheet, str]:
    """The sheet with a new point of the ground, and its name."""
    before = sheet.drawn.places
    sheet = ground_pin(sheet, end)
    return sheet, next(point for point in sheet.drawn.places if point not in before)


def _with_point(source: Source, link: str, point: str, value: str) -> Source:
    return with_last_key(source, ("links", link, "points"), point, value)


def link(sheet: Sheet, ends: Any) -> Sheet:
    """A link between two points or places."""
    if not isinstance(ends, list) or len(ends) != 2:
        raise Refusal("a link begins and ends")
    (first, start, first_new), (second, end, second_new) = end_of(sheet, ends[0]), end_of(sheet, ends[1])
    if first_new and second_new:
        second = free_point(sheet.parts, [*sheet.drawn.places, first], fixed=False)
    if first == second or math.dist(start, end) <= 10.0**-sheet.digits:
        raise Impossible("same_point")
    if any(first in other.points and second in other.points for other in sheet.parts.links):
        raise Impossible("joined_already", first=first, second=second)
    name, number = free_link(sheet.parts, sheet.link_stem)
    symbol = free_symbol(sheet.parts, f"a{number}")
    length = rounded(math.dist(start, end), sheet.digits)
    source = with_length(sheet.source, symbol, length, f"{first}{second}")
    points = f'points = {{ {key_text(first)} = [0, 0], {key_text(second)} = ["{symbol}", 0] }}'
    source = with_table(source, ("links", name), [points])
    new = {point: place for point, place, fresh in ((first, start, first_new), (second, end, second_new)) if fresh}
    return sketched(sheet.again(source, new), new)


def _written_place(sheet: Sheet, link: Link, point: str, u: float, v: float) -> tuple[Source, str]:
    """(text with the dimensions, what is written): the place by a distance and an angle, or on the axis by a distance."""
    source, number, names = sheet.source, link.number, list(link.points)
    index = len(names) - 1
    if index >= len(FURTHER) or not names or math.hypot(u, v) == 0:
        return source, f"[{rounded(u, sheet.digits)}, {rounded(v, sheet.digits)}]"
    letter, greek = FURTHER[index]
    radius = free_symbol(sheet.parts, f"{letter}{number}")
    source = with_length(source, radius, rounded(math.hypot(u, v), sheet.digits), f"{names[0]}{point}")
    if u > 0 and abs(v) < ALIGNED * u:
        return source, f'["{radius}", 0]'
    angle, corner = free_symbol(sheet.parts, f"{greek}{number}"), "".join([*names[1:2], names[0], point])
    source = with_length(source, angle, rounded(math.degrees(math.atan2(v, u)), 2), corner, ', unit = "deg"')
    return source, f'{{ r = "{radius}", angle = "{angle}" }}'


def plate(sheet: Sheet, name: str, end: Any) -> Sheet:
    """A further point of a link; a point that is there is joined to it."""
    link = sheet.parts.link(name)
    if link is None:
        raise Refusal(f'there is no link "{name}"')
    if link is sheet.ground:
        return ground_pin(sheet, end)
    point, place, new = end_of(sheet, end)
    if point in link.points:
        raise Impossible("on_link_already", point=point)
    if any(joint.point == point and joint.on == name for joint in sheet.parts.joints):
        raise Impossible("slides_on_it", point=point)
    u, v = in_frame(place, sheet.drawn.poses.get(name, Pose()))
    source, written = _written_place(sheet, link, point, u, v)
    fresh = {point: place} if new else {}
    return sketched(sheet.again(_with_point(source, name, point, written), fresh), fresh)


def rename(sheet: Sheet, kind: Renamed, old: str, new: str) -> Sheet:
    """The sheet with another name for a point or a link, everywhere in its text. Raises Impossible for one that is taken."""
    new = new.strip()
    if kind == "point":
        taken = {point for link in sheet.parts.links for point in link.points}
        fault = symbol_fault(new)
    else:
        taken = {link.name for link in sheet.parts.links}
        sound = new[:1].isalpha() and all(sign.isalnum() or sign in "_-" for sign in new)
        fault = "" if sound else "-"
    if old not in taken:
        raise Refusal(f'there is no {kind} "{old}"')
    if new == old:
        return sheet
    if fault:
        raise Impossible(f"{kind}_name", name=new)
    if any(folded(new) == folded(name) for name in taken if name != old):
        raise Impossible("there_already", name=new)
    source = renamed(sheet.source, kind, old, new)
    places = {new if point == old and kind == "point" else point: at for point, at in sheet.drawn.places.items()}
    return replace(sheet.again(source, {}), drawn=replace(sheet.drawn, places=places))

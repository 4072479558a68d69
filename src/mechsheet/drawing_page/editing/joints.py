"""Sliding joints, gear wheels and racks: what slides along what, what turns what, and in which ratio."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from mechsheet.description.text.index import key_text
from mechsheet.description.text.rewrite import with_table
from mechsheet.drawing_page.editing.links import link, new_pin
from mechsheet.drawing_page.editing.shaping import size_of
from mechsheet.drawing_page.editing.sheet import (
    Sheet,
    end_of,
    free_link,
    free_symbol,
    in_frame,
    line,
    noted,
    quoted_key,
    rounded,
    sketched,
    with_length,
)
from mechsheet.drawing_page.positions import Point, Pose, local_points
from mechsheet.drawing_page.questions import Impossible, Refusal, end, point_in, table, text_in
from mechsheet.drawing_page.reading import number_in_unit
from mechsheet.model import Link


def slide(sheet: Sheet, kind: str, end: Any, on: Any) -> Sheet:
    """A pin that slides: with a block that keeps its direction ("prismatic"), or alone in a slot ("pin-slot").

    on  {"link": …}: along that link; {"point": …}: along a line through that point, about which a new link turns, or through
        which a fixed line leads; {"at": …}: along a fixed line in that direction
    """
    if kind not in ("prismatic", "pin-slot"):
        raise Refusal(f'no sliding joint is called "{kind}"')
    guided = table(on, '"on" is a table')
    point, place, new = end_of(sheet, end)
    fresh = {point: place} if new else {}
    if fresh and "link" not in guided and kind == "pin-slot":
        raise Impossible("pin_first")
    sheet = sheet.with_places(fresh)
    if "link" in guided:
        guide = _along_link(sheet, text_in(guided, "link"), point)
    elif "point" in guided:
        guide = _through_pin(sheet, text_in(guided, "point"), point, place)
    else:
        guide = _fixed_line(sheet, place, point_in(guided, "at"), point)
    return _with_joint(guide, kind, point, fresh)


@dataclass(frozen=True, slots=True)
class _Guide:
    """A line on a link: the sheet with its dimensions, the link, and what is written of the line."""

    sheet: Sheet
    on: str
    lines: tuple[str, ...]


def _along_link(sheet: Sheet, name: str, point: str) -> _Guide:
    """The line from a link's first point to its second."""
    link = sheet.moving(name, "moving_link")
    if point in link.points:
        raise Impossible("pinned_there", point=point)
    own = local_points(link, sheet.parts.numbers)
    first, *others = link.points
    lines = [f'through = "{first}"']
    if others:
        (x, y), (u, v) = own[first], own[others[0]]
        angle = math.degrees(math.atan2(v - y, u - x))
        if abs(angle) > 1e-4:
            lines.append(f"angle = {_angle(sheet, angle)}")
    return _Guide(sheet, name, tuple(lines))


def _angle(sheet: Sheet, degrees: float) -> str:
    """An angle in the unit of the file's plain numbers."""
    unit = sheet.parts.angle_unit
    return rounded(unit.to_shown(math.radians(degrees)), 3 if unit.in_degrees else 6)


def _through_pin(sheet: Sheet, pin: str, point: str, place: Point) -> _Guide:
    """A line through a pin and the point: on the link that has the pin, on a new link about a pin of the ground."""
    if pin not in sheet.drawn.places or pin == point:
        raise Impossible("another_place")
    owners = [link for link in sheet.parts.links_at(pin) if link is not sheet.ground and point not in link.points]
    if owners:
        return _on_owner(sheet, owners[0], pin, place)
    name, _ = free_link(sheet.parts, sheet.link_stem)
    source = with_table(sheet.source, ("links", name), [f"points = {{ {key_text(pin)} = [0, 0] }}"])
    return _Guide(sheet.again(source, {}), name, (f'through = "{pin}"',))


def _on_owner(sheet: Sheet, owner: Link, pin: str, place: Point) -> _Guide:
    """The line from a pin of a link to the point, as it is drawn."""
    u, v = in_frame(place, sheet.drawn.poses.get(owner.name, Pose()))
    x, y = local_points(owner, sheet.parts.numbers)[pin]
    angle = math.degrees(math.atan2(v - y, u - x))
    lines = [f'through = "{pin}"'] + ([f"angle = {_angle(sheet, angle)}"] if abs(angle) > 1e-3 else [])
    return _Guide(sheet, owner.name, tuple(lines))


def _fixed_line(sheet: Sheet, place: Point, towards: Point, point: str) -> _Guide:
    """A fixed line through the point: its distance from the origin is a dimension, and its direction if it is askew."""
    dx, dy = towards[0] - place[0], towards[1] - place[1]
    if math.hypot(dx, dy) <= 10.0**-sheet.digits:
        raise Impossible("direction")
    angle = math.degrees(math.atan2(dy, dx))
    for straight in (-180, -90, 0, 90, 180):
        angle = float(straight) if abs(angle - straight) < 2 else angle
    source = sheet.source
    x, y = (rounded(part, sheet.digits) for part in place)
    upright = abs(angle) == 90
    if angle in (0, 180, 90, -90):
        value, symbol = (
            (x, free_symbol(sheet.parts, f"x_{point}")) if upright else (y, free_symbol(sheet.parts, f"y_{point}"))
        )
        if float(value) == 0:
            lines = ["through = [0, 0]"]
        else:
            source = with_length(source, symbol, value, f"guide of {point}")
            lines = [f'through = ["{symbol}", 0]' if upright else f'through = [0, "{symbol}"]']
        if angle:
            lines.append(f"angle = {_angle(sheet, angle)}")
    else:
        turn, along = free_symbol(sheet.parts, f"beta_{point}"), free_symbol(sheet.parts, f"y_{point}")
        crossing = place[1] - math.tan(math.radians(angle)) * place[0]
        source = with_length(source, along, rounded(crossing, sheet.digits), f"guide of {point}")
        degrees = f'{rounded(angle, 2)}, unit = "deg"'
        source = with_length(source, turn, degrees, f"direction of the guide of {point}")
        lines = [f'through = [0, "{along}"]', f'angle = "{turn}"']
    return _Guide(sheet.again(source, {}), sheet.ground.name, tuple(lines))


def _with_joint(guide: _Guide, kind: str, point: str, fresh: Mapping[str, Point]) -> Sheet:
    sheet = guide.sheet
    source = sheet.source
    lines = [f'type = "{kind}"']
    on = sheet.parts.link(guide.on)
    if kind == "prismatic" or (fresh and not sheet.parts.links_at(point)):
        name, number = free_link(sheet.parts, sheet.link_stem)
        source = with_table(source, ("links", name), [f"points = {{ {key_text(point)} = [0, 0] }}"])
        lines.append(f'link = "{name}"')
    else:
        number = next((link.number for link in sheet.parts.links_at(point)), 1)
    lines += [f'on = "{guide.on}"', f'point = "{point}"', *guide.lines]
    base = on.number if on is not None else 1
    wanted = f"s{base}{number}" if max(base, number) < 10 else f"s{base}_{number}"
    lines.append(f'symbol = "{free_symbol(sheet.parts, wanted)}"')
    source = with_table(source, ("joints", len(sheet.parts.orders)), lines)
    return sketched(sheet.again(source, fresh), fresh)


RIM = 0.12
"""Radius at which a new wheel has the point that shows its turn, of the drawing's size."""

EXPRESSION = re.compile(r"[\w.+\-*/^() ]+")


def gear(sheet: Sheet, driving: str, driven: Any, size: str) -> Sheet:
    """A wheel that a link turns.

    driven  {"link": …}: that link is the wheel; {"at": …}: a new wheel about a new pin of the ground; {"joint": …}: the
          sliding joint of a rack
    size  the ratio of the angles, negative where the wheels turn against each other: "-z2/z3"; of a rack the pinion's radius
    """
    wheel = sheet.moving(driving, "gear_pivot")
    given = end(driven)
    if "joint" in given:
        joint = text_in(given, "joint")
        if joint not in sheet.parts.orders:
            raise Refusal(f'there is no sliding joint "{joint}"')
        radius = number_in_unit(sheet.source, size, sheet.parts.length_unit)
        return sheet.with_entry(
            "joints",
            [
                line(sheet, "type", '"rack"'),
                line(sheet, "joint", quoted_key(joint)),
                f"link = {noted(sheet, quoted_key(driving), 'pinion')}",
                line(sheet, "radius", radius),
            ],
        )
    if "at" in given:
        sheet, other = _new_wheel(sheet, given)
    else:
        other = text_in(given, "link")
    arm = _arm(sheet, wheel, sheet.moving(other, "gear_pivot"))
    ratio = size.strip().replace(",", ".")
    if not EXPRESSION.fullmatch(ratio):
        raise Impossible("ratio")
    lines = [
        line(sheet, "type", '"gear"'),
        f"link = {noted(sheet, quoted_key(other), 'gear')}",
        line(sheet, "on", quoted_key(driving)),
        line(sheet, "ratio", f'"{ratio}"'),
    ]
    if arm is not sheet.ground:
        lines.insert(3, line(sheet, "arm", quoted_key(arm.name)))
    return sheet.with_entry("joints", lines)


def _arm(sheet: Sheet, first: Link, second: Link) -> Link:
    """The link that carries both axes: it shares a pivot with each; the ground where it does."""
    if first is second:
        raise Impossible("gear_pivot")
    others = [each for each in sheet.parts.links if each not in (first, second)]
    arms = [each for each in others if all(set(each.points) & set(wheel.points) for wheel in (first, second))]
    if not arms:
        raise Impossible("gear_pivot")
    return arms[0]


def _new_wheel(sheet: Sheet, place: dict[str, Any]) -> tuple[Sheet, str]:
    """A link that turns about a new pin of the ground, and its name."""
    x, y = point_in(place, "at")
    radius = float(rounded(RIM * size_of(sheet.drawn.places), max(0, sheet.digits - 2))) or 1.0
    sheet, pin = new_pin(sheet, place)
    known = {each.name for each in sheet.parts.links}
    sheet = link(sheet, [{"point": pin}, {"at": [x, y + radius]}])
    return sheet, next(each.name for each in sheet.parts.links if each.name not in known)

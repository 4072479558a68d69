"""Gear wheels and racks, by the mouse: what turns what, and in which ratio."""

from __future__ import annotations

import re
from typing import Any

from mechsheet.description.text.rewrite import with_table
from mechsheet.drawing_page.cells import number_in_unit
from mechsheet.drawing_page.editing.links import ground_pin, link
from mechsheet.drawing_page.editing.remarks import line, noted, quoted_key
from mechsheet.drawing_page.editing.shaping import size_of
from mechsheet.drawing_page.editing.sheet import Sheet, rounded
from mechsheet.drawing_page.questions import Impossible, Refusal, point_in, text_in
from mechsheet.model import Link

RIM = 0.12
"""Radius at which a new wheel has the point that shows its turn, of the drawing's size."""

EXPRESSION = re.compile(r"[\w.+\-*/^() ]+")


def gear(sheet: Sheet, driving: str, end: Any, size: str) -> Sheet:
    """A wheel that a link turns.

    end   {"link": …}: that link is the wheel; {"at": …}: a new wheel about a new pin of the ground; {"joint": …}: the
          sliding joint of a rack
    size  the ratio of the angles, negative where the wheels turn against each other: "-z2/z3"; of a rack the pinion's radius
    """
    wheel = _moving(sheet, driving)
    if not isinstance(end, dict):
        raise Refusal("an end is a table")
    if "joint" in end:
        joint = text_in(end, "joint")
        if joint not in sheet.parts.orders:
            raise Refusal(f'there is no sliding joint "{joint}"')
        radius = number_in_unit(sheet.source, size, sheet.parts.length_unit)
        return _with_joint(
            sheet,
            [
                line(sheet, "type", '"rack"'),
                line(sheet, "joint", quoted_key(joint)),
                f"link = {noted(sheet, quoted_key(driving), 'pinion')}",
                line(sheet, "radius", radius),
            ],
        )
    other = ""
    if "at" in end:
        sheet, other = _new_wheel(sheet, end)
    else:
        other = text_in(end, "link")
    arm = _arm(sheet, wheel, _moving(sheet, other))
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
    return _with_joint(sheet, lines)


def _moving(sheet: Sheet, name: str) -> Link:
    found = sheet.parts.link(name)
    if found is None or found is sheet.ground:
        raise Impossible("gear_pivot")
    return found


def _arm(sheet: Sheet, first: Link, second: Link) -> Link:
    """The link that carries both axes: it shares a pivot with each; the ground where it does."""
    if first is second:
        raise Impossible("gear_pivot")
    others = [each for each in sheet.parts.links if each not in (first, second)]
    arms = [each for each in others if all(set(each.points) & set(wheel.points) for wheel in (first, second))]
    if not arms:
        raise Impossible("gear_pivot")
    return arms[0]


def _new_wheel(sheet: Sheet, end: dict[str, Any]) -> tuple[Sheet, str]:
    """A link that turns about a new pin of the ground, and its name."""
    x, y = point_in(end, "at")
    radius = float(rounded(RIM * size_of(sheet.drawn.places), max(0, sheet.digits - 2))) or 1.0
    before = sheet.drawn.places
    sheet = ground_pin(sheet, end)
    pin = next(point for point in sheet.drawn.places if point not in before)
    known = {each.name for each in sheet.parts.links}
    sheet = link(sheet, [{"point": pin}, {"at": [x, y + radius]}])
    return sheet, next(each.name for each in sheet.parts.links if each.name not in known)


def _with_joint(sheet: Sheet, lines: list[str]) -> Sheet:
    joints = sheet.source.data.get("joints")
    number = len(joints) if isinstance(joints, list) else 0
    return sheet.again(with_table(sheet.source, ("joints", number), lines), {})

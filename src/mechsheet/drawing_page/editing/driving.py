"""What is driven, over which values, and by which motion law: the table [driver]."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

from mechsheet.description.text.rewrite import number_text, with_last_key, with_table, with_value, without_key
from mechsheet.description.text.source import Source
from mechsheet.drawing_page.editing.shaping import size_of, slid
from mechsheet.drawing_page.editing.sheet import Sheet, noted, rounded
from mechsheet.drawing_page.positions import Pose
from mechsheet.drawing_page.questions import Impossible, Refusal
from mechsheet.model import Link

SWEEPS = {True: ("0", "360", "15"), False: ("0", "2*pi", "pi/12")}
STROKE = 0.4
"""A driven slide goes this part of the drawing's size to and fro at first."""


def drive(sheet: Sheet, link_name: str, joint_name: str) -> Sheet:
    """What is driven: a link, against the ground or the link on which it is pivoted; or a sliding joint."""
    lines: dict[str, str]
    unit = sheet.parts.angle_unit
    if joint_name:
        joint = next((joint for joint in sheet.parts.joints if joint.name == joint_name), None)
        if joint is None:
            raise Refusal(f'there is no sliding joint "{joint_name}"')
        here = slid(sheet.parts, joint.name, sheet.drawn) or 0.0
        reach = round(STROKE * size_of(sheet.drawn.places), max(0, sheet.digits - 2)) or 1.0
        ends = (here - reach / 2, here + reach / 2, reach / 20)
        start, stop, step = (rounded(value, sheet.digits) for value in ends)
        lines = {"joint": f'"{joint.name}"', "start": start, "stop": stop, "step": step}
        at = here
    else:
        found = sheet.moving(link_name, "drive_moving")
        base = _pivoted_on(sheet, found)
        start, stop, step = SWEEPS[unit.in_degrees]
        if not unit.in_degrees:
            stop, step = f'"{stop}"', f'"{step}"'
        lines = {"link": f'"{found.name}"', "start": start, "stop": stop, "step": step}
        if base is not sheet.ground:
            lines["relative_to"] = f'"{base.name}"'
        turn = sheet.drawn.poses.get(found.name, Pose()).turn - sheet.drawn.poses.get(base.name, Pose()).turn
        at = unit.to_shown(turn % math.tau)
    if _one_more(sheet, link_name, joint_name):
        return _with_further(sheet, lines, at)
    source = _with_driver(sheet, lines)
    at = round(at, 2 if unit.in_degrees or joint_name else 5) + 0.0
    source = with_value(source, ("assembly", "at"), number_text(at))
    return replace(sheet, source=source, drawn=replace(sheet.drawn, at=at))


def _one_more(sheet: Sheet, link: str, joint: str) -> bool:
    """Whether a second link or joint is to be driven beside the first: there is a freedom left for it."""
    driver, further = sheet.parts.driver, sheet.source.data.get("drivers", [])
    if driver is None or sheet.mobility is None or (driver.link, driver.joint) == (link, joint):
        return False
    return sheet.mobility > 1 + len(further)


def _with_further(sheet: Sheet, lines: Mapping[str, str], at: float) -> Sheet:
    """A further driver, which stays where it is drawn until its cell is turned by hand."""
    kept = [f"{key} = {value}" for key, value in lines.items() if key not in ("start", "stop", "step")]
    written = [*kept, f"value = {number_text(round(at, sheet.digits) + 0.0)}"]
    return sheet.with_entry("drivers", written)


def _pivoted_on(sheet: Sheet, link: Link) -> Link:
    """The link against which another one turns: the ground where they share a point, else the first that shares one."""
    others = [other for other in sheet.parts.links if other is not link and set(other.points) & set(link.points)]
    if not others:
        raise Impossible("join_first")
    return sheet.ground if sheet.ground in others else others[0]


def _with_driver(sheet: Sheet, lines: Mapping[str, str]) -> Source:
    """The driver's table; where there is one, what is driven alone changes, and the sweep where it does not fit any more."""
    source, old = sheet.source, sheet.parts.driver
    if ("driver",) not in source.spots:
        return with_table(source, ("driver",), [f"{key} = {value}" for key, value in lines.items()])
    for key in ("link", "joint", "relative_to", "symbol"):
        if key not in lines:
            source = without_key(source, ("driver", key))
    same_kind = old is not None and bool(old.joint) == ("joint" in lines) and "joint" not in lines
    for key, value in lines.items():
        if key not in ("start", "stop", "step") or not same_kind or ("driver", key) not in source.spots:
            if key in ("start", "stop", "step") and ("driver", "values") in source.spots:
                source = without_key(source, ("driver", "values"))
            source = with_value(source, ("driver", key), value)
    return source


def with_motion(sheet: Sheet) -> Sheet:
    """The driver with a motion law, ready and with a remark behind it; its numbers are there to be changed."""
    if "values" in _driver_table(sheet, "motion"):
        raise Impossible("listed")
    source = sheet.source
    for key in ("step", "speed", "acceleration"):  # the law says all of them
        source = without_key(source, ("driver", key))
    law = noted(sheet, '{ law = "cycloidal", duration = 2 }', "motion")
    return sheet.again(with_last_key(source, ("driver",), "motion", law), {})


def _driver_table(sheet: Sheet, *taken: str) -> Mapping[str, object]:
    """What is written of the driver; none of the keys `taken` may be there."""
    driver = sheet.source.data.get("driver")
    spot = sheet.source.spots.get(("driver",))
    if not isinstance(driver, dict) or spot is None or spot.how != "header":
        raise Impossible("drive_first")
    for key in taken:
        if key in driver:
            raise Impossible("there_already", name=f"[driver] {key}")
    return driver

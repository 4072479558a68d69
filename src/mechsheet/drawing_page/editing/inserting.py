"""What is not drawn but written: a motion law, masses for all links; each ready, with a remark behind it.

The names in it are those of the drawing, so what is written works at once, and its numbers are there to be changed.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from mechsheet.description.text.rewrite import with_last_key, without_key
from mechsheet.drawing_page.editing.remarks import noted
from mechsheet.drawing_page.editing.sheet import Sheet
from mechsheet.drawing_page.editing.weighing import weigh, without_mass
from mechsheet.drawing_page.questions import Impossible, Refusal


def insert(sheet: Sheet, what: str) -> Sheet:
    """The sheet with something more in its text. Raises Impossible where the drawing has nothing that it could belong to."""
    if what not in KINDS:
        raise Refusal(f'nothing that can be inserted is called "{what}"')
    return KINDS[what](sheet)


# --- the driver's motion ---------------------------------------------------------------------------------------------


def _motion(sheet: Sheet) -> Sheet:
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


# --- masses ----------------------------------------------------------------------------------------------------------


def _masses(sheet: Sheet) -> Sheet:
    """A mass for every moving link that has none, each of them a bar."""
    before = sheet.source
    for moving in sheet.parts.links[1:]:
        if without_mass(sheet, moving.name):
            sheet = weigh(sheet, moving.name, "1", "bar" if len(moving.points) > 1 else "point")
    if sheet.source is before:
        raise Impossible("there_already", name="mass")
    return sheet


KINDS: dict[str, Callable[[Sheet], Sheet]] = {
    "motion": _motion,
    "masses": _masses,
}
"""What can be inserted, in the order of the page's menu."""

"""The orders that the page gives: one table each, `do` says which."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from mechsheet.drawing_page.editing.acting import between, force, torque
from mechsheet.drawing_page.editing.driving import drive, with_motion
from mechsheet.drawing_page.editing.joints import gear, slide
from mechsheet.drawing_page.editing.links import ground_pin, link, plate, rename
from mechsheet.drawing_page.editing.removing import without
from mechsheet.drawing_page.editing.shaping import Edited, drawn_now, moved, typed, with_sketched
from mechsheet.drawing_page.editing.sheet import Sheet
from mechsheet.drawing_page.editing.weighing import weigh, weigh_all
from mechsheet.drawing_page.positions import Point
from mechsheet.drawing_page.questions import Impossible, Refusal, point_in, text_in
from mechsheet.drawing_page.reading import Reading, read, typed_in_cell
from mechsheet.words.catalogue import Language
from mechsheet.words.catalogue import text_in as said_in


def edited(
    reading: Reading, order: dict[str, Any], at: float | None, held: Mapping[str, Point], language: Language
) -> Edited:
    """The text after an order, and the driver value that it shows.

    at    the driver value that the page shows;  held: where it shows the points;  language: of the names of new links
    Raises Refusal for an order that is not understood, MechsheetError for one that cannot be carried out.
    """
    do = text_in(order, "do")
    if do not in _ORDERS:
        raise Refusal(f'no order is called "{do}"')
    return _ORDERS[do](_Shown(reading, at, held, language), order)


@dataclass(frozen=True, slots=True)
class _Shown:
    """What the page shows: the arguments of `edited` but for the order."""

    reading: Reading
    at: float | None
    held: Mapping[str, Point]
    language: Language


Order = Callable[[_Shown, dict[str, Any]], Edited]


def _move(shown: _Shown, order: dict[str, Any]) -> Edited:
    return moved(shown.reading, text_in(order, "point"), point_in(order, "to"), shown.at, shown.held)


def _typing(write: Callable[[Reading, str, str], str]) -> Order:
    """An order that puts what was typed into the place of a number."""

    def order(shown: _Shown, typed: dict[str, Any]) -> Edited:
        return write(shown.reading, text_in(typed, "name"), text_in(typed, "value")), shown.at

    return order


def _drawn(draw: Callable[[Sheet, dict[str, Any]], Sheet]) -> Order:
    """An order that draws something new, or takes it away: on the sheet as it is shown."""

    def order(shown: _Shown, what: dict[str, Any]) -> Edited:
        reading = shown.reading
        if reading.source is None or reading.parts is None:
            raise Impossible("unreadable")
        drawn = drawn_now(reading, shown.at, shown.held)
        sheet = draw(Sheet(reading.source, reading.parts, drawn, shown.language, reading.mobility), what)
        return settled(reading, sheet), sheet.drawn.at

    return order


def _rename(sheet: Sheet, order: dict[str, Any]) -> Sheet:
    to = text_in(order, "to")
    if "point" in order:
        return rename(sheet, "point", text_in(order, "point"), to)
    return rename(sheet, "link", text_in(order, "link"), to)


def _delete(sheet: Sheet, order: dict[str, Any]) -> Sheet:
    kind = next((key for key in ("link", "point", "joint", "load", "mass") if key in order), "")
    return sheet.again(without(sheet.source, kind, text_in(order, kind)), {})


def _insert(sheet: Sheet, order: dict[str, Any]) -> Sheet:
    """What is not drawn but written, a motion law, masses for all links: each ready, with the names of the drawing."""
    what = text_in(order, "what")
    if what not in INSERTED:
        raise Refusal(f'nothing that can be inserted is called "{what}"')
    return INSERTED[what](sheet)


INSERTED: dict[str, Callable[[Sheet], Sheet]] = {"motion": with_motion, "masses": weigh_all}
"""In the order of the page's menu."""


def _fitting(draw: Callable[[Sheet, dict[str, Any]], Sheet]) -> Order:
    """An order after which a mechanism that moves still does: what does not fit it is refused, with why."""

    def order(shown: _Shown, what: dict[str, Any]) -> Edited:
        text, at = _drawn(draw)(shown, what)
        reading = shown.reading
        if reading.compiled is not None:
            found = read(text, reading.source.file if reading.source else "")
            if found.compiled is None:
                raise Impossible("does_not_fit", reason=said_in(found.faults[0].message, shown.language))
        return text, at

    return order


def settled(reading: Reading, sheet: Sheet) -> str:
    """The text with every point in its sketch that would be lost: without a driver nothing else says where they are."""
    source = sheet.source
    fixed = sheet.parts.links[0].points if sheet.parts.links else {}
    found = read(source.text, source.file)
    if found.compiled is not None:
        return source.text
    for point, place in sheet.drawn.places.items():
        if point not in fixed and sheet.parts.links_at(point) and ("assembly", point) not in source.spots:
            source = with_sketched(source, point, place, sheet.digits)
    if reading.compiled is not None:  # it was one and is none any more: as it was shown, not as it was sketched
        for point in sheet.parts.sketch.points:
            if point in sheet.drawn.places and point not in fixed:
                source = with_sketched(source, point, sheet.drawn.places[point], sheet.digits)
    return source.text


_ORDERS: dict[str, Order] = {
    "move": _move,
    "dimension": _typing(typed),
    "ground": _drawn(lambda sheet, order: ground_pin(sheet, order.get("end"))),
    "link": _drawn(lambda sheet, order: link(sheet, order.get("ends"))),
    "plate": _drawn(lambda sheet, order: plate(sheet, text_in(order, "link"), order.get("end"))),
    "slide": _drawn(lambda sheet, order: slide(sheet, text_in(order, "kind"), order.get("end"), order.get("on"))),
    "driver": _drawn(lambda sheet, order: drive(sheet, text_in(order, "link", ""), text_in(order, "joint", ""))),
    "delete": _drawn(_delete),
    "rename": _fitting(_rename),
    "force": _fitting(
        lambda sheet, order: force(sheet, order.get("end"), point_in(order, "to"), text_in(order, "size"))
    ),
    "torque": _fitting(lambda sheet, order: torque(sheet, text_in(order, "link"), text_in(order, "size"))),
    "spring": _fitting(lambda sheet, order: between(sheet, "stiffness", order.get("ends"), text_in(order, "size"))),
    "damper": _fitting(lambda sheet, order: between(sheet, "damping", order.get("ends"), text_in(order, "size"))),
    "mass": _fitting(
        lambda sheet, order: weigh(sheet, text_in(order, "link"), text_in(order, "size"), text_in(order, "shape"))
    ),
    "cell": _typing(typed_in_cell),
    "gear": _fitting(lambda sheet, order: gear(sheet, text_in(order, "on"), order.get("end"), text_in(order, "size"))),
    "insert": _fitting(_insert),
}

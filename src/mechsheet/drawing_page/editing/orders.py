"""The orders that the page gives: one table each, `do` says which."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

from mechsheet.drawing_page.editing.shaping import Edited, moved, typed
from mechsheet.drawing_page.positions import Point
from mechsheet.drawing_page.questions import Refusal, point_in, text_in
from mechsheet.drawing_page.reading import Reading


def edited(reading: Reading, order: dict[str, Any], at: float | None, held: Mapping[str, Point]) -> Edited:
    """The text after an order, and the driver value that it shows.

    at    the driver value that the page shows;  held: where it shows the points
    Raises Refusal for an order that is not understood, MechsheetError for one that cannot be carried out.
    """
    do = text_in(order, "do")
    if do not in _ORDERS:
        raise Refusal(f'no order is called "{do}"')
    return _ORDERS[do](reading, order, at, held)


Order = Callable[[Reading, dict[str, Any], float | None, Mapping[str, Point]], Edited]


def _move(reading: Reading, order: dict[str, Any], at: float | None, held: Mapping[str, Point]) -> Edited:
    return moved(reading, text_in(order, "point"), point_in(order, "to"), at, held)


def _dimension(reading: Reading, order: dict[str, Any], at: float | None, _: Mapping[str, Point]) -> Edited:
    return typed(reading, text_in(order, "name"), text_in(order, "value")), at


_ORDERS: dict[str, Order] = {
    "move": _move,
    "dimension": _dimension,
}

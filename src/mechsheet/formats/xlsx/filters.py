"""Which hidden rows of an .xlsx a filter hides: SUBTOTAL leaves those out always, the others only if it is asked to."""

from __future__ import annotations

from collections.abc import Iterable

from mechsheet.formula.book import BookSheet
from mechsheet.formula.references import parse_cell


def give_filters(sheet: BookSheet, areas: Iterable[str]) -> None:
    """Note the hidden rows below the first one of each area ("A1:C9") with a filter that filters."""
    below: list[tuple[int, int]] = []
    for area in dict.fromkeys(areas):
        first, _, last = area.partition(":")
        corners = parse_cell(first), parse_cell(last or first)
        if corners[0] is not None and corners[1] is not None:
            below.append((corners[0][0] + 1, corners[1][0] + 1))
    sheet.hidden.sort()
    found = {
        (max(top, first), min(bottom, end))
        for top, bottom in below
        for first, end in sheet.hidden
        if max(top, first) < min(bottom, end)
    }
    sheet.filtered = sorted(found)

"""What rows that were matched hold, put into the sheet column by column."""

from __future__ import annotations

from array import array
from collections.abc import Callable, Sequence

from mechsheet.formula.book import BookSheet
from mechsheet.formula.nodes import Scalar


def give_numbers(sheet: BookSheet, row: int, col: int, formula: bool, texts: Sequence[bytes]) -> None:
    """Numbers of the cells from (row, col) down, known to be finite; `formula`: as values stored for a formula."""
    if formula:
        sheet.cached.later(row, col, b" ".join(texts))
    else:
        sheet.constants.extend(row, col, array("d", map(float, texts)))


def give_values(
    sheet: BookSheet, row: int, col: int, formula: bool, texts: Sequence[bytes], value: Callable[[bytes, int], Scalar]
) -> None:
    """The same for other kinds of values: `value` says what a text in a row means, the same for the same text."""
    store = sheet.cached if formula else sheet.constants
    known: dict[bytes, Scalar] = {}
    for down, text in enumerate(texts, row):
        found = known.get(text)
        if found is None:
            found = value(text, down)
            if found is None:
                continue
            known[text] = found
        store.put(down, col, found)

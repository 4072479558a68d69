"""A1 text and the rows and columns it means. Rows and columns count from 0 inside; only text says A1."""

from __future__ import annotations

import re
from functools import cache

from .nodes import MAX_COLUMNS, MAX_ROWS, CellRef, RangeRef

CELL = re.compile(r"(\$?)([A-Za-z]{1,3})(\$?)([1-9][0-9]{0,6})")
COLUMN = re.compile(r"(\$?)([A-Za-z]{1,3})")
ROW = re.compile(r"(\$?)([1-9][0-9]{0,6})")


@cache
def column_letters(col: int) -> str:
    """0 -> A, 25 -> Z, 26 -> AA, 16383 -> XFD."""
    letters = ""
    col += 1
    while col:
        col, digit = divmod(col - 1, 26)
        letters = chr(65 + digit) + letters
    return letters


@cache
def column_index(letters: str) -> int:
    """A -> 0, XFD -> 16383; any number for longer ones (the caller checks the limit)."""
    index = 0
    for letter in letters.upper():
        index = index * 26 + ord(letter) - 64
    return index - 1


def cell_name(row: int, col: int) -> str:
    """(8, 2) -> C9."""
    return f"{column_letters(col)}{row + 1}"


def cell_address(sheet: str, row: int, col: int) -> str:
    """A place as messages name it: Positions!C9."""
    return f"{sheet}!{cell_name(row, col)}"


def area_name(row: int, col: int, rows: int, cols: int) -> str:
    """The rectangle as messages name it: C9, or C9:C369."""
    first = cell_name(row, col)
    return first if rows == cols == 1 else f"{first}:{cell_name(row + rows - 1, col + cols - 1)}"


def parse_cell(text: str) -> tuple[int, int] | None:
    """`C9` or `$C$9` -> (8, 2); None when it is not a cell of a sheet."""
    ref = parse_reference(text)
    return None if ref is None else (ref.row, ref.col)


def parse_area(text: str) -> tuple[int, int, int, int] | None:
    """`B2:C9` or `B2` -> (1, 1, 8, 2), the first and the last cell; None when one of them is no cell of a sheet."""
    first, _, last = text.partition(":")
    start, end = parse_cell(first), parse_cell(last or first)
    return None if start is None or end is None else (*start, *end)


def absolute_name(row: int, col: int) -> str:
    """(8, 2) -> $C$9."""
    return f"${column_letters(col)}${row + 1}"


def parse_reference(text: str, sheet: str | None = None) -> CellRef | None:
    """`$C9` or `Sheet1!C9` -> the reference with its anchors; None when it is not a cell of a sheet."""
    before, mark, cell = text.rpartition("!")
    if mark:
        quoted = len(before) > 1 and before.startswith("'") and before.endswith("'")
        text, sheet = cell, before[1:-1].replace("''", "'") if quoted else before
    match = CELL.fullmatch(text)
    if match is None:
        return None
    col_abs, letters, row_abs, digits = match.groups()
    row, col = int(digits) - 1, column_index(letters.upper())
    if row >= MAX_ROWS or col >= MAX_COLUMNS:
        return None
    return CellRef(row, col, bool(row_abs), bool(col_abs), sheet)


def parse_r1c1(text: str, row: int, col: int) -> CellRef | RangeRef | None:
    """`R2C3`, `RC[-1]`, `R1C1:R9C2`, `R3` or `C2`, as seen from (row, col), with or without a sheet, else None."""
    before, mark, area = text.strip().rpartition("!")
    sheet = None
    if mark:
        quoted = len(before) > 1 and before.startswith("'") and before.endswith("'")
        sheet = before[1:-1].replace("''", "'") if quoted else before
    first, colon, last = area.partition(":")
    corners = [_corner(part.strip(), row, col) for part in ((first, last) if colon else (first,))]
    rows = [place for corner in corners if corner is not None for place in corner[0]]
    cols = [place for corner in corners if corner is not None for place in corner[1]]
    if None in corners or min(rows) < 0 or min(cols) < 0 or max(rows) >= MAX_ROWS or max(cols) >= MAX_COLUMNS:
        return None
    start = CellRef(min(rows), min(cols), True, True, sheet)
    end = CellRef(max(rows), max(cols), True, True, sheet)
    return start if start == end else RangeRef(start, end)


def _corner(text: str, row: int, col: int) -> tuple[tuple[int, int], tuple[int, int]] | None:
    """The first and last row, the first and last column of one side of a reference in R1C1 form."""
    match = _R1C1.fullmatch(text)
    if match is None or not text:
        return None

    def place(letter: str, here: int, most: int) -> tuple[int, int]:
        if match[letter] is None:
            return 0, most - 1
        relative, absolute = match[f"{letter}_by"], match[f"{letter}_at"]
        found = here + int(relative) if relative else int(absolute) - 1 if absolute else here
        return found, found

    return place("r", row, MAX_ROWS), place("c", col, MAX_COLUMNS)


_R1C1 = re.compile(
    r"(?P<r>R(?:\[(?P<r_by>[+-]?[0-9]{1,7})\]|(?P<r_at>[1-9][0-9]{0,6}))?)?"
    r"(?P<c>C(?:\[(?P<c_by>[+-]?[0-9]{1,7})\]|(?P<c_at>[1-9][0-9]{0,6}))?)?",
    re.IGNORECASE,
)


def reference_text(ref: CellRef) -> str:
    """The reference with its anchors and without its sheet: $C9."""
    return f"{'$' * ref.col_abs}{column_letters(ref.col)}{'$' * ref.row_abs}{ref.row + 1}"

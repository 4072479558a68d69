"""A1 text and the rows and columns it means. Rows and columns count from 0 inside; only text says A1."""

from __future__ import annotations

import re
from functools import cache

from .nodes import MAX_COLUMNS, MAX_ROWS, CellRef

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


def reference_text(ref: CellRef) -> str:
    """The reference with its anchors and without its sheet: $C9."""
    return f"{'$' * ref.col_abs}{column_letters(ref.col)}{'$' * ref.row_abs}{ref.row + 1}"

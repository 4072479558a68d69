"""What a person means by a range of a workbook: `Sheet!A1:C9`, whole columns, whole sheets, names."""

from __future__ import annotations

from dataclasses import dataclass

from livesheet.diagnostics import Fault
from livesheet.formula.book import Book, BookSheet
from livesheet.formula.nodes import MAX_COLUMNS, MAX_ROWS, CellRef, RangeRef
from livesheet.formula.references import column_index, parse_reference
from livesheet.said import say


@dataclass(frozen=True, slots=True)
class Area:
    """`rows` x `cols` cells of a sheet from (row, col) on."""

    sheet: str
    row: int
    col: int
    rows: int
    cols: int


def area_of(book: Book, text: str) -> Area | Fault:
    """The cells that `Sheet!A1:C9`, `Sheet!B2`, `Sheet!A:C`, `Sheet!2:5`, `Sheet` or a defined name (a1 for a_1) mean.

    Whole columns, rows and sheets end with the last cell in use. A Fault for what means no cells.
    """
    titles = say("sheets: {titles}", titles=", ".join(sheet.title for sheet in book.sheets))
    before, mark, cells = text.rpartition("!")
    if not mark:
        sheet = book.sheet(text.strip("'").replace("''", "'"))
        defined = book.name(text) or (book.name_like(text) if sheet is None else None)
        if defined is None:
            return (
                _used(sheet)
                if sheet is not None
                else Fault(say('"{text}" is no range, name or sheet', text=text), "", None, "", "", titles)
            )
        formula = defined.formula
        start, end = (formula.start, formula.end) if isinstance(formula, RangeRef) else (formula, formula)
        if not (isinstance(start, CellRef) and isinstance(end, CellRef) and start.sheet):
            return Fault(say('the name "{text}" stands for no cells of one sheet', text=text))
        sheet = book.sheet(start.sheet)
        return (
            Fault(say('the name "{text}" leads to no sheet', text=text), hint=titles)
            if sheet is None
            else _between(sheet, start, end)
        )
    quoted = len(before) > 1 and before.startswith("'") and before.endswith("'")
    sheet = book.sheet(before[1:-1].replace("''", "'") if quoted else before)
    if sheet is None:
        return Fault(say('no sheet is called "{name}"', name=before), hint=titles)
    first, colon, last = cells.replace("$", "").partition(":")
    one, other = _corner(first, False), _corner(last if colon else first, True)
    if one is None or other is None or (not colon and parse_reference(first) is None):
        return Fault(say('"{cells}" is no range of cells', cells=cells), hint=say("for example Sheet1!A1:C9"))
    return _between(sheet, one, other)


def _corner(text: str, last: bool) -> CellRef | None:
    """A corner of a range: a cell, or the first or last cell of a column or row."""
    if text.isascii() and text.isalpha() and column_index(text) < MAX_COLUMNS:
        return CellRef(MAX_ROWS - 1 if last else 0, column_index(text))
    if text.isascii() and text.isdecimal() and 0 < len(text) < 8 and 0 < int(text) <= MAX_ROWS:
        return CellRef(int(text) - 1, MAX_COLUMNS - 1 if last else 0)
    return parse_reference(text)


def _between(sheet: BookSheet, start: CellRef, end: CellRef) -> Area:
    top, bottom = sorted((start.row, end.row))
    left, right = sorted((start.col, end.col))
    used = _used(sheet)
    if bottom == MAX_ROWS - 1:
        bottom = max(top, used.rows - 1)
    if right == MAX_COLUMNS - 1:
        right = max(left, used.cols - 1)
    return Area(sheet.title, top, left, bottom - top + 1, right - left + 1)


def _used(sheet: BookSheet) -> Area:
    """From A1 to the last row and column that hold something."""
    columns = sheet.constants.columns
    rows = [runs[-1].end for runs in columns.values() if runs] + [block.row + block.rows for block in sheet.blocks]
    cols = [col + 1 for col in columns] + [block.col + block.cols for block in sheet.blocks]
    return Area(sheet.title, 0, 0, max(rows, default=1), max(cols, default=1))

"""The part of a workbook that follows one of its cells: all that must be computed again when that cell changes.

The drawing is a few hundred cells of a workbook that has thousands. To draw it at every position only those are computed;
everything else keeps the value that it has.
"""

from __future__ import annotations

from collections.abc import Iterator

from mechsheet.compiled.evaluation import book_of
from mechsheet.formula.book import Book
from mechsheet.formula.nodes import CellRef, NameRef, RangeRef, walk
from mechsheet.sheet.workbook import Area, Fill, Workbook

Place = tuple[str, int, int]
"""Sheet, row, column."""

Read = tuple[str, Area]


def following_book(workbook: Workbook, cell: Place) -> Book:
    """The book of a computed workbook in which only the formulas that follow from `cell` are left, values elsewhere."""
    book = book_of(workbook)
    follow = _following(workbook, cell)
    for sheet, target in zip(workbook.sheets, book.sheets, strict=True):
        target.blocks = []
        for fill in sheet.fills:
            if id(fill) in follow:
                target.block(fill.row, fill.col, fill.rows, fill.cols, fill.formula)
                continue
            for col in range(fill.cols):
                target.column_constants(fill.row, fill.col + col, fill.values[col :: fill.cols])
    return book


def _following(workbook: Workbook, cell: Place) -> set[int]:
    """Identities of the fills that read the cell, or a fill that does."""
    names = {name.name.casefold(): (name.sheet, name.row, name.col) for name in workbook.names}
    waiting = [
        (sheet.title, fill, list(_reads(sheet.title, fill, names))) for sheet in workbook.sheets for fill in sheet.fills
    ]
    changed = {cell}
    found: set[int] = set()
    while True:
        new = [(title, fill) for title, fill, reads in waiting if any(_meets(read, changed) for read in reads)]
        if not new:
            return found
        found |= {id(fill) for _, fill in new}
        waiting = [entry for entry in waiting if id(entry[1]) not in found]
        changed |= {
            (title, row, col)
            for title, fill in new
            for row in range(fill.row, fill.row + fill.rows)
            for col in range(fill.col, fill.col + fill.cols)
        }


def _meets(read: Read, changed: set[Place]) -> bool:
    title, area = read
    rows, cols = area.last_row - area.first_row + 1, area.last_col - area.first_col + 1
    if rows * cols < len(changed):
        return any(
            (title, area.first_row + down, area.first_col + right) in changed
            for down in range(rows)
            for right in range(cols)
        )
    return any(
        sheet == title and area.first_row <= row <= area.last_row and area.first_col <= col <= area.last_col
        for sheet, row, col in changed
    )


def _reads(title: str, fill: Fill, names: dict[str, Place]) -> Iterator[Read]:
    """The cells that a fill's formulas read."""
    for node in walk(fill.formula):
        match node:
            case RangeRef(start, end):
                yield start.sheet or title, _reach(start, end, fill)
            case CellRef():
                yield node.sheet or title, _reach(node, node, fill)
            case NameRef(name) if name.casefold() in names:
                sheet, row, col = names[name.casefold()]
                yield sheet, Area(row, col, row, col)


def _reach(start: CellRef, end: CellRef, fill: Fill) -> Area:
    """What the reference means in all cells of the fill together."""
    down, right = fill.rows - 1, fill.cols - 1
    return Area(
        start.row,
        start.col,
        end.row if end.row_abs else end.row + down,
        end.col if end.col_abs else end.col + right,
    )

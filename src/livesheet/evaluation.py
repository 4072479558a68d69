"""Workbook data and the engine: the adapter between them, and workbooks whose every formula has its value."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from livesheet.diagnostics import WorkbookError
from livesheet.formula.book import Book, BookBuilder
from livesheet.formula.nodes import CellRef, Scalar
from livesheet.workbook import Workbook, with_values

if TYPE_CHECKING:
    from livesheet.engine import Live


def book_of(workbook: Workbook) -> Book:
    """The workbook as the engine sees it: constants, blocks of formulas, names."""
    builder = BookBuilder()
    for sheet in workbook.sheets:
        target = builder.sheet(sheet.title)
        for cell in sheet.cells:
            if cell.content is not None:
                target.constant(cell.row, cell.col, cell.value)
        for fill in sheet.fills:
            target.block(fill.row, fill.col, fill.rows, fill.cols, fill.formula)
    for name in workbook.names:
        builder.name(name.name, CellRef(name.row, name.col, True, True, name.sheet))
    for function in workbook.functions:
        builder.name(function.name, function.formula)
    return builder.build()


def live(workbook: Workbook, often: bool = False) -> Live:
    """The workbook's values, each computed when it is asked for, the same bits on every machine.

    often  whether they will be computed again and again, with other inputs
    """
    from livesheet.engine import PORTABLE, Live, Plan

    return Live(Plan(book_of(workbook), once=not often, arithmetic=PORTABLE))


def computed(workbook: Workbook, cells: Live | None = None) -> Workbook:
    """The workbook with the value of every formula, the same bits on every machine; `cells`: as `live` gives them.

    Raises WorkbookError with the engine's remarks where a formula cannot be computed as it is meant.
    """
    values = (live(workbook) if cells is None else cells).values()
    if values.remarks:
        raise WorkbookError(values.remarks)

    def columns() -> Iterator[Sequence[Scalar]]:
        for sheet in workbook.sheets:
            for fill in sheet.fills:
                last = fill.row + fill.rows - 1
                strips = [values.column(sheet.title, fill.col + col, fill.row, last) for col in range(fill.cols)]
                yield strips[0] if len(strips) == 1 else [strip[row] for row in range(fill.rows) for strip in strips]

    return with_values(workbook, columns())

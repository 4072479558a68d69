"""A sheet cut into bands of rows in which the same fills run through, so that a writer handles a column at a time."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias

from livesheet.formula.nodes import Scalar
from livesheet.formula.references import cell_address
from livesheet.workbook import PLAIN, Area, Cell, Control, Fill, Sheet

Place: TypeAlias = tuple[int, int]
"""Row and column of a cell."""

BAND_ROWS = 1024
"""Most rows of a band: a few megabytes of text at a time."""


@dataclass(frozen=True, slots=True)
class Band:
    """Rows first..last-1. Constants only in bands of one row; `fills` run through all rows, sorted by column."""

    first: int
    last: int
    cells: tuple[Cell, ...]
    fills: tuple[Fill, ...]


def bands(sheet: Sheet, areas: Iterable[Area] = (), places: Iterable[Place] = ()) -> Iterator[Band]:
    """The sheet from top to bottom; rows without cells are left out unless they have a height of their own.

    The first row of a fill is a band of its own: the cell that carries a shared formula stands there.
    areas   rectangles that begin and end with a band, and whose rows are not left out
    places  cells that stand in a band of one row, and that are made when there is nothing in them
    """
    cells = _cells_by_row(sheet, places)
    starts: dict[int, list[Fill]] = {}
    cuts: set[int] = set()
    for fill in sheet.fills:
        starts.setdefault(fill.row, []).append(fill)
        cuts |= {fill.row, fill.row + 1, fill.row + fill.rows}
    heights = {row for row, _ in sheet.row_heights}
    for row in cells.keys() | heights | {row for row, _ in places}:
        cuts |= {row, row + 1}
    covered = [(area.first_row, area.last_row + 1) for area in areas]
    cuts |= {row for rows in covered for row in rows}
    running: list[Fill] = []
    ordered = sorted(cuts)
    for first, end in pairwise(ordered):
        running = [fill for fill in running if fill.row + fill.rows > first] + starts.get(first, [])
        in_area = any(start <= first < stop for start, stop in covered)
        if not (running or first in cells or first in heights or in_area):
            continue
        fills = tuple(sorted(running, key=lambda fill: fill.col))
        _refuse_overlap(sheet, Band(first, end, cells.get(first, ()), fills))
        for row in range(first, end, BAND_ROWS):
            yield Band(row, min(row + BAND_ROWS, end), cells.get(first, ()), fills)


def _cells_by_row(sheet: Sheet, places: Iterable[Place]) -> dict[int, tuple[Cell, ...]]:
    """Constants row by row, sorted by column, with the empty cells that merged areas and `places` need."""
    taken = {(cell.row, cell.col): cell for cell in sheet.cells}
    if len(taken) != len(sheet.cells):
        raise ValueError(f"{sheet.title}: two constants in one cell")
    styles = {(fill.row, fill.col): fill.style for fill in sheet.fills}
    for merge in sheet.merges:
        area = merge.area
        corner = taken.get((area.first_row, area.first_col))
        style = corner.style if corner else styles.get((area.first_row, area.first_col), PLAIN)
        for row, col in area.places():
            if (row, col) not in styles:
                taken.setdefault((row, col), Cell(row, col, None, style))
    for row, col in places:
        if not any(0 <= row - f.row < f.rows and 0 <= col - f.col < f.cols for f in sheet.fills):
            taken.setdefault((row, col), Cell(row, col, None))
    rows: dict[int, list[Cell]] = {}
    for cell in taken.values():
        rows.setdefault(cell.row, []).append(cell)
    return {row: tuple(sorted(cells, key=lambda cell: cell.col)) for row, cells in rows.items()}


def _refuse_overlap(sheet: Sheet, band: Band) -> None:
    taken = [cell.col for cell in band.cells]
    for fill in band.fills:
        taken += range(fill.col, fill.col + fill.cols)
    if len(set(taken)) != len(taken):
        col = next(col for col in taken if taken.count(col) > 1)
        raise ValueError(f"{cell_address(sheet.title, band.first, col)} is written twice")


def linked_value(sheet: Sheet, control: Control) -> int:
    """Where a control stands: the number in its cell, within its limits."""
    place = (control.linked_row, control.linked_col)
    found = next((cell.content for cell in sheet.cells if (cell.row, cell.col) == place), None)
    value = int(found) if isinstance(found, (int, float)) else control.low
    return min(max(value, control.low), control.high)


def column_values(fill: Fill, col: int, first: int, last: int) -> Sequence[Scalar]:
    """The computed values of one column of a fill, rows first..last-1."""
    if len(fill.values) != fill.rows * fill.cols:
        raise ValueError(f"the fill at row {fill.row}, column {fill.col} has {len(fill.values)} values")
    start = (first - fill.row) * fill.cols + (col - fill.col)
    stop = (last - fill.row) * fill.cols
    return fill.values[start : stop : fill.cols]

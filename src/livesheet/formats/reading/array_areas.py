"""Array formulas of a sheet: one formula, and the cells that show its array. Files store those as cells with values."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable
from typing import NamedTuple

from livesheet.formula.book import Block, BookSheet, CellStore, Kind
from livesheet.formula.nodes import MAX_COLUMNS, MAX_ROWS
from livesheet.formula.references import parse_cell
from livesheet.said import say

from .cell_faults import CellFaults

MOST_CELLS = 1 << 24
"""Cells of all array formulas of a sheet: more of them are a mistake, or meant to fill the memory."""


class ArrayText(NamedTuple):
    """An array formula as it is read; a dynamic one grows and shrinks with its array."""

    row: int
    col: int
    rows: int
    cols: int
    text: str
    dynamic: bool


def array_text(row: int, col: int, ref: str, text: str, dynamic: bool) -> ArrayText | None:
    """An array formula in (row, col) with the area `ref` ("B2:B9"); None when that does not begin there or is too large."""
    first, _, last = ref.partition(":")
    corners = parse_cell(first), parse_cell(last or first)
    if corners[0] != (row, col) or corners[1] is None:
        return None
    rows, cols = corners[1][0] - row + 1, corners[1][1] - col + 1
    if rows < 1 or cols < 1 or rows * cols > MOST_CELLS:
        return None
    return ArrayText(row, col, rows, cols, text, dynamic)


def give_arrays(sheet: BookSheet, arrays: Iterable[ArrayText], faults: CellFaults) -> None:
    """Put array formulas into a sheet that has been read. The values in their areas are results, not constants."""
    taken: list[Block] = []
    cells = 0
    for array in arrays:
        cells += array.rows * array.cols
        if cells > MOST_CELLS:
            faults.note(
                say("array formulas over more than {most} cells: this is no workbook", most=MOST_CELLS),
                array.row,
                array.col,
            )
            break
        area = array.row, array.col, array.rows, array.cols
        formula = faults.formula(array.text, area)
        if formula is None:
            sheet.keep([(array.row, array.col, 1, 1)])
            continue
        if array.row + array.rows > MAX_ROWS or array.col + array.cols > MAX_COLUMNS:
            faults.note(say("an array formula that leaves the sheet"), array.row, array.col)
            continue
        kind: Kind = "spill" if array.dynamic else "array"
        taken.append(Block(*area, formula, kind))
    sheet.blocks.extend(taken)
    wide = [block for block in taken if block.rows * block.cols > 1]
    if wide:
        move_values(sheet, wide)


def move_values(sheet: BookSheet, blocks: list[Block]) -> None:
    """What stands as a constant inside the areas is a stored result."""
    areas: dict[int, list[tuple[int, int]]] = {}
    for block in sorted(blocks, key=lambda block: block.row):
        for col in range(block.col, block.col + block.cols):
            areas.setdefault(col, []).append((block.row, block.row + block.rows))
    constants = CellStore()
    for row, col, value in sheet.constants.items():
        here = areas.get(col, ())
        # Areas that overlap are refused later; the last that begins above is the one to look at in all others.
        index = bisect_right(here, (row, MAX_ROWS + 1)) - 1
        inside = index >= 0 and row < here[index][1]
        (sheet.cached if inside else constants).put(row, col, value)
    sheet.constants = constants

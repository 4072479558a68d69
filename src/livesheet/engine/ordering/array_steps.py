"""Steps that fill cells with one array: array formulas and dynamic arrays; and cells that keep their stored values."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...formula.book import Block, CellStore
from ...formula.nodes import Node
from ..interpreter.evaluator import Evaluator
from ..layout import Layout
from ..results import Marks
from ..values.cells import NA, REF, SPILL, Cells, Codes, Frame


class ArrayStep:
    """A block that shows one array.

    Of an array formula (`Ctrl+Shift+Enter`) a single row or column is repeated, and what lies beyond the array is #N/A. A
    dynamic array notes its size (`Environment.sizes`); `blocked`: there is something in its way, so it shows #SPILL!.
    """

    def __init__(self, layout: Layout, number: int, formula: Node, blocked: bool = False) -> None:
        self.layout = layout
        self.number = number
        self.producers: Sequence[int] = (number,)
        self.formula = formula
        self.blocked = blocked

    def run(self, ev: Evaluator, marks: Marks) -> None:
        """Compute all cells of the block."""
        marks.note(self.number, fill_array(self.layout, self.number, self.formula, self.blocked, ev))


def fill_array(layout: Layout, number: int, formula: Node, blocked: bool, ev: Evaluator) -> Codes:
    """Compute the cells of an array formula; their codes."""
    block = layout.blocks[number]
    found = ev.array(formula, Frame(layout.block_sheets[number], block.row, block.col, 1, 1))
    if found is None:
        found = _stored(ev, layout.block_sheets[number], block)
    height, width = np.shape(found.numbers)
    if block.kind == "spill":
        ev.around.sizes[number] = height, width
    rows, cols = block.rows, block.cols
    numbers, codes = np.full((rows, cols), np.nan), np.full((rows, cols), NA, np.uint8)
    if blocked:
        codes[...] = SPILL
    else:
        repeated = block.kind == "array"
        down = rows if height == 1 and repeated else min(height, rows)
        right = cols if width == 1 and repeated else min(width, cols)
        numbers[:down, :right] = _first(found.numbers, down, right)
        codes[:down, :right] = _first(found.codes, down, right)
    place = slice(layout.block_offsets[number], layout.block_offsets[number] + rows * cols)
    ev.numbers[place] = numbers.T.ravel()
    ev.codes[place] = codes.T.ravel()
    return ev.codes[place]


def _stored(ev: Evaluator, sheet: int, block: Block) -> Cells:
    """What the file holds for an array that cannot be computed, as (rows, columns)."""
    rows, cols = range(block.row, block.row + block.rows), range(block.col, block.col + block.cols)
    ev.around.kept.update((sheet, row, col) for row in rows for col in cols)
    cells = [[ev.stored(Frame(sheet, row, col, 1, 1)) for col in cols] for row in rows]
    codes = [[0 if cell.codes is None else cell.codes for cell in row] for row in cells]
    return Cells(np.array([[cell.numbers for cell in row] for row in cells]), np.array(codes, np.uint8))


def _first(array: Any, rows: int, cols: int) -> Any:
    """The first rows and columns of an array, a single one repeated as often as is asked for."""
    height, width = np.shape(array)
    return array[: rows if height > 1 else 1, : cols if width > 1 else 1]


class Kept:
    """A block whose cells keep the values stored in the file: they depend on another workbook, or on an unknown function.

    missing  what its cells without a stored value show
    """

    def __init__(self, layout: Layout, number: int, cached: CellStore, missing: int = REF) -> None:
        self.layout = layout
        self.number = number
        self.producers: Sequence[int] = (number,)
        self.cached = cached
        self.missing = missing

    def run(self, ev: Evaluator, marks: Marks) -> None:
        """Put the stored values into the cells."""
        block = self.layout.blocks[self.number]
        place = first = self.layout.block_offsets[self.number]
        for col in range(block.col, block.col + block.cols):
            for row in range(block.row, block.row + block.rows):
                value = self.cached.get(row, col)
                number, code = (np.nan, self.missing) if value is None else ev.texts.encode(value)
                ev.numbers[place], ev.codes[place] = number, code
                place += 1
        marks.note(self.number, ev.codes[first:place])

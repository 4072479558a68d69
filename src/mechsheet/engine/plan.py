"""A book made ready for evaluation once, and evaluated as often as one likes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy

import numpy as np

from ..formula.book import Block, Book, BookSheet
from ..formula.nodes import Node, Scalar, shifted
from .careful import Evaluator
from .frames import Frame
from .graph import dependencies, ordered
from .layout import Layout, make_layout
from .recurrence import Held, RunningSum, compute, recognise
from .resolve import resolve
from .results import Values
from .sequence import Together
from .values import Cells, Codes, Numbers, Texts

Overrides = Mapping[tuple[str, int, int], Scalar]
"""(sheet's title, row, column) -> what to put there instead."""


def compile_book(book: Book) -> Plan:
    """Make a book ready. Raises WorkbookError for unknown functions and names, and for cells filled twice."""
    return Plan(book)


def evaluate(book: Book, overrides: Overrides | None = None) -> Values:
    """All values of a book, with some cells' contents replaced. To do so many times, keep `compile_book`'s plan."""
    return Plan(book).evaluate(overrides)


class Plan:
    """A book with its cells laid out, its formulas resolved and their order found."""

    def __init__(self, book: Book) -> None:
        self.book = book
        self.layout = make_layout(book)
        self.formulas = resolve(book)
        self.reads = dependencies(self.layout, self.formulas)
        self.steps = [self._step(group) for group in ordered(self.reads)]
        self._replaced: dict[frozenset[tuple[int, int, int]], Plan] = {}

    def _step(self, group: Sequence[int]) -> Whole | Running | Together:
        if len(group) > 1:
            return Together(self.layout, self.formulas, group)
        number = group[0]
        if number not in self.reads[number]:
            return Whole(self.layout, number, self.formulas[number])
        kind = recognise(self.layout, number, self.formulas[number])
        if kind is None:
            return Together(self.layout, self.formulas, group)
        return Running(self.layout, number, kind)

    def evaluate(self, overrides: Overrides | None = None) -> Values:
        """All values, with some cells' contents replaced by constants (`None` empties a cell).

        Raises WorkbookError at a circular reference, naming its cells, and KeyError for a sheet that does not exist.
        """
        places = self._places(overrides or {})
        structural = [cell for cell, (place, constant) in places.items() if not constant or place < 0]
        if structural:
            return self._without(frozenset(structural)).evaluate(overrides)
        layout = self.layout
        numbers, codes = np.empty(layout.size), np.zeros(layout.size, np.uint8)
        for run in layout.constants:
            end = run.offset + len(run.numbers)
            numbers[run.offset : end] = run.numbers
            if run.codes is not None:
                codes[run.offset : end] = run.codes
        texts = Texts(layout.texts)
        for cell, value in (overrides or {}).items():
            place, _ = places[self._cell(cell)]
            numbers[place], codes[place] = texts.encode(value)
        ev = Evaluator(layout, numbers, codes, texts)
        for step in self.steps:
            step.run(ev)
        return Values(layout, numbers, codes, texts)

    def _cell(self, cell: tuple[str, int, int]) -> tuple[int, int, int]:
        title, row, col = cell
        folded = title.casefold()
        for index, known in enumerate(self.layout.titles):
            if known.casefold() == folded:
                return index, row, col
        raise KeyError(f"no sheet called {title}")

    def _places(self, overrides: Overrides) -> dict[tuple[int, int, int], tuple[int, bool]]:
        """Cell -> (its place in the flat array, whether it is a constant there)."""
        found = {}
        for cell in overrides:
            sheet, row, col = self._cell(cell)
            place = self.layout.place(sheet, row, col)
            column = self.layout.columns[sheet].get(col)
            producers = list(column.producers_in(row, 1)) if column is not None else []
            constant = bool(producers) and producers[0] >= len(self.layout.blocks)
            found[(sheet, row, col)] = place, constant
        return found

    def _without(self, cells: frozenset[tuple[int, int, int]]) -> Plan:
        """The plan of this book with constants (blank for now) in cells that hold formulas or nothing."""
        if cells not in self._replaced:
            sheets = [
                _replaced(sheet, sorted((row, col) for at, row, col in cells if at == index))
                for index, sheet in enumerate(self.book.sheets)
            ]
            book = copy(self.book)
            book.sheets = sheets
            self._replaced[cells] = Plan(book)
        return self._replaced[cells]


def _replaced(sheet: BookSheet, cells: Sequence[tuple[int, int]]) -> BookSheet:
    """The sheet with blanks in `cells`, and the blocks that held them in pieces around them."""
    if not cells:
        return sheet
    blocks = list(sheet.blocks)
    constants = sheet.constants.copy()
    for row, col in cells:
        blocks = [part for block in blocks for part in _around(block, row, col)]
        constants.put(row, col, None)
    return BookSheet(sheet.title, constants, blocks, sheet.cached)


def _around(block: Block, row: int, col: int) -> list[Block]:
    """The parts of a block around one cell: above, left, right, below."""
    down, right = row - block.row, col - block.col
    if not (0 <= down < block.rows and 0 <= right < block.cols):
        return [block]
    parts = (
        (0, 0, down, block.cols),
        (down, 0, 1, right),
        (down, right + 1, 1, block.cols - right - 1),
        (down + 1, 0, block.rows - down - 1, block.cols),
    )
    return [
        Block(block.row + r, block.col + c, rows, cols, shifted(block.formula, r, c))
        for r, c, rows, cols in parts
        if rows and cols
    ]


def write(layout: Layout, number: int, down: int, rows: int, found: Cells, numbers: Numbers, codes: Codes) -> None:
    """Put the values of a block's rows [down, down + rows) into the flat array."""
    block = layout.blocks[number]
    start = layout.block_offsets[number]
    end = start + block.rows * block.cols
    numbers[start:end].reshape(block.cols, block.rows)[:, down : down + rows] = found.numbers
    if found.codes is not None:
        codes[start:end].reshape(block.cols, block.rows)[:, down : down + rows] = found.codes


def frame_of(layout: Layout, number: int) -> Frame:
    """The whole block as a frame."""
    block = layout.blocks[number]
    return Frame(layout.block_sheets[number], block.row, block.col, block.rows, block.cols)


class Whole:
    """A block that reads nothing of itself: all its cells at once."""

    def __init__(self, layout: Layout, number: int, formula: Node) -> None:
        self.layout = layout
        self.number = number
        self.formula = formula
        self.frame = frame_of(layout, number)

    def run(self, ev: Evaluator) -> None:
        """Compute all cells."""
        found = ev.result(self.formula, self.frame)
        write(self.layout, self.number, 0, self.frame.rows, found, ev.numbers, ev.codes)


class Running:
    """A column that reads its own previous row in one of the known ways."""

    def __init__(self, layout: Layout, number: int, kind: RunningSum | Held) -> None:
        self.layout = layout
        self.number = number
        self.kind = kind
        self.frame = frame_of(layout, number)

    def run(self, ev: Evaluator) -> None:
        """Compute all cells."""
        found = compute(self.kind, ev, self.frame)
        write(self.layout, self.number, 0, self.frame.rows, found, ev.numbers, ev.codes)

"""A book made ready for evaluation once, and evaluated as often as one likes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from copy import copy

import numpy as np

from ..formula.book import Block, Book, BookSheet
from ..formula.nodes import Scalar, shifted
from .careful import Evaluator
from .graph import dependencies
from .layout import Area, make_layout
from .marks import marks_of_constants
from .resolve import resolve
from .results import Values
from .schedule import schedule
from .values import Texts

Overrides = Mapping[tuple[str, int, int], Scalar]
"""(sheet's title, row, column) -> what to put there instead."""


def compile_book(book: Book) -> Plan:
    """Make a book ready. Raises WorkbookError for unknown functions and names, and for cells filled twice."""
    return Plan(book)


def evaluate(book: Book, overrides: Overrides | None = None) -> Values:
    """All values of a book, with some cells' contents replaced. To do so many times, keep `compile_book`'s plan."""
    return Plan(book, once=True).evaluate(overrides)


class Plan:
    """A book with its cells laid out, its formulas resolved and their order found."""

    def __init__(self, book: Book, once: bool = False) -> None:
        self.book = book
        self.once = once
        self.layout = make_layout(book)
        self.resolved = resolve(book)
        self.remarks = tuple(self.resolved.remarks)
        self.formulas = self.resolved.formulas
        self.reads = dependencies(self.layout, self.formulas, self.resolved.functions)
        self.steps = schedule(self.layout, self.formulas, self.reads, once)
        self.marks = marks_of_constants(self.layout)
        self._replaced: dict[frozenset[tuple[int, int, int]], Plan] = {}

    def evaluate(self, overrides: Overrides | None = None) -> Values:
        """All values, with some cells' contents replaced by constants (`None` empties a cell).

        Raises WorkbookError at a circular reference, naming its cells, and KeyError for a sheet that does not exist.
        """
        places = self._places(overrides or {})
        count = len(self.layout.blocks)
        structural = [cell for cell, (_, producer) in places.items() if producer < count]
        if structural:
            return self.with_constants_in(frozenset(structural)).evaluate(overrides)
        layout = self.layout
        numbers, codes = layout.filled()
        texts = Texts(layout.texts)
        marks = self.marks.copy()
        for cell, value in (overrides or {}).items():
            place, producer = places[self._cell(cell)]
            numbers[place], codes[place] = texts.encode(value)
            marks.note(producer, codes[place : place + 1])
        ev = Evaluator(layout, numbers, codes, texts)
        with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
            for step in self.steps:
                step.run(ev, marks)
        return Values(layout, numbers, codes, texts)

    def _cell(self, cell: tuple[str, int, int]) -> tuple[int, int, int]:
        title, row, col = cell
        folded = title.casefold()
        for index, known in enumerate(self.layout.titles):
            if known.casefold() == folded:
                return index, row, col
        raise KeyError(f"no sheet called {title}")

    def _places(self, overrides: Overrides) -> dict[tuple[int, int, int], tuple[int, int]]:
        """Cell -> (its place in the flat array, what fills it: -1 for an empty cell)."""
        found = {}
        for cell in overrides:
            sheet, row, col = self._cell(cell)
            place = self.layout.place(sheet, row, col)
            producers = self.layout.producers(Area(sheet, row, col, 1, 1)) if place >= 0 else ()
            found[(sheet, row, col)] = place, next(iter(producers), -1)
        return found

    def with_constants_in(self, cells: frozenset[tuple[int, int, int]]) -> Plan:
        """The plan of this book with constants (blank for now) in cells, (sheet's index, row, column), that hold formulas or
        nothing."""
        if cells not in self._replaced:
            sheets = [
                _replaced(sheet, sorted((row, col) for at, row, col in cells if at == index))
                for index, sheet in enumerate(self.book.sheets)
            ]
            book = copy(self.book)
            book.sheets = sheets
            self._replaced[cells] = Plan(book, self.once)
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

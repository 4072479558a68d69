"""Where the cells of a book lie in one flat array, and how a rectangle of cells is read from it.

Cells that touch in a column lie side by side, whatever filled them, so a column is a slice. A block of several columns
lies as one array of its own.
"""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from collections.abc import Iterator
from dataclasses import dataclass, field
from math import inf
from typing import NamedTuple

import numpy as np

from ..diagnostics import Fault, WorkbookError
from ..formula.book import Block, Book
from ..formula.references import cell_address
from ..said import say
from .values.cells import EPOCHS, Cells, Codes, Numbers, Texts

_MOST_KNOWN = 20_000
"""Areas whose place is remembered: those of lone formulas are read again at every evaluation."""


class Area(NamedTuple):
    """A rectangle of cells of one sheet (by index)."""

    sheet: int
    row: int
    col: int
    rows: int
    cols: int

    def overlaps(self, other: Area) -> bool:
        """Whether they have a cell in common."""
        return (
            self.sheet == other.sheet
            and self.row < other.row + other.rows
            and other.row < self.row + self.rows
            and self.col < other.col + other.cols
            and other.col < self.col + self.cols
        )


class Piece(NamedTuple):
    """Consecutive cells of one column filled by one producer: a block, or a run of constants."""

    row: int
    rows: int
    producer: int


class Band(NamedTuple):
    """Consecutive cells of one column that lie side by side from `offset` on."""

    row: int
    rows: int
    offset: int


@dataclass(slots=True)
class Column:
    """One column: what fills it and where it lies, both from the top down.

    (row, inf) stands behind whatever begins in that row: a search with a key function would call it at every step.
    """

    pieces: list[Piece] = field(default_factory=list)
    bands: list[Band] = field(default_factory=list)

    def band_at(self, row: int) -> Band | None:
        """The band that holds a row."""
        index = bisect_right(self.bands, (row, inf)) - 1
        if index >= 0 and row < self.bands[index].row + self.bands[index].rows:
            return self.bands[index]
        return None

    def bands_in(self, row: int, rows: int) -> Iterator[Band]:
        """The bands that touch rows [row, row + rows)."""
        index = max(0, bisect_right(self.bands, (row, inf)) - 1)
        for band in self.bands[index:]:
            if band.row >= row + rows:
                break
            if band.row + band.rows > row:
                yield band

    def producers_in(self, row: int, rows: int) -> Iterator[int]:
        """What fills any of the rows [row, row + rows)."""
        index = max(0, bisect_right(self.pieces, (row, inf)) - 1)
        end = bisect_left(self.pieces, (row + rows,), index)
        for piece in self.pieces[index:end]:
            if piece.row + piece.rows > row:
                yield piece.producer


@dataclass(slots=True)
class Constants:
    """A run of constants: its place in the flat array and its encoded values."""

    sheet: int
    row: int
    col: int
    numbers: Numbers
    codes: Codes | None
    offset: int = -1


@dataclass(slots=True)
class Layout:
    """The whole book in one flat array of `size` cells; the first `lone` are constants that touch no formula.

    sheets  title -> its index
    """

    titles: list[str]
    columns: list[dict[int, Column]]
    blocks: list[Block]
    block_sheets: list[int]
    constants: list[Constants]
    block_offsets: list[int]
    texts: Texts
    size: int = 0
    lone: int = 0
    date1904: bool = False
    used_rows: list[int] = field(default_factory=list)
    _known: dict[Area, int] = field(default_factory=dict)
    _pieces: dict[Area, tuple[tuple[int, slice, slice], ...]] = field(default_factory=dict)
    template: tuple[Numbers, Codes, list[Constants]] = field(init=False)
    sheets: dict[str, int] = field(init=False)

    def __post_init__(self) -> None:
        self.sheets = {title: index for index, title in enumerate(self.titles)}

    def filled(self) -> tuple[Numbers, Codes]:
        """A new flat array and its codes with all constants in their places; formulas' cells hold anything, code 0."""
        numbers, codes = np.empty(self.size), np.zeros(self.size, np.uint8)
        lone_numbers, lone_codes, others = self.template
        numbers[: self.lone] = lone_numbers
        codes[: self.lone] = lone_codes
        for run in others:
            place = slice(run.offset, run.offset + len(run.numbers))
            numbers[place] = run.numbers
            if run.codes is not None:
                codes[place] = run.codes
        return numbers, codes

    def block_area(self, number: int) -> Area:
        """The cells that a block fills."""
        block = self.blocks[number]
        return Area(self.block_sheets[number], block.row, block.col, block.rows, block.cols)

    def spill_at(self, sheet: int, row: int, col: int) -> Area | None:
        """The cells of the array whose formula stands in a cell, None when there is none."""
        for producer in self.producers(Area(sheet, row, col, 1, 1)):
            if producer < len(self.blocks):
                block = self.blocks[producer]
                if block.kind != "fill" and (block.row, block.col) == (row, col):
                    return self.block_area(producer)
        return None

    def clipped(self, area: Area) -> Area:
        """The area without the rows below and the columns right of everything in its sheet; at least one cell."""
        sheet, row, col, rows, cols = area
        rows = max(1, min(rows, self.used_rows[sheet] - row))
        cols = max(1, min(cols, max(self.columns[sheet], default=0) + 1 - col))
        return Area(sheet, row, col, rows, cols)

    def producers(self, area: Area) -> set[int]:
        """What fills any cell of the area: numbers of blocks, then len(blocks) + number of a run of constants."""
        found: set[int] = set()
        columns = self.columns[area.sheet]
        for col in _columns_in(columns, area):
            found.update(columns[col].producers_in(area.row, area.rows))
        return found

    def place(self, sheet: int, row: int, col: int) -> int:
        """Where a cell lies in the flat array, -1 when it is empty."""
        column = self.columns[sheet].get(col)
        band = column.band_at(row) if column is not None else None
        return -1 if band is None else band.offset + row - band.row

    def read(self, area: Area, numbers: Numbers, codes: Codes) -> Cells:
        """The cells of an area, shape (cols, rows); a view where they lie side by side."""
        place = self._known.get(area)
        if place is None:
            place = self._contiguous(area)
            if len(self._known) < _MOST_KNOWN:
                self._known[area] = place
        if place >= 0:
            end = place + area.rows * area.cols
            found, kinds = numbers[place:end], codes[place:end]
            return Cells(
                found.reshape(area.cols, area.rows),
                kinds.reshape(area.cols, area.rows) if np.count_nonzero(kinds) else None,
            )
        found = np.zeros((area.cols, area.rows))
        kinds = np.ones((area.cols, area.rows), np.uint8)  # BLANK
        pieces = self._pieces.get(area)
        if pieces is None:
            pieces = tuple(self._scattered(area))
            if len(self._pieces) < _MOST_KNOWN:
                self._pieces[area] = pieces
        for col, target, source in pieces:
            found[col, target] = numbers[source]
            kinds[col, target] = codes[source]
        return Cells(found, kinds if np.count_nonzero(kinds) else None)

    def _scattered(self, area: Area) -> Iterator[tuple[int, slice, slice]]:
        """The pieces of an area that lie side by side: (column of the area, its rows there, where they lie)."""
        columns = self.columns[area.sheet]
        for col in _columns_in(columns, area):
            for band in columns[col].bands_in(area.row, area.rows):
                first, last = max(band.row, area.row), min(band.row + band.rows, area.row + area.rows)
                place = band.offset - band.row
                yield col - area.col, slice(first - area.row, last - area.row), slice(place + first, place + last)

    def _contiguous(self, area: Area) -> int:
        """Where the area lies as one piece of the flat array, -1 when it does not."""
        columns = self.columns[area.sheet]
        first = self.place(area.sheet, area.row, area.col)
        if first < 0:
            return -1
        for index in range(area.cols):
            column = columns.get(area.col + index)
            band = column.band_at(area.row) if column is not None else None
            if band is None or area.row + area.rows > band.row + band.rows:
                return -1
            if band.offset + area.row - band.row != first + index * area.rows:
                return -1
        return first


def _columns_in(columns: dict[int, Column], area: Area) -> list[int]:
    """The used columns of an area, from the left."""
    if area.cols < len(columns):
        return [col for col in range(area.col, area.col + area.cols) if col in columns]
    return sorted(col for col in columns if area.col <= col < area.col + area.cols)


def make_layout(book: Book) -> Layout:
    """Give every cell its place. Raises WorkbookError when two things fill the same cell."""
    texts = Texts(settings=book.settings, epochs=EPOCHS if book.date1904 else 0.0)
    layout = Layout([sheet.title for sheet in book.sheets], [{} for _ in book.sheets], [], [], [], [], texts)
    layout.date1904 = book.date1904
    for index, sheet in enumerate(book.sheets):
        for block in sheet.blocks:
            layout.blocks.append(block)
            layout.block_sheets.append(index)
    for index, sheet in enumerate(book.sheets):
        for col, runs in sorted(sheet.constants.columns.items()):
            for run in runs:
                layout.constants.append(_encoded(index, run.row, col, run.values, texts))
    _fill_columns(layout, book)
    _give_places(layout)
    return layout


def _encoded(sheet: int, row: int, col: int, values: object, texts: Texts) -> Constants:
    if not isinstance(values, list):
        return Constants(sheet, row, col, np.array(values, np.float64), None)
    pairs = [texts.encode(value) for value in values]
    codes = np.array([code for _, code in pairs], np.uint8)
    return Constants(sheet, row, col, np.array([n for n, _ in pairs], np.float64), codes if codes.any() else None)


def _fill_columns(layout: Layout, book: Book) -> None:
    for number, block in enumerate(layout.blocks):
        columns = layout.columns[layout.block_sheets[number]]
        for col in range(block.col, block.col + block.cols):
            columns.setdefault(col, Column()).pieces.append(Piece(block.row, block.rows, number))
    for number, run in enumerate(layout.constants, len(layout.blocks)):
        column = layout.columns[run.sheet].setdefault(run.col, Column())
        column.pieces.append(Piece(run.row, len(run.numbers), number))
    faults = []
    for index, columns in enumerate(layout.columns):
        for col, column in columns.items():
            column.pieces.sort()
            for above, below in zip(column.pieces, column.pieces[1:], strict=False):
                if above.row + above.rows > below.row:
                    place = cell_address(book.sheets[index].title, below.row, col)
                    faults.append(Fault(say("a cell that is filled twice"), file=book.source, key=place))
        ends = (column.pieces[-1].row + column.pieces[-1].rows for column in columns.values())
        layout.used_rows.append(max(ends, default=1))
    if faults:
        raise WorkbookError(faults)


def _give_places(layout: Layout) -> None:
    """Columns of constants that touch no formula, then blocks of several columns, then what touches side by side."""
    count = len(layout.blocks)
    layout.block_offsets = [-1] * count
    stacks = [
        (column, stack)
        for columns in layout.columns
        for col, column in sorted(columns.items())
        for stack in _stacks(column.pieces, layout)
    ]
    for column, stack in stacks:
        if all(piece.producer >= count for piece in stack):
            _give_band(layout, column, stack)
    layout.lone = layout.size
    for number, block in enumerate(layout.blocks):
        if block.cols > 1:
            layout.block_offsets[number] = layout.size
            for col in range(block.col, block.col + block.cols):
                column = layout.columns[layout.block_sheets[number]][col]
                column.bands.append(Band(block.row, block.rows, layout.size))
                layout.size += block.rows
    for column, stack in stacks:
        if any(piece.producer < count for piece in stack):
            _give_band(layout, column, stack)
    for columns in layout.columns:
        for column in columns.values():
            column.bands.sort()
    layout.template = _template(layout)


def _stacks(pieces: list[Piece], layout: Layout) -> Iterator[list[Piece]]:
    """Pieces of a column that touch, without those of wide blocks."""
    stack: list[Piece] = []
    for piece in pieces:
        wide = piece.producer < len(layout.blocks) and layout.blocks[piece.producer].cols > 1
        if stack and (wide or stack[-1].row + stack[-1].rows != piece.row):
            yield stack
            stack = []
        if not wide:
            stack.append(piece)
    if stack:
        yield stack


def _give_band(layout: Layout, column: Column, stack: list[Piece]) -> None:
    count = len(layout.blocks)
    column.bands.append(Band(stack[0].row, sum(piece.rows for piece in stack), layout.size))
    for piece in stack:
        if piece.producer < count:
            layout.block_offsets[piece.producer] = layout.size
        else:
            layout.constants[piece.producer - count].offset = layout.size
        layout.size += piece.rows


def _template(layout: Layout) -> tuple[Numbers, Codes, list[Constants]]:
    """The lone constants as arrays, and the runs of constants that touch formulas."""
    numbers, codes = np.zeros(layout.lone), np.zeros(layout.lone, np.uint8)
    others = []
    for run in layout.constants:
        if run.offset >= layout.lone:
            others.append(run)
            continue
        place = slice(run.offset, run.offset + len(run.numbers))
        numbers[place] = run.numbers
        codes[place] = 0 if run.codes is None else run.codes
    return numbers, codes, others

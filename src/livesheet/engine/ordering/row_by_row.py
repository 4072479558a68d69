"""Columns that read each other row by row: in which order their cells can be computed, and the loop over the rows.

A *line* is one column of a block. Each line gets a start, so that its cell in row r is computed at time r + start, after all
that it reads: of cells of the set only what is computed earlier, or at the same time by a line that stands before it. So
columns of different sheets, first rows and heights go together, and a row may read any rows above it.

The loop computes floats as far as all is numbers; values of any kind from there until it is again; and what neither can
say, the interpreter.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from graphlib import CycleError, TopologicalSorter
from itertools import pairwise
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from ...formula.book import Block
from ...formula.nodes import Apply, CellRef, FunctionRef, Local, Node, RangeRef, Text, shifted, walk
from ..fast.cell_code import CellCodes
from ..fast.cell_functions import CellCode, Memory
from ..fast.lowered_functions import FUNCTIONS
from ..fast.lowering import UnsuitableError
from ..fast.row_loop import RowBlock, RowCode, RowLowering, above_order, row_code
from ..graph import area_read, reads_anywhere, references
from ..interpreter.evaluator import Evaluator
from ..kernels.math import Arithmetic
from ..layout import Layout
from ..results import Marks

_MOST_LINES = 2_000
_MOST_ROUNDS = 64
"""Lines of a set; rounds until all starts must be settled: a circle would raise them without end."""


@dataclass(slots=True)
class Line:
    """One column of a block, so many `right` of its first: its formula as seen from its first cell, and its start."""

    producer: int
    sheet: int
    block: Block
    offset: int
    right: int
    start: int = 0

    @property
    def first(self) -> int:
        """The time of its first cell."""
        return self.block.row + self.start

    @property
    def last(self) -> int:
        """The time after its last cell."""
        return self.first + self.block.rows


class Stretch(NamedTuple):
    """Times [first, last) in which the same lines have cells, in their order."""

    first: int
    last: int
    lines: tuple[Line, ...]


class _Edge(NamedTuple):
    """`reader` (by number) reads cells of `read`, down to `further` rows below its own."""

    reader: int
    read: int
    further: int


def lines_in_order(layout: Layout, formulas: Sequence[Node], group: Sequence[int]) -> list[Line] | None:
    """The lines of blocks that read each other, with their starts, in order; None when there is no such order."""
    lines: list[Line] = []
    for number in group:
        block, formula = layout.blocks[number], formulas[number]
        if block.kind != "fill" or reads_anywhere(formula) or len(lines) + block.cols > _MOST_LINES:
            return None
        if any(isinstance(part, FunctionRef | Local | Apply) for part in walk(formula)):
            return None
        for right in range(block.cols):
            seen = shifted(formula, 0, right) if right else formula
            part = Block(block.row, block.col + right, block.rows, 1, seen)
            offset = layout.block_offsets[number] + right * block.rows
            lines.append(Line(number, layout.block_sheets[number], part, offset, right))
    edges = list(_edges(layout, lines))
    # All first rows at one time, if that will do; else each as early as can be.
    for line in lines:
        line.start = -line.block.row
    if all(lines[reader].start >= lines[read].start + further for reader, read, further in edges):
        found = _ordered(lines, edges)
        if found is not None:
            return found
    for line in lines:
        line.start = 0
    return _ordered(lines, edges) if _settled(lines, edges) else None


def stretches(lines: Sequence[Line]) -> list[Stretch]:
    """The times in which the same lines have cells, one after the other."""
    times = sorted({time for line in lines for time in (line.first, line.last)})
    found = []
    for first, last in pairwise(times):
        active = tuple(line for line in lines if line.first <= first and last <= line.last)
        if active:
            found.append(Stretch(first, last, active))
    return found


def _edges(layout: Layout, lines: Sequence[Line]) -> Iterator[_Edge]:
    columns: dict[tuple[int, int], list[int]] = {}
    for number, line in enumerate(lines):
        columns.setdefault((line.sheet, line.block.col), []).append(number)
    for reader, line in enumerate(lines):
        for ref in dict.fromkeys(references(line.block.formula)):
            area = area_read(ref, line.block, layout.sheets)
            if area is None:
                continue
            for col in range(area.col, area.col + area.cols):
                for read in columns.get((area.sheet, col), ()):
                    block = lines[read].block
                    if block.row < area.row + area.rows and area.row < block.row + block.rows:
                        yield _Edge(reader, read, _further(ref, line.block, block))


def _further(ref: CellRef | RangeRef, reader: Block, read: Block) -> int:
    """How far below its own row a reader's row reads, at most. A fixed row must be done before the reader's first one."""
    corners = (ref.start, ref.end) if isinstance(ref, RangeRef) else (ref,)
    last = read.row + read.rows - 1
    return max(
        min(corner.row, last) - reader.row + 1 if corner.row_abs else corner.row - reader.row
        for corner in corners
        if isinstance(corner, CellRef)
    )


def _settled(lines: list[Line], edges: list[_Edge]) -> bool:
    """Give each line the least start that lets it read what it reads (Bellman and Ford); whether there is one."""
    for _ in range(_MOST_ROUNDS):
        moved = False
        for reader, read, further in edges:
            needed = lines[read].start + further
            if lines[reader].start < needed:
                lines[reader].start = needed
                moved = True
        if not moved:
            return True
    return False


def _ordered(lines: list[Line], edges: list[_Edge]) -> list[Line] | None:
    """The lines in an order in which each stands after those that it reads at its own time; None for a circle."""
    after: dict[int, list[int]] = {number: [] for number in range(len(lines))}
    for reader, read, further in edges:
        if lines[reader].start == lines[read].start + further:
            after[reader].append(read)
    try:
        return [lines[number] for number in TopologicalSorter(after).static_order()]
    except CycleError:
        return None


_FEW_ROWS, _FEW_CELLS = 12, 256
"""Rows and cells for which no code is made: the interpreter is done before it is."""
_FEW_SLOW = 8
"""Rows with something other than numbers until code for values of any kind is made."""
_FIRST_ROWS, _MOST_ROWS = 64, 4096
"""Rows of the loop at a time: few where they stop early, many when all goes well."""
_MOST_BURST = 256
"""Rows computed as values of any kind before floats are tried again, where that has failed again and again."""

_Loop: TypeAlias = tuple[RowLowering, RowCode]


class RowByRow:
    """A set of columns that read each other, in their order."""

    def __init__(self, layout: Layout, formulas: Sequence[Node], group: Sequence[int], lines: Sequence[Line]) -> None:
        self.layout = layout
        self.formulas = formulas
        self.producers = group
        self.sheets = layout.sheets
        self.lines = lines
        self.parts = [_Part(self, stretch) for stretch in stretches(lines)]
        self.codes = CellCodes(layout, _FEW_SLOW)
        # The loop is made when it pays; by then no more texts are taken.
        texts = {part.value for each in group for part in walk(formulas[each]) if isinstance(part, Text)}
        for text in sorted(filter(layout.texts.takes, texts)):
            layout.texts.number(text)

    def run(self, ev: Evaluator, marks: Marks) -> None:
        """Compute all cells."""
        memory = Memory(ev)
        for part in self.parts:
            part.run(memory, marks)
        for number in self.producers:
            block, start = self.layout.blocks[number], self.layout.block_offsets[number]
            marks.note(number, ev.codes[start : start + block.rows * block.cols])


class _Part:
    """The rows in which the same lines have cells."""

    def __init__(self, step: RowByRow, stretch: Stretch) -> None:
        self.step = step
        self.layout = step.layout
        self.lines = stretch.lines
        self.first = stretch.first
        self.rows = stretch.last - stretch.first
        self._runs = 0
        self._tried = False
        self._loop: _Loop | None = None
        self._codes: dict[bool, list[CellCode]] = {}

    @cached_property
    def blocks(self) -> list[RowBlock]:
        """These rows of the lines."""
        found = []
        for line in self.lines:
            down, block = self.first - line.first, line.block
            formula = shifted(block.formula, down) if down else block.formula
            rows = Block(block.row + down, block.col, self.rows, 1, formula)
            found.append(RowBlock(line.producer, line.sheet, rows, line.offset + down))
        return found

    def loop(self, arithmetic: Arithmetic) -> _Loop | None:
        """The loop of floats, None where a formula cannot be said so. A plan knows one arithmetic, so one loop is kept."""
        if not self._tried:
            self._tried = True
            try:
                lowering = RowLowering(self.layout, self.step.sheets, FUNCTIONS, self.blocks, set(self.step.producers))
                self._loop = lowering, row_code(lowering, self.layout, arithmetic)[0]
            except UnsuitableError:
                pass
        return self._loop

    def run(self, memory: Memory, marks: Marks) -> None:
        """Compute the rows from the first to the last."""
        self._runs += 1
        many = self.rows > _FEW_ROWS and (self._runs > 1 or self.rows * len(self.lines) > _FEW_CELLS)
        loop = self.loop(memory.ev.around.arithmetic) if many or self._runs > _FEW_SLOW else None
        if loop is None or not self._as_expected(loop[0], memory.ev, marks):
            for row in range(self.rows):
                self._row(memory, row)
            return
        self._by_loop(memory, *loop)

    @staticmethod
    def _as_expected(lowering: RowLowering, ev: Evaluator, marks: Marks) -> bool:
        """Whether what all rows read is numbers."""
        reads = lowering.reads
        return (
            reads.others.isdisjoint(marks.dirty)
            and reads.texts <= marks.texts
            and not any(ev.codes[place] for place in lowering.cells)
        )

    def _by_loop(self, memory: Memory, lowering: RowLowering, code: RowCode) -> None:
        ev = memory.ev
        plain = self._plain(lowering, ev)
        order = above_order(lowering)
        row, size, burst = 0, _FIRST_ROWS, 1
        out = np.empty((min(self.rows, _MOST_ROWS), len(self.lines)))
        while row < self.rows:
            above = self._above(order, ev, row) if plain is None or plain[row] else None
            done = 0
            if above is not None:
                end = min(row + size, self.rows)
                if plain is not None and not plain[row:end].all():
                    end = row + int(np.argmin(plain[row:end]))
                done = code(ev.numbers, above, row, end, out)
                self._write(ev, out, row, done)
                row += done
                if row == end:
                    size, burst = min(2 * size, _MOST_ROWS), 1
                    continue
            size = _FIRST_ROWS
            burst = 1 if done >= _FIRST_ROWS else min(2 * burst, _MOST_BURST)
            for _ in range(min(burst, self.rows - row)):
                self._row(memory, row)
                row += 1

    def _row(self, memory: Memory, row: int) -> None:
        """Compute the cells of a row, of any kind of values."""
        step, by_code = self.step, self.step.codes.due()
        if by_code not in self._codes:
            parts = [(line.producer, step.formulas[line.producer], line.right) for line in self.lines]
            self._codes[by_code] = [step.codes.code(memory.ev, *part, by_code) for part in parts]
        for line, code in zip(self.lines, self._codes[by_code], strict=True):
            down = self.first + row - line.first
            if not memory.fill(code, down, line.offset + down):
                step.codes.interpret(memory.ev, line.producer, step.formulas[line.producer], down, line.right)

    def _write(self, ev: Evaluator, out: Any, row: int, done: int) -> None:
        if not done:
            return
        columns = np.ascontiguousarray(out[:done].T)
        for number, block in enumerate(self.blocks):
            start = block.offset + row
            ev.numbers[start : start + done] = columns[number]
            ev.codes[start : start + done] = 0

    def _plain(self, lowering: RowLowering, ev: Evaluator) -> Any:
        """In which rows the columns read elsewhere hold numbers; None: in all."""
        plain = None
        for place in lowering.columns:
            codes = ev.codes[place : place + self.rows]
            if codes.any():
                plain = (codes == 0) if plain is None else plain & (codes == 0)
        return plain

    def _above(self, order: list[tuple[int, int]], ev: Evaluator, row: int) -> list[float] | None:
        """The values that a row reads from rows above, None when one is no number."""
        found = []
        for number, above in order:
            block = self.blocks[number]
            place = block.offset + row - above
            if above > row:
                place = self.layout.place(block.sheet, block.block.row + row - above, block.block.col)
            if place < 0 or ev.codes[place]:
                return None
            found.append(float(ev.numbers[place]))
        return found


def row_by_row(layout: Layout, formulas: Sequence[Node], group: Sequence[int]) -> RowByRow | None:
    """The step that computes blocks row by row, None where no order of rows and columns serves all of them."""
    lines = lines_in_order(layout, formulas, group)
    return None if lines is None else RowByRow(layout, formulas, group, lines)

"""Columns that read each other row by row, computed by a loop over the rows.

It computes floats as far as all is numbers; values of any kind from there until it is again; and what neither can say, the
interpreter.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np

from ...formula.book import Block
from ...formula.nodes import Node, Text, shifted, walk
from ..fast.any_kind import CellCode
from ..fast.cell_codes import CellCodes
from ..fast.lowered_functions import FUNCTIONS
from ..fast.lowering import UnsuitableError
from ..fast.marks import Marks
from ..fast.memory import Memory
from ..fast.row_loop import RowCode, above_order, row_code
from ..fast.row_lowering import RowBlock, RowLowering
from ..interpreter.evaluator import Evaluator
from ..kernels.arithmetic import Arithmetic
from ..layout import Layout
from .row_order import Line, Stretch, lines_in_order, stretches

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

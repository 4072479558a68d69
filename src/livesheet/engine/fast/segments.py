"""Segments: blocks that are computed together, fast where everything is plain numbers, interpreted where it is not."""

from __future__ import annotations

from functools import cache, cached_property
from typing import Any, TypeAlias

import numpy as np

from ...formula.nodes import Node
from ..interpreter.evaluator import Evaluator
from ..layout import Layout
from ..results import Marks
from ..values.cells import Cells, Codes, Frame
from .cell_code import CellCodes
from .cell_functions import Memory
from .emitting import CHUNK, Code, emit
from .generated import TroubleError
from .lowering import MOST_VALUES, Lowering, Reads, UnsuitableError

Buffers: TypeAlias = dict[str, Any]

_MOST_MEMBERS = 256
"""Blocks of a segment: what depends on a change is found by segments."""
_PATIENCE = 3
_PART = 4096
"""Cells of a chunk that are computed together where not all of it is plain numbers."""
_PIECE = 64
_GAP = 16
"""Rows: a piece that is tried by itself; good rows between bad ones that are worth a call of their own."""
_SHORT = 64
"""Rows that cell by cell, by code, are done before the interpreter has looked at each part of their formula once."""
_INTERPRETED = 4
"""Times that a segment is interpreted before its cells get code of their own, for values of any kind."""

_FAILURES = (TroubleError, FloatingPointError, ZeroDivisionError, OverflowError)


def worth_at_once(rows: int, cols: int) -> bool:
    """Whether a block is so large that making code for it pays even when it is computed only once."""
    return rows * cols >= 4 * _PART


class Member:
    """A block of a segment and its formula.

    singly  whether the interpreter takes it cell by cell, as a range's size differs or goes down with them
    """

    def __init__(self, layout: Layout, number: int, formula: Node) -> None:
        self.layout = layout
        self.number = number
        self.formula = formula
        self.block = layout.blocks[number]
        self.singly = self.block.rows * self.block.cols == 1

    def run(self, ev: Evaluator, start: int, stop: int) -> Codes:
        """Compute rows [start, stop) by the interpreter; their codes."""
        block = self.block
        sheet = self.layout.block_sheets[self.number]
        frame = Frame(sheet, block.row + start, block.col, stop - start, block.cols, start)
        before = ev.singly
        found = ev.result(self.formula, frame)
        self.singly |= ev.singly > before
        return write(self.layout, self.number, start, stop, found, ev)


def write(layout: Layout, number: int, start: int, stop: int, found: Cells, ev: Evaluator) -> Codes:
    """Put the values of a block's rows [start, stop) into the flat array; their codes."""
    block = layout.blocks[number]
    first = layout.block_offsets[number]
    last = first + block.rows * block.cols
    ev.numbers[first:last].reshape(block.cols, block.rows)[:, start:stop] = found.numbers
    codes = ev.codes[first:last].reshape(block.cols, block.rows)[:, start:stop]
    codes[...] = 0 if found.codes is None else found.codes
    return codes


class Segment:
    """Blocks of the same height in their order, and the code that computes them when all is well."""

    def __init__(self, layout: Layout, first: Member, lowering: Lowering | None) -> None:
        self.layout = layout
        self.members = [first]
        self.producers = [first.number]
        self.lowering = lowering
        self.rows = first.block.rows
        self.cols = first.block.cols
        self._code: Code | None = None
        self._buffers: list[Buffers] = []
        self._counts: dict[str, int] = {}
        self._runs = 0
        self._cells = CellCodes(layout, _INTERPRETED, alone=self.rows * self.cols == 1)

    def joined(self, member: Member) -> bool:
        """Take a block in, if the fast path can compute it together with the others."""
        if self.lowering is None or self.is_full:
            return False
        try:
            self.lowering.add(member.number, member.formula)
        except UnsuitableError:
            return False
        self.members.append(member)
        self.producers.append(member.number)
        return True

    @property
    def is_full(self) -> bool:
        """Whether further blocks must go elsewhere."""
        return self.lowering is None or len(self.members) >= _MOST_MEMBERS or len(self.lowering.order) >= MOST_VALUES

    @cached_property
    def texts(self) -> set[int]:
        """The members that the fast path fills with a text."""
        if self.lowering is None:
            return set()
        values, results = self.lowering.values, self.lowering.results
        return {number for number, result in results.items() if values[result].kind == "text"}

    def run(self, ev: Evaluator, marks: Marks) -> None:
        """Compute all cells, and mark those blocks that do not consist of numbers alone."""
        self._runs += 1
        # Making the code costs some milliseconds: worth it for long columns, or when the plan is used again.
        worth = (self._runs > 1 or worth_at_once(self.rows, self.cols)) and _flags_work()
        marks.texts |= self.texts  # what an interpreted chunk finds may take them out again
        marks.dirty |= self.texts
        if not worth or self.lowering is None or not self._as_expected(self.lowering.reads, marks):
            self._interpreted(ev, marks, 0, self.rows)
            return
        if self._code is None:
            self._code, _, self._counts = emit(self.lowering, self.layout, ev.around.arithmetic)
        buffers = self._buffers.pop() if self._buffers else self._new_buffers()
        for start in range(0, self.rows, CHUNK):
            stop = min(start + CHUNK, self.rows)
            if self._suspect(marks) or not self._fast(ev, buffers, start, stop):
                for part in range(start, stop, _PART):
                    self._chunk(ev, marks, buffers, part, min(part + _PART, stop))
        self._buffers.append(buffers)

    def _chunk(self, ev: Evaluator, marks: Marks, buffers: Buffers, start: int, stop: int) -> None:
        """Rows [start, stop): fast as far as everything is plain, interpreted where it is not, in order from the top.

        Where the code stops, the rows are tried again in smaller pieces, so that a few bad ones cost little; after
        three failures the rest is interpreted, so that many cost little more than that.
        """
        step, failures = stop - start, 0
        while start < stop:
            end, plain = self._stretch(ev, marks, start, stop)
            end = min(end, start + step)
            if failures >= _PATIENCE:
                end, plain = stop, False
            if plain and not self._fast(ev, buffers, start, end):
                failures += 1
                if end - start > _PIECE:
                    step = max(_PIECE, step // 8)
                    continue
                plain = False
            if not plain:
                self._interpreted(ev, marks, start, end)
            start = end

    def _fast(self, ev: Evaluator, buffers: Buffers, start: int, stop: int) -> bool:
        if self._code is None:
            return False
        try:
            self._code(ev.numbers, ev.codes, buffers, start, stop)
        except _FAILURES:
            return False
        return True

    def _stretch(self, ev: Evaluator, marks: Marks, start: int, stop: int) -> tuple[int, bool]:
        """How far the rows from `start` on are of one sort, and whether they read numbers only."""
        suspect = self._suspect(marks)
        if not suspect:
            return stop, True
        bad = np.zeros(stop - start, bool)
        for place in suspect:
            bad |= ev.codes[place + start : place + stop] != 0
        rows = np.flatnonzero(bad)
        if not len(rows):
            return stop, True
        if rows[0] >= _GAP:
            return start + int(rows[0]), True
        gaps = np.flatnonzero(np.diff(rows) > _GAP)
        if len(gaps) > _PATIENCE:
            return stop, False
        end = int(rows[gaps[0]] if len(gaps) else rows[-1]) + 1
        return (stop if stop - start - end < _GAP else start + end), False

    @staticmethod
    def _as_expected(reads: Reads, marks: Marks) -> bool:
        """Whether what all rows read is numbers, and texts where texts are expected."""
        return reads.others.isdisjoint(marks.dirty) and reads.texts <= marks.texts

    def _suspect(self, marks: Marks) -> list[int]:
        """Where columns lie that are read row by row and may hold something other than numbers."""
        columns = self.lowering.reads.columns if self.lowering is not None else {}
        return [place for place, producers in columns.items() if not producers.isdisjoint(marks.dirty)]

    def _interpreted(self, ev: Evaluator, marks: Marks, start: int, stop: int) -> None:
        memory = Memory(ev) if self._cells.due() else None
        for member in self.members:
            if memory is None or not self._by_code(member, ev, memory, marks, start, stop):
                marks.note(member.number, member.run(ev, start, stop))

    def _by_code(self, member: Member, ev: Evaluator, memory: Memory, marks: Marks, start: int, stop: int) -> bool:
        """Compute cells one by one, where they are few or the interpreter would do so too; False where code cannot compute
        all of them."""
        if not member.singly and stop - start > _SHORT:
            return False
        number = member.number
        for col in range(self.cols):
            code = self._cells.code(ev, number, member.formula, col)
            first = self.layout.block_offsets[number] + col * self.rows
            for down in range(start, stop):
                if not memory.fill(code, down, first + down):
                    return False
                marks.note_one(number, memory.codes[first + down])
        return True

    def _new_buffers(self) -> Buffers:
        kinds = {"t": np.float64, "b": np.bool_}
        size = min(CHUNK, self.rows)
        return {letter: [np.empty(size, kinds[letter]) for _ in range(count)] for letter, count in self._counts.items()}


@cache
def _flags_work() -> bool:
    """Whether this build of numpy reports what goes wrong in an array; else nothing is computed the fast way."""
    cases = (
        (np.arccos, 2.0), (np.arcsin, -2.0), (np.sqrt, -1.0), (np.log, 0.0), (np.log10, -1.0), (np.exp, 1e3),
        (np.cosh, 1e4), (np.sinh, 1e4), (np.arccosh, 0.5), (np.arctanh, 1.0), (np.square, 1e200),
        (np.reciprocal, 0.0),
    )  # fmt: skip
    with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
        for function, value in cases:
            for size in (1, 9, 64):
                array = np.full(size, 0.5 if function is not np.arccosh else 2.0)
                array[-1] = value
                try:
                    function(array)
                except FloatingPointError:
                    continue
                return False
    return True

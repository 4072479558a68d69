"""Segments: blocks that are computed together, fast where everything is plain numbers, carefully where it is not."""

from __future__ import annotations

from functools import cache, cached_property
from typing import Any

import numpy as np

from ..formula.nodes import Node
from .careful import Evaluator
from .emitting import CHUNK, Code, TroubleError, emit
from .frames import Frame
from .layout import Layout
from .lowering import Lowering, UnsuitableError
from .recurrence import Held, RunningSum, compute
from .values import Cells

_FAILURES = (TroubleError, FloatingPointError, ZeroDivisionError, OverflowError)


class Member:
    """A block of a segment: its formula, and what kind of recurrence it is, if it is one."""

    def __init__(self, layout: Layout, number: int, formula: Node, recurrence: RunningSum | Held | None) -> None:
        self.layout = layout
        self.number = number
        self.formula = formula
        self.recurrence = recurrence
        self.block = layout.blocks[number]

    def run(self, ev: Evaluator, start: int, stop: int) -> bool:
        """Compute rows [start, stop) carefully; whether they hold anything but numbers."""
        block = self.block
        sheet = self.layout.block_sheets[self.number]
        frame = Frame(sheet, block.row + start, block.col, stop - start, block.cols, start)
        found = ev.result(self.formula, frame) if self.recurrence is None else compute(self.recurrence, ev, frame)
        return write(self.layout, self.number, start, stop, found, ev)


def write(layout: Layout, number: int, start: int, stop: int, found: Cells, ev: Evaluator) -> bool:
    """Put the values of a block's rows [start, stop) into the flat array; whether there is anything but numbers."""
    block = layout.blocks[number]
    first = layout.block_offsets[number]
    last = first + block.rows * block.cols
    ev.numbers[first:last].reshape(block.cols, block.rows)[:, start:stop] = found.numbers
    if found.codes is None or not np.any(found.codes):
        return False
    ev.codes[first:last].reshape(block.cols, block.rows)[:, start:stop] = found.codes
    return True


class Segment:
    """Blocks of the same height in their order, and the code that computes them when all is well."""

    def __init__(self, layout: Layout, first: Member, lowering: Lowering | None) -> None:
        self.layout = layout
        self.members = [first]
        self.lowering = lowering
        self.rows = first.block.rows
        self.cols = first.block.cols
        self.chunk = max(256, CHUNK // self.cols)
        self._code: Code | None = None
        self._buffers: list[dict[str, Any]] = []
        self._counts: dict[str, int] = {}
        self._runs = 0

    def joined(self, member: Member) -> bool:
        """Take a block in, if the fast path can compute it together with the others."""
        if self.lowering is None:
            return False
        try:
            self.lowering.add(member.number, member.formula, member.recurrence)
        except UnsuitableError:
            return False
        self.members.append(member)
        return True

    @cached_property
    def texts(self) -> set[int]:
        """The members that the fast path fills with a text."""
        if self.lowering is None:
            return set()
        values, results = self.lowering.values, self.lowering.results
        return {number for number, result in results.items() if values[result].kind == "text"}

    @cached_property
    def inputs(self) -> frozenset[int]:
        """Everything read, by what fills it."""
        if self.lowering is None:
            return frozenset()
        return frozenset(self.lowering.reads.others.union(*self.lowering.reads.columns.values()))

    def run(self, ev: Evaluator, dirty: set[int]) -> None:
        """Compute all cells. `dirty` holds what does not consist of numbers alone, and is added to."""
        self._runs += 1
        # Making the code costs some milliseconds: worth it for long columns, or when the plan is used again.
        worth = self.lowering is not None and (self._runs > 1 or self.rows * self.cols >= 4 * CHUNK) and _flags_work()
        if not worth or self.lowering is None or self.lowering.reads.others & dirty:
            self._carefully(ev, dirty, 0, self.rows)
            return
        if self._code is None:
            self._code, _, self._counts = emit(self.lowering, self.layout)
        buffers = self._buffers.pop() if self._buffers else self._new_buffers()
        suspect = self._suspect(dirty)
        for start in range(0, self.rows, self.chunk):
            stop = min(start + self.chunk, self.rows)
            if any(ev.codes[place + start : place + stop].any() for place in suspect):
                self._carefully(ev, dirty, start, stop)
                suspect = self._suspect(dirty)
                continue
            try:
                self._code(ev.numbers, ev.codes, buffers, start, stop)
            except _FAILURES:
                self._carefully(ev, dirty, start, stop)
                suspect = self._suspect(dirty)
        dirty |= self.texts
        self._buffers.append(buffers)

    def _suspect(self, dirty: set[int]) -> list[int]:
        """Where columns lie that are read and may hold something other than numbers."""
        if self.lowering is None or self.inputs.isdisjoint(dirty):
            return []
        return [place for place, producers in self.lowering.reads.columns.items() if not producers.isdisjoint(dirty)]

    def _carefully(self, ev: Evaluator, dirty: set[int], start: int, stop: int) -> None:
        for member in self.members:
            if member.run(ev, start, stop):
                dirty.add(member.number)

    def _new_buffers(self) -> dict[str, Any]:
        size = {"t": self.chunk, "b": self.chunk, "w": self.chunk * self.cols, "v": self.chunk * self.cols}
        kinds = {"t": np.float64, "b": np.bool_, "w": np.float64, "v": np.bool_}
        return {
            letter: [np.empty(size[letter], kinds[letter]) for _ in range(count)]
            for letter, count in self._counts.items()
        }


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

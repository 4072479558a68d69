"""The values of a plan kept while inputs change: a change is noted at once, and computed when a value is asked for, no
further than that value needs."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from itertools import compress
from math import copysign
from typing import Any

import numpy as np

from ..diagnostics import Fault
from ..formula.nodes import Scalar
from ..time_limit import check_time
from .graph import reads_area
from .interpreter.evaluator import Evaluator
from .layout import Area
from .plan import Plan
from .results import Values
from .values.cells import NUMBER, TEXT, Cells, Texts

MOST_TEXTS = 1 << 20
"""Texts that computed cells may leave behind before everything is computed anew without them."""

_MOST_COMPARED = 1024
"""Cells of a step that are compared with what they were: of more, that takes about as long as computing what reads them."""

_MOST_KNOWN = 4096
"""Sets of steps whose order is remembered: a loop over a few inputs and outputs has a handful."""

Cell = tuple[int, int, int]
"""(sheet's index, row, column)"""


class Live:
    """One set of values of a plan.

    After any number of `set` and `reset`, the values are those of `Plan.evaluate` with the same cells replaced, to the last
    bit: the same steps have run in the same order, over the same kinds of values.
    """

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.inputs: dict[Cell, Scalar] = {}
        self._step_of: dict[int, int] = {}
        self._reads: list[set[int]] = []
        self._readers: dict[int, list[int]] = {}
        # Sets of steps are the bits of one number each.
        self._depending: dict[Cell, tuple[int, int]] = {}
        self._needed: dict[Area, int] = {}
        self._orders: dict[int, tuple[int, ...]] = {}
        self._outputs: dict[int, _Output | None] = {}
        # What may have other values since an input changed, and what must, as something that it reads does.
        self._stale = 0
        self._touched = 0
        self._take_in()
        self._start()

    def _take_in(self) -> None:
        """Note the steps that the plan has reached since: nothing of them is computed yet."""
        plan, known = self.plan, len(self._reads)
        for index, step in enumerate(plan.steps[known:], known):
            self._step_of.update(dict.fromkeys(step.producers, index))
            self._reads.append(set[int]().union(*(plan.reads[number] for number in step.producers)))
            for producer in self._reads[index]:
                self._readers.setdefault(producer, []).append(index)
        if len(plan.steps) > known:
            new = (1 << len(plan.steps)) - (1 << known)
            self._stale |= new
            self._touched |= new
            self._depending.clear()

    def _reach(self, producers: Iterable[int]) -> None:
        """Have the plan make ready what fills some cells."""
        self.plan.reach(producers)
        if not self.plan.settles:
            self._take_in()

    def _start(self) -> None:
        """New arrays with the inputs as they are, and nothing computed yet."""
        layout = self.plan.layout
        self.numbers, self.codes = layout.filled()
        self.texts = Texts(layout.texts)
        self._marks = self.plan.marks.copy()
        self._set_codes: dict[int, dict[Cell, int]] = {}
        self._evaluator = Evaluator(layout, self.numbers, self.codes, self.texts, self.plan.environment())
        self._settled: Values | None = None
        self._most_texts = len(self.texts) + MOST_TEXTS
        self._stale = self._touched = (1 << len(self.plan.steps)) - 1
        self._remarks: dict[int, tuple[Fault, ...]] = {}
        for cell, value in self.inputs.items():
            self._enter(cell, value)

    # inputs

    def holds_constant(self, cell: Cell) -> bool:
        """Whether a cell can be set: it holds a constant, neither a formula nor nothing."""
        return self._constant(cell) >= len(self.plan.layout.blocks)

    def set(self, cell: Cell, value: Scalar) -> None:
        """Put a value into a cell that holds a constant; None empties it."""
        self.inputs[cell] = value
        self._enter(cell, value)

    def _enter(self, cell: Cell, value: Scalar) -> None:
        producer = self._constant(cell)
        number, code = self.texts.encode(value)
        self._set_codes.setdefault(producer, {})[cell] = code
        self._put(cell, producer, number, code)

    def reset(self, cell: Cell) -> None:
        """Give a cell the value back that it has in the book."""
        if cell not in self.inputs:
            return
        del self.inputs[cell]
        producer = self._constant(cell)
        del self._set_codes[producer][cell]
        run = self.plan.layout.constants[producer - len(self.plan.layout.blocks)]
        down = cell[1] - run.row
        self._put(cell, producer, float(run.numbers[down]), NUMBER if run.codes is None else int(run.codes[down]))

    def _constant(self, cell: Cell) -> int:
        """The number of the producer that fills a cell, -1 for an empty cell."""
        if self.plan.layout.place(*cell) < 0:
            return -1
        return next(iter(self.plan.layout.producers(Area(*cell, 1, 1))))

    def _put(self, cell: Cell, producer: int, number: float, code: int) -> None:
        """Write a constant, note what kinds its producer now holds, and what must be computed again."""
        place = self.plan.layout.place(*cell)
        before = float(self.numbers[place])
        changed = code != self.codes[place] or number != before or copysign(1, number) != copysign(1, before)
        self.numbers[place], self.codes[place] = number, code
        # The marks are those that `Plan.evaluate` would start from.
        codes = self._set_codes.get(producer, {}).values()
        marks, book = self._marks, self.plan.marks
        _mark(marks.dirty, producer, producer in book.dirty or any(codes))
        _mark(marks.texts, producer, producer in book.texts and all(kind == TEXT for kind in codes))
        if changed and self.plan.settles:
            self._stale, self._settled = 1, None
        elif changed:
            reading, after = self._steps_after(cell, producer)
            self._touched |= reading
            self._stale |= after

    def _steps_after(self, cell: Cell, producer: int) -> tuple[int, int]:
        """The steps that read a constant, and these with all that depend on them, at any remove."""
        found = self._depending.get(cell)
        if found is None:
            plan, area = self.plan, Area(*cell, 1, 1)
            reading = {
                step
                for step in self._readers.get(producer, ())
                if any(
                    reads_area(plan.layout, number, plan.formulas[number], plan.resolved.functions, area)
                    for number in plan.steps[step].producers
                    if producer in plan.reads[number]
                )
            }
            seen: set[int] = set()
            waiting = list(reading)
            while waiting:
                step = waiting.pop()
                if step not in seen:
                    seen.add(step)
                    for number in plan.steps[step].producers:
                        waiting += self._readers.get(number, ())
            found = self._depending[cell] = _bits(reading, len(plan.steps)), _bits(seen, len(plan.steps))
        return found

    # values

    def asked(self) -> Asked:
        """Values that are computed when they are asked for; after a change they are those after the change."""
        return Asked(self)

    def values(self) -> Values:
        """All values, brought up to date. They are these arrays, not a copy: they change with the next change."""
        self._reach(range(len(self.plan.layout.blocks)))
        if self.plan.settles:
            return self._settle()
        self._run(self._stale)
        return Values(self.plan.layout, self.numbers, self.codes, self.texts, self.remarks)

    @property
    def remarks(self) -> tuple[Fault, ...]:
        """What is not as it is meant in the cells computed so far."""
        if self._settled is not None:
            return self._settled.remarks
        found = dict.fromkeys(self.plan.remarks)
        for _, remarks in sorted(self._remarks.items()):
            found |= dict.fromkeys(remarks)
        return tuple(found)

    def _settle(self) -> Values:
        """All values of a book in which order or sizes depend on values: computed as a whole."""
        if self._settled is None:
            titles = self.plan.layout.titles
            inputs = {(titles[sheet], row, col): value for (sheet, row, col), value in self.inputs.items()}
            self._settled = self.plan.evaluate(inputs)
            self.texts = self._settled.texts
        return self._settled

    def read(self, area: Area) -> Cells:
        """The cells of an area, shape (cols, rows), after computing what they need; a view where they lie side by side."""
        needed = self._needed.get(area)
        if needed is None:
            self._reach(self.plan.layout.producers(area))
            needed = self._steps_before(area)
            if len(self._needed) < _MOST_KNOWN:
                self._needed[area] = needed
        if self.plan.settles:
            return self._settle().read(area)
        self._run(self._stale & needed)
        return self.plan.layout.read(area, self.numbers, self.codes)

    def _steps_before(self, area: Area) -> int:
        """The steps that an area's values need, at any remove."""
        seen: set[int] = set()
        waiting = [self._step_of[n] for n in self.plan.layout.producers(area) if n in self._step_of]
        while waiting:
            step = waiting.pop()
            if step not in seen:
                seen.add(step)
                waiting += [self._step_of[n] for n in self._reads[step] if n in self._step_of]
        return _bits(seen, len(self.plan.steps))

    def _run(self, todo: int) -> None:
        """Compute steps in their order, but those that read the same as the last time. When one fails, all of them stay to
        be done."""
        if not todo:
            return
        if len(self.texts) > self._most_texts:
            self._start()
            todo = self._stale
        order = self._orders.get(todo)
        if order is None:
            order = tuple(index for index, bit in enumerate(reversed(f"{todo:b}")) if bit == "1")
            if len(self._orders) < _MOST_KNOWN:
                self._orders[todo] = order
        self._evaluator.around.budget.called = 0
        try:
            with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
                for index in order:
                    if self._touched >> index & 1:
                        check_time()
                        self._compute(index)
        except BaseException:
            self._touched |= todo
            raise
        self._stale &= ~todo
        self._touched &= ~todo

    def _compute(self, index: int) -> None:
        """Compute a step, and note which steps read what has another value now."""
        step, marks, layout, around = self.plan.steps[index], self._marks, self.plan.layout, self._evaluator.around
        output = self._output(index)
        before = None if output is None else output.values(self)
        for number in step.producers:
            if number in marks.dirty:
                block, start = layout.blocks[number], layout.block_offsets[number]
                self.codes[start : start + block.rows * block.cols] = NUMBER
                marks.dirty.discard(number)
                marks.texts.discard(number)
        around.remarks.clear()
        step.run(self._evaluator, marks)
        if around.remarks:
            self._remarks[index] = tuple(around.remarks)
        elif index in self._remarks:
            del self._remarks[index]
        changed = step.producers if output is None or before is None else output.changed(self, before)
        for number in changed:
            for reader in self._readers.get(number, ()):
                self._touched |= 1 << reader

    def _output(self, index: int) -> _Output | None:
        """The cells of a step, None of one with very many."""
        if index not in self._outputs:
            layout, producers = self.plan.layout, self.plan.steps[index].producers
            sizes = [layout.blocks[number].rows * layout.blocks[number].cols for number in producers]
            few = sum(sizes) <= _MOST_COMPARED
            starts = [layout.block_offsets[number] for number in producers]
            self._outputs[index] = _Output(producers, starts, sizes) if few else None
        return self._outputs[index]


class _Output:
    """The cells of a step, by the blocks that they are of."""

    def __init__(self, producers: Sequence[int], starts: Sequence[int], sizes: Sequence[int]) -> None:
        self.producers = producers
        self.lone = slice(starts[0], starts[0] + sizes[0]) if len(producers) == 1 else None
        self.cells = np.concatenate([np.arange(at, at + size) for at, size in zip(starts, sizes, strict=True)])
        self.firsts = np.cumsum([0, *sizes[:-1]])

    def values(self, live: Live) -> tuple[Any, Any]:
        """Their values to the last bit, and what kinds they are."""
        if self.lone is not None:  # as most steps are; bytes are compared in a fifth of the time
            return live.numbers[self.lone].tobytes(), live.codes[self.lone].tobytes()
        return live.numbers.view(np.int64)[self.cells], live.codes[self.cells]

    def changed(self, live: Live, before: tuple[Any, Any]) -> Sequence[int]:
        """The blocks in which a cell is not what it was `before`."""
        numbers, codes = self.values(live)
        if self.lone is not None:
            return self.producers if (numbers, codes) != before else ()
        other = (numbers != before[0]) | (codes != before[1])
        return list(compress(self.producers, np.logical_or.reduceat(other, self.firsts).tolist()))


class Asked(Values):
    """What the cells of a book show, each computed when it is asked for. `remarks` are those of what has been computed."""

    def __init__(self, live: Live) -> None:
        super().__init__(live.plan.layout, live.numbers, live.codes, live.texts)
        self._live = live

    def get(self, sheet: str, row: int, col: int) -> Scalar:
        """A cell's value, None when it is empty. Raises KeyError for a sheet that does not exist."""
        return self.column(sheet, col, row, row)[0]

    def read(self, area: Area) -> Cells:
        """The cells of an area, shape (cols, rows)."""
        found = self._live.read(area)
        self.texts, self.remarks = self._live.texts, self._live.remarks
        return found


def _mark(marks: set[int], producer: int, marked: bool) -> None:
    if marked:
        marks.add(producer)
    else:
        marks.discard(producer)


def _bits(steps: set[int], count: int) -> int:
    """A set of step numbers below `count` as the bits of one number."""
    bits = bytearray(count // 8 + 1)
    for step in steps:
        bits[step >> 3] |= 1 << (step & 7)
    return int.from_bytes(bits, "little")

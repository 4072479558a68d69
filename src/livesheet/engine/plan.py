"""A book made ready for evaluation once, and evaluated as often as one likes."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from copy import copy
from dataclasses import replace

import numpy as np

from ..diagnostics import Fault
from ..formula.book import Block, Book, BookSheet, CellStore
from ..formula.nodes import Missing, Node, Scalar
from ..said import say
from ..time_limit import check_time
from .graph import dependents, producers_read
from .interpreter.environment import Environment
from .interpreter.evaluator import Evaluator
from .kernels.math import FAST, Arithmetic
from .layout import Area, make_layout
from .ordering.dynamic_order import Sizes, TangledError, drive, fitting, sizes_of, with_sizes
from .ordering.schedule import Special, Step, schedule
from .resolve import Resolver
from .results import Marks, Values, marks_of_constants
from .values.cells import Texts, error_code

_MOST_PASSES = 64
_MOST_RESIZED = 16
"""Plans with other sizes of dynamic arrays that are kept."""

Overrides = Mapping[tuple[str, int, int], Scalar]
"""(sheet's title, row, column) -> what to put there instead."""


def compile_book(book: Book, arithmetic: Arithmetic = FAST) -> Plan:
    """Make a book ready, all of it. Raises WorkbookError for cells filled twice."""
    return Plan(book, arithmetic=arithmetic).complete()


def evaluate(book: Book, overrides: Overrides | None = None, arithmetic: Arithmetic = FAST) -> Values:
    """All values of a book, with some cells' contents replaced. To do so many times, keep `compile_book`'s plan.

    With `PORTABLE` arithmetic their bits are the same on every machine.
    """
    return Plan(book, once=True, arithmetic=arithmetic).evaluate(overrides)


def steady_plan(book: Book) -> Plan:
    """A plan for one evaluation in which NOW, TODAY, RAND and their like keep the values stored in the file."""
    return Plan(book, once=True, steady=True).complete()


class Plan:
    """A book with its cells laid out, the formulas reached so far resolved and their order found.

    A new plan has reached none. Whoever needs some cells reaches what they need; `complete` reaches all.
    """

    def __init__(
        self,
        book: Book,
        once: bool = False,
        blocked: frozenset[int] = frozenset(),
        steady: bool = False,
        arithmetic: Arithmetic = FAST,
    ) -> None:
        self.book = book
        self.once = once
        self.steady = steady
        self.arithmetic = arithmetic
        self.layout = make_layout(book)
        self.resolver = Resolver(book, steady)
        self.resolved = self.resolver.found
        self.blocked = blocked
        self.sizes = sizes_of(self.layout, blocked)
        self.marks = marks_of_constants(self.layout)
        count = len(self.layout.blocks)
        self.formulas: list[Node] = [Missing()] * count
        self.reads: list[set[int]] = [set() for _ in range(count)]
        self.steps: list[Step] = []
        self._reached: set[int] = set()
        self._texts = set(self.marks.texts)
        self._replaced: dict[frozenset[tuple[int, int, int]], Plan] = {}
        self._resized: dict[Sizes, Plan] = {}

    @property
    def remarks(self) -> tuple[Fault, ...]:
        """What is not as it is meant in the formulas reached, with their cells: unknown functions and names, references to
        other workbooks, volatile functions (circles and the like are found by each evaluation: `Values.remarks`)."""
        return tuple(self.resolved.remarks)

    @property
    def settles(self) -> bool:
        """Whether order or sizes depend on values (OFFSET, INDIRECT, dynamic arrays): then each evaluation finds them.

        Formulas that have not been reached do not count; where one that has does, all are reached.
        """
        return bool(self.resolved.moving or self.sizes)

    def complete(self) -> Plan:
        """This plan with all formulas reached."""
        self.reach(range(len(self.layout.blocks)))
        return self

    def reach(self, producers: Iterable[int]) -> None:
        """Make ready the blocks among some producers, and all that they read; where order depends on values, all blocks."""
        if len(self._reached) == len(self.layout.blocks):
            return
        found = self._resolved_from(producers)
        if found and self.settles:
            self._resolved_from(range(len(self.layout.blocks)))
            self._schedule_anew()
        elif found:
            self.steps += self._scheduled(found)

    def _resolved_from(self, producers: Iterable[int]) -> set[int]:
        """The blocks among some producers and all that they read, without those reached before; their formulas resolved."""
        found: set[int] = set()
        waiting = list(producers)
        for number in waiting:  # which grows
            if number >= len(self.layout.blocks) or number in self._reached:
                continue
            found.add(number)
            self._reached.add(number)
            title = self.layout.titles[self.layout.block_sheets[number]]
            self.formulas[number] = formula = self.resolver.formula(number, self.layout.blocks[number], title)
            if number not in self.resolved.kept:
                self.reads[number] = producers_read(self.layout, number, formula, self.resolved.functions)
                waiting += self.reads[number]
        return found

    def _schedule_anew(self) -> None:
        """The order of all blocks."""
        self._texts = set(self.marks.texts)
        self.steps = self._scheduled(range(len(self.layout.blocks)))

    def _scheduled(self, blocks: Collection[int]) -> list[Step]:
        moving = self.resolved.moving
        special = Special(
            self.resolved.functions,
            {number: self._cached(number) for number in self.resolved.kept},
            self.blocked,
            frozenset(dependents(moving, self.reads)) if moving else frozenset(),
            self._texts,
            self.once,
        )
        return schedule(self.layout, self.formulas, self.reads, special, blocks)

    def _cached(self, number: int) -> tuple[CellStore, int]:
        """What a block that keeps its stored values has, and what it shows where there is none."""
        cached = self.book.sheets[self.layout.block_sheets[number]].cached
        return cached, error_code(self.resolved.kept[number])

    def unsure(self) -> tuple[frozenset[int], frozenset[int]]:
        """The blocks whose values the workbook alone does not say, and these with all that depend on them.

        Blocks are counted through the sheets of the book.
        """
        own = self.resolved.kept.keys() | self.resolved.unsteady
        return frozenset(own), frozenset(dependents(own, self.reads))

    def evaluate(self, overrides: Overrides | None = None) -> Values:
        """All values, with some cells' contents replaced by constants (`None` empties a cell).

        Raises KeyError for a sheet that does not exist.
        """
        places = self._places(overrides or {})
        structural = [cell for cell, (_, producer) in places.items() if producer < len(self.layout.blocks)]
        if structural:
            return self.with_constants_in(frozenset(structural)).evaluate(overrides)
        if self.complete().settles:
            return _settled(self, overrides or {})
        ev, marks = self.begin(overrides or {})
        with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
            for step in self.steps:
                check_time()
                step.run(ev, marks)
        return self.values_of(ev)

    def begin(self, overrides: Overrides) -> tuple[Evaluator, Marks]:
        """An evaluator with all constants in their places and nothing computed yet."""
        numbers, codes = self.layout.filled()
        texts = Texts(self.layout.texts)
        marks = self.marks.copy()
        places = self._places(overrides)
        for cell, value in overrides.items():
            place, producer = places[self._cell(cell)]
            numbers[place], codes[place] = texts.encode(value)
            marks.note(producer, codes[place : place + 1])
        return Evaluator(self.layout, numbers, codes, texts, self.environment()), marks

    def environment(self) -> Environment:
        """What an evaluation knows of the book."""
        return Environment(
            self.book,
            self.resolved.functions,
            self.resolver.reference,
            arithmetic=self.arithmetic,
        )

    def values_of(self, ev: Evaluator) -> Values:
        """The values that an evaluator has computed, with what it remarked."""
        remarks = (*self.remarks, *ev.around.remarks)
        return Values(self.layout, ev.numbers, ev.codes, ev.texts, remarks, ev.around.kept)

    def is_constant(self, cell: tuple[str, int, int]) -> bool:
        """Whether a constant stands in a cell."""
        place, producer = self._places({cell: None})[self._cell(cell)]
        return place >= 0 and producer >= len(self.layout.blocks)

    def learn(self, reads: Sequence[tuple[int, int]]) -> None:
        """Take note of (reader, what it reads) that turned up while computing, and find the order again."""
        if all(producer in self.reads[reader] for reader, producer in reads):
            raise RuntimeError("blocks that need each other are computed apart")
        for reader, producer in reads:
            self.reads[reader].add(producer)
        self._schedule_anew()

    def resized(self, sizes: Sizes) -> Plan:
        """The plan of this book with dynamic arrays of other sizes."""
        if sizes == self.sizes:
            return self
        if sizes not in self._resized:
            if len(self._resized) >= _MOST_RESIZED:
                self._resized.clear()
            book = copy(self.book)
            book.sheets = with_sizes(self.book.sheets, sizes)
            blocked = frozenset(number for number, _, _, blocked in sizes if blocked)
            self._resized[sizes] = Plan(book, self.once, blocked, self.steady, self.arithmetic).complete()
        return self._resized[sizes]

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
            self._replaced[cells] = Plan(book, self.once, steady=self.steady, arithmetic=self.arithmetic).complete()
        return self._replaced[cells]


def _settled(plan: Plan, overrides: Overrides) -> Values:
    """All values, when all steps had what they need and all dynamic arrays have their sizes."""
    first = plan
    for _ in range(_MOST_PASSES):
        ev = _driven(plan, overrides)
        sizes = fitting(ev)
        if sizes == plan.sizes:
            return plan.values_of(ev)
        plan = first.resized(sizes)
    ev = _driven(plan, overrides)
    number = plan.sizes[0][0]
    block = plan.layout.blocks[number]
    ev.around.remark(
        say("dynamic arrays whose sizes do not settle"), plan.layout.block_sheets[number], block.row, block.col
    )
    return plan.values_of(ev)


def _driven(plan: Plan, overrides: Overrides) -> Evaluator:
    """An evaluator that has run all steps. The plan learns of blocks that turn out to need each other: finitely many."""
    while True:
        ev, marks = plan.begin(_present(plan, overrides))
        try:
            with np.errstate(divide="raise", over="raise", invalid="raise", under="ignore"):
                drive(plan.steps, plan.reads, ev, marks)
        except TangledError as tangle:
            plan.learn(tangle.reads)
        else:
            return ev


def _present(plan: Plan, overrides: Overrides) -> Overrides:
    """Without the cells that were emptied and are no constants here: a dynamic array has grown over them."""
    if all(value is not None for value in overrides.values()):
        return overrides
    return {cell: value for cell, value in overrides.items() if value is not None or plan.is_constant(cell)}


def _replaced(sheet: BookSheet, cells: Sequence[tuple[int, int]]) -> BookSheet:
    """The sheet with blanks in `cells`, and the blocks that held them in pieces around them."""
    if not cells:
        return sheet
    blocks = list(sheet.blocks)
    constants = sheet.constants.copy()
    for row, col in cells:
        blocks = [part for block in blocks for part in _around(block, row, col)]
        constants.put(row, col, None)
    return replace(sheet, constants=constants, blocks=blocks)


def _around(block: Block, row: int, col: int) -> list[Block]:
    """The parts of a block around one cell: above, left, right, below."""
    down, right = row - block.row, col - block.col
    if not (0 <= down < block.rows and 0 <= right < block.cols):
        return [block]
    if block.kind != "fill":
        # The first cell takes the whole array with it; a constant elsewhere stands in the way of a dynamic array.
        spill = block.kind == "spill" and (down or right)
        return [Block(block.row, block.col, 1, 1, block.formula, "spill")] if spill else []
    return block.around(down, right)

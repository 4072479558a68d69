"""Many formulas tried in one place at once: what would the columns that depend on it be with each of them?

The cells that depend on the changed formula are laid out side by side, once for each candidate, on sheets of one small
book, which the engine computes in one go; everything else stands in it as numbers.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import cast

import numpy as np

from livesheet.engine import evaluate
from livesheet.engine.layout import Area
from livesheet.engine.values.cells import NUMBER
from livesheet.formula.book import Book, BookSheet
from livesheet.formula.nodes import (
    Call,
    CellRef,
    Foreign,
    NameRef,
    Node,
    RangeRef,
    SheetsRef,
    TableRef,
    children,
    rebuilt,
    walk,
)
from mechsheet.homework.expected_values import Array
from mechsheet.homework.formula_strips import Place
from mechsheet.homework.series import Graph, Series
from mechsheet.library.routines import routine_names

MOST_AT_ONCE = 1500
OF_ONE = 600
"""What a candidate costs besides its cells, in cells."""
OF_NODE = 20
"""What each node of a function that it calls costs, in cells: one of a textbook's routines has some hundred."""
PLACED = frozenset(("OFFSET", "INDIRECT", "CELL", "FORMULATEXT"))
TURNED = frozenset(
    ("ROW", "COLUMN", "INDEX", "VLOOKUP", "HLOOKUP", "MATCH", "LOOKUP", "ROWS", "COLUMNS", "TRANSPOSE", "MMULT")
)
"""Functions that mean another thing on a sheet laid out anew: always, and where rows and columns were exchanged."""
_MOST_LINES = 16


class UntriableError(Exception):
    """A formula that cannot be computed outside of its workbook."""


@dataclass
class Effort:
    """What may still be spent on one workbook, in cells computed: time would give other marks on another machine."""

    left: float = 8e6

    def spend(self, cells: float) -> None:
        """Take from what is left."""
        self.left -= cells

    @property
    def spent(self) -> bool:
        """Whether nothing is left."""
        return self.left <= 0


@dataclass(frozen=True, slots=True)
class Trial:
    """Tries formulas for strips of one workbook."""

    graph: Graph
    effort: Effort

    def columns(self, number: int, candidates: Sequence[Node], goals: Sequence[Series]) -> list[Array]:
        """For each goal an array (candidates, rows): its numbers with each candidate in place of a strip's bound formula.

        NaN stands for candidates for which nothing is left to be spent.

        Raises UntriableError.
        """
        last = {strip for goal in goals for strip in goal.strips(self.graph.work)}
        affected = self.graph.below({number}) & (self.graph.above(last) | {number})
        cells = sum(self.graph.work.strips[index].length for index in affected)
        one = (
            OF_ONE + cells + OF_NODE * self._called(candidates[0])
        )  # all are changes of one formula, and about as long
        found = [np.full((len(candidates), goal.rows), np.nan) for goal in goals]
        first = 0
        while first < len(candidates) and not self.effort.spent:
            end = min(len(candidates), first + MOST_AT_ONCE, first + math.ceil(self.effort.left / one))
            self.effort.spend((end - first) * one)
            book = _Book(self.graph, affected, end - first)
            book.candidates(number, candidates[first:end])
            book.follow(affected - {number})
            for numbers, part in zip(found, book.computed(goals), strict=True):
                numbers[first:end] = part
            first = end
        return found

    def _called(self, formula: Node) -> int:
        """How many nodes the functions have that a formula calls by name, and those that they call."""
        bodies = {each.name.casefold(): each.formula for each in routine_names(self.graph.work.book)}
        nodes, rest = 0, [formula]
        while rest:
            for part in walk(rest.pop()):
                nodes += 1
                if isinstance(part, Call) and part.name.casefold() in bodies:
                    rest.append(bodies.pop(part.name.casefold()))
        return nodes - sum(1 for _ in walk(formula))


@dataclass
class _Book:
    """The small book: a sheet for each line with affected cells, and sheets of numbers as they are."""

    graph: Graph
    affected: set[int]
    count: int
    cells: dict[tuple[str, int], set[int]] = field(default_factory=dict)
    sheets: dict[tuple[str, int], BookSheet] = field(default_factory=dict)
    given: dict[str, BookSheet] = field(default_factory=dict)
    known: set[Place] = field(default_factory=set)
    kept: set[Place] = field(default_factory=set)

    def __post_init__(self) -> None:
        for index in sorted(self.affected):
            strip = self.graph.work.strips[index]
            line = strip.sheet, strip.line
            self.cells.setdefault(line, set()).update(range(strip.start, strip.end))
            self.sheets.setdefault(line, BookSheet(f"t{len(self.sheets)}"))

    def follow(self, indices: Iterable[int]) -> None:
        """Strips that depend on the candidates: the same formula beside each."""
        for index in sorted(indices):
            strip = self.graph.work.strips[index]
            placed = self._placed(self.graph.formulas[index], strip.length, 0)
            self.sheets[strip.sheet, strip.line].block(strip.start, 0, strip.length, self.count, placed)

    def candidates(self, number: int, candidates: Sequence[Node]) -> None:
        """The candidates themselves, one beside the other."""
        work = self.graph.work
        strip = work.strips[number]
        sheet = self.sheets[strip.sheet, strip.line]
        for column, candidate in enumerate(candidates):
            formula = self._placed(candidate, strip.length, column)
            sheet.block(strip.start, column, strip.length, 1, formula)

    def _placed(self, formula: Node, length: int, column: int) -> Node:
        """A bound formula with references into the small book; `column`: where it stands there."""

        def area(start: CellRef, end: CellRef) -> list[Node]:
            sheet = self.graph.titles.get((start.sheet or "").casefold())
            if sheet is None or not start.col <= end.col < start.col + _MOST_LINES:
                raise UntriableError
            low = min(start.row, end.row)
            high = max(one.row if one.row_abs else one.row + length - 1 for one in (start, end))
            last = max(low, self.graph.work.ends[sheet] - 1)
            if high > last:  # of a whole column what is there
                high = last
                end = replace(end, row=min(end.row, last)) if start is not end else end
            lines = [self._line(sheet, line, low, high) for line in range(start.col, end.col + 1)]
            if not any(moves for moves, _ in lines):
                return [
                    _joined(
                        replace(start, sheet=lines[0][1], col_abs=True), replace(end, sheet=lines[0][1], col_abs=True)
                    )
                ]
            return [
                _joined(*(self._cell(one, start.col + offset, moves, title, column) for one in (start, end)))
                for offset, (moves, title) in enumerate(lines)
            ]

        def change(part: Node) -> Node:
            if isinstance(part, Call):
                if part.name in PLACED or (part.name in TURNED and self.graph.work.across):
                    raise UntriableError
                return Call(part.name, tuple(one for arg in part.args for one in _spread(arg)))
            if isinstance(part, NameRef | Foreign | SheetsRef | TableRef):
                raise UntriableError
            return part

        def _spread(arg: Node) -> list[Node]:
            return list(arg.items) if isinstance(arg, _Spread) else [arg]

        return _rewritten(formula, area, change)

    def _line(self, sheet: str, line: int, low: int, high: int) -> tuple[bool, str]:
        """(whether candidates differ there, the sheet to read) for positions low to high of a line."""
        work = self.graph.work
        moving = self.cells.get((sheet, line), set())
        if moving.isdisjoint(range(low, high + 1)):
            held = self.given.setdefault(sheet, BookSheet(f"g{len(self.given)}"))
            for pos in range(low, high + 1):
                if (sheet, pos, line) not in self.known:
                    self.known.add((sheet, pos, line))
                    held.constant(pos, line, work.value((sheet, pos, line)))
            return False, held.title
        for pos in range(low, high + 1):
            if pos not in moving:
                self.keep((sheet, pos, line))
        return True, self.sheets[sheet, line].title

    def keep(self, place: Place) -> None:
        """A cell of an affected line that no candidate changes."""
        if place in self.kept:
            return
        self.kept.add(place)
        value = self.graph.work.value(place)
        if value is not None:
            sheet = self.sheets[place[0], place[2]]
            for column in range(self.count):
                sheet.constant(place[1], column, value)

    @staticmethod
    def _cell(cell: CellRef, line: int, moves: bool, title: str, column: int) -> CellRef:
        if moves:
            return CellRef(cell.row, column, cell.row_abs, False, title)
        return CellRef(cell.row, line, cell.row_abs, True, title)

    def computed(self, goals: Sequence[Series]) -> list[Array]:
        """The goals' numbers."""
        work = self.graph.work
        found: list[Array] = []
        lines = list(self.sheets)
        values = evaluate(Book([*self.sheets.values(), *self.given.values()], routine_names(work.book)))
        for goal in goals:
            line = goal.sheet, goal.line
            column = goal.column(work)
            columns = np.broadcast_to(column, (self.count, goal.rows)).copy()
            moving = self.cells.get(line, set())
            if moving:
                cells = values.read(Area(lines.index(line), goal.origin, 0, goal.rows, self.count))
                numbers = np.array(np.broadcast_to(cells.numbers, (self.count, goal.rows)))
                if cells.codes is not None:
                    numbers[np.broadcast_to(cells.codes, numbers.shape) != NUMBER] = np.nan
                own = [row for row in range(goal.rows) if goal.origin + row in moving]
                columns[:, own] = numbers[:, own]
            found.append(columns)
        return found


@dataclass(frozen=True, slots=True)
class _Spread:
    """Several areas in place of one argument."""

    items: tuple[Node, ...]


def _joined(start: CellRef, end: CellRef) -> Node:
    return start if start == end else RangeRef(start, end)


def _rewritten(formula: Node, area: Callable[[CellRef, CellRef], list[Node]], change: Callable[[Node], Node]) -> Node:
    """A tree with its areas and its other nodes rewritten; ranges are taken whole, before their corners."""
    if isinstance(formula, CellRef):
        return area(formula, formula)[0]
    if isinstance(formula, RangeRef):
        if not isinstance(formula.start, CellRef) or not isinstance(formula.end, CellRef):
            raise UntriableError
        items = area(formula.start, formula.end)
        return items[0] if len(items) == 1 else cast("Node", _Spread(tuple(items)))
    below = tuple(_rewritten(part, area, change) for part in children(formula))
    if not isinstance(formula, Call) and any(isinstance(part, _Spread) for part in below):
        raise UntriableError
    return change(rebuilt(formula, below) if below else formula)

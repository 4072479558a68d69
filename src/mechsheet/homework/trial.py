"""Many formulas tried in one place at once: what would the columns that depend on it be with each of them?

The cells that depend on the changed formula are laid out side by side, once for each candidate, on sheets of one small
book, which the engine computes in one go; everything else stands in it as numbers.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field, replace
from typing import cast

import numpy as np

from mechsheet.engine import evaluate
from mechsheet.engine.interpreter.evaluator import Evaluator
from mechsheet.engine.layout import Area
from mechsheet.engine.values.cells import NUMBER, Cells
from mechsheet.engine.values.frames import Frame
from mechsheet.formula.book import Book, BookSheet
from mechsheet.formula.functions import FUNCTIONS
from mechsheet.formula.nodes import (
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    Foreign,
    NameRef,
    Node,
    Number,
    RangeRef,
    SheetsRef,
    TableRef,
    Text,
    Unary,
    calls,
    children,
    rebuilt,
    walk,
)
from mechsheet.homework.routines import routine_names
from mechsheet.homework.series import Graph, Series
from mechsheet.homework.truth import Array
from mechsheet.homework.upright import Place

MOST_AT_ONCE = 1500
OF_ONE = 150
"""What a candidate costs besides its cells, in cells."""
_MOST_LINES = 16
_PLACED = frozenset(("OFFSET", "INDIRECT", "CELL", "FORMULATEXT"))
_TURNED = frozenset(
    ("ROW", "COLUMN", "INDEX", "VLOOKUP", "HLOOKUP", "MATCH", "LOOKUP", "ROWS", "COLUMNS", "TRANSPOSE", "MMULT")
)
"""Functions that mean another thing on a sheet laid out anew: always, and where rows and columns were exchanged."""


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


class Trial:
    """Tries formulas for strips of one workbook."""

    def __init__(self, graph: Graph, effort: Effort) -> None:
        self.graph = graph
        self.effort = effort

    def columns(self, number: int, candidates: Sequence[Node], goals: Sequence[Series]) -> list[Array]:
        """For each goal an array (candidates, rows): its numbers with each candidate in place of a strip's bound formula.

        Raises UntriableError.
        """
        found = [
            self._columns(number, candidates[first : first + MOST_AT_ONCE], goals)
            for first in range(0, len(candidates), MOST_AT_ONCE)
        ]
        return [np.concatenate([part[index] for part in found]) for index in range(len(goals))]

    def _columns(self, number: int, candidates: Sequence[Node], goals: Sequence[Series]) -> list[Array]:
        work = self.graph.work
        last = {strip for goal in goals for strip in goal.strips(work)}
        affected = self.graph.below({number}) & (self.graph.above(last) | {number})
        self.effort.spend(len(candidates) * (OF_ONE + sum(work.strips[index].length for index in affected)))
        alone = not self.graph.reads[number] & self.graph.below({number})
        if not alone or not _simple(self.graph.formulas[number]) or work.plan.settles:
            self.effort.spend(3 * OF_ONE * len(candidates))
            book = _Book(self, affected, len(candidates))
            book.candidates(number, candidates)
            book.follow(affected - {number})
            return book.computed(goals)
        values = self._values(number, candidates)
        different, which = np.unique(values, axis=0, return_inverse=True, equal_nan=True)
        book = _Book(self, affected, len(different))
        book.numbers(number, different)
        book.follow(affected - {number})
        return [columns[np.ravel(which)] for columns in book.computed(goals)]

    def _values(self, number: int, candidates: Sequence[Node]) -> Array:
        """What each candidate gives in the strip's own cells, (candidates, rows): by the engine, common parts once."""
        work = self.graph.work
        strip = work.strips[number]
        sheet, row, col = work.engine_place((strip.sheet, strip.start, strip.line))
        index = next(n for n, title in enumerate(work.plan.layout.titles) if title == sheet)
        frame = Frame(index, row, col, *((1, strip.length) if work.across else (strip.length, 1)))
        evaluator = _Remembering(work.computed, set(map(id, walk(self.graph.formulas[number]))))
        found = np.full((len(candidates), strip.length), np.nan)
        turn = _Turn() if work.across else None
        for place, candidate in enumerate(candidates):
            cells = evaluator.result(candidate if turn is None else turn(candidate), frame)
            numbers = np.ravel(np.broadcast_to(cells.numbers, frame.shape))
            if cells.codes is not None:
                numbers = np.where(np.ravel(np.broadcast_to(cells.codes, frame.shape)) == NUMBER, numbers, np.nan)
            found[place] = numbers
        return found


_PLAIN = (Number, Text, Boolean, CellRef, RangeRef, Unary, Binary, Call)


def _simple(formula: Node) -> bool:
    """Whether a formula is made of what means the same anywhere."""
    called = set(calls(formula))
    plain = all(isinstance(part, _PLAIN) for part in walk(formula))
    return plain and called <= FUNCTIONS.keys() and not called & (_PLACED | _TURNED)


class _Remembering(Evaluator):
    """An evaluator that computes what all candidates have in common once. `common`: ids of the nodes of the formula."""

    def __init__(self, like: Evaluator, common: set[int]) -> None:
        super().__init__(like.layout, like.numbers, like.codes, like.texts, like.around)
        self.common = common
        self.known: dict[tuple[int, bool], Cells] = {}

    def value(self, node: Node, frame: Frame, spread: bool = False) -> Cells:
        """As the evaluator's."""
        if id(node) not in self.common:
            return super().value(node, frame, spread)
        key = id(node), spread
        found = self.known.get(key)
        if found is None:
            found = self.known[key] = super().value(node, frame, spread)
        return found


class _Turn:
    """Exchanges rows and columns; a part that was exchanged before is the same object again."""

    def __init__(self) -> None:
        self.known: dict[int, tuple[Node, Node]] = {}

    def __call__(self, node: Node) -> Node:
        found = self.known.get(id(node))
        if found is None:
            below = children(node)
            if isinstance(node, CellRef):
                new: Node = CellRef(node.col, node.row, node.col_abs, node.row_abs, node.sheet)
            else:
                new = rebuilt(node, tuple(map(self, below))) if below else node
            found = self.known[id(node)] = (node, new)
        return found[1]


@dataclass
class _Book:
    """The small book: a sheet for each line with affected cells, and sheets of numbers as they are."""

    trial: Trial
    affected: set[int]
    count: int
    cells: dict[tuple[str, int], set[int]] = field(default_factory=dict)
    sheets: dict[tuple[str, int], BookSheet] = field(default_factory=dict)
    given: dict[str, BookSheet] = field(default_factory=dict)
    known: set[Place] = field(default_factory=set)
    kept: set[Place] = field(default_factory=set)

    def __post_init__(self) -> None:
        for index in sorted(self.affected):
            strip = self.trial.graph.work.strips[index]
            line = strip.sheet, strip.line
            self.cells.setdefault(line, set()).update(range(strip.start, strip.end))
            self.sheets.setdefault(line, BookSheet(f"t{len(self.sheets)}"))

    def follow(self, indices: Iterable[int]) -> None:
        """Strips that depend on the candidates: the same formula beside each."""
        for index in sorted(indices):
            strip = self.trial.graph.work.strips[index]
            formula = self._placed(self.trial.graph.formulas[index], strip.length, 0)
            self.sheets[strip.sheet, strip.line].block(strip.start, 0, strip.length, self.count, formula)

    def numbers(self, number: int, values: Array) -> None:
        """The candidates' values, one beside the other."""
        strip = self.trial.graph.work.strips[number]
        sheet = self.sheets[strip.sheet, strip.line]
        for column, numbers in enumerate(values):
            known = [ErrorValue("#NUM!") if value != value else float(value) for value in numbers]
            sheet.column_constants(strip.start, column, known)

    def candidates(self, number: int, candidates: Sequence[Node]) -> None:
        """The candidates themselves, one beside the other."""
        work = self.trial.graph.work
        strip = work.strips[number]
        sheet = self.sheets[strip.sheet, strip.line]
        for column, candidate in enumerate(candidates):
            formula = self._placed(candidate, strip.length, column)
            sheet.block(strip.start, column, strip.length, 1, formula)

    def _placed(self, formula: Node, length: int, column: int) -> Node:
        """A bound formula with references into the small book; `column`: where it stands there."""

        def area(start: CellRef, end: CellRef) -> list[Node]:
            sheet = self.trial.graph.titles.get((start.sheet or "").casefold())
            if sheet is None or not start.col <= end.col < start.col + _MOST_LINES:
                raise UntriableError
            low = min(start.row, end.row)
            high = max(one.row if one.row_abs else one.row + length - 1 for one in (start, end))
            last = max(low, self.trial.graph.work.ends[sheet] - 1)
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
                if part.name in _PLACED or (part.name in _TURNED and self.trial.graph.work.across):
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
        work = self.trial.graph.work
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
        value = self.trial.graph.work.value(place)
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
        work = self.trial.graph.work
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

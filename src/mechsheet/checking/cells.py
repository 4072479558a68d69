"""Every formula's value against another program's, cell by cell.

What a workbook searches by probe rows is held against the search in Python instead. Where a parabola has its vertex, or
which of two equal rows is the best, rounding decides; each program may place its probes elsewhere. What they find must be
the same. Likewise Newton's method in a row where the links do not meet: it leaps about, each leap makes a difference of the
last digit larger; asked is only that no program takes such a row for a position.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from livesheet.formula.book import Book
from livesheet.formula.nodes import Direction, ErrorValue, Scalar, Symbol, shifted
from livesheet.formula.references import cell_address
from mechsheet.checking.against_search import against_search
from mechsheet.checking.cells_apart import EqualRows, Rules, column_scale, difference, ignored_in
from mechsheet.checking.comparison import Comparison, Tally
from mechsheet.checking.edited.inserted_rows import Move, MovedValues, Moves
from mechsheet.kinematics.dimensions import is_length
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.asked.requested import tables_of
from mechsheet.sheet.asked.summary_table import SummaryTable
from mechsheet.sheet.asked.two_way import FIRST
from mechsheet.sheet.columns.lowering import FITS
from mechsheet.sheet.plan import BLOCKS, Plan
from mechsheet.sheet.table.tolerance import lines_of
from mechsheet.units import turn

Compared = Literal["value", "error", "nothing"]


@dataclass(frozen=True, slots=True)
class Angles:
    """Where a mechanism's workbook holds angles, as (sheet, column) -> period, and counts of turns (period 1).

    ATAN2(-1, 0) is pi or -pi by the sign of a rounding error: programs may differ by a turn there, and in the count of
    turns that makes up for it. `size` is the mechanism's: lengths far smaller than 1 are compared on their own scale.
    """

    periods: Mapping[tuple[str, int], float] = field(default_factory=dict)
    size: float = 1.0


def angles_in(plan: Plan) -> Angles:
    """The angles of a mechanism's workbook."""
    periods = {}
    for column in plan.columns:
        if column.equation is None:
            continue
        if column.equation.unit.kind == "angle":
            periods[plan.table, column.col] = turn(plan.at.spots[column.symbol].degrees)
    # a table's angle before it goes on from the cell above: of atan2(0, -1) a rounding error makes half a turn or minus that
    for table in tables_of(plan):
        periods |= {(table.title, col): turn(False) for col in table.found.columns_of_raw_angles}
    lengths = [abs(dim.value) for dim in plan.mechanism.dimensions if isinstance(dim.value, float) and is_length(dim)]
    return Angles(periods, min(1.0, max(lengths, default=1.0) or 1.0))


def compare_cells(
    judge: str,
    book: Book,
    values: Any,
    theirs: Callable[[str, int, int], Scalar],
    angles: Angles | None = None,
    rules: Rules | None = None,
    but: Collection[int] = (),
    compared: Callable[[str, int, int], Compared] = lambda _sheet, _row, _col: "value",
) -> Comparison:
    """The engine's value of every formula against `theirs(sheet, row, col)`.

    but       blocks that are left out, by their number
    compared  what is compared in a cell of a sheet: values, whether there is one or an error, nothing
    """
    angles, rules = angles or Angles(), rules or Rules()
    ignored = ignored_in(book, rules.ignore)
    equal = EqualRows(values, angles.size)
    tally = Tally(judge, tolerance=rules.relative)
    number = -1
    for sheet in book.sheets:
        for block in sheet.blocks:
            number += 1
            if number in but:
                continue
            for col in range(block.col, block.col + block.cols):
                ours = values.column(sheet.title, col, block.row, block.row + block.rows - 1)
                scale = column_scale(ours, angles.size)
                period = angles.periods.get((sheet.title, col))
                for row, value in enumerate(ours, block.row):
                    what = compared(sheet.title, row, col)
                    if what == "nothing" or ignored.has(sheet.title, row, col):
                        continue
                    other = theirs(sheet.title, row, col)
                    apart = difference(value, other, scale, period)
                    if what == "error" and isinstance(value, ErrorValue) == isinstance(other, ErrorValue):
                        apart = 0.0
                    if apart > rules.relative:
                        formula = shifted(block.formula, row - block.row, col - block.col)
                        if _is_near(value, other, rules.absolute) or equal.has(formula, sheet.title, other):
                            apart = 0.0
                    if apart > tally.worst or apart > rules.relative:
                        tally.note(apart, cell_address(sheet.title, row, col), value, other)
                    else:
                        tally.cells += 1
    return tally.result()


def _is_near(ours: Scalar, theirs: Scalar, absolute: float) -> bool:
    return type(ours) is float and type(theirs) is float and abs(ours - theirs) <= absolute


Find = Callable[[str, int, int], Scalar]
"""The value of a cell by sheet, row and column."""


# --- what is searched, and what goes astray --------------------------------------------------------------------------


UNMOVED = Moves(())


class Searched:
    """Cells that a search in the sheet decides: the probes on the sheet of extremes and below the rows of tables
    of summaries, what these show, verdicts and summaries on the first sheet, and the derivatives where a summary is
    smallest or largest, on the sheet of tolerances, with its band on the first sheet."""

    def __init__(self, plan: Plan, moves: Moves) -> None:
        extremes = plan.at.titles["extremes"]
        self.sheet = "" if extremes == plan.main else moves.now(extremes)  # a page has no probes
        blocks = [plan.blocks[key] for key in ("verdicts", "summary") if key in plan.blocks]
        rows = [(plan.main, row) for block in blocks for row in block.rows.values()]
        rows.append((plan.main, plan.places.verdict.row))
        for line in lines_of(plan):
            if line.summary and line.summary.take.ways:
                rows += [(plan.at.titles["tolerance"], line.row + part) for part in (0, 1)]
                rows.append((plan.main, plan.blocks["bands"].rows[line.summary.symbol]))
        now = {title: moves.now(title) for title, _ in rows}
        self.rows = {(now[title], moves.of(now[title]).rows.now(row)) for title, row in rows}
        self.tables: dict[str, tuple[int, int, int]] = {}
        for table in tables_of(plan):
            if isinstance(table, SummaryTable):
                title = moves.now(table.title)
                rows_now = moves.of(title).rows
                first, last, end = (rows_now.now(row) for row in (FIRST, table.last, table.rows_end))
                if first is not None and last is not None and end is not None:
                    self.tables[title] = (first, last, end)

    def has(self, sheet: str, row: int) -> bool:
        """Whether the cells of a row are verdicts, summaries, or derivatives where a summary is smallest or largest."""
        if sheet in self.tables:
            return row >= self.tables[sheet][0]
        return (sheet, row) in self.rows

    def compared(self, sheet: str, row: int) -> Compared:
        """What may be compared cell by cell: of a verdict only whether there is one, of a probe nothing."""
        if sheet == self.sheet:
            return "nothing"
        if sheet in self.tables:
            first, last, rows_end = self.tables[sheet]
            if row > rows_end:
                return "nothing"
            return "error" if first <= row <= last else "value"
        return "error" if self.has(sheet, row) else "value"


class Astray:
    """Cells of rows in which links do not meet: of passes of Newton's method, which arrive nowhere, and of directions from
    pin to pin, which are none where the pins coincide (ATAN2(0, 0) is 0 in LibreOffice, else an error)."""

    def __init__(self, plan: Plan, values: Any, moves: Moves) -> None:
        self.cells: set[tuple[str, int, int]] = set()
        there, found = MovedValues(values, moves), plan.iterations
        self._directions(plan, there, moves)
        for group in plan.equations.groups if found else ():
            if group.system is None:
                continue
            closes, title = plan.at.spots[group.closes], plan.at.titles["iterations"]
            passes = [
                column.col
                for column in found
                if column.group // BLOCKS == group.number and not column.symbol.startswith(FITS)
            ]
            last = (Symbol(group.system.residual), Symbol(group.system.determinant))
            beside = [column.col for column in plan.columns if column.equation and column.equation.expression in last]
            rows = _open(plan, there, closes)
            self._add(moves, title, rows, passes)
            self._add(moves, plan.table, rows, beside)

    def _directions(self, plan: Plan, there: MovedValues, moves: Moves) -> None:
        spots = plan.at.spots
        for group in plan.equations.groups:
            own = {
                equation.symbol
                for equation in plan.equations.equations.columns
                if equation.group == group.number and isinstance(equation.expression, Direction)
            }
            cols = [column.col for column in plan.columns if column.symbol in own]
            if cols and group.closes in spots and spots[group.closes].column:
                self._add(moves, plan.table, _open(plan, there, spots[group.closes]), cols)

    def _add(self, moves: Moves, title: str, rows: list[int], cols: list[int]) -> None:
        """Rows of some columns of a sheet, where they are now."""
        move = moves.by_title.get(title, Move(title, title))
        places = [(move.rows.now(row), move.cols.now(col)) for row in rows for col in cols]
        self.cells |= {(move.now, row, col) for row, col in places if row is not None and col is not None}


def _open(plan: Plan, there: MovedValues, closes: Spot) -> list[int]:
    """The rows in which a group does not close."""
    shown = there.column(closes.sheet, closes.col, plan.at.first, plan.at.last)
    return [row for row, value in enumerate(shown, plan.at.first) if not isinstance(value, float)]


class _Answered:
    """The engine's values, but for the searched cells those of a program."""

    def __init__(self, values: Any, theirs: Find, searched: Searched) -> None:
        self._values, self._theirs, self._searched = values, theirs, searched

    def get(self, sheet: str, row: int, col: int) -> Scalar:
        if self._searched.has(sheet, row):
            return self._theirs(sheet, row, col)
        found: Scalar = self._values.get(sheet, row, col)
        return found

    def column(self, sheet: str, col: int, first_row: int, last_row: int) -> list[Scalar]:
        return [self.get(sheet, row, col) for row in range(first_row, last_row + 1)]


def compare_program(
    program: str,
    book: Book,
    values: Any,
    theirs: Find,
    plan: Plan,
    shown: str,
    *,
    rules: Rules | None = None,
    but: Collection[int] = (),
    moves: Moves = UNMOVED,
) -> Comparison:
    """A program's values of a mechanism's workbook: cell by cell against the engine's, searched ones against the search.

    book, values  the workbook as it is and the engine's values of it;  moves  how its rows and columns were moved
    but           blocks that are left out, by their number
    """
    searched, astray = Searched(plan, moves), Astray(plan, values, moves).cells

    def compared(sheet: str, row: int, col: int) -> Compared:
        return "nothing" if (sheet, row, col) in astray else searched.compared(sheet, row)

    cells = compare_cells(program, book, values, theirs, angles_in(plan), rules, but, compared)
    answered: Any = _Answered(values, theirs, searched)
    found = against_search(book, MovedValues(answered, moves) if moves else answered, plan, shown)
    if found is None:
        return cells
    worse = cells.agrees and not found.agrees
    return replace(found if worse else cells, judge=program, cells=cells.cells + found.cells)

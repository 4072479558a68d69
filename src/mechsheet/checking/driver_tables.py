"""The two-way tables over the driver against the reference, which solves the sweep of each column by itself.

Cells count turns: down a column an angle is within half a turn of the cell above it, or, where there is none, of a line
from where the table of positions has it. The same is done here in numpy, with the equations, to know the turn in which each
run of rows begins; within a run the reference goes on by itself, so that a cell that leaps by a turn differs from it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from livesheet.formula.book import Book
from livesheet.formula.references import cell_address
from mechsheet import reference
from mechsheet.checking.columns_apart import Mask, Rows, apart_from, apart_of, closed_rows, scale_of
from mechsheet.checking.comparison import Array, Tally
from mechsheet.checking.inputs import (
    Inputs,
    OfTheLast,
    changed,
    equations_as_typed,
    functions_in,
    missing_dimensions,
    numbers_in,
    readers,
    typed,
)
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import runs_of, without_jumps
from mechsheet.kinematics.sweep import DISTINCT, distinct, poses_in, sweep
from mechsheet.sheet.asked.cell_formula import CellFormula
from mechsheet.sheet.asked.requested import tables_of
from mechsheet.sheet.asked.summary_table import SummaryTable
from mechsheet.sheet.asked.two_way import FIRST, HEAD_ROW, Table
from mechsheet.sheet.plan import Plan

NEAR_DEAD_CENTRE = 1e-5
"""Below this part of the largest distance between a group's assemblies rounding may move a position by more than the
tolerance."""

SPREAD = 1e-11
"""So far apart are equations and reference only where rounding is magnified."""

HALF_TURN = 1e-6
"""So near to half a turn [rad] rounding decides which way an angle goes on: then the sheet's own choice is followed."""


def compare_tables(book: Book, values: Any, plan: Plan, inputs: Inputs, tally: Tally) -> None:
    """Note each cell of each such table; one whose sheet is missing is told as an edit.

    Columns are left out whose head holds no number, or no length where there must be one: they are sweeps of nothing.
    """
    for table in tables_of(plan):
        if isinstance(table, SummaryTable) or book.sheet(table.title) is None:
            continue
        judge = _Judge(values, plan, inputs, tally, table, table.found, bool(functions_in(book)))
        for across in range(table.count):
            typed_number = values.get(table.title, HEAD_ROW, 1 + across)
            if isinstance(typed_number, float):
                number = table.column.unit.to_internal(typed_number)
                if number > 0 or table.column.symbol not in plan.equations.positive:
                    judge.column(across, number)


_SOLUTIONS: OfTheLast[dict[Any, reference.Solution]] = OfTheLast()


@dataclass(frozen=True, slots=True)
class _Judge:
    """One table.

    called  its cells call functions, which know no cell above: they take each angle into one turn around a line
    """

    values: Any
    plan: Plan
    inputs: Inputs
    tally: Tally
    table: Table
    cell: CellFormula
    called: bool

    @property
    def driver(self) -> Array:
        """Its values, which the table takes from the table of positions."""
        return self.inputs.given[self.plan.mechanism.driver.symbol]

    def column(self, across: int, number: float) -> None:
        """The cells below one value of the dimension (internal units)."""
        plan, value = self.plan, self.table.request.value
        inputs = replace(self.inputs, dimensions={**self.inputs.dimensions, self.table.column.symbol: number})
        ours = self._shown(1 + across, plan.at.spots[value].degrees)
        nothing = np.full(plan.rows, math.nan)
        if missing := missing_dimensions(plan.mechanism, inputs.dimensions):
            if value in readers(plan.equations, missing):
                self._note(across, np.where(np.isnan(ours), 0.0, math.inf), ours, nothing)
            return
        mechanism, equations = changed(plan.mechanism, inputs), equations_as_typed(plan, inputs)
        turned = {angle: self._turns(index, angle, across) for index, angle in enumerate(self.cell.angles)}
        guide = sweep(mechanism, equations, self.driver, turned)
        opened, closes = self._opened(equations, guide), equations.closed(guide)
        if not closes.any():  # there is no position to ask the reference from
            self._note(across, np.where(opened & ~np.isnan(ours), math.inf, 0.0), ours, nothing)
            return
        near = distinct(equations, guide)
        apart, theirs = nothing.copy(), nothing.copy()
        for rows in _parts(closes, [guide[angle] for angle in turned], bool(equations.tied)):
            there = {symbol: column[rows] for symbol, column in guide.items()}
            row = int(np.argmax(np.minimum(near[rows], DISTINCT)))
            solution = self._solution(inputs, number, rows, poses_in(mechanism, equations, there, row))
            part = _Part(self, solution, there, opened[rows], closes[rows], near[rows] < NEAR_DEAD_CENTRE)
            apart[rows], theirs[rows] = part.compared(ours[rows])
        self._note(across, apart, ours, theirs)

    def _solution(self, inputs: Inputs, number: float, rows: slice, start: Any) -> reference.Solution:
        """What the reference finds in some rows."""
        known = _SOLUTIONS.of(self.plan, self.inputs, dict)
        asked = (self.table.column.symbol, number, rows.start, rows.stop, tuple(start.items()))
        if asked not in known:
            mechanism = typed(self.plan.mechanism, inputs)
            known[asked] = reference.solve(mechanism, inputs.dimensions, start=start, values=self.driver[rows])
        return known[asked]

    # --- cells ---------------------------------------------------------------------------------------------------------

    def _shown(self, col: int, degrees: bool) -> Array:
        """A column of the sheet in internal units, NaN where it holds no number."""
        return numbers_in(self.values, self.table.title, col, FIRST, self.table.last, degrees)

    def _turns(self, index: int, angle: str, across: int) -> Callable[[Array], Array]:
        """What takes an angle into the turns in which the cells have it; `index`: that of its block of helpers."""
        branch = self.cell.windows[angle]
        if self.called:
            low = branch.slope * self.driver + math.radians(round(math.degrees(branch.centre)) - 180.0)
            return lambda column: low + np.mod(column - low, math.tau)
        helper = self._shown(self.cell.blocks.col(index) + across, degrees=False)
        return _Turns(self._start(angle), branch.slope, self.driver, helper)

    def _start(self, symbol: str) -> float:
        """The angle [rad] near which all columns start; see `CellFormula.start`."""
        plan, branch = self.plan, self.cell.windows[symbol]
        said, spot = plan.places.status, plan.at.spots[symbol]
        first = next(
            (row for row in range(plan.rows) if self.values.get(said.sheet, said.row + row, said.col) == plan.ok), None
        )
        if first is not None:
            angle = self.values.get(spot.sheet, spot.row + first, spot.col)
            if isinstance(angle, float):
                way = float(self.driver[first] - self.driver[0])
                return (math.radians(angle) if spot.degrees else angle) - branch.slope * way
        return branch.centre + branch.slope * float(plan.driver[0])

    def _opened(self, equations: Equations, guide: Mapping[str, Array]) -> Mask:
        """Rows in which, by the equations, a group comes apart that the table's value depends on."""
        found = np.zeros(self.plan.rows, dtype=bool)
        for group in equations.groups:
            if self.depends_on(group.closes):
                found |= np.isnan(guide[group.closes])
        return found

    def depends_on(self, closes: str) -> bool:
        """Whether the table's value needs the group that a symbol closes."""
        return self.table.request.value in {closes, *readers(self.plan.equations, {closes})}

    def _note(self, across: int, apart: Array, ours: Array, theirs: Array) -> None:
        def address(row: int) -> str:
            return cell_address(self.table.title, FIRST + row, 1 + across)

        self.tally.note_column(self.table.request.value, apart, address, ours, theirs)


@dataclass(frozen=True, slots=True)
class _Part:
    """Rows of a column that are solved together.

    guide   what the equations give there, angles in the turns of the sheet
    opened  rows in which the value has none, by the equations;  closes  those in which all groups close
    dead    those near a dead centre
    """

    judge: _Judge
    solution: reference.Solution
    guide: Mapping[str, Array]
    opened: Mask
    closes: Mask
    dead: Mask

    def compared(self, ours: Array) -> tuple[Array, Array]:
        """How far the cells are from the reference, and what that has."""
        plan, symbol, found = self.judge.plan, self.judge.table.request.value, self._found()
        theirs = np.asarray(found[symbol], float)
        scale, *_ = scale_of(plan, symbol, self.solution)
        spread = apart_of(self.guide[symbol], theirs, False, scale or np.maximum(1.0, np.abs(theirs)))
        closed = closed_rows(plan.mechanism, self.solution, {**found, **self.guide}) & (self.dead | (spread > SPREAD))
        rows = Rows(~self.opened & ~self.closes, closed)
        return apart_from(plan, symbol, ours, self.solution, found, rows, turns=False), theirs

    def _found(self) -> dict[str, Array]:
        """The reference's variables and outputs, each run of rows in the turn in which the sheet begins it."""
        found = reference.reached(self.solution)
        for angle in self.judge.cell.angles:
            turns = np.round((self.guide[angle] - found[angle]) / math.tau)
            for first, end in runs_of(self.solution.exists):
                turns[first:end] = turns[first]
            found[angle] = found[angle] + math.tau * np.nan_to_num(turns)
        return found | reference.outputs(self.solution, found)


@dataclass(frozen=True, slots=True)
class _Turns:
    """How the cells of a column go on with an angle.

    start, slope  the line [rad] near which it is where the cell above holds no number; start is at the driver's first value
    shown         the angle as the sheet has it: its choice counts where two are equally near
    """

    start: float
    slope: int
    driver: Array
    shown: Array

    def __call__(self, angle: Array) -> Array:
        """The angles within half a turn of the ones above them."""
        found = without_jumps(angle).copy()
        line = self.start + self.slope * (self.driver - self.driver[0])
        for first, end in runs_of(np.isfinite(found)):
            steps = np.abs(np.diff(found[first:end]))
            halves = [first + 1 + int(step) for step in np.flatnonzero(np.abs(steps - math.pi) < HALF_TURN)]
            for begin, stop in zip([first, *halves], [*halves, end], strict=True):
                place = line[begin] if begin == first else found[begin - 1]
                turns = self._turns(float(found[begin] - place), float(self.shown[begin] - place))
                found[begin:stop] -= math.tau * turns
        return np.asarray(found)

    @staticmethod
    def _turns(away: float, shown: float) -> float:
        """Whole turns to take off an angle so far from its place, where the sheet's is `shown` from it."""
        turns = math.floor((away + math.pi) / math.tau)
        if math.pi - abs(away - math.tau * turns) < HALF_TURN and abs(abs(shown) - math.pi) < 2 * HALF_TURN:
            return float(round((away - shown) / math.tau))
        return float(turns)


def _parts(there: Mask, angles: Sequence[Array], by_run: bool) -> list[slice]:
    """All rows at once, but for other turns from some row on; by run where a gear or rack makes more of a turn than a turn.

    angles  as the cells have them;  by_run  whether something is tied to them
    """
    begins = {first for first, _ in runs_of(there)[1:]} if by_run and angles else set()
    for angle in angles:
        begins |= {1 + int(row) for row in np.flatnonzero(np.abs(np.diff(angle)) > math.pi + HALF_TURN)}
    edges = sorted(begins)
    return [slice(first, end) for first, end in zip([0, *edges], [*edges, len(there)], strict=True)]

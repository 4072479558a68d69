"""The engine's values against the reference: Newton's method on link poses, straight from the description inside."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.book import Book
from livesheet.formula.nodes import symbols
from livesheet.formula.references import cell_address
from livesheet.said import say
from mechsheet import reference
from mechsheet.checking.bands import compare_bands
from mechsheet.checking.columns_apart import DEAD_CENTRE, EDGE, Rows, Steepness, apart_from, apart_of, closed_rows
from mechsheet.checking.comparison import Array, Comparison, Tally
from mechsheet.checking.driver_tables import compare_tables
from mechsheet.checking.inputs import (
    Inputs,
    OfTheLast,
    changed,
    equations_as_typed,
    inputs_in,
    missing_dimensions,
    numbers_in,
    readers,
    typed,
    with_listed_rates,
)
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.newton.changed_dimensions import LEAP
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import rough_poses, sweep
from mechsheet.model import ENERGY, Mechanism
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.columns.added import MEAN_NEEDS
from mechsheet.sheet.deleted import with_what_they_read
from mechsheet.sheet.plan import MAY_GO, Plan


def against_plan(
    book: Book, values: Any, plan: Plan, shown: str, built: Plan | None = None, rows: Sequence[int] = ()
) -> tuple[Comparison, list[str]]:
    """Compare every variable, point and output, row by row, with what the reference finds for the inputs in the cells.

    `values` is the engine's, `plan` that of the description inside the workbook. Where somebody has made the table longer,
    it is that of so many rows; `built` is the description's own then, and `rows` the numbers of its rows, which two-way
    tables follow. Returns the comparison, and remarks for a person.
    """
    inputs = inputs_in(book, values, plan, shown)
    tally = Tally("reference")
    remarks = _compare_rows(book, values, plan, inputs, tally)
    if built is None or built is plan:
        compare_tables(book, values, plan, inputs, tally)
    else:
        given = {name: column[list(rows)] for name, column in inputs.given.items()}
        compare_tables(book, values, built, replace(inputs, given=given), tally)
    return tally.result(), [*inputs.remarks, *remarks]


def _compare_rows(book: Book, values: Any, plan: Plan, inputs: Inputs, tally: Tally) -> list[str]:
    """The table of positions and what goes with it; returns why nothing can be compared, where that is so."""
    mechanism = plan.mechanism
    if missing := missing_dimensions(mechanism, inputs.dimensions):
        _without(plan, values, tally, readers(plan.equations, missing))
        return [
            *(
                say("{symbol} has no value with these dimensions: {why}", symbol=symbol, why=why)
                for symbol, why in missing.items()
            ),
            UNREACHED,
        ]
    opened = _opened(plan, values)
    as_typed = changed(mechanism, inputs)
    # where Newton's method starts, and from which turn a gear or rack counts, was decided when the workbook was built
    equations = equations_as_typed(plan, inputs) if plan.newton or mechanism.relations else None
    start = _start(as_typed, inputs, equations)
    if start is None:
        _judge_status(plan, tally, opened, np.zeros(plan.rows, dtype=bool))
        for symbol, mask in opened.items():
            if symbol in plan.at.spots and plan.equations.of(symbol).role in RESULTS:
                _expect_nothing(plan, tally, symbol, _column(plan, values, symbol), mask)
        return [NOWHERE]
    solution = _SOLUTIONS.of(plan, inputs, lambda: _solved(mechanism, inputs, start))
    nowhere = beyond = np.zeros(plan.rows, dtype=bool)
    if plan.newton and equations is not None:
        solution, beyond = _reached(solution, as_typed, equations, inputs.given[mechanism.driver.symbol])
    known = _Known(plan, values)
    deleted, lost = _lost(book, plan)  # told in a remark; the rest is compared
    known.update({symbol: np.full(plan.rows, math.nan) for symbol in deleted})
    _without(plan, values, tally, lost)
    steep = Steepness(plan, known)
    ours = {symbol: known[symbol] for symbol in _judged(plan) if symbol not in deleted | lost}
    theirs = _theirs(solution, ours, plan.efforts)
    placed = {symbol: known[symbol] for symbol in theirs if symbol in plan.at.spots or symbol in plan.plain}
    closed = closed_rows(mechanism, solution, ours | placed, beyond)
    _judge_status(plan, tally, opened, solution.exists | (beyond & closed & ~opened[EVERY]))
    elsewhere = beyond & closed & _elsewhere(plan, ours, theirs, solution.size)
    for symbol, column in ours.items():
        if symbol == ENERGY:
            apart = steep.energy_apart(column, solution, theirs)
        elif steep.concerns(symbol):
            apart = steep.apart(symbol, column, solution, theirs, elsewhere)
        else:
            rows = Rows(~opened.get(symbol, nowhere), closed, beyond)
            apart = apart_from(plan, symbol, column, solution, theirs, rows, turns=True)
        address = partial(_address, plan, plan.at.spots[symbol])
        tally.note_column(symbol, apart, address, column, np.asarray(theirs[symbol], float))
    if plan.bands and book.sheet(plan.at.titles["tolerance"]) is not None:  # that it is missing is told as an edit
        _compare_bands(plan, tally, values, as_typed, inputs, start)
    return []


_SOLUTIONS: OfTheLast[reference.Solution] = OfTheLast()


def _solved(mechanism: Mechanism, inputs: Inputs, start: Any) -> reference.Solution:
    """What the reference finds, from the sketch `start` on, for the inputs in the cells; it reads no other cell."""
    by_law = mechanism.driver.law is not None  # the reference has laws of its own
    return reference.solve(
        typed(with_listed_rates(mechanism, inputs), inputs), inputs.dimensions, start=start,
        values=None if by_law else inputs.given[mechanism.driver.symbol],
    )  # fmt: skip


def _compare_bands(plan: Plan, tally: Tally, values: Any, mechanism: Mechanism, inputs: Inputs, start: Any) -> None:
    """The sheet of tolerances, by solutions with each dimension a little smaller and larger."""

    def number(sheet: str, row: int, col: int) -> float:
        cell = values.get(sheet, row, col)
        return cell if isinstance(cell, float) else math.nan

    def solve(driver: Array) -> reference.Solution:
        own = None if mechanism.driver.law is not None else driver
        return reference.solve(typed(plan.mechanism, inputs), inputs.dimensions, start=start, values=own)

    known, dead = _Known(plan, values), np.zeros(plan.rows, dtype=bool)
    for group in plan.equations.groups:
        if group.number in plan.sensitivities.groups and group.dead is not None:
            names = {*symbols(group.dead.margin), *symbols(group.dead.least)}
            there = {name: known[name] for name in names}
            with np.errstate(invalid="ignore"):
                dead |= ~(value(group.dead.margin, there) > (1 + EDGE) * value(group.dead.least, there))
    compare_bands(plan, tally, number, solve, inputs.given[plan.mechanism.driver.symbol], dead)


RESULTS = ("variable", "point", "rate", "force", "output")
"""Roles of the equations that are judged; intermediate quantities are nobody's but the sheet's."""

EVERY = ""
"""Stands among symbols for the whole mechanism."""

NOWHERE = say("with these dimensions and modes no row exists: there is no position to compare, only that none is shown")

UNREACHED = say("the reference cannot be asked: compared is only that no number is shown of what depends on them")


def _without(plan: Plan, values: Any, tally: Tally, symbols: Collection[str]) -> None:
    """Nothing can be said of `symbols`: each must say so in every row."""
    for equation in plan.equations.columns:
        if equation.role in RESULTS and equation.symbol in symbols:
            column = _column(plan, values, equation.symbol)
            _expect_nothing(plan, tally, equation.symbol, column, np.ones(plan.rows, dtype=bool))


class _Known(dict[str, Array]):
    """The values of symbols in internal units, those too that have no cell of their own; each when it is asked for."""

    def __init__(self, plan: Plan, values: Any) -> None:
        super().__init__()
        self.plan = plan
        self.values_of_cells = values

    def __missing__(self, symbol: str) -> Array:
        if symbol in self.plan.at.spots:
            found = _column(self.plan, self.values_of_cells, symbol)
        else:
            found = np.broadcast_to(np.asarray(value(self.plan.plain[symbol], self), float), (self.plan.rows,))
        self[symbol] = found
        return found


def _expect_nothing(plan: Plan, tally: Tally, symbol: str, ours: Array, rows: NDArray[np.bool_]) -> None:
    for row in np.flatnonzero(rows):
        where = f"{_address(plan, plan.at.spots[symbol], int(row))} ({symbol}, row {row})"
        tally.note(0.0 if math.isnan(ours[row]) else math.inf, where, float(ours[row]), None)


def _opened(plan: Plan, values: Any) -> dict[str, NDArray[np.bool_]]:
    """By symbol the rows in which, as the sheet has it, a group comes apart that it depends on; under EVERY any group."""
    nowhere = np.zeros(plan.rows, dtype=bool)
    found = {EVERY: nowhere}
    for group in plan.equations.groups:
        apart = np.isnan(_Known(plan, values)[group.closes])
        for symbol in (EVERY, group.closes, *readers(plan.equations, {group.closes})):
            found[symbol] = found.get(symbol, nowhere) | apart
    return found


def _judge_status(plan: Plan, tally: Tally, opened: Mapping[str, NDArray[np.bool_]], exists: NDArray[np.bool_]) -> None:
    """In a row that does not exist some group comes apart."""
    for row in np.flatnonzero(~exists):
        said = "joined" if not opened[EVERY][row] else say("cannot be joined")
        where = f"{_address(plan, plan.places.status, int(row))} (row {row})"
        tally.note(0.0 if opened[EVERY][row] else math.inf, where, said, say("cannot be joined"))


def _address(plan: Plan, spot: Spot, row: int) -> str:
    return cell_address(spot.sheet, plan.at.first + row if spot.column else spot.row, spot.col)


def _theirs(solution: reference.Solution, ours: Mapping[str, Array], efforts: tuple[str, ...]) -> dict[str, Array]:
    """The reference's variables, and the outputs for them.

    Where no position lies between, an angle may be a whole turn away: outputs are asked for the sheet's turn.
    """
    found = reference.reached(solution)
    angles = {link.angle_symbol for link in solution.mechanism.links} & found.keys() & ours.keys()
    turned = {symbol: math.tau * np.round((ours[symbol] - found[symbol]) / math.tau) for symbol in angles}
    found |= {symbol: found[symbol] + np.nan_to_num(turns) for symbol, turns in turned.items()}
    found |= {symbol: column for symbol, column in reference.further(solution).items() if symbol not in found}
    if efforts:
        effort, by_work = efforts
        found[by_work] = found[effort]
    return found | reference.outputs(solution, found)


def _lost(book: Book, plan: Plan) -> tuple[set[str], set[str]]:
    """Quantities of sheets that somebody has deleted, and those of other sheets that can have no number without them."""
    gone = {key for key, title in plan.at.titles.items() if key in MAY_GO and book.sheet(title) is None}
    titles = {plan.at.titles[key] for key in gone}
    deleted = {symbol for symbol, spot in plan.at.spots.items() if spot.sheet in titles}
    lost = readers(plan.equations, deleted)
    if plan.mechanism.flywheel is not None and gone & with_what_they_read(MEAN_NEEDS):
        lost.add(ENERGY)
    return deleted, lost - deleted


def _judged(plan: Plan) -> list[str]:
    fixed = [f"{point}.{axis}" for point in plan.mechanism.ground.points for axis in "xy"]
    columns = [equation.symbol for equation in plan.equations.columns if equation.role in RESULTS]
    given = (plan.mechanism.driver.symbol, *plan.mechanism.given_by_row)
    judged = list(dict.fromkeys([*given, *fixed, *columns]))
    return [symbol for symbol in judged if symbol in plan.at.spots]


def _column(plan: Plan, values: Any, symbol: str) -> Array:
    """A column of the table in internal units, NaN where it holds no number."""
    spot = plan.at.spots[symbol]
    if not spot.column:
        cell = values.get(spot.sheet, spot.row, spot.col)
        number = cell if isinstance(cell, float) else math.nan
        return np.full(plan.rows, math.radians(number) if spot.degrees else number)
    return numbers_in(values, spot.sheet, spot.col, plan.at.first, plan.at.last, spot.degrees)


def _elsewhere(plan: Plan, ours: Mapping[str, Array], theirs: Mapping[str, Array], size: float) -> NDArray[np.bool_]:
    """Rows in which something lies farther from where the reference has it than a dead centre makes uncertain."""
    found = np.zeros(plan.rows, dtype=bool)
    for symbol in ours.keys() & {each.symbol for each in plan.equations.columns if each.role in ("variable", "point")}:
        turns = plan.equations.of(symbol).unit.kind == "angle"
        found |= apart_of(ours[symbol], np.asarray(theirs[symbol], float), turns, max(size, 1e-300)) > DEAD_CENTRE
    return found


def _reached(
    solution: reference.Solution, mechanism: Mechanism, equations: Equations, driver: Array
) -> tuple[reference.Solution, NDArray[np.bool_]]:
    """Of a mechanism that Newton's method solves: the solution without the rows that it does not reach from row to row,
    and the rows behind a gap or a leap that the sheet tells, in which any assembly will do."""
    values = sweep(mechanism, equations, driver)
    there = equations.closed(values)
    exists = solution.exists & there
    home = next(group.system.row for group in equations.groups if group.system is not None)
    gaps = np.flatnonzero(~there)
    leaps = np.flatnonzero(_leapt(equations, values, solution.size))
    before = np.concatenate([gaps[gaps < home], leaps[leaps <= home]])
    after = np.concatenate([gaps[gaps > home], leaps[leaps > home] - 1])
    rows = np.arange(len(there))
    beyond = (rows < before.max(initial=-1)) | (rows > after.min(initial=len(rows)))
    return replace(solution, exists=exists), beyond


def _leapt(equations: Equations, values: Mapping[str, Array], size: float) -> NDArray[np.bool_]:
    """Rows in which an unknown leaves its trend, as the sheet measures it: perhaps for another assembly."""
    found = np.zeros(len(next(iter(values.values()))), bool)
    for group in equations.groups:
        for name in () if group.system is None else group.system.variables:
            scale = 1.0 if equations.of(name).unit.kind == "angle" else size
            column = values[name]
            bend = np.diff(column, 2, prepend=column[:1])  # in the second row how far it goes
            with np.errstate(invalid="ignore"):
                found[1:] |= np.abs(bend) > math.radians(LEAP) * scale
    return found


def _start(
    mechanism: Mechanism, inputs: Inputs, equations: Equations | None
) -> dict[str, tuple[float, float, float]] | None:
    """A completed sketch for the reference: link poses in the first row that exists, by fresh equations, roughly.

    The reference needs to know which assembly is meant, also where the sketch leaves it open or a person has flipped a
    mode. The poses are rounded to three digits: Newton's method finds the position itself.
    """
    try:
        return rough_poses(mechanism, equations or solve(mechanism, inputs.modes))
    except MechanismError:
        return None  # it assembles nowhere: the reference will find that by itself

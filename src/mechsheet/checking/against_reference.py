"""The engine's values against the reference: Newton's method on link poses, straight from the description inside."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet import reference
from mechsheet.checking.conditioning import excused
from mechsheet.checking.inputs import Array, Inputs, inputs_in
from mechsheet.checking.report import TOLERANCE, Comparison, Tally
from mechsheet.checking.undefined_dimensions import missing_dimensions, readers
from mechsheet.diagnostics import MechanismError
from mechsheet.formula.book import Book
from mechsheet.formula.references import cell_address
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.sweep import rough_poses
from mechsheet.model import Mechanism
from mechsheet.sheet.plan import Plan

DEAD_CENTRE = 1e-6
"""At a dead centre a position is as uncertain as the square root of rounding: two answers that both close the loops to
CLOSED agree when they are this near."""


CLOSED = 1e-11
"""A closure residual, as a part of the size, that is nothing but rounding."""


def against_plan(book: Book, values: Any, plan: Plan, shown: str) -> tuple[Comparison, list[str]]:
    """Compare every variable, point and output, row by row, with what the reference finds for the inputs in the cells.

    `values` is the engine's, `plan` that of the description inside the workbook. Returns the comparison, and remarks for a
    person.
    """
    mechanism = plan.mechanism
    inputs = inputs_in(book, values, plan, shown)
    if missing := missing_dimensions(mechanism, inputs.dimensions):
        lost = readers(plan.equations, missing)
        words = [f"{symbol} has no value with these dimensions: {why}" for symbol, why in missing.items()]
        return _nowhere(plan, values, lost), [*inputs.remarks, *words, UNREACHED]
    start = _start(mechanism, inputs)
    if start is None:
        return _nowhere(plan, values), [*inputs.remarks, NOWHERE]
    solution = reference.solve(mechanism, inputs.dimensions, start=start, values=inputs.driver)
    theirs = reference.variables(solution)
    tally = Tally("reference")
    known = _Known(plan, values)
    ours = {symbol: known[symbol] for symbol in _judged(plan) if symbol in theirs}
    placed = {symbol: known[symbol] for symbol in theirs if symbol in plan.at.spots or symbol in plan.plain}
    closed = _closed_rows(mechanism, solution, placed)
    for symbol, column in ours.items():
        _compare_column(plan, tally, symbol, column, theirs, solution, closed)
    return tally.result(), list(inputs.remarks)


NOWHERE = "with these dimensions and modes no row exists: there is no position to compare, only that none is shown"


UNREACHED = "the reference cannot be asked: compared is only that no number is shown of what depends on them"


def _nowhere(plan: Plan, values: Any, symbols: Collection[str] | None = None) -> Comparison:
    """Nothing assembles: every result (or each of `symbols`) must say so."""
    tally = Tally("reference")
    for equation in plan.equations.columns:
        if equation.role in ("variable", "point", "output") and (symbols is None or equation.symbol in symbols):
            spot = plan.at.spots[equation.symbol]
            for row, value in enumerate(_column(plan, values, equation.symbol)):
                where = f"{cell_address(spot.sheet, plan.at.first + row, spot.col)} ({equation.symbol}, row {row})"
                tally.note(0.0 if math.isnan(value) else math.inf, where, float(value), None)
    return tally.result()


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


def _judged(plan: Plan) -> list[str]:
    kinds = ("variable", "point", "output")
    fixed = [f"{point}.{axis}" for point in plan.mechanism.ground.points for axis in "xy"]
    columns = [equation.symbol for equation in plan.equations.columns if equation.role in kinds]
    judged = dict.fromkeys([plan.mechanism.driver.symbol, *fixed, *columns])
    return [symbol for symbol in judged if symbol in plan.at.spots]


def _column(plan: Plan, values: Any, symbol: str) -> Array:
    """A column of the table in internal units, NaN where it holds no number."""
    spot = plan.at.spots[symbol]
    if not spot.column:
        cell = values.get(spot.sheet, spot.row, spot.col)
        number = cell if isinstance(cell, float) else math.nan
        return np.full(plan.rows, math.radians(number) if spot.degrees else number)
    cells = values.column(spot.sheet, spot.col, plan.at.first, plan.at.last)
    found = np.array([cell if isinstance(cell, float) else math.nan for cell in cells], dtype=float)
    return np.radians(found) if spot.degrees else found


def _closed_rows(mechanism: Mechanism, solution: Any, ours: Mapping[str, Array]) -> NDArray[np.bool_]:
    """Rows in which our positions close every loop to rounding: there a larger difference is a dead centre's uncertainty."""

    worst, _ = reference.worst(reference.residuals(mechanism, solution.dimensions, ours))
    closed: NDArray[np.bool_] = np.nan_to_num(worst, nan=math.inf) < CLOSED * max(solution.size, 1e-300)
    return closed


def _compare_column(
    plan: Plan,
    tally: Tally,
    symbol: str,
    ours: Array,
    found: Mapping[str, Array],
    solution: reference.Solution,
    closed: NDArray[np.bool_],
) -> None:
    spot = plan.at.spots[symbol]
    theirs = np.asarray(found[symbol], float)
    output = next((out for out in plan.mechanism.outputs if out.symbol == symbol), None)
    unit = plan.equations.of(symbol).unit.kind if symbol != plan.mechanism.driver.symbol else ""
    is_angle = unit == "angle" or (unit == "" and plan.mechanism.driver.unit.kind == "angle")
    scale = solution.size if output is None or unit == "length" else 1.0
    with np.errstate(invalid="ignore"):
        gap = ours - theirs
        if is_angle:
            gap = np.remainder(gap + math.pi, math.tau) - math.pi
        else:
            gap = gap / (scale if output is None or unit == "length" else np.maximum(1.0, np.abs(theirs)))
    apart = np.abs(gap)
    both_missing = np.isnan(theirs) if not spot.column else np.isnan(ours) & np.isnan(theirs)
    apart = np.where(both_missing, 0.0, np.where(np.isnan(apart), math.inf, apart))
    at_dead_centre = closed & (apart <= DEAD_CENTRE)
    apart = np.where(at_dead_centre, np.minimum(apart, TOLERANCE), apart)
    if output is not None and (apart > TOLERANCE).any():
        steep = (apart > TOLERANCE) & excused(solution, found, symbol, ours, 1.0 if is_angle else scale)
        apart = np.where(steep, 0.0, apart)
    tally.cells += len(apart) - 1
    row = int(np.argmax(apart))
    where = (
        f"{cell_address(spot.sheet, plan.at.first + row if spot.column else spot.row, spot.col)} ({symbol}, row {row})"
    )
    tally.note(float(apart[row]), where, float(ours[row]), float(theirs[row]))


def _start(mechanism: Mechanism, inputs: Inputs) -> dict[str, tuple[float, float, float]] | None:
    """A completed sketch for the reference: link poses in the first row that exists, by fresh equations, roughly.

    The reference needs to know which assembly is meant, also where the sketch leaves it open or a person has flipped a
    mode. The poses are rounded to three digits: Newton's method finds the position itself.
    """

    changed = replace(
        mechanism,
        dimensions=tuple(
            dim if dim.derived else replace(dim, value=inputs.dimensions[dim.symbol]) for dim in mechanism.dimensions
        ),
        driver=replace(mechanism.driver, values=tuple(float(value) for value in inputs.driver)),
    )
    try:
        return rough_poses(changed, inputs.modes)
    except MechanismError:
        return None  # it assembles nowhere: the reference will find that by itself

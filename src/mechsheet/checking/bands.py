"""Bands by tolerances against the reference: derivatives by dimensions as differences of whole solutions.

    dQ/dd = sum of c_k Q(d + k h) / h,   k = -4 ... 4

with the weights that are exact for polynomials of degree eight. How far they can be trusted is told by those of degree six:
where both differ (beside a limit, where a position comes to its end within h) nothing finer is asked.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.references import cell_address
from mechsheet import reference
from mechsheet.checking.comparison import Array, Tally
from mechsheet.kinematics.numeric import value as number_of
from mechsheet.kinematics.rates.sensitivity import by_symbol, toleranced
from mechsheet.model import WAYS
from mechsheet.sheet.columns.bands import ROOT, WORST, part_of, tolerance_symbol
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.table.tolerance import Line, lines_of

EIGHT = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
SIX = {1: 3 / 4, 2: -3 / 20, 3: 1 / 60}
"""Weights of Q(d + k h) - Q(d - k h)."""

STEP = 1e-3
"""h, as a part of the dimension."""

ROUNDING = 1e-12
"""Of the largest number in a column: what a difference of solutions cannot tell, h in parts of the dimension."""

Number = Callable[[str, int, int], float]
"""What a cell (sheet, row, column) holds, NaN for no number."""

Solve = Callable[[Array], reference.Solution]
"""The reference's solution at values of the driver."""


@dataclass(frozen=True, slots=True)
class Derivative:
    """Of a quantity by a dimension, (n,); `uncertain`: by how much it may be wrong."""

    value: Array
    uncertain: Array

    def part(self, rows: slice) -> Derivative:
        """In some rows."""
        return Derivative(self.value[rows], self.uncertain[rows])


Found: TypeAlias = Mapping[str, Mapping[str, Derivative]]
"""By dimension and quantity."""


def derivatives(
    solution: reference.Solution, by: str, quantities: Mapping[str, bool], size: float
) -> dict[str, Derivative]:
    """dQ/dd of quantities in internal units; NaN where a position ends within the steps.

    quantities  whether each is an angle: then a difference of whole turns is none
    """
    own = solution.dimensions[by]
    step = STEP * (abs(own) or size)
    moved = {
        k: reference.variables(reference.nearby(solution, {by: own + k * step})) for k in (*range(-4, 0), *range(1, 5))
    }
    found = {}
    with np.errstate(invalid="ignore"):
        for name, turns in quantities.items():
            apart = {k: moved[k][name] - moved[-k][name] for k in EIGHT}
            if turns:
                apart = {k: np.remainder(each + math.pi, math.tau) - math.pi for k, each in apart.items()}
            eight, six = (
                np.asarray(sum(weight * apart[k] for k, weight in weights.items())) / step for weights in (EIGHT, SIX)
            )
            largest = max(float(np.nanmax(np.abs(moved[1][name]), initial=0.0)), size)
            found[name] = Derivative(eight, np.abs(eight - six) + ROUNDING * largest / step)
    return found


def compare_bands(
    plan: Plan, tally: Tally, number: Number, solve: Solve, driver: Array, dead: NDArray[np.bool_]
) -> None:
    """Judge the sheet of tolerances.

    driver  its value in each row;  dead  rows in which a group is at a dead centre, so that there may be no derivative
    """
    judge = _Judge(plan, tally, number)
    extremes = [(line, places) for line in lines_of(plan) if (places := judge.places(line))]
    # behind the rows: one row alone would not tell the assembly
    solution = solve(np.concatenate([driver, *(places for _, places in extremes)]))
    found = judge.found(solution)
    judge.rows(found, dead)
    first = len(driver)
    for line, places in extremes:
        judge.line(line, found, range(first, first + len(places)))
        first += len(places)


class _Judge:
    def __init__(self, plan: Plan, tally: Tally, number: Number) -> None:
        self.plan, self.tally, self.number = plan, tally, number
        self.title = plan.at.titles["tolerance"]
        self.kinds = {name: plan.equations.of(name).unit.kind for name in plan.banded}
        self.units = {dim.symbol: dim.unit for dim in toleranced(plan.mechanism)}
        self.tolerances = {name: self._tolerance(name) for name in self.units}

    def _tolerance(self, name: str) -> float:
        return self._cell(tolerance_symbol(name))

    def _cell(self, name: str) -> float:
        spot = self.plan.at.spots[name]
        return self.number(spot.sheet, spot.row, spot.col)

    def found(self, solution: reference.Solution) -> Found:
        """By dimension and quantity, as people read them."""
        turns = {name: kind == "angle" for name, kind in self.kinds.items()}
        result = {}
        for name, unit in self.units.items():
            all_found = derivatives(solution, name, turns, self.plan.size)
            result[name] = {
                quantity: Derivative(
                    *(self._shown(quantity) / unit.factor * part for part in (each.value, each.uncertain))
                )
                for quantity, each in all_found.items()
            }
        return result

    def _shown(self, quantity: str) -> float:
        return self.plan.mechanism.shown(self.plan.equations.of(quantity).unit).factor

    def rows(self, found: Found, dead: NDArray[np.bool_]) -> None:
        """Derivatives and what they come to, row by row."""
        for quantity, band in self.plan.banded.items():
            by = {name: found[name][quantity].part(slice(len(dead))) for name in self.units}
            columns = {by_symbol(quantity, name): by[name] for name in band.dimensions}
            worst, root = self._sums(by)
            columns |= {part_of(quantity, WORST): worst, part_of(quantity, ROOT): root}
            for symbol, each in columns.items():
                spot, largest = self.plan.at.spots[symbol], self._scale(quantity, by, symbol)
                for row in map(int, np.flatnonzero(np.isfinite(each.value))):
                    if dead[row] and math.isnan(self.number(self.title, spot.row + row, spot.col)):
                        continue
                    value, uncertain = float(each.value[row]), float(each.uncertain[row])
                    self._note(symbol, spot.row + row, spot.col, value, uncertain, largest)

    def _scale(self, quantity: str, by: Mapping[str, Derivative], symbol: str) -> float:
        """What a difference is measured by: the largest change that the dimensions, in parts of themselves, bring about; by
        one of them, or by the tolerances together."""
        own = {name: abs(self._cell(name)) or self.plan.size for name in self.units}
        reach = max(_largest(each.value) * own[name] for name, each in by.items())
        natural = {"angle": 1.0, "length": self.plan.size}.get(self.kinds[quantity], 1.0)
        reach = max(reach, natural * self._shown(quantity))
        name = symbol.removeprefix(f"{quantity}:")
        return reach / own[name] if name in own else reach * max(self.tolerances[each] / own[each] for each in own)

    def _sums(self, by: Mapping[str, Derivative]) -> tuple[Derivative, Derivative]:
        """Worst case and root sum of squares."""
        parts = np.array([np.abs(each.value * self.tolerances[name]) for name, each in by.items()])
        uncertain = np.sum([each.uncertain * self.tolerances[name] for name, each in by.items()], axis=0)
        return Derivative(parts.sum(axis=0), uncertain), Derivative(np.sqrt((parts**2).sum(axis=0)), uncertain)

    def _note(self, symbol: str, row: int, col: int, theirs: float, uncertain: float, scale: float) -> None:
        """Both agree as far as can be told; where that is not far (beside a limit) nothing is said."""
        if not uncertain < 1e-3 * max(scale, abs(theirs)):
            return
        ours = self.number(self.title, row, col)
        apart = max(0.0, abs(ours - theirs) - uncertain) / max(abs(theirs), scale, 1e-300)
        where = f"{cell_address(self.title, row, col)} ({symbol})"
        self.tally.note(math.inf if math.isnan(ours) else apart, where, ours, theirs)

    # --- below the table --------------------------------------------------------------------------------------

    def places(self, line: Line) -> list[float]:
        """Values of the driver where the extremes are that a line is of; none for one that is of no extreme."""
        mechanism = self.plan.mechanism
        if mechanism.driver.law is not None or mechanism.listed_symbols:
            return []  # the reference has no positions between their rows
        ways = reversed(line.summary.take.ways) if line.summary else ()  # what is largest first
        spots = [self.plan.searched.extremes[way, line.quantity].occurs for way in ways]
        found = [self.number(spot.sheet, spot.row, spot.col) for spot in spots]
        unit = mechanism.driver.unit
        return [unit.to_internal(place) for place in found] if np.isfinite(found).all() else []

    def line(self, line: Line, found: Found, rows: range) -> None:
        """The line of a summary: its take of the derivatives in these rows, that of what is largest first."""
        take, by = line.summary.take if line.summary else None, {}
        parts = [part for part in reversed(WAYS) if take and part in take.parts]
        for name in self.units:
            each = found[name][line.quantity].part(slice(rows.start, rows.stop))
            taken = number_of(take.value, dict(zip(parts, each.value, strict=True))) if take else each.value
            by[name] = Derivative(np.atleast_1d(taken), np.array([each.uncertain.sum()]))
        for part, each in zip((WORST, ROOT), self._sums(by), strict=True):
            symbol = part_of(line.quantity, part)
            col, scale = self.plan.at.spots[symbol].col, self._scale(line.quantity, by, symbol)
            if np.isfinite(each.value[0]) and not math.isnan(self.number(self.title, line.row, col)):
                name = f"{part} {line.key}"
                self._note(name, line.row, col, float(each.value[0]), float(each.uncertain[0]), scale)


def _largest(column: Array) -> float:
    return float(np.nanmax(np.abs(column), initial=0.0))

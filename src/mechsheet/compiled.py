"""All that follows from a mechanism, each part computed when it is first asked for, and once: nobody solves twice."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import WorkbookError
from livesheet.evaluation import computed, live
from livesheet.formula.nodes import Scalar
from livesheet.workbook import Workbook
from mechsheet import sheet
from mechsheet.diagnostics import MechanismError
from mechsheet.dynamics.solve import solve
from mechsheet.dynamics.whole_mechanism import Flywheel, flywheel
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import ENERGY, ChartRequest, Mechanism, energy_unit
from mechsheet.model.names import names_of
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.plan import Plan
from mechsheet.units import LENGTH, Unit

if TYPE_CHECKING:
    from livesheet.engine import Live


class Compiled:
    """A mechanism, its equations, their values over the sweep, its workbook.

    modes  assembly modes that are given instead of picked from the sketch, by symbol

    Every part raises MechanismError where the mechanism cannot be solved.
    """

    def __init__(self, mechanism: Mechanism, modes: Mapping[str, int] | None = None) -> None:
        self.mechanism = mechanism
        self._given = modes

    @cached_property
    def equations(self) -> Equations:
        """The equations in order of solution."""
        return solve(self.mechanism, self._given)

    @property
    def modes(self) -> dict[str, int]:
        """The assembly mode of each group that has two, by symbol."""
        return {group.mode: group.mode_value for group in self.equations.groups if group.mode}

    @cached_property
    def given(self) -> Mapping[str, Array]:
        """Of every row the driver's value, and what is given beside it: the time of a motion law, listed speeds."""
        return given_values(self.mechanism, dimension_values(self.mechanism))

    @property
    def driver(self) -> Array:
        """The driver's values [rad or length unit]."""
        return self.given[self.mechanism.driver.symbol]

    @cached_property
    def values(self) -> Mapping[str, Array]:
        """Every symbol's values over the sweep, in internal units; NaN where a position does not exist."""
        return sweep(self.mechanism, self.equations, self.given)

    @cached_property
    def flywheel(self) -> Flywheel | None:
        """The flywheel that the description asks for."""
        return flywheel(self.mechanism, self.equations, self.values)

    @property
    def closed(self) -> NDArray[np.bool_]:
        """True in the rows in which every group can be joined, by the equations' own values."""
        return self.equations.closed(self.values)

    @cached_property
    def _laid_out(self) -> tuple[Workbook, Plan]:
        page = self.mechanism.layout == "page"
        lay_out = sheet.lay_out_page if page else sheet.lay_out
        return lay_out(self.mechanism, self.equations)

    @property
    def layout(self) -> Workbook:
        """The workbook, its formulas without values yet."""
        return self._laid_out[0]

    @property
    def plan(self) -> Plan:
        """Where everything is in the workbook."""
        return self._laid_out[1]

    @cached_property
    def workbook(self) -> Workbook:
        """The workbook with the value of every formula."""
        return computed(self.layout, self.cells)

    @cached_property
    def cells(self) -> Live:
        """What the workbook's cells show, each computed when it is asked for."""
        return live(self.layout)

    def column(self, col: int) -> list[Scalar]:
        """What a column of the table of positions shows, row by row."""
        return self._shown(self.plan.table, col, self.plan.at.first, self.plan.at.last)

    def value(self, spot: Spot, row: int = 0) -> Scalar:
        """What a cell shows, or that row (from 0) of a column."""
        place = self.plan.at.first + row if spot.column else spot.row
        return self._shown(spot.sheet, spot.col, place, place)[0]

    def number(self, spot: Spot, row: int = 0) -> float:
        """The number in a cell, or in that row (from 0) of a column; NaN for anything but a number."""
        value = self.value(spot, row)
        return value if isinstance(value, float) else math.nan

    def _shown(self, title: str, col: int, first: int, last: int) -> list[Scalar]:
        """What some rows of a column show. Raises WorkbookError as `computed` does."""
        values = self.cells.asked()
        found = values.column(title, col, first, last)
        if values.remarks:
            raise WorkbookError(values.remarks)
        return found

    @cached_property
    def exists(self) -> tuple[bool, ...]:
        """In which rows the table of positions shows a position."""
        ok = self.plan.ok
        return tuple(value == ok for value in self.column(self.plan.status_column))


def compiled_of(mechanism: Mechanism) -> Compiled:
    """A mechanism compiled; a linkage (`mechsheet.load`) keeps what was compiled of it."""
    kept: Compiled | None = getattr(mechanism, "_compiled", None)
    return Compiled(mechanism) if kept is None else kept


# --- the sweep as people read it --------------------------------------------------------------------------------------

SHOWN_ROLES = ("variable", "point", "rate", "force", "output")


def motion_of(compiled: Compiled) -> tuple[dict[str, Array], dict[str, str]]:
    """Driver (with the time of a motion law, with listed speeds), variables, points, rates, forces and outputs, row by row;
    the unit of each: "°", "mm", "" for a plain number.

    Angles are continuous; NaN in rows in which some group cannot be joined; no rates at dead centres. Raises MechanismError.
    """
    mechanism, values, exists = compiled.mechanism, compiled.values, compiled.closed
    unit = mechanism.driver.unit
    columns: dict[str, Array] = {
        mechanism.driver.symbol: np.array([unit.written(float(value)) for value in compiled.driver])
    }
    units = {mechanism.driver.symbol: unit.text}
    for symbol in mechanism.given_by_row:
        own = mechanism.given_unit(symbol) or unit
        shown = mechanism.shown(own)
        columns[symbol] = np.array([shown.written(float(value)) for value in compiled.given[symbol]])
        units[symbol] = shown.text
    for equation in compiled.equations.columns:
        symbol = equation.symbol
        if equation.role not in SHOWN_ROLES or symbol in columns:
            continue
        unit = mechanism.shown(equation.unit)
        units[symbol] = unit.text
        columns[symbol] = _as_shown(values[symbol], exists, unit)
    if compiled.flywheel is not None and mechanism.dynamics is not None:
        columns[ENERGY] = compiled.flywheel.energy
        units[ENERGY] = energy_unit(mechanism.dynamics, mechanism.length_unit)
    return columns, units


def further_of(compiled: Compiled) -> tuple[dict[str, Array], dict[str, str]]:
    """Every other name that a description may read (`names_of`), in columns as those of `motion_of`: what nobody shows.

    The equations are written once more, as for a chart of all of them: a rate that nobody reads has no equation. Nothing
    where that is refused: a driver whose values are listed says nothing of its speed.
    """
    mechanism = compiled.mechanism
    names = names_of(mechanism)
    chart = ChartRequest(None, "", names, (), ())
    try:
        whole = Compiled(replace(mechanism, charts=(*mechanism.charts, chart)), compiled.modes)
        values, exists = whole.values, whole.closed
    except MechanismError:
        return {}, {}
    own = {equation.symbol: equation.unit for equation in whole.equations.all}
    own |= {dim.symbol: dim.unit for dim in mechanism.dimensions}
    fixed = {f"{point}.{axis}" for point in mechanism.ground.points for axis in "xy"}
    columns: dict[str, Array] = {}
    units: dict[str, str] = {}
    for name in names:
        if name not in values:
            continue
        unit = mechanism.shown(LENGTH if name in fixed else own[name])
        units[name] = unit.text
        columns[name] = _as_shown(values[name], exists, unit)
    return columns, units


def _as_shown(values: Array, exists: NDArray[np.bool_], unit: Unit) -> Array:
    """A column in the unit that people read; NaN in rows that do not exist, or where it has no value."""
    return np.where(exists & np.isfinite(values), unit.to_shown(values), np.nan)

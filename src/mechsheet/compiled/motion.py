"""The sweep in the units that people read, from the equations in numpy: no workbook is laid out for it."""

from __future__ import annotations

import numpy as np

from mechsheet.compiled.mechanism import Compiled
from mechsheet.kinematics.numeric import Array
from mechsheet.model import ENERGY, energy_unit

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
        columns[symbol] = np.where(exists & np.isfinite(values[symbol]), unit.to_shown(values[symbol]), np.nan)
    if compiled.flywheel is not None and mechanism.dynamics is not None:
        columns[ENERGY] = compiled.flywheel.energy
        units[ENERGY] = energy_unit(mechanism.dynamics, mechanism.length_unit)
    return columns, units

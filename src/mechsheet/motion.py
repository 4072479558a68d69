"""The sweep in the units that people read, from the equations in numpy: no workbook is laid out for it."""

from __future__ import annotations

import numpy as np

from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.solve import dimension_values, driver_values, solve
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Mechanism

SHOWN_ROLES = ("variable", "point", "output")


def motion_of(mechanism: Mechanism) -> tuple[dict[str, Array], dict[str, str]]:
    """Driver, variables, points and outputs, row by row, and the unit of each: "°", "mm", "" for a plain number.

    Angles are continuous; NaN in rows in which some group cannot be joined. Raises MechanismError.
    """
    equations = solve(mechanism)
    driver = driver_values(mechanism, dimension_values(mechanism))
    values = sweep(mechanism, equations, driver)
    exists = np.ones(len(driver), bool)
    for group in equations.groups:
        exists &= np.isfinite(values[group.closes])
    unit = mechanism.driver.unit
    columns: dict[str, Array] = {mechanism.driver.symbol: np.array([unit.written(float(value)) for value in driver])}
    units = {mechanism.driver.symbol: unit.text}
    for equation in equations.columns:
        symbol = equation.symbol
        if equation.role not in SHOWN_ROLES or symbol in columns:
            continue
        unit = mechanism.shown(equation.unit)
        units[symbol] = unit.text
        columns[symbol] = np.where(exists & np.isfinite(values[symbol]), unit.to_shown(values[symbol]), np.nan)
    return columns, units

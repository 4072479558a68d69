"""The sweep in the units that people read, from the equations in numpy: no workbook is laid out for it."""

from __future__ import annotations

import math

import numpy as np

from mechsheet.compiled.mechanism import Compiled
from mechsheet.kinematics.numeric import Array
from mechsheet.sheet.plan import unit_shown, unit_text
from mechsheet.sheet.positions import shown_number

SHOWN_ROLES = ("variable", "point", "output")


def motion_of(compiled: Compiled) -> tuple[dict[str, Array], dict[str, str]]:
    """Driver, variables, points and outputs, row by row, and the unit of each: "°", "mm", "" for a plain number.

    Angles are continuous; NaN in rows in which some group cannot be joined. Raises MechanismError.
    """
    mechanism, values, exists = compiled.mechanism, compiled.values, compiled.closed
    degrees = mechanism.driver.unit == "deg"
    columns: dict[str, Array] = {
        mechanism.driver.symbol: np.array([shown_number(value, degrees) for value in compiled.driver])
    }
    units = {mechanism.driver.symbol: unit_text(mechanism.driver.unit)}
    outputs = {output.symbol: unit_text(output.unit) for output in mechanism.outputs}
    for equation in compiled.equations.columns:
        symbol = equation.symbol
        if equation.role not in SHOWN_ROLES or symbol in columns:
            continue
        units[symbol] = outputs.get(symbol, unit_shown(mechanism, equation.unit))
        factor = math.degrees(1.0) if units[symbol] == "°" else 1.0
        columns[symbol] = np.where(exists & np.isfinite(values[symbol]), values[symbol] * factor, np.nan)
    return columns, units

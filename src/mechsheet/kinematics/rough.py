"""The equations in numbers, without a sheet: whole sweeps for a look, and rough poses as a sketch for the reference."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import Array, evaluate_column
from mechsheet.kinematics.solve import dimension_values, driver_values, number, solve
from mechsheet.model import Cartesian, Link, Mechanism, Polar

CHUNKS = (200, 4_000)
"""Rows looked at first, and next, for one that exists; then all."""

DIGITS = 3
"""Poses are rounded to so many digits of the size: a sketch, not an answer."""


def sweep(mechanism: Mechanism, equations: Equations, driver: Array) -> dict[str, Array]:
    """Every symbol's values over the given driver values; NaN where a position does not exist."""
    rows = len(driver)
    values = {symbol: np.full(rows, value) for symbol, value in dimension_values(mechanism).items()}
    values[mechanism.driver.symbol] = driver
    for group in equations.groups:
        if group.mode:
            values[group.mode] = np.full(rows, float(group.mode_value))
    for equation in equations.all:
        values[equation.symbol] = evaluate_column(equation, values, rows)
    return values


def rough_poses(mechanism: Mechanism, modes: Mapping[str, int]) -> dict[str, tuple[float, float, float]]:
    """(x, y, theta) of each moving link's frame, rounded, in the first row in which every group closes.

    Raises MechanismError when there is none.
    """
    equations = solve(mechanism, modes)
    dimensions = dimension_values(mechanism)
    driver = driver_values(mechanism, dimensions)
    for count in (*CHUNKS, len(driver)):
        values = sweep(mechanism, equations, driver[:count])
        exists = np.ones(len(driver[:count]), bool)
        for group in equations.groups:
            exists &= np.isfinite(values[group.closes])
        if exists.any() or count >= len(driver):
            break
    row = int(np.argmax(exists))
    size = max([abs(value) for value in dimensions.values()], default=1.0) or 1.0
    return {
        link.name: _pose(link, {name: float(column[row]) for name, column in values.items()}, dimensions, size)
        for link in mechanism.links[1:]
    }


def _pose(
    link: Link, values: Mapping[str, float], dimensions: Mapping[str, float], size: float
) -> tuple[float, float, float]:
    theta = values[link.angle_symbol]
    for point, place in link.points.items():
        if isinstance(place, Cartesian):
            u, v = number(place.x, dimensions), number(place.y, dimensions)
        elif isinstance(place, Polar):
            r, angle = number(place.r, dimensions), number(place.angle, dimensions)
            u, v = r * math.cos(angle), r * math.sin(angle)
        else:
            continue
        x = values[f"{point}.x"] - u * math.cos(theta) + v * math.sin(theta)
        y = values[f"{point}.y"] - u * math.sin(theta) - v * math.cos(theta)
        return (round(x / size, DIGITS) * size, round(y / size, DIGITS) * size, round(theta, DIGITS))
    return (0.0, 0.0, theta)

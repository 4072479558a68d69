"""The equations in numbers, without a sheet: whole sweeps for a look, and rough poses as a sketch for the reference."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import Root
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values, listed_values
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.newton.system import CLOSED, followed, refined
from mechsheet.kinematics.numeric import Array, evaluate_equation, value
from mechsheet.model import Mechanism

CHUNKS = (200, 4_000)
"""Rows looked at first, and next, for one that exists; then all."""

DISTINCT = 0.1
"""From this part of the largest distance between its assemblies on, roughly given poses show which one is meant."""

DIGITS = 3
"""Poses are rounded to so many digits of the size: a sketch, not an answer."""


def sweep(
    mechanism: Mechanism,
    equations: Equations,
    given: Array | Mapping[str, Array],
    turned: Mapping[str, Callable[[Array], Array]] | None = None,
) -> dict[str, Array]:
    """Every symbol's values; NaN where a position does not exist.

    given   the driver's values, and what is given beside them (`given_values`); the driver's values alone where positions
            are all that is asked for: then what needs the rest is NaN
    turned  angle -> what takes its column into other turns, before anything reads it
    """
    taken = turned or {}
    rowwise = given if isinstance(given, Mapping) else {mechanism.driver.symbol: given}
    rows = len(rowwise[mechanism.driver.symbol])
    known: dict[str, Array] = {symbol: np.array(number) for symbol, number in dimension_values(mechanism).items()}
    known |= {group.mode: np.array(float(group.mode_value)) for group in equations.groups if group.mode}
    known |= dict.fromkeys(mechanism.given_by_row, np.full(rows, np.nan))
    if not isinstance(given, Mapping):
        known |= listed_values(mechanism, dimension_values(mechanism), given)
    known |= dict(rowwise)
    seen: dict[Any, Any] = {}
    for equation in equations.constants:
        known[equation.symbol] = evaluate_equation(equation, known, 1)[0]
    for equation in equations.columns:
        if isinstance(equation.expression, Root):
            if equation.symbol not in known:
                driver = rowwise[mechanism.driver.symbol]
                known |= _roots(mechanism, equations, equation.symbol, known, driver)
            continue
        column = evaluate_equation(equation, known, rows, seen)
        known[equation.symbol] = taken[equation.symbol](column) if equation.symbol in taken else column
    return {symbol: np.broadcast_to(column, (rows,)) for symbol, column in known.items()}


def _roots(
    mechanism: Mechanism, equations: Equations, symbol: str, known: Mapping[str, Array], driver: Array
) -> dict[str, Array]:
    """The unknowns of a group that Newton's method solves: row by row of the mechanism's own rows, else from the nearest.

    At other values of the driver than those of the rows each starts from the nearest row that has a position.
    """
    system = next(
        group.system for group in equations.groups if group.system is not None and symbol in group.system.unknowns
    )
    own = driver_values(mechanism, dimension_values(mechanism))
    if np.array_equal(own, driver):
        return followed(system, known, len(driver))
    base = sweep(mechanism, equations, own)
    there = np.flatnonzero(np.isfinite(base[system.unknowns[0]]))
    if not len(there) or not len(driver):
        return {name: np.full(len(driver), np.nan) for name in system.unknowns}
    order = there[np.argsort(own[there], kind="stable")]
    after = np.clip(np.searchsorted(own[order], driver), 1, max(len(order) - 1, 1))
    left, right = order[after - 1], order[np.minimum(after, len(order) - 1)]
    nearest = np.where(np.abs(driver - own[left]) <= np.abs(driver - own[right]), left, right)
    found, residual, determinant = refined(system, known, [base[name][nearest] for name in system.unknowns])
    same = (residual <= CLOSED) & (determinant * base[system.determinant][nearest] > 0)
    return {name: np.where(same, column, np.nan) for name, column in zip(system.unknowns, found, strict=True)}


def rough_poses(mechanism: Mechanism, equations: Equations) -> dict[str, tuple[float, float, float]]:
    """(x, y, theta) of each moving link's frame, rounded, in the first row in which every group closes.

    That row is away from dead centres when there is such a row: at a dead centre rough poses do not tell the assemblies
    apart.
    """
    dimensions = dimension_values(mechanism)
    driver = driver_values(mechanism, dimensions)
    for count in (*CHUNKS, len(driver)):
        values = sweep(mechanism, equations, driver[:count])
        good = distinct(equations, values)
        begun = np.where(_followed(equations, values), good, -1.0)
        good = begun if np.any(begun >= 0) else good  # nowhere near its beginning: anywhere
        if np.any(good >= DISTINCT) or count >= len(driver):
            break
    return poses_in(
        mechanism, equations, values, int(np.argmax(np.minimum(good, DISTINCT)))
    )  # good enough, or the best


def poses_in(
    mechanism: Mechanism, equations: Equations, values: Mapping[str, Array], row: int
) -> dict[str, tuple[float, float, float]]:
    """(x, y, theta) of each moving link's frame in one row of a sweep's values, rounded."""
    size = max([abs(value) for value in dimension_values(mechanism).values()], default=1.0) or 1.0
    there = {name: float(column[row]) for name, column in values.items()}
    found = {}
    for link in mechanism.links[1:]:
        x, y = (
            float(value(part, there)) / size for part in (equations.poses[link.name].x, equations.poses[link.name].y)
        )
        found[link.name] = (round(x, DIGITS) * size, round(y, DIGITS) * size, round(there[link.angle_symbol], DIGITS))
    return found


def _followed(equations: Equations, values: Mapping[str, Array]) -> NDArray[np.bool_]:
    """Rows without a gap between them and the row at which Newton's method begins: behind one any assembly may be found."""
    rows = np.arange(len(next(iter(values.values()))))
    found = np.ones(len(rows), bool)
    for group in equations.groups:
        if group.system is not None:
            gaps = np.flatnonzero(~np.isfinite(values[group.closes]))
            home = group.system.row
            found &= (rows > gaps[gaps < home].max(initial=-1)) & (rows < gaps[gaps > home].min(initial=len(rows)))
    return found


def distinct(equations: Equations, values: Mapping[str, Array]) -> Array:
    """How well the assemblies of all groups are told apart, row by row: -1 where one does not close, 0 at a dead centre.

    The measure is what shrinks to nothing at the dead centre, as a part of its largest value.
    """
    found = np.ones_like(next(iter(values.values())))
    for group in equations.groups:
        exists = np.isfinite(values[group.closes])
        part = np.ones_like(found)
        if group.apart is not None:
            apart = np.abs(value(group.apart, values))
            largest = float(np.max(apart[exists], initial=0.0))
            part = apart / largest if largest > 0 else np.zeros_like(apart)
        found = np.where(exists, np.minimum(found, part), -1.0)
    return found

"""First and second derivatives, from the equations and the groups' closures, against two strangers to both.

Variables and points: the reference, which has them from the constraints on link poses, to rounding. Every symbol besides:
differences over eight points around each position, with weights that are exact for polynomials of degree eight.
"""

import numpy as np
import pytest
from closure_rates import PRIME, rates_over

from chosen import ALL, CAMS, ITERATED, LISTED, but, some
from folders import TEMPLATE_FILES
from mechsheet import reference
from mechsheet.description import load, loads
from mechsheet.diagnostics import MechsheetError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import rough_poses, sweep
from random_mechanisms import Grower, compared

ONCE = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
TWICE = np.array([-1 / 560, 8 / 315, -1 / 5, 8 / 5, -205 / 72, 8 / 5, -1 / 5, 8 / 315, -1 / 560])
STEP = 2e-3
CALM = 0.25
"""Rows are judged where each group is this far from its dead centre (of the most in the sweep): beside it differences, which
reach over the limit, are worth nothing."""
DEAD = 1e6
"""A row in which something moves so many times as fast as the driver is a dead centre: there is no derivative."""


def worst_against_reference(mechanism):
    """The largest difference from the reference's derivatives, as a part of size and derivative; how many were compared."""
    equations = solve(mechanism)
    driver = driver_values(mechanism, dimension_values(mechanism))
    rates = rates_over(equations, sweep(mechanism, equations, driver), {mechanism.driver.symbol: (1.0, 0.0)})
    solution = reference.solve(mechanism, start=rough_poses(mechanism, equations))
    stroke = 1.0 if mechanism.driver.unit.kind == "angle" else float(np.max(np.abs(driver)))
    lengths = {equation.symbol for equation in equations.all if equation.unit.kind == "length"}
    expected = reference.rates(solution)
    parts = {symbol: stroke / (solution.size if symbol in lengths else 1.0) for symbol in expected}
    rows = solution.exists.copy()
    for symbol, (once, _) in expected.items():
        rows[rows] = np.abs(once[rows]) * parts[symbol] < DEAD
    assert rows.sum() >= solution.exists.sum() - 2  # where it turns back
    worst = 0.0
    for symbol, derivatives in expected.items():
        for order, column in enumerate(derivatives, 1):
            found = np.broadcast_to(rates.get(symbol + PRIME * order, 0.0), driver.shape)
            size = 1.0 / (parts[symbol] * stroke ** (order - 1))
            error = np.abs(found - column)[rows] / (size + np.abs(column[rows]))
            worst = max(worst, float(np.max(error, initial=0.0)))
            assert np.isfinite(error).all(), (symbol, order)
    return worst, int(rows.sum()) * len(expected)


@pytest.mark.cases(8)
@pytest.mark.parametrize("template", but(TEMPLATE_FILES, *ITERATED, *LISTED), ids=lambda path: path.stem)
def test_templates_against_the_reference(template):
    worst, count = worst_against_reference(load(template))
    assert count > 0
    assert worst < 1e-11


@pytest.mark.slow
def test_random_mechanisms_against_the_reference():
    assert compared(60 if ALL else 15, worst_against_reference, 1e-10) > 5_000


def by_both(mechanism, rows=40):
    """(symbol, which derivative, by differences, by equations, size) of every column, in the calm rows."""
    equations = solve(mechanism)
    driver = driver_values(mechanism, dimension_values(mechanism))[:rows]
    turns = mechanism.driver.unit.kind == "angle"
    step = STEP if turns else STEP * float(np.max(np.abs(driver)))
    grid = (driver[:, None] + step * np.arange(-4, 5)).ravel()
    values = sweep(mechanism, equations, grid)
    rates = rates_over(equations, values, {mechanism.driver.symbol: (1.0, 0.0)})
    calm = np.ones(len(driver), bool)
    for group in equations.groups:
        # The sine of a transmission angle or the like; of lines that cross the sine of the angle between them.
        if group.apart is not None:
            apart = np.abs(value(group.apart, values))
        else:
            crossing = equations.of(group.closes)
            apart = np.abs(values[crossing.symbol]) if crossing.unit.kind == "number" else np.ones(len(grid))
        apart = np.broadcast_to(apart, grid.shape).reshape(-1, 9)
        calm &= np.isfinite(values[group.closes].reshape(-1, 9)).all(axis=1)
        calm &= apart.min(axis=1) >= CALM * np.nanmax(apart, initial=1e-300)
    lengths = [
        abs(dim.value) for dim in mechanism.dimensions if isinstance(dim.value, float) and dim.unit.kind == "length"
    ]
    lengths += [
        float(np.nanmax(np.abs(values[eq.symbol]), initial=0.0)) for eq in equations.columns if eq.role == "point"
    ]
    for equation in equations.columns:
        if equation.symbol == mechanism.driver.symbol or equation.role == "output":
            continue
        table = values[equation.symbol].reshape(-1, 9)
        if equation.unit.kind == "angle" and not equation.unit.per:
            table = np.unwrap(table, axis=1)
        size = max(lengths) if equation.unit.kind == "length" else 1.0
        for order, weights in ((1, ONCE), (2, TWICE)):
            found = np.broadcast_to(rates.get(equation.symbol + PRIME * order, 0.0), grid.shape).reshape(-1, 9)[:, 4]
            scale = step**order
            if not turns:  # per part of the stroke, so that one tolerance serves all
                found, scale = found * float(np.max(np.abs(driver))) ** order, STEP**order
            yield equation.symbol, order, (table @ weights / scale)[calm], found[calm], size


def assert_agree(mechanism, once=1e-8, twice=2e-6):
    judged = 0
    for symbol, order, differences, found, size in by_both(mechanism):
        exists = np.isfinite(differences)
        error = np.abs(differences - found)[exists] / (size + np.abs(found[exists]))
        judged += int(exists.sum())
        assert error.max(initial=0.0) < (once if order == 1 else twice), (symbol, order)
    return judged


BESIDE = ("excavator",)
"""Its first position lies beside a limit, where differences are no judge."""


@pytest.mark.parametrize(
    "template", some(but(TEMPLATE_FILES, *ITERATED, *LISTED, *BESIDE, *CAMS), 5), ids=lambda path: path.stem
)
def test_templates_against_differences(template):
    assert assert_agree(load(template)) > 0


@pytest.mark.slow
def test_random_mechanisms_against_differences():
    judged = 0
    for seed in range(120 if ALL else 25):
        try:
            # Any length may be short against the others here, so that differences are the worse of the two.
            judged += assert_agree(loads(Grower(seed, 1 + seed % 3).text(), "random.toml"), 1e-5, 1e-3)
        except MechsheetError:  # it closes nowhere: a random one may
            continue
        except AssertionError as error:
            raise AssertionError(f"seed {seed}: {error}") from error
    assert judged > 1000

"""Derivatives by dimensions, the driver standing: two strangers have them as well, and 10,000 drawn sets of dimensions.

The reference has them as differences of whole solutions; the closures of the groups, differentiated forwards, dimension by
dimension, to rounding (`closure_rates`). For what has a formula in every textbook the draws are made with that.
"""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from closure_rates import PRIME, rates_over

from chosen import ALL, ITERATED, but, some
from livesheet.formula.nodes import symbols
from mechsheet import reference
from mechsheet.checking.bands import derivatives
from mechsheet.description import load
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.equations import FORCES, RATES
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.rates.sensitivity import determinant_symbol, sensitivities, toleranced
from mechsheet.kinematics.sweep import rough_poses, sweep
from random_mechanisms import compared

pytestmark = pytest.mark.slow

TEMPLATES = [
    path
    for path in but(sorted((Path(__file__).parents[3] / "templates").glob("*.toml")), *ITERATED)
    if "[synthesis" not in path.read_text(encoding="utf-8")  # which finds all their dimensions
]
CALM = 0.02
"""Rows are judged in which each group's determinant is at least this part of its largest: differences reach further."""
DRAWS, SEED = 10_000, 20


def with_tolerances(mechanism, tolerance=0.1):
    """Every input has one."""
    return replace(
        mechanism,
        dimensions=tuple(
            dim if dim.derived or dim.path else replace(dim, tolerance=tolerance) for dim in mechanism.dimensions
        ),
    )


class Found:
    """All derivatives of all positions of a mechanism, over its rows."""

    def __init__(self, mechanism):
        self.mechanism = with_tolerances(mechanism)
        self.equations = solve(self.mechanism)
        given = given_values(self.mechanism, dimension_values(self.mechanism))
        self.driver = given[mechanism.driver.symbol]
        self.values = dict(sweep(self.mechanism, self.equations, given))
        moving = {each.symbol for each in self.equations.columns if each.role in (*RATES, *FORCES)}
        self.quantities = [
            each.symbol
            for each in self.equations.columns
            if each.role in ("variable", "point", "output") and not moving & set(each.reads)
        ]
        found = sensitivities(self.mechanism, self.equations, self.quantities)
        known = dict(self.values)
        self.by, self.calm = {}, np.ones(len(self.driver), bool)
        with np.errstate(all="ignore"):
            known |= {name: value(node, known) for name, node in found.constants.items()}
            for group in self.equations.groups:
                if group.number in found.groups:
                    det = np.broadcast_to(value(group.determinant, known), self.driver.shape)
                    known[determinant_symbol(group.number)] = det
                    self.calm &= np.abs(det) > CALM * np.nanmax(np.abs(det))
            for each in found.of:
                for name, node in each.inner.items():
                    known[name] = value(node, known)
                for name, node in each.by.items():
                    self.by[each.quantity, name] = np.broadcast_to(value(node, known), self.driver.shape)

    def of(self, quantity, dimension):
        return self.by.get((quantity, dimension), np.zeros(len(self.driver)))


def worst_against_reference(mechanism):
    """The largest difference as a part of size and derivative, less what differences cannot tell; how many were compared."""
    found = Found(mechanism)
    own = None if mechanism.driver.law else found.driver
    solution = reference.solve(found.mechanism, start=rough_poses(found.mechanism, found.equations), values=own)
    units = {name: found.equations.of(name).unit.kind for name in found.quantities}
    worst, count = 0.0, 0
    for dim in toleranced(found.mechanism):
        angles = {name: kind == "angle" for name, kind in units.items()}
        theirs = derivatives(solution, dim.symbol, angles, solution.size)
        length = abs(solution.dimensions[dim.symbol]) or 1.0
        for name, other in theirs.items():
            ours = found.of(name, dim.symbol)
            rows = found.calm & np.isfinite(other.value) & np.isfinite(ours)
            natural = (1.0 if units[name] == "angle" else solution.size) / length
            error = np.abs(ours - other.value)[rows] - other.uncertain[rows]
            worst = max(worst, float(np.max(error / (natural + np.abs(other.value[rows])), initial=0.0)))
            count += int(rows.sum())
    return worst, count


@pytest.mark.cases(1)
@pytest.mark.parametrize("template", some(TEMPLATES, 4), ids=lambda path: path.stem)
def test_templates_against_the_reference(template):
    worst, count = worst_against_reference(load(template))
    assert count > 100
    assert worst < 1e-9


@pytest.mark.ci
def test_random_mechanisms_against_the_reference():
    assert compared(40 if ALL else 5, worst_against_reference, 1e-9) > 1_000


@pytest.mark.cases(2)
@pytest.mark.parametrize("template", some(TEMPLATES, 2), ids=lambda path: path.stem)
def test_both_ways_to_differentiate_the_closures_agree(template):
    """Backwards from a quantity, and forwards from a dimension."""
    found = Found(load(template))
    derived = {name for dim in found.mechanism.dimensions if dim.derived for name in symbols(dim.value)}
    judged = 0
    free = [dim for dim in toleranced(found.mechanism) if dim.symbol not in derived]
    if not free:
        pytest.skip("`rates_over` knows nothing between dimensions and equations, and all others follow from these")
    for dim in free:
        forwards = rates_over(found.equations, found.values, {dim.symbol: (1.0, 0.0)})
        for name in found.quantities:
            theirs = np.broadcast_to(forwards.get(name + PRIME, 0.0), found.driver.shape)
            ours = found.of(name, dim.symbol)
            rows = found.calm & np.isfinite(theirs) & np.isfinite(ours)
            size = 1.0 + np.abs(theirs[rows])
            assert np.max(np.abs(ours[rows] - theirs[rows]) / size, initial=0.0) < 1e-9, (name, dim.symbol)
            judged += int(rows.sum())
    assert judged > 100


# --- 10,000 draws ---------------------------------------------------------------------------------------------------

FOUR_BAR = {"a1": 70.0, "a2": 35.0, "a3": 62.3, "a4": 56.0}
TOLERANCES = {"a1": 0.05, "a2": 0.02, "a3": 0.04, "a4": 0.03}


def rocker(a1, a2, a3, a4, theta):
    """The rocker's angle of a four-bar by the law of cosines, as every textbook has it."""
    x, y = a1 - a2 * np.cos(theta), -a2 * np.sin(theta)
    s = np.hypot(x, y)
    return np.pi + np.arctan2(y, x) - np.arccos((a4**2 + s**2 - a3**2) / (2 * a4 * s))


def four_bar(theta):
    found = Found(load(TEMPLATES[[path.stem for path in TEMPLATES].index("four-bar")]))
    row = int(np.argmin(np.abs(found.driver - theta)))
    by = {name: float(found.of("theta14", name)[row]) for name in FOUR_BAR}
    return found.driver[row], float(found.values["theta14"][row]), by


@pytest.mark.parametrize("degrees", [30, 105, 240])
def test_quantiles_of_drawn_four_bars(degrees):
    """With dimensions of normal distribution, t their threefold deviation, the band holds as often as such a band does."""
    theta, middle, by = four_bar(np.radians(degrees))
    root = np.sqrt(sum((by[name] * TOLERANCES[name]) ** 2 for name in by))
    rng = np.random.default_rng(SEED)
    drawn = {name: size + TOLERANCES[name] / 3 * rng.standard_normal(DRAWS) for name, size in FOUR_BAR.items()}
    angles = np.remainder(rocker(**drawn, theta=theta) - middle + np.pi, 2 * np.pi) - np.pi
    for z, share in ((-2, 0.0227501), (-1, 0.1586553), (0, 0.5), (1, 0.8413447), (2, 0.9772499)):
        density = np.exp(-(z**2) / 2) / np.sqrt(2 * np.pi)
        error = np.sqrt(share * (1 - share) / DRAWS) / density * root / 3
        assert abs(np.quantile(angles, share) - z * root / 3) < 4 * error, (z, np.quantile(angles, share), root)


@pytest.mark.parametrize("degrees", [30, 105, 240])
def test_no_drawn_four_bar_is_worse_than_the_worst_case(degrees):
    theta, middle, by = four_bar(np.radians(degrees))
    worst = sum(abs(by[name] * TOLERANCES[name]) for name in by)
    rng = np.random.default_rng(SEED)
    drawn = {name: size + TOLERANCES[name] * rng.uniform(-1, 1, DRAWS) for name, size in FOUR_BAR.items()}
    away = np.abs(np.remainder(rocker(**drawn, theta=theta) - middle + np.pi, 2 * np.pi) - np.pi)
    assert away.max() <= 1.01 * worst
    corner = {name: size + np.sign(by[name]) * TOLERANCES[name] for name, size in FOUR_BAR.items()}
    there = np.remainder(rocker(**corner, theta=theta) - middle + np.pi, 2 * np.pi) - np.pi
    assert there == pytest.approx(worst, rel=0.01)
    assert away.max() > 0.75 * worst

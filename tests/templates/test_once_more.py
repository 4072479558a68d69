"""Every template solved once more in another way: by Newton's method, and driven at each of its other grounded links."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from chosen import but, part
from mechsheet.description import load
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Driver, Sketch, Solution

FOLDER = Path(__file__).resolve().parents[2] / "templates"
NAMES = sorted(path.stem for path in FOLDER.glob("*.toml"))
NO_DYADS = (
    "cardan-gear",
    "double-butterfly",
    "planar-3rpr",
    "stephenson-ii-class-iv",
    "stephenson-iii-output",
    "sun-and-planet",
)
"""Gears alone, or Newton's method anyway."""

SIX_BARS = [
    name
    for name in NAMES
    if len(load(FOLDER / f"{name}.toml").links) == 6 and name not in ("planar-3rpr", "pantograph")
]
"""Six links; of the platform and the pantograph no other link is pivoted on the ground that could drive them."""

ALIKE = 1e-12
CLEAR = 0.2
"""From this part of the fastest on a link is a driver: at its dead centres it is none."""

LEAST_ROWS = 3


def positions(name):
    """The mechanism of a template, without all that reads positions."""
    mechanism = load(FOLDER / f"{name}.toml")
    driver = replace(mechanism.driver, speed=None)
    return replace(mechanism, driver=driver, dynamics=None, outputs=(), summaries=(), charts=(), tables=())


def swept(mechanism):
    equations = solve(mechanism)
    return equations, sweep(mechanism, equations, driver_values(mechanism, dimension_values(mechanism)))


def gaps(equation, one, other):
    gap = one - other
    return gap - math.tau * np.round(gap / math.tau) if equation.unit.kind == "angle" else gap


@pytest.mark.cases(4)
@pytest.mark.parametrize("name", part(but(NAMES, *NO_DYADS), 3))
def test_dyads_solved_as_groups(name):
    """`[solution] force`: the closed form and Newton's method, which share nothing but the sketch."""
    mechanism = positions(name)
    equations, values = swept(mechanism)
    forced, found = swept(replace(mechanism, solution=Solution(force=True)))
    assert all(group.system for group in forced.groups)
    dead = np.zeros(len(values[mechanism.driver.symbol]), bool)
    for group in equations.groups:
        if group.apart is not None:  # where two assemblies meet
            apart = np.abs(value(group.apart, values))
            dead |= np.broadcast_to(apart < 1e-6 * np.nanmax(apart), dead.shape)
    for equation in equations.columns:
        if equation.role in ("variable", "point") and equation.symbol in found:
            ours, theirs = found[equation.symbol][~dead], values[equation.symbol][~dead]
            assert np.array_equal(np.isnan(ours), np.isnan(theirs)), equation.symbol
            size = max(1.0, np.nanmax(np.abs(theirs)))
            assert np.nanmax(np.abs(gaps(equation, ours, theirs))) < ALIKE * size, equation.symbol


def grounded(mechanism):
    """What else could drive it: links that turn about a point of the ground, slides on the ground."""
    ground, driver = mechanism.ground, mechanism.driver
    for link in mechanism.links[1:]:
        if link.name != driver.link and {*link.points} & {*ground.points}:
            yield Driver(link.angle_symbol, mechanism.angle_unit, link.name, ground.name)
    for joint in mechanism.joints:
        if ground.name in (joint.link, joint.on) and joint.name != driver.joint:
            yield Driver(joint.symbol, mechanism.shown(replace(mechanism.driver.unit, kind="length", symbol="")),
                         joint=joint.name)  # fmt: skip


def stretch(column):
    """The longest run of rows over which a column rises or falls, and not too slowly."""
    speed = np.gradient(column)
    with np.errstate(invalid="ignore"):
        fine = np.abs(speed) > CLEAR * np.nanmax(np.abs(speed))
    sign = np.where(fine, np.sign(speed), 0)
    best, start = slice(0, 0), 0
    for row in range(1, len(sign) + 1):
        if row == len(sign) or sign[row] != sign[start]:
            if sign[start] and row - start > best.stop - best.start:
                best = slice(start, row)
            start = row
    return best


@pytest.mark.parametrize("name", part(SIX_BARS, 3, 1))
def test_driven_at_another_grounded_link_it_reads_its_own_rows_backwards(name):
    mechanism = positions(name)
    equations, values = swept(mechanism)
    others = list(grounded(mechanism))
    assert others
    for driver in others:
        rows = stretch(values[driver.symbol])
        assert rows.stop - rows.start >= LEAST_ROWS, driver.symbol
        there = {symbol: column[rows] for symbol, column in values.items()}
        points = {point for link in mechanism.links[1:] for point in link.points} - {*mechanism.ground.points}
        sketch = {point: (float(there[f"{point}.x"][0]), float(there[f"{point}.y"][0])) for point in sorted(points)}
        moved = replace(driver, values=tuple(map(float, there[driver.symbol])))
        _, back = swept(replace(mechanism, driver=moved, drivers=(), sketch=Sketch(sketch, doubted=False)))
        for equation in equations.columns:
            if equation.role in ("variable", "point"):
                size = max(1.0, np.nanmax(np.abs(there[equation.symbol])))
                gap = np.abs(gaps(equation, back[equation.symbol], there[equation.symbol])) / size
                assert np.max(gap) < 1e-11, (driver.symbol, equation.symbol)

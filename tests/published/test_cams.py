"""Cams against the factors of their laws as books print them, and the closed forms of profiles.

Factors: R. L. Norton, Design of Machinery, table 8-3 (peak velocity, acceleration, jerk of the laws).
"""

import math

import numpy as np
import pytest
from printed_numbers import template

from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.sweep import sweep


def motion(name, **overrides):
    mechanism, equations = template(name, **overrides)
    dimensions = dimension_values(mechanism)
    rows = np.radians(np.arange(0, 360, 0.25))
    return dimensions, sweep(mechanism, equations, rows) | {"phi": rows}


@pytest.mark.parametrize(
    ("name", "symbol", "first", "last", "way", "factors"),
    [
        ("cam-slide", "s", 0, 90, 20, (2.000, 6.283, 39.48)),
        ("cam-slide", "s", 150, 270, 20, (1.875, 5.777, 60.0)),
        ("cam-flat", "s", 0, 90, 10, (1.760, 5.528, 69.47)),
        ("cam-rocker", "theta12", 0, 110, math.radians(20), (2.000, 4.888, 61.43)),
        ("cam-linkage", "theta12", 0, 120, math.radians(25), (2.188, 7.526, 52.5)),
    ],
)
def test_peak_factors(name, symbol, first, last, way, factors):
    _, found = motion(name)
    over = math.radians(last - first)
    here = (found["phi"] >= math.radians(first) - 1e-9) & (found["phi"] <= math.radians(last) + 1e-9)
    for order, (ending, factor) in enumerate(zip(("d", "dd", "ddd"), factors, strict=True), 1):
        largest = np.max(np.abs(found[f"{symbol}.{ending}"][here]))
        assert largest * over**order / way == pytest.approx(factor, rel=2e-3), ending


def test_profile_of_a_slide_by_the_textbooks_formulas():
    dimensions, found = motion("cam-slide")
    s, once, twice = found["s"], found["s.d"], found["s.dd"]
    assert np.max(np.abs(np.tan(found["alpha"]) - (once - dimensions["e"]) / s)) < 1e-12
    dimensions, found = motion("cam-slide", e="0")
    s, once, twice = found["s"], found["s.d"], found["s.dd"]
    kappa = (s**2 + 2 * once**2 - s * twice) / (s**2 + once**2) ** 1.5
    assert np.max(np.abs(found["kappa"] - kappa)) < 1e-14
    assert s[0] == pytest.approx(dimensions["rb"] + dimensions["rr"])


def test_flat_face_by_the_textbooks_formulas():
    dimensions, found = motion("cam-flat")
    lift = found["s"] - dimensions["rb"]
    assert np.max(np.abs(found["contact"] + found["s.d"])) < 1e-12  # clockwise: on the other side
    assert np.max(np.abs(found["rho"] - (dimensions["rb"] + lift + found["s.dd"]))) < 1e-11
    assert np.max(np.abs(found["alpha"])) < 1e-12
    polar = np.hypot(found["cam.x"], found["cam.y"])
    assert np.max(np.abs(polar - np.hypot(found["s"], found["s.d"]))) < 1e-11


def test_given_rows_are_a_turn():
    mechanism, _ = template("cam-slide")
    rows = given_values(mechanism, dimension_values(mechanism))["phi"]
    assert np.degrees(rows).tolist() == pytest.approx(list(range(0, 365, 5)))

"""Velocities and accelerations of the reference against closed forms."""

import numpy as np
import pytest
from reference_cases import mechanism

from mechsheet.reference import rates, solve, variables

SLIDER_CRANK = """
links.ground.points = {{ O = [3, -2] }}
links.crank.points = {{ O = [0, 0], A = [{r}, 0] }}
links.rod.points = {{ A = [0, 0], B = [{l}, 0] }}
links.slider.points = {{ B = [0, 0] }}
assembly.B = [200, -2]

[[joints]]
type = "prismatic"
link = "slider"
on = "ground"
point = "B"
through = "O"
symbol = "s"

[driver]
{driver}
"""
CRANK = 'link = "crank"\nstart = 10\nstop = 350\nstep = 10'
SLIDE = 'joint = "s"\nsymbol = "s"\nstart = 62\nstop = 98\nstep = 4'
R, L = 20.0, 80.0


@pytest.fixture(scope="module")
def crank():
    return solve(mechanism(SLIDER_CRANK.format(r=R, l=L, driver=CRANK)))


def test_slider_crank(crank):
    """s = r cos(t) + w, w = sqrt(l^2 - r^2 sin^2(t))."""
    t, found = crank.driver, rates(crank)
    w = np.sqrt(L**2 - (R * np.sin(t)) ** 2)
    once = -R * np.sin(t) - R**2 * np.sin(2 * t) / (2 * w)
    twice = -R * np.cos(t) - R**2 * np.cos(2 * t) / w - R**4 * np.sin(2 * t) ** 2 / (4 * w**3)
    for name in ("s", "B.x"):
        assert np.allclose(found[name], (once, twice), rtol=1e-12, atol=1e-12)
    assert np.allclose(found["theta13"][0], -R * np.cos(t) / w, rtol=1e-12)
    assert np.allclose(found["A.y"], (R * np.cos(t), -R * np.sin(t)), rtol=1e-12, atol=1e-12)
    assert np.array_equal(found["theta12"], (np.ones(len(t)), np.zeros(len(t))))
    assert np.allclose((found["B.y"], found["O.x"], found["theta14"]), 0.0, atol=1e-12)
    assert set(found) == set(variables(crank))


def test_driven_by_its_slide(crank):
    """The other way round: dt/ds = 1/(ds/dt), and the second derivative is -s'' / s'^3."""
    driven = solve(mechanism(SLIDER_CRANK.format(r=R, l=L, driver=SLIDE)))
    there = solve(crank.mechanism, values=variables(driven)["theta12"])
    once, twice = rates(there)["s"]
    assert driven.exists.all()
    assert np.allclose(rates(driven)["theta12"], (1 / once, -twice / once**3), rtol=1e-9)


def test_rows_that_do_not_exist_have_none():
    found = solve(mechanism(SLIDER_CRANK.format(r=100.0, l=60.0, driver=CRANK)))
    assert 0 < found.exists.sum() < len(found.driver)
    for name, columns in rates(found).items():
        for column in columns:
            assert name == "theta12" or np.array_equal(np.isfinite(column), found.exists)

"""Deliberate faults in positions are seen, and named."""

import numpy as np
import pytest
from reference_cases import EXAMPLES, read

from mechsheet.reference import residuals, solve, variables, worst


def solved(name, folder=EXAMPLES):
    m = read(name, folder)
    return m, variables(solve(m))


def judged(m, found):
    return worst(residuals(m, {}, found))


@pytest.mark.parametrize("name", ["four-bar", "slider-crank", "adjustable-pump", "six-link-dwell"])
def test_right_positions_pass(name):
    m, found = solved(name)
    values, names = judged(m, found)
    assert values.max() < 1e-11
    assert all(names)


FAULTS = {
    "a length that stretches": ("four-bar", "B.x", lambda v: v + 0.01, "B"),
    "a point shifted by a row": ("four-bar", "C.y", np.roll, "C"),
    "an angle of the other link": ("four-bar", "theta14", lambda v: v + 0.001, "rocker"),
    "degrees for radians": ("four-bar", "theta13", np.degrees, "coupler"),
    "a guide left": ("slider-crank", "B.y", lambda v: v + 0.01, "coupler at C"),
    "a displacement of the wrong sign": ("slider-crank", "s14", lambda v: -v, "s14: displacement"),
    "a block that turns": ("slider-crank", "theta14", lambda v: v + 0.001, "s14: angle"),
    "a slot missed": ("adjustable-pump", "s4", lambda v: v + 0.01, "s4: displacement"),
    "a ground point that walks": ("four-bar", "B0.x", lambda v: v + 0.01, "rocker"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_fault_is_caught(fault):
    name, symbol, spoil, culprit = FAULTS[fault]
    m, found = solved(name)
    found[symbol] = np.roll(found[symbol], 1) if spoil is np.roll else spoil(found[symbol])
    values, names = judged(m, found)
    assert values.max() > 1e-4
    assert culprit in names[int(np.argmax(values))]


def test_the_other_assembly_is_closed_too():
    """A flipped mode satisfies all constraints: only comparison with the reference tells; a mirrored point does not pass."""
    m, found = solved("four-bar")
    a, b = (np.stack([found[f"{p}.x"], found[f"{p}.y"]], axis=1) for p in "AB")
    c = np.stack([found["C.x"], found["C.y"]], axis=1)
    along = (b - a) / np.hypot(*(b - a).T)[:, None]
    mirrored = 2 * np.sum((c - a) * along, axis=1)[:, None] * along + 2 * a - c
    found["C.x"], found["C.y"] = mirrored.T
    every = residuals(m, {}, found)
    assert np.abs(every["length AC of coupler"]).max() < 1e-11
    assert np.abs(every["length BC of coupler"]).max() < 1e-11
    assert np.abs(every["side of B on coupler"]).min() > 10


def test_driver_that_is_not_obeyed():
    m, found = solved("relative-driver", EXAMPLES.parent / "cases" / "reference")
    found["q"] = found["q"] + 0.01
    every = residuals(m, {}, found)
    assert every["driver"] == pytest.approx(-0.01 * 4.0)


def test_each_condition_has_its_own_residual():
    m, found = solved("slider-crank")
    found["B.y"] = found["B.y"] + 0.01
    every = residuals(m, {}, found)
    assert every["s14: on the line"] == pytest.approx(0.01)
    assert np.abs(every["s14: displacement"]).max() < 1e-11
    m, found = solved("four-bar")
    found["B0.x"] = found["B0.x"] + 0.01
    assert residuals(m, {}, found)["ground point B0"] == pytest.approx(0.01)


def test_rows_without_numbers():
    m, found = solved("dead-centre", EXAMPLES.parent / "cases" / "reference")
    values, names = judged(m, found)
    gone = np.isnan(found["B.x"])
    assert np.array_equal(np.isnan(values), gone)
    assert all((name == "") == lost for name, lost in zip(names, gone, strict=True))


def test_missing_variable():
    m, found = solved("four-bar")
    del found["theta13"]
    with pytest.raises(KeyError, match="theta13"):
        residuals(m, {}, found)


def test_dimensions_count():
    m, found = solved("four-bar")
    values, _ = worst(residuals(m, {"a3": 62.4}, found))
    assert values.max() > 0.05

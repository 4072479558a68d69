"""Numbers printed in the text, section 3.8."""

import csv
import tomllib

import numpy as np
import pytest
from reference_cases import EXAMPLES, PUBLISHED, read

from mechsheet.reference import dimension_values, driver_values, solve, variables

WORKED = tomllib.loads((PUBLISHED / "worked-values.toml").read_text(encoding="utf-8"))


def table(name):
    with (PUBLISHED / f"{name}.csv").open(encoding="utf-8", newline="") as file:
        return np.array(list(csv.reader(file))[1:], dtype=float)


def off(angles, printed):
    return np.abs((angles - printed + np.pi) % (2 * np.pi) - np.pi)


def test_slider_crank_at_60_degrees():
    printed = WORKED["slider-crank"]
    found = variables(solve(read("slider-crank", EXAMPLES), values=[np.radians(printed["theta12_deg"])]))
    assert found["s14"][0] == pytest.approx(printed["s14"], abs=0.05)
    assert found["C.x"][0] == pytest.approx(printed["xC"], abs=0.05)
    assert found["C.y"][0] == pytest.approx(printed["yC"], abs=0.05)
    assert np.degrees(found["theta13"][0]) % 360 == pytest.approx(printed["theta13_deg"], abs=0.05)
    assert np.sin(found["theta13"][0]) == pytest.approx(printed["sin_theta13"], abs=5e-5)
    assert [found["s14"][0], found["C.x"][0], found["C.y"][0]] == pytest.approx([273.912, 176.033, 89.425], abs=5e-4)


def test_pump_table():
    printed = table("adjustable-pump")
    pump = read("adjustable-pump", EXAMPLES)
    for column, s1 in enumerate(WORKED["adjustable-pump"]["s1"], start=1):
        found = solve(pump, {"s1": s1})
        assert np.abs(found.displacements["s15"] - printed[:, column]).max() < 6e-5


def test_fivelink_table():
    """The printed table subtracts alpha1 twice: its row theta12 is what the mechanism does at theta12 - alpha1."""
    printed = table("fivelink")
    fivelink = read("fivelink")
    numbers = dimension_values(fivelink)
    shifted = solve(fivelink, values=driver_values(fivelink, numbers) - numbers["alpha1"])
    assert off(shifted.poses["lever"][:, 2], printed[:, 2]).max() < 3e-7
    assert off(shifted.poses["output"][:, 2], printed[:, 4]).max() < 3e-7
    true = solve(fivelink)
    assert true.poses["lever"][0, 2] == pytest.approx(1.83476, abs=5e-6)
    assert off(true.poses["lever"][:, 2], printed[:, 2]).max() == pytest.approx(0.104, abs=5e-4)
    assert off(true.poses["output"][:, 2], printed[:, 4]).max() == pytest.approx(0.144, abs=5e-4)


def test_dwell_of_the_six_link():
    angles = np.degrees(variables(solve(read("six-link-dwell", EXAMPLES)))["theta16"])
    dwell = angles[20:27]
    assert np.ptp(dwell) == pytest.approx(0.51, abs=0.005)
    assert [dwell.min(), dwell.max(), angles.min(), angles.max()] == pytest.approx(
        [98.82, 99.33, 71.52, 99.33], abs=0.06
    )


def test_four_bar_outputs():
    found = variables(solve(read("four-bar", EXAMPLES)))
    assert np.array_equal(found["mu"], found["theta14"] - found["theta13"])
    away = np.hypot(found["C.x"] - found["A.x"], found["C.y"] - found["A.y"])
    assert np.abs(away - 126.6).max() < 1e-12

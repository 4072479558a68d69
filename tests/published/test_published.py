"""The templates reproduce the numbers that the text prints, by their equations and by the reference alike."""

import math

import numpy as np
import pytest
from printed_numbers import (
    CUT_PI,
    SETTINGS,
    TEMPLATES,
    at,
    dimensions,
    pump_as_printed,
    table,
    template,
    worked_values,
)

from mechsheet import reference
from mechsheet.description import Overrides, load, loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.solve import solve
from mechsheet.library.building import build
from mechsheet.library.recalculation import recalc

FULL_PUMP = [(column, float(s1)) for column, s1 in enumerate(SETTINGS, 1)]


@pytest.mark.parametrize("name", ["slider-crank", "four-bar", "fivelink", "adjustable-pump", "six-link-dwell"])
def test_dimensions_are_the_texts(name):
    found = dimensions(name)
    for symbol, value in worked_values()[name]["dimensions"].items():
        if symbol.endswith("_deg"):
            symbol, value = symbol.removesuffix("_deg"), math.radians(value)
        assert found[symbol] == value, symbol


@pytest.mark.parametrize("name", ["fivelink", "adjustable-pump"])
def test_cell_names_are_the_texts(name):
    mechanism = load(TEMPLATES / f"{name}.toml")
    found = {dim.symbol: dim.cell for dim in mechanism.dimensions if dim.cell}
    assert found == worked_values()[name]["cell_names"]


def test_four_bar_refers_to_cells_as_the_texts_workbook_does():
    mechanism = load(TEMPLATES / "four-bar.toml")
    assert mechanism.references == "anchors"
    assert mechanism.driver.step == math.radians(worked_values()["four-bar"]["step_deg"])


def test_slider_crank_to_all_printed_digits():
    printed = worked_values()["slider-crank"]
    mechanism, equations = template("slider-crank")
    driver = np.radians([float(printed["theta12_deg"])])
    for found in (
        at(mechanism, equations, driver),
        reference.variables(reference.solve(mechanism, values=driver)),
    ):
        theta13, s14, x, y = (float(found[name][0]) for name in ("theta13", "s14", "C.x", "C.y"))
        assert round(math.sin(theta13), 4) == printed["sin_theta13"]
        assert round(math.degrees(theta13) % 360, 1) == printed["theta13_deg"]
        assert (round(s14, 1), round(x, 1), round(y, 1)) == (printed["s14"], printed["xC"], printed["yC"])


@pytest.mark.parametrize(("column", "s1"), FULL_PUMP)
def test_pump_table_with_true_pi(column, s1):
    published = table("adjustable-pump")
    mechanism, equations = template("adjustable-pump", s1=str(s1))
    found = at(mechanism, equations, np.radians(published[:, 0]))["s15"]
    assert found.shape == (19,)
    assert np.max(np.abs(found - published[:, column])) < 6e-5


@pytest.mark.parametrize(("column", "s1"), FULL_PUMP)
def test_pump_table_with_the_texts_pi(column, s1):
    """The text's pi enters the conversion to radians and AçıCos; the latter is a right angle B-B0-slot that much short."""
    published = table("adjustable-pump")
    text = template_text("adjustable-pump")
    right_angle = 'B = [0, "a4"]'
    assert right_angle in text
    cut = text.replace(right_angle, f'B = {{ r = "a4", angle = "{CUT_PI}/2" }}')
    mechanism = loads(cut, overrides=Overrides({"s1": str(s1)}))
    found = at(mechanism, solve(mechanism), published[:, 0] * CUT_PI / 180)["s15"]
    assert np.max(np.abs(found - published[:, column])) < 5e-5
    transcribed = pump_as_printed(published[:, 0], s1, -1, CUT_PI)
    assert np.max(np.abs(transcribed - published[:, column])) < 5e-5
    assert np.max(np.abs(transcribed - found)) < 1e-9


@pytest.mark.parametrize("s1", SETTINGS)
def test_one_assembly_mode_serves_the_whole_pump_table(s1):
    """The two-way table takes the modes of the sketch at s1 = 20 for every setting."""
    _, sketched = template("adjustable-pump")
    _, changed = template("adjustable-pump", s1=str(s1))
    assert [group.mode_value for group in changed.groups] == [group.mode_value for group in sketched.groups]


def test_fivelink_table_is_the_mechanism_at_theta12_less_alpha1():
    published = table("fivelink")
    mechanism, equations = template("fivelink")
    driver = np.radians(published[:, 0]) - dimensions("fivelink")["alpha1"]
    for found in (
        at(mechanism, equations, driver),
        reference.variables(reference.solve(mechanism, values=driver)),
    ):
        for symbol, column in (("theta13", 2), ("theta15", 4)):
            assert found[symbol].shape == (19,)
            assert np.max(np.abs(np.remainder(found[symbol], math.tau) - published[:, column])) < 3e-7
            assert np.max(np.abs(np.degrees(found[symbol]) % 360 - published[:, column + 1])) < 0.0051


def test_fivelink_constants():
    printed, found = worked_values()["fivelink"], dimensions("fivelink")
    assert round(found["alpha1"], 7) == printed["alpha1_rad"]
    assert round(math.degrees(found["alpha1"]), 7) == printed["alpha1_deg"]
    assert round(found["A0B0"], 4) == printed["A0B0"]
    assert round(found["B0C0"], 2) == printed["B0C0"]
    assert math.degrees(found["alpha2"]) == pytest.approx(printed["alpha2_deg"], abs=6e-6)
    assert math.degrees(found["alpha2p"]) == pytest.approx(printed["alpha2p_deg"], abs=6e-7)


def test_fivelink_template_shows_the_true_angle():
    mechanism, equations = template("fivelink")
    found = at(mechanism, equations, np.radians(table("fivelink")[:, 0]))
    assert round(float(found["theta13"][0]), 5) == 1.83476
    assert round(math.degrees(found["theta13"][0]), 2) == 105.12
    assert round(math.degrees(found["theta15"][0]), 2) == 107.08
    # straight from the drawing: the slot stands at right angles to B0B
    crank_pin, pivot = np.array([510.0, 0.0]), np.array([1250.0, 200.0])
    slot = math.atan2(*(crank_pin - pivot)[::-1]) % math.tau
    assert found["theta13"][0] == pytest.approx(slot - math.pi / 2, abs=1e-12)


def test_dwell_of_the_six_link():
    mechanism, equations = template("six-link-dwell")
    found = np.degrees(at(mechanism, equations, np.radians(np.arange(0.0, 360.5, 0.5)))["theta16"])
    first, last = worked_values()["six-link-dwell"]["dwell_deg"]
    dwell = found[2 * first : 2 * last + 1]
    assert round(float(np.ptp(dwell)), 2) == 0.51
    assert (round(float(dwell.min()), 2), round(float(dwell.max()), 2)) == (98.82, 99.33)
    assert (round(float(found.min()), 2), round(float(found.max()), 2)) == (71.52, 99.33)


def test_six_link_closes_at_the_given_distance():
    mechanism, equations = template("six-link-dwell")
    found = at(mechanism, equations, np.zeros(1))
    distance = math.hypot(found["B0.x"][0] - found["D0.x"][0], found["B0.y"][0] - found["D0.y"][0])
    assert distance == pytest.approx(490, abs=1e-9)


@pytest.mark.ci
def test_pump_workbook_holds_the_table_where_the_text_has_it(tmp_path):
    """B8:G26, one formula with mixed anchors, settings in row 7 and theta12 in column A, as in the text's workbook."""
    published = table("adjustable-pump")
    (path,) = build(load(TEMPLATES / "adjustable-pump.toml"), tmp_path)
    (title,) = [title for title, cells in recalc(path).as_dict().items() if cells.get("G7") == 250.0]
    for settings, columns in (({}, range(6)), ({"F7": 50.0}, (1,))):
        cells = recalc(path, {f"'{title}'!{cell}": value for cell, value in settings.items()}).as_dict()[title]
        for row, values in enumerate(published, 8):
            assert cells[f"A{row}"] == pytest.approx(values[0])
            for column in columns:
                letter = "F" if settings else "BCDEFG"[column]
                assert cells[f"{letter}{row}"] == pytest.approx(values[1 + column], abs=6e-5), f"{letter}{row}"


@pytest.mark.slow
def test_cells_of_the_fivelink_carry_the_texts_names(tmp_path):
    (path,) = build(load(TEMPLATES / "fivelink.toml"), tmp_path)
    printed, cells = worked_values()["fivelink"], recalc(path).named()
    for symbol, name in printed["cell_names"].items():
        found = cells[name]
        assert isinstance(found, float), name
        if symbol in printed["dimensions"]:
            assert found == printed["dimensions"][symbol], name
    assert cells["SabitUzuv"] == pytest.approx(printed["A0B0"], abs=5e-5)
    assert cells["Alfa1"] == pytest.approx(printed["alpha1_rad"], abs=5e-8)

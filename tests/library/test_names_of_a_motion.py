"""What a motion has by name: its columns, what no column shows, the numbers of the whole of it."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

import mechsheet
from mechsheet.diagnostics import MechsheetError
from mechsheet.library.show import variables_json

DESCRIPTION = (Path(__file__).parents[2] / "docs" / "description.md").read_text(encoding="utf-8")
FORCES = """format = 1
[mechanism]
name = "four-bar"
[links.ground]
points = { A0 = [0, 0], B0 = [70, 0] }
[links.crank]
points = { A0 = [0, 0], A = [35, 0] }
[links.coupler]
points = { A = [0, 0], B = [62.3, 0], C = [30, 20] }
mass = 1
center = [30, 5]
inertia = 0.001
[links.rocker]
points = { B0 = [0, 0], B = [56, 0] }
[driver]
link = "crank"
start = 0
stop = 360
step = 15
speed = "60 rpm"
[assembly]
B = [50, 55]
[outputs]
mu = { formula = "theta14 - theta13", unit = "deg" }
[summary]
swing = { of = "theta14", take = "range" }
mu_min = { of = "mu", take = "min" }
"""


@pytest.fixture(scope="module")
def motion():
    return mechsheet.loads(FORCES).solve()


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("C.vx", "mm/s"),
        ("B.ay", "mm/s²"),
        ("theta13.d", ""),
        ("omega12", "rad/s"),
        ("alpha12", "rad/s²"),
        ("G3.x", "mm"),
        ("G3.a", "mm/s²"),
        ("F34.x", "N"),
        ("T12.work", "N m"),
        ("power", "W"),
        ("shaking.m", "N m"),
        ("B0.x", "mm"),
    ],
)
def test_every_name_of_the_manual_has_its_values(motion, name, unit):
    assert name in motion
    assert motion[name].shape == motion["theta12"].shape
    assert np.isfinite(motion[name]).all()
    assert motion.units[name] == unit


def test_they_are_what_an_output_of_them_is(motion):
    names = ["C.vx", "B.ay", "theta13.dd", "G3.vy", "power", "shaking.x"]
    lines = "".join(f'out{number} = {{ formula = "{name}", unit = "1" }}\n' for number, name in enumerate(names))
    read = mechsheet.loads(FORCES.replace("[outputs]\n", f"[outputs]\n{lines}")).solve()
    for number, name in enumerate(names):
        assert motion[name] == pytest.approx(read[f"out{number}"], rel=1e-12)


def test_the_list_of_columns_stays_that_of_the_workbook(motion):
    assert "C.vx" in motion
    assert "C.vx" not in list(motion)


def test_as_json_all_of_them_are_there(motion):
    found = json.loads(variables_json(mechsheet.loads(FORCES)))
    assert found["C.vx"] == pytest.approx(motion["C.vx"].tolist())
    assert found.keys() >= set(motion)


def test_a_wrong_name_is_told_with_the_one_that_is_meant(motion):
    with pytest.raises(KeyError, match=r'did you mean "theta13"') as caught:
        motion["thetal3"]
    assert isinstance(caught.value, MechsheetError)
    assert "C.vz" not in motion
    with pytest.raises(KeyError, match="nothing is called"):
        motion.units["C.vz"]


def test_without_a_speed_there_are_coefficients_and_no_velocities():
    still = mechsheet.template("four-bar").solve()
    assert still["theta13.d"].shape == still["theta13"].shape
    assert "omega13" not in still


def test_a_driver_whose_values_are_listed_has_its_columns_alone():
    assert "theta13.d" not in mechsheet.template("five-bar-robot").solve()


@pytest.mark.slow
def test_the_numbers_of_the_whole_motion(motion):
    assert motion.summary["swing"] == pytest.approx(np.ptp(motion["theta14"]), abs=0.5)
    assert motion.summary["mu_min"] == pytest.approx(33.89, abs=0.1)
    with pytest.raises(KeyError, match=r'did you mean "swing"'):
        motion.summary["swin"]


def test_a_notebook_shows_a_table(motion):
    shown = motion._repr_html_()
    assert shown.count("<tr>") == 26
    assert "<th>theta14<br>°</th>" in shown
    long = mechsheet.template("four-bar", rows=200).solve()._repr_html_()
    assert "⋮ 140 ⋮" in long


@pytest.mark.slow
def test_a_notebook_shows_a_linkage_as_its_drawing():
    shown = mechsheet.template("four-bar")._repr_mimebundle_()
    assert "<svg" in shown["image/svg+xml"]
    assert shown["text/plain"].startswith("<Linkage four-bar")


def test_what_cannot_be_solved_is_shown_by_its_name():
    linkage = mechsheet.loads(FORCES.replace("[62.3, 0]", "[2.3, 0]"))
    assert linkage._repr_mimebundle_() == {"text/plain": repr(linkage)}


@pytest.mark.slow
def test_a_notebook_shows_what_a_check_prints(tmp_path):
    (built,) = mechsheet.template("four-bar").build(tmp_path, formats="xlsx")

    class Printer:
        said = ""

        def text(self, text):
            self.said += text

    printer = Printer()
    mechsheet.check(built)._repr_pretty_(printer, False)
    assert "all agree" in printer.said.splitlines()[0]


# --- what is said of it ---------------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_verdicts_are_objects():
    verdicts = mechsheet.template("four-bar").verdicts()
    angle = verdicts["transmission_1"]
    assert angle.value == pytest.approx(33.89, abs=0.01)
    assert angle.where in (0, 360)
    assert "poor" in angle.words
    assert angle.sure
    assert verdicts["verdict"].words.startswith("closes in all 25 positions")
    with pytest.raises(KeyError, match=r'did you mean "transmission_1"'):
        verdicts["transmision_1"]


@pytest.mark.slow
def test_a_number_of_the_rows_alone_is_not_sure():
    verdicts = mechsheet.template("double-butterfly").verdicts()
    assert not verdicts["swing_theta15"].sure
    assert verdicts["same_assembly"].sure
    assert not mechsheet.template("planar-3rpr").verdicts()["largest_effort"].sure


@pytest.mark.slow
def test_they_print_as_the_command_line_prints_them():
    assert "transmission_1 = 33.8" in str(mechsheet.template("four-bar").verdicts())


@pytest.mark.slow
def test_bands_are_objects():
    text = FORCES.replace("[70, 0] }", '["a1", 0] }').replace(
        "[links.ground]", "[dimensions]\na1 = { value = 70, tolerance = 0.2 }\n[links.ground]"
    )
    bands = mechsheet.loads(text).tolerance()
    assert bands["swing"].worst > 0
    assert bands["swing"].unit == "°"
    assert bands["swing"].shares == {"a1": pytest.approx(1)}
    assert "swing ± " in str(bands)


# --- what there is --------------------------------------------------------------------------------------------------------


def test_dir_shows_what_there_is_and_nothing_else():
    assert dir(mechsheet) == sorted(mechsheet.__all__)
    assert all(hasattr(mechsheet, name) for name in dir(mechsheet))


def test_names_in_the_manual_are_names_here():
    """The tables of [rates] and [dynamics]: C.vx, theta13.d, G3.x …"""
    tables = "\n".join(line for line in DESCRIPTION.splitlines() if line.startswith("| `"))
    names = re.findall(r"`(?:C|G3|theta13|shaking|F34|T12)\.\w+`|`power`", tables)
    assert len(names) > 15
    motion = mechsheet.loads(FORCES).solve()
    assert [name for name in (each.strip("`") for each in names) if name not in motion] == []

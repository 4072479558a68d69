"""Motion laws: the driver's value, speed and acceleration in time, and what follows from them."""

import numpy as np
import pytest
from laid import Laid

import mechsheet
from chosen import ALL
from in_line import IN_LINE
from livesheet.formula.nodes import ErrorValue
from mechsheet import loads, reference
from mechsheet.checking import check
from mechsheet.compiled import Compiled
from mechsheet.diagnostics import DescriptionError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_at
from mechsheet.kinematics.sweep import sweep
from mechsheet.library.building import build
from mechsheet.library.show import equations_text
from mechsheet.model import LAWS

PI = np.pi

BY_HAND = {
    "constant": (lambda x: x, lambda x: 1 + 0 * x, lambda x: 0 * x),
    "accelerated": (lambda x: x**2, lambda x: 2 * x, lambda x: 2 + 0 * x),
    "parabolic": (
        lambda x: np.where(x <= 0.5, 2 * x**2, 1 - 2 * (1 - x) ** 2),
        lambda x: np.where(x <= 0.5, 4 * x, 4 - 4 * x),
        lambda x: np.where(x <= 0.5, 4, -4),
    ),
    "harmonic": (
        lambda x: (1 - np.cos(PI * x)) / 2,
        lambda x: PI / 2 * np.sin(PI * x),
        lambda x: PI**2 / 2 * np.cos(PI * x),
    ),
    "cycloidal": (
        lambda x: x - np.sin(2 * PI * x) / (2 * PI),
        lambda x: 1 - np.cos(2 * PI * x),
        lambda x: 2 * PI * np.sin(2 * PI * x),
    ),
    "polynomial": (
        lambda x: 10 * x**3 - 15 * x**4 + 6 * x**5,
        lambda x: 30 * x**2 - 60 * x**3 + 30 * x**4,
        lambda x: 60 * x - 180 * x**2 + 120 * x**3,
    ),
}
"""Of each law the part of the way after a part of the time, and its derivatives."""


def moved(text, law="cycloidal", duration=2.0, rows=11, start=30, stop=150):
    """A template's description with a motion law in place of its sweep."""
    head, _, tail = text.partition("[driver]\n")
    kept = [line for line in tail.split("\n") if not line.startswith(("start", "stop", "step", "speed", "motion"))]
    motion = f'start = {start}\nstop = {stop}\nmotion = {{ law = "{law}", duration = {duration}, rows = {rows} }}\n'
    return head + "[driver]\n" + motion + "\n".join(kept)


FOUR_BAR = moved(
    """
format = 1
[mechanism]
name = "four-bar"
[dimensions]
a1 = 80
a2 = 35
a3 = 70
a4 = 60
[links.ground]
points = { A0 = [0, 0], B0 = ["a1", 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.coupler]
points = { A = [0, 0], B = ["a3", 0], C = [35, 20] }
[links.rocker]
points = { B0 = [0, 0], B = ["a4", 0] }
[driver]
link = "crank"
[assembly]
B = [80, 60]
""",
    rows=6,
)


@pytest.mark.parametrize("law", LAWS)
def test_every_law_by_hand(law):
    outputs = "".join(f'{name} = {{ formula = "{name}12", unit = "1" }}\n' for name in ("omega", "alpha"))
    found = loads(moved(IN_LINE, law, 0.7, 21, 200, -40) + "[outputs]\n" + outputs).solve()
    assert found["t"] == pytest.approx(np.arange(21) * 0.7 / 20)
    way = np.radians(-240)
    value, speed, acceleration = (curve(np.arange(21) / 20) for curve in BY_HAND[law])
    assert np.radians(found["theta12"]) == pytest.approx(np.radians(200) + way * value)
    assert found["omega"] == pytest.approx(way / 0.7 * speed, abs=1e-12)
    assert found["alpha"] == pytest.approx(way / 0.7**2 * acceleration, abs=1e-11)


@pytest.mark.parametrize("law", LAWS)
def test_rates_are_what_positions_do_in_time(law):
    """Differences over eight points of time; nothing else knows how fast anything moves."""
    mechanism = loads(moved(FOUR_BAR, law, 1.5, 8, 20, 200))
    compiled = Compiled(mechanism)
    step, places = 1e-2, np.array([1.3, 2.6, 3.7, 5.2, 6.9, 7.6])
    known = sweep(mechanism, compiled.equations, given_at(mechanism, dimension_values(mechanism), places))
    weights = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
    for position, rate in (
        ("theta12", "omega12"),
        ("theta14", "omega14"),
        ("omega14", "alpha14"),
        ("omega12", "alpha12"),
    ):
        slope = np.zeros(len(places))
        for by, weight in weights.items():
            ahead, behind = (
                sweep(
                    mechanism,
                    compiled.equations,
                    given_at(mechanism, dimension_values(mechanism), places + sign * by * step),
                )
                for sign in (1, -1)
            )
            slope += weight * (np.broadcast_to(ahead[position], 6) - np.broadcast_to(behind[position], 6))
        slope /= step * 1.5 / 7
        assert slope == pytest.approx(np.broadcast_to(known[rate], 6), rel=1e-8, abs=1e-8)


@pytest.mark.parametrize("law", LAWS)
def test_the_reference_has_laws_of_its_own(law):
    compiled = Compiled(loads(moved(FOUR_BAR, law, 3, 12)))
    solution = reference.solve(compiled.mechanism)
    assert solution.driver == pytest.approx(compiled.driver, abs=1e-14)
    theirs = reference.by_time(solution)
    for name in ("t", "omega12", "alpha12", "omega14", "alpha14", "C.v", "C.a"):
        scale = np.max(np.abs(theirs[name])) or 1.0
        assert np.broadcast_to(compiled.values[name], 12) / scale == pytest.approx(theirs[name] / scale, abs=1e-12)


@pytest.mark.slow
def test_another_duration_changes_everything():
    laid = Laid(FOUR_BAR)
    before = {name: np.array(laid.column(name)) for name in ("t", "theta12", "omega14", "alpha14")}
    laid.change(duration=4)
    assert np.array(laid.column("t")) == pytest.approx(2 * before["t"])
    assert np.array(laid.column("theta12")) == pytest.approx(before["theta12"])
    assert np.array(laid.column("omega14")) == pytest.approx(before["omega14"] / 2)
    assert np.array(laid.column("alpha14")) == pytest.approx(before["alpha14"] / 4)
    laid.change(stop=90)
    assert laid.column("theta12")[-1] == pytest.approx(90)
    laid.change(duration=0)
    assert all(isinstance(cell, ErrorValue) for cell in laid.column("theta14"))
    assert laid.spot("inputs") > 0
    assert "duration" in laid.spot("verdict")


@pytest.mark.slow
def test_a_driven_slide_moves_by_a_law(tmp_path):
    text = moved(IN_LINE, "harmonic", '"2*r/100"', 9, 160, '"l + r/2"').replace('link = "crank"\n[', 'joint = "s14"\n[')
    text = text.replace("B = [250, 0]", "A = [10, 49]\nB = [200, 0]")
    assert 'joint = "s14"' in text
    laid = Laid(text)
    assert laid.column("s14")[4] == pytest.approx((160 + 225) / 2)
    assert laid.spot("duration") == 1
    for layout in ("sheets", "page") if ALL else ("sheets",):
        (path,) = build(loads(text), tmp_path, layout=layout, force=True)
        assert check(path).agrees


def test_rows_are_asked_for_and_a_step_is_not(tmp_path):
    path = tmp_path / "m.toml"
    path.write_text(FOUR_BAR, encoding="utf-8")
    assert len(mechsheet.load(path, rows=31).solve()["t"]) == 31
    with pytest.raises(DescriptionError, match="equally spaced in time, there is no step"):
        mechsheet.load(path, step=5)


@pytest.mark.slow
@pytest.mark.parametrize("language", ["en", "tr"])
def test_what_a_person_sees(language):
    laid = Laid(FOUR_BAR, language)
    mechanism = laid.workbook.sheets[0]
    words = [cell.content for cell in mechanism.cells if isinstance(cell.content, str)]
    wanted = {"en": "cycloidal motion, 6 rows", "tr": "sikloidal hareket, 6 satır"}[language]
    assert any(wanted in word for word in words)
    assert {"start", "stop", "duration"} <= {name.name for name in laid.workbook.names}
    curves = [chart for chart in mechanism.charts if chart.x_axis.title.startswith("t [s]")]
    assert len(curves) >= 3  # against the time, not the driver
    assert laid.values.get(laid.plan.main, laid.plan.blocks["variables"].rows["t"], 1) == 0


def test_equations_are_printed_from_the_time_on():
    lines = equations_text(loads(FOUR_BAR)).split("\n")
    first = lines.index("driver") + 1
    assert lines[first].strip() == "t = n*duration/5"
    assert lines[first + 1].strip().startswith("theta12 = start + (stop - start)*(t/duration - sin(2*pi")


@pytest.mark.slow
def test_a_whole_turn_in_time_leaves_a_rocker_a_rocker():
    """The rows end in time, but the ends of a whole turn are one position: what comes back there has not turned on."""
    laid = Laid(moved(FOUR_BAR, "cycloidal", 2, 15, 0, 360))
    fine = loads(moved(FOUR_BAR, "constant", 2, 3601, 0, 360)).solve()["theta14"]
    assert laid.spot("swing_theta14") == pytest.approx(np.ptp(fine), rel=1e-4)
    assert laid.words("swing_theta14") == "rocker: swings by this much"

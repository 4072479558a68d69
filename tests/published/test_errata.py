"""The numbers of docs/errata.md, slip by slip: each proves that the text as printed cannot be right."""

import math

import numpy as np
import pytest
from printed_numbers import (
    CUT_PI,
    ROOT,
    SETTINGS,
    TEMPLATES,
    at,
    dimensions,
    four_bar_theta14_config,
    pump_as_printed,
    table,
    template,
    worked_values,
)

from mechsheet.description import load, loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.solve import solve

ERRATA = (ROOT / "docs" / "errata.md").read_text(encoding="utf-8")


def stated(*texts: str) -> None:
    """Every text is in docs/errata.md."""
    missing = [text for text in texts if text not in ERRATA]
    assert not missing


def spread(values) -> str:
    return f"{np.min(values):.1f} to {np.max(values):.1f}"


def test_1_alpha1_is_subtracted_twice():
    published = table("fivelink")
    theta12, alpha1 = np.radians(published[:, 0]), dimensions("fivelink")["alpha1"]
    assert np.max(np.abs(theta12 - alpha1 - published[:, 1])) < 6e-8  # the column of theta12 has lost alpha1 already
    mechanism, equations = template("fivelink")
    true = at(mechanism, equations, theta12)
    twice = at(mechanism, equations, theta12 - alpha1)
    off = {name: np.max(np.abs(true[name] - published[:, c])) for name, c in (("theta13", 2), ("theta15", 4))}
    rest = {name: np.max(np.abs(twice[name] - published[:, c])) for name, c in (("theta13", 2), ("theta15", 4))}
    stated(f"{off['theta13']:.3f} rad ({math.degrees(off['theta13']):.1f}°)")
    stated(f"{off['theta15']:.3f} rad ({math.degrees(off['theta15']):.1f}°)")
    stated("4.4e-8 rad", "5.0e-8 rad")
    assert (f"{rest['theta13']:.1e}", f"{rest['theta15']:.1e}") == ("4.4e-08", "5.0e-08")
    for name, column in (("theta13", 2), ("theta15", 4)):
        printed = f"{published[0, column]:.5f} rad, {published[0, column + 1]:.2f}°"
        stated(f"| {name} | {printed} | {true[name][0]:.5f} rad, {math.degrees(true[name][0]):.2f}° |")


def test_2_abscissa_of_c_takes_theta13():
    mechanism, equations = template("four-bar")
    found, dims = at(mechanism, equations, np.radians(np.arange(0, 361, 15))), dimensions("four-bar")
    for angle, fixed in (("theta13", True), ("theta14", False)):
        x = found["A.x"] + dims["b3"] * np.cos(found[angle] + dims["gamma3"])
        y = found["A.y"] + dims["b3"] * np.sin(found["theta13"] + dims["gamma3"])
        ac, bc = np.hypot(x - found["A.x"], y - found["A.y"]), np.hypot(x - found["B.x"], y - found["B.y"])
        if fixed:
            assert np.allclose(ac, dims["b3"], atol=1e-9)
            assert np.allclose(bc, dims["c3"], atol=1e-9)
            assert np.allclose(x, found["C.x"], atol=1e-9)
        else:
            stated(f"AC would vary from {spread(ac)}", f"BC from {spread(bc)}")


def test_3_gamma3_is_bac():
    a3, b3, c3 = (dimensions("four-bar")[name] for name in ("a3", "b3", "c3"))
    bac = math.degrees(math.acos((a3**2 + b3**2 - c3**2) / (2 * a3 * b3)))
    abc = math.degrees(math.acos((a3**2 + c3**2 - b3**2) / (2 * a3 * c3)))
    assert math.degrees(dimensions("four-bar")["gamma3"]) == pytest.approx(bac)
    stated(f"BAC = {bac:.3f}°", f"ABC is {abc:.3f}°")


def test_4_the_vector_is_b0a():
    mechanism, equations = template("four-bar")
    found, dims = at(mechanism, equations, np.zeros(1)), dimensions("four-bar")
    x = float(found["A.x"][0] - found["B0.x"][0])
    assert x == dims["a2"] * math.cos(0) - dims["a1"] == -35
    stated("(-35, 0); AB0 is (35, 0)")


def test_5_sign_of_s1():
    published = table("adjustable-pump")
    worst = {}
    for sign, pi in ((-1, math.pi), (-1, CUT_PI), (1, math.pi)):
        gaps = [
            np.max(np.abs(pump_as_printed(published[:, 0], s1, sign, pi) - published[:, column]))
            for column, s1 in enumerate(SETTINGS, 1)
        ]
        worst[sign, pi] = (gaps[0], max(gaps), max(gaps[2:]), min(gaps[2:]))
    assert f"{worst[-1, math.pi][1]:.1e}" == "6.0e-05"
    assert f"{worst[-1, CUT_PI][1]:.2e}" == "4.94e-05"
    assert round(worst[1, math.pi][0]) == 14
    assert worst[1, math.pi][3] > 100
    stated("within 6.0e-5", "within 4.94e-5", "14 mm in the column s1 = 20")


def test_6_mathcad_value():
    def value(a: float) -> str:
        return f"{50 + a * math.cos(math.radians(20)):.3f}"

    assert value(100) == "143.969"
    stated("143.969 needs a = 100", f"it is {value(120)}")


def test_7_theta13_of_the_slider_crank():
    mechanism, equations = template("slider-crank")
    found = at(mechanism, equations, np.radians([60.0]))
    theta13, s14, x, y = (float(found[name][0]) for name in ("theta13", "s14", "C.x", "C.y"))
    stated(f"{math.degrees(theta13):.3f}°", f"({s14:.3f})", f"({x:.3f}, {y:.3f})", f"({math.sin(theta13):.5f})")


def test_8_step_and_config():
    mechanism, equations = template("four-bar")
    rows = np.radians(np.arange(0, 361, worked_values()["four-bar"]["step_deg"]))
    assert len(rows) == 25
    found = at(mechanism, equations, rows)
    gap = found["theta14"] - four_bar_theta14_config(rows, 1)
    assert np.max(np.abs(np.remainder(gap + math.pi, math.tau) - math.pi)) < 1e-12
    assert np.max(np.abs(found["theta14"] - four_bar_theta14_config(rows, -1))) > 0.5
    assert np.all(found["B.y"] > 0)
    assert [group.mode_value for group in equations.groups] == [1]
    stated(f"theta14 = {math.degrees(found['theta14'][0]):.2f}° at theta12 = 0", "25 rows")


def test_9_headings_and_ranges():
    column = table("fivelink")[:, 1]
    stated(f"from {column.min():.4f} to {column.max():.4f}")
    assert column.max() < math.tau
    rows, columns = table("adjustable-pump")[:, 1:].shape
    stated(f"B8:{chr(ord('B') + columns - 1)}{8 + rows - 1}")


def test_10_sign_of_b0_in_the_m_file():
    text = template_text("six-link-dwell")
    as_equations = 'B0 = { r = "A0B0", angle = "alpha1" }'
    assert as_equations in text
    distance, moved = {}, {}
    variants = {"equations": text, "m-file": text.replace(as_equations, as_equations.replace('"alpha1"', '"-alpha1"'))}
    for name, variant in variants.items():
        mechanism = loads(variant)
        found = at(mechanism, solve(mechanism), np.radians(np.arange(200, 260.5, 0.5)))
        distance[name] = math.hypot(found["B0.x"][0] - found["D0.x"][0], found["B0.y"][0] - found["D0.y"][0])
        moved[name] = np.degrees(np.ptp(found["theta16"]))
    stated(f"| {distance['equations']:.1f} | {distance['m-file']:.1f} |", f"99.33°: {moved['equations']:.2f}°")
    assert 9 < moved["m-file"] < 10
    stated("moves by more than 9°")


def test_templates_state_the_slips_that_concern_them():
    for name in ("four-bar", "slider-crank", "fivelink", "adjustable-pump", "six-link-dwell"):
        comment = template_text(name).partition("format = 1")[0]
        assert "docs/errata.md" in comment, name
        assert load(TEMPLATES / f"{name}.toml").source.of("en").startswith("Eres Söylemez"), name

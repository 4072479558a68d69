"""What the first sheet says of a cam, as its cells are changed."""

from pathlib import Path

import pytest
from both_layouts import Book

from mechsheet.compiled import compiled_of
from mechsheet.description import Overrides, load, loads

TEMPLATES = Path(__file__).resolve().parents[3] / "templates"
WORDS = 4


def line(mechanism, key):
    """Number and words of a line."""
    compiled = compiled_of(mechanism)
    row = compiled.plan.blocks["verdicts"].rows[key]
    return tuple(compiled.cells.values().get(compiled.plan.main, row, col) for col in (1, WORDS))


def test_pressure_angle():
    number, words = line(load(TEMPLATES / "cam-slide.toml"), "pressure_angle")
    assert 23.9 < number < 24.0
    assert words == "pressure angle: no more than usual"
    number, words = line(load(TEMPLATES / "cam-slide.toml", Overrides({"rb": "15", "e": "0"})), "pressure_angle")
    assert number > 30
    assert words.startswith("pressure angle: more than usual")


def test_undercut_face_and_the_base_circle_that_would_do():
    radius, words = line(load(TEMPLATES / "cam-flat.toml"), "least_rho")
    assert words == "least radius of curvature of the profile"
    low = 25 - radius - 1e-6
    number, words = line(load(TEMPLATES / "cam-flat.toml", Overrides({"rb": str(low)})), "least_rho")
    assert number == pytest.approx(-1e-6, abs=1e-9)
    assert words.startswith("undercut") and words.endswith(f"{25 - radius:.3f}".rstrip("0"))
    number, words = line(load(TEMPLATES / "cam-flat.toml", Overrides({"rb": str(low + 2e-6)})), "least_rho")
    assert number > 0 and not words.startswith("undercut")


def test_undercut_roller():
    number, words = line(load(TEMPLATES / "cam-slide.toml", Overrides({"rb": "5", "rr": "30"})), "least_rho")
    assert number <= 0 and words == "undercut: this profile cannot be made"


@pytest.mark.slow
def test_leaps():
    text = (TEMPLATES / "cam-slide.toml").read_text(encoding="utf-8")
    smooth = loads(text)
    assert line(smooth, "velocity_leaps") == (0, "the velocity goes without leaps")
    assert line(smooth, "acceleration_leaps") == (0, "the acceleration goes without leaps")
    uniform = loads(text.replace('"cycloidal"\nover', '"uniform"\nover'))
    assert line(uniform, "velocity_leaps") == (2, "infinite acceleration: the velocity leaps at 0° 90°")
    parabolic = loads(text.replace('"cycloidal"\nover', '"parabolic"\nover'))
    assert line(parabolic, "acceleration_leaps") == (3, "the acceleration leaps at 0° 45° 90°")


def test_outputs_summaries_and_charts_read_the_cams_columns_without_a_speed():
    text = (
        (TEMPLATES / "cam-slide.toml")
        .read_text(encoding="utf-8")
        .replace('speed = { value = 600, unit = "rpm" }\n', "")
    )
    text += (
        '[outputs]\nq = { formula = "hypot(cam.x, cam.y) + 0*alpha" }\n[summary]\nfar = { of = "q", take = "max" }\n'
    )
    text += '[[charts]]\nx = "phi"\ny = ["alpha", "s.ddd"]\n'
    compiled = compiled_of(loads(text))
    row = compiled.plan.blocks["summary"].rows["far"]
    assert 55 < compiled.cells.values().get(compiled.plan.main, row, 1) < 61


@pytest.mark.parametrize(
    ("law", "radius", "colour"), [("cycloidal", 30, "green"), ("cycloidal", 14, "amber"), ("uniform", 30, "red")]
)
def test_the_line_under_the_title_is_as_bad_as_the_worst_line(law, radius, colour):
    """A pressure angle above the usual one is amber below, a velocity that leaps is red: so is the line."""
    text = (TEMPLATES / "cam-slide.toml").read_text(encoding="utf-8")
    book = Book(text.replace('"cycloidal"\nover', f'"{law}"\nover'), "sheets").type(rb=radius)
    assert book.line.startswith("closes in all")
    assert book.line_colour == colour

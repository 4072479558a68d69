"""What the first sheet says of a cam, as its cells are changed."""

import math
import re

import numpy as np
import pytest
from both_layouts import Book
from laid import Laid

from folders import TEMPLATES
from mechsheet.compiled import compiled_of
from mechsheet.description import Overrides, load, loads
from mechsheet.description.templates import template_text
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.sweep import sweep
from mechsheet.sheet.findings.cam import FACTORS
from mechsheet.sheet.plan import UNIT
from random_cams import ON_A_SLIDE

WORDS = 4

NO_DIMENSIONS = (
    ON_A_SLIDE
    + 'driver = { joint = "s", step = 5, segments = [{ law = "3-4-5", over = 90, to = 12 }, { law = "3-4-5", to = 0 }] }'
)


def line(mechanism, key):
    """Number and words of a line."""
    compiled = compiled_of(mechanism)
    row = compiled.plan.blocks["verdicts"].rows[key]
    return tuple(compiled.cells.values().get(compiled.plan.main, row, col) for col in (1, WORDS))


@pytest.mark.slow
def test_pressure_angle():
    number, words = line(load(TEMPLATES / "cam-slide.toml"), "pressure_angle")
    assert 23.9 < number < 24.0
    assert words == "pressure angle: no more than usual"
    number, words = line(load(TEMPLATES / "cam-slide.toml", Overrides({"rb": "15", "e": "0"})), "pressure_angle")
    assert number > 30
    assert words.startswith("pressure angle: more than usual")


@pytest.mark.slow
def test_undercut_face_and_the_base_circle_that_would_do():
    radius, words = line(load(TEMPLATES / "cam-flat.toml"), "least_rho")
    assert words == "least radius of curvature of the profile"
    low = 25 - radius - 1e-6
    number, words = line(load(TEMPLATES / "cam-flat.toml", Overrides({"rb": str(low)})), "least_rho")
    assert number == pytest.approx(-1e-6, abs=1e-9)
    assert words.startswith("undercut")
    needed = float(words.split(" ")[-1])
    assert 25 - radius <= needed < 25 - radius + 1e-3  # so that it does
    number, words = line(load(TEMPLATES / "cam-flat.toml", Overrides({"rb": str(low + 2e-6)})), "least_rho")
    assert number > 0 and not words.startswith("undercut")


@pytest.mark.slow
def test_a_knife_edge_is_a_roller_without_radius():
    """The search of `check` says the same: it has a position in every row, and the radius is that of the pitch curve."""
    mechanism = load(TEMPLATES / "cam-slide.toml", Overrides({"rr": "0"}))
    assert line(mechanism, "inputs") == (0, "all hold possible values")
    fine = sweep(mechanism, solve(mechanism), {"phi": np.radians(np.arange(0, 360, 0.05))})
    assert line(mechanism, "least_rho")[0] == pytest.approx(1 / np.max(fine["kappa"]), rel=1e-5)
    text = (TEMPLATES / "cam-slide.toml").read_text(encoding="utf-8").replace('radius = "rr"', "radius = 0")
    assert line(loads(text), "inputs")[0] == 0  # the radius has a cell of its own


@pytest.mark.slow
def test_undercut_roller():
    number, words = line(load(TEMPLATES / "cam-slide.toml", Overrides({"rb": "5", "rr": "30"})), "least_rho")
    assert number <= 0
    assert words == "undercut: it cannot be made; see study"


@pytest.mark.slow
@pytest.mark.cases(2)
@pytest.mark.parametrize("offset", [0, 8, -6])
@pytest.mark.parametrize("base", [12, 40])
def test_the_base_circle_that_makes_the_pressure_angle_usual(offset, base):
    """Its largest angle is the limit then, from a smaller base circle and from a larger one."""
    changes = {"e": str(offset), "rb": str(base)}
    needed, words = line(load(TEMPLATES / "cam-slide.toml", Overrides(changes)), "needed_base")
    assert words == "base circle for just the usual pressure angle"
    mechanism = load(TEMPLATES / "cam-slide.toml", Overrides(changes | {"rb": repr(needed)}))
    rows = sweep(mechanism, solve(mechanism), {"phi": np.radians(np.arange(0, 360, 0.05))})
    assert np.degrees(np.abs(rows["alpha"]).max()) == pytest.approx(30, abs=1e-4)
    assert line(mechanism, "needed_base")[0] == pytest.approx(needed, rel=1e-6)


@pytest.mark.slow
def test_where_no_closed_form_says_what_would_do_a_study_is_named():
    rocker = load(TEMPLATES / "cam-rocker.toml")
    assert line(rocker, "pressure_angle")[1] == "pressure angle: no more than usual"
    text = rocker.text.replace("[cam]\n", "[cam]\npressure_angle = 20\n")
    assert line(loads(text), "pressure_angle")[1].endswith("it may jam; see study")
    assert "needed_base" not in compiled_of(rocker).plan.blocks["verdicts"].rows


@pytest.mark.slow
def test_a_base_circle_that_decides_nothing_is_not_advised():
    """Where a face's start is written out another base circle moves nothing."""
    flat = load(TEMPLATES / "cam-flat.toml", Overrides({"rb": "2"}))
    assert line(flat, "least_rho")[1].startswith("undercut: it cannot be made: a base circle of at least")
    text = flat.text.replace("[driver]\n", "[driver]\nstart = 2\n")
    assert (
        line(loads(text, overrides=Overrides({"rb": "2"})), "least_rho")[1] == "undercut: it cannot be made; see study"
    )


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["sheets", "page"])
def test_how_long_a_face_must_be(layout):
    """A slide is touched s' beside its axis: a cycloidal rise by h over b is up to 2 h/b away."""
    mechanism = load(TEMPLATES / "cam-flat.toml", Overrides(layout=layout))
    compiled = compiled_of(mechanism)
    spot = compiled.plan.places.lines["face_length"]
    fine = sweep(mechanism, solve(mechanism), {"phi": np.radians(np.arange(0, 360, 0.05))})["contact"]
    assert compiled.number(spot) == pytest.approx(np.ptp(fine), rel=1e-5 if layout == "sheets" else 1e-2)
    words = compiled.cells.values().get(spot.sheet, spot.row, WORDS if layout == "sheets" else 3)
    ends = [float(number) for number in re.findall(r"-?\d+\.\d+", words)]
    assert ends == pytest.approx([fine.min(), fine.max()], abs=6e-3 if layout == "sheets" else 0.1)


@pytest.mark.slow
def test_a_page_says_where_in_the_rows():
    """In a line of its own."""
    mechanism = load(TEMPLATES / "cam-slide.toml", Overrides(layout="page"))
    compiled = compiled_of(mechanism)
    alpha = np.abs(compiled.values["alpha"])
    spot = compiled.plan.places.occurs["pressure_angle"]
    said = [compiled.cells.values().get(spot.sheet, spot.row, col) for col in (0, 1, 2, 3)]
    assert said[1:] == [5.0 * int(np.argmax(alpha)), "°", "where that is"]


@pytest.mark.slow
def test_leaps():
    text = template_text("cam-slide")
    smooth = loads(text)
    assert line(smooth, "velocity_leaps") == (0, "the velocity goes without leaps")
    assert line(smooth, "acceleration_leaps") == (0, "the acceleration goes without leaps")
    uniform = loads(text.replace('"cycloidal"\nover', '"uniform"\nover'))
    assert line(uniform, "velocity_leaps") == (
        2, "infinite acceleration: the velocity leaps at 0° (dwell – uniform) 90° (uniform – dwell)",
    )  # fmt: skip
    parabolic = loads(text.replace('"cycloidal"\nover', '"parabolic"\nover'))
    assert line(parabolic, "acceleration_leaps") == (
        3, "the acceleration leaps at 0° (dwell – parabolic) 45° (parabolic) 90° (parabolic – dwell)",
    )  # fmt: skip


@pytest.mark.slow
def test_a_motion_that_ends_leaps_where_it_stops():
    """It stands still before it begins and after it ends."""
    text = (TEMPLATES / "cam-slide.toml").read_text(encoding="utf-8").split("[[driver.segments]]")[0]
    text = text.replace("step = 5", "step = 5\nclosed = false")
    text += '[[driver.segments]]\nlaw = "uniform"\nover = 90\nby = "h1"\n'
    text += '[cam]\ncenter = "O"\nbase_radius = "rb"\nroller = { point = "C", radius = "rr" }\n'
    assert line(loads(text), "velocity_leaps") == (
        2, "infinite acceleration: the velocity leaps at 0° (uniform) 90° (uniform)",
    )  # fmt: skip


@pytest.mark.slow
def test_beside_leaps_of_the_acceleration_an_extreme_is_about_right():
    """The largest may be just where a segment ends, on the side on which no row lies: no probe comes so near."""
    text = (TEMPLATES / "cam-slide.toml").read_text(encoding="utf-8")
    assert not line(loads(text), "least_rho")[1].endswith("(about)")
    assert line(loads(text.replace("cycloidal", "parabolic")), "least_rho")[1].endswith("(about)")


@pytest.mark.slow
def test_outputs_summaries_and_charts_read_the_cams_columns_without_a_speed():
    text = (
        (TEMPLATES / "cam-slide.toml")
        .read_text(encoding="utf-8")
        .replace('speed = { value = 600, unit = "rpm" }\n', "")
        .split("[summary]")[0]
    )
    text += (
        '[outputs]\nq = { formula = "hypot(cam.x, cam.y) + 0*alpha" }\n[summary]\nfar = { of = "q", take = "max" }\n'
    )
    text += '[[charts]]\nx = "phi"\ny = ["alpha", "s.ddd"]\n'
    compiled = compiled_of(loads(text))
    row = compiled.plan.blocks["summary"].rows["far"]
    assert 55 < compiled.cells.values().get(compiled.plan.main, row, 1) < 61


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cam-slide", "cam-valve", "cam-rocker"])
def test_extremes_are_those_between_the_rows(name):
    """With rows of 5 degrees the lines say what rows of a twentieth of a degree have."""
    text = template_text(name).split("[study]")[0]
    mechanism = loads(text)
    equations, dimensions = solve(mechanism), dimension_values(mechanism)
    fine = sweep(mechanism, equations, {"phi": np.radians(np.arange(0, 360, 0.05))})
    convex = fine["rho"] if mechanism.cam.radius is None else fine["rho"][fine["kappa"] > 0]
    assert line(mechanism, "least_rho")[0] == pytest.approx(np.min(convex), rel=1e-5)
    if name != "cam-valve":
        steepest = np.degrees(np.max(np.abs(fine["alpha"])))
        assert line(mechanism, "pressure_angle")[0] == pytest.approx(steepest, rel=1e-5)
        return
    assert line(mechanism, "contact_force")[0] == pytest.approx(np.min(fine["N"]), rel=1e-5)
    assert dimensions["rb"] == 20


@pytest.mark.slow
def test_where_the_follower_lifts_off_and_the_spring_that_holds_it():
    book = Book(template_text("cam-valve"), "sheets")
    assert book.words("contact_force") == "the follower stays on the cam"
    assert book.line_colour == "green"
    book.type(speed=4000)
    assert book.words("contact_force").startswith("the follower lifts off at 69")
    assert book.line_colour == "red"
    needed = book.number("holding_spring")
    least = book.number("contact_force")
    assert needed - 48 == pytest.approx(-least / 25)  # they touch where the force was least
    said = book.words("holding_spring")
    assert said == f"{-least:.1f} N more preload of K needed: at least this"
    needed = math.ceil(100 * needed) / 100
    book.type(speed=4000, l0=needed)
    assert book.words("contact_force") == "the follower stays on the cam"
    book.type(speed=4000, l0=needed - 0.02)
    assert book.words("contact_force").startswith("the follower lifts off")


@pytest.mark.slow
def test_a_spring_that_pulls_is_to_be_shorter():
    text = template_text("cam-valve")
    text = text.replace('S = [0, "rb + 15 + l1"]', 'S = [0, "rb + 15 - l1"]').replace("value = 48", "value = 32")
    mechanism = loads(text.replace("value = 3000", "value = 4000"))
    needed, words = line(mechanism, "holding_spring")
    assert words.endswith("needed: at most this")
    held = loads(text.replace("value = 3000", "value = 4000").replace("value = 32", f"value = {needed}"))
    assert line(held, "contact_force")[0] >= 0


def test_the_largest_rates_have_the_units_of_their_columns():
    compiled = compiled_of(load(TEMPLATES / "cam-slide.toml"))
    units = {cell.row: cell.content for cell in compiled.layout.sheets[0].cells if cell.col == UNIT}
    keys = ("largest_velocity", "largest_acceleration", "largest_jerk")
    assert [units[compiled.plan.places.lines[key].row] for key in keys] == ["mm/s", "mm/s²", "mm/s³"]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("key", "factor", "power", "law"),
    [("largest_velocity", 2, 1, "factor 2"), ("largest_acceleration", 2 * math.pi, 2, "factor 6.2832"),
     ("largest_jerk", 4 * math.pi**2, 3, "factor 39.478")],
)  # fmt: skip
def test_largest_rates_are_those_of_the_laws(key, factor, power, law):
    """Rows of 7 degrees miss every peak; the numbers do not."""
    text = template_text("cam-slide").replace("step = 5", "step = 7.2")
    number, words = line(loads(text), key)
    speed, over = 600 * math.pi / 30, math.pi / 2
    assert number == pytest.approx(factor * 20 * (speed / over) ** power)
    assert words == f"segment 1, cycloidal: {law}"


@pytest.mark.slow
def test_factors_of_all_laws_are_those_of_their_formulas():
    for law, factors in FACTORS.items():
        if law in ("dwell", "uniform"):
            continue
        text = template_text("cam-slide").replace('"cycloidal"\nover', f'"{law}"\nover')
        mechanism = loads(text)
        found = sweep(mechanism, solve(mechanism), {"phi": np.radians(np.linspace(0, 90, 20001)[:-1])})
        for ending, power, factor in zip(("d", "dd", "ddd"), (1, 2, 3), factors, strict=True):
            largest = np.max(np.abs(found[f"s.{ending}"])) * (math.pi / 2) ** power / 20
            assert largest == pytest.approx(factor, rel=1e-5, abs=1e-9), (law, ending)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("law", "radius", "colour"), [("cycloidal", 30, "green"), ("cycloidal", 14, "amber"), ("uniform", 30, "red")]
)
def test_the_line_under_the_title_is_as_bad_as_the_worst_line(law, radius, colour):
    """A pressure angle above the usual one is amber below, a velocity that leaps is red: so is the line."""
    text = template_text("cam-slide")
    book = Book(text.replace('"cycloidal"\nover', f'"{law}"\nover'), "sheets").type(rb=radius)
    assert book.line.startswith("closes in all")
    assert book.line_colour == colour


@pytest.mark.slow
def test_a_page_says_the_same_of_its_rows():
    text = template_text("cam-valve")
    page, sheets = Book(text, "page"), Book(text, "sheets")
    for key in ("pressure_angle", "largest_velocity", "largest_acceleration", "largest_jerk", "velocity_leaps"):
        assert page.number(key) == pytest.approx(sheets.number(key))
        assert page.words(key).partition(", at ")[0] == sheets.words(key)
    for key in ("least_rho", "contact_force", "holding_spring"):
        assert page.number(key) == pytest.approx(sheets.number(key), rel=0.02)
        assert page.words(key).partition(", at ")[0].endswith("(rows only)")
    assert page.type(speed=4000).words("contact_force").startswith("the follower lifts off at 70°: N = -81.61 N")
    assert page.line_colour == "red"
    mechanism = loads(text)
    rows = sweep(mechanism, solve(mechanism), {"phi": np.radians(np.arange(0, 365, 5))})
    assert Book(text, "page").number("contact_force") == pytest.approx(np.min(rows["N"]))


@pytest.mark.slow
def test_an_empty_cell_is_called_by_its_own_name():
    """A cam's dimensions stand below its sweep where there are no others: the words named the cells between the two."""
    laid = Laid(NO_DIMENSIONS)
    assert laid.change(base_radius=None).verdict.startswith("look at base_radius: ")
    assert laid.change(over_1=None).verdict.startswith("look at over₁: ")
    assert laid.change(_step=0).verdict.startswith("look at step: ")

"""The chart of a cam's profile, and the curves of what the cam moves."""

import numpy as np
import pytest
from laid import Laid

from mechsheet.description.templates import template_text

PROFILE = "Profile of the cam"


def series(laid, chart, name):
    """A series of a chart as numbers (n, 2)."""
    found = next(each for each in chart.series if each.name == name)
    columns = []
    for ref in (found.x, found.y):
        rows = range(ref.area.first_row, ref.area.last_row + 1)
        columns.append([laid.values.get(ref.sheet, row, ref.area.first_col) for row in rows])
    return np.array(columns, float).T


def chart(laid, title):
    return next(each for each in laid.workbook.sheets[0].charts if each.title == title)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["cam-slide", "cam-valve"])
def test_profile_and_base_circle_are_at_true_scale(name):
    laid = Laid(template_text(name))
    found = chart(laid, PROFILE)
    assert found.x_axis == found.y_axis
    assert found.inner[2] == found.inner[3]  # a square with equal axes
    outline, circle, middle = (series(laid, found, each) for each in ("profile", "base circle", "O"))
    radii = np.hypot(*(circle - middle).T)
    assert radii == pytest.approx([radii[0]] * len(radii))
    scale = radii[0] / laid.spot("rb")
    places = np.column_stack([laid.column("cam.x"), laid.column("cam.y")])
    assert (outline - middle) / scale == pytest.approx(places, abs=1e-9)
    assert np.abs(outline).max() <= 1  # nothing leaves the window
    # it touches the base circle, and nowhere goes below it
    assert np.min(np.hypot(*(outline - middle).T)) == pytest.approx(radii[0])


@pytest.mark.slow
def test_the_place_touched_goes_round_with_the_position():
    laid = Laid(template_text("cam-slide"))
    found = chart(laid, PROFILE)
    outline = series(laid, found, "profile")
    for row in (0, 20, 55):
        laid.change(_position=row)
        assert series(laid, found, "place touched")[0] == pytest.approx(outline[row])


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "titles"),
    [
        ("cam-slide", ["s against φ", "ṡ against φ", "s̈ against φ", "j_s against φ"]),
        ("cam-rocker", ["θ₁₂ against φ", "ω₁₂ against φ", "α₁₂ against φ", "j₁₂ against φ"]),
    ],
)
def test_curves_of_the_follower_stand_one_under_another(name, titles):
    laid = Laid(template_text(name))
    anchors = [chart(laid, title).anchor for title in titles]
    assert len({(anchor.col, anchor.dx) for anchor in anchors}) == 1
    assert [anchor.row for anchor in anchors] == sorted(anchor.row for anchor in anchors)
    assert not chart(laid, titles[2]).smooth
    assert chart(laid, titles[0]).smooth


@pytest.mark.slow
def test_without_a_speed_they_are_derivatives_by_the_cams_angle():
    text = template_text("cam-slide").replace('speed = { value = 600, unit = "rpm" }', "")
    titles = [each.title for each in Laid(text).workbook.sheets[0].charts]
    assert {"s against φ", "s′ against φ", "s″ against φ", "s‴ against φ"} < {*titles}


@pytest.mark.slow
def test_a_chart_of_the_profile_can_be_asked_for():
    laid = Laid(template_text("cam-rocker") + "[[charts]]\nprofile = true\ntitle = 'Kurve'\n")
    assert [each.title for each in laid.workbook.sheets[0].charts] == ["", "Kurve"]

"""What is drawn: the points are the reference's at any driver value, at one scale; what does not exist is not drawn."""

import math
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from placed import places_of

from drawn_points import expected, fitted
from folders import TEMPLATES
from livesheet.engine import PORTABLE, evaluate
from livesheet.evaluation import book_of
from mechsheet import reference
from mechsheet.description import Overrides, load
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechanismError, MechsheetError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.plotting.sampling import LEAST, MOST, resampled, sample, with_value
from mechsheet.plotting.scenes import Stage, journey


@cache
def template(name, **changes):
    return load(TEMPLATES / f"{name}.toml", Overrides(changes))


def marked(scene):
    """Places of the marked points, rings before dots."""
    return np.array([(item.x, item.y) for item in scene.items if item.kind in ("pin", "point")])


def bar(scene):
    """(length written at the scale bar, its length in the drawing)."""
    line, text = (item for item in scene.items if item.kind == "scale")
    return float(text.text.split()[0]), np.ptp(line.points[:, 0])


CASES = [
    ("four-bar", 60.0),
    ("four-bar", 62.5),
    ("four-bar", 301.125),
    ("four-bar", 425.0),  # outside of the sweep
    ("four-bar", -30.0),
    ("fivelink", 47.0),
    ("adjustable-pump", 133.3),
    ("six-link-dwell", 200.7),
    ("jansen", 91.0),
    ("elliptic-trammel", 12.0),
    ("scissor-lift", 77.7),
    ("watt-straight-line", -3.25),
    ("inverted-slider-crank", 222.0),
]


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "at"), CASES)
def test_points_are_the_references(name, at):
    mechanism = template(name)
    stage = Stage(sample(mechanism, at, None))
    row = stage.sample.shown
    assert shown_value(stage, row) == pytest.approx(at, abs=1e-9)
    own = driver_values(mechanism, dimension_values(mechanism))
    value = mechanism.driver.unit.to_internal(at)
    way = np.linspace(own[0], value, 400).tolist()  # the reference gets there from the sketch by a way of its own
    truth = reference.solve(replace(mechanism, driver=replace(mechanism.driver, values=tuple(way))))
    scene = stage.drawing(row)
    scale, worst = fitted(marked(scene), expected(mechanism, truth, len(way) - 1))
    assert worst < 1e-9 * scene.window.half
    assert scale == pytest.approx(1, abs=1e-9)
    length, drawn = bar(scene)
    assert drawn == pytest.approx(length, rel=1e-9)


def shown_value(stage, row):
    value = stage.sample.plan.driver[row]
    return stage.sample.plan.mechanism.driver.unit.to_shown(value)


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "scotch-yoke", "peaucellier"])
def test_whole_sweep_is_the_references(name):
    stage = Stage(sample(template(name), None, None))
    mechanism = stage.sample.plan.mechanism
    truth = reference.solve(mechanism)
    for row in range(0, stage.sample.sweep, 13):
        assert marked(stage.drawing(row)) == pytest.approx(
            expected(mechanism, truth, row), abs=1e-9 * mechanism_size(stage)
        )


def mechanism_size(stage):
    return stage.positions.window.half


@pytest.mark.slow
def test_what_follows_the_position_is_all_that_changes():
    """What is computed for the drawing is what the whole workbook gives, for every series of every chart."""
    stage = Stage(sample(template("adjustable-pump"), None, None))
    spot = places_of(stage.sample.plan)["position"]
    before = stage.sample.value(spot)
    whole = evaluate(book_of(stage.sample.layout), {(spot.sheet, spot.row, spot.col): 37.0}, PORTABLE)
    for chart, scene in zip(stage.charts, stage.at(37, stage.charts), strict=True):
        for piece in scene:
            for axis, ref in enumerate((piece.series.x, piece.series.y)):
                area = ref.area
                numbers = whole.arrays(ref.sheet, area.first_col, area.first_row, area.last_row)[0]
                both = np.isfinite(numbers) & np.isfinite(piece.points[:, axis])
                assert both.sum() == np.isfinite(piece.points[:, axis]).sum(), chart.title
                assert (piece.points[both, axis] == numbers[both]).all(), chart.title
    assert stage.sample.value(spot) == before != 37.0


@pytest.mark.slow
def test_position_outside_of_the_sweep_leaves_the_path_as_it_is():
    def path(at):
        stage = Stage(sample(template("four-bar"), at, None))
        return next(item.points for item in stage.drawing(stage.sample.shown).items if item.kind == "path")

    assert path(425.0) == pytest.approx(path(None), abs=1e-9)
    assert len(path(62.5)) == len(path(None)) + 1


@pytest.mark.slow
def test_rows_that_do_not_exist_leave_gaps():
    stage = Stage(sample(template("four-bar", a2="90"), None, None))
    exists = np.array(stage.sample.exists)
    assert 0 < exists.sum() < len(exists)
    nothing = stage.drawing(int(np.flatnonzero(~exists)[0]))
    path = next(item.points for item in nothing.items if item.kind == "path")
    assert (np.isfinite(path).all(axis=1) == exists).all()
    links = {item.name: item.points for item in nothing.items if item.kind == "link"}
    assert np.isfinite(links["crank"]).all(), "which turns on"
    assert not np.isfinite(links["coupler"]).any()
    assert "does not close" in nothing.caption
    rows, closed = journey(stage, 60)
    assert not closed
    assert all(exists[row] for row in rows)


def test_no_position_there():
    with pytest.raises(MechanismError) as caught:
        sample(template("four-bar", a2="90"), 180.0, None)
    assert "no position at θ₁₂ = 180°: does not close: coupler, rocker" in str(caught.value)
    assert "0 … 93°, 267 … 360°" in str(caught.value)


@pytest.mark.parametrize("at", [math.nan, math.inf])
def test_no_number(at):
    with pytest.raises(MechsheetError, match="expected a finite number"):
        sample(template("four-bar"), at, None)


@pytest.mark.slow
def test_modes_are_those_of_the_description():
    """Another crossing of the loop, chosen by the sketch, stays chosen however the sweep is cut."""
    text = template_text("four-bar").replace("B = [50, 55]", "B = [50, -55]")
    from mechsheet.description import loads

    stage = Stage(sample(loads(text), 90.0, None))
    truth = reference.solve(stage.sample.plan.mechanism)
    row = stage.sample.shown
    assert truth.points["B"][row, 1] < 0
    assert fitted(marked(stage.drawing(row)), expected(stage.sample.plan.mechanism, truth, row))[1] < 1e-7


@pytest.mark.parametrize(
    ("count", "made"), [(2, 121), (25, 121), (19, 127), (121, 121), (361, 361), (362, 182), (3601, 361)]
)
def test_number_of_positions(count, made):
    values = np.linspace(10.0, 20.0, count).tolist()
    found = resampled(values)
    assert len(found) == made
    assert LEAST <= len(found) <= MOST
    assert (found[0], found[-1]) == (10.0, 20.0)
    assert (np.diff(found) > 0).all()
    if count <= LEAST:
        assert set(values) <= set(found)


def test_single_position():
    assert resampled([0.5]) == [0.5]
    mechanism = template("four-bar")
    stage = Stage(sample(replace(mechanism, driver=replace(mechanism.driver, values=(0.5,))), None, None))
    assert journey(stage, 60) == ([0], False)


@pytest.mark.parametrize(
    ("values", "value", "expected_values", "row"),
    [
        ([0.0, 1.0, 2.0], 1.0, [0.0, 1.0, 2.0], 1),
        ([0.0, 1.0, 2.0], 1.0 + 1e-12, [0.0, 1.0, 2.0], 1),
        ([0.0, 1.0, 2.0], 1.5, [0.0, 1.0, 1.5, 2.0], 2),
        ([2.0, 1.0, 0.0], 1.5, [2.0, 1.5, 1.0, 0.0], 1),
        ([0.0, 1.0, 2.0], 2.0, [0.0, 1.0, 2.0], 2),
        ([0.0, 1.0, 2.0], 3.0, [0.0, 1.0, 2.0, 3.0], 3),
        ([0.0, 1.0, 2.0], -1.0, [0.0, 1.0, 2.0, -1.0], 3),
        ([0.0], 5.0, [0.0, 5.0], 1),
    ],
)
def test_one_more_position(values, value, expected_values, row):
    assert with_value(values, value) == (expected_values, row)


@pytest.mark.slow
def test_journeys():
    stage = Stage(sample(template("four-bar"), None, None))
    rows, closed = journey(stage, 60)
    assert closed
    assert rows == list(range(0, 120, 2))  # the last row looks like the first and is left out
    stage = Stage(sample(template("four-bar"), 60.0, None))
    rows, _ = journey(stage, 60)
    assert rows[0] == stage.sample.shown == 20
    assert sorted(rows) == list(range(0, 120, 2))
    stage = Stage(sample(template("scissor-lift"), None, None))
    rows, closed = journey(stage, 60)
    assert not closed
    assert len(rows) <= 60
    assert rows == [*rows[: len(rows) // 2 + 1], *rows[len(rows) // 2 - 1 : 0 : -1]]  # to and fro

"""Which charts a workbook has, what is in them, and where they stand."""

import math
import re
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from chosen import some
from folders import TEMPLATE_NAMES
from livesheet.formats.house_style import MARGIN_END, MARGIN_TOP
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.dynamics.solve import solve
from mechsheet.sheet.drawing.charts import COLUMN_WIDTH, ROW_HEIGHT, chart_requests, driver_axis, value_axis
from mechsheet.sheet.first.mechanism import CHARTS
from mechsheet.sheet.layout import lay_out

SLIDER_CRANK = """
format = 1
[mechanism]
name = "slider-crank"
[dimensions]
a2 = 50
a3 = 250
b3 = 120
[links.ground]
points = { A0 = [0, 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.coupler]
points = { B = [0, 0], A = ["a3", 0], C = { r = "b3", angle = -30 } }
[links.piston]
points = { B = [0, 0] }
[[joints]]
type = "prismatic"
link = "piston"
on = "ground"
point = "B"
through = "A0"
[driver]
link = "crank"
start = 0
stop = 360
step = 10
[outputs]
mu = { formula = "theta13 - theta12", unit = "deg" }
nu = { formula = "theta12 - 2*theta13", unit = "deg" }
near = { formula = "s14 - a3", unit = "mm" }
far = { formula = "100*s14", unit = "mm" }
area = { formula = "a2*s14", unit = "mm^2" }
one = { formula = "sin(theta12)^2 + cos(theta12)^2", unit = "1" }
"""


@cache
def laid(text):
    mechanism = loads(text)
    return lay_out(mechanism, solve(mechanism))


def template(name):
    return laid(template_text(name))


def test_charts_that_suit_any_mechanism():
    """Angles that move, displacements, outputs by unit and size, the coupler point; not a constant, not the crank's pin."""
    _, plan = laid(SLIDER_CRANK)
    requests = chart_requests(plan)
    assert [request.y or request.paths for request in requests] == [
        ("theta13",), ("s14",), ("mu", "nu"), ("near",), ("far",), ("area",), ("C",),
    ]  # fmt: skip


def test_charts_of_the_description_take_their_place():
    text = (
        SLIDER_CRANK
        + '[[charts]]\ntitle = "One"\nx = "theta12"\ny = ["mu", "theta13"]\n[[charts]]\npaths = ["A", "C"]\n'
    )
    workbook, _ = laid(text)
    drawing, one, paths = workbook.sheets[0].charts
    assert (drawing.name, one.title) == ("drawing", "One")
    assert [series.name for series in one.series if series.in_legend] == ["μ", "θ₁₃"]
    assert [series.name for series in paths.series if series.in_legend] == ["A", "C"]


def test_axes_say_symbol_and_unit():
    workbook, _ = laid(SLIDER_CRANK)
    _, angles, displacements, outputs, *_ = workbook.sheets[0].charts
    assert (angles.x_axis.title, angles.y_axis.title) == ("θ₁₂ [°]", "θ₁₃ [°]")
    assert (angles.x_axis.low, angles.x_axis.high, angles.x_axis.step) == (0, 360, 30)
    assert displacements.y_axis.title == "s₁₄ [mm]"
    assert outputs.y_axis.title == "μ, ν [°]"
    assert [curve.dash for curve in outputs.series if curve.in_legend] == ["solid", "dash"]  # in black and white, too
    assert (outputs.y_axis.low, outputs.y_axis.high) == (None, None)  # dimensions change while the file lives


def charts(text):
    """The curves of the first sheet, by title."""
    return {chart.title: chart for chart in laid(text)[0].sheets[0].charts}


@pytest.mark.slow
@pytest.mark.parametrize("sign", [1, -1])
def test_a_dwell_far_from_0_fills_its_chart(sign):
    """The output of the six-link is between 71 and 99 degrees: on an axis from 0 its dwell would be a line among lines."""
    text = template_text("six-link-dwell")
    chart = charts(text)["Output with a dwell from 200 to 260 degrees"]
    assert (chart.y_axis.low, chart.y_axis.high) == (50.0, None)
    text = SLIDER_CRANK.replace('"a2*s14"', f'"{sign}*a2*(a3 + s14/8)"')  # from 13,750 to 14,375
    axis = next(chart.y_axis for title, chart in charts(text).items() if title.startswith("area"))
    assert (axis.low, axis.high) == ((13_400.0, None) if sign > 0 else (None, -13_400.0))


def test_numbers_of_many_digits_leave_the_curve_its_room():
    """The jerk of a cam's follower goes up to 5E+7 mm/s³: eight digits beside the axis would push the curve aside."""
    text = template_text("cam-slide")
    formats = {title: chart.y_axis.number_format for title, chart in charts(text).items() if chart.y_axis.visible}
    assert formats["j_s against φ"] == "0.0E+0;-0.0E+0;0"
    assert {form for title, form in formats.items() if not title.startswith("j_s")} == {"General"}


def test_ends_of_axes_that_the_description_gives():
    text = (
        SLIDER_CRANK + '[[charts]]\ntitle = "One"\nx = "theta12"\ny = ["mu"]\ny_min = -90\nx_min = 45.5\nx_max = 90\n'
    )
    one = charts(text)["One"]
    assert (one.x_axis.low, one.x_axis.high, one.y_axis.low, one.y_axis.high) == (45.5, 90, -90, None)


def test_curves_are_bent_unless_they_leap():
    text = SLIDER_CRANK.replace('far = { formula = "100*s14"', 'far = { formula = "a2/sin(theta12 - 0.1)"')
    found = charts(text)
    assert not next(chart.smooth for title, chart in found.items() if "far" in title)
    assert {chart.smooth for title, chart in found.items() if title and "far" not in title} == {True}


@pytest.mark.parametrize(("start", "stop", "low", "high", "step"), [
    (0, 360, 0, 360, 30), (0, 720, 0, 720, 60), (-70, 70, -75, 75, 15), (10, 32, 10, 32, 2), (30, 30, None, None, None),
    (0, 375, 0, 405, 45), (0, 90_000, 0, 90_000, 3600), (20, -340, -360, 30, 30),
])  # fmt: skip
def test_steps_of_the_driver(start, stop, low, high, step):
    """At most twelve of them, or those of ten turns: hundreds of grid lines would be a black area."""
    plan = replace(laid(SLIDER_CRANK)[1], driver=[math.radians(start), math.radians(stop)])
    axis = driver_axis(plan, "theta12")
    assert (axis.low, axis.high, axis.step) == (low, high, step)


@pytest.mark.cases(5)
@pytest.mark.parametrize("name", TEMPLATE_NAMES)
def test_every_curve_has_its_marker(name):
    """One point from single cells for each curve, in its colour; curves read whole columns of the table of positions."""
    workbook, plan = template(name)
    for chart in workbook.sheets[0].charts:
        if chart.name == "drawing" or chart.title == plan.text("chart.profile"):
            continue
        curves = [series for series in chart.series if series.in_legend]
        markers = {(series.name, series.marker_fill) for series in chart.series if series.marker}
        named = {
            (series.name.replace("v ", "v_"), series.line) for series in curves
        }  # the end of the arrow v_C on the curve v C
        assert curves and named == markers
        for series in chart.series:
            if series.marker:
                assert series.x.area.first_row == series.x.area.last_row


@pytest.mark.cases(12)
@pytest.mark.parametrize("name", TEMPLATE_NAMES)
def test_charts_do_not_overlap(name):
    """On the grid by which they are placed; the drawing first, under the scroll bar, everything else right of the blocks."""
    workbook, _ = template(name)
    sheet = workbook.sheets[0]
    boxes = []
    for chart in sheet.charts:
        left = (chart.anchor.col - CHARTS) * COLUMN_WIDTH + chart.anchor.dx
        top = chart.anchor.row * ROW_HEIGHT + chart.anchor.dy
        boxes.append((left, top, left + chart.anchor.width, top + chart.anchor.height))
        assert chart.anchor.dx < COLUMN_WIDTH and chart.anchor.dy < ROW_HEIGHT
    assert sheet.charts[0].name == "drawing" and sheet.charts[0].anchor.row == 3
    for n, a in enumerate(boxes):
        assert a[0] >= 0
        for b in boxes[:n]:
            assert a[0] >= b[2] or b[0] >= a[2] or a[1] >= b[3] or b[1] >= a[3]
    heights = dict(sheet.row_heights)
    for row in range(sheet.charts[0].anchor.row, max(chart.anchor.row for chart in sheet.charts)):
        assert row in heights  # not left to a program, else charts run into each other


@pytest.mark.cases(10)
@pytest.mark.parametrize("name", TEMPLATE_NAMES)
def test_true_scale(name):
    """Drawing and paths: square frame, square plot area, the same fixed axes, hidden."""
    workbook, _ = template(name)
    for chart in workbook.sheets[0].charts:
        if chart.inner is None:
            continue
        assert chart.anchor.width == chart.anchor.height
        assert chart.inner[2] == chart.inner[3]
        assert chart.inner[0] + chart.inner[2] <= 1 and chart.inner[1] + chart.inner[3] <= 1
        for axis in (chart.x_axis, chart.y_axis):
            assert (axis.low, axis.high, axis.visible) == (-1, 1, False)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "six-link-dwell", "four-bar-forces", "jansen"])
def test_the_first_sheet_can_be_read_on_paper(name):
    """A4: letters of 10 points are at least 6.5 high; on a sheet of several pages charts have some of their own, uncut."""
    sheet = template(name)[0].sheets[0]
    setup = sheet.print_setup
    heights = dict(sheet.row_heights)
    pixels = sum(heights.values())
    inches = 11.69 - MARGIN_TOP - MARGIN_END  # of an upright page
    if not setup.scale:
        assert (setup.fit_width, setup.fit_height, setup.landscape) == (1, 1, True)
        assert 10 * (8.27 - MARGIN_TOP - MARGIN_END) * 96 / pixels >= 6.5
        return
    assert 10 * setup.scale / 100 >= 6.5
    assert setup.page_at[0] == CHARTS
    bottom = max(
        sum(heights[row] for row in range(chart.anchor.row)) + chart.anchor.dy + chart.anchor.height
        for chart in sheet.charts
    )
    assert bottom / 96 * setup.scale / 100 <= inches
    assert max(cell.row for cell in sheet.cells) <= setup.area.last_row
    ends = [*setup.page_at[1:], setup.area.last_col + 1]
    for chart in sheet.charts:
        end = next(end for end in ends if chart.anchor.col < end)
        assert chart.anchor.dx + chart.anchor.width <= (end - chart.anchor.col) * COLUMN_WIDTH
    tops = [sum(heights[at] for at in range(row)) for row in setup.row_at]
    for chart in sheet.charts:
        top = sum(heights[row] for row in range(chart.anchor.row)) + chart.anchor.dy
        assert not any(top < edge < top + chart.anchor.height for edge in tops), chart.title


BALANCED = """
format = 1
[mechanism]
name = "balanced"
[links.ground]
points = { A0 = [0, 0] }
[links.crank]
points = { A0 = [0, 0], A = [100, 0] }
mass = 3
center = CENTER
[driver]
link = "crank"
start = 0
stop = 360
step = 15
[dynamics]
gravity = 9.81
"""


def requested(center, more=""):
    _, plan = laid(BALANCED.replace("CENTER", center) + more)
    return plan, {request.y: request for request in chart_requests(plan) if "T12" in request.y}


def test_a_balanced_torque_is_a_line_at_zero():
    """What rounding leaves of an effort has an axis as large as the terms that cancel."""
    plan, found = requested('["300*(0.1 + 0.2) - 90", 0]')
    assert 0 < np.nanmax(np.abs(plan.nominal["T12"])) < 1e-15
    axis = value_axis(plan, found["T12", "T12.work"])
    assert (axis.low, axis.high) == (-1.0, 1.0)


@pytest.mark.slow
@pytest.mark.parametrize("name", some(TEMPLATE_NAMES, 6))
def test_no_chart_shows_what_is_the_same_in_every_row(name):
    """Of the charts that nobody has asked for; but rounding that is a line at 0."""
    _, plan = laid(without_charts(template_text(name)))
    for request in chart_requests(plan):
        columns = [plan.nominal[symbol] for symbol in request.y if symbol in plan.nominal]
        there = [column[np.isfinite(column)] for column in columns]
        moves = [np.ptp(column) > 1e-9 * np.abs(column).max() for column in there if len(column)]
        assert not moves or any(moves) or set(request.y) <= plan.only_rounding.keys(), request.y


def without_charts(text):
    """The description without its own charts."""
    return re.sub(r"(?ms)^\[\[charts\]\]\n.*?(?=^\[|\Z)", "", text)


def test_an_effort_that_is_the_same_in_every_row_has_no_chart():
    load = '[[loads]]\nname = "M"\nlink = "crank"\ntorque = "{}"\n'
    assert not requested("[0, 0]", load.format("5"))[1]
    assert not requested("[0, 0]")[1]
    assert requested("[0, 0]", load.format("5*theta12"))[1]

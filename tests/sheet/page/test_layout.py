"""The one sheet: the axis of its charts, and what stands beside the position."""

import math
from dataclasses import replace

import pytest

from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.dynamics.solve import solve
from mechsheet.sheet.cells import height_of
from mechsheet.sheet.drawing.charts import driver_axis
from mechsheet.sheet.page.layout import AXIS_STEPS, lay_out_page
from mechsheet.sheet.plan import UNIT, VALUE, VERDICT_ROW


@pytest.fixture(scope="module")
def laid():
    mechanism = loads(template_text("four-bar"))
    return lay_out_page(mechanism, solve(mechanism))


@pytest.mark.parametrize(("start", "stop", "step", "ends"), [
    (0, 360, 45, (0, 360)), (-180, 180, 45, (-180, 180)), (-30, -114, 15, (-120, -30)), (20, 36, 2, (20, 36)),
    (30, 30, None, (None, None)),
])  # fmt: skip
def test_grid_lines_of_the_drivers_axis(laid, start, stop, step, ends):
    """At most eight of them, however the sweep lies; the axis ends with it: Excel's own ended at 405 degrees."""
    plan = replace(laid[1], driver=[math.radians(start), math.radians(stop)])
    axis = driver_axis(plan, "theta12", steps=AXIS_STEPS)
    assert (axis.title, axis.step, (axis.low, axis.high)) == ("θ₁₂ [°]", step, ends)
    assert driver_axis(plan, "theta14", steps=AXIS_STEPS).step is None


@pytest.mark.parametrize("language", ["en", "tr"])
@pytest.mark.parametrize(("name", "lines"), [("four-bar", 2), ("slider-crank", 2), ("fivelink", 3)])
def test_the_line_under_the_title_has_room(name, lines, language):
    """Of the text's pages two lines, which print on one sheet of paper; that of the five-link was cut in its third."""
    mechanism = loads(template_text(name), "x.toml", Overrides(layout="page", language=language))
    sheet = lay_out_page(mechanism, solve(mechanism))[0].sheets[0]
    assert dict(sheet.row_heights)[VERDICT_ROW] == height_of(lines)


def test_the_axis_of_a_page_ends_with_the_turn(laid):
    axis = laid[0].sheets[0].charts[-1].x_axis
    assert (axis.low, axis.high, axis.step) == (0, 360, 45)


def test_bar_and_button_move_the_position_from_the_first_row_to_the_last(laid):
    """The button stands behind the position's cell, in its row; both write into that cell."""
    workbook, plan = laid
    row = plan.blocks["position"].rows["position"]
    bar, button = workbook.sheets[0].controls
    for control in (bar, button):
        assert (control.linked_row, control.linked_col) == (row, VALUE)
        assert (control.low, control.high, control.step) == (0, 24, 1)
    assert (bar.kind, button.kind) == ("scroll", "spin")
    assert (button.anchor.row, button.anchor.col) == (row, UNIT)
    assert bar.page == 2


@pytest.mark.parametrize("name", ["four-bar", "fivelink"])
def test_the_scroll_bar_stands_just_below_the_drawing(name):
    """It covered the length of the drawing's scale, or stood apart where rows above it had two lines."""
    mechanism = loads(template_text(name), "x.toml", Overrides(layout="page"))
    sheet = lay_out_page(mechanism, solve(mechanism))[0].sheets[0]
    heights = dict(sheet.row_heights)

    def top(anchor):
        return sum(int(heights[row]) for row in range(anchor.row)) + anchor.dy

    drawing, bar = sheet.charts[0].anchor, sheet.controls[0].anchor
    assert 0 <= top(bar) - (top(drawing) + drawing.height) <= 10

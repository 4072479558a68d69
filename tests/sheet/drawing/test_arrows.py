"""Velocities, accelerations and forces as a person sees them: arrows in the drawing, hodographs."""

import numpy as np
import pytest
from laid import Laid

from in_line import IN_LINE
from livesheet.formula.nodes import ErrorValue
from mechsheet import loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechsheetError
from mechsheet.plotting.sampling import sample
from mechsheet.plotting.scenes import Stage
from mechsheet.shapes.forms import BAR_RISE, BAR_ROOM, EDGE, LEAST, room_of_bars
from mechsheet.shapes.loads import COLORS, LONGEST
from mechsheet.sheet.first.mechanism import controls

OUTPUTS = "".join(
    f'{point}_{part} = {{ formula = "C.{part}", unit = "1" }}\n' for point in "C" for part in ("ax", "ay")
)

MOVED = (
    IN_LINE.replace('B = ["l", 0] }', 'B = ["l", 0], C = [80, 40] }\nmass = 0.8\ncenter = [90, 0]\ninertia = 0.003')
    .replace("step = 15", 'step = 60\nspeed = { value = 300, unit = "rpm" }')
    .replace('points = { B = [0, 0] }', 'points = { B = [0, 0] }\nmass = 0.5')
    + f'[[charts]]\nhodographs = ["C"]\n[outputs]\n{OUTPUTS}'
)  # fmt: skip


@pytest.mark.parametrize(
    ("kinds", "room"), [(0, BAR_ROOM), (1, BAR_ROOM), (2, BAR_ROOM + BAR_RISE), (3, BAR_ROOM + 2 * BAR_RISE)]
)
def test_room_below_the_drawing(kinds, room):
    """The bar of lengths stands in `BAR_ROOM`, that of a kind of arrows beside it, each further one above the last."""
    assert room_of_bars(kinds) == pytest.approx(room)


@pytest.fixture(scope="module")
def laid():
    return Laid(MOVED)


def named(laid, chart, name):
    """The series of a chart with that name that has a line, as numbers: (n, 2)."""
    return places(laid, next(each for each in chart.series if each.name == name and each.line))


def places(laid, series):
    """A series as numbers: (n, 2)."""
    columns = []
    for ref in (series.x, series.y):
        area = ref.area
        cells = [laid.values.get(ref.sheet, row, area.first_col) for row in range(area.first_row, area.last_row + 1)]
        columns.append([cell if isinstance(cell, float) else np.nan for cell in cells])
    return np.array(columns).T


def charts(laid):
    return laid.workbook.sheets[0].charts


@pytest.mark.slow
def test_the_hodograph_is_the_end_of_the_velocity(laid):
    motion = loads(MOVED).solve()
    chart = next(chart for chart in charts(laid) if chart.title == "Hodograph of C")
    assert chart.x_axis == chart.y_axis
    assert chart.inner[2] == chart.inner[3]  # a square with equal axes
    curve, vector = named(laid, chart, "v C"), named(laid, chart, "v_C")
    velocity = np.column_stack([motion["C.vx"], motion["C.vy"]])
    scale = np.ptp(curve[:, 0]) / np.ptp(velocity[:, 0])
    assert (curve - vector[0]) / scale == pytest.approx(velocity, abs=1e-9)
    assert vector[1] == pytest.approx(curve[0])


KINDS = (
    {"v_C": ("C.vx", "C.vy")},
    {"a_C": ("C_ax", "C_ay")},
    {"F₂₃": ("F23.x", "F23.y"), "F₃₄": ("F34.x", "F34.y"), "F₁₂": ("F12.x", "F12.y"), "F₁₄ₙ": (None, "F14.n")},
)


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("speed", [31.0, 2000.0])
def test_arrows_are_true_to_scale_and_stay_in_the_window(laid, speed):
    """The longest arrow of a kind is `LONGEST`, in proportion all others; the window is large enough for every tip."""
    laid.change(speed=speed)
    motion, chart = loads(MOVED.replace("value = 300", f"value = {speed}")).solve(), charts(laid)[0]
    farthest = 0.0
    for kind in KINDS:
        lengths, scales = [], []
        for row in range(laid.plan.rows):
            laid.change(_position=row)
            for name, parts in kind.items():
                arrow = named(laid, chart, name)
                vector = np.array([motion[part][row] if part else 0.0 for part in parts])
                drawn = arrow[1] - arrow[0]
                length = np.hypot(*vector)
                lengths.append(length)
                if np.isfinite(arrow).all():
                    scales.append(np.hypot(*drawn) / length)
                    assert drawn * length == pytest.approx(vector * np.hypot(*drawn), abs=1e-9 * length)
                    assert arrow[2:].mean(axis=0) == pytest.approx(arrow[1], abs=0.05)  # the head is where the tip is
                    farthest = max(farthest, np.max(np.abs(arrow[1])))
        assert scales == pytest.approx([LONGEST / max(lengths)] * len(scales))
        assert len(scales) == sum(length >= LEAST * max(lengths) for length in lengths)
    assert farthest <= EDGE + 1e-9


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("changed", [{}, {"a4": 180.0, "a5": 260.0, "die": 430.0}], ids=["as it is", "ram lower"])
def test_no_scale_bar_lies_on_the_mechanism(changed):
    """Links, supports, the ram and its rail end above the scale bars, whatever the dimensions."""
    press = Laid(template_text("toggle-press")).change(**changed)
    for row in range(0, press.plan.rows, 18):
        press.change(_position=row)
        heights = {}
        for series in charts(press)[0].series:
            if series.line and (series.name == "scale bar" or series.line not in COLORS.values()):
                heights.setdefault(series.name, []).extend(places(press, series)[:, 1])
        bars = np.nanmax(heights.pop("scale bar"))
        assert len(heights) >= 8, list(heights)
        assert {name: height for name, height in heights.items() if np.nanmin(height) < bars + 0.02} == {}, row


@pytest.mark.slow
def test_a_cell_hides_a_kind(laid):
    laid.change(_show_velocity=0)
    chart = charts(laid)[0]
    assert np.isnan(named(laid, chart, "v_C")[1]).all()
    assert np.isfinite(named(laid, chart, "a_C")).all()
    labels = [series.name for series in chart.series if not isinstance(series.name, str)]
    words = [laid.values.get(cell.sheet, cell.row, cell.col) for cell in labels]
    assert not any(isinstance(word, ErrorValue) for word in words)
    assert sum(str(word).endswith("mm/s") for word in words) == 0


@pytest.mark.slow
def test_only_where_there_is_something_to_draw():
    plain = Laid(IN_LINE)
    assert plain.plan.arrows == ()
    assert list(plain.plan.blocks["position"].rows) == ["position", "theta12", "status"]
    with pytest.raises(MechsheetError, match="no velocities of points and no forces"):
        sample(loads(IN_LINE), None, None, least=2, vectors=True)


def test_without_points_the_message_says_whose_velocities_may_be_asked_for():
    moving = IN_LINE.replace("step = 15", "step = 15\nspeed = 10")
    with pytest.raises(MechsheetError) as found:
        sample(loads(moving), None, None, least=2, vectors=True)
    assert 'points = ["A"] in [rates]' in str(found.value)
    mended = sample(loads(moving + '[rates]\npoints = ["A"]\n'), None, None, least=2, vectors=True)
    assert mended.plan.arrows == ("velocity", "acceleration")


@pytest.mark.slow
@pytest.mark.parametrize("vectors", [False, True])
def test_a_picture_has_arrows_when_asked(vectors):
    stage = Stage(sample(loads(MOVED), None, None, least=2, vectors=vectors))
    drawn = {(item.kind, item.name) for item in stage.drawing(0).items if hasattr(item, "name")}
    arrows = {("force", "F₃₄"), ("velocity", "v_C"), ("acceleration", "a_C")}
    assert arrows & drawn == (arrows if vectors else set())


def test_the_speed_has_a_scroll_bar(laid):
    spot = laid.plan.at.spots["speed"]
    control = next(each for each in controls(laid.plan) if each.name == "speed scroll bar")
    assert (control.linked_row, control.linked_col) == (spot.row, spot.col)
    assert (control.low, control.high) == (0, 1000)

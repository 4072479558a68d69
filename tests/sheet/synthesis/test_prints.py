"""The sheet of synthesis on paper: wide enough for its charts, narrow enough to be read; figures name their points."""

import pytest

from livesheet.evaluation import book_of
from livesheet.formula.references import cell_address
from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.library.session import Session
from mechsheet.synthesis.kinds import kind_of
from mechsheet.words.symbols import plain

NAMES = (
    "function-generator",
    "crank-rocker-swing",
    "rigid-body-guidance",
    "quick-return-slider",
    "quick-return-lever",
)
PAPER = 1_050
"""Pixels across A4, landscape, at full size."""
LEGIBLE = 0.75
"""A scale at which 10 points are still 7.5."""
WIDE, PAD = 7, 5
"""Pixels of a character, and of what a column has beside its characters."""


@pytest.fixture(scope="module", params=NAMES)
def laid_out(request):
    compiled = Compiled(loads(template_text(request.param)))
    title = compiled.plan.at.titles["synthesis"]
    return compiled.plan, next(sheet for sheet in compiled.layout.sheets if sheet.title == title)


def pixels(sheet, columns):
    widths = {col: each.width for each in sheet.columns for col in range(each.first, each.last + 1)}
    return sum(widths.get(col, 8.43) * WIDE + PAD for col in columns)


def test_its_print_can_be_read(laid_out):
    _, sheet = laid_out
    area = sheet.print_setup.area
    assert PAPER / pixels(sheet, range(area.last_col + 1)) >= LEGIBLE


def test_charts_stand_in_the_print_and_not_on_each_other(laid_out):
    _, sheet = laid_out
    area = sheet.print_setup.area
    below = 0
    assert sheet.charts
    for chart in sheet.charts:
        at = chart.anchor
        assert pixels(sheet, range(at.col)) + at.dx + at.width <= pixels(sheet, range(area.last_col + 1))
        assert at.dy >= below
        below = at.dy + at.height


def test_each_point_with_a_name_is_named_once(laid_out):
    plan, sheet = laid_out
    figure = sheet.charts[0]
    shown = [series.name.strip() for series in figure.series if series.show_name]
    names = {
        name
        for line in kind_of(plan.mechanism.synthesis).figure(plan.mechanism.synthesis)
        for name, _, _ in line.vertices
        if name
    }
    assert sorted(shown) == sorted(map(plain, names))
    assert {"A₀", "A₁", "B₁", "A₂", "B₂"} <= set(shown)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["crank-rocker-swing", "quick-return-lever"])
def test_the_swing_is_drawn_from_one_dead_centre_to_the_other(name):
    """An arc round the output's pivot that begins and ends where B stands."""
    compiled = Compiled(loads(template_text(name)))
    title = compiled.plan.at.titles["synthesis"]
    figure = next(sheet for sheet in compiled.layout.sheets if sheet.title == title).charts[0]
    session = Session(book_of(compiled.layout))

    def points(series):
        return [
            complex(*(session.get(cell_address(title, row, ref.area.first_col)) for ref in (series.x, series.y)))
            for row in range(series.x.area.first_row, series.x.area.last_row + 1)
        ]

    named = {series.name.strip(): points(series)[0] for series in figure.series if series.show_name}
    way = points(next(series for series in figure.series if series.name == "swing"))
    ends = sorted([way[0], way[-1]], key=lambda point: point.real)
    assert ends == pytest.approx(sorted([named["B₁"], named["B₂"]], key=lambda point: point.real))
    assert [abs(point - named["B₀"]) for point in way] == pytest.approx([abs(way[0] - named["B₀"])] * len(way))


@pytest.mark.parametrize(("lam", "high"), [(3, 10), (10, 10), (16, 20)])
def test_the_solution_is_on_the_chart_over_the_ratio(lam, high):
    text = template_text("crank-rocker-swing").replace("best = true", f"lam = {lam}")
    compiled = Compiled(loads(text))
    sheet = next(each for each in compiled.layout.sheets if each.title == compiled.plan.at.titles["synthesis"])
    assert sheet.charts[1].x_axis.high == high

"""The drawing: its points are the reference's at every position, all in the window, nothing where there is no position."""

import math
from functools import cache

import numpy as np
import pytest
from placed import places_of

from chosen import ALL, LOADED, but, some
from folders import TEMPLATE_NAMES
from livesheet.engine import Live, compile_book
from livesheet.engine.layout import Area
from livesheet.engine.results import Values
from livesheet.evaluation import book_of
from livesheet.formula.nodes import CellRef, ErrorValue
from mechsheet import reference
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.dynamics.solve import solve
from mechsheet.shapes.forms import PLATE
from mechsheet.sheet.drawing.charts import chart_requests
from mechsheet.sheet.drawing.drawing import drawing_of
from mechsheet.sheet.drawing.frames import SAMPLES
from mechsheet.sheet.layout import lay_out
from mechsheet.sheet.plan import STATUS

FOUR_BAR = template_text("four-bar")


class Laid:
    """A mechanism's workbook, its drawing, and the values of its cells at any position."""

    def __init__(self, text):
        self.mechanism = loads(text)
        self.workbook, self.plan = lay_out(self.mechanism, solve(self.mechanism))
        requests = chart_requests(self.plan)
        self.drawing = drawing_of(self.plan, requests)
        self.book = compile_book(book_of(self.workbook))
        self.titles = [sheet.title for sheet in self.workbook.sheets]
        self.live = Live(self.book)

    def at(self, position, **dimensions):
        """Values with the position cell and dimensions (as shown) changed."""
        changes = {"position": float(position)} | dimensions
        places = places_of(self.plan)
        spots = {symbol: places[symbol] for symbol in changes}
        return self.book.evaluate({(spot.sheet, spot.row, spot.col): changes[name] for name, spot in spots.items()})

    def moved_to(self, position):
        """The sheet's values with the position cell changed, until the next call: only what reads that cell is computed."""
        spot = places_of(self.plan)["position"]
        self.live.set((self.titles.index(spot.sheet), spot.row, spot.col), float(position))
        own = self.titles.index(self.drawing.sheet.title)
        self.live.read(Area(own, 0, 0, 1 + max(fill.row + fill.rows for fill in self.drawing.sheet.fills), 99))
        return Values(self.book.layout, self.live.numbers, self.live.codes, self.live.texts, ())

    def series(self, values, series):
        """Points of a series: NaN where a cell holds no number."""
        found = []
        for ref in (series.x, series.y):
            area = ref.area
            cells = [values.get(ref.sheet, row, area.first_col) for row in range(area.first_row, area.last_row + 1)]
            found.append([math.nan if isinstance(cell, ErrorValue) else cell for cell in cells])
        return np.array(found, dtype=float).T


@cache
def template(name):
    return Laid(template_text(name))


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("name", some(TEMPLATE_NAMES, 0, every=13))
def test_points_are_the_references(name):
    laid = template(name)
    truth = reference.solve(laid.mechanism)
    for position in {0, 1, laid.plan.rows // 2, laid.plan.rows - 1}:
        values = laid.moved_to(position)
        for point, cells in laid.drawing.points.items():
            for axis, cell in enumerate((cells.x, cells.y)):
                found = values.get(laid.drawing.sheet.title, cell.row, cell.col)
                assert found == pytest.approx(truth.points[point][position, axis], abs=1e-7 * truth.size), point


@pytest.mark.slow
@pytest.mark.parametrize("name", some(but(TEMPLATE_NAMES, *LOADED), 1, every=13))
def test_everything_lies_in_the_window(name):
    """Points, blocks, supports and names at every fourth position (twelfth outside CI); slots may be cut by the edge,
    and arrows of forces."""
    laid = template(name)
    for position in range(0, laid.plan.rows, 4 if ALL else 12):
        values = laid.moved_to(position)
        for series in laid.drawing.chart.series:
            if "slot" in str(series.name) or "kanal" in str(series.name):
                continue
            places = laid.series(values, series)
            # an arrow too short to be read has no name: nothing but gaps
            assert np.nanmax(np.abs(places), initial=0.0) <= 1.0, (position, series.name)


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "adjustable-pump", "jansen", "inverted-slider-crank", "oldham"])
def test_one_scale_for_both_axes(name):
    """(X - X') / (x - x') is the same for both axes and all points, and stays while the mechanism moves."""
    laid = template(name)
    scales = []
    for position in (0, laid.plan.rows // 3):
        values = laid.at(position)
        title = laid.drawing.sheet.title
        numbers = {
            point: [values.get(title, cell.row, cell.col) for cell in (c.x, c.y, c.chart_x, c.chart_y)]
            for point, c in laid.drawing.points.items()
        }
        first, *others = numbers.values()
        for other in others:
            for own, chart in ((0, 2), (1, 3)):
                if abs(other[own] - first[own]) > 1e-6:
                    scales.append((other[chart] - first[chart]) / (other[own] - first[own]))
    assert scales == pytest.approx([scales[0]] * len(scales), rel=1e-9)


@pytest.mark.slow
def test_window_follows_the_dimensions():
    laid = template("four-bar")
    large = {symbol: 1000.0 * value for symbol, value in _lengths(laid).items()}
    before, after = laid.at(5), laid.at(5, **large)
    for series in laid.drawing.chart.series:
        small_places = laid.series(before, series)
        large_places = laid.series(after, series)
        if series.name != "scale bar":  # mechanism grown a thousandfold: the same picture
            assert large_places == pytest.approx(small_places, abs=1e-9, nan_ok=True)


@pytest.mark.slow
def test_scale_bar_is_one_two_or_five():
    laid = template("four-bar")
    names = [series.name for series in laid.drawing.chart.series]
    bar = laid.drawing.chart.series[names.index("scale bar")]
    label = laid.drawing.chart.series[names.index("scale bar") + 1]
    for factor in (1e-3, 0.3, 1.0, 2.7, 40.0):
        values = laid.at(0, **{symbol: factor * value for symbol, value in _lengths(laid).items()})
        half = _half(laid, values)
        places = laid.series(values, bar)
        length = (places[:, 0].max() - places[:, 0].min()) * half
        mantissa = length / 10 ** math.floor(math.log10(length) + 1e-9)
        assert min(abs(mantissa - digit) for digit in (1, 2, 5)) < 1e-9
        assert 0.2 * half <= length <= 0.5 * half * (1 + 1e-12)
        assert isinstance(label.name, CellRef)
        text = values.get(label.name.sheet, label.name.row, label.name.col)
        assert float(text.removesuffix(" mm")) == pytest.approx(length, rel=1e-9)


def _half(laid, values):
    names = {cell.content: cell.row for cell in reversed(laid.drawing.sheet.cells) if cell.col == 0}
    return values.get(laid.drawing.sheet.title, names["half the side"], 1)


def _lengths(laid):
    return {dim.symbol: dim.value for dim in laid.mechanism.dimensions if dim.unit.kind == "length" and not dim.derived}


@pytest.mark.slow
def test_a_position_that_does_not_exist_draws_nothing():
    """With a longer crank the four-bar does not close everywhere: what is to close vanishes, the crank and the
    supports stay, the caption says why."""
    laid = template("four-bar")
    values = laid.at(12, a2=90.0)
    chart = laid.drawing.chart
    links = list(dict.fromkeys(series for series in chart.series if series.width == PLATE))
    assert [series.name for series in links] == [
        "rocker",
        "coupler",
        "crank",
    ]  # what lies on top is drawn on both sides
    ends = [int(np.isfinite(laid.series(values, series)).all(axis=1).sum()) for series in links]
    assert ends == [1, 2, 2]  # the coupler's outline begins and ends at the crank's pin: one point, and no line
    caption = next(s for s in chart.series if s.label_size == 11.0).name
    assert "does not close" in values.get(caption.sheet, caption.row, caption.col)
    good = laid.at(0)
    assert values.get(caption.sheet, caption.row, caption.col) != good.get(caption.sheet, caption.row, caption.col)
    assert good.get(caption.sheet, caption.row, caption.col) == "θ₁₂ = 0°"


@pytest.mark.slow
def test_paths_leave_gaps():
    """Rows that do not exist are #N/A in the path; the window is that of the rows that do."""
    laid = template("four-bar")
    values = laid.at(0, a2=90.0)
    path = next(s for s in laid.drawing.chart.series if s.x.area.last_row - s.x.area.first_row == laid.plan.rows - 1)
    places = laid.series(values, path)
    said = values.column(laid.plan.table, STATUS, laid.plan.at.first, laid.plan.at.last)
    exists = [words == "ok" for words in said]
    assert 0 < sum(exists) < len(exists)
    assert (np.isfinite(places).all(axis=1) == np.array(exists, dtype=bool)).all()
    assert np.nanmax(np.abs(places)) <= 1.0


@pytest.mark.slow
def test_no_positions_at_all():
    """Nothing closes anywhere: a window round the fixed pins, no error but #N/A."""
    laid = template("four-bar")
    values = laid.at(0, a2=900.0)
    assert np.isfinite(_half(laid, values))
    for series in laid.drawing.chart.series:
        for ref in (series.x, series.y):
            for row in range(ref.area.first_row, ref.area.last_row + 1):
                value = values.get(ref.sheet, row, ref.area.first_col)
                assert isinstance(value, float) or value == ErrorValue("#N/A")


@pytest.mark.slow
@pytest.mark.parametrize(("step", "rows", "drawn"), [("1", 361, 361), ("0.1", 3601, 721), ("0.01", 36001, 721)])
def test_long_tables_are_thinned(step, rows, drawn):
    mechanism = loads(FOUR_BAR.replace("step = 15", f"step = {step}"))
    workbook, plan = lay_out(mechanism, solve(mechanism))
    assert plan.rows == rows
    sheet = workbook.sheet("Drawing")
    assert max(fill.rows for fill in sheet.fills) == drawn <= SAMPLES
    assert len(sheet.cells) < 600 and len(sheet.fills) < 600


@pytest.mark.slow
def test_thinned_paths_end_with_the_last_row():
    text = FOUR_BAR.replace("step = 15", "step = 0.4")
    laid = Laid(text)
    values = laid.at(0)
    path = next(s for s in laid.drawing.chart.series if s.x.area.last_row - s.x.area.first_row > 300)
    places = laid.series(values, path)
    first, last = laid.at(0), laid.at(laid.plan.rows - 1)
    cells = laid.drawing.points["C"]
    for place, there in ((places[0], first), (places[-1], last)):
        expected = [there.get("Drawing", cell.row, cell.col) for cell in (cells.chart_x, cells.chart_y)]
        assert list(place) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize("name", ["four-bar", "slider-crank"])
def test_rings_are_the_pins_and_dots_the_other_points_that_move(name):
    mechanism = loads(template_text(name))
    workbook, _ = lay_out(mechanism, solve(mechanism))
    (drawn,) = (chart for chart in workbook.sheets[0].charts if any(series.marker_size == 9 for series in chart.series))
    rings, dots = (
        {row for each in drawn.series if each.marker and each.marker_size == size
         for row in range(each.x.area.first_row, each.x.area.last_row + 1)}
        for size in (9, 3)
    )  # fmt: skip
    shared = [point for link in mechanism.links for point in link.points]
    assert len(rings) == len({point for point in shared if shared.count(point) > 1})
    assert not rings & dots

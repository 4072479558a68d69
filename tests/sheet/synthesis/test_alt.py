"""Alt's chart: both tables against the reference's golden section, and the task's own row and column live."""

import math

import pytest

from livesheet.evaluation import book_of
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.references import cell_address
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.library.session import Session
from mechsheet.reference.synthesis import crank_rocker
from mechsheet.sheet.synthesis.alt import ACROSS, ANGLES, DOWN, LINE_ROW, RATIOS, SWINGS, TURNS

TEXT = template_text("crank-rocker-swing")
NOTHING = ErrorValue("#N/A")


class Chart:
    """The sheet of a description: its cells, what is typed into the task."""

    def __init__(self, text, language="en"):
        compiled = Compiled(loads(text, overrides=Overrides(language=language)))
        self.spots, self.title = compiled.plan.at.spots, compiled.plan.at.titles["alt"]
        self.session = Session(book_of(compiled.layout))

    def type(self, **values):
        cells = {symbol: self.spots[symbol] for symbol in values}
        self.session.update({cell_address(at.sheet, at.row, at.col): values[symbol] for symbol, at in cells.items()})
        return self

    def at(self, row, col):
        return self.session.get(cell_address(self.title, row, col))

    def own(self):
        """The best mu_min and lam of the task, and the line that says so."""
        return self.at(ANGLES + 1 + DOWN, ACROSS), self.at(RATIOS + 1 + DOWN, ACROSS), self.at(LINE_ROW, 0)


@pytest.fixture(scope="module")
def chart():
    return Chart(TEXT)


def best(psi, phi):
    """By the reference: mu_min in degrees, and lam; None where there is none."""
    found = crank_rocker.best(math.radians(psi), math.radians(phi), 1.0)
    return (math.degrees(found.mu_min), found.lam) if math.isfinite(found.mu_min) else None


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize(("row", "phi"), enumerate(TURNS, 1))
def test_every_cell_is_the_best_that_the_reference_finds(chart, row, phi):
    """To 1e-9 degrees; lam to what a golden section of a flat top can tell."""
    for col, psi in enumerate(SWINGS, 1):
        angle, ratio = (chart.at(first + 1 + row, col) for first in (ANGLES, RATIOS))
        expected = best(psi, phi) if 90 + psi / 2 < phi < 270 + psi / 2 else None
        if expected is None:
            assert (angle, ratio) == (NOTHING, NOTHING), psi
        else:
            assert angle == pytest.approx(expected[0], abs=1e-9), psi
            assert ratio == pytest.approx(expected[1], rel=1e-8), psi


@pytest.mark.slow
def test_there_are_best_ones_but_for_equal_times(chart):
    empty = {
        (SWINGS[col - 1], phi)
        for row, phi in enumerate(TURNS, 1)
        for col in range(1, len(SWINGS) + 1)
        if chart.at(ANGLES + 1 + row, col) == NOTHING
    }
    assert empty == {(120, 150), *((psi, 180) for psi in SWINGS)}


@pytest.mark.cases(6)
@pytest.mark.parametrize(
    ("psi", "time_ratio"), [(80, 1.1111), (25.5, 1.4), (110, 0.9), (140, 1.25), (5, 0.8), (150, 1.9), (33, 1.02)]
)
def test_the_corner_is_the_task_as_it_is_typed(chart, psi, time_ratio):
    chart.type(psi=psi, time_ratio=time_ratio)
    angle, ratio, line = chart.own()
    expected = best(psi, 180 + 180 * (time_ratio - 1) / (time_ratio + 1))
    assert angle == pytest.approx(expected[0], abs=1e-9)
    assert ratio == pytest.approx(expected[1], rel=1e-8)
    assert f"{round(angle, 2):g}°" in line
    assert chart.session.get(cell_address(*place(chart, "mu_min"))) == pytest.approx(angle, abs=1e-9)


def place(chart, symbol):
    spot = chart.spots[symbol]
    return spot.sheet, spot.row, spot.col


@pytest.mark.parametrize(("psi", "time_ratio"), [(80, 1), (170, 0.5), (200, 1.1), (0, 1.1), (80, -1)])
def test_a_task_without_a_best_has_none_in_the_corner(chart, psi, time_ratio):
    chart.type(psi=psi, time_ratio=time_ratio)
    angle, ratio, line = chart.own()
    assert (angle, ratio) == (NOTHING, NOTHING)
    assert line == "no best λ for the swing ψ and the turn φ of this task"
    assert chart.at(ANGLES + 2, 1) == pytest.approx(best(10, 150)[0], abs=1e-9)


@pytest.mark.slow
def test_a_chosen_ratio_is_no_better_than_the_best():
    """And in Turkish, with radians: the chart stays in degrees."""
    chosen = TEXT.replace("best = true", "lam = 4.0").replace("psi = 80", f"psi = {math.radians(80)!r}")
    in_radians = chosen.replace("stop = 360", "stop = 6.25").replace("step = 10", "step = 0.25")
    chart = Chart(in_radians.replace("[mechanism]", '[mechanism]\nangle_unit = "rad"'), "tr")
    angle, _, line = chart.own()
    chosen = math.degrees(crank_rocker.by_lam(math.radians(80), crank_rocker.crank_turn(1.1111), 120, 4.0).mu_min)
    assert chosen < angle - 1
    assert line.endswith(f"bu mekanizma: {round(chosen, 2):g}°")
    assert angle == pytest.approx(best(80, math.degrees(crank_rocker.crank_turn(1.1111)))[0], abs=1e-9)


def test_the_curves_are_those_of_the_table_the_task_s_and_the_mechanism_s():
    compiled = Compiled(loads(TEXT))
    sheet = next(sheet for sheet in compiled.layout.sheets if sheet.title == compiled.plan.at.titles["alt"])
    (drawn,) = sheet.charts
    turns = [phi for phi in TURNS if phi != 180]
    assert [series.name for series in drawn.series[: len(turns)]] == [f"φ = {phi}°" for phi in turns]
    assert len(drawn.series) == len(turns) + 2
    rows = [series.y.area.first_row for series in drawn.series[:-1]]
    assert rows == [ANGLES + 2 + TURNS.index(phi) for phi in turns] + [ANGLES + 1 + DOWN]
    assert all(series.x.area.first_row == ANGLES + 1 for series in drawn.series[:-1])

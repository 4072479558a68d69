"""The sheet of velocities and accelerations, its words and its inputs, as a person meets them."""

import re

import numpy as np
import pytest
from laid import Laid

from livesheet.evaluation import book_of
from livesheet.formats import read
from livesheet.formula.nodes import Call, CellRef, ErrorValue, Number, transform, walk
from livesheet.formula.printer import print_formula
from livesheet.workbook import Rich
from mechsheet import loads
from mechsheet.checking import check
from mechsheet.checking.against_reference import against_plan
from mechsheet.compiled import Compiled
from mechsheet.description.templates import template_text
from mechsheet.library.building import build
from mechsheet.sheet.table.positions import GROUP_ROW

NA = ErrorValue("#N/A")


def with_speed(name, speed="10", more=""):
    text = re.sub(r"(?m)^(layout|speed) *=.*$", "", template_text(name))
    return re.sub(r"(?m)^\[driver\]", f"[driver]\nspeed = {speed}", text) + more


FOUR_BAR = with_speed("four-bar", '{ value = 60, unit = "rpm" }')

TOGGLE = """
format = 1
[mechanism]
name = "kite"
[dimensions]
a1 = 80
a2 = 35
a3 = 80
[links.ground]
points = { A0 = [0, 0], B0 = ["a1", 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.coupler]
points = { A = [0, 0], B = ["a3", 0] }
[links.rocker]
points = { B0 = [0, 0], B = ["a2", 0] }
[driver]
link = "crank"
start = 150
stop = 180
step = 10
speed = 4
[assembly]
B = [50, 20]
"""


def texts(sheet):
    return [cell.content.plain if isinstance(cell.content, Rich) else cell.content for cell in sheet.cells]


@pytest.mark.slow
def test_the_sheet_stands_behind_the_positions_with_their_rows():
    laid = Laid(FOUR_BAR)
    titles = [sheet.title for sheet in laid.workbook.sheets]
    assert titles[1:3] == ["Positions", "Rates"]
    sheet = laid.workbook.sheet("Rates")
    symbols = [column.symbol for column in laid.plan.rates]
    assert symbols == [
        "D", "theta13.d", "theta14.d", "k_x", "k_y", "theta13.dd", "theta14.dd",
        "omega13", "alpha13", "omega14", "alpha14", "C.x.d", "C.y.d", "C.x.dd", "C.y.dd", "C.v", "C.a",
    ]  # fmt: skip
    folded = {column.first for column in sheet.columns if column.level}
    assert folded == {column.col for column in laid.plan.rates if column.inner}
    assert [laid.values.get("Rates", laid.plan.at.first + row, 0) for row in (0, 1)] == [0.0, 15.0]
    assert laid.column("rates") == ["ok"] * 25
    assert {"Velocity and acceleration", "θ′13", "ω13 [rad/s]", "α14 [rad/s²]", "vC [mm/s]"} <= set(texts(sheet))


@pytest.mark.slow
def test_headings_stand_over_the_columns_of_their_group():
    """Each across all of its columns and no others; the sheet's own over the driver and the word about the row."""
    laid = Laid(FOUR_BAR)
    sheet = laid.workbook.sheet("Rates")
    columns = {0: "own", 1: "own"} | {column.col: column.group for column in laid.plan.rates}
    groups = [[col for col in columns if columns[col] == group] for group in dict.fromkeys(columns.values())]
    heads = {cell.col: bool(cell.content) for cell in sheet.cells if cell.row == GROUP_ROW}
    assert heads == {col: col == group[0] for group in groups for col in group}
    merged = sorted((merge.area.first_col, merge.area.last_col) for merge in sheet.merges)
    assert merged == [(group[0], group[-1]) for group in groups if len(group) > 1]


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "inverted-slider-crank", "oldham", "six-link-dwell"])
def test_formulas_can_be_read(name):
    sheet = Laid(with_speed(name)).workbook.sheets[2]
    for fill in sheet.fills:
        assert len(print_formula(fill.formula, "excel")) <= 130
        assert sum(isinstance(part, Call) and part.name == "IF" for part in walk(fill.formula)) <= 1


@pytest.mark.slow
def test_speed_is_typed_in_its_own_unit():
    laid = Laid(FOUR_BAR)
    before = np.array(laid.column("omega14")), np.array(laid.column("alpha14"))
    assert laid.spot("omega12") == pytest.approx(2 * np.pi)
    laid.change(speed=120)
    assert np.array(laid.column("omega14")) == pytest.approx(2 * before[0])
    assert np.array(laid.column("alpha14")) == pytest.approx(4 * before[1], abs=1e-10)
    names = {name.name for name in laid.workbook.names}
    assert {"speed", "omega12", "alpha12", "velocities_fit", "dead_centres"} <= names


@pytest.mark.slow
def test_the_position_shown_has_its_rates():
    laid = Laid(with_speed("slider-crank")).change(**{"_position": 3})
    row = laid.plan.blocks["variables"].rows["s14.v"]
    assert laid.values.get(laid.plan.main, row, 1) == laid.column("s14.v")[3]
    titles = [chart.title for chart in laid.workbook.sheets[0].charts]
    assert {"ω₁₃ against θ₁₂", "ṡ₁₄, v_C against θ₁₂"} <= set(titles)


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize(
    ("language", "words"), [("en", "dead centre: coupler, rocker"), ("tr", "ölü konum: biyel, sarkaç")]
)
def test_a_dead_centre_has_words_and_keeps_its_position(language, words):
    laid = Laid(TOGGLE, language)
    assert laid.column("rates")[-2:] == [laid.plan.text("status.ok"), words]
    assert laid.column("omega13")[-1] == NA
    assert isinstance(laid.column("omega13")[-2], float)
    assert isinstance(laid.column("theta13")[-1], float)
    assert laid.column("status")[-1] == laid.plan.text("status.ok")
    assert laid.spot("dead_centres") == 1
    laid.change(a3=10)  # it closes nowhere: the words are those of the positions
    assert laid.column("rates") == laid.column("status")


@pytest.mark.slow
def test_velocities_that_do_not_fit_are_noticed():
    laid = Laid(FOUR_BAR)
    assert laid.spot("velocities_fit") < 1e-12
    assert laid.words("velocities_fit") == "they fit the links: rounding only"
    for symbol, key in (("theta13.d", "velocities_fit"), ("k_x", "accelerations_fit")):
        laid = Laid(FOUR_BAR).damage(
            "Rates", laid.plan.at.spots[symbol].col, lambda formula: Call("SUM", (formula, Number(1e-4)))
        )
        assert laid.words(key).startswith("they do not fit"), symbol


@pytest.mark.slow
def test_extremes_of_rates_are_refined_between_the_rows():
    more = (
        '\n[summary.fastest]\nof = "omega14"\ntake = "max"\n[outputs.gain]\nformula = "omega12/omega14"\nunit = "1"\n'
    )
    coarse = Laid(with_speed("drag-link", "10", more))
    row = coarse.plan.blocks["summary"].rows["fastest"]
    found = coarse.values.get(coarse.plan.main, row, 1)
    fine = load_fine(with_speed("drag-link", "10", more))
    assert found >= max(coarse.column("omega14"))
    assert found == pytest.approx(fine, rel=1e-6)


def load_fine(text):
    return np.nanmax(loads(re.sub(r"(?m)^step = .*$", "step = 0.05", text)).solve()["omega14"])


@pytest.mark.slow
def test_a_speed_by_the_driver_is_a_column():
    laid = Laid(with_speed("four-bar", '"5 + cos(theta12)"'))
    assert "motion" not in laid.plan.blocks
    assert laid.column("omega12") == pytest.approx([5 + np.cos(np.radians(angle)) for angle in laid.column("theta12")])


@pytest.mark.slow
def test_notes_have_the_loop_equations():
    laid = Laid(FOUR_BAR)
    lines = texts(laid.workbook.sheet("Notes"))
    assert "i·a2·ω12·eiθ₁₂ + i·a3·ω13·eiθ₁₃ = i·a4·ω14·eiθ₁₄" in lines
    lines = texts(Laid(with_speed("whitworth")).workbook.sheet("Notes"))
    assert any(isinstance(line, str) and "2·ṡ3·ω13" in line for line in lines)  # Coriolis's term


@pytest.mark.slow
def test_nothing_of_it_without_a_speed():
    laid = Laid(template_text("four-bar"))
    assert not laid.plan.rates
    assert "Rates" not in [sheet.title for sheet in laid.workbook.sheets]


@pytest.mark.slow
def test_both_formats_and_the_reference_agree(tmp_path):
    text = TOGGLE + '[outputs.ratio]\nformula = "omega14/omega12 + B.vx"\nunit = "1"\n'
    paths = build(loads(text), tmp_path, ["xlsx", "ods"])
    for path in paths:
        report = check(path)
        assert report.agrees, report
        assert max(judged.worst for judged in report.comparisons if judged.judge != "search") < 1e-11
    books = [read(path) for path in paths]
    assert [len(book.sheets) for book in books] == [len(books[0].sheets)] * 2


@pytest.mark.slow
def test_the_reference_notices_any_damaged_rate():
    laid = Laid(FOUR_BAR)
    book = book_of(laid.workbook)
    assert against_plan(book, laid.values, laid.plan, "one")[0].agrees
    for symbol in ("omega13", "C.a"):
        laid = Laid(FOUR_BAR).damage(
            "Rates", laid.plan.at.spots[symbol].col, lambda formula: Call("SUM", (formula, Number(1e-4)))
        )
        assert not against_plan(book, laid.values, laid.plan, "one")[0].agrees, symbol


def test_what_the_library_gives():
    motion = loads(TOGGLE).solve()
    assert motion.units["omega13"] == "rad/s"
    assert np.isnan(motion["omega13"][-1])
    assert motion.exists.all()  # at the dead centre there is a position
    assert "theta13.d" not in list(motion) and np.isfinite(
        motion["theta13.d"][0]
    )  # not shown, and there when asked for
    assert Compiled(loads(TOGGLE)).mechanism.driver_rates == ("omega12", "alpha12")


def test_references_are_to_cells_of_the_same_row():
    """Filled down by hand, a row reads its own positions."""
    laid = Laid(FOUR_BAR)
    first = laid.plan.at.first
    for fill in laid.workbook.sheet("Rates").fills:
        rows = []
        transform(fill.formula, lambda part, rows=rows: rows.append(part.row) or part
                  if isinstance(part, CellRef) and not part.row_abs else part)  # fmt: skip
        assert set(rows) <= {first}

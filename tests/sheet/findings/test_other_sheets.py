"""A person deletes a sheet: the first one says which, and has no error but #N/A; what does not need the sheet stays."""

from dataclasses import replace

import pytest
from laid import Laid

from chosen import some
from folders import TEMPLATE_NAMES
from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from livesheet.formula.nodes import CellRef, ErrorValue, NameRef, RangeRef, transform
from mechsheet.description.templates import template_text
from mechsheet.model import ENERGY
from mechsheet.sheet.plan import MAY_GO, MEANING, RATES_STATUS, VALUE


def without(laid, title):
    """The values of the workbook after the sheet was deleted: what read it reads #REF!."""
    gone = {name.name for name in laid.workbook.names if name.sheet == title}

    def change(part):
        match part:
            case RangeRef(CellRef(sheet=own), _) | CellRef(sheet=own) if own == title:
                return ErrorValue("#REF!")
            case RangeRef(ErrorValue(), _):
                return ErrorValue("#REF!")
            case NameRef(name) if name in gone:
                return ErrorValue("#REF!")
        return part

    sheets = tuple(
        replace(sheet, fills=tuple(replace(fill, formula=transform(fill.formula, change)) for fill in sheet.fills))
        for sheet in laid.workbook.sheets
        if sheet.title != title
    )
    names = tuple(name for name in laid.workbook.names if name.name not in gone)
    return evaluate(book_of(replace(laid.workbook, sheets=sheets, names=names)))


def changed_in_silence(laid, shown, place):
    """Whether a result is another number now, and the words beside it do not say that they are of something else."""
    plan, (row, col) = laid.plan, place
    tells = {spot.row for spot in plan.places.sheets.values()} | {plan.places.lines["sheets"].row}
    was, now = laid.values.get(plan.main, row, col), shown[place]
    if col != VALUE or row in tells or not isinstance(now, float) or now == was:
        return False
    return shown.get((row, MEANING)) == laid.values.get(plan.main, row, MEANING)


@pytest.mark.slow
@pytest.mark.cases(3)
@pytest.mark.parametrize("language", ["en", "tr"])
@pytest.mark.parametrize("name", some(TEMPLATE_NAMES, 8))
def test_a_deleted_sheet_leaves_no_error_on_the_first(name, language):
    laid = Laid(template_text(name), language)
    plan, first = laid.plan, laid.workbook.sheets[0]
    for key in (*MAY_GO, "notes", "drawing", "description"):
        if key not in plan.at.titles:
            continue
        title = plan.at.titles[key]
        values = without(laid, title)
        shown = {(fill.row, fill.col): values.get(plan.main, fill.row, fill.col) for fill in first.fills}
        wrong = {place: said for place, said in shown.items() if isinstance(said, ErrorValue) and said.code != "#N/A"}
        assert wrong == {}, title
        assert [place for place in shown if changed_in_silence(laid, shown, place)] == [], title
        marked = shown[plan.places.lines["inputs"].row, MEANING + 1]
        assert marked == laid.values.get(plan.main, plan.places.lines["inputs"].row, MEANING + 1), title
        line = shown[plan.places.verdict.row, plan.places.verdict.col]
        if key not in MAY_GO:
            assert line == laid.verdict
            continue
        assert plan.text("verdict.sheets.deleted", sheet=title) in line
        for table, reads in (("forces", {"rates"}), ("tolerance", {"rates", "checks", "extremes"})):
            if table in plan.at.titles and key in reads:
                assert plan.at.titles[table] in line
        if key not in ("synthesis", "iterations"):
            assert values.get(plan.main, plan.places.closed.row, plan.places.closed.col) == laid.spot("rows_closed")


GAIN = """
[outputs]
gain = { formula = "omega14/omega12", label = { en = "gain", tr = "oran" } }
"""


def errors(laid, values, title):
    """The errors that a sheet shows, each once."""
    sheet = next(sheet for sheet in laid.workbook.sheets if sheet.title == title)
    shown = {values.get(title, row, fill.col) for fill in sheet.fills for row in range(fill.row, fill.row + fill.rows)}
    return {value.code for value in shown if isinstance(value, ErrorValue)}


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar-forces", "shaper"])
def test_charts_have_gaps_and_forces_say_why(name):
    """Excel draws any error but #N/A as 0: arrows would point to a corner of the drawing."""
    laid = Laid(template_text(name), "en")
    plan = laid.plan
    for key in ("rates", "forces", "checks", "extremes"):
        assert errors(laid, without(laid, plan.at.titles[key]), plan.at.titles["drawing"]) <= {"#N/A"}, key
    alone, forces = without(laid, plan.at.titles["rates"]), plan.at.titles["forces"]
    said = {alone.get(forces, row, RATES_STATUS) for row in range(plan.at.first, plan.at.last + 1)}
    assert said == {"sheet Rates was deleted; Forces needs it"}


@pytest.mark.slow
def test_an_output_that_reads_a_deleted_sheet_is_not_there():
    laid = Laid(template_text("four-bar-forces") + GAIN, "en")
    plan, spot = laid.plan, laid.plan.at.spots["gain"]
    for key, there in (("rates", False), ("forces", True), ("checks", True)):
        values = without(laid, plan.at.titles[key])
        found = [values.get(spot.sheet, row, spot.col) for row in range(plan.at.first, plan.at.last + 1)]
        assert all(isinstance(value, float) for value in found) if there else set(found) == {ErrorValue("#N/A")}, key


@pytest.mark.slow
def test_the_flywheels_energy_is_not_there_without_its_mean():
    """Its column read an empty text, and was #VALUE! in every row."""
    laid = Laid(template_text("engine"), "en")
    plan, spot = laid.plan, laid.plan.at.spots[ENERGY]
    for key in ("checks", "extremes"):
        values = without(laid, plan.at.titles[key])
        found = {values.get(spot.sheet, row, spot.col) for row in range(plan.at.first, plan.at.last + 1)}
        assert found == {ErrorValue("#N/A")}, key

"""A person deletes a sheet: the first one says which, and has no error but #N/A; what does not need the sheet stays."""

from dataclasses import replace

import pytest
from laid import TEMPLATES, Laid, template_text

from chosen import some
from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from livesheet.formula.nodes import CellRef, ErrorValue, NameRef, RangeRef, transform
from mechsheet.sheet.plan import MAY_GO


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


@pytest.mark.parametrize("language", ["en", "tr"])
@pytest.mark.parametrize("name", some(TEMPLATES, 8))
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
        line = shown[plan.places.verdict.row, plan.places.verdict.col]
        if key not in MAY_GO:
            assert line == laid.verdict
            continue
        assert line.endswith(plan.text("verdict.sheets.deleted", sheet=title))
        if key not in ("synthesis", "iterations"):
            assert values.get(plan.main, plan.places.closed.row, plan.places.closed.col) == laid.spot("rows_closed")

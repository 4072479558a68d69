"""Beside each equation *Notes* has the formula of the cell that it names, as text."""

import pytest
from laid import Laid

from livesheet.formula.printer import print_formula
from mechsheet.description.templates import template_text
from mechsheet.sheet.notes import FORMULA, PLACE


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("name", ["four-bar", "four-bar-forces", "fivelink"])
def test_the_formula_is_that_of_the_cell(name):
    laid = Laid(template_text(name))
    sheets = {sheet.title: sheet for sheet in laid.workbook.sheets}
    notes = sheets[laid.plan.at.titles["notes"]]
    places = {cell.row: cell.content for cell in notes.cells if cell.col == PLACE and isinstance(cell.content, str)}
    texts = {cell.row: cell.content for cell in notes.cells if cell.col == FORMULA}
    said = [row for row in texts if texts[row].startswith("=")]
    assert len(said) > 15
    for row in said:
        title, _, place = places[row].rpartition(" ")
        written = {f"={print_formula(fill.formula)}" for fill in sheets[title].fills if address(fill, place)}
        assert texts[row] in written, (row, places[row])


def address(fill, place):
    """Whether a fill begins in that column, or in that cell."""
    letters = place.rstrip("0123456789")
    col = 0
    for letter in letters:
        col = 26 * col + ord(letter) - ord("A") + 1
    return fill.col == col - 1 and place[len(letters) :] in ("", str(fill.row + 1))


def test_the_column_is_not_printed():
    laid = Laid(template_text("four-bar"))
    (notes,) = (sheet for sheet in laid.workbook.sheets if sheet.title == laid.plan.at.titles["notes"])
    assert notes.print_setup.area.last_col == PLACE < FORMULA

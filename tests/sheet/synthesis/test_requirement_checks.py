"""Does it do it? What is said where there is no solution, and from when on a length is not known well."""

import pytest
from planned import planned

from livesheet.formula.nodes import CellRef
from livesheet.formula.printer import print_formula
from mechsheet.description.templates import template_text
from mechsheet.sheet.synthesis.page import Page
from mechsheet.sheet.synthesis.requirement_checks import DOUBT, YES, Does
from mechsheet.sheet.task_rows import INPUTS, ROUNDED, UNSOLVED, USED, VALUE


@pytest.fixture(scope="module")
def written():
    """Rows of verdicts, and the formulas by cell."""
    plan = planned(template_text("quick-return-slider"))
    page = Page(plan, plan.mechanism.synthesis, plan.synthesis)
    Does(page).write()
    rows = {key: row for (block, key), row in plan.synthesis.of.items() if block == "does"}
    return rows, {(fill.row, fill.col): print_formula(fill.formula) for fill in page.fills}


def test_without_a_solution_nothing_is_said_of_the_mechanism(written):
    """Only whether the inputs can be, and why there is no solution: the other lines would speak of no mechanism."""
    rows, formulas = written
    silent = {key for key, row in rows.items() if formulas[row, USED].startswith('IF(unsolved>0,"–",IFERROR(')}
    assert silent == set(rows) - {INPUTS, UNSOLVED} != set()


def test_a_length_that_changes_by_more_than_5_percent_is_a_doubt(written):
    rows, formulas = written
    row = rows["sensitivity"]
    cell = print_formula(CellRef(row, VALUE, True, True))
    assert f'IF(IFERROR({cell}>5,FALSE),"{DOUBT}","{YES}")' in formulas[row, ROUNDED]

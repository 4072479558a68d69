"""The table of positions against the reference, for what is typed into the cells."""

import pytest
from laid import Laid

from livesheet.evaluation import book_of
from mechsheet.checking.against_reference import against_plan
from mechsheet.description.templates import template_text

pytestmark = pytest.mark.slow


@pytest.mark.cases(1)
@pytest.mark.parametrize("mode", [1, -1])
def test_a_rack_keeps_the_turns_that_the_workbook_began_with(mode):
    """Assembled the other way the rocker is a turn further on by the formulas, and the rack with it."""
    laid = Laid(template_text("rack-slider"))
    laid.change(mode_1=mode)
    comparison, _ = against_plan(book_of(laid.workbook), laid.values, laid.plan, "rack-slider")
    assert comparison.agrees, comparison

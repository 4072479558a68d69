"""Other programs' values are held against the engine's cell by cell, but for those that a search in the sheet decides."""

import math
from pathlib import Path

import pytest
from laid import Laid
from test_summary_table import built, evaluated

from livesheet.evaluation import book_of
from livesheet.formula.nodes import ErrorValue
from mechsheet.checking.against_search import ExpectedSummary
from mechsheet.checking.cells import UNMOVED, Astray, Searched, compare_program
from mechsheet.compiled import Compiled
from mechsheet.description import load
from mechsheet.description.templates import template_text
from mechsheet.sheet.asked.requested import tables_of
from mechsheet.sheet.asked.two_way import FIRST
from mechsheet.sheet.table.tolerance import lines_of

HOEKEN = Path(__file__).parents[2] / "templates/hoeken.toml"


@pytest.fixture(scope="module")
def plan():
    return Compiled(load(HOEKEN)).plan


def test_the_band_of_an_extreme_is_not_compared_digit_by_digit_on_any_sheet(plan):
    searched = Searched(plan, UNMOVED)
    lines = lines_of(plan)
    kinds = {}
    for line in lines:
        below = searched.compared(plan.at.titles["tolerance"], line.row)
        kinds[line.kind] = below
        if line.kind == "shown":
            continue
        row = plan.blocks["bands"].rows[line.summary.symbol if line.summary else line.quantity]
        assert searched.compared(plan.main, row) == below
    assert kinds == {"shown": "value", "largest": "value", "summary": "error"}


@pytest.mark.slow
def test_passes_of_a_row_that_does_not_close_are_nobodys():
    """There Newton's method leaps about; that no position follows is compared all the same."""
    text = template_text("planar-3rpr").replace("stop = 7\nstep = 0.2", "stop = 10\nstep = 0.5")
    laid = Laid(text)
    plan, values, title = laid.plan, laid.values, laid.plan.at.titles["iterations"]
    open_row = laid.exists.index(False) + plan.at.first
    last = plan.iterations[-1].col  # whether it fits, beside the residual
    astray = Astray(plan, values, UNMOVED).cells
    assert {row for _, row, _ in astray} == {row for row, there in enumerate(laid.exists, plan.at.first) if not there}
    spots = [plan.at.spots[symbol] for symbol in ("residual", "det")]  # where Positions shows what the last pass has
    assert {(spot.sheet, open_row, spot.col) for spot in spots} <= astray
    divisor = plan.at.spots["D"]  # of velocities: there it is no number, as what is divided by it
    assert values.get(divisor.sheet, open_row, divisor.col) == ErrorValue("#N/A")

    def agrees(row, col):
        def theirs(sheet, *place):
            return 0.123 if (sheet, *place) == (title, row, col) else values.get(sheet, *place)

        return compare_program("other", book_of(laid.workbook), values, theirs, plan, "x").agrees

    assert agrees(open_row, last - 1)
    assert not agrees(open_row, last)
    assert not agrees(plan.at.first, last - 1)


@pytest.mark.slow
def test_a_tables_angle_is_known_up_to_a_turn_until_it_goes_on_from_the_cell_above():
    """At 180 degrees of the crank a rounding error decides whether the rocker stands at half a turn or at minus that."""
    compiled, _ = built()
    plan, values = evaluated()
    (table,) = (table for table in tables_of(plan) if table.title == "Table swing")
    raw, row = table.helpers.found.columns_of_raw_angles[0], FIRST + 9

    def agrees(col, apart):
        def theirs(sheet, *place):
            own = values.get(sheet, *place)
            return own + apart if (sheet, *place) == (table.title, row, col) else own

        return compare_program("other", book_of(compiled.layout), values, theirs, plan, "x").agrees

    assert agrees(raw, -math.tau)
    assert not agrees(raw, 0.1)
    assert not agrees(table.at, -math.tau)


def test_no_number_where_an_angle_is_expected():
    """A program that has an error there has a wrong value; it is not asked by how many turns."""
    assert ExpectedSummary(1.0, 1.0, 1.0, 0.0, 360.0, True, True).apart(math.nan, True) == math.inf

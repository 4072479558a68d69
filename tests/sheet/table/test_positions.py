"""Columns of the table of positions: each in its own place, from the first row to the last."""

from collections import defaultdict

import pytest
from placed import places_of
from planned import planned

from livesheet.formula.printer import print_formula
from mechsheet.description.templates import template_text
from mechsheet.sheet.table.positions import column_fills

FIRST = 30
"""A row that is no column."""

SWEEP = "start = 0\nstop = 360\nstep = 15\n"
LAW = 'start = 20\nstop = 200\nmotion = { law = "cycloidal", duration = 3, rows = 7 }\n'


@pytest.mark.parametrize(("law", "rows"), [(False, 25), (True, 7)])
def test_every_column_is_filled_from_the_first_row_to_the_last(law, rows):
    """Also the times of a motion law: in another column or row they would be read as something else."""
    plan = planned(template_text("four-bar").replace(SWEEP, LAW if law else SWEEP))
    assert [column.col for column in plan.columns] == list(range(len(plan.columns)))
    written = {}
    for column in plan.columns:
        filled = defaultdict(list)
        for fill in column_fills(plan, column, plan.table, FIRST, rows):
            filled[fill.col] += range(fill.row, fill.row + fill.rows)
            written.setdefault(column.symbol, print_formula(fill.formula))
        assert filled == {column.col: list(range(FIRST, FIRST + rows))}, column.symbol
    start, step, duration = (
        print_formula(places_of(plan)[symbol].cell) if symbol in places_of(plan) else ""
        for symbol in ("start", "step", "duration")
    )
    assert law or written["theta12"] == f"{start}+$A31*{step}"
    assert written.get("t") == (f"$A31*{duration}/6" if law else None)

"""Other programs' values are held against the engine's cell by cell, but for those that a search in the sheet decides."""

from pathlib import Path

import pytest

from mechsheet.checking.searched.probed_cells import UNMOVED, Searched
from mechsheet.compiled import Compiled
from mechsheet.description import load
from mechsheet.sheet.table.tolerance import lines_of

HOEKEN = Path(__file__).parents[3] / "templates/hoeken.toml"


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

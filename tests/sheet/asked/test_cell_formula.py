"""Where the angles of a two-way table begin when no row of the table of positions exists: as they are described."""

import math

import pytest
from planned import planned

from mechsheet.description.templates import template_text
from mechsheet.sheet.asked.cell_formula import Blocks, CellFormula
from mechsheet.sheet.checks.extremes import Extremes


@pytest.mark.parametrize("start", [0, 170])
def test_links_that_turn_on_begin_within_half_a_turn_of_their_angles(start):
    """Those of a drag link turn with its crank, from wherever the sweep begins: half a turn off, and a column would show
    another turn than the table of positions."""
    sweep = f"start = {start}\nstop = {start + 360}\n"
    plan = planned(template_text("drag-link").replace("start = 0\nstop = 360\n", sweep))
    Extremes(plan)
    for symbol in ("theta13", "theta14"):
        found = CellFormula(plan, "Table", symbol, {}, Blocks(8, 7, 0, 10, 1))
        assert found.windows[symbol].slope == 1
        otherwise, described = found.start(symbol).args
        assert abs(described.value - plan.nominal[symbol][0]) < math.pi / 2
        assert otherwise != described

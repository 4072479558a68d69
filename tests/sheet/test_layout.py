"""The sheets of a workbook are laid out before any formula is written: in which order they are asked does not matter."""

from collections import Counter
from itertools import permutations

import pytest
from placed import places_of

from chosen import some
from livesheet.formula.nodes import CellRef, Symbol, walk
from mechsheet.description import loads
from mechsheet.description.templates import template_names, template_text
from mechsheet.dynamics.solve import solve
from mechsheet.sheet import layout
from mechsheet.sheet.planning import plan_of


@pytest.mark.slow
@pytest.mark.parametrize("name", ["inverted-slider-crank", "four-bar-forces"])
def test_no_cell_depends_on_the_order_in_which_sheets_are_begun(name, monkeypatch):
    mechanism = loads(template_text(name))
    equations = solve(mechanism)
    expected, _ = layout.lay_out(mechanism, equations)
    parts = {"Checks": layout.Checks, "Extremes": layout.Extremes, "Tolerance": layout.Tolerance}
    for order in permutations(parts):
        plan = plan_of(mechanism, equations)
        begun = {part: parts[part](plan) for part in order}
        with monkeypatch.context() as patched:
            patched.setattr(layout, "plan_of", lambda *_, plan=plan: plan)
            for part in parts:
                patched.setattr(layout, part, lambda _, part=part, begun=begun: begun[part])
            assert layout.lay_out(mechanism, equations)[0] == expected, order


def test_a_formula_over_what_stands_nowhere_is_refused():
    mechanism = loads(template_text("four-bar"))
    plan = plan_of(mechanism, solve(mechanism))
    with pytest.raises(KeyError, match="nowhere"):
        plan.at.bind(Symbol("nowhere"), plan.main)
    with pytest.raises(ValueError, match="outside the table"):
        plan.at.bind(Symbol("theta14"), plan.main)


def contents(sheet):
    """How often something is put into each cell that holds something."""
    found = Counter((cell.row, cell.col) for cell in sheet.cells if cell.content is not None)
    for fill in sheet.fills:
        found.update((fill.row + row, fill.col + col) for row in range(fill.rows) for col in range(fill.cols))
    return found


@pytest.mark.cases(6)
@pytest.mark.parametrize("name", some(template_names(), 5))
def test_everything_has_its_place(name):
    """No cell is written twice, where something is said to stand it stands, and colours belong to the rows they ask."""
    mechanism = loads(template_text(name))
    workbook, plan = layout.lay_out(mechanism, solve(mechanism))
    filled = {sheet.title: contents(sheet) for sheet in workbook.sheets}
    assert {title: [cell for cell, times in found.items() if times > 1] for title, found in filled.items()} == {
        title: [] for title in filled
    }
    for symbol, spot in places_of(plan).items():
        # what is compared with the rows around it has nothing in the first row
        places = [(spot.row + row, spot.col) for row in range(2 if spot.column else 1)]
        assert any(place in filled[spot.sheet] for place in places), symbol
    for sheet in workbook.sheets:
        for each in sheet.conditionals:
            area = each.area
            assert area.first_row <= area.last_row and area.first_col <= area.last_col
            own = [part for part in walk(each.condition) if isinstance(part, CellRef) and part.sheet is None]
            assert {part.row for part in own if not part.row_abs} <= {area.first_row}, (sheet.title, area)

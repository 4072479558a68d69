"""The sheets of a workbook are laid out before any formula is written: in which order they are asked does not matter."""

from itertools import permutations

import pytest

from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.dynamics.solve import solve
from mechsheet.formula.nodes import Symbol
from mechsheet.sheet import layout
from mechsheet.sheet.plan import plan_of


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

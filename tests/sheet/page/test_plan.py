"""Columns of the one sheet: which are grey, and over which a group's heading stands."""

from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.dynamics.solve import solve
from mechsheet.sheet.page.plan import plan_page

LAW = 'start = 20\nstop = 200\nmotion = { law = "cycloidal", duration = 3, rows = 7 }\n'


def test_what_is_only_computed_with_is_grey_and_times_belong_to_the_driver():
    text = template_text("four-bar").replace("start = 0\nstop = 360\nstep = 15\n", LAW)
    mechanism = loads(text)
    columns = plan_page(mechanism, solve(mechanism)).columns
    assert [column.col for column in columns] == list(range(len(columns)))
    groups = {column.symbol: (column.group, column.inner) for column in columns}
    assert groups["theta12"] == groups["t"] == (0, False)
    assert groups["theta13"] == groups["theta14"] == (1, False)
    assert groups["s"] == groups["phi"] == (1, True)
    assert groups["mu"] == (-1, False)

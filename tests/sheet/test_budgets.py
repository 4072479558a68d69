"""The workbook stays small: cells, columns, and formulas short enough to be read."""

from dataclasses import replace
from functools import cache

import pytest
from claims import ROOT

from mechsheet.description import load
from mechsheet.formula.nodes import Call, Node, children
from mechsheet.formula.printer import print_formula
from mechsheet.kinematics.solve import solve
from mechsheet.sheet.layout import lay_out
from mechsheet.sheet.table.positions import heading

TEMPLATES = sorted(path.stem for path in (ROOT / "templates").glob("*.toml"))
POSITIONS = {"names": 120, "anchors": 195}
"""Characters of the longest formula of a cell of the table."""

ELSEWHERE = 460
LARGE_BESIDE_FEW_ROWS = {"fivelink", "adjustable-pump", "cylinder-boom"}
"""Of 19 and 31 rows: what does not grow with the rows (drawing, extremes) is more than half."""


@cache
def laid(name, references="names"):
    mechanism = replace(load(ROOT / f"templates/{name}.toml"), references=references)
    return lay_out(mechanism, solve(mechanism))


def cells(sheet):
    return sum(fill.rows * fill.cols for fill in sheet.fills)


def nested_ifs(node: Node) -> int:
    below = max(map(nested_ifs, children(node)), default=0)
    return below + (isinstance(node, Call) and node.name == "IF")


def test_four_bar():
    workbook, plan = laid("four-bar")
    assert sum(map(cells, workbook.sheets)) <= 1500
    assert len(plan.columns) <= 19


def test_all_templates():
    assert sum(cells(sheet) for name in TEMPLATES for sheet in laid(name)[0].sheets) <= 130_000


@pytest.mark.parametrize("name", TEMPLATES)
def test_cells_beside_the_table(name):
    workbook, plan = laid(name)
    table = cells(workbook.sheet(plan.table))
    tables = sum(cells(sheet) for sheet in workbook.sheets if sheet.title.startswith(plan.text("sheet.table")))
    rates = cells(workbook.sheet(plan.at.titles["rates"])) if plan.rates else 0
    assert rates <= 1.5 * table
    # velocities and accelerations have their own checks: not more cells than they themselves
    most = 2.5 * table + 2 * rates + (650 if name in LARGE_BESIDE_FEW_ROWS else 500)
    assert sum(map(cells, workbook.sheets)) - tables <= most


@pytest.mark.parametrize("name", TEMPLATES)
def test_no_heading_stands_over_two_columns(name):
    _, plan = laid(name)
    heads = [str(getattr(head, "plain", head)) for head in (heading(plan, column) for column in plan.columns)]
    assert len(set(heads)) == len(heads)


@pytest.mark.parametrize("references", POSITIONS)
@pytest.mark.parametrize("name", TEMPLATES)
def test_formulas_are_short(name, references):
    workbook, plan = laid(name, references)
    outputs = {plan.at.spots[output.symbol].col for output in plan.mechanism.outputs}  # as long as the description's
    for sheet in workbook.sheets:
        if sheet.title.startswith(plan.text("sheet.table")):
            continue
        for fill in sheet.fills:
            if sheet.title == plan.table and fill.col in outputs:
                continue
            text = print_formula(fill.formula, "excel")
            most = POSITIONS[references] if sheet.title == plan.table else ELSEWHERE
            assert len(text) <= most, (sheet.title, fill.row, fill.col, len(text), text)
            assert sheet.title != plan.table or nested_ifs(fill.formula) <= 1, text

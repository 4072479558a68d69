"""Two-way tables: the published one, and any other against tables of positions built one by one."""

import csv
import tomllib

import numpy as np
import pytest

from chosen import part
from folders import ROOT
from judging import positions_only
from livesheet.evaluation import computed
from livesheet.formula.nodes import CellRef, ErrorValue, shifted, walk
from livesheet.formula.printer import print_formula
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.sweep import rough_poses
from mechsheet.library.building import compile_workbook
from mechsheet.reference import solve as refer
from mechsheet.reference import variables
from mechsheet.sheet.asked.cell_formula import LIMITS, depth
from mechsheet.sheet.asked.two_way import FIRST, HEAD_ROW

pytestmark = pytest.mark.slow

CASES = tomllib.loads((ROOT / "tests/cases/tables.toml").read_text(encoding="utf-8"))["case"]


def template(name, **overrides):
    return loads(template_text(name), overrides=Overrides(overrides))


def blocks(sheet, plan, count):
    return [fill for fill in sheet.fills if (fill.row, fill.rows, fill.cols) == (FIRST, plan.rows, count) and fill.col]


def shown_column(workbook, plan, symbol):
    spot = plan.at.spots[symbol]
    fills = [fill for fill in workbook.sheet(spot.sheet).fills if fill.col == spot.col]
    return [value for fill in sorted(fills, key=lambda fill: fill.row) for value in fill.values]


def test_published_pump_table():
    """Every cell within 6e-5 of the text's table, printed with four decimals and computed with a shorter pi."""
    workbook, plan = compile_workbook(template("adjustable-pump"))
    sheet = workbook.sheet("Tablo s15")
    table, *_ = blocks(sheet, plan, 6)
    heads = {cell.col: cell.content for cell in sheet.cells if cell.row == HEAD_ROW and cell.col}
    assert list(heads.values()) == [20, 50, 100, 150, 200, 250]
    with (ROOT / "tests/data/published/adjustable-pump.csv").open(encoding="utf-8") as file:
        _, *rows = csv.reader(file)
    assert len(rows) == 19
    for number, (angle, *values) in enumerate(rows):
        (driver,) = [fill for fill in sheet.fills if fill.col == 0 and fill.row == FIRST]
        assert driver.value(FIRST + number, 0) == pytest.approx(float(angle), abs=1e-12)
        for col, value in enumerate(values, 1):
            assert abs(table.value(FIRST + number, col) - float(value)) < 6e-5


def test_mixed_anchors():
    """One formula, `$A8` and `B$7`, filled both ways; the sheet has a curve for each column."""
    workbook, plan = compile_workbook(template("adjustable-pump"))
    sheet = workbook.sheet("Tablo s15")
    table, *helpers = blocks(sheet, plan, 6)
    heads = {CellRef(FIRST, 0, col_abs=True), CellRef(HEAD_ROW, 1, row_abs=True)}
    own = {part for part in walk(table.formula) if isinstance(part, CellRef) and part.sheet is None}
    assert own - heads <= {CellRef(FIRST, helper.col) for helper in helpers}
    assert "E$7" in print_formula(shifted(table.formula, 2, 3))
    assert "RADIANS($A10)" in print_formula(shifted(helpers[0].formula, 2, 3))
    (chart,) = sheet.charts
    assert len(chart.series) == 6


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    "case", part(CASES, 2), ids=lambda case: f"{case['template']}-{case['value']}-{case['column']}"
)
def test_equals_positions(case):
    """Column for column what the table of positions shows when the dimension has that value, #N/A included."""
    text = template_text(case["template"]).partition("[[tables]]")[0]
    if "outputs" in case:
        text += f"\n[outputs.{case['value']}]\n{case['outputs']}\n"
    driver = loads(text).driver.symbol
    columns = f"{{ {case['column']} = {case['values']} }}"
    request = f'[[tables]]\nrows = "{driver}"\ncolumns = {columns}\nvalue = "{case["value"]}"\n'
    workbook, plan = compile_workbook(loads(text + request))
    sheet = next(sheet for sheet in workbook.sheets if case["value"] in sheet.title)
    table, *helpers = blocks(sheet, plan, len(case["values"]))
    assert all(
        len(print_formula(block.formula)) < LIMITS[0] * 1.05 and depth(block.formula) < 64
        for block in (table, *helpers)
    )
    numbers = 0
    for col, value in enumerate(case["values"], 1):
        single, single_plan = positions_only(loads(text, overrides=Overrides({case["column"]: str(value)})))
        single = computed(single)
        for row, expected in enumerate(shown_column(single, single_plan, case["value"]), FIRST):
            found = table.value(row, col)
            if isinstance(expected, ErrorValue):
                assert found == expected == ErrorValue("#N/A")
            else:
                assert found == pytest.approx(expected, abs=1e-9), (row, col)
                numbers += 1
    assert numbers > plan.rows


def test_anchors_and_names_of_sheets():
    """`references = "anchors"`, expressions in the head row, two tables of the same value, a sheet of each."""
    text = template_text("slider-crank")
    head, _, workbook_part = text.partition("[workbook]")
    assert "references" not in workbook_part
    table = '[[tables]]\nrows = "theta12"\ncolumns = { a1 = [0, "a2/2"] }\nvalue = "s14"\n'
    workbook, _ = compile_workbook(loads(head + table + table + '[workbook]\nreferences = "anchors"\n'))
    first, second = [sheet for sheet in workbook.sheets if "s14" in sheet.title]
    assert (first.title, second.title) == ("Table s14", "Table s14 2")
    heads = [fill for fill in first.fills if fill.row == HEAD_ROW]
    assert [fill.value(HEAD_ROW, 2) for fill in heads] == [25.0]
    assert "Mechanism!$B$" in print_formula(blocks(first, _, 2)[0].formula)


TURNING = [
    ("four-bar", "theta14", "a1", [70, 20, 5, 500, 150]),
    ("four-bar", "theta13", "a1", [70, 20, 90]),
    ("drag-link", "theta14", "r1", [1, 3, 2]),
]
"""Dimensions that make a crank of a rocker, or the other way round, and some with rows that do not exist."""


@pytest.mark.cases(1)
@pytest.mark.parametrize("language", ["en", "tr"])
@pytest.mark.parametrize(("name", "value", "column", "values"), part(TURNING, 2))
def test_angles_do_not_jump(name, value, column, values, language):
    """Down a column an angle goes on as the link does: as the reference has it, whole turns of the column aside."""
    text = template_text(name).partition("[[tables]]")[0]
    text = text.partition("[[charts]]")[0].partition("[workbook]")[0]
    request = f'[[tables]]\nrows = "theta12"\ncolumns = {{ {column} = {values} }}\nvalue = "{value}"\n'
    workbook, plan = compile_workbook(loads(text + request, overrides=Overrides(language=language)))
    sheet = next(sheet for sheet in workbook.sheets if value in sheet.title)
    table, *_ = blocks(sheet, plan, len(values))
    for col, number in enumerate(values, 1):
        cells = [table.value(FIRST + row, col) for row in range(plan.rows)]
        ours = np.array([cell if isinstance(cell, float) else np.nan for cell in cells])
        mechanism = loads(text, overrides=Overrides({column: str(number)}))
        try:
            start = rough_poses(mechanism, plan.equations.equations)
            theirs = np.degrees(variables(refer(mechanism, start=start))[value])
        except MechanismError:
            theirs = np.full(plan.rows, np.nan)
        assert np.array_equal(np.isnan(ours), np.isnan(theirs))
        turns = (ours - theirs) / 360
        whole = np.round(turns[0] if np.isfinite(turns[0]) else 0)
        assert np.nanmax(np.abs(turns - np.round(turns)), initial=0) < 1e-11
        steps = np.abs(np.diff(ours))
        assert np.nanmax(steps, initial=0) < 180
        if not np.isnan(ours).any():
            assert (np.round(turns) == whole).all()
        assert np.isnan(ours[0]) or abs(ours[0] - table.value(FIRST, 1)) <= 180.000001

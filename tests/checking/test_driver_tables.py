"""`check` judges two-way tables over the driver: damaged cells and leaps by a turn are found, what is right agrees."""

import math
from dataclasses import replace
from itertools import pairwise

import pytest

from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from livesheet.formula.nodes import Binary, Number, transform
from mechsheet.checking import against_reference
from mechsheet.checking.against_reference import against_plan
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.exporting.functions.workbooks import functions_workbook
from mechsheet.sheet.asked.two_way import CHART_COLUMNS, FIRST, HEAD_ROW

pytestmark = pytest.mark.slow


def with_table(name, value, column, numbers, **dimensions):
    text = template_text(name).partition("[[tables]]")[0]
    table = f'[[tables]]\nrows = "theta12"\ncolumns = {{ {column} = {numbers} }}\nvalue = "{value}"\n'
    return Compiled(loads(text + table, overrides=Overrides(dimensions)))


def compared(compiled, typed=None, workbook=None):
    """The comparison with the reference, cells typed over, or the formulas of another workbook."""
    book = book_of(workbook or compiled.layout)
    return against_plan(book, evaluate(book, typed or {}), compiled.plan, "table")[0]


def damaged(compiled, title, col, change):
    """The workbook with another formula in the block of the table's sheet that begins in a column."""
    sheets = tuple(
        replace(
            sheet,
            fills=tuple(
                replace(fill, formula=change(fill.formula)) if (fill.row, fill.col) == (FIRST, col) else fill
                for fill in sheet.fills
            ),
        )
        if sheet.title == title
        else sheet
        for sheet in compiled.layout.sheets
    )
    return replace(compiled.layout, sheets=sheets)


@pytest.fixture(scope="module")
def rack():
    """A crank that turns all round, or a rocker instead: with a1 = 20 the pinion turns, with 30 not all rows exist."""
    return with_table("rack-slider", "s15", "a1", [70, 20, 30])


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    ("name", "value", "column", "numbers"),
    [
        ("four-bar", "theta14", "a3", [62.3, 70, 120]),  # 120: does not close everywhere
        ("four-bar", "A.x", "a1", [70, 120]),  # the crank's pin is there in every row
        ("four-bar", "mu", "a1", [70, 500]),  # 500: closes nowhere
        ("drag-link", "theta14", "r1", [1, 3, 2]),  # links that turn; 3: half a turn from cell to cell
    ],
)
def test_what_is_right_agrees(name, value, column, numbers):
    compiled = with_table(name, value, column, numbers)
    found = compared(compiled)
    assert found.agrees, found
    assert found.worst < 1e-12


def test_every_cell_is_counted(rack, monkeypatch):
    with_tables = compared(rack)
    monkeypatch.setattr(against_reference, "compare_tables", lambda *_: None)
    assert with_tables.agrees
    assert with_tables.cells == compared(rack).cells + 3 * rack.plan.rows


def test_a_leap_by_a_turn_is_found(monkeypatch):
    """A pinion that turns with the crank: the way of its bare direction leaps at half a turn; only the table shows it."""
    turning = with_table("rack-slider", "s15", "a1", [20, 25], a1="20", a2="60", a4="50")
    assert compared(turning).agrees
    bare = damaged(turning, "Table s15", HELPERS_OF_TWO, bare_of)
    values = evaluate(book_of(bare))
    ways = [values.get("Table s15", row, 1) for row in range(FIRST, FIRST + turning.plan.rows)]
    assert max(abs(after - before) for before, after in pairwise(ways)) > 25 * math.pi
    found = compared(turning, workbook=bare)
    assert not found.agrees
    assert found.where.startswith("Table s15!")
    monkeypatch.setattr(against_reference, "compare_tables", lambda *_: None)
    assert compared(turning, workbook=bare).agrees


HELPERS_OF_TWO = 1 + 2 + 1 + CHART_COLUMNS + 1
"""The column of the first block of helpers of a table of two columns: that of the angle."""


def bare_of(formula):
    """place + MOD(angle - place + pi, a turn) - pi without the place: within half a turn of 0."""
    place = formula.left.left
    return transform(formula, lambda part: Number(0.0) if part == place else part)


@pytest.mark.cases(1)
@pytest.mark.parametrize("value", ["s15", "theta14", "B.x"])
def test_a_damaged_formula_is_found(value, monkeypatch):
    compiled = with_table("rack-slider", value, "a1", [70, 30])
    wrong = damaged(compiled, f"Table {value}", 1, lambda formula: Binary("*", formula, Number(1.0001)))
    found = compared(compiled, workbook=wrong)
    assert not found.agrees
    assert found.where.startswith(f"Table {value}!")
    monkeypatch.setattr(against_reference, "compare_tables", lambda *_: None)
    assert compared(compiled, workbook=wrong).agrees


def test_a_number_where_nothing_exists_is_found():
    compiled = with_table("four-bar", "theta14", "a1", [70, 500, 120])
    nowhere = compared(compiled, {("Table theta14", FIRST + 3, 2): 12.0})
    assert not nowhere.agrees
    assert nowhere.where.startswith("Table theta14!C11 ")
    values = evaluate(book_of(compiled.layout))
    beyond = next(row for row in range(FIRST, FIRST + 25) if not isinstance(values.get("Table theta14", row, 3), float))
    assert not compared(compiled, {("Table theta14", beyond, 3): 12.0}).agrees


def test_an_angle_a_turn_away_is_found():
    compiled = with_table("four-bar", "theta14", "a1", [70, 20])
    shown = evaluate(book_of(compiled.layout)).get("Table theta14", FIRST + 4, 2)
    assert not compared(compiled, {("Table theta14", FIRST + 4, 2): shown + 360.0}).agrees


@pytest.mark.cases(1)
@pytest.mark.parametrize("number", [45.0, None, "?"])
def test_typed_inputs_are_followed(number):
    """The table's head and the assembly; a head without a number is a sweep of nothing."""
    compiled = with_table("four-bar", "theta14", "a1", [70, 20])
    mode = compiled.plan.at.spots["mode_1"]
    typed = {("Table theta14", HEAD_ROW, 2): number, (mode.sheet, mode.row, mode.col): -1.0}
    found = compared(compiled, typed)
    assert found.agrees, found


@pytest.mark.cases(1)
@pytest.mark.parametrize(("value", "numbers"), [("s15", [70, 20, 30]), ("theta14", [70, 30])])
def test_tables_that_call_functions(value, numbers):
    """They know no cell above: each angle is in one turn around a line."""
    compiled = with_table("rack-slider", value, "a1", numbers)
    found = compared(compiled, workbook=functions_workbook(compiled, "lambda"))
    assert found.agrees, found

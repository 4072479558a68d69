"""Portable arithmetic: the engine computes what `portable` does, in every one of its ways, and nothing numpy would round."""

import re

import numpy as np
import pytest

from folders import ROOT
from livesheet import portable
from livesheet.engine import PORTABLE, compile_book, evaluate
from livesheet.evaluation import book_of
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import Call, walk
from livesheet.formula.parser import DESCRIPTION_FUNCTIONS, parse_formula
from mechsheet.compiled import compiled_of
from mechsheet.description import Overrides, load

EXACT = frozenset(
    [
        "ABS",
        "AND",
        "AVERAGEIF",
        "AVERAGEIFS",
        "CHOOSE",
        "COLUMNS",
        "COUNT",
        "COUNTIF",
        "COUNTIFS",
        "DEGREES",
        "FIND",
        "HYPERLINK",
        "IF",
        "IFERROR",
        "INDEX",
        "INT",
        "ISFORMULA",
        "ISNA",
        "ISNUMBER",
        "ISODD",
        "ISTEXT",
        "MATCH",
        "MAX",
        "MAXIFS",
        "MEDIAN",
        "MID",
        "MIN",
        "MINIFS",
        "MOD",
        "NA",
        "NOT",
        "OR",
        "PI",
        "RADIANS",
        "ISREF",
        "LEFT",
        "LEN",
        "ROUND",
        "ROUNDDOWN",
        "ROUNDUP",
        "ROW",
        "ROWS",
        "SEARCH",
        "SIGN",
        "SQRT",
        "SUM",
        "SUMPRODUCT",
        "SUMSQ",
        "TEXT",
        "N",
    ]
)
"""Functions that choose, count, compare, round, or are made of +, -, *, / and the square root alone."""

TEXTS = {
    "SIN(A1)": portable.sin, "COS(A1)": portable.cos, "TAN(A1)": portable.tan, "ATAN(A1)": portable.arctan,
    "ASIN(A1/9)": lambda x: portable.arcsin(x / 9), "ACOS(A1/9)": lambda x: portable.arccos(x / 9),
    "EXP(A1)": portable.exp, "LN(A1)": portable.log, "LOG10(A1)": portable.log10,
    "ATAN2(A1,2)": lambda x: portable.arctan2(2.0, x), "POWER(A1,1.7)": lambda x: portable.power(x, 1.7),
    "A1^1.7": lambda x: portable.power(x, 1.7),
}  # fmt: skip


@pytest.mark.parametrize("rows", [1, 40, 20_000])
def test_interpreted_and_generated_code_are_the_portable_functions(rows):
    """The first evaluation of short columns is interpreted, the second generated code; that of long ones always is."""
    numbers = np.random.default_rng(rows).uniform(0.1, 8, rows)
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, numbers.tolist())
    texts = [text for text in TEXTS if rows < 1000 or "LOG10" not in text]  # which takes its time for each number
    for col, text in enumerate(texts, 1):
        sheet.block(0, col, rows, 1, parse_formula(text))
    plan = compile_book(builder.build(), PORTABLE)
    for _ in range(2):
        values = plan.evaluate()
        for col, text in enumerate(texts, 1):
            assert values.column("S", col, 0, rows - 1) == TEXTS[text](numbers).tolist(), text


def test_row_loops_are_the_portable_functions():
    """Columns that read each other's rows above are floats in generated Python."""
    rows = 60
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [0.3])
    sheet.constants.extend(0, 1, [0.4])
    sheet.block(1, 0, rows, 1, parse_formula("SIN(B1)+ATAN2(A1,B1)"))
    sheet.block(1, 1, rows, 1, parse_formula("COS(A2)*(1+B1^2)^0.7"))
    values = evaluate(builder.build(), arithmetic=PORTABLE)
    a, b = 0.3, 0.4
    for row in range(1, rows + 1):
        a = portable.sin(b) + portable.arctan2(b, a)
        b = portable.cos(a) * portable.power(1 + b * b, 0.7)
        assert (values.get("S", row, 0), values.get("S", row, 1)) == (a, b)


def test_a_changed_plan_keeps_its_arithmetic():
    """A constant typed over a formula makes another plan."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [0.1 * n for n in range(200)])
    sheet.block(0, 1, 200, 1, parse_formula("ATAN2(A1,SIN(A1)+2)"))
    values = compile_book(builder.build(), PORTABLE).evaluate({("S", 3, 1): 7.0})
    numbers = np.array([0.1 * n for n in range(200)])
    expected = portable.arctan2(portable.sin(numbers) + 2, numbers).tolist()
    expected[3] = 7.0
    assert values.column("S", 1, 0, 199) == expected


def test_all_that_descriptions_may_use_is_portable():
    assert set(DESCRIPTION_FUNCTIONS.values()) <= EXACT | set(PORTABLE.functions)


@pytest.mark.parametrize(
    ("name", "layout"),
    [("four-bar", "page"), ("four-bar", "sheets"), ("six-link-dwell", "sheets"), ("stephenson-iii-output", "sheets"),
     ("five-bar-robot", "sheets"), ("adjustable-pump", "sheets")],
)  # fmt: skip
def test_all_that_workbooks_use_is_portable(name, layout):
    mechanism = load(ROOT / "templates" / f"{name}.toml", Overrides(layout=layout))
    used = {
        node.name
        for sheet in book_of(compiled_of(mechanism).layout).sheets
        for block in sheet.blocks
        for node in walk(block.formula)
        if isinstance(node, Call)
    }
    assert used - EXACT <= set(PORTABLE.functions)


WRITING = ("arguments", "compiled", "description", "dynamics", "formula", "kinematics", "library", "sheet", "synthesis")
NOT_EXACT = re.compile(
    r"\b(?:math|cmath)\.(?:a?(?:sin|cos|tan)h?|atan2|exp\w*|log\w*|pow|hypot|dist|cbrt|gamma)\b"
    r"|\bnp\.(?:arc\w+|sin|cos|tan|sinh|cosh|tanh|exp\w*|log(?!ical)\w*|power|float_power|hypot|interp|cbrt|dot|matmul"
    r"|einsum|linalg|polyfit|unwrap)\b"
)


def test_what_decides_about_files_calls_no_function_of_the_machine():
    """Rooms whose numbers reach a workbook compute with `portable`."""
    found = [
        f"{path.name}:{number}: {line.strip()}"
        for room in WRITING
        for path in sorted((ROOT / "src" / "mechsheet" / room).rglob("*.py"))
        if path.name != "written.py"  # there they are the text of exported programs
        for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
        if NOT_EXACT.search(line.split("#")[0]) and '"""' not in line
    ]
    assert not found, "\n".join(found)

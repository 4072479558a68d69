"""A number that says how a function searches: every row has its own, an array gives a value for each."""

import pytest

from livesheet.engine import evaluate
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.parser import parse_formula

NOWHERE = ErrorValue("#N/A")


def sheet_with(*, modes=()):
    """Column A has 1, 2, 4, 8, 16, and column B the modes."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for row in range(5):
        sheet.constant(row, 0, 2.0**row)
    for row, mode in enumerate(modes):
        sheet.constant(row, 1, mode)
    return builder, sheet


@pytest.mark.parametrize(
    ("formula", "modes", "values"),
    [
        ("MATCH(3,A$1:A$5,B1)", (0, 1), (NOWHERE, 2)),
        ("XMATCH(3,A$1:A$5,B1)", (0, -1, 1), (NOWHERE, 2, 3)),
        ("XMATCH(3,A$1:A$5,-1,B1)", (1, 2), (2, 2)),
        ('XLOOKUP(3,A$1:A$5,A$1:A$5,"none",B1)', (0, -1, 1), ("none", 2, 4)),
        ("VLOOKUP(3,A$1:A$5,1,B1)", (0, 1), (NOWHERE, 2)),
        ("HLOOKUP(3,A$1:A$5,2,B1)", (0, 1), (NOWHERE, 2)),
        ("SUBTOTAL(B1,A$1:A$5)", (4, 5, 9), (16, 1, 31)),
    ],
)
def test_rows_that_search_each_in_its_way(formula, modes, values):
    builder, sheet = sheet_with(modes=modes)
    sheet.block(0, 3, len(modes), 1, parse_formula(formula), kind="fill")
    found = evaluate(builder.build())
    assert [found.get("S", row, 3) for row in range(len(modes))] == list(values)


@pytest.mark.parametrize(
    ("formula", "values"),
    [  # as LibreOffice computes them
        ("MATCH(3,A$1:A$5,{0,1})", (NOWHERE, 2)),
        ("VLOOKUP(3,A$1:A$5,1,{0,1})", (NOWHERE, 2)),
        ("SUBTOTAL({4,9},A$1:A$5)", (16, 31)),
        # and by the same rule
        ("XMATCH(3,A$1:A$5,{0,-1})", (NOWHERE, 2)),
        ('XLOOKUP(3,A$1:A$5,A$1:A$5,"none",{0,-1})', ("none", 2)),
    ],
)
def test_an_array_of_ways(formula, values):
    builder, sheet = sheet_with()
    sheet.block(0, 3, 1, 2, parse_formula(formula), kind="array")
    found = evaluate(builder.build())
    assert (found.get("S", 0, 3), found.get("S", 0, 4)) == values


@pytest.mark.parametrize("formula", ["RANDARRAY(1/0,2)", "MAKEARRAY(1/0,2,LAMBDA(r,c,r))", "XMATCH(3,A$1:A$5,1/0)"])
def test_an_error_stays_the_error_it_is(formula):
    builder, sheet = sheet_with()
    sheet.block(0, 3, 1, 1, parse_formula(formula))
    assert evaluate(builder.build()).get("S", 0, 3) == ErrorValue("#DIV/0!")

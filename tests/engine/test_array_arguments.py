"""Functions that want arrays keep them wherever they stand: found by `check --perturb` with IronCalc."""

import pytest

from livesheet.engine import evaluate
from livesheet.formula.book import BookBuilder
from livesheet.formula.parser import parse_formula


@pytest.mark.parametrize(
    ("formula", "value"),
    [
        ("SUMPRODUCT(LARGE(A1:A3*(B1:B3+1),1))", 3.0),
        ("INDEX(B1:B3,SUMPRODUCT(LARGE(A1:A3*(B1:B3+1),1)))", 2.0),
        ("ROUND(INDEX(B1:B3,SUMPRODUCT(LARGE(A1:A3*(B1:B3+1),1))),4)", 2.0),
        ('IF(B1=25,"all",INDEX(B1:B3,SUMPRODUCT(MAX(A1:A3*B1:B3))))', 1.0),
    ],
)
def test_inside_a_function_that_makes_a_reference(formula, value):
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for row in range(3):
        sheet.constant(row, 0, 1.0)
        sheet.constant(row, 1, float(row))
    sheet.block(35, 4, 1, 1, parse_formula(formula))  # beside none of the ranges
    assert evaluate(builder.build()).get("S", 35, 4) == value

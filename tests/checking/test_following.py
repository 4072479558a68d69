"""Which stored values follow from those they read: the last digits of a file decide what little a difference leaves."""

import math

import pytest

from livesheet.formula.book import BookBuilder
from livesheet.formula.parser import parse_formula
from mechsheet.checking.stored import judge_stored

LENGTH = 250.0
NEAR = 250.00001019104857
"""Where a search has come to rest near the length, beside where another program has."""

REST = LENGTH - NEAR


def written(number):
    """A number as LibreOffice writes it into a file."""
    return float(f"{number:.15g}")


def at_fault(*formulas):
    """Cells whose stored values do not follow: each formula of column B has such a value, B1 where the search has rested."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for row, value in enumerate((LENGTH, 7.0, 7.000000000000001, 3.0)):
        sheet.constant(row, 0, value)
        sheet.constant(row, 2, float(row))
    for row, (text, value) in enumerate([("A1", written(NEAR)), *formulas]):
        sheet.block(row, 1, 1, 1, parse_formula(text))
        sheet.cached.put(row, 1, value)
    return [item.address for item in judge_stored(builder.build())[0].own()]


@pytest.mark.parametrize(
    ("formula", "stored"),
    [
        ("A1-ABS(B1)", written(REST)),
        ("SQRT(MAX(0,(B1-A1)*(B1+A1)))", written(math.sqrt(-REST * (NEAR + LENGTH)))),
        ("1000*(B1-A1)^2-1000*(B1-A1)*(A1-B1)*2", written(3000 * REST**2)),
    ],
)
def test_what_the_last_digits_decide_is_no_difference_and_more_is_one(formula, stored):
    """Else a length that does not close, typed into a workbook and saved in LibreOffice, would be said to differ."""
    assert at_fault((formula, stored)) == ["S!B1"]
    assert at_fault((formula, 1.001 * stored)) == ["S!B1", "S!B2"]


def test_of_rows_that_are_equal_but_for_the_last_digit_each_is_an_answer():
    """Where the largest gap of the joints is, two programs may say of two whole turns."""
    where = 'IFERROR(INDEX(C2:C4,MATCH(MAX(A2:A4),A2:A4,0)),"")'
    assert at_fault((where, 1.0)) == ["S!B1"]
    assert at_fault((where, 3.0)) == ["S!B1", "S!B2"]

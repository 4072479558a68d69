"""Angles that people read in degrees: what a cell shows is the angle, and its formula has no detour by radians."""

import math

import pytest

from livesheet.engine import compile_book
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import transform
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from mechsheet.sheet.as_typed import degrees_together, in_degrees

READS = [
    ("RADIANS(A1)", "A1"),
    ("RADIANS(A1)-RADIANS(B1)", "A1-B1"),
    ("RADIANS(A1)-B1*C1", "A1-DEGREES(B1*C1)"),
    ("RADIANS(A1)+PI()", "A1+180"),
    ("-RADIANS(A1)", "-A1"),
    ("C1+3*PI()/2", "DEGREES(C1)+270"),
    ("C1-PI()*(1-B1)/2", "DEGREES(C1)-90*(1-B1)"),
    ("2*PI()*B1", "360*B1"),
    ("B1*RADIANS(A1)/4", "B1*A1/4"),
    ("ATAN2(A1,B1)", "DEGREES(ATAN2(A1,B1))"),
    ("IF(A1>0,NA(),RADIANS(B1))", "IF(A1>0,NA(),B1)"),
    ("IF(A1>0,ACOS(C1),PI()-ACOS(C1))", "IF(A1>0,DEGREES(ACOS(C1)),180-DEGREES(ACOS(C1)))"),
    ("IFERROR(ACOS(B1),NA())", "IFERROR(DEGREES(ACOS(B1)),NA())"),
]
CELLS = {"A1": 75.0, "B1": 3.0, "C1": 0.4}


def value_of(formula):
    """What a cell with this formula shows."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for col, number in enumerate(CELLS.values()):
        sheet.constant(0, col, number)
    sheet.block(1, 0, 1, 1, formula)
    return compile_book(builder.build()).evaluate().get("S", 1, 0)


@pytest.mark.parametrize(("radians", "degrees"), READS)
def test_the_formula_is_short_and_means_the_same_angle(radians, degrees):
    tree = parse_formula(radians)
    shown = in_degrees(tree)
    assert print_formula(shown, "excel") == degrees
    before, after = value_of(tree), value_of(shown)
    if isinstance(before, float):
        assert after == pytest.approx(math.degrees(before), rel=1e-14)
    else:
        assert after == before


def test_numbers_are_those_that_were_written():
    assert print_formula(in_degrees(parse_formula(repr(math.radians(60)))), "excel") == "60"


def test_angles_in_degrees_are_added_before_they_are_converted():
    tree = transform(parse_formula("COS(RADIANS(A1)+RADIANS(B1)-RADIANS(C1))"), degrees_together)
    assert print_formula(tree, "excel") == "COS(RADIANS(A1+B1-C1))"

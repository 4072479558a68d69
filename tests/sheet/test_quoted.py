"""Formulas written as they read, and where the names in them come to stand."""

from dataclasses import replace

import pytest

from livesheet.formula.nodes import CellRef, NameRef, Previous, RangeRef, Symbol
from livesheet.formula.printer import print_formula
from mechsheet.sheet.addresses import Addresses, Spot
from mechsheet.sheet.quoted import formula, joined


def text(node):
    return print_formula(node, "excel")


def test_holes_take_trees_numbers_and_texts():
    node = formula("IF(low<high,high-low,words)", low=CellRef(0, 0), high=2, words="none")
    assert text(node) == 'IF(A1<2,2-A1,"none")'


def test_a_hole_keeps_the_order_of_its_operations():
    """What is put in is put in whole: (a + b) * 2, not a + b * 2."""
    a, b = CellRef(0, 0), CellRef(0, 1)
    assert text(formula("x*2", x=formula("a+b", a=a, b=b))) == "(A1+B1)*2"
    assert text(formula("a-x", a=a, x=formula("a-b", a=a, b=b))) == "A1-(A1-B1)"


def test_names_that_are_no_holes_are_quantities():
    assert formula("theta14") == Symbol("theta14")
    assert formula("ALL(C.x)") == Symbol("ALL C.x")
    assert formula("SHOWN(theta14)") == Symbol("SHOWN theta14")


@pytest.mark.parametrize("text_", ["s14+1", "ALL(a1)", "MAX(x,b3:b9)"])
def test_a_name_that_reads_as_an_address_is_refused(text_):
    """S14 is a cell: whoever means the slide s14 gives it through a hole, or a formula would read that cell."""
    with pytest.raises(ValueError, match="address"):
        formula(text_)
    assert formula("slide+1", slide=Symbol("s14")).left == Symbol("s14")


def test_the_same_text_with_other_holes_is_another_formula():
    assert text(formula("x+1", x=1)) == "1+1"
    assert text(formula("x+1", x=2)) == "2+1"
    assert formula("x+1").left == Symbol("x")


@pytest.mark.parametrize(
    ("parts", "expected"), [((), '""'), (("", "a", ""), '"a"'), (("a", CellRef(0, 0), "b"), '"a"&A1&"b"')]
)
def test_joined(parts, expected):
    assert text(joined(*parts)) == expected


@pytest.fixture
def at():
    places = Addresses({}, 3, 9)
    places.spots["a1"] = Spot("Main", 5, 1, name="a_1", named=True)
    places.spots["beta"] = Spot("Main", 6, 1, degrees=True, name="beta", named=True)
    places.spots["theta"] = Spot("Table", 3, 4, 7, degrees=True)
    return places


def test_bound_to_cells(at):
    """Dimensions by name, columns by the cell of the row, angles in radians unless they are asked for as people read
    them."""
    assert (
        text(at.bind(formula("length+beta+theta", length=Symbol("a1")), "Table", 8)) == "a_1+RADIANS(beta)+RADIANS(E9)"
    )
    assert text(at.bind(formula("SHOWN(theta)-SHOWN(beta)"), "Main", 8)) == "Table!E9-beta"
    assert (
        text(at.bind(formula("MAX(ALL(theta))+count", count=Spot("Main", 7, 1).cell), "Main"))
        == "MAX(Table!$E$4:$E$10)+$B$8"
    )
    assert at.bind(formula("x", x=Previous("theta")), "Table", 8).args == (CellRef(7, 4),)
    assert at.bind(Symbol("a1"), "Main") == NameRef("a_1")
    assert isinstance(at.bind(formula("ALL(theta)"), "Table"), RangeRef)


def test_anchors_instead_of_names(at):
    at.spots["a1"] = replace(at.spots["a1"], named=False)
    assert text(at.bind(formula("2*length", length=Symbol("a1")), "Table", 8)) == "2*Main!$B$6"


def test_a_column_has_no_value_outside_the_table(at):
    with pytest.raises(ValueError, match="column"):
        at.bind(Symbol("theta"), "Main")

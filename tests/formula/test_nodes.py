"""Trees of formulas as data: moved, anchored."""

import pytest

from livesheet.formula.nodes import Arrayed, CellRef, ErrorValue, Number, anchored, shifted, transform
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula


@pytest.mark.parametrize(
    ("text", "moved"), [("A1+$B$2", "C4+$B$2"), ("SUM(A$1:B2)", "SUM(C$1:D5)"), ("Sheet2!A1", "Sheet2!C4")]
)
def test_relative_references_move_and_others_stay(text, moved):
    assert print_formula(shifted(parse_formula(text), 3, 2), "excel") == moved


def test_a_formula_that_is_not_moved_stays_itself():
    node = parse_formula("A1")
    assert shifted(node, 0) is node


def test_an_array_formula_is_changed_inside():
    assert transform(Arrayed(CellRef(0, 0)), anchored) == Arrayed(CellRef(0, 0, True, True))


def test_what_leaves_the_sheet_is_an_error_or_comes_back_on_the_other_side():
    assert shifted(CellRef(0, 0), -1) == ErrorValue("#REF!")
    assert shifted(CellRef(0, 0), -1, -1, wrap=True) == CellRef(1_048_575, 16_383)


def test_an_anchored_formula_means_the_same_cells_everywhere():
    fixed = transform(parse_formula("A1*Sheet2!B$2+1"), anchored)
    assert print_formula(fixed, "excel") == "$A$1*Sheet2!$B$2+1"
    assert anchored(Number(1.0)) == Number(1.0)

"""Texts of fill-down runs equal the printed texts of shifted trees."""

from __future__ import annotations

import pytest

from livesheet.formats.fill_down_text import ColumnTexts
from livesheet.formats.xml_text import attribute, ooxml_escaped
from livesheet.formula.nodes import MAX_ROWS, Binary, Call, CellRef, RangeRef, Text, shifted
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from livesheet.workbook import Fill

FORMULAS = (
    "1+2",
    "A1",
    "A3*$B$2+A3",
    "A3-A2",
    "SUM(A$1:A3)",
    "SUM($A3:B$9)+SUM(A3:A5)",
    "A3&\"{0} < 'x'\"",
    "MMULT({1,2;3,4},A3:B4)",
    "IF(A3>0,-A3^2,name)",
    "Sheet888888!A3+'o''clock 777777 & {1}'!A3:B3",
    "A:A+A3",
    "A3%+B777777+C888888",
)


def texts_down(tree, rows, dialect, escape):
    """The texts of a column's rows; its first row is row 0 of the sheet."""
    return ColumnTexts(dialect, escape).rows(Fill(0, 0, tree, rows=rows.stop), 0, rows.start, rows.stop)


@pytest.mark.parametrize("formula", FORMULAS)
@pytest.mark.parametrize(("dialect", "escape"), [("excel", ooxml_escaped), ("openformula", attribute)])
@pytest.mark.parametrize("rows", [range(5), range(7, 300)])
def test_texts_are_those_of_the_shifted_trees(formula, dialect, escape, rows):
    tree = parse_formula(formula)
    expected = [escape(print_formula(shifted(tree, n), dialect)) for n in rows]
    assert texts_down(tree, rows, dialect, escape) == expected


def test_references_that_leave_the_sheet_become_errors():
    tree = Binary("+", CellRef(MAX_ROWS - 2, 0), CellRef(5, 0))
    assert texts_down(tree, range(1, 3), "excel", str) == ["A1048576+A7", "#REF!+A8"]


def test_a_text_with_the_mark_itself():
    tree = Call("LEN", (Binary("&", Text("\0000\0"), CellRef(1, 0)),))
    assert texts_down(tree, range(2), "excel", str) == ['LEN("\0000\0"&A2)', 'LEN("\0000\0"&A3)']


def test_a_range_with_one_moving_corner():
    tree = Call("SUM", (RangeRef(CellRef(0, 0, True, True), CellRef(2, 0)),))
    assert texts_down(tree, range(2), "openformula", str) == ["SUM([.$A$1:.A3])", "SUM([.$A$1:.A4])"]

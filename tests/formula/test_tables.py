"""Structured references: read, written as Excel writes them, and the cells that they mean."""

import pytest

from livesheet.formula.nodes import CellRef, ErrorValue, RangeRef, TableRef
from livesheet.formula.printer import print_formula
from livesheet.formula.tables import Table, cells_of_table, parse_table, table_text

TABLE = Table("Sales", "S", 2, 1, 6, ("Item", "Qty", "Unit price", "#[x]'s"), 1, 1)
"""In B3:E8: a row of names, four rows of data, a row of totals."""


@pytest.mark.parametrize(
    "text, written",
    [
        ("Sales[]", "Sales[]"),
        ("Sales[Qty]", "Sales[Qty]"),
        ("Sales[Unit price]", "Sales[Unit price]"),
        ("Sales['#'[x']''s]", "Sales['#'[x']''s]"),
        ("Sales[[Item]:[Qty]]", "Sales[[Item]:[Qty]]"),
        ("Sales[[#Totals],[Qty]]", "Sales[[#Totals],[Qty]]"),
        ("Sales[[#Headers], [#Data], [Item]:[Qty]]", "Sales[[#Headers],[#Data],[Item]:[Qty]]"),
        ("Sales[#All]", "Sales[#All]"),
        ("Sales[@Qty]", "Sales[[#This Row],[Qty]]"),
        ("Sales[@[Unit price]]", "Sales[[#This Row],[Unit price]]"),
        ("Sales[@[Item]:[Qty]]", "Sales[[#This Row],[Item]:[Qty]]"),
        ("[Qty]", "[Qty]"),
    ],
)
def test_read_and_written(text, written):
    found = parse_table(text)
    assert found is not None
    assert table_text(found) == written
    assert parse_table(written) == found


@pytest.mark.parametrize(
    "text",
    [
        "Sales[[Item],[Qty]:]",
        "Sales[#Nothing]",
        "Sales[[Item]:[Qty]:[Item]]",
        "Sales[[Item],[Qty],[Item]]",
        "Sales[[Item]",
    ],
)
def test_what_says_nothing(text):
    assert parse_table(text) is None


def meant(text, sheet="S", row=4, col=9):
    node = cells_of_table(parse_table(text), [TABLE], sheet, row, col)
    return node.code if isinstance(node, ErrorValue) else print_formula(node)


@pytest.mark.parametrize(
    "text, cells",
    [
        ("sales[]", "S!$B$4:$E$7"),
        ("Sales[qty]", "S!$C$4:$C$7"),
        ("Sales[[Unit price]:[Qty]]", "S!$C$4:$D$7"),
        ("Sales[#All]", "S!$B$3:$E$8"),
        ("Sales[#Headers]", "S!$B$3:$E$3"),
        ("Sales[[#Totals],[Qty]]", "S!$C$8"),
        ("Sales[[#Headers],[#Data],[Item]]", "S!$B$3:$B$7"),
        ("Sales[[#Data],[#Totals],[Item]]", "S!$B$4:$B$8"),
        ("Sales[@Qty]", "S!$C5"),
        ("Sales[Nobody]", "#REF!"),
        ("Nothing[Qty]", "#REF!"),
    ],
)
def test_cells_that_are_meant(text, cells):
    assert meant(text) == cells


def test_this_row_is_one_of_the_data():
    assert [meant("Sales[@Qty]", row=row) for row in (2, 3, 6, 7)] == ["#VALUE!", "S!$C4", "S!$C7", "#VALUE!"]


def test_a_table_without_a_name_is_the_one_around_the_formula():
    inside = {(row, col) for row in range(10) for col in range(8) if meant("[Qty]", "s", row, col) == "S!$C$4:$C$7"}
    assert inside == {(row, col) for row in range(2, 8) for col in range(1, 5)}
    assert meant("[Qty]", "T", 4, 2) == "#REF!"


def test_a_table_without_names_and_totals():
    table = Table("T", "S", 0, 0, 3, ("a",), 0, 0)
    means = {
        text: cells_of_table(parse_table(text), [table], "S", 0, 5) for text in ("T[#Headers]", "T[#Totals]", "T[]")
    }
    assert means["T[#Headers]"] == means["T[#Totals]"] == ErrorValue("#REF!")
    corners = (CellRef(0, 0, True, True, "S"), CellRef(2, 0, True, True, "S"))
    assert means["T[]"] == RangeRef(*corners)
    assert isinstance(parse_table("T[]"), TableRef)

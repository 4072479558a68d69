"""Tokens of formulas, as the format's own description numbers them, and the form that fill-down leaves equal."""

import struct

import xls_files as xls

from livesheet.formats import read
from livesheet.formats.xls.formulas import normal
from livesheet.formula.printer import print_formula

OPERATORS = ("+", "-", "*", "/", "^", "&", "<", "<=", "=", ">=", ">", "<>")
"""From 0x03 on ([MS-XLS] 2.5.198.25 and following)."""


def on_sheet(row, col, **anchored):
    """A cell of another sheet."""
    return b"\x5a" + struct.pack("<H", 1) + xls.cell(row, col, **anchored)[1:]


def area_on_sheet(top, bottom, col):
    return b"\x5b" + struct.pack("<HHHHH", 1, top, bottom, *[col | 0xC000] * 2)


def test_every_operator(tmp_path):
    one, two = (b"\x1e" + struct.pack("<H", number) for number in (1, 2))
    cells = (xls.formula(row, 0, one + two + bytes([3 + row])) for row in range(len(OPERATORS)))
    (tmp_path / "book.xls").write_bytes(xls.stream(("S", b"".join(cells))))
    (sheet,) = read(tmp_path / "book.xls").sheets
    said = {block.row: print_formula(block.formula) for block in sheet.blocks}
    assert said == {row: f"1{operator}2" for row, operator in enumerate(OPERATORS)}


def test_what_reads_another_sheet_is_the_same_formula_a_row_further_down():
    """Else a table filled down is thousands of single formulas, and none of them has a neighbour to be compared with."""
    assert normal(on_sheet(4, 1), 3, 0) == normal(on_sheet(9, 2), 8, 1) != normal(on_sheet(9, 1), 3, 0)
    assert normal(on_sheet(4, 1, rows=False), 3, 0) == normal(on_sheet(4, 1, rows=False), 8, 0)
    assert normal(area_on_sheet(4, 6, 1), 3, 0) == normal(area_on_sheet(9, 11, 1), 8, 0) != area_on_sheet(4, 6, 1)

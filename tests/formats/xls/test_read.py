"""Every formula of an .xls is what the same workbook says as .xlsx; what only Excel writes is built here."""

from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import openpyxl
import pytest
import xlrd
import xls_files as xls
from openpyxl.workbook.defined_name import DefinedName
from openpyxl.worksheet.formula import ArrayFormula

import mechsheet
from command_line import run
from livesheet.diagnostics import WorkbookError
from livesheet.formats import read
from livesheet.formats.xls.formulas import FUNCTION_NUMBERS
from livesheet.formula.functions import FUNCTIONS
from livesheet.formula.nodes import Boolean, Call, ErrorValue, Foreign, NameRef, SheetsRef, shifted
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from mechsheet.checking.programs import convert_with_libreoffice, libreoffice_command

libreoffice = [
    pytest.mark.libreoffice,
    pytest.mark.skipif(libreoffice_command() is None, reason="LibreOffice is not installed"),
]
CASES = Path(__file__).parents[2] / "cases" / "xls_formulas.txt"
FORMULAS = [line for line in CASES.read_text(encoding="utf-8").splitlines() if line and not line.startswith("#")]


def formulas(book):
    """Every formula by its cell, as seen from there."""
    found = {}
    for sheet in book.sheets:
        for block in sheet.blocks:
            for row in range(block.rows):
                for col in range(block.cols):
                    node = shifted(block.formula, row, col) if block.kind == "fill" else block.formula
                    found[sheet.title, block.row + row, block.col + col] = block.kind, node
    return found


def typed(book):
    """Every value that was typed, but for empty texts."""
    return {(s.title, row, col): v for s in book.sheets for row, col, v in s.constants.items() if v != ""}


def of_bytes(tmp_path, data):
    (tmp_path / "book.xls").write_bytes(data)
    return read(tmp_path / "book.xls")


def sheet_of(tmp_path, *records):
    (sheet,) = of_bytes(tmp_path, xls.stream(("S", b"".join(records)))).sheets
    return sheet


# --- the same workbook in both formats --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def pairs(tmp_path_factory):
    """Workbooks as .xlsx with what LibreOffice makes of them as .xls: our own, and one of everything a formula can be."""
    folder = tmp_path_factory.mktemp("pairs")
    for name in ("four-bar", "fivelink"):
        mechsheet.build(mechsheet.template(name), folder / f"{name}.xlsx")
    mechsheet.build(mechsheet.template("slider-crank"), folder / "page.xlsx", layout="page")
    everything(folder / "everything.xlsx")
    paths = sorted(folder.glob("*.xlsx"))
    return {path.stem: (path, made) for path, made in zip(paths, converted(paths, folder), strict=True)}


def converted(paths, folder):
    return convert_with_libreoffice(paths, "xls", folder)


def everything(path):
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "S"
    other, third = book.create_sheet("It's 2"), book.create_sheet("U")
    for row in range(1, 31):
        for col in range(1, 5):
            sheet.cell(row, col, row * col / 2)
        other.cell(row, 1, row)
        sheet.cell(row, 13, f"=A{row}*$B$1+SIN(A{row})")
    for row, text in enumerate(FORMULAS, 1):
        sheet.cell(row, 10, f"={text}")
    sheet["P1"] = ArrayFormula("P1:P3", "=A1:A3*B1:B3")
    sheet["Q1"] = ArrayFormula("Q1", "=SUM(A1:A3*{1;2;3})")
    book.defined_names["rate"] = DefinedName("rate", attr_text="S!$A$1")
    book.defined_names["above"] = DefinedName("above", attr_text="S!A1048576*2")
    sheet.defined_names["local"] = DefinedName("local", attr_text="U!$A$1+1")
    for row, name in enumerate(known_functions(), 1):
        args = ",".join(f"$A${n}" for n in range(1, FUNCTIONS[name].least + 1))
        third.cell(row, 5, f"={name}({args})")
    book.save(path)


def known_functions():
    """The functions with a number that the program knows; of two Excel writes more arguments than LibreOffice."""
    names = [name for _, (name, _) in sorted(FUNCTION_NUMBERS.items()) if name in FUNCTIONS]
    return [name for name in names if name not in ("IF",)]


def test_functions_have_the_numbers_that_another_reader_knows():
    assert {number: row[:2] for number, row in xlrd.formula.func_defs.items()} == FUNCTION_NUMBERS


@pytest.mark.parametrize("name", ["everything", "fivelink", "four-bar", "page"])
class TestPairs:
    pytestmark = libreoffice

    @pytest.mark.cases(1)
    @pytest.mark.ci
    def test_every_formula_is_the_same(self, pairs, name):
        one, other = (formulas(read(path)) for path in pairs[name])
        apart = [
            (place, print_formula(node), other.get(place))
            for place, (_, node) in one.items()
            if other.get(place) != one[place]
        ]
        assert apart == []
        assert len(one) == len(other) > 300

    def test_values_and_names_are_the_same(self, pairs, name):
        one, other = (read(path) for path in pairs[name])
        assert typed(one) == typed(other)
        assert {(n.name, n.sheet): n.formula for n in one.names} == {(n.name, n.sheet): n.formula for n in other.names}
        assert other.program == "LibreOffice"
        assert one.remarks == other.remarks == []

    @pytest.mark.cases(1)
    @pytest.mark.slow
    def test_the_values_are_those_that_another_reader_finds(self, pairs, name):
        theirs = xlrd.open_workbook(str(pairs[name][1]))
        book = read(pairs[name][1])
        count = 0
        for sheet in book.sheets:
            cells = theirs.sheet_by_name(sheet.title)
            for store in (sheet.constants, sheet.cached):
                for row, col, value in store.items():
                    assert cells.cell_value(row, col) == value or isinstance(value, ErrorValue)
                    count += 1
        assert count > 400


@pytest.mark.libreoffice
@pytest.mark.skipif(libreoffice_command() is None, reason="LibreOffice is not installed")
def test_commands_read_it(pairs, tmp_path):
    path = pairs["four-bar"][1]
    done = run("check", path)
    assert done.exit_code == 0, done.output
    done = run("recalc", path, "--set", "a2=30", "--print", "Mechanism!B8")
    assert (done.exit_code, done.stdout) == (0, "ok\n"), done.output
    done = run("recalc", path, "-o", tmp_path / "new.xls")
    assert done.exit_code == 2
    assert "an .xls is read, not written" in done.output
    assert not list(tmp_path.iterdir())


# --- what Excel writes ------------------------------------------------------------------------------------------------


def test_cells_of_every_kind(tmp_path):
    rk = (
        struct.pack("<HI", 0, 0x3FF00000),
        struct.pack("<HI", 0, (12345 << 2) | 3),
        struct.pack("<HI", 0, (-7 << 2 & 0xFFFFFFFF) | 2),
    )
    wide = xls.record(0x3C, b"\1" + "şa".encode("utf-16-le"))
    shared_texts = xls.record(0xFC, struct.pack("<IIHBHH", 2, 2, 4, 8, 1, 0)[:-2] + b"te") + wide
    shared_texts += xls.record(0x3C, bytes(4) + struct.pack("<HB", 1, 0) + b"z")
    cells = xls.number(0, 0, 1.5)
    cells += xls.record(0xBD, struct.pack("<HH", 1, 0) + b"".join(rk) + struct.pack("<H", 2))
    cells += xls.record(0xFD, struct.pack("<HHHI", 2, 0, 0, 0)) + xls.record(0xFD, struct.pack("<HHHI", 2, 1, 0, 1))
    cells += xls.record(0x205, struct.pack("<HHHBB", 3, 0, 0, 1, 0)) + xls.record(
        0x205, struct.pack("<HHHBB", 3, 1, 0, 0x2A, 1)
    )
    cells += xls.record(0x204, struct.pack("<HHHH", 4, 0, 0, 2) + xls.text("ğü"))
    (sheet,) = of_bytes(tmp_path, xls.stream(("S", cells), before=shared_texts)).sheets
    assert {(row, col): value for row, col, value in sheet.constants.items()} == {
        (0, 0): 1.5, (1, 0): 1.0, (1, 1): 123.45, (1, 2): -7.0, (2, 0): "teşa", (2, 1): "z", (3, 0): True,
        (3, 1): ErrorValue("#N/A"), (4, 0): "ğü",
    }  # fmt: skip


def test_stored_values_of_formulas(tmp_path):
    said = {
        b"\1\0\1\0\0\0\xff\xff": True,
        b"\2\0\x07\0\0\0\xff\xff": ErrorValue("#DIV/0!"),
        b"\3\0\0\0\0\0\xff\xff": "",
    }
    records = [xls.formula(row, 0, b"\x1e\1\0", struct.unpack("<d", data)[0]) for row, data in enumerate(said)]
    records.append(xls.formula(3, 0, b"\x1e\1\0", struct.unpack("<d", bytes(6) + b"\xff\xff")[0]))
    records.append(xls.record(0x207, struct.pack("<H", 4) + b"\0te") + xls.record(0x3C, b"\0xt"))
    sheet = sheet_of(tmp_path, *records)
    assert [sheet.cached.get(row, 0) for row in range(4)] == [*said.values(), "text"]


def test_a_shared_formula(tmp_path):
    """B2:B5 holds A2*$C$1 once; the last of them stands before the first."""
    tokens = xls.cell(0, -1, 0x4C) + xls.cell(0, 2, 0x4C, rows=False, columns=False) + b"\x05"
    cells = [xls.formula(4, 1, xls.member(1, 1)), xls.formula(1, 1, xls.member(1, 1)), xls.shared(1, 4, 1, 1, tokens)]
    cells += [xls.formula(row, 1, xls.member(1, 1)) for row in (2, 3)]
    (block,) = sheet_of(tmp_path, *cells).blocks
    assert (block.row, block.col, block.rows, block.cols) == (1, 1, 4, 1)
    assert print_formula(block.formula) == "A2*$C$1"


def test_formulas_filled_to_the_right_are_one_block(tmp_path):
    cells = [xls.formula(row, col, xls.cell(row - 1, col) + b"\x1e\2\0\x05") for row in (2, 3) for col in (4, 5, 6)]
    (block,) = sheet_of(tmp_path, *cells).blocks
    assert (block.row, block.col, block.rows, block.cols) == (2, 4, 2, 3)
    assert print_formula(block.formula) == "E2*2"


def test_an_array_formula(tmp_path):
    tokens = b"\x25" + struct.pack("<HHHH", 0, 1, 0xC000, 0xC000) + b"\x20" + bytes(7) + b"\x05"
    extra = struct.pack("<BH", 0, 1) + b"\1" + struct.pack("<d", 2.0) + b"\2\1\0\0x"
    cells = [
        xls.formula(0, 2, xls.member(0, 2), 1.0),
        xls.array(0, 1, 2, 2, tokens, extra),
        xls.formula(1, 2, xls.member(0, 2), 4.0),
    ]
    sheet = sheet_of(tmp_path, *cells)
    (block,) = sheet.blocks
    assert (block.rows, block.cols, block.kind) == (2, 1, "array")
    assert print_formula(block.formula) == 'A1:A2*{2;"x"}'
    assert [sheet.cached.get(row, 2) for row in (0, 1)] == [1.0, 4.0]


def test_marks_without_meaning_and_choices(tmp_path):
    """Spaces, jumps and brackets, as Excel writes them around IF, CHOOSE and SUM."""
    condition = (
        xls.cell(0, 0)
        + b"\x19\x02\x07\x00"
        + b"\x1e\1\0"
        + b"\x19\x08\x0a\x00"
        + b"\x16"
        + b"\x19\x08\x03\x00\x42\x03\x01\x00"
    )
    choose = b"\x1e\1\0" + b"\x19\x04\x02\x00" + bytes(6) + b"\x1e\5\0\x19\x08\0\0\x1e\6\0\x19\x08\0\0\x42\x03\x64\x00"
    total = b"\x25" + struct.pack("<HHHH", 0, 3, 0xC000, 0xC000) + b"\x19\x10\0\0" + b"\x19\x40\0\1\x15"
    sheet = sheet_of(tmp_path, *(xls.formula(9 + row, 9, code) for row, code in enumerate((condition, choose, total))))
    assert [print_formula(block.formula) for block in sheet.blocks] == ["IF(A1,1,)", "CHOOSE(1,5,6)", "SUM(A1:A4)"]


def test_names_sheets_add_ins_and_other_workbooks(tmp_path):
    own = xls.record(0x1AE, struct.pack("<HH", 2, 0x0401))
    add_in = xls.record(0x1AE, struct.pack("<HH", 1, 0x3A01)) + xls.record(
        0x23, struct.pack("<HIB", 0, 0, 7) + xls.text("EOMONTH")
    )
    other = xls.record(0x1AE, struct.pack("<HH", 1, 12) + b"\0" + b"\1\1Cdir\3a.xls" + struct.pack("<H", 1) + b"\0X")
    spans = [(0, 0, 0), (0, 0, 1), (1, 0xFFFE, 0xFFFE), (2, 0, 0), (0, 0xFFFF, 0xFFFF), (0, 0xFFFE, 0xFFFE)]
    listed = xls.record(0x17, struct.pack("<H", len(spans)) + b"".join(struct.pack("<HHH", *span) for span in spans))
    names = xls.name("k", b"\x3a" + struct.pack("<HHH", 0, 0xFFFF, 0x8000)) + xls.name("DörtÇubuk", b"", about=6)
    names += xls.name("_xlfn.IFERROR", b"\x1c\x1d", about=2) + xls.name("own", b"\x1e\3\0", sheet=2)

    def on(span):
        return b"\x5a" + struct.pack("<HHH", span, 0, 0xC000)

    def call(head):
        return head + b"\x1e\1\0" + b"\x42\2\xff\0"

    codes = [on(0), on(1), on(3), on(4), b"\x43\1\0\0\0", b"\x59\5\0\4\0\0\0", call(b"\x23\2\0\0\0"), call(b"\x23\3\0\0\0"),
             call(b"\x39\2\0\1\0\0\0")]  # fmt: skip
    cells = b"".join(xls.formula(0, col, code) for col, code in enumerate(codes))
    book = of_bytes(
        tmp_path, xls.stream(("S", xls.number(9, 9, 1.0)), ("T", cells), before=own + add_in + other + listed + names)
    )
    found = [block.formula for block in book.sheets[1].blocks]
    away, sheets, foreign, lost, name, elsewhere, macro, young, added = found
    assert print_formula(away) == "S!A1"
    assert isinstance(sheets, SheetsRef)
    assert (sheets.first, sheets.last) == ("S", "T")
    assert isinstance(foreign, Foreign)
    assert "a.xls" in foreign.text
    assert lost == ErrorValue("#REF!")
    assert (name, elsewhere) == (NameRef("k"), NameRef("own"))
    assert [part.name for part in (macro, young, added) if isinstance(part, Call)] == [
        "DÖRTÇUBUK",
        "IFERROR",
        "EOMONTH",
    ]
    assert {(n.name, n.sheet, print_formula(n.formula)) for n in book.names} == {
        ("k", None, "S!$A1048576"),
        ("own", "T", "3"),
    }


def test_whole_columns_and_rows(tmp_path):
    column = b"\x25" + struct.pack("<HHHH", 0, 65535, 0xC001, 0xC002)
    row = b"\x25" + struct.pack("<HHHH", 3, 3, 0xC000, 0xC0FF)
    sheet = sheet_of(tmp_path, xls.formula(5, 9, column), xls.formula(6, 9, row))
    assert [block.formula for block in sheet.blocks] == [parse_formula("B:C"), parse_formula("4:4")]


def test_rows_that_a_filter_hides(tmp_path):
    hidden = b"".join(xls.record(0x208, struct.pack("<HHHHHHI", row, 0, 1, 255, 0, 0, 0x20)) for row in (2, 3, 8))
    own = xls.record(0x1AE, struct.pack("<HH", 1, 0x0401)) + xls.record(0x17, struct.pack("<HHHH", 1, 0, 0, 0))
    area = xls.name("\x0d", b"\x3b" + struct.pack("<HHHHH", 0, 0, 5, 0, 2), sheet=1, about=0x21)
    cells = xls.record(0x9B) + hidden + xls.number(0, 0, 1.0)
    book = of_bytes(tmp_path, xls.stream(("S", cells), before=own + area))
    assert (book.sheets[0].hidden, book.sheets[0].filtered) == ([(2, 4), (8, 9)], [(2, 4)])
    assert book.names == []


UNREADABLE = {
    "a macro's function": b"\x42\0\x36\x80",
    "unknown function": b"\x42\0\xf0\x0f",
    "too few operands": b"\x03",
    "too many operands": b"\x1e\1\0\x1e\1\0",
    "no such name": b"\x43\x09\0\0\0",
    "no such sheets": b"\x5a" + bytes(6),
    "too deep": b"\x1e\1\0" + b"\x13" * 100,
    "array without constants": b"\x20" + bytes(7),
    "cut off": b"\x1f\0",
    "no such token": b"\x7f\0",
    "a label": b"\x18\2" + bytes(4),
    "nothing": b"",
}


@pytest.mark.parametrize("name", UNREADABLE)
def test_a_formula_that_cannot_be_read_keeps_its_value(tmp_path, name):
    book = of_bytes(
        tmp_path, xls.stream(("S", xls.formula(0, 0, UNREADABLE[name], 4.5) + xls.formula(1, 0, b"\x1d\1")))
    )
    (sheet,) = book.sheets
    assert sheet.constants.get(0, 0) == 4.5
    assert [(fault.key, "stored values are kept" in fault.message) for fault in book.remarks] == [("S!A1", True)]
    assert [block.formula for block in sheet.blocks] == [Boolean(True)]


def test_a_what_if_table_keeps_its_values(tmp_path):
    table = xls.record(0x236, struct.pack("<HHBBHHHHH", 1, 2, 1, 1, 0, 0, 0, 0, 0))
    cells = [
        xls.formula(row, 1, b"\2" + struct.pack("<HH", 1, 1), row * 1.5) + (table if row == 1 else b"")
        for row in (1, 2)
    ]
    book = of_bytes(tmp_path, xls.stream(("S", b"".join(cells))))
    assert [book.sheets[0].constants.get(row, 1) for row in (1, 2)] == [1.5, 3.0]
    assert "the what-if table B2" in book.remarks[0].message


@pytest.mark.parametrize("small", [True, False])
def test_the_container(tmp_path, small):
    data = xls.stream(("S", b"".join(xls.number(row, 0, float(row)) for row in range(100))))
    assert len(data) < 4096
    book = of_bytes(tmp_path, xls.compound(data, small=small))
    assert book.sheets[0].constants.get(99, 0) == 99.0
    assert book.macros == ""


@pytest.mark.slow
def test_whatever_is_broken_is_told(tmp_path):
    """Bytes changed at random, in the container and in the stream: a workbook, or an error in words."""
    rng = np.random.default_rng(3)
    tokens = xls.cell(0, -1, 0x4C) + xls.cell(0, 2) + b"\x05\x17\2\0ab\x08"
    cells = b"".join(xls.formula(row, 1, tokens) for row in range(4)) + xls.shared(5, 9, 1, 1, tokens)
    data = xls.stream(("S", cells), ("T", xls.number(0, 0, 1.0)), before=xls.name("k", b"\x1e\1\0"))
    whole = {"stream": data, "container": xls.compound(data), "small": xls.compound(data, small=True)}
    ends = {"read": 0, "told": 0}
    for original in whole.values():
        for _ in range(300):
            broken = bytearray(original)
            for place in rng.integers(0, min(len(broken), 2600), 3):
                broken[place] = rng.integers(0, 256)
            try:
                of_bytes(tmp_path, bytes(broken))
                ends["read"] += 1
            except WorkbookError:
                ends["told"] += 1
    assert min(ends.values()) > 100

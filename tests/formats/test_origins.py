"""Workbooks as different programs write them: read alike, computed alike, written back with everything but values kept."""

from __future__ import annotations

import datetime
import re
import zipfile
from pathlib import Path

import openpyxl
import pytest
import xlsxwriter
from openpyxl.chart import LineChart, Reference
from openpyxl.comments import Comment
from openpyxl.workbook.defined_name import DefinedName

from livesheet.formats import read
from livesheet.formula.nodes import ErrorValue
from mechsheet.checking.programs import convert_with_libreoffice
from mechsheet.library.recalculation import recalc

VBA = bytes(range(256)) * 20

FORMULAS = {
    "B1": ("=A1*2", 6.0),
    "B2": ("=SUM(C:C)", 24.0),
    "B3": ("=SUM('It''s odd'!$A$1:A2)", 30.0),
    "B4": ('=IF(A5,"yes "&A4,"no")', "yes  two  spaces"),
    "B5": ("=A5", True),
    "B6": ("=1/0", ErrorValue("#DIV/0!")),
    "B7": ("=rate*100", 25.0),
    "B8": ("=double+1", 1.5),
    "B9": ("=A9+1", 45352.0),
    "B10": ("=A3&COUNTA(A1:A11)", "1.510"),
    "B11": ('=SUMPRODUCT((A1:A3>1)*A1:A3)+COUNTIF(A1:A4,">1")', 13.5),
    "B12": ("=INDEX(A1:A3,MATCH(6,A1:A3,0))+C1", 12.0),
    "B13": ("=-2^2+5%", 4.05),
    "B14": ('=TEXT(A3,"0.00")&CHAR(10)&"x"', "1.50\nx"),
    "B15": ("=ISBLANK(A12)", True),
}
CONSTANTS = {
    "A1": 3, "A2": 6, "A3": 1.5, "A4": " two  spaces", "A5": True, "A6": 'a <tag> & "quotes"',
    "A7": "line\nbreak", "A8": "ÇığŞ θ", "A9": datetime.date(2024, 2, 29), "C1": 6,
}  # fmt: skip


def by_xlsxwriter(path: Path) -> Path:
    """With a merged cell, a hidden sheet, a sheet of charts, rich text, a name of one sheet, an array formula."""
    with xlsxwriter.Workbook(path, {"default_date_format": "yyyy-mm-dd"}) as workbook:
        sheet = workbook.add_worksheet("Main")
        chart = workbook.add_chart({"type": "line"})
        chart.add_series({"values": "=Main!$A$1:$A$3"})
        workbook.add_chartsheet("Chart").set_chart(chart)
        other = workbook.add_worksheet("It's odd")
        other.write_column("A1", [10, 20])
        other.hide()
        workbook.define_name("rate", "=0.25")
        workbook.define_name("Main!double", "=2*rate")
        workbook.define_name("double", "=99")
        for place, value in CONSTANTS.items():
            sheet.write(place, value)
        for place, (formula, value) in FORMULAS.items():
            sheet.write_formula(place, formula, None, str(value) if isinstance(value, ErrorValue) else value)
        bold = workbook.add_format({"bold": True})
        sheet.write_rich_string("A11", bold, "rich", " text")
        sheet.merge_range("D1:E3", "merged", bold)
        sheet.write_array_formula("C2:C3", "{=A1:A2*2}", None, 6)
        sheet.write_number("C3", 12)
        sheet.write_comment("A1", "a comment")
        sheet.data_validation("A1", {"validate": "integer", "criteria": ">", "value": 0})
        sheet.conditional_format("B1:B9", {"type": "cell", "criteria": ">", "value": 5, "format": bold})
    return path


def by_openpyxl(path: Path) -> Path:
    """Without stored values, with texts inside the cells."""
    workbook = openpyxl.Workbook()
    sheet, other = workbook.active, workbook.create_sheet("It's odd")
    sheet.title = "Main"
    other["A1"], other["A2"] = 10, 20
    other.sheet_state = "hidden"
    workbook.defined_names["rate"] = DefinedName("rate", attr_text="0.25")
    workbook.defined_names["double"] = DefinedName("double", attr_text="99")
    sheet.defined_names["double"] = DefinedName("double", attr_text="2*rate")
    for place, value in CONSTANTS.items():
        sheet[place] = value
    for place, (formula, _) in FORMULAS.items():
        sheet[place] = formula
    sheet["A11"] = "rich text"
    sheet["D1"] = "merged"
    sheet.merge_cells("D1:E3")
    sheet["A1"].comment = Comment("a comment", "me")
    sheet["C2"] = openpyxl.worksheet.formula.ArrayFormula("C2:C3", "=A1:A2*2")
    chart = LineChart()
    chart.add_data(Reference(sheet, min_col=1, min_row=1, max_row=3))
    sheet.add_chart(chart, "G2")
    workbook.save(path)
    return path


def strict(source: Path, path: Path) -> Path:
    """As ISO 29500 strict has it: other namespaces, dates as texts, targets from the root."""
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(path, "w") as new:
        for name in old.namelist():
            text = old.read(name).decode("utf-8")
            text = text.replace(
                "http://schemas.openxmlformats.org/spreadsheetml/2006/", "http://purl.oclc.org/ooxml/spreadsheetml/"
            )
            text = text.replace(
                "http://schemas.openxmlformats.org/officeDocument/2006/", "http://purl.oclc.org/ooxml/officeDocument/"
            )
            if name == "xl/_rels/workbook.xml.rels":
                text = text.replace('Target="', 'Target="/xl/')
            if name == "xl/worksheets/sheet1.xml":
                text, count = re.subn(r'(<c r="A9"[^>]*)><v>45351</v>', r'\1 t="d"><v>2024-02-29</v>', text)
                assert count == 1
            new.writestr(name, text)
    return path


def wrong(path: Path) -> dict[str, object]:
    """Cells of Main that are not what they must be: {cell: (found, wanted)}."""
    result = recalc(path)
    assert result.remarks == ()
    cells = result.as_dict()["Main"]
    wanted = {place: str(value) if isinstance(value, ErrorValue) else value for place, (_, value) in FORMULAS.items()}
    wanted |= {
        "C2": 6.0,
        "C3": 12.0,
        "A9": 45351.0,
        "A7": "line\nbreak",
        "A11": "rich text",
        "A8": "ÇığŞ θ",
        "D1": "merged",
    }
    return {
        place: (cells.get(place), value)
        for place, value in wanted.items()
        if cells.get(place) != (pytest.approx(value) if isinstance(value, float) else value)
    }


@pytest.mark.parametrize("make", [by_xlsxwriter, by_openpyxl])
def test_computed_alike(make, tmp_path):
    assert wrong(make(tmp_path / "book.xlsx")) == {}


def test_strict(tmp_path):
    assert wrong(strict(by_xlsxwriter(tmp_path / "book.xlsx"), tmp_path / "strict.xlsx")) == {}


def test_stored_values_agree(tmp_path):
    stored = recalc(by_xlsxwriter(tmp_path / "book.xlsx")).compare_with_stored()
    assert stored.differences == ()
    assert (stored.formulas, stored.equal) == (len(FORMULAS) + 2, len(FORMULAS) + 2)


@pytest.fixture(scope="module")
def saved_as_ods(tmp_path_factory):
    """Both, as .xlsx and as LibreOffice saves them as .ods."""
    folder = tmp_path_factory.mktemp("ods")
    sources = [by_xlsxwriter(folder / "writer.xlsx"), by_openpyxl(folder / "openpyxl.xlsx")]
    return sources, convert_with_libreoffice(sources, "ods", folder)


@pytest.mark.ci
@pytest.mark.libreoffice
def test_what_libreoffice_makes_of_them(saved_as_ods, tmp_path):
    """Both formats, saved by LibreOffice: our values, and its own."""
    sources, as_ods = saved_as_ods
    for saved in (as_ods, convert_with_libreoffice(sources, "xlsx", tmp_path)):
        for path in saved:
            assert wrong(path) == {}, path
            stored = recalc(path).compare_with_stored()
            assert stored.differences == (), path
            assert stored.equal == stored.formulas >= len(FORMULAS) + 2  # LibreOffice writes TRUE as a formula
            assert {name.sheet for name in read(path).names if name.name == "double"} == {"Main", None}


@pytest.mark.ci
@pytest.mark.libreoffice
def test_written_back_libreoffice_opens_it(saved_as_ods, tmp_path):
    """Its own files and ours, with another input: LibreOffice computes what was written."""
    sources, as_ods = saved_as_ods
    written = []
    for path in (sources[0], as_ods[0]):
        result = recalc(path, {"Main!A1": 30, "Main!A4": "sir"})
        output = tmp_path / f"new-{path.suffix[1:]}{path.suffix}"
        result.write(output)
        written.append(output)
        assert read(output).sheets[0].cached.get(0, 1) == 60.0
    (tmp_path / "again").mkdir()
    for again in convert_with_libreoffice(written, "xlsx", tmp_path / "again"):
        sheet = openpyxl.load_workbook(again, data_only=True)["Main"]
        assert [sheet[place].value for place in ("A1", "B1", "B4", "C2")] == [30, 60, "yes sir", 60]


def test_macros_and_whatever_else_is_inside(tmp_path):
    """An .xlsm: every other part byte for byte, packed as it was."""
    plain, source, output = (tmp_path / name for name in ("plain.xlsx", "book.xlsm", "new.xlsm"))
    by_xlsxwriter(plain)
    with zipfile.ZipFile(plain) as old, zipfile.ZipFile(source, "w", zipfile.ZIP_DEFLATED, compresslevel=1) as new:
        for name in old.namelist():
            data = old.read(name)
            if name == "[Content_Types].xml":
                data = data.replace(
                    b"application/vnd.openxmlformats-officedocument.spreadsheetml.sheet.main+xml",
                    b"application/vnd.ms-excel.sheet.macroEnabled.main+xml",
                ).replace(
                    b"<Override",
                    b'<Default Extension="bin" ContentType="application/vnd.ms-office.vbaProject"/><Override',
                    1,
                )
            if name == "xl/_rels/workbook.xml.rels":
                data = data.replace(
                    b"</Relationships>",
                    b'<Relationship Id="rId99" Type="http://schemas.microsoft.com/office/2006/relationships/vbaProject"'
                    b' Target="vbaProject.bin"/></Relationships>',
                )
            new.writestr(name, data)
        new.writestr("xl/vbaProject.bin", VBA)
        new.writestr("customXml/item1.xml", "<mine/>", zipfile.ZIP_STORED)
    result = recalc(source, {"Main!A1": 4})
    result.write(output)
    with zipfile.ZipFile(source) as old, zipfile.ZipFile(output) as new:
        assert old.namelist() == new.namelist()
        changed = [name for name in old.namelist() if old.read(name) != new.read(name)]
        assert changed == ["xl/worksheets/sheet1.xml"]
        assert new.read("xl/vbaProject.bin") == VBA
        for name in set(old.namelist()) - set(changed):
            assert old.getinfo(name).compress_size == new.getinfo(name).compress_size, name
    again = openpyxl.load_workbook(output, keep_vba=True)
    assert again["Main"]["B1"].value == "=A1*2"
    assert again["Main"]["A1"].comment.text == "a comment"
    again.vba_archive.close()  # openpyxl leaves it open
    assert openpyxl.load_workbook(output, data_only=True)["Main"]["B1"].value == 8

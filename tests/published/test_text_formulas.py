"""The text's own formulas, pasted into our workbooks: named cells hold what the text's cells hold, in its units."""

import math
import zipfile

import openpyxl
import pytest
from printed_numbers import TEMPLATES

import mechsheet
from command_line import run
from mechsheet.description import load
from mechsheet.library.building import build
from mechsheet.library.recalculation import recalc

pytestmark = pytest.mark.slow

LEVER = "=KolKızak(Krank,SabitUzuv,(RADIANS(A{row})-Alfa1))+Alfa1-PI()/2"
OUTPUT = "=DörtÇubuk(Krank2,Biyel,ÇıkışUzvu,SabitUzuv4,1,B{row}+Alfa2p)-Alfa2p"


@pytest.fixture(scope="module")
def pasted(tmp_path_factory):
    """A sheet of one's own in the five-link's workbook: the angles, and the text's formulas filled down."""
    folder = tmp_path_factory.mktemp("fivelink")
    (path,) = build(load(TEMPLATES / "fivelink.toml"), folder)
    book = openpyxl.load_workbook(path)
    sheet = book.create_sheet("Ders")
    for row in range(1, 20):
        sheet[f"A{row}"] = 20 * (row - 1)
        sheet[f"B{row}"] = LEVER.format(row=row)
        sheet[f"C{row}"] = OUTPUT.format(row=row)
    book.save(folder / "pasted.xlsx")
    return folder / "pasted.xlsx"


def test_the_texts_formulas_give_the_angles_of_the_workbook(pasted):
    values = recalc(pasted)
    found = values.table(values.area("Ders!B1:C19"))
    ours = zip(*(values.table(values.area(f"Konumlar!{column}4:{column}22")) for column in "LV"), strict=True)
    for row, wanted in zip(found, ours, strict=True):
        for angle, (degrees,) in zip(row, wanted, strict=True):
            assert math.remainder(angle - math.radians(degrees), math.tau) == pytest.approx(0.0, abs=1e-12)
    assert found[0] == pytest.approx([1.83476, 1.86892], abs=5e-6)


def test_that_they_are_the_texts_is_said(pasted):
    result = run("recalc", pasted, "--strict", "--print", "Ders!B1")
    assert result.exit_code == 0, result.output
    assert "DörtÇubuk, KolKızak: computed as the textbook's functions" in result.stderr
    result = run("check", pasted)
    assert "DörtÇubuk, KolKızak: computed as the textbook's functions" in result.stdout


def test_they_follow_what_is_set(pasted):
    """A session, and `--set`: nothing is kept that does not follow."""
    book = mechsheet.open_book(pasted)
    before = book["Ders!B3"]
    book["Krank"] = 600
    assert book["Ders!B3"] != before
    assert book["Ders!B3"] == recalc(pasted, {"Krank": 600}).get("Ders", 2, 1)


@pytest.mark.parametrize(("stored", "value"), [("", 5.0), ("5", 5.0), ("7", 7.0)])
def test_a_function_of_another_meaning_keeps_its_values(tmp_path, stored, value):
    """Boy is somebody's own where the file holds another number than the textbook's function gives."""
    book = openpyxl.Workbook()
    book.active["A1"], book.active["B1"] = 3, "=Boy(A1,4)"
    book.save(tmp_path / "plain.xlsx")
    with zipfile.ZipFile(tmp_path / "plain.xlsx") as old, zipfile.ZipFile(tmp_path / "own.xlsx", "w") as new:
        for name in old.namelist():
            text = old.read(name)
            if name == "xl/worksheets/sheet1.xml":
                empty = b"<v />" if b"<v />" in text else b"<v></v>"
                assert text.count(empty) == 1
                text = text.replace(empty, f"<v>{stored}</v>".encode() if stored else b"")
            new.writestr(name, text)
    result = recalc(tmp_path / "own.xlsx")
    assert result.get("Sheet", 0, 1) == value
    assert ("stored values are kept" in str(result.remarks)) == (value == 7.0)

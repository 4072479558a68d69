"""Names and sheet titles in other alphabets, with spaces and apostrophes, in both formats and every program."""

from __future__ import annotations

import math
import shutil
import subprocess

import pytest

from livesheet.engine import evaluate
from livesheet.evaluation import computed
from livesheet.formats import read, write
from livesheet.formula.nodes import Binary, Call, CellRef, NameRef, Number, RangeRef, Text
from livesheet.workbook import Cell, Fill, Name, Properties, Sheet, Workbook
from mechsheet.checking.books_compared import compare_twins
from mechsheet.checking.cells import compare_cells
from mechsheet.checking.programs import convert_with_libreoffice, stored_values

TITLES = ("Ömer'in çizelgesi", "Αρχική θέση", "Лист 1", "表 (二)", "A1", "1. satır", "it''s & <so>", "R1C1", "TRUE")
NAMES = ("ÇıkışUzvu", "Açı1", "Δθ", "x₂", "ШАГ", "ölçü.A_1", "_başlangıç", "Ğğ")
STEPS = 12


def workbook() -> Workbook:
    """Each sheet holds one named input and a column computed from it; the last column adds up the sheet before."""
    sheets = []
    for n, title in enumerate(TITLES):
        before = TITLES[n - 1]
        cells = [Cell(0, 0, f"{title} → {NAMES[n % len(NAMES)]}"), Cell(1, 0, 30.0 + n)]
        cells += [Cell(3 + row, 0, float(15 * row)) for row in range(STEPS)]
        angle = Binary("+", CellRef(3, 0, col_abs=True), NameRef(NAMES[n % len(NAMES)]))
        fills = [Fill(3, 1, Call("SIN", (Call("RADIANS", (angle,)),)), rows=STEPS)]
        fills.append(Fill(3, 2, Binary("*", Number(2.0), CellRef(3, 1, False, True)), rows=STEPS))
        if n:
            area = RangeRef(CellRef(3, 1, True, True, before), CellRef(2 + STEPS, 1, True, True, before))
            there = Binary("&", CellRef(0, 0, True, True, before), Text(" ı İ"))
            fills += [Fill(1, 1, Call("SUM", (area,))), Fill(1, 2, there)]
            fills.append(Fill(3, 3, Binary("-", CellRef(3, 1, sheet=before), CellRef(3, 1)), rows=STEPS))
        sheets.append(Sheet(title, cells=tuple(cells), fills=tuple(fills)))
    names = tuple(Name(name, TITLES[n], 1, 0) for n, name in enumerate(NAMES))
    return computed(Workbook(tuple(sheets), names=names, properties=Properties(title="Çizelge", language="tr")))


@pytest.fixture(scope="module")
def twins(tmp_path_factory):
    folder = tmp_path_factory.mktemp("letters")
    paths = [folder / "türkçe.xlsx", folder / "türkçe.ods"]
    for path in paths:
        write(workbook(), path)
    return paths


def test_both_are_read_as_they_were_meant(twins):
    books = [read(path) for path in twins]
    for book in books:
        assert tuple(sheet.title for sheet in book.sheets) == TITLES
        assert {name.name for name in book.names} == set(NAMES)
        assert compare_cells("stored", book, evaluate(book), stored_values_of(book)).agrees
    assert evaluate(books[1]).get("Лист 1", 3, 1) == pytest.approx(math.sin(math.radians(32)))
    assert compare_twins(*books, "twin").agrees


def stored_values_of(book):
    return lambda title, row, col: book.sheet(title).cached.get(row, col)


@pytest.mark.ci
@pytest.mark.libreoffice
def test_libreoffice(twins, tmp_path):
    sources = [shutil.copy(path, tmp_path / f"{path.stem}-{path.suffix[1:]}{path.suffix}") for path in twins]
    (tmp_path / "answers").mkdir()
    for path, answer in zip(twins, convert_with_libreoffice(sources, "xlsx", tmp_path / "answers"), strict=True):
        book = read(path)
        found = compare_cells("libreoffice", book, evaluate(book), stored_values(answer).get)
        assert found.agrees, found
        assert {name.name for name in read(answer).names} == set(NAMES)


@pytest.mark.gnumeric
def test_gnumeric(twins, tmp_path):
    # Not from the .xlsx: gnumeric cannot read a sheet's name with an apostrophe there.
    answer = tmp_path / "answer.ods"
    subprocess.run([shutil.which("ssconvert"), "--recalc", twins[1], answer], check=True, capture_output=True)
    book = read(twins[1])
    found = compare_cells("gnumeric", book, evaluate(book), stored_values(answer).get)
    assert found.agrees, found

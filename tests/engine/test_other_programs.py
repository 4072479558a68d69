"""The case files computed by other programs. Where they differ from Excel, the difference is listed with its value."""

import subprocess

import openpyxl
import pytest
from openpyxl.worksheet.formula import ArrayFormula

from engine_cases import COLUMN, FILES, FIRST_ROW, FOLDER, answered, cases, cells, load, same, scalar
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from mechsheet.checking.programs import convert_with_libreoffice

pytestmark = pytest.mark.slow

CASES = cases()
DIFFERENCES = load(FOLDER / "differences.toml")
ARRAYS = {path.stem for path in FILES if load(path).get("arrays")}
"""Case files whose formulas are array formulas in other programs, which else take one cell of an array."""


@pytest.fixture(scope="module")
def workbook(tmp_path_factory):
    """All cases in one file without stored values, so that every program computes them."""
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "S"
    for row, col, value in cells():
        cell = sheet.cell(row + 1, col + 1)
        if isinstance(value, ErrorValue):
            cell.value, cell.data_type = value.code, "e"
        elif value == "":
            cell.value = '=""'
        else:
            cell.value = value
            cell.data_type = "s" if isinstance(value, str) else cell.data_type
    for row, (file, formula, _) in enumerate(CASES, FIRST_ROW):
        cell, shown = sheet.cell(row + 1, COLUMN + 1), "=" + print_formula(parse_formula(formula))
        cell.value = ArrayFormula(cell.coordinate, shown) if file in ARRAYS else shown
    path = tmp_path_factory.mktemp("cases") / "cases.xlsx"
    book.save(path)
    return path


def answers(path):
    """The values of the cases in a file, empty cells as the empty text."""
    sheet = openpyxl.load_workbook(path, data_only=True)["S"]
    for row, (_, formula, value) in enumerate(CASES, FIRST_ROW):
        found = answered(sheet.cell(row + 1, COLUMN + 1).value)
        yield formula, value, found


def disagreements(path, program):
    own = load(FOLDER / f"differences_{program}.toml")["values"]
    known = {formula: scalar(value) for formula, value in (own | DIFFERENCES[program]).items()}
    for formula, value, found in answers(path):
        expected = known.get(formula, value)
        if expected == "*" or agree(expected, found):
            continue
        yield formula, value, found


def agree(expected, found):
    """Any error is as good as any other: programs name the same fault differently. An empty result may stand for 0."""
    if isinstance(expected, ErrorValue) and isinstance(found, ErrorValue):
        return True
    return same(expected, found, 1e-9) or (expected == 0.0 and found == "")


@pytest.mark.libreoffice
def test_libreoffice(workbook, tmp_path):
    (path,) = convert_with_libreoffice([workbook], "xlsx", tmp_path)
    assert list(disagreements(path, "libreoffice")) == []


@pytest.mark.gnumeric
def test_gnumeric(workbook, tmp_path):
    path = tmp_path / "gnumeric.xlsx"
    subprocess.run(["ssconvert", "--recalc", str(workbook), str(path)], check=True, capture_output=True)
    with pytest.warns(UserWarning, match="no default style"):
        assert list(disagreements(path, "gnumeric")) == []

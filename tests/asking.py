"""What other programs give for formulas: all of them in one workbook, each program started once."""

import subprocess
import tempfile
from pathlib import Path

import openpyxl
from openpyxl.worksheet.formula import ArrayFormula

from engine_cases import COLUMN, FIRST_ROW, answered, same
from livesheet.engine import evaluate
from livesheet.formula.book import BookBuilder
from livesheet.formula.nodes import ErrorValue
from livesheet.formula.parser import parse_formula
from livesheet.formula.printer import print_formula
from mechsheet.checking.programs import answers, convert_with_libreoffice

PROGRAMS = ("ironcalc", "gnumeric", "libreoffice")


def workbook(formulas: list[str], grid, path: Path, arrays: bool) -> None:
    """All formulas in one file without stored values."""
    book = openpyxl.Workbook()
    sheet = book.active
    sheet.title = "S"
    for row, col, value in grid:
        cell = sheet.cell(row + 1, col + 1)
        if isinstance(value, ErrorValue):
            cell.value, cell.data_type = value.code, "e"
        elif value == "":
            cell.value = '=""'
        else:
            cell.value = value
            cell.data_type = "s" if isinstance(value, str) else cell.data_type
    for row, formula in enumerate(formulas, FIRST_ROW):
        cell = sheet.cell(row + 1, COLUMN + 1)
        shown = "=" + print_formula(parse_formula(formula))
        cell.value = ArrayFormula(cell.coordinate, shown) if arrays else shown
    book.save(path)


def asked(formulas: list[str], grid, programs=PROGRAMS, arrays: bool = True) -> dict[str, list[object]]:
    """What each program gives for each formula; as array formulas, but in ironcalc, which has none."""
    found: dict[str, list[object]] = {}
    with tempfile.TemporaryDirectory() as folder:
        for program in programs:
            path = Path(folder) / f"{program}.xlsx"
            workbook(formulas, grid, path, arrays and program != "ironcalc")
            rows = range(FIRST_ROW, FIRST_ROW + len(formulas))
            if program == "ironcalc":
                given = answers(program, path)
                found[program] = [given.get("S", row, COLUMN) for row in rows]
                continue
            result = Path(folder) / "answers" / f"{program}.xlsx"
            result.parent.mkdir(exist_ok=True)
            if program == "gnumeric":
                subprocess.run(["ssconvert", "--recalc", str(path), str(result)], check=True, capture_output=True)
            else:
                convert_with_libreoffice([path], "xlsx", result.parent)
            sheet = openpyxl.load_workbook(result, data_only=True)["S"]
            found[program] = [answered(sheet.cell(row + 1, COLUMN + 1).value) for row in rows]
    return found


def ours(formulas: list[str], grid) -> list[object]:
    """What the engine gives."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    for row, col, value in grid:
        sheet.constant(row, col, value)
    for row, formula in enumerate(formulas, FIRST_ROW):
        sheet.block(row, COLUMN, 1, 1, parse_formula(formula))
    values = evaluate(builder.build())
    return [values.get("S", row, COLUMN) for row in range(FIRST_ROW, FIRST_ROW + len(formulas))]


def agree(mine: object, other: object) -> bool:
    """Equal values, any errors; an empty text may stand for nothing."""
    if isinstance(mine, ErrorValue) and isinstance(other, ErrorValue):
        return True
    if isinstance(mine, float) and isinstance(other, int) and not isinstance(other, bool):
        other = float(other)
    if mine in ("", 0.0) and other in (None, ""):
        return True
    return same(mine, other, 1e-9)


def outvoted(value: object, given: dict[str, object]) -> bool:
    """Whether two programs agree on another value."""
    others = [other for other in given.values() if not agree(value, other) and str(other) not in ("#NAME?", "#N/IMPL!")]
    return any(agree(a, b) for i, a in enumerate(others) for b in others[i + 1 :])


def code_agrees(value: object, given: dict[str, object]) -> bool:
    """Whether ironcalc or gnumeric name the same error, where they name one."""
    if not isinstance(value, ErrorValue):
        return True
    codes = {
        other.code for program, other in given.items() if isinstance(other, ErrorValue) and program != "libreoffice"
    }
    return not codes or value.code in codes

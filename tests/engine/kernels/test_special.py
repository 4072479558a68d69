"""Special functions and distributions against values of 60 digits; SciPy, which computes most of them, and what it costs."""

import subprocess
import sys
import time

import openpyxl
import pytest

from asking import ours
from engine_cases import FOLDER, load
from livesheet.engine import evaluate
from livesheet.formula.book import BookBuilder
from livesheet.formula.parser import parse_formula

CASES = load(FOLDER / "special" / "mpmath.toml")["cases"]

EXPECTED_DIGITS = 2e-13
"""Far out in the tails of distributions with large parameters; elsewhere it is nearer to 1e-14."""


@pytest.fixture(scope="module")
def found():
    return ours([formula for formula, _ in CASES], [])


@pytest.mark.slow
def test_special_functions(found):
    wrong = [
        (formula, value, mine)
        for (formula, value), mine in zip(CASES, found, strict=True)
        if not (isinstance(mine, float) and abs(mine - value) <= EXPECTED_DIGITS * abs(value))
    ]
    assert wrong == []


@pytest.mark.slow
def test_most_have_fourteen_digits(found):
    good = sum(abs(mine - value) <= 2e-14 * abs(value) for (_, value), mine in zip(CASES, found, strict=True))
    assert good >= 0.95 * len(CASES)


def _filled_down(formula, rows):
    """The values of a formula beside `rows` numbers between 0 and 1 in column A."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    sheet.constants.extend(0, 0, [(row + 1) / (rows + 1) for row in range(rows)])
    sheet.block(0, 1, rows, 1, parse_formula(formula))
    return evaluate(builder.build()).column("S", 1, 0, rows - 1)


@pytest.mark.parametrize("formula", ["BETA.INV(A1,2.5,3.5)", "T.INV(A1,7)"])
def test_a_long_column_takes_no_time(formula):
    """Cell by cell these took 9 and 16 seconds."""
    start = time.process_time()
    values = _filled_down(formula, 36_001)
    assert time.process_time() - start < 3
    assert len(set(values)) > 100


def test_wrong_cells_of_a_column_leave_the_others_alone():
    """Errors, texts, truth values and parameters out of range, each in its own cell."""
    builder = BookBuilder()
    sheet = builder.sheet("S")
    column = [0.5, "x", True, -1.0, "0.5", None, 2.0, 0.975]
    sheet.constants.extend(0, 0, column)
    flags = [True, "x", "FALSE", 0.0, 1.0, None, "true", False]
    sheet.constants.extend(0, 1, flags)
    sheet.block(0, 2, len(column), 1, parse_formula("T.INV(A1,1)"))
    sheet.block(0, 3, len(column), 1, parse_formula("EXPON.DIST(1,1,B1)"))
    values = evaluate(builder.build())
    shown = [getattr(value, "code", value) for value in values.column("S", 2, 0, len(column) - 1)]
    assert shown[:7] == [0, "#VALUE!", "#NUM!", "#NUM!", 0, "#NUM!", "#NUM!"]
    assert shown[7] == pytest.approx(12.706204736174694, rel=1e-14)
    below, density = 0.6321205588285577, 0.36787944117144233
    shown = [getattr(value, "code", value) for value in values.column("S", 3, 0, len(flags) - 1)]
    assert [value if isinstance(value, str) else round(value, 12) for value in shown] == [
        value if isinstance(value, str) else round(value, 12)
        for value in (below, "#VALUE!", density, density, below, density, below, density)
    ]


@pytest.mark.slow
def test_who_builds_a_mechanism_does_not_wait_for_scipy(tmp_path):
    code = (
        "import sys; from mechsheet.cli import main\n"
        f"try: main(['build', 'templates/four-bar.toml', '-o', {str(tmp_path / 'four-bar.xlsx')!r}])\n"
        "except SystemExit as end: assert not end.code\n"
        "print(any(name.partition('.')[0] == 'scipy' for name in sys.modules))"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert ran.stdout.split()[-1] == "False"


@pytest.mark.slow
def test_without_scipy_its_functions_keep_their_stored_values_and_say_what_is_missing(tmp_path):
    """The bare install: a workbook with one NORM.DIST is recalculated all the same."""
    book = openpyxl.Workbook()
    sheet = book.active
    sheet["A1"], sheet["B1"], sheet["C1"], sheet["D1"] = 0.5, "=NORM.S.INV(A1)+1", "=B1*2", "=ERF(A1)+GAMMA(5)"
    book.save(tmp_path / "book.xlsx")
    code = (
        "import sys; sys.modules['scipy'] = None\n"
        "import mechsheet\n"
        f"found = mechsheet.recalc({str(tmp_path / 'book.xlsx')!r})\n"
        "cells = found.as_dict()['Sheet']\n"
        "print([cells[cell] for cell in ('B1', 'C1', 'D1')])\n"
        "print(found.remarks)"
    )
    ran = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    values, remarks = ran.stdout.splitlines()
    assert values.startswith("['#NAME?', '#NAME?', 24.52"), "nothing is stored; what needs no scipy is computed"
    assert "NORM.S.INV needs scipy, which is not installed" in remarks
    assert "pip install scipy" in remarks

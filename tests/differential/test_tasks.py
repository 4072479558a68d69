"""Workbooks of random tasks of synthesis, in the programs that people open them with; and a task typed into one of them.

Built lean (no drawing, no rates): what is asked here is the synthesis.
"""

import contextlib
import itertools
import re
import shutil
import subprocess

import openpyxl
import pytest

from chosen import ALL
from livesheet.engine import evaluate
from livesheet.formats import read, update_values, write
from mechsheet.checking.cells import compare_program
from mechsheet.checking.inputs import description_in, plan_inside
from mechsheet.checking.programs import convert_with_libreoffice, stored_values
from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechanismError
from mechsheet.library import changed
from mechsheet.library.building import FORMATS, compile_workbook
from mechsheet.synthesis.kinds import KINDS
from synthesis_tasks import description, task

pytestmark = pytest.mark.slow

COUNT = 20 if ALL else 1
"""Of each kind: the formulas of a kind are the same whatever the numbers are."""

LEAN = ((r"(?m)^speed = .*\n", ""), (r"\Z", "[workbook]\ndrawing = false\n"))
"""What makes a packaged description small: pattern, what stands in its place."""


def lean(asked):
    text = description(asked)
    for pattern, new in LEAN:
        text = re.sub(pattern, new, text, count=1)
    return text


def workbooks(folder, count=COUNT, suffix="xlsx"):
    """So many files of each kind, of the first tasks that have a solution: others are refused when they are built."""
    folder.mkdir(exist_ok=True)
    paths = []
    for kind in KINDS:
        for seed in itertools.count():
            path = folder / f"{kind}-{seed}.{suffix}"
            with contextlib.suppress(MechanismError):
                write(compile_workbook(loads(lean(task(kind, seed))))[0], path)
                paths.append(path)
            if sum(made.name.startswith(f"{kind}-") for made in paths) == count:
                break
    return paths


def compared(judge, source, answer):
    """What the program that wrote `answer` computed from `source`, cell by cell, with what the engine computes."""
    book = read(source)
    plan = plan_inside(description_in(book), source.name)
    return compare_program(judge, book, evaluate(book), stored_values(answer).get, plan, source.name)


@pytest.mark.ci
@pytest.mark.libreoffice
def test_libreoffice_computes_them(tmp_path):
    (tmp_path / "answers").mkdir()
    sources = workbooks(tmp_path / "ods", suffix="ods")
    for source, answer in zip(sources, convert_with_libreoffice(sources, "xlsx", tmp_path / "answers"), strict=True):
        found = compared("libreoffice", source, answer)
        assert found.agrees, (source.name, found)


@pytest.mark.ci
@pytest.mark.gnumeric
def test_gnumeric_computes_them(tmp_path):
    for source in workbooks(tmp_path / "xlsx"):
        answer = tmp_path / source.name
        subprocess.run([shutil.which("ssconvert"), "--recalc", source, answer], check=True, capture_output=True)
        found = compared("gnumeric", source, answer)
        assert found.agrees, (source.name, found)


TYPED = {
    "function-generator": ("psi_p2", "psi.2", 79.5),
    "crank-rocker-swing": ("psi", "psi", 70),
    "rigid-body-guidance": ("alpha_p2", "poses.2.3", -11.0),
    "quick-return-slider": ("stroke", "stroke", 110),
    "quick-return-lever": ("time_ratio", "time_ratio", 1.6),
}
"""Packaged description -> symbol of a yellow cell, what `--set` calls it, the number that is typed."""


@pytest.mark.ci
@pytest.mark.libreoffice
def test_what_is_typed_moves_everything_as_if_it_were_built_anew(tmp_path, monkeypatch):
    """Drawing, curves, table, verdicts: every formula of the workbook in which the number was typed.

    Outside full runs one half of the tasks as .xlsx, the other half as .ods. Beside which way of its point a name stands is
    chosen when a workbook is built: here for all alike.
    """
    monkeypatch.setattr("mechsheet.sheet.drawing.labels._changes", lambda *_: [(1, 0, 0.05, 0.05)])
    (tmp_path / "answers").mkdir()
    typed, anew = [], []
    for number, (name, (symbol, key, value)) in enumerate(TYPED.items()):
        for suffix in FORMATS if ALL else (FORMATS[number % 2],):
            built, fresh = (tmp_path / f"{name}-{suffix}-{which}.{suffix}" for which in ("built", "anew"))
            spots = compiled_into(built, name)
            compiled_into(fresh, name, {key: str(value)})
            anew.append(fresh)
            typed.append(tmp_path / f"{name}-{suffix}-typed.{suffix}")
            type_into(built, typed[-1], spots[symbol], value)
    for fresh, answer in zip(anew, convert_with_libreoffice(typed, "xlsx", tmp_path / "answers"), strict=True):
        found = compared("libreoffice", fresh, answer)
        assert found.agrees, (fresh.name, found)
        assert found.cells > 500


def compiled_into(path, name, overrides=()):
    """The workbook of a packaged description, with fewer rows and other values in its task; where its cells are."""
    workbook, plan = compile_workbook(changed.loads(template_text(name), name, Overrides(overrides, rows="9")))
    write(workbook, path)
    return plan.at.spots


def type_into(source, target, spot, value):
    """The same file with a number typed into a cell, and no result that belongs to it: nothing but computing helps.

    openpyxl keeps no stored results; for .ods those of the old number stay.
    """
    if source.suffix == ".ods":
        book = read(source)
        assert book.sheet(spot.sheet).constants.get(spot.row, spot.col) not in (None, value)
        update_values(source, target, book, evaluate(book), {(spot.sheet, spot.row, spot.col): value})
        return
    book = openpyxl.load_workbook(source)
    cell = book[spot.sheet].cell(spot.row + 1, spot.col + 1)
    assert isinstance(cell.value, int | float)
    assert cell.value != value
    cell.value = value
    book.save(target)

"""Workbooks of random tasks of synthesis, in the programs that people open them with; and a task typed into one of them.

Built lean (no drawing, no rates): what is asked here is the synthesis.
"""

import contextlib
import itertools
import re
import shutil
import subprocess

import pytest

from chosen import first
from mechsheet.checking.inputs import description_in, plan_inside
from mechsheet.checking.probed_cells import compare_program
from mechsheet.checking.programs import convert_with_libreoffice, stored_values
from mechsheet.description import loads
from mechsheet.diagnostics import MechanismError
from mechsheet.engine import evaluate
from mechsheet.formats import read, write
from mechsheet.library.building import compile_workbook
from mechsheet.synthesis.kinds import KINDS
from synthesis_tasks import description, task

COUNT = len(first(range(20), 1))

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


@pytest.mark.slow
@pytest.mark.libreoffice
def test_libreoffice_computes_them(tmp_path):
    (tmp_path / "answers").mkdir()
    sources = workbooks(tmp_path / "ods", suffix="ods")
    for source, answer in zip(sources, convert_with_libreoffice(sources, "xlsx", tmp_path / "answers"), strict=True):
        found = compared("libreoffice", source, answer)
        assert found.agrees, (source.name, found)


@pytest.mark.slow
@pytest.mark.gnumeric
def test_gnumeric_computes_them(tmp_path):
    for source in workbooks(tmp_path / "xlsx"):
        answer = tmp_path / source.name
        subprocess.run([shutil.which("ssconvert"), "--recalc", source, answer], check=True, capture_output=True)
        found = compared("gnumeric", source, answer)
        assert found.agrees, (source.name, found)

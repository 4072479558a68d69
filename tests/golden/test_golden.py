"""The workbooks of the templates as text: names, cells, formulas, charts. A diff of these files shows what a change did.

After a wanted change: MECHSHEET_ALL=1 MECHSHEET_UPDATE_GOLDEN=1 .venv/bin/pytest tests/golden, and read the diff.
"""

import os
from pathlib import Path

import pytest

from folders import TEMPLATE_FILES
from mechsheet.description import load
from mechsheet.dynamics.solve import solve
from mechsheet.library.show import cells_of_workbook, equations_text
from mechsheet.sheet.layout import lay_out

FOLDER = Path(__file__).parent
SHOWN = ("adjustable-pump", "fivelink", "four-bar", "inverted-slider-crank", "six-link-dwell", "slider-crank")
"""Their whole workbooks are kept; of the others the equations."""


def test_there_are_templates():
    assert len(TEMPLATE_FILES) >= 21
    assert set(SHOWN) <= {path.stem for path in TEMPLATE_FILES}


def compare(path: Path, text: str) -> None:
    if os.environ.get("MECHSHEET_UPDATE_GOLDEN"):
        path.write_text(text, encoding="utf-8", newline="\n")
    assert path.read_text(encoding="utf-8") == text, f"{path.name} differs: see the head of this file"


@pytest.mark.cases(35)
@pytest.mark.parametrize("template", TEMPLATE_FILES, ids=lambda path: path.stem)
def test_equations(template):
    compare(FOLDER / f"{template.stem}.equations.txt", equations_text(load(template)) + "\n")


@pytest.mark.slow
@pytest.mark.parametrize("name", SHOWN)
def test_cells(name):
    mechanism = load(TEMPLATE_FILES[0].parent / f"{name}.toml")
    workbook, _ = lay_out(mechanism, solve(mechanism))
    compare(FOLDER / f"{name}.cells.txt", cells_of_workbook(workbook) + "\n")

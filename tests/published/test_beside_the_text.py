"""docs/beside-the-text.md: every formula that it shows stands in that cell of that workbook, and the numbers are right."""

import re
from functools import cache
from pathlib import Path

import pytest
from printed_numbers import TEMPLATES

from livesheet.formats import read
from livesheet.formula.names import folded
from livesheet.formula.nodes import shifted
from livesheet.formula.printer import print_formula
from livesheet.formula.references import parse_reference
from mechsheet.description import Overrides, load
from mechsheet.library.building import build

PAGE = (Path(__file__).parents[2] / "docs" / "beside-the-text.md").read_text(encoding="utf-8")
SHOWN = re.findall(r"`([\w-]+)-(page|lambda)\.xlsx` `([A-Z]+\d+)` \| `=([^`]+)` \|", PAGE)


@cache
def formulas_at(folder, name, form, cell):
    """Of every sheet of a workbook that has a formula there."""
    mechanism = load(TEMPLATES / f"{name}.toml", Overrides(layout="page" if form == "page" else None))
    path = build(mechanism, folder, ("xlsx",), ("lambda",) if form == "lambda" else ())[-1]
    reference = parse_reference(f"S!{cell}")
    found = set()
    for sheet in read(path).sheets:
        if (block := sheet.formula_at(reference.row, reference.col)) is not None:
            moved = shifted(block.formula, reference.row - block.row, reference.col - block.col)
            found.add(folded(print_formula(moved)))
    return found


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("beside")


def test_the_page_shows_formulas_of_four_workbooks():
    assert len({name for name, *_ in SHOWN}) == 4
    assert len(SHOWN) == PAGE.count(".xlsx` `")


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "form", "cell", "formula"), SHOWN)
def test_the_formula_stands_there(folder, name, form, cell, formula):
    assert folded(formula) in formulas_at(folder, name, form, cell)

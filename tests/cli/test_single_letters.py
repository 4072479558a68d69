"""Symbols of one letter: the workbook calls their cells by the word of their label, and a person goes on writing `a`."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

import mechsheet
from command_line import printed

pytestmark = pytest.mark.slow

TEMPLATE = Path(__file__).parent.parent.parent / "templates" / "inverted-slider-crank.toml"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    made = tmp_path_factory.mktemp("letters")
    shutil.copy(TEMPLATE, made / TEMPLATE.name)
    printed("build", made / TEMPLATE.name, "-o", made, "--format", "xlsx,ods")
    return made


@pytest.mark.cases(1)
@pytest.mark.parametrize("suffix", ["xlsx", "ods"])
def test_the_symbol_finds_its_cell(folder, suffix):
    path = folder / f"inverted-slider-crank.{suffix}"
    changed = folder / f"changed.{suffix}"
    printed("recalc", path, "--set", "a=31", "-o", changed)
    assert printed("recalc", changed, "--print", "a").strip() == "31"
    assert "a = { value = 31" in printed("pull", changed)
    assert "all agree" in printed("check", changed)


def test_the_library_finds_it_too(folder):
    book = mechsheet.open_book(folder / "inverted-slider-crank.xlsx")
    book["a"] = 31
    assert book["a"] == book["crank"] == 31

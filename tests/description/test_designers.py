"""Mechanisms that no template has, written from the docs as a designer would: units behind the numbers, masses, springs, a
cylinder, feet and pounds. Each builds without a warning, and its workbook agrees with the reference."""

import warnings
from pathlib import Path

import pytest

import mechsheet

CASES = Path(__file__).parents[1] / "cases" / "designers"


@pytest.mark.slow
@pytest.mark.cases(2)
@pytest.mark.parametrize("name", sorted(path.stem for path in CASES.glob("*.toml")))
def test_a_designers_mechanism_is_built_and_agrees(tmp_path, name):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        linkage = mechsheet.load(CASES / f"{name}.toml")
        (book,) = linkage.build(tmp_path / f"{name}.xlsx")
    assert "closes in" in linkage.verdicts()["verdict"].words
    assert mechsheet.check(book).agrees

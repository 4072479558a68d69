"""`check` judges the sheet of tolerances: a damaged formula is found by the reference, and typed inputs are followed."""

from pathlib import Path

import pytest
from placed import places_of

from livesheet.engine import evaluate
from livesheet.evaluation import book_of
from mechsheet.checking.against_reference import against_plan
from mechsheet.compiled import Compiled
from mechsheet.description import load

pytestmark = pytest.mark.slow

HOEKEN = Path(__file__).parents[2] / "templates/hoeken.toml"


@pytest.fixture(scope="module")
def hoeken():
    compiled = Compiled(load(HOEKEN))
    return book_of(compiled.layout), compiled.plan


def compared(hoeken, typed):
    """The comparison with the reference, cells typed over: {(key, row): value}."""
    book, plan = hoeken
    overrides = {}
    for (key, row), value in typed.items():
        spot = places_of(plan)[key]
        overrides[spot.sheet, spot.row + row, spot.col] = value
    comparison, _ = against_plan(book, evaluate(book, overrides), plan, "hoeken")
    return comparison


def test_inputs_are_followed(hoeken):
    typed = {("a2", 0): 38.0, ("tolerance a4", 0): 0.4, ("mode_1", 0): -1.0}
    assert compared(hoeken, typed).agrees


@pytest.mark.cases(1)
@pytest.mark.parametrize("key", ["deviation:a3", "P.x:worst case", "P.x:root sum of squares"])
def test_a_wrong_number_is_found(hoeken, key):
    comparison = compared(hoeken, {(key, 20): 0.123})
    assert not comparison.agrees
    assert comparison.where.startswith("Tolerance!")


def test_a_wrong_line_of_a_summary_is_found(hoeken):
    comparison = compared(hoeken, {("worst case of length", 0): 0.6})
    assert not comparison.agrees
    assert "length" in comparison.where

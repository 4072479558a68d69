"""Extremes of quantities, held against the same motion in far more rows."""

import numpy as np
import pytest
from placed import places_of
from swept import four_bar, swept

from mechsheet.compiled import compiled_of
from mechsheet.description.templates import template_text
from mechsheet.library.changed import loads
from mechsheet.sheet.plan import VALUE
from mechsheet.studies.chunk import kept_of
from mechsheet.studies.designs import Designs
from studying import in_workbook

ROWS = {"closed by its last row": (360, 15), "without the row that closes it": (345, 15), "open": (300, 15)}
STUDY = "[study]\nvary = { a2 = { values = [35, 30] } }\n"


def dense(text, rows, of):
    """The extremes of a quantity over rows of a hundredth of the step, as the rows of the equations have it."""
    last, step = rows
    column = compiled_of(loads(swept(text, (last, step / 100)))).values[of]
    return float(np.min(column)), float(np.max(column))


@pytest.mark.cases(11)
@pytest.mark.parametrize("rows", ROWS.values(), ids=ROWS)
@pytest.mark.parametrize(
    ("formula", "unit"),
    [
        ("C.x - 20*theta12", "mm"),
        ("B.x + 2*theta12", "mm"),
        ("theta12/10 + 0.2*sin(theta12)", "deg"),
        ("cos(theta12/2) - 0.1*sin(theta12)", ""),
        ("20*theta14 + C.y", "mm"),
        ("theta12", "deg"),
    ],
)
def test_what_does_not_come_back_with_the_mechanism_has_ends(formula, unit, rows):
    text = four_bar(formula, unit)
    mechanism = loads(swept(f"{text}{STUDY}", rows))
    low, high = dense(text, rows, "asked")
    found = in_workbook(mechanism, {"a2": 35.0}, {})
    to_shown = next(each for each in mechanism.outputs).unit.to_shown
    off = 2e-4 * (to_shown(high) - to_shown(low))
    assert found["low"] == pytest.approx(to_shown(low), abs=off)
    assert found["high"] == pytest.approx(to_shown(high), abs=off)


@pytest.mark.slow
@pytest.mark.parametrize("rows", ROWS.values(), ids=ROWS)
def test_a_load_that_grows_with_the_angle(rows):
    text = template_text("four-bar-forces").replace("torque = 120", 'torque = "-50*theta12"')
    text = text[: text.index("[summary]")] + '[summary]\nhigh = { of = "F34.x", take = "max" }\n'
    compiled = compiled_of(loads(swept(text, rows)))
    spot = places_of(compiled.plan)["summary high"]
    assert spot.col == VALUE
    low, high = dense(text, rows, "F34.x")
    assert compiled.number(spot) == pytest.approx(high, abs=2e-4 * (high - low))


@pytest.mark.cases(5)
@pytest.mark.slow
@pytest.mark.parametrize("rows", ROWS.values(), ids=ROWS)
@pytest.mark.parametrize("formula", ["C.x - 20*theta12", "C.x + 20*theta14", "C.x - C.y"])
def test_a_study_finds_the_same(formula, rows):
    mechanism = loads(swept(f"{four_bar(formula)}{STUDY}", rows))
    designs = Designs(mechanism)
    found = kept_of(designs, 0, designs.sampling.total)
    for number, a2 in enumerate(found.columns["a2"]):
        book = in_workbook(mechanism, {"a2": a2}, designs.modes)
        assert {name: found.columns[name][number] for name in book} == pytest.approx(book, rel=1e-12)

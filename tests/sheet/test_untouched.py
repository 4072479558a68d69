"""Workbooks that nobody has touched: none of them shows a red cell, whatever its description looks like."""

import re
import tomllib
from pathlib import Path

import pytest
from laid import Laid

from chosen import part
from degenerate_cases import cases
from livesheet.formula.nodes import ErrorValue
from mechsheet.description import loads
from mechsheet.kinematics.solve import solve
from mechsheet.sheet.planning import plan_of

TESTS = Path(__file__).parents[1]


def descriptions():
    """Everything under tests that can be built: whole files, and texts inside files of cases."""
    found = {}
    for path in [*sorted((TESTS / "cases").rglob("*.toml")), *sorted((TESTS / "data").glob("*.toml"))]:
        text = path.read_text(encoding="utf-8")
        if "links" in tomllib.loads(text):
            found[path.stem] = text
    for folder in ("branches", "degenerate"):
        found |= {case.name: case.description for case in cases(folder) if not case.refused and not case.leaps}
    return found


NOT_BUILT = ("everything", "trammel")
"""Two drivers would be needed; the driven link shares no point with the ground."""

LEAPS = ("dead-centre",)
"""Its driver's values are listed, a billionth of a degree and 45 degrees apart."""

CLOSED = ("largest gap of a joint: rounding only", "en büyük mafsal açıklığı: yalnız yuvarlama")

UNDETERMINED = ("kite",)
"""A row between others in which links can turn freely is no stretch with a limit on either side: nothing is found there."""

TEXTS = {name: text for name, text in descriptions().items() if name not in NOT_BUILT}


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("name", part([name for name in TEXTS if name not in LEAPS], of=4))
def test_nothing_is_red(name):
    """It closes somewhere, gaps are rounding, no cell counts as typed over; what can be said of it is said in words."""
    laid = Laid(TEXTS[name])
    assert laid.spot("rows_closed") > 0
    assert laid.words("largest_gap") in CLOSED
    assert laid.spot("typed") == 0
    assert laid.verdict.startswith(("closes in ", "kapandığı konum", f"{laid.plan.rows} konumun hepsinde"))
    lines = [line for line in laid.plan.blocks["verdicts"].rows if line != "limits" or name not in UNDETERMINED]
    words = [laid.words(line) for line in lines]
    assert not [word for word in words if isinstance(word, ErrorValue)]


@pytest.mark.parametrize("length", ["12000", "6 * 2000"])
def test_size_of_plain_and_derived_lengths(length):
    """A derived length, and one that an expression in a place gives, are lengths too."""
    text = TEXTS["four-bar"]
    derived = text.replace("[links.ground]", f'long = {{ formula = "{length}" }}\n[links.ground]')
    placed = re.sub(r'C = \{.*?side = "left" \}', f'C = ["{length}", 0]', text)
    for changed in (derived, placed):
        assert changed != text
        mechanism = loads(changed)
        assert plan_of(mechanism, solve(mechanism)).size == pytest.approx(12000)

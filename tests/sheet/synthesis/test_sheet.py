"""The sheet of synthesis as it says why a task has no solution: each step only what can be wrong with its own kind."""

from pathlib import Path

import pytest

from mechsheet.compiled import Compiled
from mechsheet.compiled.evaluation import book_of
from mechsheet.description import loads
from mechsheet.formula.references import cell_address
from mechsheet.library.session import Session
from mechsheet.sheet.synthesis.rows import LINE_ROW, REMARK, SYMBOL
from mechsheet.words.synthesis import STEPS

TEXT = (Path(__file__).parents[3] / "templates/crank-rocker-swing.toml").read_text(encoding="utf-8")
REASONS = {english for key, (english, _) in STEPS.items() if key.startswith("none.")}
OF_OTHER_KINDS = {STEPS[key][0] for key in ("none.a3", "none.cubic_b")}


@pytest.mark.parametrize(
    ("given", "typed", "reason"),
    [
        ("lam = 4.0", {"lam": 0.5}, STEPS["none.D"][0]),
        ("best = true", {"time_ratio": 1.0}, STEPS["none.t_squared"][0]),
    ],
)
def test_a_crank_rocker_that_is_none_has_reasons_of_its_own(given, typed, reason):
    """Not also that the points of a function generator cannot be met, nor the limits of a slider-crank."""
    compiled = Compiled(loads(TEXT.replace("best = true", given)))
    spots, session = compiled.plan.at.spots, Session(book_of(compiled.layout))
    title, rows = compiled.plan.at.titles["synthesis"], compiled.plan.synthesis.of
    session.update({cell_address(title, spots[name].row, spots[name].col): value for name, value in typed.items()})
    remarks = [session.get(cell_address(title, row, REMARK)) for (block, _), row in rows.items() if block == "solution"]
    said = [remark for remark in remarks if remark in REASONS]
    assert said[0] == reason
    assert not OF_OTHER_KINDS & set(said)
    assert session.get(cell_address(title, LINE_ROW, SYMBOL)) == reason

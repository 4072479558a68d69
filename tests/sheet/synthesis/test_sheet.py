"""The sheet of synthesis as it says why a task has no solution: each step only what can be wrong with its own kind."""

import pytest
from laid import Laid

from catalogues import pairs
from mechsheet.description.templates import template_text
from mechsheet.sheet.task_rows import INPUTS, REMARK, UNSOLVED, USED

STEPS = pairs("step.")

pytestmark = pytest.mark.slow

TEXT = template_text("crank-rocker-swing")
REASONS = {english for key, (english, _) in STEPS.items() if key.startswith("none.")}
OF_OTHER_KINDS = {STEPS[key][0] for key in ("none.a3", "none.cubic_b")}


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    ("given", "typed", "reason"),
    [
        ("lam = 4.0", {"lam": 0.5}, STEPS["none.D"][0]),
        ("best = true", {"time_ratio": 1.0}, STEPS["none.t_squared"][0]),
    ],
)
def test_a_crank_rocker_that_is_none_has_reasons_of_its_own(given, typed, reason):
    """Not also that the points of a function generator cannot be met, nor the limits of a slider-crank."""
    sheet = Laid(TEXT.replace("best = true", given)).change(**typed)
    title, rows = sheet.plan.at.titles["synthesis"], sheet.plan.synthesis.of
    remarks = [sheet.values.get(title, row, REMARK) for (block, _), row in rows.items() if block == "solution"]
    said = [remark for remark in remarks if remark in REASONS]
    assert said[0] == reason
    assert not OF_OTHER_KINDS & set(said)
    assert sheet.spot("synthesis") == reason
    # what the mechanism does is said of none: only that the inputs can be, and that there is no solution
    does = {key: sheet.values.get(title, row, USED) for (block, key), row in rows.items() if block == "does"}
    assert {key for key, words in does.items() if words != "–"} == {INPUTS, UNSOLVED}

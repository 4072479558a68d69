"""Lengths rounded before they are used: what that costs, and that a full turn lost by it alone is a doubt, not a refusal."""

import pytest
from laid import Laid

from mechsheet.sheet.synthesis.requirement_checks import DOUBT, NO, YES
from mechsheet.sheet.synthesis.tables import exact_column
from mechsheet.sheet.task_rows import ROUNDED, USED
from synthesis_tasks import description

pytestmark = pytest.mark.slow

CRANK_ROCKER = {"kind": "dead-centres", "psi": 59.1, "a1": 25.6, "phi": 166.4, "a2": 11.51, "round": 1}
SLIDER = {"kind": "quick-return-slider", "stroke": 26.7, "time_ratio": 1.56, "a2": 13.3, "round": 0.5}
FUNCTION = {
    "kind": "function", "theta": [61.5, 179.53, 190.89], "psi": [151.02, 176.99, 223.21], "a1": 268.5, "round": 0.5,
}  # fmt: skip
GUIDANCE = {
    "kind": "guidance", "poses": [[41.0, 20.0, 26.83], [-8.8, -24.6, 55.92], [-32.3, -82.5, 85.26]],
    "A": {"turns": [-34.43, -94.29]}, "B": {"fixed": [82.05, 11.93]}, "round": 1,
}  # fmt: skip


class Sheet(Laid):
    """The sheet of synthesis of a task."""

    def __init__(self, asked, language="en"):
        super().__init__(description(asked), language)
        self.rows = self.plan.synthesis.of

    def at(self, row, col):
        return self.values.get(self.plan.at.titles["synthesis"], row, col)

    def said(self, key):
        """The mark of a verdict, and its words."""
        row = self.rows["does", key]
        return self.at(row, ROUNDED), self.at(row, USED)

    def errors(self):
        """Of the lengths as they are used, and of the exact ones."""
        rows = [row for (block, _), row in self.rows.items() if block == "asked"]
        exact = exact_column(self.mechanism.synthesis)
        return [self.at(row, USED) for row in rows], [self.at(row, exact) for row in rows]


@pytest.mark.cases(1)
@pytest.mark.parametrize(
    ("asked", "margin"),
    [
        # a1, a2, a3, a4 = 25.6, 11.51, 14.4608, 23.4326; rounded 26, 12, 14, 23: 26 + 12 > 14 + 23
        (CRANK_ROCKER, "0.7834"),
        # a2, a3, c = 13.3, 13.7343, 0.2790; rounded 13.5, 13.5, 0.5: no longer a rod than a crank
        (SLIDER, "0.1553"),
    ],
    ids=["crank-rocker", "slider-crank"],
)
def test_a_full_turn_that_rounding_loses_is_amber_with_the_exact_margin(asked, margin):
    sheet = Sheet(asked)
    mark, said = sheet.said("turns")
    assert mark == DOUBT
    assert said.startswith("no full turn once rounded; exact it has to spare ")
    assert margin in said
    assert NO not in {sheet.said(key)[0] for block, key in sheet.rows if block == "does"}
    assert sheet.change(round_to=0.01).said("turns") == (YES, "the crank turns fully")


def test_that_what_is_asked_is_not_reached_then_is_amber_likewise():
    sheet = Sheet(CRANK_ROCKER)
    assert sheet.said("meets") == (DOUBT, "rounded, it does not reach what is asked; exact it does")
    assert sheet.spot("synthesis") == "rounded, it does not reach what is asked; exact it does"
    turkish = Sheet(CRANK_ROCKER, "tr")
    assert turkish.spot("synthesis") == "yuvarlanınca istenene ulaşamıyor; tam boylarla ulaşıyor"


@pytest.mark.cases(1)
@pytest.mark.parametrize("asked", [FUNCTION, GUIDANCE], ids=["function", "guidance"])
def test_the_full_turn_of_an_input_through_points_is_told_beside_its_type(asked):
    sheet = Sheet(asked)
    mark, said = sheet.said("grashof")
    assert mark == DOUBT
    assert said.endswith("; exact: the input turns fully")
    mark, said = sheet.change(round_to=0.001).said("grashof")
    assert mark == YES
    assert "exact" not in said


def test_the_error_of_the_exact_lengths_stands_beside_that_of_the_rounded_ones():
    rounded, exact = Sheet({**FUNCTION, "theta": [45, 90, 135], "psi": [60, 80, 100], "a1": 100}).errors()
    assert max(map(abs, rounded)) > 0.1
    assert max(map(abs, exact)) < 1e-10


def test_nothing_of_it_where_nothing_is_rounded():
    asked = {key: value for key, value in CRANK_ROCKER.items() if key != "round"}
    sheet = Sheet(asked)
    assert sheet.said("turns") == (YES, "the crank turns fully")
    assert sheet.at(sheet.rows["asked", "0"] - 1, exact_column(sheet.mechanism.synthesis)) is None

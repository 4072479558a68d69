"""An output that is the transmission angle under another name has its extremes; one that only looks like it has not."""

import pytest
from planned import planned

from mechsheet.description.templates import template_text
from mechsheet.sheet.transmission import same_angle

OUTPUTS = """
[outputs]
mine = { formula = "theta14 - theta13", unit = "deg" }
turned = { formula = "theta13 - theta14", unit = "deg" }
bare = { formula = "theta14 - theta13", unit = "rad" }
crank = { formula = "theta12 - theta13", unit = "deg" }
double = { formula = "theta14 - 2*theta13", unit = "deg" }
total = { formula = "theta14 + theta13", unit = "deg" }
"""


@pytest.fixture(scope="module")
def plan():
    return planned(template_text("four-bar").partition("[outputs]")[0] + OUTPUTS)


@pytest.mark.parametrize(("symbol", "minus", "in_degrees"), [
    ("mine", False, True), ("turned", True, True), ("bare", False, False),
])  # fmt: skip
def test_a_difference_of_the_groups_two_links_is(plan, symbol, minus, in_degrees):
    found = same_angle(plan, symbol)
    assert (found.group.number, found.minus, found.in_degrees) == (1, minus, in_degrees)


@pytest.mark.parametrize("symbol", ["crank", "double", "total", "theta14"])
def test_anything_else_is_not(plan, symbol):
    assert same_angle(plan, symbol) is None

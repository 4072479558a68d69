"""The length of a link between its two pins is greater than 0: a description is refused as its workbook's cell would be."""

import pytest

from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.solve import solve


@pytest.mark.parametrize("value", ["0", "-35"])
def test_a_crank_that_has_no_length(value):
    text = template_text("four-bar").replace("a2 = { value = 35", f"a2 = {{ value = {value}")
    with pytest.raises(MechanismError, match=rf"a2 is the length of crank from A0 to A: .* not {value}\n"):
        solve(loads(text))


def test_all_lengths_at_once():
    text = template_text("four-bar").replace("a2 = { value = 35", "a2 = { value = -35")
    with pytest.raises(MechanismError) as caught:
        solve(loads(text.replace("a4 = { value = 56", "a4 = { value = 0")))
    assert [fault.key for fault in caught.value.faults] == ["dimensions.a2", "dimensions.a4"]


def test_places_on_the_ground_and_in_plates_may_have_any_sign():
    text = template_text("four-bar").replace("a1 = { value = 70", "a1 = { value = -70").replace("[50, 55]", "[-50, 55]")
    assert solve(loads(text)).columns

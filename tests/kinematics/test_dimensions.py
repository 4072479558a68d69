"""The order in which dimensions are computed, and listed: inputs, then step by step what follows from what is known."""

from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.dimensions import dimension_order, dimension_values

DERIVED = """[dimensions]
last = { formula = "2*middle" }
middle = { formula = "a2/5" }
fixed = { formula = "3*2" }
"""
MECHANISM = loads(template_text("four-bar").replace("[dimensions]\n", DERIVED, 1))


def test_each_step_lists_as_described():
    order = dimension_order(MECHANISM)
    assert [symbol for symbol in order if symbol in ("a2", "last", "middle", "fixed")] == [
        "a2",
        "middle",
        "fixed",
        "last",
    ]
    assert dimension_values(MECHANISM)["last"] == 14

"""Where the ruler of the sheet Checks is laid: places of points in their links, straight from the description."""

import math

import pytest

from livesheet.formula.scalar import evaluate
from mechsheet.model import Cartesian, Distances, Link, Polar
from mechsheet.sheet.geometry import base_point, distance, place

ENDS = {"A": Cartesian(1.0, 2.0), "B": Polar(5.0, 0.4)}


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(("b", "c"), [(4.0, 3.5), (3.5, 4.0), (2.0, 5.0)])
def test_a_point_by_two_distances_is_as_far_from_both_as_given(b, c, side):
    link = Link("plate", 3, {"C": Distances("A", b, "B", c, side), **ENDS})
    (au, av), (bu, bv), (cu, cv) = ([evaluate(part, {}) for part in place(link, name)] for name in "ABC")
    assert (bu, bv) == pytest.approx((5 * math.cos(0.4), 5 * math.sin(0.4)))
    assert math.hypot(cu - au, cv - av) == pytest.approx(b)
    assert math.hypot(cu - bu, cv - bv) == pytest.approx(c)
    turn = (bu - au) * (cv - av) - (bv - av) * (cu - au)
    assert (turn > 0) == (side == "left")
    for start, end, length in (("A", "C", b), ("C", "B", c), ("A", "B", math.hypot(bu - au, bv - av))):
        assert evaluate(distance(link, start, end), {}) == pytest.approx(length)
    assert base_point(link) == "A"

"""Where the points of a link are: a wrong place is a link drawn in a shape that it has not."""

import math

import pytest

from livesheet.formula.nodes import Symbol
from mechsheet.model import Cartesian, Distances, Link, Polar
from mechsheet.shapes.described import corners, number_points

ENDS = {"A": Cartesian(1.0, 2.0), "B": Polar(Symbol("r"), 0.4)}


@pytest.mark.parametrize("side", ["left", "right"])
@pytest.mark.parametrize(("b", "c"), [(4.0, 3.5), (3.5, 4.0), (2.0, 5.0)])
def test_a_point_by_two_distances_is_as_far_from_both_as_given(b, c, side):
    link = Link("plate", 3, {"C": Distances("A", b, "B", c, side), **ENDS})
    places = number_points(link, {"r": 5.0})
    assert list(places) == ["C", "A", "B"]
    assert places["B"] == pytest.approx((5 * math.cos(0.4), 5 * math.sin(0.4)))
    (ax, ay), (bx, by), (cx, cy) = (places[name] for name in "ABC")
    assert (math.hypot(cx - ax, cy - ay), math.hypot(cx - bx, cy - by)) == pytest.approx((b, c))
    assert ((bx - ax) * (cy - ay) > (by - ay) * (cx - ax)) == (side == "left")


def test_distances_that_do_not_meet_leave_the_point_on_the_line():
    """While somebody drags a point: no error, the nearest that there is."""
    link = Link(
        "plate", 3, {"A": Cartesian(0.0, 0.0), "B": Cartesian(10.0, 0.0), "C": Distances("A", 2, "B", 3, "left")}
    )
    x, y = number_points(link, {})["C"]
    assert (x, y) == pytest.approx(((4 - 9 + 100) / 20, 0.0))


def test_an_outline_does_not_cross_itself():
    """Around the middle of its corners, in whatever order and wherever they are described."""
    square = {"A": (30, 20), "B": (32, 22), "C": (32, 20), "D": (30, 22)}
    link = Link("plate", 3, {name: Cartesian(*map(float, place)) for name, place in square.items()})
    assert "".join(corners(link, {})) in ("ACBD" * 2)

"""The time ratio: its places are found where a quantity is flat, and it is one of times or there is none."""

import math
import re

import pytest
from laid import Laid

from mechsheet.description.templates import template_text

FOUR_BAR = template_text("four-bar").partition("[[charts]]")[0]
INVERTED = template_text("inverted-slider-crank").replace("step = 5", "step = 15")


def of_way(way):
    return max(way, math.tau - way) / min(way, math.tau - way)


def of_dead_centres(a1, a2, a3, a4):
    """Crank and coupler are in line: the triangle of the fixed pivots and the rocker's pin, stretched and folded."""
    stretched, folded = (math.acos((a1**2 + side**2 - a4**2) / (2 * a1 * side)) for side in (a3 + a2, a3 - a2))
    return of_way(folded + math.pi - stretched)


def of_tangents(a, d, offset):
    """The rod's line, `offset` away from the rocker's pivot, touches the crank's circle on either side of its pivot."""
    one, other = (math.acos((offset + side * a) / d) for side in (1, -1))
    return of_way(math.pi + one - other)


@pytest.mark.slow
@pytest.mark.parametrize(
    "lengths",
    [(70, 45, 62.3, 56), (70, 35, 62.3, 56), (70, 45, 60, 56), (70, 40, 62.3, 56), (75.471, 46.816, 52.5, 79.549)],
)
def test_crank_rockers(lengths):
    """In steps of 15 degrees."""
    laid = Laid(FOUR_BAR).change(**dict(zip(("a1", "a2", "a3", "a4"), lengths, strict=True)))
    assert laid.spot("time_ratio_theta14") == pytest.approx(of_dead_centres(*lengths), rel=5e-5)
    assert "about" not in laid.words("time_ratio_theta14")


@pytest.mark.slow
@pytest.mark.parametrize("d", [0.2, 0.21, 0.25, 0.3])
def test_inverted_slider_crank(d):
    laid = Laid(INVERTED).change(d=d)
    expected = of_tangents(0.08, d, 0.13 * math.sin(math.radians(60)))
    found, about = laid.spot("time_ratio_theta14"), "about" in laid.words("time_ratio_theta14")
    assert found == pytest.approx(expected, rel=2e-2 if about else 1e-4)


@pytest.mark.slow
def test_a_speed_that_follows_from_the_angle_leaves_none():
    """Ways of the same length do not take the same time then."""
    text = re.sub(r"(?m)^step = .*$", r'\g<0>\nspeed = "5 + 3*cos(theta12)"', FOUR_BAR)
    laid = Laid(text)
    assert str(laid.spot("time_ratio_theta14")) == "#N/A"
    assert laid.words("time_ratio_theta14") == "ratio of θ₁₄: needs a constant speed"

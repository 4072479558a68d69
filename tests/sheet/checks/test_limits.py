"""Limits and extremes typed into one workbook, against closed forms. What holds of any mechanism: test_claims.py."""

import math

import pytest
from laid import Laid
from placed import places_of

from mechsheet.description.templates import template_text
from parallel_slides import COTANGENT

FOUR_BAR = template_text("four-bar").partition("[[charts]]")[0]


def limits(laid):
    """The driver's values at the limits that are found; the count says of all."""
    return [laid.spot(f"limit_{n}") for n in range(1, min(4, int(laid.spot("limits"))) + 1)]


def by_cosines(a1, a2, reach):
    """Where the crank's pin is `reach` away from the other fixed pivot [deg]."""
    return math.degrees(math.acos((a1**2 + a2**2 - reach**2) / (2 * a1 * a2)))


@pytest.mark.slow
@pytest.mark.parametrize("a1", [90, 100, 110, 130, 150])
def test_limits_of_a_rocker(a1):
    """Typed into one workbook: |A B0| <= a3 + a4 = 118.3; from a1 = 153.3 on it closes nowhere."""
    laid = Laid(FOUR_BAR).change(a1=a1)
    limit = by_cosines(a1, 35, 118.3)
    assert limits(laid) == pytest.approx([limit, 360 - limit], abs=1e-5)
    assert laid.spot("limits") == 2
    assert (laid.spot("input_from"), laid.spot("input_to")) == pytest.approx((0, limit), abs=1e-5)
    assert laid.words("limits").startswith(f"{round(limit, 2):.15g}°; {round(360 - limit, 2):.15g}°")
    assert laid.words("input_from") == "from … to: the first of several stretches"


@pytest.mark.slow
@pytest.mark.parametrize(("start", "step"), [(-180, 15), (180, -15)])
def test_an_extreme_at_a_limit_is_where_the_stretch_begins_or_ends(start, step):
    """With a2 = 50 the coupler is stretched at -160.4 degrees, between two rows, and the rocker stands at 188.1."""
    limit = by_cosines(70, 50, 118.3)
    rocker = 360 - math.degrees(math.atan2(50 * math.sin(math.radians(limit)), 50 * math.cos(math.radians(limit)) - 70))
    laid = Laid(FOUR_BAR)
    spots = (places_of(laid.plan)[key] for key in ("max_theta14", "max_at_theta14"))
    laid.only(*((spot.sheet, spot.row, spot.col) for spot in spots)).change(a2=50, _start=start, _step=step)
    assert math.remainder(laid.spot("max_theta14") - rocker, 360) == pytest.approx(0, abs=1e-3)
    assert laid.spot("max_at_theta14") == pytest.approx(-limit, abs=1e-5)


@pytest.mark.slow
def test_two_ranges():
    """Neither stretched nor folded everywhere: two mirrored ranges, and four limits in a turn."""
    laid = Laid(template_text("drag-link"), overrides={"r1": "100", "r2": "60", "r3": "30", "r4": "80"})
    near, far = by_cosines(100, 60, 50), by_cosines(100, 60, 110)
    assert limits(laid) == pytest.approx([near, far, 360 - far, 360 - near], abs=1e-4)


@pytest.mark.slow
def test_crank_without_limits_and_no_position_at_all():
    laid = Laid(FOUR_BAR)
    assert limits(laid) == []
    assert laid.words("limits") == "no limit position in this range"
    assert laid.words("input_from") == "from … to: the driver can turn fully"
    laid.change(a1=500)
    assert limits(laid) == []
    assert laid.words("input_from") == laid.words("rows_closed") == "closes nowhere"


@pytest.mark.slow
def test_slider_crank_whose_rod_is_too_short():
    """|r sin(theta) - e| <= rod: the rod of 30 is shorter than the crank of 50."""
    laid = Laid(template_text("slider-crank"), overrides={"a2": "50", "a3": "30", "a1": "0"})
    limit = math.degrees(math.asin(30 / 50))
    wanted = [limit, 180 - limit, 180 + limit, 360 - limit]
    assert limits(laid) == pytest.approx(wanted, abs=1e-4)


@pytest.mark.slow
@pytest.mark.parametrize("offset", [0, 20, 60])
def test_stroke(offset):
    """sqrt((l + r)^2 - e^2) - sqrt((l - r)^2 - e^2)."""
    laid = Laid(template_text("slider-crank"), overrides={"a1": str(offset)})
    far, near = (math.sqrt((250 + sign * 50) ** 2 - offset**2) for sign in (1, -1))
    assert laid.spot("stroke_s14") == pytest.approx(far - near, abs=1e-5)


def test_lines_that_turn_parallel_between_two_rows_meet_nowhere():
    """s = h cot(theta): all rows close, but at 180 degrees the crank's slot is parallel to the slider's guide."""
    laid = Laid(COTANGENT)
    assert all(laid.exists)
    assert laid.words("passes") == "may not close near 190°: smaller step"
    assert laid.words("passes") in laid.verdict
    laid.change(**{"start": 10.6, "step": 360 / 17})  # the next row would be the first again, and 0 lies before it
    assert laid.words("passes") == "may not close near 10.6°: smaller step"
    laid.change(**{"start": 10, "step": 9})  # ends at 163 degrees
    assert laid.words("passes") == "no gap seen between neighbouring positions"
    assert laid.words("limits") == "no limit position in this range"

"""Searches of extremes: of an offset slider-crank, by its two dead centres, from few and unfavourable rows."""

import math

import pytest
from laid import Laid

from mechsheet.description.templates import template_text
from mechsheet.sheet.checks.search_rules import PROBES
from mechsheet.sheet.checks.search_table import KNOWN, PLACE_COL

pytestmark = pytest.mark.slow

R, ROD = 50, 250


def slider_crank(start, step, count, speed=True):
    text = template_text("slider-crank")
    stop = start + step * (count - 1)
    for key, value in (("start", start), ("stop", stop), ("step", step)):
        text = text.replace(
            next(line for line in text.splitlines() if line.startswith(f"{key} = ")), f"{key} = {value}"
        )
    return text.replace("[driver]", "[driver]\nspeed = 10", 1) if speed else text


@pytest.mark.cases(8)
@pytest.mark.parametrize("offset", [0, 20, 60])
@pytest.mark.parametrize(("start", "step", "count"), [(0, 15, 25), (7.3, 45, 9), (0, -30, 13), (5, 40, 9)])
def test_dead_centres_of_a_slider_crank(offset, start, step, count):
    """Also of rows that go backwards, and of a whole turn without its last row. A place where a quantity is flat has half
    of its digits."""
    laid = Laid(slider_crank(start, step, count), overrides={"a1": str(offset)})
    far, near = math.sqrt((ROD + R) ** 2 - offset**2), math.sqrt((ROD - R) ** 2 - offset**2)
    assert laid.spot("stroke_s14") == pytest.approx(far - near, rel=1e-7)
    places = [math.degrees(math.asin(offset / (ROD + R))), 180 + math.degrees(math.asin(offset / (ROD - R)))]
    assert abs(math.remainder(laid.spot("max_at_s14"), 360)) == pytest.approx(places[0], abs=2e-2)
    further = places[1] - 180 - places[0]
    assert laid.spot("time_ratio_s14") == pytest.approx((180 + further) / (180 - further), rel=1e-6)
    assert "about" not in laid.words("stroke_s14")


def test_the_rows_of_a_search():
    """Each row is a probe, placed within the bracket of the row above; the last row has what was found."""
    laid = Laid(slider_crank(0, 15, 25))
    spot = laid.plan.searched.extremes["max", "s14"].value
    rows = range(spot.row, spot.row + PROBES + 1)
    known = [[laid.values.get(spot.sheet, row, col) for col in range(KNOWN, KNOWN + 6)] for row in rows]
    places = [laid.values.get(spot.sheet, row, PLACE_COL) for row in rows]
    for above, below, place in zip(known, known[1:], places, strict=False):
        left, _, middle, best, right, _ = above
        assert left < place < right and place != middle
        assert left <= below[0] < below[2] < below[4] <= right
        assert below[3] >= best
    assert known[-1][3] == laid.spot("max_s14")


def test_beside_a_limit_the_best_is_the_limit_and_nothing_is_doubted():
    """The rod is too short for a whole turn: the slider is farthest where the stretch ends or between its rows."""
    laid = Laid(slider_crank(0, 15, 25), overrides={"a2": "50", "a3": "30", "a1": "0"})
    limit = math.degrees(math.asin(30 / 50))
    assert laid.spot("max_s14") == pytest.approx(80, rel=1e-9)
    assert laid.spot("limit_1") == pytest.approx(limit, abs=1e-4)


def test_a_summary_of_a_point_asked_for():
    """The highest place of a coupler point, from rows of 30 degrees, against rows of a hundredth."""
    more = '\n[rates]\npoints = ["C"]\n[summary.highest]\nof = "C.y"\ntake = "max"\n'
    laid = Laid(slider_crank(0, 30, 13) + more)
    fine = max(Laid(slider_crank(0, 0.5, 721) + more).column("C.y"))
    assert laid.spot("max_C.y") >= fine - 1e-9
    assert laid.spot("max_C.y") == pytest.approx(fine, rel=1e-4)


def test_an_extreme_between_rows_that_are_no_neighbours_of_the_best():
    """The first row stands 1.931 degrees behind the outer dead centre, the nearest ones to the next, at 360, farther off."""
    for speed in (True, False):
        laid = Laid(slider_crank(1.931, 10.973754793, 37, speed), overrides={"a1": "0"})
        assert laid.spot("max_s14") == pytest.approx(ROD + R, rel=1e-6)
        assert laid.spot("max_at_s14") == pytest.approx(360, abs=0.05)
        assert laid.spot("stroke_s14") == pytest.approx(2 * R, rel=1e-5)

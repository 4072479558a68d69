"""Extremes by derivatives: of an offset slider-crank, by its two dead centres, from few and unfavourable rows."""

import math

import pytest
from laid import Laid, template_text
from placed import places_of

from mechsheet.sheet.checks import turning

R, ROD = 50, 250


def slider_crank(start, step, count, speed=True):
    text = template_text("slider-crank")
    stop = start + step * (count - 1)
    for key, value in (("start", start), ("stop", stop), ("step", step)):
        text = text.replace(
            next(line for line in text.splitlines() if line.startswith(f"{key} = ")), f"{key} = {value}"
        )
    return text.replace("[driver]", "[driver]\nspeed = 10", 1) if speed else text


@pytest.mark.parametrize("offset", [0, 20, 60])
@pytest.mark.parametrize(("start", "step", "count"), [(0, 15, 25), (7.3, 45, 9), (0, -30, 13), (5, 40, 9)])
def test_dead_centres_of_a_slider_crank(offset, start, step, count):
    """Also of rows that go backwards, and of a whole turn without its last row."""
    laid = Laid(slider_crank(start, step, count), overrides={"a1": str(offset)})
    far, near = math.sqrt((ROD + R) ** 2 - offset**2), math.sqrt((ROD - R) ** 2 - offset**2)
    assert laid.spot("stroke_s14") == pytest.approx(far - near, rel=1e-9)
    places = [math.degrees(math.asin(offset / (ROD + R))), 180 + math.degrees(math.asin(offset / (ROD - R)))]
    assert abs(math.remainder(laid.spot("max_at_s14"), 360)) == pytest.approx(places[0], abs=2e-3)
    way = (laid.spot("max_at_s14") - laid.spot("min_at_s14")) % 360
    whole = abs(step) * (count - 1) == 360 or abs(step) * count == 360
    assert whole
    assert max(way, 360 - way) / min(way, 360 - way) == pytest.approx(laid.spot("time_ratio_s14"))
    assert abs(way - 180) == pytest.approx(places[1] - 180 - places[0], abs=2e-3)
    assert "about" not in laid.words("stroke_s14")


def test_two_probes_and_only_where_the_derivatives_are_columns():
    moving, still = (Laid(slider_crank(0, 15, 25, speed)) for speed in (True, False))
    assert turning.known(moving.plan, "s14")
    assert not turning.known(still.plan, "s14")
    for laid, count in ((moving, 2), (still, 4)):
        spot = places_of(laid.plan)["max_s14"]
        column = [laid.values.get(spot.sheet, row, 1) for row in range(spot.row - 1, spot.row + 7)]
        assert sum(isinstance(cell, float) for cell in column[: count + 1]) == count


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
    assert turning.known(laid.plan, "C.y")
    assert laid.spot("max_C.y") >= fine - 1e-9
    assert laid.spot("max_C.y") == pytest.approx(fine, rel=1e-4)


def test_an_extreme_between_rows_that_are_no_neighbours_of_the_best():
    """The first row stands 1.931 degrees behind the outer dead centre, the nearest ones to the next, at 360, farther off."""
    for speed in (True, False):
        laid = Laid(slider_crank(1.931, 10.973754793, 37, speed), overrides={"a1": "0"})
        assert laid.spot("max_s14") == pytest.approx(ROD + R, rel=1e-6)
        assert laid.spot("max_at_s14") == pytest.approx(360, abs=0.05)
        assert laid.spot("stroke_s14") == pytest.approx(2 * R, rel=1e-5)

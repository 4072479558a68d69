"""A base circle that is not the one at which a follower starts is said to be another one."""

import pytest

from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.doubts.base_circle import base_circle_doubts
from mechsheet.kinematics.solve import solve
from random_cams import ON_A_SLIDE

SLIDE = (
    ON_A_SLIDE + 'driver = { joint = "s", step = 5, START segments = [{ law = "3-4-5", over = 90, by = 12 }, LATER] }'
)
BACK = '{ law = "3-4-5", over = 90, to = 0 }, { law = "dwell" }'
BELOW = '{ law = "3-4-5", over = 90, by = -20 }, { law = "cycloidal", to = 0 }'


def said(start, later=BACK):
    mechanism = loads(SLIDE.replace("START", start).replace("LATER", later))
    return list(base_circle_doubts(mechanism, solve(mechanism)))


@pytest.mark.parametrize("start", ["", "start = 42.71,", 'start = "sqrt(43^2 - 5^2)",'])
def test_a_start_on_the_base_circle_is_not_doubted(start):
    assert said(start) == []


@pytest.mark.parametrize(("start", "near"), [(60, 52.2080), (40, 32.3113)])
def test_a_start_elsewhere_is(start, near):
    (fault,) = said(f"start = {start},")
    assert fault.key == "cam.base_radius"
    assert f"as near to its centre as {near:g}" in str(fault.message)
    assert "`start`" in str(fault.hint)


EVEN = {
    "roller": "roller = { point = 'F', radius = 8 }",
    "edge": "roller = { point = 'F', radius = 0 }",
    "face": "face = { link = 'tappet', point = 'F', angle = 90 }",
}
STARTS = {"roller": "sqrt(43^2 - 5^2)", "edge": "sqrt(35^2 - 5^2)", "face": "35"}


@pytest.mark.parametrize("written", [False, True])
@pytest.mark.parametrize("touch", EVEN)
def test_a_profile_that_never_rests_stays_outside_its_base_circle(touch, written):
    """Down and up at even speed the follower turns at its lowest place without resting there: a face is touched beside."""
    text = SLIDE.replace('roller = { point = "F", radius = 8 }', EVEN[touch])
    segments = '{ law = "uniform", over = 180, to = 30 }, { law = "uniform", to = 0 }'
    text = text.replace('{ law = "3-4-5", over = 90, by = 12 }, LATER', segments)
    mechanism = loads(text.replace("START", f'start = "{STARTS[touch]}",' if written else ""))
    assert list(base_circle_doubts(mechanism, solve(mechanism))) == []


def test_where_it_rests_a_wrong_start_is_doubted_of_an_even_motion():
    """It waits at its lowest place: there the profile would come to the base circle."""
    later = '{ law = "uniform", over = 90, to = 0 }, { law = "dwell" }'
    (fault,) = said("start = 60,", later)
    assert "as near to its centre as 52.208;" in str(fault.message)


@pytest.mark.parametrize(("start", "doubted"), [("sqrt(43^2 - 5^2) + 30", False), ("sqrt(43^2 - 5^2) + 32", True)])
def test_a_motion_that_ends_between_two_rows_is_compared_at_its_end(start, doubted):
    """It only falls, over 100 degrees in rows of 15: the last row is 10 degrees before the lowest place."""
    text = SLIDE.replace("step = 5, START", f'step = 15, closed = false, start = "{start}",')
    text = text.replace('{ law = "3-4-5", over = 90, by = 12 }, LATER', '{ law = "harmonic", over = 100, by = -30 }')
    mechanism = loads(text)
    assert bool(list(base_circle_doubts(mechanism, solve(mechanism)))) == doubted


def test_a_motion_that_goes_below_its_start_is():
    (fault,) = said("", BELOW)
    assert "lowest" in str(fault.hint)


@pytest.mark.parametrize("name", ["cam-slide", "cam-flat", "cam-rocker", "cam-linkage", "cam-valve"])
def test_templates_are_not_doubted(name):
    mechanism = loads(template_text(name))
    assert list(base_circle_doubts(mechanism, solve(mechanism))) == []

"""A sweep whose first row is a dead centre: both assemblies are one there, and a later row tells which one is meant."""

import numpy as np
import pytest

from judging import judged
from mechsheet.description import loads
from mechsheet.kinematics.solve import solve

FOUR_BAR = """format = 1
[mechanism]
name = "dead-centre"
[dimensions]
a1 = {a1}
a2 = {a2}
a3 = {a3}
a4 = {a4}
[links.ground]
points = {{ A0 = [0, 0], B0 = ["a1", 0] }}
[links.arm]
points = {{ A0 = [0, 0], A = ["a2", 0] }}
[links.coupler]
points = {{ A = [0, 0], B = ["a3", 0] }}
[links.rocker]
points = {{ B0 = [0, 0], B = ["a4", 0] }}
[driver]
link = "arm"
values = ["acos((a1^2 + a2^2 - {reach}^2) / (2*a1*a2))", "acos((a1^2 + a2^2 - {reach}^2) / (2*a1*a2)) {turn} pi/18"]
[assembly]
B = [{x}, {y}]
"""

SLIDER_CRANK = """format = 1
[mechanism]
name = "dead-centre"
[dimensions]
a2 = 100
a3 = 60
[links.ground]
points = {{ A0 = [0, 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = ["a2", 0] }}
[links.coupler]
points = {{ A = [0, 0], B = ["a3", 0] }}
[links.piston]
points = {{ B = [0, 0] }}
[[joints]]
type = "prismatic"
link = "piston"
on = "ground"
point = "B"
through = "A0"
[driver]
link = "crank"
values = ["asin(a3/a2)", "asin(a3/a2) - pi/36", 0]
[assembly]
B = [{x}, 0]
"""


def random_four_bars(count):
    """Dimensions of four-bars that have a stretched (folded: False) or folded dead centre, from one seed."""
    random = np.random.default_rng(7)
    while count:
        a1, a2, a3, a4 = (round(float(length), 2) for length in random.uniform(20, 300, 4))
        stretched = bool(count % 2)
        reach = a3 + a4 if stretched else abs(a3 - a4)
        if abs((a1**2 + a2**2 - reach**2) / (2 * a1 * a2)) < 0.95:
            count -= 1
            yield a1, a2, a3, a4, stretched


def four_bar(a1, a2, a3, a4, stretched, x, y):
    reach, turn = ("(a3 + a4)", "-") if stretched else ("(a3 - a4)", "+")
    return loads(FOUR_BAR.format(a1=a1, a2=a2, a3=a3, a4=a4, reach=reach, turn=turn, x=x, y=y))


@pytest.mark.slow
@pytest.mark.parametrize("lengths", list(random_four_bars(12)))
def test_both_assemblies_follow_the_sketch_and_the_reference(lengths):
    picked = set()
    for x, y in ((0, -1000), (0, 1000), (1000, 0), (-1000, 0)):
        mechanism = four_bar(*lengths, x, y)
        (group,) = solve(mechanism).groups
        picked.add(group.mode_value)
        comparison = judged(mechanism)
        assert comparison.agrees, comparison
    assert picked == {1, -1}


@pytest.mark.parametrize(("x", "mode"), [(150, 1), (20, -1)])
def test_slider_crank_with_a_coupler_shorter_than_the_crank(x, mode):
    mechanism = loads(SLIDER_CRANK.format(x=x))
    (group,) = solve(mechanism).groups
    assert group.mode_value == mode
    assert judged(mechanism).agrees


def test_a_good_sketch_of_the_dead_centre_itself_leaves_the_mode_open():
    mechanism = loads(SLIDER_CRANK.format(x=80).replace("pi/36", "pi/3600"))
    (group,) = solve(mechanism).groups
    assert (group.mode_value, group.open) == (1, True)
    assert judged(mechanism).agrees


ROBOT = """format = 1
[mechanism]
name = "robot"
[links.base]
points = {{ A0 = [0, 0], B0 = [100, 0] }}
[links.left]
points = {{ A0 = [0, 0], A = [60, 0] }}
[links.left-rod]
points = {{ A = [0, 0], P = [80, 0] }}
[links.right-rod]
points = {{ B = [0, 0], P = [80, 0] }}
[links.right]
points = {{ B0 = [0, 0], B = [60, 0] }}
[driver]
link = "left"
values = [120, 110, 100]
[[drivers]]
link = "right"
values = [60, 65, 70]
[assembly]
P = [50, {y}]
at = 105
"""


def test_a_position_between_rows_of_listed_further_drivers_may_be_sketched():
    """At 105° the other driver is half way between its values of the rows around."""
    above, below = (loads(ROBOT.format(y=y)) for y in (120, 0))
    assert judged(above).agrees
    assert judged(below).agrees
    assert {solve(above).groups[0].mode_value, solve(below).groups[0].mode_value} == {1, -1}


def test_a_position_of_a_motion_law_may_be_sketched_at_another_value():
    """It is shown at `at`, where the rocker is above or below, and not at the first row of the law."""
    head, _ = FOUR_BAR.format(a1=70, a2=35, a3=62.3, a4=56, reach=60, turn="+", x=0, y=0).split("[driver]")
    sweep = '[driver]\nlink = "arm"\nstart = 0\nstop = 300\n'
    law, steps = 'motion = { law = "harmonic", duration = 1, rows = 9 }', "step = 30"
    for y in (20, -20):
        modes = {
            solve(loads(f"{head}{sweep}{way}\n[assembly]\nB = [18, {y}]\nat = 180\n")).groups[0].mode_value
            for way in (law, steps)
        }
        assert len(modes) == 1


def test_a_mechanism_of_any_size_is_told_by_its_sketch():
    """Angles among its dimensions are no lengths: beside one of 0.7 rad a mechanism of 1e-7 mm is no point."""
    for size in (1e-9, 1.0, 1e7):
        text = FOUR_BAR.format(a1=70 * size, a2=35 * size, a3=62 * size, a4=56 * size, reach=80 * size, turn="+",
                               x=49 * size, y=-55 * size)  # fmt: skip
        text = text.replace("[links.ground]", 'tilt = { value = 40, unit = "deg" }\n[links.ground]', 1)
        equations = solve(loads(text))
        assert [(group.mode_value, group.open) for group in equations.groups] == [(-1, False)]

"""Rows that go down beside a speed that leads up are doubted, and nothing else."""

import pytest

from mechsheet.description import loads
from mechsheet.kinematics.doubts.sketched import doubts
from mechsheet.kinematics.solve import solve

ARM = """
format = 1
mechanism.name = "arm"
dimensions.w = "3 rad/s"
links.ground.points = { O = [0, 0] }
links.arm.points = { O = [0, 0], A = [60, 0] }
links.block.points = { B = [0, 0] }
joints = [{ type = "prismatic", link = "block", on = "arm", point = "B", through = "O", symbol = "s" }]
drivers = [{ joint = "s", value = 40 }]
driver = { link = "arm", ROWS }
"""


def said(rows):
    mechanism = loads(ARM.replace("ROWS", rows))
    return list(doubts(mechanism, solve(mechanism)))


@pytest.mark.parametrize(
    ("rows", "hint"),
    [
        ('start = 0, stop = -20, step = -1, speed = "30 deg/s"', 'write speed = "-30 deg/s"; '),
        ("start = 90, stop = 30, step = -5, speed = 0.5", 'write speed = "-0.5 rad/s"; '),
        ('start = 360, stop = 0, step = -30, speed = { value = 60, unit = "rpm" }', 'write speed = "-60 rpm"; '),
        ('values = [60, 40, 10], speed = "w/2"', "put a minus before the speed; "),
    ],
)
def test_the_minus_that_was_forgotten(rows, hint):
    (fault,) = said(rows)
    assert fault.key == "driver.speed"
    assert fault.hint.startswith(hint)
    if "write speed = " in hint:
        new = hint.removeprefix("write speed = ").removesuffix("; ")
        assert said(rows[: rows.index("speed")] + f"speed = {new}") == []


@pytest.mark.parametrize(
    "rows",
    [
        'start = 0, stop = 20, step = 1, speed = "30 deg/s"',
        'start = 0, stop = 360, step = 10, speed = "-60 rpm"',  # a crank that turns clockwise, listed by its angle
        'start = 0, stop = -20, step = -1, speed = "cos(theta12)"',
        "start = 0, stop = -20, step = -1, speed = 0",
        "start = 0, stop = -20, step = -1",
        "values = [30, 60, 90, 60], speed = [1, 1.2, 0, -1.2]",
        "values = [60, 30, 10], speed = [1, 1, 1]",
        "values = [60, 90, 10], speed = 2",
        "values = [60], speed = 2",
        'start = 90, stop = 0, motion = { law = "harmonic", duration = 1 }',
    ],
)
def test_what_may_be_meant_is_not_doubted(rows):
    assert said(rows) == []

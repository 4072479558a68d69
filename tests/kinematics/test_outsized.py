"""A number in another unit than the one that counts: said once, and nothing is refused."""

import warnings

import pytest

from mechsheet.description import loads
from mechsheet.diagnostics import DescriptionWarning
from mechsheet.kinematics.doubts.sketched import tell
from mechsheet.kinematics.doubts.slips import inertia_doubts, sweep_doubts
from mechsheet.kinematics.solve import solve

ROCKER = """
format = 1
mechanism.name = "rocker"
mechanism.length_unit = "UNIT"
links.ground.points = { O = [0, 0] }
links.arm = { points = { O = [0, 0], A = [60, 0] }, mass = "1 kg", center = [20, 0], inertia = INERTIA }
driver = { link = "arm", start = 0, stop = 90, step = 15, speed = 1 }
"""


def said(inertia, unit="mm"):
    return list(inertia_doubts(loads(ROCKER.replace("INERTIA", inertia).replace("UNIT", unit))))


def test_square_millimetres_for_square_metres():
    (fault,) = said("500")
    assert fault.key == "links.arm.inertia"
    assert str(fault.message) == (
        "with this mass the radius of gyration is 2.24e+04 mm, 373 times the size of the mechanism"
    )
    assert '"500 kg mm²"' in str(fault.hint)


@pytest.mark.parametrize(
    ("inertia", "unit"),
    [("5e-4", "mm"), ('"500 kg mm2"', "mm"), ("0.5", "mm"), ("500", "m"), ("0", "mm"), ('"3 lb in2"', "in")],
)
def test_what_a_link_or_a_geared_motor_may_have_is_not_doubted(inertia, unit):
    assert said(inertia, unit) == []


def test_it_is_told_as_a_warning():
    mechanism = loads(ROCKER.replace("INERTIA", "500").replace("UNIT", "mm"))
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        tell(mechanism, solve(mechanism))
    assert [warning.category for warning in caught] == [DescriptionWarning]


ARM = """
format = 1
mechanism = { name = "arm", angle_unit = "UNIT" }
links.ground.points = { O = [0, 0] }
links.arm.points = { O = [0, 0], A = [60, 0] }
driver = { link = "arm", ROWS }
"""


def said_of_rows(rows, unit="rad"):
    return list(sweep_doubts(loads(ARM.replace("ROWS", rows).replace("UNIT", unit))))


@pytest.mark.parametrize(
    "rows",
    [
        "start = 0, stop = 360, step = 5",
        "start = 0, stop = -90, step = -5",
        "values = [0, 30, 60]",
        'start = 0, stop = 90, motion = { law = "harmonic", duration = 1 }',
    ],
)
def test_degrees_for_radians(rows):
    (fault,) = said_of_rows(rows)
    assert fault.key == "driver"
    assert 'angle_unit = "deg"' in str(fault.hint)
    assert said_of_rows(rows, "deg") == []


@pytest.mark.parametrize(
    "rows",
    [
        "start = 0, stop = 6.2, step = 0.1",
        "start = 0, stop = 62, step = 0.5",  # ten turns, finely
        'start = "0°", stop = "360°", step = "60°"',  # coarsely, one turn
        "values = [0, 1.57, 3.14, 4.71]",
    ],
)
def test_radians_are_not_doubted(rows):
    assert said_of_rows(rows) == []

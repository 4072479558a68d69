"""How far what Newton's method seeks may leave its trend: angles in radians, lengths in parts of the mechanism's size."""

from types import SimpleNamespace

import pytest

from mechsheet.description import loads
from mechsheet.kinematics.newton.changed_dimensions import TREND, scales, trends
from mechsheet.units import ANGLE, LENGTH

TWO_LINKS = """
format = 1
[mechanism]
name = "pendulum"
[links.ground]
points = { A0 = [0, 0] }
[links.crank]
points = { A0 = [0, 0], A = [80, 0] }
[driver]
link = "crank"
start = 0
stop = 90
step = 15
"""


def test_angles_and_lengths_are_measured_by_their_own_kind():
    """Were a length measured as an angle is, a group in metres would never leave its trend, one in mm always."""
    units = {"theta13": ANGLE, "s14": LENGTH}
    found = loads(TWO_LINKS), SimpleNamespace(of=lambda name: SimpleNamespace(unit=units[name]))
    system = SimpleNamespace(variables=("theta13", "s14"))
    assert scales(*found, system) == (1.0, 80.0)
    assert trends(*found, system) == pytest.approx((TREND, 80 * TREND))

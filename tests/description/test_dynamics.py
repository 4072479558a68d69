"""Loads as they are read: numbers are cells, a 0 is none, what differs from row to row stands as it is."""

import pytest

from in_line import IN_LINE
from livesheet.formula.algebra import ZERO, neg
from livesheet.formula.nodes import Symbol, symbols
from mechsheet.description import loads
from mechsheet.diagnostics import DescriptionError
from mechsheet.kinematics.dimensions import dimension_values

LOADS = """
[[loads]]
link = "piston"
force = [-5, 0]
[[loads]]
link = "crank"
torque = "2*r"
[[loads]]
link = "rod"
point = "B"
force = [0, "3*sin(theta12)"]
"""


def test_every_force_and_torque_arrives():
    """A load left out, or taken as 0, is a driving torque that is too small."""
    mechanism = loads(IN_LINE + LOADS)
    piston, crank, rod = mechanism.dynamics.loads
    values = dimension_values(mechanism)
    assert piston.force == (Symbol("L1_x"), ZERO) and values["L1_x"] == -5
    assert crank.torque == Symbol("L2") and values["L2"] == 100
    assert rod.force[0] == ZERO and {*symbols(rod.force[1])} == {"theta12"}
    assert (piston.point, crank.point, rod.point) == ("B", "", "B")


def test_gravity_has_a_direction_or_points_downwards():
    """[gx, gy] in the ground's frame; one number is downwards, however it is written."""
    both, down = (loads(f"{IN_LINE}{LOADS}[dynamics]\ngravity = {given}\n") for given in ("[3, -9.81]", "9.81"))
    found = dimension_values(both) | dimension_values(down)
    assert both.dynamics.gravity == (Symbol("g_x"), Symbol("g_y"))
    assert down.dynamics.gravity == (ZERO, neg(Symbol("g")))
    assert (found["g_x"], found["g_y"], found["g"]) == (3, -9.81, 9.81)


def test_a_spring_joins_two_points():
    """The first link that has a point holds it; without damping there is none."""
    (spring,) = loads(IN_LINE + '[[loads]]\nbetween = ["A0", "B"]\nstiffness = 2\nfree_length = 180\n').dynamics.springs
    assert spring.ends == (("ground", "A0"), ("rod", "B"))
    assert (spring.stiffness, spring.free_length, spring.damping) == (Symbol("k_L1"), Symbol("l_L1"), ZERO)


def test_a_flywheel_of_a_motion_that_takes_no_time_is_no_crash():
    """A speed that is no finite number: the faults of the text are told, this is none of them."""
    text = """format = 1
[dimensions]
a1 = 1e90
[links.ground]
points = { A = [0, 0] }
[links.crank]
points = { A = [0, 0], B = ["a1", 0] }
[driver]
link = "crank"
start = 0
stop = "a1"
motion = { law = "constant", duration = 1e-90 }
[flywheel]
fluctuation = 1e-99
"""
    with pytest.raises(DescriptionError):
        loads(text)

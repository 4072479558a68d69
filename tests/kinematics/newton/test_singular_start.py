"""A group that is singular in the first position is refused: with a value at which it is not, or as one that is free."""

import pytest

from mechsheet.description import loads
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.solve import solve

TOGGLE = """
format = 1
[mechanism]
name = "toggle"
[dimensions]
a1 = 70
a2 = 30
a3 = 100
a4 = 60
[links.ground]
points = { A0 = [0, 0], B0 = ["a1", 0] }
[links.crank]
points = { A0 = [0, 0], A = ["a2", 0] }
[links.coupler]
points = { A = [0, 0], B = ["a3", 0] }
[links.rocker]
points = { B0 = [0, 0], B = ["a4", 0] }
[driver]
link = "crank"
start = 0
stop = 90
step = 15
[solution]
force = true
[assembly]
B = [90, 55]
"""

LEG = """
[links.crank{n}]
points = {{ O{n} = [0, 0], P{n} = ["r", 0] }}
[links.leg{n}]
points = {{ P{n} = [0, 0], Q{n} = ["{length}", 0] }}
"""

BELT = """
[[joints]]
type = "belt"
link = "crank{n}"
on = "crank1"
ratio = 1
phase = 0
"""


def platform(third="l"):
    """Three cranks that stay parallel carry a plate on three legs, parallel as well where they are equal."""
    legs = "".join(LEG.format(n=n, length=length) for n, length in ((1, "l"), (2, "l"), (3, third)))
    return f"""
format = 1
[mechanism]
name = "platform"
[dimensions]
r = 30
l = 80
b = 100
h = 90
[links.ground]
points = {{ O1 = [0, 0], O2 = ["b", 0], O3 = [0, "h"] }}
{legs}
[links.plate]
points = {{ Q1 = [0, 0], Q2 = ["b", 0], Q3 = [0, "h"] }}
{BELT.format(n=2)}{BELT.format(n=3)}
[driver]
link = "crank1"
start = 0
stop = 30
step = 15
[assembly]
Q1 = [80, 60]
Q2 = [180, 60]
Q3 = [80, 150]
"""


def test_where_coupler_and_rocker_are_in_line_the_next_row_is_named():
    """s = a1 - a2 = a3 - a4: the dead centre itself; half a degree on the assemblies are apart."""
    with pytest.raises(MechanismError) as error:
        solve(loads(TOGGLE))
    (fault,) = error.value.faults
    assert fault.message == "two assemblies of coupler, rocker: pins A, B, B0 meet in the first position"
    assert fault.hint == "at theta12 = 15 they are apart: begin the sweep there, or walk it the other way"
    assert solve(loads(TOGGLE.replace("start = 0", "start = 0.5"))).groups[0].system is not None


def test_where_there_are_no_next_rows_a_value_beside_is_named():
    with pytest.raises(MechanismError, match=r"at theta12 = 0\.1 they are apart"):
        solve(loads(TOGGLE.replace("stop = 90", "stop = 0")))


def test_equal_and_parallel_legs_are_free_to_move():
    with pytest.raises(MechanismError) as error:
        solve(loads(platform()))
    (fault,) = error.value.faults
    assert "free to move while the driver stands" in fault.message
    assert "at theta12 = 0 and at theta12 = 15" in fault.message


def test_legs_of_different_lengths_hold():
    assert solve(loads(platform("1.1*l"))).groups[0].kind == "III"

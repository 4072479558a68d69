"""Forces and masses with lengths in inches and feet: their units, pounds, and what does not belong together."""

import pytest

from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.diagnostics import DescriptionError

TEXT = """\
format = 1
[mechanism]
name = "inch"
length_unit = "LENGTH"
[dimensions]
k = "20 lbf/LENGTH"
[links.ground]
points = { A0 = [0, 0], B0 = [6, 0] }
[links.crank]
points = { A0 = [0, 0], A = [2, 0] }
mass = "386.0886 lb"
center = [1, 0]
[links.coupler]
points = { A = [0, 0], B = [7, 0] }
[links.rocker]
points = { B0 = [0, 0], B = [5, 0] }
[driver]
link = "crank"
start = 0
stop = 360
step = 30
speed = 6
[dynamics]
gravity = "9.80665 m/s²"
MORE
[[loads]]
name = "K"
between = ["B", "A0"]
stiffness = "k"
free_length = 4
[assembly]
B = [5, 4]
"""


def inch(length="in", more=""):
    return loads(TEXT.replace("LENGTH", length).replace("MORE", more))


@pytest.mark.parametrize(
    ("length", "mass", "inertia", "torque", "per_unit"),
    [("in", "lbf s²/in", "lbf in s²", "lbf in", 1), ("ft", "slug", "slug ft²", "lbf ft", 12)],
)
def test_units_go_with_the_length_and_a_weight_is_what_a_scale_shows(length, mass, inertia, torque, per_unit):
    """386.0886 lb are 386.0886 lbf on earth, whatever the length unit is."""
    mechanism = inch(length)
    units = {dim.symbol: dim.unit.text for dim in mechanism.dimensions}
    assert (units["m_2"], units["J_2"], units["k"], units["k_K"]) == (mass, inertia, f"lbf/{length}", f"lbf/{length}")
    shown = {dim.symbol: dim.shown for dim in mechanism.dimensions}
    assert shown["m_2"] == pytest.approx(1 * per_unit, rel=1e-6)
    assert shown["m_2"] * shown["g"] == pytest.approx(386.0886, rel=1e-6)
    efforts = {each.symbol: each.unit.text for each in Compiled(mechanism).equations.columns}
    assert efforts["T12"] == torque


def test_what_does_not_belong_together_is_refused_with_what_is_right():
    with pytest.raises(DescriptionError, match="1 lbf is not 1 lb times 1 in/s²") as refused:
        inch(more='mass_unit = "lb"')
    (fault,) = refused.value.faults
    assert (fault.key, fault.line) == ("dynamics.mass_unit", 25)
    assert 'mass = "5 lb"' in fault.hint
    assert inch("ft", 'mass_unit = "lbf s²/ft"')
    with pytest.raises(DescriptionError, match="1 lbf is not 1 slug times 1 in/s²"):
        inch(more='mass_unit = "slug"')


def test_units_of_ones_own_are_not_judged():
    own = TEXT.replace('"386.0886 lb"', "3").replace('"9.80665 m/s²"', "386").replace("LENGTH", "cubit")
    mechanism = loads(own.replace('"20 lbf/cubit"', "20").replace("MORE", 'force_unit = "F"\nmass_unit = "M"'))
    assert (mechanism.dynamics.force_unit, mechanism.dynamics.mass_unit) == ("F", "M")

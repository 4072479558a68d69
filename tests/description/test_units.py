"""A description with units behind its numbers is the one with plain numbers."""

import math

import pytest

import mechsheet
from mechsheet.checking.edited.pull import pull
from mechsheet.diagnostics import DescriptionError

TEXT = """format = 1
[mechanism]
name = "four-bar"
[dimensions]
a1 = {a1}
a2 = {a2}
a3 = 62.3
a4 = 56
P = {P}
[links.ground]
points = {{ A0 = [0, 0], B0 = ["a1", 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = ["a2", 0] }}
mass = {mass}
center = "A"
inertia = {inertia}
[links.coupler]
points = {{ A = [0, 0], B = ["a3", 0] }}
[links.rocker]
points = {{ B0 = [0, 0], B = ["a4", 0] }}
[[loads]]
link = "rocker"
point = "B"
force = [{force}, "-P"]
[[loads]]
name = "K"
between = ["A0", "B"]
stiffness = {k}
[driver]
link = "crank"
start = 0
stop = {stop}
step = 15
speed = {speed}
[assembly]
B = [50, 55]
"""
PLAIN = {
    "a1": "70",
    "a2": "35",
    "P": '{ value = 2000, unit = "N" }',
    "mass": "0.2",
    "inertia": "0.0003",
    "force": "20",
    "k": "0.3",
    "stop": "360",
    "speed": '{ value = 60, unit = "rpm" }',
}
WITH_UNITS = {
    "a1": '"7 cm"',
    "a2": '{ value = "35 mm", label = "crank" }',
    "P": '"2 kN"',
    "mass": '"200 g"',
    "inertia": '"300 kg mm²"',
    "force": '"0.02 kN"',
    "k": '"300 N/m"',
    "stop": '"360°"',
    "speed": '"60 rpm"',
}


def text(**changes):
    return TEXT.format(**WITH_UNITS | changes)


def test_the_motion_is_that_of_plain_numbers():
    plain, same = (mechsheet.loads(TEXT.format(**given)).solve() for given in (PLAIN, WITH_UNITS))
    assert list(plain) == list(same)
    assert plain.units == same.units
    for name in plain:
        assert plain[name] == pytest.approx(same[name], rel=1e-14, nan_ok=True)


def test_a_dimension_has_the_unit_of_its_cell():
    dims = {dim.symbol: dim for dim in mechsheet.loads(text()).dimensions}
    shown = {name: (dims[name].shown, dims[name].unit.text) for name in ("a1", "a2", "P", "speed", "m_2", "k_K")}
    assert shown == {
        "a1": (70.0, "mm"),
        "a2": (35.0, "mm"),
        "P": (2000.0, "N"),
        "speed": (60.0, "rpm"),
        "m_2": (0.2, "kg"),
        "k_K": (0.3, "N/mm"),
    }
    assert dims["omega12"].written == "speed*pi/30"


@pytest.mark.parametrize(
    ("name", "value", "line"),
    [
        ("a1", "8 cm", "a1 = 80"),
        ("a1", "65", "a1 = 65"),
        ("a2", "36", 'a2 = { value = 36, label = "crank" }'),
        ("P", "2500", 'P = "2500 N"'),
        ("P", "3 kN", 'P = "3000 N"'),
    ],
)
def test_another_value_is_written_with_the_unit_that_it_is_in(name, value, line):
    changed = mechsheet.loads(text(), overrides={name: value})
    assert line in changed.text.splitlines()
    again = {dim.symbol: dim.shown for dim in mechsheet.loads(changed.text).dimensions}
    assert again[name] == next(dim.shown for dim in changed.dimensions if dim.symbol == name)


@pytest.mark.slow
def test_what_was_typed_into_a_workbook_comes_back_in_the_unit_of_its_cell(tmp_path):
    mine = tmp_path / "mine.toml"
    mine.write_text(text(), encoding="utf-8")
    (built,) = mechsheet.load(mine).build(tmp_path, formats="xlsx")
    session = mechsheet.open_book(built)
    session.update({"P": 2500, "speed": 65, "m_2": 0.3, "L1_x": 30})
    session.write(built)
    lines = pull(built).text.splitlines()
    for line in ('P = "2500 N"', 'speed = "65 rpm"', "mass = 0.3", 'force = [30, "-P"]'):
        assert line in lines


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"a1": '"7 px"'}, 'a1: unknown unit "px"'),
        ({"speed": '"60 mm/s"'}, 'speed: "60 mm/s" where rad/s are needed'),
        ({"speed": '"60 N"'}, 'speed: "60 N" where rad/s are needed'),
        ({"k": '"3 mm"'}, 'stiffness: "3 mm" where N/mm are needed'),
        ({"stop": '"2 cm"'}, 'stop: "2 cm" where deg are needed'),
        ({"force": '"2 a1"'}, 'in "2 a1"'),
        ({"P": '{ value = 2, unit = "kN" }'}, 'write value = "2 kN"'),
        ({"a2": '{ value = "35 mm", unit = "cm" }'}, "the value says its unit already"),
    ],
)
def test_what_does_not_fit_is_told_and_no_other_value_is_advised(changes, message):
    with pytest.raises(DescriptionError) as caught:
        mechsheet.loads(text(**changes))
    assert message in str(caught.value)


def test_a_product_without_its_sign_is_no_unit():
    with pytest.raises(DescriptionError, match=r'write "2\*P"'):
        mechsheet.loads(text(force='"2 P"'))


def test_a_displacement_has_a_speed_in_lengths():
    source = mechsheet.template("cylinder-boom").text
    source = source.replace("[driver]", '[driver]\nspeed = "0.05 m/s"')
    (speed,) = [dim for dim in mechsheet.loads(source).dimensions if dim.path == ("driver", "speed")]
    assert (speed.shown, speed.unit.text) == (50.0, "mm/s")


def test_an_angle_is_an_angle():
    source = text().replace("P = ", 'phi = "30°"\npsi = "0.5 rad"\nP = ', 1)
    dims = {dim.symbol: dim for dim in mechsheet.loads(source).dimensions}
    assert dims["phi"].value == math.radians(30)
    assert (dims["psi"].value, dims["psi"].unit.text) == (0.5, "rad")


@pytest.mark.parametrize(
    ("where", "given", "said"),
    [
        ("inertia", '"3 furlong"', 'links.crank.inertia: unknown unit "furlong"'),
        ("inertia", '"3 kg miles2"', 'links.crank.inertia: unknown unit "kg miles2"'),
        ("speed", '"60 RPM"', 'did you mean "rpm"?'),
        ("k", '"0.3 N per mm"', 'loads[2].stiffness: unknown unit "N per mm"'),
        ("k", '"2 a2"', 'a product is written with "*"'),
        ("k", '"P"', 'loads[2].stiffness: "P" is in N where N/mm are needed'),
        ("k", '"-P"', 'loads[2].stiffness: "-P" is in N where N/mm are needed'),
        ("stop", '"P"', '"P" is in N where an angle is needed'),
    ],
)
def test_what_a_unit_that_does_not_fit_is_told(where, given, said):
    with pytest.raises(DescriptionError) as error:
        mechsheet.loads(text(**{where: given}))
    assert said in str(error.value)


def test_an_acceleration_in_millimetres_is_no_gravity_in_metres():
    own = text().replace("a3 = 62.3", 'a3 = 62.3\nfall = "9810 mm/s²"')
    with pytest.raises(DescriptionError, match=r'"fall" is in mm/s² where m/s² are needed'):
        mechsheet.loads(own + '[dynamics]\ngravity = "fall"\n')


def test_a_force_is_no_length():
    with pytest.raises(DescriptionError, match='"a2" is in N where a length is needed'):
        mechsheet.loads(text(a2='"35 N"'))


@pytest.mark.parametrize("given", ['"0.001*P"', '"k"'])
def test_what_may_be_meant_is_taken(given):
    """A factor may be a conversion, and a dimension without a unit is what its place needs."""
    mechsheet.loads(text(k=given).replace("a3 = 62.3", "a3 = 62.3\nk = 0.3"))

"""Units as a person reads them, and the numbers behind them."""

import math

import numpy as np
import pytest

from mechsheet.description import loads
from mechsheet.units import ANGLE, DEG, LENGTH, NUMBER, RAD, Unit, unit_of

MM = unit_of("mm", "mm")
CRANK = """
format = 1
mechanism = {{ name = "crank", length_unit = "cm", angle_unit = "{angle}" }}
links.ground.points = {{ O = [0, 0] }}
links.crank.points = {{ O = [0, 0], A = [3, 0] }}
driver = {{ link = "crank", start = 0, stop = 1, step = 0.1 }}
outputs.double = {{ formula = "2*theta12", unit = "{output}" }}
"""


@pytest.mark.parametrize(
    ("unit", "text"),
    [
        (DEG, "°"),
        (RAD, "rad"),
        (MM, "mm"),
        (NUMBER, ""),
        (MM.per_time(), "mm/s"),
        (RAD.per_time().per_time(), "rad/s²"),
        (DEG.per_time(), "°/s"),
        (NUMBER.per_time(), "1/s"),
        (MM.per_time().per_time().per_time(), "mm/s³"),
        (Unit("force", "N"), "N"),
        (Unit("moment", "N·m"), "N·m"),
    ],
)
def test_how_units_are_written(unit, text):
    assert unit.text == text


@pytest.mark.parametrize(
    ("symbol", "kind"),
    [("deg", "angle"), ("rad", "angle"), ("cm", "length"), ("1", "number"), ("mm", "label"), ("mm^2", "label")],
)
def test_units_of_a_description_in_centimetres(symbol, kind):
    unit = unit_of(symbol, "cm")
    assert (unit.kind, unit.symbol) == (kind, symbol)


@pytest.mark.parametrize("angle", [0.0, 1e-9, 0.1, math.pi / 6, 2.0, 6.3, 1e6])
def test_degrees_are_those_of_the_mathematics_library_to_the_last_bit(angle):
    assert DEG.to_shown(angle) == math.degrees(angle)
    assert DEG.to_internal(angle) == math.radians(angle)
    assert np.array_equal(DEG.to_shown(np.array([angle])), np.degrees([angle]))
    assert RAD.to_shown(angle) == MM.to_internal(angle) == angle


def test_rates_keep_kind_and_factor():
    speed = DEG.per_time()
    assert (speed.kind, speed.factor, speed.per) == ("angle", DEG.factor, 1)
    assert speed.internal == RAD.per_time()
    assert MM.internal == MM


@pytest.mark.parametrize(("angle", "degrees"), [("deg", True), ("rad", False)])
def test_an_equation_is_shown_as_the_mechanism_shows_its_kind(angle, degrees):
    crank = loads(CRANK.format(angle=angle, output="deg"))
    assert crank.shown(ANGLE).in_degrees == degrees
    assert crank.shown(ANGLE.per_time()).text == ("°/s" if degrees else "rad/s")
    assert (crank.shown(LENGTH).text, crank.shown(LENGTH.per_time()).text) == ("cm", "cm/s")
    assert crank.shown(NUMBER).text == ""


@pytest.mark.parametrize("angle", ["deg", "rad"])
@pytest.mark.parametrize("output", ["deg", "rad"])
def test_an_output_is_shown_in_its_own_unit(angle, output):
    crank = loads(CRANK.format(angle=angle, output=output))
    assert crank.shown(crank.outputs[0].unit).symbol == output


@pytest.mark.parametrize("degrees", [0.0, 15.0, -7.5, 30.0, 35.538, 360.0])
def test_degrees_come_back_as_they_were_written(degrees):
    assert DEG.written(DEG.to_internal(degrees)) == degrees
    assert DEG.written(math.radians(1 / 3)) == math.degrees(math.radians(1 / 3))
    assert RAD.written(0.1) == MM.written(0.1) == 0.1

"""Numbers with their unit, as people write them."""

import math

import pytest

from mechsheet.description.text.numbers import home, like, measured


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("20 mm", "mm", 20.0),
        ("2 cm", "mm", 20.0),
        ("0.3 m", "mm", 300.0),
        ("1 in", "mm", 25.4),
        ("30°", "deg", 30.0),
        ("30 derece", "deg", 30.0),
        ("180 deg", "rad", math.pi),
        ("60 rpm", "rad/s", 2 * math.pi),
        ("60 1/min", "rpm", 60.0),
        ("60 d/dk", "rpm", 60.0),
        ("2 kN", "N", 2000.0),
        ("300 N/m", "N/mm", 0.3),
        ("5 N·s/m", "N s/mm", 0.005),
        ("12 Nmm", "N m", 0.012),
        ("300 kg mm²", "kg m²", 0.0003),
        ("9.81 m/s^2", "m/s²", 9.81),
        ("-2.5e3 g", "kg", -2.5),
        ("20 birim", "birim", 20.0),
        ("5 Ns/mm", "N s/mm", 5.0),
        ("5 N.m", "N m", 5.0),
        ("2 kNm", "N m", 2000.0),
        ("300 kg mm2", "kg m²", 0.0003),
        ("3 kgm²", "kg m²", 3.0),
        ("9.81 m/s2", "m/s²", 9.81),
        ("6 rad/sec", "rad/s", 6.0),
        ("1 Hz", "rpm", 60.0),
    ],
)
def test_a_number_in_another_unit(text, unit, value):
    assert measured(text).in_unit(unit) == pytest.approx(value, rel=1e-15)


@pytest.mark.parametrize(("text", "unit"), [("2 kN", "mm"), ("60 rpm", "s"), ("3 px", "mm"), ("3 mm", "1")])
def test_of_another_kind(text, unit):
    assert measured(text).in_unit(unit) is None


@pytest.mark.parametrize("text", ["20", "2*a1", "a1", "2,5 mm", "1e999999999 mm", "60/min", "3 a b", ""])
def test_what_is_no_number_with_a_unit(text):
    assert measured(text) is None


@pytest.mark.parametrize(("unit", "known"), [("RPM", "rpm"), ("Kg", "kg"), ("KN", "kN"), ("furlong", "")])
def test_a_unit_of_other_capitals_is_known(unit, known):
    assert like(unit) == known


def test_in_which_unit_a_dimension_has_it():
    assert home(measured("2 cm"), "mm") == (20.0, "mm")
    assert home(measured("0.5 rad"), "mm") == (0.5, "rad")
    assert home(measured("2 kN"), "mm") == (2000.0, "N")
    assert home(measured("9.81 m/s²"), "mm") == (9.81, "m/s²")
    assert home(measured("9.81 mm/s²"), "mm") == (9.81, "mm/s²")
    assert home(measured("2 kN"), "ell") is None  # nobody knows what a force is there

"""Numbers as people type them."""

import pytest

from mechsheet.description.text.numbers import typed_number, with_points


@pytest.mark.parametrize(
    ("typed", "text", "unit", "why"),
    [
        ("35", "35", "", ""),
        (" -.5 ", "-0.5", "", ""),
        ("+007", "+7", "", ""),
        ("5.", "5", "", ""),
        ("1e-7", "1e-7", "", ""),
        ("65,5", "65.5", "", "the decimal sign is a point"),
        ("1.234,5", "1234.5", "", "the decimal sign is a point"),
        ("−5", "-5", "", "is not the minus sign of a keyboard"),
        ("30°", "30", "°", 'the unit "°" stands behind the number'),
        ("62.3 mm", "62.3", "mm", 'the unit "mm" stands behind the number'),
    ],
)
def test_what_a_number_is_meant_as(typed, text, unit, why):
    found = typed_number(typed)
    assert (found.text, found.unit) == (text, unit)
    assert found.why.endswith(why)
    assert bool(found.why) == bool(why)


@pytest.mark.parametrize("typed", ["", "a1", "2*a1", "1_000", "١", "nan", "1,2,3"])
def test_what_is_no_number(typed):
    assert typed_number(typed) is None


def test_lists_with_decimal_commas():
    assert with_points("[50,5, 55,2]") == ["50.5", "55.2"]
    assert with_points("[50,5,55,2]") == ["50.5", "55.2"]
    assert with_points("[50, 55]") is None

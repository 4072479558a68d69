"""What makes the functions the same everywhere: one way to every bit, and the values that no rounding touches."""

import hashlib
import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from livesheet import portable
from livesheet.portable.steps import PIECE

ONE = ["arccos", "arcsin", "arctan", "cos", "exp", "log", "log10", "sin", "tan"]
SPECIAL = [0.0, -0.0, math.inf, -math.inf, math.nan, 1.0, -1.0, 5e-324, 1.7e308, -2.0, 0.5]
floats = st.floats(width=64) | st.floats(-10, 10) | st.sampled_from(SPECIAL)


def bits(values):
    """Floats as whole numbers; all NaN alike."""
    values = np.asarray(values, np.float64)
    return np.where(np.isnan(values), -1, values.view(np.int64)).tolist()


@pytest.mark.cases(5)
@pytest.mark.parametrize("name", ONE)
@settings(deadline=None)
@given(st.lists(floats, min_size=1, max_size=20))
def test_an_array_has_the_bits_of_its_numbers(name, numbers):
    function = getattr(portable, name)
    with np.errstate(all="ignore"):
        assert bits(function(np.array(numbers))) == bits([function(number) for number in numbers])


@pytest.mark.slow
@settings(deadline=None)
@given(st.lists(floats, min_size=1, max_size=20))
def test_sine_and_cosine_together_have_the_bits_of_each(numbers):
    with np.errstate(all="ignore"):
        for x in (np.array(numbers), numbers[0]):
            assert [bits(part) for part in portable.sin_and_cos(x)] == [bits(portable.sin(x)), bits(portable.cos(x))]


@pytest.mark.ci
@settings(deadline=None)
@given(st.lists(st.tuples(floats, floats), min_size=1, max_size=20))
def test_arrays_of_two_have_the_bits_of_their_numbers(pairs):
    first, second = np.array(pairs).T
    with np.errstate(all="ignore"):
        for function in (portable.arctan2, portable.power):
            assert bits(function(first, second)) == bits([function(*pair) for pair in pairs])


def test_a_long_array_is_computed_in_pieces_with_the_same_bits():
    x = np.random.default_rng(1).uniform(-9, 9, (3, PIECE))
    assert bits(portable.sin(x)) == [bits(portable.sin(row)) for row in x]
    assert [bits(part) for part in portable.sin_and_cos(x)] == [bits(portable.sin(x)), bits(portable.cos(x))]
    whole = portable.arctan2(x, x[:, ::-1])
    assert bits(whole) == [bits(portable.arctan2(row, row[::-1])) for row in x]


@pytest.mark.parametrize("name", ONE)
def test_limits_are_those_of_the_standard(name):
    """Zeros with their signs, infinities, NaN outside the domain: as numpy has them."""
    numbers = np.array(SPECIAL)
    with np.errstate(all="ignore"):
        found, expected = getattr(portable, name)(numbers), getattr(np, name)(numbers)
    assert np.allclose(found, expected, rtol=1e-15, atol=0, equal_nan=True)
    there = ~np.isnan(expected)
    assert np.array_equal(np.signbit(found[there]), np.signbit(expected[there]))


def test_limits_of_directions_and_powers():
    first, second = np.meshgrid(SPECIAL, SPECIAL)
    with np.errstate(all="ignore"):
        for name in ("arctan2", "power"):
            found, expected = getattr(portable, name)(first, second), getattr(np, name)(first, second)
            assert np.allclose(found, expected, rtol=1e-15, atol=0, equal_nan=True), name
            there = ~np.isnan(expected)
            assert np.array_equal(np.signbit(found[there]), np.signbit(expected[there])), name


@pytest.mark.parametrize(("name", "wrong"), [("sin", math.inf), ("arcsin", 1.5), ("arccos", -2.0), ("log", -1.0),
                                             ("log", 0.0), ("exp", 1e4), ("log10", 0.0), ("tan", math.inf)])  # fmt: skip
def test_numpy_hears_the_alarm(name, wrong):
    """The engine's fast code stops at the processor's flags."""
    with np.errstate(divide="raise", over="raise", invalid="raise"), pytest.raises(FloatingPointError):
        getattr(portable, name)(np.array([0.25, wrong]))
    with np.errstate(all="raise", under="ignore"):
        assert np.isfinite(getattr(portable, name)(np.array([0.25, 0.5]))).all()


def test_published_bits():
    """A fingerprint of many results, the same wherever this is run."""
    rng = np.random.default_rng(2)
    x = rng.integers(-(2**52), 2**52, 2000) / 2.0**49
    parts = [getattr(portable, name)(x) for name in ("sin", "cos", "tan", "arctan", "exp")]
    parts += [portable.arcsin(x / 8), portable.arccos(x / 8), portable.log(np.abs(x)), portable.log10(np.abs(x))]
    parts += [portable.arctan2(x, x[::-1]), portable.power(np.abs(x), x[::-1])]
    assert hashlib.sha256(np.concatenate(parts).astype("<f8").tobytes()).hexdigest() == (
        "1ba2855e184a109a2252802970b41fc378882b6bb24008f7efd1c72845ee60d0"
    )

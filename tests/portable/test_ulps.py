"""The functions that are the same everywhere: below one unit in the last place, by mpmath with digits enough."""

import math

import mpmath
import numpy as np
import pytest

from livesheet import portable

COUNT = 300


def drawn(seed):
    """Numbers of every size, near 0, near 1, and beside multiples of pi/4."""
    rng = np.random.default_rng(seed)
    quarters = np.arange(1, 60) * (math.pi / 4)
    return np.concatenate([
        rng.uniform(-1, 1, COUNT), rng.uniform(-7, 7, COUNT), rng.uniform(-1e6, 1e6, COUNT),
        rng.uniform(-1, 1, COUNT) * 10.0 ** rng.uniform(-300, 300, COUNT), 1 + rng.uniform(-1, 1, COUNT) * 1e-9,
        quarters, np.nextafter(quarters, 0), np.nextafter(quarters, 1e3), quarters * 2.0**900,
        [5e-324, 1e-300, 1e6, math.nextafter(1e6, 2e6), 6381956970095103 * 2.0**797, 5319372648326541 * 2.0**-38],
    ])  # fmt: skip


def inside(seed):
    """Sines and cosines, many of them close to 1, 1/2, 0."""
    rng = np.random.default_rng(seed)
    close = 10.0 ** rng.uniform(-16, 0, COUNT)
    return np.concatenate([
        rng.uniform(-1, 1, COUNT), 1 - close, close - 1, close, 0.5 + close / 1e3, -0.5 - close / 1e3,
        [0.5, -0.5, 1, -1, math.nextafter(0.5, 0), math.nextafter(1, 0)],
    ])  # fmt: skip


def above_zero(seed):
    numbers = np.abs(drawn(seed))
    return numbers[numbers > 0]


CASES = {
    "sin": (drawn, mpmath.sin),
    "cos": (drawn, mpmath.cos),
    "tan": (drawn, mpmath.tan),
    "arctan": (drawn, mpmath.atan),
    "arcsin": (inside, mpmath.asin),
    "arccos": (inside, mpmath.acos),
    "exp": (lambda seed: np.concatenate([drawn(seed)[:600], np.linspace(-707, 709.7, 400)]), mpmath.exp),
    "log": (above_zero, mpmath.log),
    "log10": (above_zero, mpmath.log10),
}


def units(found, true):
    """How many units in the last place a float is from the truth."""
    return float(abs(mpmath.mpf(found) - true) / mpmath.mpf(math.ulp(float(true))))


def digits_for(number):
    """Binary digits that a sine of it needs: those of the number, and as many again."""
    return 200 + 2 * max(0, math.frexp(number)[1])


@pytest.mark.parametrize("name", CASES)
def test_below_one_unit_in_the_last_place(name):
    numbers, true = CASES[name]
    worst = 0.0
    numbers = numbers(11)
    for x, found in zip(numbers.tolist(), getattr(portable, name)(numbers).tolist(), strict=True):
        with mpmath.workprec(digits_for(x)):
            worst = max(worst, units(found, true(mpmath.mpf(x))))
    assert worst < 0.9


def test_directions():
    rng = np.random.default_rng(3)
    wide = [rng.uniform(-1, 1, 900) * 10.0 ** rng.uniform(-size, size, 900) for size in (0, 0, 5, 5, 300, 300)]
    y = np.concatenate([wide[0], wide[2], wide[4], [1e-310, 1.7e308, 1e308]])
    x = np.concatenate([wide[1], wide[3], wide[5], [3e-310, -1.7e308, 1e-308]])
    found = portable.arctan2(y, x)
    with mpmath.workprec(200):
        true = [mpmath.atan2(mpmath.mpf(a), mpmath.mpf(b)) for a, b in zip(y.tolist(), x.tolist(), strict=True)]
        worst = max(units(a, b) for a, b in zip(found.tolist(), true, strict=True) if abs(b) > 1e-307)
    assert worst < 0.9


def test_powers():
    """To the ends of the numbers, and of numbers close to 1 to very large exponents."""
    rng = np.random.default_rng(5)
    base = np.concatenate([rng.uniform(0, 20, 400), 1 + rng.uniform(-1, 1, 300) * 10.0 ** rng.uniform(-15, -2, 300)])
    exponent = np.concatenate([rng.uniform(-90, 90, 400), rng.uniform(-1, 1, 300) * 10.0 ** rng.uniform(0, 16, 300)])
    assert worst_power(base, exponent) < 0.9


def test_whole_powers_are_correctly_rounded():
    rng = np.random.default_rng(7)
    assert worst_power(rng.uniform(-20, 20, 300), rng.integers(-9, 10, 300).astype(float)) <= 0.5
    assert [portable.power(10.0, float(n)) for n in range(-300, 300)] == [float(f"1e{n}") for n in range(-300, 300)]


def worst_power(base, exponent):
    with np.errstate(all="ignore"):
        found = portable.power(base, exponent).tolist()
    with mpmath.workprec(300):
        true = [mpmath.mpf(a) ** mpmath.mpf(b) for a, b in zip(base.tolist(), exponent.tolist(), strict=True)]
        return max(units(a, b) for a, b in zip(found, true, strict=True) if 1e-300 < abs(b) < 1e308)


@pytest.mark.parametrize("exponent", [1.0, 2.0, -1.0, 3.0, 0.5])
def test_a_column_to_one_power_has_the_bits_of_its_numbers(exponent):
    base = np.random.default_rng(6).uniform(0, 9, 200)
    assert portable.power(base, exponent).tolist() == [portable.power(x, exponent) for x in base.tolist()]

"""Sine, cosine and tangent of an angle [rad], of any size."""

from __future__ import annotations

import math
from functools import cache
from typing import Any, TypeAlias

import numpy as np

from .steps import Real, in_pieces, polynomial, remainder

Parts: TypeAlias = tuple[Any, Any]
"""A number and what it lacks."""

_PER_QUARTER = 0.6366197723675814  # 2 / pi
_QUARTER = 1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21
"""pi / 2 in three parts: the first two have 33 digits, so that up to 2^20 of them are exact."""

_MOST = 1e6
_CANCELLED = 3.5e-18  # 2^-58
"""A remainder below so much of the quarters taken away has lost digits of its tail."""

_SINE = (
    -0.16666666666666666, 0.008333333333330925, -0.00019841269836722418, 2.755731608381636e-06,
    -2.5051127944014188e-08, 1.5917848524808262e-10,
)  # fmt: skip
"""(sin x - x) / x^3 over x^2, to pi/4."""
_COSINE = (
    0.041666666666666664, -0.0013888888888887382, 2.480158729874307e-05, -2.7557317260008837e-07,
    2.0876143827993133e-09, -1.1382456778061306e-11,
)  # fmt: skip
"""(cos x - 1 + x^2/2) / x^4 over x^2, to pi/4."""

_BITS = 1280
"""Digits of pi that the largest number, 2^1024, needs, and as many as two floats hold."""


def sin(x: Any) -> Any:
    """sin x, x in radians."""
    if np.ndim(x) == 0:
        if x == 0:
            return float(x)  # with its sign
        quadrant, y, tail = _reduced(float(x))
        found = _cosine(y, tail) if quadrant & 1 else _sine(y, tail)
        return -found if quadrant & 2 else found
    return in_pieces(lambda part: _with_zeros(part, _circular(part, 0.0)), np.asarray(x, np.float64))


def cos(x: Any) -> Any:
    """cos x, x in radians."""
    if np.ndim(x) == 0:
        quadrant, y, tail = _reduced(float(x))
        found = _sine(y, tail) if quadrant & 1 else _cosine(y, tail)
        return -found if (quadrant + 1) & 2 else found
    return in_pieces(lambda part: _circular(part, 1.0), np.asarray(x, np.float64))


def tan(x: Any) -> Any:
    """tan x, x in radians."""
    if np.ndim(x) == 0:
        if x == 0:
            return float(x)
        quadrant, y, tail = _reduced(float(x))
        sine, cosine = _sine_parts(y, tail), _cosine_parts(y, tail)
        return _ratio((-cosine[0], -cosine[1]), sine) if quadrant & 1 else _ratio(sine, cosine)
    return in_pieces(lambda part: _with_zeros(part, _tangents(part)), np.asarray(x, np.float64))


def sin_and_cos(x: Any) -> tuple[Any, Any]:
    """`sin` and `cos` of the same angles: what an angle leaves of its quarters, and both series, are computed once."""
    if np.ndim(x) == 0:
        return sin(x), cos(x)
    found = in_pieces(_sines_and_cosines, np.asarray(x, np.float64), results=2)
    return found[0], found[1]


def _circular(x: Any, ahead: float) -> Any:
    """The sine of angles, or the cosine, which is a quarter `ahead`."""
    quarters, y, tail = _all_reduced(x)
    quadrant = _quadrant(quarters + ahead)
    found: Any = np.where((quadrant == 1.0) | (quadrant == 3.0), _cosine(y, tail), _sine(y, tail))
    return np.where(quadrant >= 2.0, -found, found)


def _sines_and_cosines(x: Any) -> Parts:
    quarters, y, tail = _all_reduced(x)
    quadrant = _quadrant(quarters)
    sines, cosines = _sine(y, tail), _cosine(y, tail)
    second = quadrant == 1.0
    odd = second | (quadrant == 3.0)
    sine: Any = np.where(odd, cosines, sines)
    cosine: Any = np.where(odd, sines, cosines)
    sine = np.where(quadrant >= 2.0, -sine, sine)
    return _with_zeros(x, sine), np.where(second | (quadrant == 2.0), -cosine, cosine)


def _quadrant(quarters: Any) -> Any:
    """0..3."""
    return quarters - 4.0 * np.floor(quarters * 0.25)


def _with_zeros(x: Any, found: Any) -> Any:
    """What is found of a function that keeps zeros with their signs."""
    zeros = x == 0.0
    if zeros.any():
        found[zeros] = x[zeros]
    return found


def _tangents(x: Any) -> Any:
    quarters, y, tail = _all_reduced(x)
    odd = quarters - 2.0 * np.floor(quarters * 0.5) == 1.0
    sine, cosine = _sine_parts(y, tail), _cosine_parts(y, tail)
    over = np.where(odd, np.negative(cosine), sine)
    under = np.where(odd, sine, cosine)
    return _ratio((over[0], over[1]), (under[0], under[1]))


# for |y| <= pi/4, of an angle y + tail


def _sine(y: Real, tail: Real) -> Real:
    first, rest = _sine_terms(y, tail)
    return first + rest


def _cosine(y: Real, tail: Real) -> Real:
    first, rest = _cosine_terms(y, tail)
    return first + rest


def _sine_terms(y: Real, tail: Real) -> Parts:
    z = y * y
    cube = z * y
    higher = polynomial(_SINE[1:], z) * z
    return y, ((cube * higher - z * (0.5 * tail)) + tail) + cube * _SINE[0]


def _cosine_terms(y: Real, tail: Real) -> Parts:
    z = y * y
    half = 0.5 * z
    first = 1.0 - half
    return first, ((1.0 - first) - half) + ((z * z) * polynomial(_COSINE, z) - y * tail)


def _joined(first: Real, rest: Real) -> Parts:
    total = first + rest
    return total, (first - total) + rest


def _sine_parts(y: Real, tail: Real) -> Parts:
    return _joined(*_sine_terms(y, tail))


def _cosine_parts(y: Real, tail: Real) -> Parts:
    return _joined(*_cosine_terms(y, tail))


def _ratio(over: Parts, under: Parts) -> Real:
    """A quotient of numbers in two parts."""
    quotient = over[0] / under[0]
    return quotient + ((remainder(over[0], quotient, under[0]) + over[1]) - quotient * under[1]) / under[0]


# quarters taken away


def _reduced(x: float) -> tuple[int, float, float]:
    """(quadrant 0..3, y, tail): what is left of x, |y| <= pi/4, in two parts. NaN of what is not finite."""
    if not abs(x) <= _MOST:
        return _exactly_reduced(x) if math.isfinite(x) else (0, math.nan, math.nan)
    quarters = float(round(x * _PER_QUARTER))
    y, tail = _less(x, quarters)
    if abs(y) < abs(quarters) * _CANCELLED:
        return _exactly_reduced(x)
    return int(quarters) & 3, y, tail


def _all_reduced(x: Any) -> tuple[Any, Any, Any]:
    """(quarters as numbers, y, tail) of many angles."""
    quarters = np.rint(x * _PER_QUARTER)
    y, tail = _less(x, quarters)
    size = np.abs(quarters)
    size *= _CANCELLED
    hard = np.abs(y) < size
    hard |= np.abs(x) > _MOST
    if hard.any():
        hard &= np.isfinite(x)
        for place in zip(*np.nonzero(hard), strict=True):
            quarters[place], y[place], tail[place] = _exactly_reduced(float(x[place]))
    return quarters, y, tail


def _less(x: Real, quarters: Real) -> Parts:
    """x less so many quarters of a turn, in two parts."""
    first = x - quarters * _QUARTER[0]  # exact, as is the product
    taken = quarters * _QUARTER[1]
    second = first - taken
    moved = second - first
    lost = (first - (second - moved)) - (taken + moved)
    rest = lost - quarters * _QUARTER[2]
    y = second + rest
    return y, (second - y) + rest


def _exactly_reduced(x: float) -> tuple[int, float, float]:
    """The same in whole numbers, for angles that are very large or very close to a multiple of a quarter."""
    numerator, denominator = x.as_integer_ratio()
    quarter = _quarter()
    scaled = (numerator << _BITS) // denominator  # exact: a float that large has less than 1075 digits behind the point
    count = (2 * scaled + quarter) // (2 * quarter)
    rest = scaled - count * quarter
    unit = 1 << _BITS
    y = rest / unit
    over, under = y.as_integer_ratio()
    return count & 3, y, (rest - (over * unit) // under) / unit


@cache
def _quarter() -> int:
    """pi / 2 in units of 2^-1280, by J. Machin's formula."""
    spare = 32  # digits for what the divisions cut off
    one = 1 << (_BITS + spare)

    def arctan_of_inverse(n: int) -> int:
        power = total = one // n
        k = 1
        while power:
            power //= n * n
            k += 2
            total += power // k if k % 4 == 1 else -(power // k)
        return total

    return (2 * (4 * arctan_of_inverse(5) - arctan_of_inverse(239))) >> spare

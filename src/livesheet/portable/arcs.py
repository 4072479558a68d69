"""Arc functions [rad]: the direction of a point, and what follows from sines, cosines and tangents."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .steps import Real, head, in_pieces, polynomial, remainder

_ARCTAN = (
    0.3333333333333333, -0.19999999999999404, 0.14285714285565465, -0.111111110965279, 0.09090908350382436,
    -0.07692285419714515, 0.06666239748865294, -0.05876924062763387, 0.05216532007308444, -0.044916556747777434,
    0.033114228762660534, -0.014759380407779157,
)  # fmt: skip
"""(t - arctan t) / t^3 over t^2, to 7/16."""
_ARCSIN = (
    0.16666666666666669, 0.07499999999998433, 0.04464285714635543, 0.030381944138531247, 0.02237217294214989,
    0.017352392720869973, 0.013971212973552933, 0.011479177415184906, 0.01032281435018578, 0.005457506718640358,
    0.01740087944269402, -0.014851887071247204, 0.028757851367421566,
)  # fmt: skip
"""(arcsin x - x) / x^3 over x^2, to 1/2."""

_PI, _PI_REST = 3.141592653589793, 1.2246467991473532e-16
_HALF, _HALF_REST = 1.5707963267948966, 6.123233995736766e-17
_QUARTER = 0.7853981633974483
_BESIDE = (0.0, 0.0), (0.4636476090008061, 2.2698777452961687e-17), (_QUARTER, 3.061616997868383e-17)
"""The directions of (1, 0), (2, 1) and (1, 1), in two parts: a point's direction is found from the nearest of them."""
_P, _Q = (1.0, 2.0, 1.0), (0.0, 1.0, 1.0)

_LARGEST, _SMALLEST = 2.0**400, 2.0**-400
"""Between these no product of two coordinates overflows or loses digits."""


def _corners() -> tuple[list[float], list[float], list[float]]:
    """By band, whether the point lies nearer to the y-axis, and whether left of it: where the direction's sum starts (in
    two parts) and which way it goes."""
    firsts, rests, ways = [], [], []
    for left in (False, True):
        for steep in (False, True):
            start, rest = (_HALF, _HALF_REST) if steep else (_PI, _PI_REST) if left else (0.0, 0.0)
            way = -1.0 if steep != left else 1.0
            for first, more in _BESIDE:
                total = start + way * first
                error = (start - total) + way * first
                firsts.append(total)
                rests.append(error + (rest + way * more))
                ways.append(way)
    return firsts, rests, ways


_FIRSTS, _RESTS, _WAYS = _corners()
_TABLES = tuple(np.array(table) for table in (_FIRSTS, _RESTS, _WAYS, 4 * _P, 4 * _Q))


def arctan2(y: Any, x: Any) -> Any:
    """The direction of the point (x, y) from +x, -pi..pi; y first, as numpy has it. Of (0, 0) it is 0 or pi."""
    if np.ndim(y) == 0 and np.ndim(x) == 0:
        return _direction(float(y), float(x))
    return in_pieces(_directions, np.asarray(y, np.float64), np.asarray(x, np.float64))


def arctan(x: Any) -> Any:
    """arctan x, -pi/2..pi/2."""
    return arctan2(x, 1.0)


def arcsin(x: Any) -> Any:
    """arcsin x, -pi/2..pi/2; NaN outside -1..1."""
    if np.ndim(x) == 0:
        x = float(x)
        return _arcsin_inside(x) if abs(x) < 0.5 else math.copysign(_arcsin_outside(abs(x)), x)
    return in_pieces(_arcsines, np.asarray(x, np.float64))


def arccos(x: Any) -> Any:
    """arccos x, 0..pi; NaN outside -1..1."""
    if np.ndim(x) == 0:
        x = float(x)
        return _arccos_inside(x) if abs(x) < 0.5 else _arccos_left(x) if x < 0 else _arccos_right(x)
    return in_pieces(_arccosines, np.asarray(x, np.float64))


# directions


def _direction(y: float, x: float) -> float:
    if math.isnan(x) or math.isnan(y):
        return math.nan
    short, long = abs(y), abs(x)
    steep = short > long
    if steep:
        short, long = long, short
    if not _SMALLEST < long < _LARGEST:
        short, long = _of_middle_size(short, long)
    band = (16.0 * short >= 7.0 * long) + (16.0 * short >= 11.0 * long)
    place = band + 3 * steep + 6 * (math.copysign(1.0, x) < 0)
    angle = _FIRSTS[place] + (_RESTS[place] + _WAYS[place] * _from_corner(short, long, _P[band], _Q[band]))
    return math.copysign(angle, y)


def _directions(y: Any, x: Any) -> Any:
    short, long = np.abs(y), np.abs(x)
    steep = short > long
    short, long = np.minimum(short, long), np.maximum(short, long)
    usual = (long > _SMALLEST) & (long < _LARGEST)
    if not usual.all():
        for place in zip(*np.nonzero(~usual), strict=True):
            short[place], long[place] = _of_middle_size(float(short[place]), float(long[place]))
    sixteen = 16.0 * short
    lower, upper, left = sixteen >= 7.0 * long, sixteen >= 11.0 * long, np.signbit(x)
    place = lower.view(np.int8) + upper.view(np.int8) + 3 * steep.view(np.int8) + 6 * left.view(np.int8)
    place = place.astype(np.intp)  # once, not for each table
    firsts, rests, ways, p, q = (table.take(place) for table in _TABLES)
    angle = firsts + (rests + ways * _from_corner(short, long, p, q))
    return np.copysign(angle, y)


def _from_corner(short: Real, long: Real, p: Real, q: Real) -> Real:
    """The angle from the direction (p, q) to (long, short): the arc tangent of a quotient whose numerator has no error."""
    over = p * short - q * long
    first = p * long
    under = first + q * short
    lost = (first - under) + q * short
    t = over / under
    rest = (remainder(over, t, under) - t * lost) / under
    z = t * t
    return t + (rest * (1.0 - z) - t * (z * polynomial(_ARCTAN, z)))


def _of_middle_size(short: float, long: float) -> tuple[float, float]:
    """The same direction for coordinates that are 0, infinite, very large or very small."""
    if math.isnan(long) or math.isnan(short):
        return math.nan, math.nan
    if long == 0.0:
        return 0.0, 1.0
    if math.isinf(long):
        return (1.0 if math.isinf(short) else 0.0), 1.0
    _, exponent = math.frexp(long)
    return math.ldexp(short, -exponent), math.ldexp(long, -exponent)


# arc sine and cosine: near 1 by the half angle, whose sine is a root


def _series(square: Real) -> Real:
    """arcsin x / x - 1, from the square of x."""
    return square * polynomial(_ARCSIN, square)


def _half_angle(size: Real, root: Any) -> tuple[Real, Real, Real, Real]:
    """For 1/2 <= size <= 1: the sine of half the angle whose cosine is size (whole, head, the rest of its digits), and the
    series of that angle."""
    square = (1.0 - size) * 0.5
    sine = root(square)
    first = head(sine)
    under = sine + first
    rest = (square - first * first) / (under + (under == 0.0))
    return sine, first, rest, _series(square)


def _root(x: float) -> float:
    return math.sqrt(x) if x >= 0 else math.nan


def _arcsin_inside(x: Real) -> Real:
    return x + x * _series(x * x)


def _arcsin_outside(size: Real, root: Any = _root) -> Real:
    sine, first, rest, series = _half_angle(size, root)
    return _QUARTER - ((2.0 * (sine * series) - (_HALF_REST - 2.0 * rest)) - (_QUARTER - 2.0 * first))


def _arccos_inside(x: Real) -> Real:
    return _HALF - (x - (_HALF_REST - x * _series(x * x)))


def _arccos_right(x: Real, root: Any = _root) -> Real:
    sine, first, rest, series = _half_angle(x, root)
    return 2.0 * (first + (sine * series + rest))


def _arccos_left(x: Real, root: Any = _root) -> Real:
    sine, _, _, series = _half_angle(-x, root)
    return _PI - 2.0 * (sine + (sine * series - _HALF_REST))


def _arcsines(x: Any) -> Any:
    size = np.abs(x)
    inside = size < 0.5
    result = np.empty(x.shape)
    result[inside] = _arcsin_inside(x[inside])
    result[~inside] = np.copysign(_arcsin_outside(size[~inside], np.sqrt), x[~inside])
    return result


def _arccosines(x: Any) -> Any:
    inside, left = np.abs(x) < 0.5, x <= -0.5
    right = ~(inside | left)
    result = np.empty(x.shape)
    result[inside] = _arccos_inside(x[inside])
    result[left] = _arccos_left(x[left], np.sqrt)
    result[right] = _arccos_right(x[right], np.sqrt)
    return result

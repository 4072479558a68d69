"""The exponential function and the natural logarithm."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .steps import Real, in_pieces, polynomial

LN2, LN2_REST = 0.6931471803691238, 1.9082149292705877e-10
"""ln 2 in two parts; the first has 32 digits: products with exponents are exact."""
_PER_LN2 = 1.4426950408889634
ROOT_HALF = 0.7071067811865476

_EXP = (
    0.5, 0.16666666666666666, 0.04166666666666668, 0.008333333333333333, 0.0013888888888879054,
    0.00019841269841263285, 2.480158733649766e-05, 2.755731924725567e-06, 2.7557263219790347e-07,
    2.505207105477011e-08, 2.09181596693241e-09, 1.6086642574672407e-10,
)  # fmt: skip
"""(e^r - 1 - r) / r^2, |r| to ln(2) / 2."""
_LOG = (
    0.6666666666666666, 0.4000000000000088, 0.28571428570801954, 0.22222222392089008, 0.18181795600060793,
    0.15386241881938595, 0.13268714792348096, 0.1308723619665962,
)  # fmt: skip
"""(ln((1 + s) / (1 - s)) / s - 2) / s^2 over s^2, for numbers from sqrt(1/2) to sqrt(2)."""

_RANGE = 800.0
"""Beyond it e^x is 0 or infinite."""


def exp(x: Any) -> Any:
    """e^x."""
    if np.ndim(x) == 0:
        x = float(x)
        if math.isnan(x):
            return math.nan
        return exp_of_two(min(max(x, -_RANGE), _RANGE), 0.0)
    return in_pieces(_exponentials, np.asarray(x, np.float64))


def log(x: Any) -> Any:
    """The natural logarithm; NaN below 0, -infinity at 0."""
    if np.ndim(x) == 0:
        x = float(x)
        if not 0.0 < x < math.inf:
            return x if x == math.inf else -math.inf if x == 0.0 else math.nan
        fraction, exponent = math.frexp(x)
        return _log_of(2.0 * fraction, exponent - 1.0) if fraction < ROOT_HALF else _log_of(fraction, float(exponent))
    return in_pieces(_logarithms, np.asarray(x, np.float64))


def exp_of_two(x: Real, more: Real) -> Real:
    """e^(x + more), more being far smaller than x, |x| to 800."""
    if np.ndim(x) == 0:
        count = float(round(x * _PER_LN2))
        try:
            return math.ldexp(_exp_less(x, more, count), int(count))
        except OverflowError:
            return math.inf
    counts = np.rint(x * _PER_LN2)
    return np.ldexp(_exp_less(x, more, counts), np.where(np.isnan(counts), 0.0, counts).astype(np.int32))


def _exp_less(x: Real, more: Real, count: Real) -> Real:
    """e^(x + more) / 2^count."""
    high, low = x - count * LN2, count * LN2_REST
    r = high - low
    rest = (high - r) - low
    over = r + (rest + r * r * polynomial(_EXP, r))
    total = 1.0 + over
    return total + (((1.0 - total) + over) + total * more)


def _exponentials(x: Any) -> Any:
    return exp_of_two(np.minimum(np.maximum(x, -_RANGE), _RANGE), 0.0)


def _log_of(number: Real, exponent: Real) -> Real:
    """ln(number 2^exponent), number from sqrt(1/2) to sqrt(2)."""
    f = number - 1.0
    s = f / (2.0 + f)
    z = s * s
    half = 0.5 * f * f
    return exponent * LN2 - ((half - (s * (half + z * polynomial(_LOG, z)) + exponent * LN2_REST)) - f)


def _logarithms(x: Any) -> Any:
    fraction, exponent = np.frexp(x)
    small = fraction < ROOT_HALF
    with np.errstate(all="ignore"):
        found = _log_of(np.where(small, 2.0 * fraction, fraction), np.where(small, exponent - 1.0, exponent))
    outside = ~((x > 0.0) & (x < np.inf))
    if outside.any():
        found[outside] = np.log(x[outside])  # NaN and infinity, which no library rounds, with numpy's own alarm
    return found

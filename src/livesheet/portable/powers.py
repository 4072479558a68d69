"""Powers, the exponential function, logarithms.

A whole exponent, and what lies near the ends of the numbers, is left to Python's decimal arithmetic, which is the same
everywhere, number by number. Other powers are e^(exponent ln base), the logarithm to some 65 digits in two parts.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from .steps import Real, in_pieces, polynomial, remainder

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
    return in_pieces(_natural_logarithms, np.asarray(x, np.float64))


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


def _natural_logarithms(x: Any) -> Any:
    fraction, exponent = np.frexp(x)
    small = fraction < ROOT_HALF
    with np.errstate(all="ignore"):
        found = _log_of(np.where(small, 2.0 * fraction, fraction), np.where(small, exponent - 1.0, exponent))
    outside = ~((x > 0.0) & (x < np.inf))
    if outside.any():
        found[outside] = np.log(x[outside])  # NaN and infinity, which no library rounds, with numpy's own alarm
    return found


_DIGITS = 40

_PARTS = 32
"""A number from sqrt(1/2) to sqrt(2) is divided by the next multiple of 1/32, whose logarithm is known."""

_SERIES = (0.6666666666666666, 0.4, 0.2857142857142857, 0.2222222222222222)
"""(ln((1 + s) / (1 - s)) / s - 2) / s^2 over s^2, |s| to 1/90: 2/3 + 2/5 s^2 + ..."""

_MOST = 700.0
"""Powers of e beyond it come near the largest and smallest numbers."""
_MOST_EXPONENT = 2.0**400


def power(base: Any, exponent: Any) -> Any:
    """base^exponent, as IEEE 754 has it: NaN for roots of negatives."""
    if np.ndim(base) == 0 and np.ndim(exponent) == 0:
        return _power(float(base), float(exponent))
    return in_pieces(_powers, np.asarray(base, np.float64), np.asarray(exponent, np.float64))


def log10(x: Any) -> Any:
    """The decimal logarithm; NaN below 0, -infinity at 0."""
    if np.ndim(x) == 0:
        return _log10(float(x))
    x = np.asarray(x, np.float64)
    return _alarmed(np.log10, [_log10(number) for number in x.ravel().tolist()], x)


def _power(base: float, exponent: float) -> float:
    if not (0.0 < base < math.inf and abs(exponent) < _MOST_EXPONENT) or exponent == math.floor(exponent):
        return _by_decimals(base, exponent)
    fraction, power_of_two = math.frexp(base)
    if fraction < ROOT_HALF:
        fraction, power_of_two = 2.0 * fraction, power_of_two - 1
    place = round(fraction * _PARTS)
    first, rest = _logarithms()[place]
    high, low = _product(exponent, *_in_two(fraction, float(power_of_two), place / _PARTS, first, rest))
    return exp_of_two(high, low) if abs(high) <= _MOST else _by_decimals(base, exponent)


def _powers(base: Any, exponent: Any) -> Any:
    base, exponent = np.broadcast_arrays(base, exponent)
    with np.errstate(all="ignore"):
        there = (base > 0.0) & (base < np.inf) & (np.abs(exponent) < _MOST_EXPONENT) & (exponent != np.floor(exponent))
        fraction, powers_of_two = np.frexp(np.where(there, base, 1.0))
        small = fraction < ROOT_HALF
        fraction, powers_of_two = np.where(small, 2.0 * fraction, fraction), powers_of_two - small
        place = np.rint(fraction * _PARTS).astype(np.intp)
        first, rest = np.array(_logarithms())[place].T
        high, low = _product(
            np.where(there, exponent, 0.0), *_in_two(fraction, powers_of_two, place / _PARTS, first.T, rest.T)
        )
        there &= np.abs(high) <= _MOST
        found = exp_of_two(np.where(there, high, 0.0), low)
    hard = ~there
    if hard.any():
        pairs = zip(base[hard].tolist(), exponent[hard].tolist(), strict=True)
        found[hard] = _alarmed(np.power, [_by_decimals(*pair) for pair in pairs], base[hard], exponent[hard])
    return found


def _in_two(fraction: Real, power_of_two: Real, part: Real, first: Real, rest: Real) -> tuple[Real, Real]:
    """ln(fraction 2^power_of_two) in two parts; first and rest are ln(part), part beside the fraction."""
    over, under = fraction - part, fraction + part
    lost = _missing(fraction, part, under)
    s = over / under
    tail = (remainder(over, s, under) - s * lost) / under
    z = s * s
    series = 2.0 * tail + s * (z * polynomial(_SERIES, z))
    twos = power_of_two * LN2
    known = twos + first
    total = known + 2.0 * s
    missing = _missing(twos, first, known) + _missing(known, 2.0 * s, total)
    missing = missing + (series + (rest + power_of_two * LN2_REST))
    logarithm = total + missing
    return logarithm, _missing(total, missing, logarithm)


def _missing(a: Real, b: Real, total: Real) -> Real:
    """What the sum of two numbers has lost, whichever is larger. D. E. Knuth."""
    other = total - a
    return (a - (total - other)) + (b - other)


def _product(factor: Real, high: Real, low: Real) -> tuple[Real, Real]:
    product = factor * high
    return product, factor * low - remainder(product, factor, high)


@cache
def _logarithms() -> tuple[tuple[float, float], ...]:
    """ln(n / 32) in two parts, by n; 0 where nobody asks."""
    from decimal import Context, Decimal

    context = Context(prec=_DIGITS)
    found = [(0.0, 0.0)] * 22
    for n in range(22, 47):
        exact = context.ln(Decimal(n) / _PARTS)
        first = float(exact)
        found.append((first, float(context.subtract(exact, Decimal(first)))))
    return tuple(found)


def _alarmed(same: Any, found: list[float], *args: Any) -> Any:
    """The results as an array, with numpy's alarm where one is not finite: no library rounds those."""
    result = np.array(found, np.float64).reshape(args[0].shape)
    outside = ~np.isfinite(result)
    if outside.any():
        result[outside] = same(*(arg[outside] for arg in args))
    return result


def _by_decimals(base: float, exponent: float) -> float:
    size = abs(base)
    if size in (0.0, 1.0) or exponent == 0.0 or not (math.isfinite(base) and math.isfinite(exponent)):
        try:
            return math.pow(base, exponent)  # exact: no library rounds these
        except ValueError:
            pole = math.copysign(math.inf, base) if exponent % 2.0 == 1.0 else math.inf
            return pole if size == 0.0 else math.nan
    if base < 0.0 and exponent != math.floor(exponent):
        return math.nan
    found = _power_of_decimals()(size, exponent)
    return -found if base < 0.0 and exponent % 2.0 == 1.0 else found


@cache
def _power_of_decimals() -> Callable[[float, float], float]:
    """The power of two numbers by decimal arithmetic, which is imported and set up once: cams ask for thousands."""
    from decimal import Context, Decimal

    context = Context(prec=_DIGITS, Emax=999_999, Emin=-999_999, traps=[])
    return lambda base, exponent: float(context.power(Decimal(base), Decimal(exponent)))


def _log10(x: float) -> float:
    if not 0.0 < x < math.inf:
        return x if x == math.inf else -math.inf if x == 0.0 else math.nan
    from decimal import Context, Decimal

    return float(Context(prec=_DIGITS).log10(Decimal(x)))

"""Error functions, gamma functions and Bessel functions."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import lru_cache
from typing import Any

from ..calling import Problem

_EULER = 0.57721566490153286061
_FARTHEST = 1e5
"""Bessel functions of the first and second kind are computed up to here; Excel's own lose all digits earlier."""


def erf(low: float, high: float | None = None) -> float:
    """ERF: from 0 to `low`, or from `low` to `high`."""
    if high is None:
        return math.erf(low)
    if low > 0 and high > 0:
        return math.erfc(low) - math.erfc(high)
    return math.erf(high) - math.erf(low)


def log_gamma(x: float) -> float:
    """GAMMALN."""
    if x <= 0:
        raise Problem("#NUM!")
    return math.lgamma(x)


def _order(number: float) -> int:
    order = math.trunc(number)
    if order < 0 or order > 100000:
        raise Problem("#NUM!")
    return order


@lru_cache(maxsize=16)
def _downwards(x: float, order: int, sign: int) -> tuple[float, ...]:
    """Miller's algorithm: J (sign -1) or I (sign +1, times e^-x) of x > 0 for the orders 0..; DLMF 3.6(vi)."""
    start = 2 * ((max(order, int(x)) + int(math.sqrt(50 * max(order, x, 1.0))) + 20) // 2)
    values = [0.0] * (start + 2)
    values[start] = 1e-300
    top = start  # above it, all values have become too small to count
    for n in range(start, 0, -1):
        values[n - 1] = 2 * n / x * values[n] + sign * values[n + 1]
        if abs(values[n - 1]) > 1e200:
            for k in range(n - 1, top + 1):
                values[k] *= 1e-250
            while values[top] == 0 or abs(values[top]) < 1e-290:
                values[top] = 0.0
                top -= 1
    whole = 2 * math.fsum(values[1:] if sign > 0 else values[2::2]) + values[0]
    return tuple(value / whole for value in values[:start])


def bessel_j(x: float, n: float) -> float:
    """BESSELJ."""
    order, size = _order(n), abs(x)
    if size == 0:
        return float(order == 0)
    if size > _FARTHEST:
        raise Problem("#NUM!")
    found = _downwards(size, order, -1)[order]
    return -found if x < 0 and order % 2 else found


def bessel_i(x: float, n: float) -> float:
    """BESSELI."""
    order, size = _order(n), abs(x)
    if size == 0:
        return float(order == 0)
    if size > 709:
        raise Problem("#NUM!")
    found = _downwards(size, order, 1)[order] * math.exp(size)
    return -found if x < 0 and order % 2 else found


def bessel_y(x: float, n: float) -> float:
    """BESSELY: Neumann's series (DLMF 10.8.3) for the orders 0 and 1, then upwards."""
    order = _order(n)
    if not 0 < x <= _FARTHEST:
        raise Problem("#NUM!")
    j = _downwards(x, 1, -1)
    log = math.log(x / 2) + _EULER
    pairs = range(1, (len(j) - 2) // 2)
    zero = 2 / math.pi * (log * j[0] - 2 * math.fsum((-1) ** k * j[2 * k] / k for k in pairs))
    rest = math.fsum((-1) ** k * (2 * k + 1) / (k * (k + 1)) * j[2 * k + 1] for k in pairs)
    one = -2 / (math.pi * x) * j[0] + 2 / math.pi * ((log - 1) * j[1] - rest)
    return _upwards(zero, one, x, order, -1)


def _upwards(zero: float, one: float, x: float, order: int, sign: int) -> float:
    for n in range(1, order):
        zero, one = one, 2 * n / x * one + sign * zero
    return zero if order == 0 else one


def bessel_k(x: float, n: float) -> float:
    """BESSELK: the integral of e^(-x cosh t) cosh(nt) by the trapezoidal rule (DLMF 10.32.9), for the orders 0 and 1."""
    order = _order(n)
    if x <= 0:
        raise Problem("#NUM!")
    last = math.acosh(1 + 800 / x)
    step = last / 400
    terms = [(step * k, math.exp(-x * (math.cosh(step * k) - 1))) for k in range(401)]
    front = math.exp(-x) * step
    zero = front * (math.fsum(e for _, e in terms) - 0.5)
    one = front * (math.fsum(e * math.cosh(t) for t, e in terms) - 0.5)
    return _upwards(zero, one, x, order, 1)


PLAIN: dict[str, Callable[..., Any]] = {
    "ERF": erf,
    "ERF.PRECISE": erf,
    "ERFC": math.erfc,
    "ERFC.PRECISE": math.erfc,
    "GAMMA": math.gamma,
    "GAMMALN": log_gamma,
    "GAMMALN.PRECISE": log_gamma,
    "BESSELJ": bessel_j,
    "BESSELI": bessel_i,
    "BESSELY": bessel_y,
    "BESSELK": bessel_k,
}

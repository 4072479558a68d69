"""Special functions in double precision: incomplete gamma and beta functions, their densities, inverses.

Densities are computed by Loader's saddle-point expansion (C. Loader, "Fast and Accurate Computation of Binomial
Probabilities", 2000), which loses no digits for large arguments; the incomplete functions by their power series and
continued fractions (NIST DLMF 8.7, 8.9, 8.17).
"""

from __future__ import annotations

import math
from collections.abc import Callable

_TINY = 1e-300
_MOST_TERMS = 20000


def stirling_error(n: float) -> float:
    """log(n!) - log(sqrt(2 pi n) (n/e)^n), for n >= 0 (infinite at 0)."""
    if n == 0:
        return math.inf
    if n <= 16:
        return math.lgamma(n + 1) - (n + 0.5) * math.log(n) + n - 0.5 * math.log(2 * math.pi)
    square = n * n
    return (1 / 12 - (1 / 360 - (1 / 1260 - (1 / 1680 - (1 / 1188) / square) / square) / square) / square) / n


def deviance(x: float, mean: float) -> float:
    """x log(x/mean) + mean - x, without cancellation where they are near each other."""
    if x == 0:
        return mean
    if abs(x - mean) < 0.1 * (x + mean):
        ratio = (x - mean) / (x + mean)
        total = (x - mean) * ratio
        term, k = 2 * x * ratio, 1
        while True:
            term *= ratio * ratio
            new = total + term / (2 * k + 1)
            if new == total:
                return new
            total, k = new, k + 1
    return x * math.log(x / mean) + mean - x


def poisson_density(x: float, mean: float) -> float:
    """mean^x e^-mean / x!, also for x that are not whole."""
    if mean == 0:
        return 1.0 if x == 0 else 0.0
    if x == 0:
        return math.exp(-mean)
    if x < 1e-3:
        return math.exp(-mean + x * math.log(mean) - math.lgamma(x + 1))
    return math.exp(-stirling_error(x) - deviance(x, mean)) / math.sqrt(2 * math.pi * x)


def binomial_density(x: float, n: float, p: float, q: float) -> float:
    """n! / (x! (n-x)!) p^x q^(n-x), where p + q = 1; also for numbers that are not whole."""
    if p == 0:
        return 1.0 if x == 0 else 0.0
    if q == 0:
        return 1.0 if x == n else 0.0
    if x == 0:
        return math.exp(n * math.log1p(-p) if p < 0.1 else n * math.log(q))
    if x == n:
        return math.exp(n * math.log1p(-q) if q < 0.1 else n * math.log(p))
    y = n - x
    exponent = stirling_error(n) - stirling_error(x) - stirling_error(y) - deviance(x, n * p) - deviance(y, n * q)
    return math.exp(exponent) * math.sqrt(n / (2 * math.pi * x * y))


def gamma_parts(a: float, x: float) -> tuple[float, float]:
    """The regularised incomplete gamma functions (P, Q) of a > 0 and x >= 0."""
    if x <= 0:
        return 0.0, 1.0
    front = poisson_density(a, x)
    if x < a + 1:
        term = total = 1.0
        for n in range(1, _MOST_TERMS):
            term *= x / (a + n)
            total += term
            if term < total * 1e-17:
                break
        low = front * total
        return low, 1 - low
    b = x + 1 - a
    c, d = 1 / _TINY, 1 / b
    h = d
    for i in range(1, _MOST_TERMS):
        step = -i * (i - a)
        b += 2
        d = 1 / _nonzero(step * d + b)
        c = _nonzero(b + step / c)
        h *= d * c
        if abs(d * c - 1) < 1e-16:
            break
    high = front * a * h
    return 1 - high, high


def _nonzero(value: float) -> float:
    return value if abs(value) > _TINY else _TINY


def beta_parts(a: float, b: float, x: float, y: float) -> tuple[float, float]:
    """The regularised incomplete beta function of x and its complement, for a, b > 0; y is 1 - x."""
    if x <= 0:
        return 0.0, 1.0
    if y <= 0:
        return 1.0, 0.0
    if x > (a + 1) / (a + b + 2):
        high, low = beta_parts(b, a, y, x)
        return low, high
    n = a + b
    front = binomial_density(a, n, x, y) * b / n
    low = front * _beta_fraction(a, b, x)
    return low, 1 - low


def _beta_fraction(a: float, b: float, x: float) -> float:
    """The continued fraction of the incomplete beta function (DLMF 8.17.22), times a."""
    c, d = 1.0, 1 / _nonzero(1 - (a + b) * x / (a + 1))
    h = d
    for m in range(1, _MOST_TERMS):
        step = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m))
        d = 1 / _nonzero(1 + step * d)
        c = _nonzero(1 + step / c)
        h *= d * c
        step = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1))
        d = 1 / _nonzero(1 + step * d)
        c = _nonzero(1 + step / c)
        h *= d * c
        if abs(d * c - 1) < 1e-16:
            break
    return h


def crossing(function: Callable[[float], float], low: float, high: float) -> float:
    """Where an increasing function passes 0, within [low, high], to the last digit. Between bounds of the same sign that
    lie far apart the search halves the exponent, not the number."""
    for _ in range(400):
        middle = _between(low, high)
        if not low < middle < high:
            break
        if function(middle) < 0:
            low = middle
        else:
            high = middle
    return high if abs(function(high)) <= abs(function(low)) else low


def _between(low: float, high: float) -> float:
    if low > 0 and high > 4 * low:
        return math.sqrt(low) * math.sqrt(high)
    if high < 0 and low < 4 * high:
        return -math.sqrt(-low) * math.sqrt(-high)
    return low + (high - low) / 2


def upper_bound(function: Callable[[float], float], start: float) -> float:
    """A number from `start` on, doubled again and again, where an increasing function is not negative."""
    bound = start
    while function(bound) < 0:
        bound *= 2
        if bound > 1e300:
            raise OverflowError
    return bound

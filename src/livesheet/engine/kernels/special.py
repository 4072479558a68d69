"""What SciPy computes: incomplete gamma and beta functions, with the densities that distributions share; Bessel functions.

The standard library has fewer digits, or none. The incomplete functions are Temme's expansion (gamma) and Boost's (beta).
Densities are computed by Loader's saddle-point expansion (C. Loader, "Fast and Accurate Computation of Binomial
Probabilities", 2000), which loses no digits for large arguments, where the logarithms of gamma functions cancel.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.special import betainc, betaincc, gammainc, gammaincc, gammainccinv, gammaincinv, gammaln, iv, jv, kv, yv

_MOST_TERMS = 20000
_LARGE, _FAR = 1e5, 4.4
"""Beyond a shape of _LARGE and _FAR standard deviations from its mean SciPy cuts the series of the incomplete gamma function
off after 2,000 terms: of a million, five deviations below, it keeps five digits."""


def stirling_error(n: Any) -> Any:
    """log(n!) - log(sqrt(2 pi n) (n/e)^n), for n >= 0 (infinite at 0)."""
    small = gammaln(n + 1) - (n + 0.5) * np.log(n) + n - 0.5 * math.log(2 * math.pi)
    square = np.square(n)
    series = (1 / 12 - (1 / 360 - (1 / 1260 - (1 / 1680 - (1 / 1188) / square) / square) / square) / square) / n
    return np.where(np.equal(n, 0), np.inf, np.where(np.less_equal(n, 16), small, series))


def deviance(x: Any, mean: Any) -> Any:
    """x log(x/mean) + mean - x for x > 0, without cancellation where they are near each other."""
    ratio = (x - mean) / (x + mean)
    square = np.square(ratio)
    series = np.zeros_like(square)
    for k in range(9, 0, -1):  # the ninth term of a ratio of 0.1 is below the last digit
        series = square * (1 / (2 * k + 1) + series)
    near = (x - mean) * ratio + 2 * x * ratio * series
    return np.where(np.abs(ratio) < 0.1, near, x * np.log(x / mean) + mean - x)


def poisson_density(x: Any, mean: Any) -> Any:
    """mean^x e^-mean / x!, also for x that are not whole."""
    usual = np.exp(-stirling_error(x) - deviance(x, mean)) / np.sqrt(2 * math.pi * x)
    small = np.exp(-mean + x * np.log(mean) - gammaln(x + 1))
    where = [np.equal(mean, 0), np.equal(x, 0), np.less(x, 1e-3)]
    return np.select(where, [np.where(np.equal(x, 0), 1.0, 0.0), np.exp(-mean), small], usual)


def binomial_density(x: Any, n: Any, p: Any, q: Any) -> Any:
    """n! / (x! (n-x)!) p^x q^(n-x), where p + q = 1; also for numbers that are not whole."""
    y = n - x
    exponent = stirling_error(n) - stirling_error(x) - stirling_error(y) - deviance(x, n * p) - deviance(y, n * q)
    usual = np.exp(exponent) * np.sqrt(n / (2 * math.pi * x * y))
    none, all_ = np.equal(x, 0), np.equal(y, 0)
    where = [np.equal(p, 0), np.equal(q, 0), none, all_]
    return np.select(
        where, [np.where(none, 1.0, 0.0), np.where(all_, 1.0, 0.0), _power(q, p, n), _power(p, q, n)], usual
    )


def _power(p: Any, rest: Any, n: Any) -> Any:
    """p^n, where `rest` is 1 - p."""
    return np.exp(n * np.where(np.less(rest, 0.1), np.log1p(-rest), np.log(p)))


def gamma_below(a: Any, x: Any) -> Any:
    """The regularised lower incomplete gamma function P of a > 0 and x >= 0."""
    return _with_far_tails(gammainc(a, x), a, x, upper=False)


def gamma_above(a: Any, x: Any) -> Any:
    """The regularised upper incomplete gamma function Q of a > 0 and x >= 0."""
    return _with_far_tails(gammaincc(a, x), a, x, upper=True)


def _with_far_tails(found: Any, a: Any, x: Any, upper: bool) -> Any:
    far = np.greater(a, _LARGE) & np.less(_FAR * np.sqrt(a), np.abs(x - a)) & np.isfinite(x)
    if not np.any(far):
        return found
    a, x = np.broadcast_arrays(a, x)
    tail = _far_tail(a[far], x[far])
    found = np.array(found, np.float64)
    found[far] = np.where((x[far] > a[far]) == upper, tail, 1 - tail)
    return found


def _far_tail(a: Any, x: Any) -> Any:
    """The smaller of P (x < a) and Q by their power series (DLMF 8.7.1, 8.11.2)."""
    below = x < a
    term = total = np.ones_like(x)
    for n in range(1, _MOST_TERMS):
        term = term * np.where(below, x / (a + n), (a - n) / x)
        total = total + term
        if np.all(np.abs(term) < total * 1e-17):
            break
    return poisson_density(a, x) * total * np.where(below, 1.0, a / x)


def gamma_quantile(a: Any, p: Any, upper: bool) -> Any:
    """Where P (or Q, if `upper`) is p; of large shapes one Newton step makes good what SciPy's series has lost."""
    x = (gammainccinv if upper else gammaincinv)(a, p)
    if not np.any(np.greater(a, _LARGE)):
        return x
    miss = p - gamma_above(a, x) if upper else gamma_below(a, x) - p
    step = miss / (poisson_density(a, x) * a / x)
    return np.where(np.greater(a, _LARGE) & np.isfinite(step), x - step, x)


def beta_below(a: Any, b: Any, x: Any, y: Any) -> Any:
    """The regularised incomplete beta function of x for a, b > 0; y is 1 - x, known to all its digits."""
    return np.where(np.less(x, y), betainc(a, b, x), betaincc(b, a, y))


_FARTHEST = 1e5
"""Bessel functions of the first and second kind are computed up to here; Excel's own lose all digits earlier."""


def log_gamma(x: Any) -> Any:
    """GAMMALN: #NUM! where x is not positive."""
    return np.where(np.greater(x, 0), gammaln(x), np.nan)


def _bessel(function: Callable[[Any, Any], Any], farthest: float, both_signs: bool) -> Callable[[Any, Any], Any]:
    """A Bessel function of (x, order): the order is cut off to a whole number from 0 to 100,000; x lies between 0, or
    -farthest, and farthest. #NUM! elsewhere."""

    def of(x: Any, n: Any) -> Any:
        order, size = np.trunc(n), np.abs(x)
        there = (order >= 0) & (order <= 100000) & (size <= farthest) & (both_signs | np.greater(x, 0))
        found = function(order, size)
        return np.where(there, np.where(np.less(x, 0) & (order % 2 == 1), -found, found), np.nan)

    return of


MAPS: dict[str, Callable[..., Any]] = {
    "GAMMALN": log_gamma,
    "GAMMALN.PRECISE": log_gamma,
    "BESSELJ": _bessel(jv, _FARTHEST, both_signs=True),
    "BESSELI": _bessel(iv, 709, both_signs=True),
    "BESSELY": _bessel(yv, _FARTHEST, both_signs=False),
    "BESSELK": _bessel(kv, math.inf, both_signs=False),
}

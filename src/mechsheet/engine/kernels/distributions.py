"""Probability distributions of continuous variables: densities, cumulative probabilities and their inverses, over arrays.

Upper tails are computed as such, not as 1 minus the rest. Parameters outside their range are #NUM!; degrees of freedom and
counts are cut off to whole numbers, as Excel does.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import reduce
from typing import Any

import numpy as np
from scipy.special import (
    betainccinv,
    betaincinv,
    erf,
    ndtri,
)

from .densities import (
    beta_below,
    binomial_density,
    deviance,
    gamma_above,
    gamma_below,
    gamma_quantile,
    poisson_density,
    stirling_error,
)

_ROOT_2PI = math.sqrt(2 * math.pi)


def within(value: Any, *conditions: Any) -> Any:
    """`value` where all conditions hold, NaN (which becomes #NUM!) elsewhere."""
    return np.where(reduce(np.logical_and, conditions), value, np.nan)


def either(cumulative: Any, below: Callable[[], Any], density: Callable[[], Any]) -> Any:
    """The cumulative probability or the density, as the last argument of most distributions asks."""
    if np.all(cumulative):
        return below()
    return np.where(cumulative, below(), density()) if np.any(cumulative) else density()


def _at_edge(exponent: Any, value: Any) -> Any:
    """A density that goes with x^(exponent - 1), at x = 0."""
    return np.select([np.equal(exponent, 1), np.greater(exponent, 1)], [value, 0.0], np.nan)


# --- normal ----------------------------------------------------------------------------------------------------------


def density(z: Any) -> Any:
    """PHI: the density of the standard normal distribution."""
    return np.exp(-np.square(z) / 2) / _ROOT_2PI


_erfc = np.vectorize(math.erfc, otypes=[np.float64])
"""The C library's keeps all digits far out, where SciPy's loses two or three."""


def normal_below(z: Any) -> Any:
    """The probability of less than z."""
    return _erfc(-z / math.sqrt(2)) / 2


def normal_quantile(p: Any) -> Any:
    """NORM.S.INV."""
    return within(ndtri(p), np.greater(p, 0), np.less(p, 1))


def norm_dist(x: Any, mean: Any, deviation: Any, cumulative: Any) -> Any:
    """NORM.DIST."""
    z = (x - mean) / deviation
    return within(either(cumulative, lambda: normal_below(z), lambda: density(z) / deviation), np.greater(deviation, 0))


def norm_inv(p: Any, mean: Any, deviation: Any) -> Any:
    """NORM.INV."""
    return within(mean + deviation * normal_quantile(p), np.greater(deviation, 0))


def lognorm_dist(x: Any, mean: Any, deviation: Any, cumulative: Any = True) -> Any:
    """LOGNORM.DIST."""
    z = (np.log(x) - mean) / deviation
    found = either(cumulative, lambda: normal_below(z), lambda: density(z) / (deviation * x))
    return within(found, np.greater(x, 0), np.greater(deviation, 0))


# --- gamma, chi-squared, exponential, Weibull ------------------------------------------------------------------------


def gamma_dist(x: Any, shape: Any, scale: Any, cumulative: Any) -> Any:
    """GAMMA.DIST."""

    def slope() -> Any:
        inside = poisson_density(shape, x / scale) * shape / x
        return np.where(np.equal(x, 0), _at_edge(shape, 1 / scale), inside)

    found = either(cumulative, lambda: gamma_below(shape, x / scale), slope)
    return within(found, np.greater_equal(x, 0), np.greater(shape, 0), np.greater(scale, 0))


def gamma_inv(p: Any, shape: Any, scale: Any) -> Any:
    """GAMMA.INV."""
    found = scale * gamma_quantile(shape, p, upper=False)
    return within(found, np.greater_equal(p, 0), np.less(p, 1), np.greater(shape, 0), np.greater(scale, 0))


def freedom(number: Any) -> Any:
    """Degrees of freedom, cut off to a whole number from 1 to 10^10; NaN elsewhere."""
    return within(np.trunc(number), np.greater_equal(number, 1), np.less_equal(number, 1e10))


def chisq_dist(x: Any, degrees: Any, cumulative: Any) -> Any:
    """CHISQ.DIST."""
    return gamma_dist(x, freedom(degrees) / 2, 2.0, cumulative)


def chisq_right(x: Any, degrees: Any) -> Any:
    """CHISQ.DIST.RT."""
    return within(gamma_above(freedom(degrees) / 2, x / 2), np.greater_equal(x, 0))


def chisq_inv(p: Any, degrees: Any) -> Any:
    """CHISQ.INV."""
    return gamma_inv(p, freedom(degrees) / 2, 2.0)


def chisq_inv_right(p: Any, degrees: Any) -> Any:
    """CHISQ.INV.RT."""
    return within(2 * gamma_quantile(freedom(degrees) / 2, p, upper=True), np.greater(p, 0), np.less_equal(p, 1))


def weibull(x: Any, shape: Any, scale: Any, cumulative: Any) -> Any:
    """WEIBULL.DIST."""
    power = np.power(x / scale, shape)

    def slope() -> Any:
        return shape / scale * np.power(x / scale, shape - 1) * np.exp(-power)

    found = either(cumulative, lambda: -np.expm1(-power), slope)
    return within(found, np.greater_equal(x, 0), np.greater(shape, 0), np.greater(scale, 0))


def exponential(x: Any, rate: Any, cumulative: Any) -> Any:
    """EXPON.DIST."""
    found = either(cumulative, lambda: -np.expm1(-rate * x), lambda: rate * np.exp(-rate * x))
    return within(found, np.greater_equal(x, 0), np.greater(rate, 0))


# --- beta, t, F ------------------------------------------------------------------------------------------------------


def beta_dist(x: Any, a: Any, b: Any, cumulative: Any, low: Any = 0.0, high: Any = 1.0) -> Any:
    """BETA.DIST."""
    width = high - low
    part, rest = (x - low) / width, (high - x) / width

    def slope() -> Any:
        inside = binomial_density(a, a + b, part, rest) * a * b / (a + b) / (part * rest) / width
        edges = [_at_edge(exponent, (a + b - 1) / width) for exponent in (a, b)]
        return np.select([np.equal(part, 0), np.equal(part, 1)], edges, inside)

    found = either(cumulative, lambda: beta_below(a, b, part, rest), slope)
    inside = np.less_equal(low, x) & np.less_equal(x, high)
    return within(found, np.greater(a, 0), np.greater(b, 0), np.less(low, high), inside)


def beta_inv(p: Any, a: Any, b: Any, low: Any = 0.0, high: Any = 1.0) -> Any:
    """BETA.INV."""
    inside = np.less(0, p) & np.less(p, 1)
    found = low + betaincinv(a, b, p) * (high - low)
    return within(found, np.greater(a, 0), np.greater(b, 0), np.less(low, high), inside)


def t_tail(x: Any, degrees: Any) -> Any:
    """The probability of more than x, also for degrees of freedom that are not whole."""
    square = np.square(x)
    tail = beta_below(degrees / 2, 0.5, degrees / (degrees + square), 1 / (1 + degrees / square)) / 2
    return np.where(np.greater_equal(x, 0), tail, 1 - tail)


def t_right(x: Any, degrees: Any) -> Any:
    """T.DIST.RT."""
    return t_tail(x, freedom(degrees))


def t_dist(x: Any, degrees: Any, cumulative: Any) -> Any:
    """T.DIST."""
    df = freedom(degrees)

    def slope() -> Any:
        half, share = df / 2, np.square(x) / df
        front = stirling_error(half + 0.5) - stirling_error(half) - deviance(half, half + 0.5)
        return np.exp(front - half * np.log1p(share)) / np.sqrt(2 * math.pi * (1 + share))

    return either(cumulative, lambda: t_tail(-x, df), slope)


def t_both(x: Any, degrees: Any) -> Any:
    """T.DIST.2T."""
    return within(2 * t_right(x, degrees), np.greater_equal(x, 0))


def t_tails(x: Any, degrees: Any, tails: Any) -> Any:
    """TDIST."""
    sides = np.trunc(tails)
    return within(t_right(x, degrees) * sides, np.greater_equal(x, 0), (sides == 1) | (sides == 2))


def t_inv_both(p: Any, degrees: Any) -> Any:
    """T.INV.2T."""
    df = freedom(degrees)
    part = betaincinv(df / 2, 0.5, p)
    # of one degree the part falls below the smallest number: there the quantile is a cotangent
    found = np.where(part == 0, 1 / np.tan(math.pi / 2 * p), np.sqrt(df * betainccinv(0.5, df / 2, p) / part))
    return within(found, np.greater(p, 0), np.less_equal(p, 1))


def t_inv(p: Any, degrees: Any) -> Any:
    """T.INV."""
    size = t_inv_both(2 * np.minimum(p, 1 - p), degrees)
    return np.where(np.less(p, 0.5), -size, size)


def _f_parts(x: Any, m: Any, n: Any) -> tuple[Any, Any, Any, Any]:
    """Arguments of the incomplete beta function of x."""
    whole = m * x + n
    return m / 2, n / 2, m * x / whole, n / whole


def f_dist(x: Any, first: Any, second: Any, cumulative: Any) -> Any:
    """F.DIST."""
    m, n = freedom(first), freedom(second)
    a, b, part, rest = _f_parts(x, m, n)

    def slope() -> Any:
        inside = binomial_density(a, a + b, part, rest) * a * b / (a + b) / x
        return np.where(np.equal(x, 0), _at_edge(a, 1.0), inside)

    found = either(cumulative, lambda: beta_below(a, b, part, rest), slope)
    return within(found, np.greater_equal(x, 0), np.isfinite(n))


def f_right(x: Any, first: Any, second: Any) -> Any:
    """F.DIST.RT."""
    a, b, part, rest = _f_parts(x, freedom(first), freedom(second))
    return within(beta_below(b, a, rest, part), np.greater_equal(x, 0))


def f_inv(p: Any, first: Any, second: Any) -> Any:
    """F.INV."""
    m, n = freedom(first), freedom(second)
    found = n * betaincinv(m / 2, n / 2, p) / (m * betainccinv(n / 2, m / 2, p))
    return within(found, np.greater_equal(p, 0), np.less(p, 1))


def f_inv_right(p: Any, first: Any, second: Any) -> Any:
    """F.INV.RT."""
    m, n = freedom(first), freedom(second)
    found = n * betainccinv(m / 2, n / 2, p) / (m * betaincinv(n / 2, m / 2, p))
    return within(found, np.greater(p, 0), np.less_equal(p, 1))


MAPS: dict[str, Callable[..., Any]] = {
    "PHI": density,
    "GAUSS": lambda z: erf(z / math.sqrt(2)) / 2,
    "NORM.DIST": norm_dist,
    "NORMDIST": norm_dist,
    "NORM.S.DIST": lambda z, cumulative: either(cumulative, lambda: normal_below(z), lambda: density(z)),
    "NORMSDIST": normal_below,
    "NORM.INV": norm_inv,
    "NORMINV": norm_inv,
    "NORM.S.INV": normal_quantile,
    "NORMSINV": normal_quantile,
    "LOGNORM.DIST": lognorm_dist,
    "LOGNORMDIST": lognorm_dist,
    "LOGNORM.INV": lambda p, mean, deviation: np.exp(norm_inv(p, mean, deviation)),
    "LOGINV": lambda p, mean, deviation: np.exp(norm_inv(p, mean, deviation)),
    "GAMMA.DIST": gamma_dist,
    "GAMMADIST": gamma_dist,
    "GAMMA.INV": gamma_inv,
    "GAMMAINV": gamma_inv,
    "CHISQ.DIST": chisq_dist,
    "CHISQ.DIST.RT": chisq_right,
    "CHIDIST": chisq_right,
    "CHISQ.INV": chisq_inv,
    "CHISQ.INV.RT": chisq_inv_right,
    "CHIINV": chisq_inv_right,
    "WEIBULL.DIST": weibull,
    "WEIBULL": weibull,
    "EXPON.DIST": exponential,
    "EXPONDIST": exponential,
    "BETA.DIST": beta_dist,
    "BETADIST": lambda x, a, b, low=0.0, high=1.0: beta_dist(x, a, b, True, low, high),
    "BETA.INV": beta_inv,
    "BETAINV": beta_inv,
    "T.DIST": t_dist,
    "T.DIST.RT": t_right,
    "T.DIST.2T": t_both,
    "TDIST": t_tails,
    "T.INV": t_inv,
    "T.INV.2T": t_inv_both,
    "TINV": t_inv_both,
    "F.DIST": f_dist,
    "F.DIST.RT": f_right,
    "FDIST": f_right,
    "F.INV": f_inv,
    "F.INV.RT": f_inv_right,
    "FINV": f_inv_right,
    "FISHER": np.arctanh,
    "FISHERINV": np.tanh,
}

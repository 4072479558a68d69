"""Probability distributions, over arrays: densities, cumulative probabilities and their inverses; statistical tests.

Upper tails are computed as such, not as 1 minus the rest. Parameters outside their range are #NUM!; degrees of freedom and
counts are cut off to whole numbers, as Excel does.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import reduce
from typing import Any

import numpy as np
from scipy.special import betainccinv, betaincinv, erf, ndtri

from ..values.cells import NUMBER, Cells, Numbers
from ..values.coerce import Problem, need, raise_first
from .math import paired
from .special import (
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


# --- counts ----------------------------------------------------------------------------------------------------------


_MOST_TERMS = 1_000_000
"""Sums of more terms are not computed: #NUM!."""


def _binom_below(k: Any, n: Any, p: Any) -> Any:
    return np.where(np.equal(k, n), 1.0, beta_below(n - k, k + 1, 1 - p, p))


def binom_dist(hits: Any, trials: Any, p: Any, cumulative: Any) -> Any:
    """BINOM.DIST."""
    k, n = np.trunc(hits), np.trunc(trials)
    found = either(cumulative, lambda: _binom_below(k, n, p), lambda: binomial_density(k, n, p, 1 - p))
    return within(found, k >= 0, k <= n, n < 2**31, np.greater_equal(p, 0), np.less_equal(p, 1))


def binom_range(trials: float, p: float, first: float, last: float | None = None) -> float:
    """BINOM.DIST.RANGE: from `first` to `last` hits."""
    n, low = math.trunc(trials), math.trunc(first)
    high = low if last is None else math.trunc(last)
    need(0 <= p <= 1, n >= 0, 0 <= low <= n, low <= high <= n)
    if high - low < 1000:
        return math.fsum(binomial_density(np.arange(low, high + 1.0), n, p, 1 - p))
    return float(binom_dist(high, n, p, True) - (binom_dist(low - 1, n, p, True) if low else 0.0))


def binom_inv(trials: Any, p: Any, alpha: Any) -> Any:
    """BINOM.INV: the least count whose cumulative probability reaches alpha, by halving."""
    n, p, alpha = np.broadcast_arrays(np.trunc(trials), p, alpha)
    there = (n >= 0) & (n < 2**31) & (alpha > 0) & (alpha < 1) & (p >= 0) & (p < 1)
    low, high = np.full(n.shape, -1.0), np.where(there, n, 0.0)
    while np.any(high - low > 1):
        middle = np.floor((low + high) / 2)
        enough = _binom_below(middle, n, p) >= alpha
        low, high = np.where(enough, low, middle), np.where(enough, middle, high)
    return within(high, there)


def negbinom_dist(failures: Any, hits: Any, p: Any, cumulative: Any = False) -> Any:
    """NEGBINOM.DIST: so many failures before the last hit."""
    f, s = np.trunc(failures), np.trunc(hits)
    found = either(
        cumulative,
        lambda: beta_below(s, f + 1, p, 1 - p),
        lambda: binomial_density(s, f + s, p, 1 - p) * s / (f + s),
    )
    return within(found, f >= 0, s >= 1, np.greater(p, 0), np.less(p, 1))


def _hypgeom_density(k: Any, n: Any, m: Any, size: Any) -> Any:
    p = n / size
    whole = binomial_density(n, size, p, 1 - p)
    return binomial_density(k, m, p, 1 - p) * (binomial_density(n - k, size - m, p, 1 - p) / whole)


def _hypgeom_below(k: float, n: float, m: float, size: float) -> float:
    counts = k - max(0.0, n + m - size) + 1
    if not 0 < counts <= _MOST_TERMS:
        return math.nan
    return math.fsum(_hypgeom_density(k - np.arange(counts), n, m, size))


def hypgeom_dist(hits: Any, sample: Any, good: Any, population: Any, cumulative: Any = False) -> Any:
    """HYPGEOM.DIST."""
    k, n, m, size = map(np.trunc, (hits, sample, good, population))
    found = either(
        cumulative,
        lambda: np.vectorize(_hypgeom_below, otypes=[np.float64])(k, n, m, size),
        lambda: _hypgeom_density(k, n, m, size),
    )
    there = (size > 0) & (n > 0) & (n <= size) & (m > 0) & (m <= size)
    return within(found, there, k >= 0, k <= np.minimum(n, m), k >= n + m - size)


def poisson_dist(x: Any, mean: Any, cumulative: Any) -> Any:
    """POISSON.DIST."""
    k = np.trunc(x)
    found = either(
        cumulative,
        lambda: np.where(np.equal(mean, 0), 1.0, gamma_above(k + 1, mean)),
        lambda: poisson_density(k, mean),
    )
    return within(found, np.greater_equal(x, 0), np.greater_equal(mean, 0))


def confidence_normal(alpha: Any, deviation: Any, size: Any) -> Any:
    """CONFIDENCE.NORM: half the width of the interval."""
    found = -normal_quantile(alpha / 2) * deviation / np.sqrt(np.trunc(size))
    return within(found, np.greater(alpha, 0), np.less(alpha, 1), np.greater(deviation, 0), np.greater_equal(size, 1))


def confidence_t(alpha: float, deviation: float, size: float) -> float:
    """CONFIDENCE.T."""
    need(0 < alpha < 1, deviation > 0, size >= 1)
    if math.trunc(size) == 1:
        raise Problem("#DIV/0!")
    return float(t_inv_both(alpha, math.trunc(size) - 1)) * deviation / math.sqrt(math.trunc(size))


# --- tests -----------------------------------------------------------------------------------------------------------


def variance(numbers: Numbers) -> float:
    """The variance of a sample; #DIV/0! of fewer than two numbers."""
    if len(numbers) < 2:
        raise Problem("#DIV/0!")
    return float(np.sum((numbers - numbers.mean()) ** 2) / (len(numbers) - 1))


def chisq_test(found: Cells, expected: Cells) -> float:
    """CHISQ.TEST."""
    if found.numbers.shape != expected.numbers.shape or found.numbers.size == 1:
        raise Problem("#N/A")
    observed, wanted = paired(found, expected)
    if np.any(wanted == 0):
        raise Problem("#DIV/0!")
    need(bool(np.all(wanted > 0)))
    rows, cols = found.numbers.shape
    freedom = (rows - 1) * (cols - 1) if rows > 1 and cols > 1 else rows * cols - 1
    return float(chisq_right(np.sum((observed - wanted) ** 2 / wanted), freedom))


def f_test(first: Numbers, second: Numbers) -> float:
    """F.TEST: the two-sided probability that the variances do not differ."""
    above, below = variance(first), variance(second)
    if above == 0 or below == 0:
        raise Problem("#DIV/0!")
    right = f_right(above / below, len(first) - 1, len(second) - 1)
    return float(2 * np.minimum(right, f_right(below / above, len(second) - 1, len(first) - 1)))


def t_test(first: Cells, second: Cells, tails: float, kind: float) -> float:
    """T.TEST: paired (1), of equal variance (2), of unequal variance (3)."""
    sides, how = math.trunc(tails), math.trunc(kind)
    need(sides in (1, 2), how in (1, 2, 3))
    t, freedom = _paired_t(first, second) if how == 1 else _separate_t(_numbers(first), _numbers(second), how == 2)
    return sides * float(t_tail(abs(t), freedom))


def _numbers(table: Cells) -> Numbers:
    raise_first(table.codes)
    return np.asarray(table.numbers[table.codes == NUMBER], np.float64)


def _paired_t(first: Cells, second: Cells) -> tuple[float, float]:
    x, y = paired(first, second)
    spread = variance(x - y)
    if spread == 0:
        raise Problem("#DIV/0!")
    return float((x - y).mean()) / math.sqrt(spread / len(x)), len(x) - 1


def _separate_t(x: Numbers, y: Numbers, equal: bool) -> tuple[float, float]:
    a, b = variance(x) / len(x), variance(y) / len(y)
    n, m = len(x), len(y)
    if equal:
        freedom = float(n + m - 2)
        error = (a * n * (n - 1) + b * m * (m - 1)) / freedom * (1 / n + 1 / m)
    else:
        error = a + b
        if error == 0:
            raise Problem("#DIV/0!")
        freedom = error**2 / (a**2 / (n - 1) + b**2 / (m - 1))
    if error == 0:
        raise Problem("#DIV/0!")
    return float(x.mean() - y.mean()) / math.sqrt(error), freedom


def z_test(numbers: Numbers, mean: float, deviation: float | None = None) -> float:
    """Z.TEST: the probability of a greater mean."""
    if not len(numbers):
        raise Problem("#N/A")
    sigma = math.sqrt(variance(numbers)) if deviation is None else deviation
    if sigma == 0 and deviation is None:
        raise Problem("#DIV/0!")
    need(sigma > 0)
    return float(normal_below((mean - numbers.mean()) / (sigma / math.sqrt(len(numbers)))))


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
    "BINOM.DIST": binom_dist,
    "BINOMDIST": binom_dist,
    "BINOM.INV": binom_inv,
    "CRITBINOM": binom_inv,
    "NEGBINOM.DIST": negbinom_dist,
    "NEGBINOMDIST": negbinom_dist,
    "HYPGEOM.DIST": hypgeom_dist,
    "HYPGEOMDIST": hypgeom_dist,
    "POISSON.DIST": poisson_dist,
    "POISSON": poisson_dist,
    "CONFIDENCE": confidence_normal,
    "CONFIDENCE.NORM": confidence_normal,
}

PLAIN: dict[str, Callable[..., Any]] = {
    "BINOM.DIST.RANGE": binom_range,
    "CONFIDENCE.T": confidence_t,
    "CHISQ.TEST": chisq_test,
    "CHITEST": chisq_test,
    "F.TEST": f_test,
    "FTEST": f_test,
    "T.TEST": t_test,
    "TTEST": t_test,
    "Z.TEST": z_test,
    "ZTEST": z_test,
}

"""Distributions of counts, and statistical tests."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ..values.calling import Problem, need, raise_first
from ..values.cells import NUMBER, Cells, Numbers
from .densities import beta_below, binomial_density, gamma_above, poisson_density
from .distributions import chisq_right, either, f_right, normal_below, normal_quantile, t_inv_both, t_tail, within
from .numbers import paired

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

"""Distributions of counts, and statistical tests."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ..calling import Problem, raise_first
from ..special import beta_parts, binomial_density, gamma_parts, poisson_density
from ..values import NUMBER, Cells, Numbers
from .distributions import chisq_right, f_right, need, normal_below, normal_quantile, t_inv_both, t_right
from .numbers import paired

_MOST_TERMS = 1_000_000
"""Sums of more terms are not computed: #NUM!."""


def _share(p: float) -> None:
    need(0 <= p <= 1)


def binom_dist(hits: float, trials: float, p: float, cumulative: bool) -> float:
    """BINOM.DIST."""
    k, n = math.trunc(hits), math.trunc(trials)
    _share(p)
    need(0 <= k <= n < 2**31)
    if not cumulative:
        return binomial_density(k, n, p, 1 - p)
    return 1.0 if k == n else beta_parts(n - k, k + 1, 1 - p, p)[0]


def binom_range(trials: float, p: float, first: float, last: float | None = None) -> float:
    """BINOM.DIST.RANGE: from `first` to `last` hits."""
    n, low = math.trunc(trials), math.trunc(first)
    high = low if last is None else math.trunc(last)
    _share(p)
    need(n >= 0, 0 <= low <= n, low <= high <= n)
    if high - low < 1000:
        return math.fsum(binomial_density(k, n, p, 1 - p) for k in range(low, high + 1))
    return binom_dist(high, n, p, True) - (binom_dist(low - 1, n, p, True) if low else 0.0)


def binom_inv(trials: float, p: float, alpha: float) -> float:
    """BINOM.INV: the least count whose cumulative probability reaches alpha."""
    n = math.trunc(trials)
    need(n >= 0, 0 < alpha < 1, 0 <= p < 1)
    low, high = -1, n
    while high - low > 1:
        middle = (low + high) // 2
        if binom_dist(middle, n, p, True) >= alpha:
            high = middle
        else:
            low = middle
    return float(high)


def negbinom_dist(failures: float, hits: float, p: float, cumulative: bool = False) -> float:
    """NEGBINOM.DIST: so many failures before the last hit."""
    f, s = math.trunc(failures), math.trunc(hits)
    need(f >= 0, s >= 1, 0 < p < 1)
    if cumulative:
        return beta_parts(s, f + 1, p, 1 - p)[0]
    return binomial_density(s, f + s, p, 1 - p) * s / (f + s)


def hypgeom_dist(hits: float, sample: float, good: float, population: float, cumulative: bool = False) -> float:
    """HYPGEOM.DIST."""
    k, n, m, size = (math.trunc(value) for value in (hits, sample, good, population))
    need(size > 0, 0 < n <= size, 0 < m <= size, 0 <= k <= min(n, m), k >= n + m - size)
    counts = range(max(0, n + m - size), k + 1) if cumulative else (k,)
    need(len(counts) <= _MOST_TERMS)
    p = n / size
    whole = binomial_density(n, size, p, 1 - p)
    return math.fsum(
        binomial_density(i, m, p, 1 - p) * (binomial_density(n - i, size - m, p, 1 - p) / whole) for i in counts
    )


def poisson_dist(x: float, mean: float, cumulative: bool) -> float:
    """POISSON.DIST."""
    k = math.trunc(x)
    need(x >= 0, mean >= 0)
    if not cumulative:
        return poisson_density(k, mean)
    return 1.0 if mean == 0 else gamma_parts(k + 1, mean)[1]


def confidence_normal(alpha: float, deviation: float, size: float) -> float:
    """CONFIDENCE.NORM: half the width of the interval."""
    need(0 < alpha < 1, deviation > 0, size >= 1)
    return -normal_quantile(alpha / 2) * deviation / math.sqrt(math.trunc(size))


def confidence_t(alpha: float, deviation: float, size: float) -> float:
    """CONFIDENCE.T."""
    need(0 < alpha < 1, deviation > 0, size >= 1)
    if math.trunc(size) == 1:
        raise Problem("#DIV/0!")
    return t_inv_both(alpha, math.trunc(size) - 1) * deviation / math.sqrt(math.trunc(size))


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
    return chisq_right(float(np.sum((observed - wanted) ** 2 / wanted)), freedom)


def f_test(first: Numbers, second: Numbers) -> float:
    """F.TEST: the two-sided probability that the variances do not differ."""
    above, below = variance(first), variance(second)
    if above == 0 or below == 0:
        raise Problem("#DIV/0!")
    right = f_right(above / below, len(first) - 1, len(second) - 1)
    return 2 * min(right, f_right(below / above, len(second) - 1, len(first) - 1))


def t_test(first: Cells, second: Cells, tails: float, kind: float) -> float:
    """T.TEST: paired (1), of equal variance (2), of unequal variance (3)."""
    sides, how = math.trunc(tails), math.trunc(kind)
    need(sides in (1, 2), how in (1, 2, 3))
    t, freedom = _paired_t(first, second) if how == 1 else _separate_t(_numbers(first), _numbers(second), how == 2)
    return sides * _t_right_real(abs(t), freedom)


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


def _t_right_real(t: float, freedom: float) -> float:
    """As T.DIST.RT, also for degrees of freedom that are not whole."""
    if freedom == math.trunc(freedom):
        return t_right(t, freedom)
    return beta_parts(freedom / 2, 0.5, freedom / (freedom + t * t), t * t / (freedom + t * t))[0] / 2


def z_test(numbers: Numbers, mean: float, deviation: float | None = None) -> float:
    """Z.TEST: the probability of a greater mean."""
    if not len(numbers):
        raise Problem("#N/A")
    sigma = math.sqrt(variance(numbers)) if deviation is None else deviation
    if sigma == 0 and deviation is None:
        raise Problem("#DIV/0!")
    need(sigma > 0)
    return normal_below((mean - float(numbers.mean())) / (sigma / math.sqrt(len(numbers))))


PLAIN: dict[str, Callable[..., Any]] = {
    "BINOM.DIST": binom_dist,
    "BINOMDIST": binom_dist,
    "BINOM.DIST.RANGE": binom_range,
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

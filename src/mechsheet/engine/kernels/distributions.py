"""Probability distributions: densities, cumulative probabilities and their inverses.

Upper tails are computed as such, not as 1 minus the rest. Parameters outside their range are #NUM!; degrees of freedom and
counts are cut off to whole numbers, as Excel does.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from statistics import NormalDist
from typing import Any

from ..calling import Problem
from ..special import beta_parts, binomial_density, crossing, gamma_parts, poisson_density, upper_bound

_ROOT_2PI = math.sqrt(2 * math.pi)


def need(*conditions: bool) -> None:
    """#NUM! unless all conditions hold."""
    if not all(conditions):
        raise Problem("#NUM!")


def _probability(p: float, open_below: bool = True, open_above: bool = True) -> None:
    need(p > 0 if open_below else p >= 0, p < 1 if open_above else p <= 1)


# --- normal ----------------------------------------------------------------------------------------------------------


def density(z: float) -> float:
    """PHI: the density of the standard normal distribution."""
    return math.exp(-z * z / 2) / _ROOT_2PI


def normal_below(z: float) -> float:
    """The probability of less than z."""
    return math.erfc(-z / math.sqrt(2)) / 2


def normal_quantile(p: float) -> float:
    """NORM.S.INV; one Newton step sharpens the rational approximation of the standard library."""
    _probability(p)
    z = NormalDist().inv_cdf(p)
    slope = density(z)
    if slope > 1e-290:
        tail = normal_below(z) - p if z < 0 else (1 - p) - math.erfc(z / math.sqrt(2)) / 2
        z -= tail / slope
    return z


def norm_dist(x: float, mean: float, deviation: float, cumulative: bool) -> float:
    """NORM.DIST."""
    need(deviation > 0)
    z = (x - mean) / deviation
    return normal_below(z) if cumulative else density(z) / deviation


def norm_inv(p: float, mean: float, deviation: float) -> float:
    """NORM.INV."""
    need(deviation > 0)
    return mean + deviation * normal_quantile(p)


def lognorm_dist(x: float, mean: float, deviation: float, cumulative: bool = True) -> float:
    """LOGNORM.DIST."""
    need(x > 0, deviation > 0)
    z = (math.log(x) - mean) / deviation
    return normal_below(z) if cumulative else density(z) / (deviation * x)


# --- gamma, chi-squared, exponential, Weibull ------------------------------------------------------------------------


def gamma_dist(x: float, shape: float, scale: float, cumulative: bool) -> float:
    """GAMMA.DIST."""
    need(x >= 0, shape > 0, scale > 0)
    if cumulative:
        return gamma_parts(shape, x / scale)[0]
    if x == 0:
        need(shape >= 1)
        return 1 / scale if shape == 1 else 0.0
    return poisson_density(shape, x / scale) * shape / x


def _tail_inverse(p: float, lower: Callable[[float], float], upper: Callable[[float], float], start: float) -> float:
    """Where `lower` is p, on [0, infinity), found on the smaller tail."""
    if p <= 0:
        return 0.0

    def misses(x: float) -> float:
        return lower(x) - p if p < 0.5 else (1 - p) - upper(x)

    return crossing(misses, 1e-300, upper_bound(misses, start))


def gamma_inv(p: float, shape: float, scale: float) -> float:
    """GAMMA.INV."""
    _probability(p, open_below=False)
    need(shape > 0, scale > 0)
    return scale * _tail_inverse(p, lambda x: gamma_parts(shape, x)[0], lambda x: gamma_parts(shape, x)[1], shape + 1)


def _freedom(number: float) -> int:
    need(1 <= number <= 1e10)
    return math.trunc(number)


def chisq_dist(x: float, freedom: float, cumulative: bool) -> float:
    """CHISQ.DIST."""
    df = _freedom(freedom)
    if x == 0 and not cumulative and df == 1:
        raise Problem("#NUM!")
    return gamma_dist(x, df / 2, 2.0, cumulative)


def chisq_right(x: float, freedom: float) -> float:
    """CHISQ.DIST.RT."""
    need(x >= 0)
    return gamma_parts(_freedom(freedom) / 2, x / 2)[1]


def chisq_inv(p: float, freedom: float) -> float:
    """CHISQ.INV."""
    return gamma_inv(p, _freedom(freedom) / 2, 2.0)


def chisq_inv_right(p: float, freedom: float) -> float:
    """CHISQ.INV.RT."""
    _probability(p, open_above=False)
    half = _freedom(freedom) / 2
    if p == 1:
        return 0.0

    def misses(x: float) -> float:
        return p - gamma_parts(half, x)[1] if p < 0.5 else gamma_parts(half, x)[0] - (1 - p)

    return 2 * crossing(misses, 1e-300, upper_bound(misses, half + 1))


def weibull(x: float, shape: float, scale: float, cumulative: bool) -> float:
    """WEIBULL.DIST."""
    need(x >= 0, shape > 0, scale > 0)
    if cumulative:
        return -math.expm1(-math.pow(x / scale, shape))
    return shape / scale * math.pow(x / scale, shape - 1) * math.exp(-math.pow(x / scale, shape))


def exponential(x: float, rate: float, cumulative: bool) -> float:
    """EXPON.DIST."""
    need(x >= 0, rate > 0)
    return -math.expm1(-rate * x) if cumulative else rate * math.exp(-rate * x)


# --- beta, t, F ------------------------------------------------------------------------------------------------------


def beta_dist(x: float, a: float, b: float, cumulative: bool, low: float = 0.0, high: float = 1.0) -> float:
    """BETA.DIST."""
    need(a > 0, b > 0, low < high, low <= x <= high)
    part, rest = (x - low) / (high - low), (high - x) / (high - low)
    if cumulative:
        return beta_parts(a, b, part, rest)[0]
    if part in (0.0, 1.0):
        nearest = a if part == 0 else b
        need(nearest >= 1)
        return (a + b - 1) / (high - low) if nearest == 1 else 0.0
    return binomial_density(a, a + b, part, rest) * a * b / (a + b) / (part * rest) / (high - low)


def beta_inv(p: float, a: float, b: float, low: float = 0.0, high: float = 1.0) -> float:
    """BETA.INV."""
    need(a > 0, b > 0, low < high, 0 < p < 1)
    part = crossing(lambda x: beta_parts(a, b, x, 1 - x)[0] - p, 1e-300, 1.0)
    return low + part * (high - low)


def t_right(x: float, freedom: float) -> float:
    """T.DIST.RT."""
    df = _freedom(freedom)
    tail = beta_parts(df / 2, 0.5, df / (df + x * x), x * x / (df + x * x))[0] / 2
    return tail if x >= 0 else 1 - tail


def t_dist(x: float, freedom: float, cumulative: bool) -> float:
    """T.DIST."""
    df = _freedom(freedom)
    if cumulative:
        return t_right(-x, df)
    return math.exp(
        math.lgamma((df + 1) / 2) - math.lgamma(df / 2) - (df + 1) / 2 * math.log1p(x * x / df)
    ) / math.sqrt(df * math.pi)


def t_both(x: float, freedom: float) -> float:
    """T.DIST.2T."""
    need(x >= 0)
    return 2 * t_right(x, freedom)


def t_tails(x: float, freedom: float, tails: float) -> float:
    """TDIST."""
    need(x >= 0, math.trunc(tails) in (1, 2))
    return t_right(x, freedom) * math.trunc(tails)


def t_inv_both(p: float, freedom: float) -> float:
    """T.INV.2T."""
    _probability(p, open_above=False)
    df = _freedom(freedom)
    if p == 1:
        return 0.0

    def misses(x: float) -> float:
        return p - 2 * t_right(x, df)

    return crossing(misses, 1e-300, upper_bound(misses, 1.0))


def t_inv(p: float, freedom: float) -> float:
    """T.INV."""
    _probability(p)
    if p == 0.5:
        return 0.0
    return -t_inv_both(2 * p, freedom) if p < 0.5 else t_inv_both(2 * (1 - p), freedom)


def _f_parts(x: float, first: int, second: int) -> tuple[float, float]:
    whole = first * x + second
    return beta_parts(first / 2, second / 2, first * x / whole, second / whole)


def f_dist(x: float, first: float, second: float, cumulative: bool) -> float:
    """F.DIST."""
    m, n = _freedom(first), _freedom(second)
    need(x >= 0)
    if cumulative:
        return _f_parts(x, m, n)[0]
    if x == 0:
        need(m >= 2)
        return 1.0 if m == 2 else 0.0
    part, rest = m * x / (m * x + n), n / (m * x + n)
    return binomial_density(m / 2, (m + n) / 2, part, rest) * (m / 2) * (n / 2) / ((m + n) / 2) / x


def f_right(x: float, first: float, second: float) -> float:
    """F.DIST.RT."""
    m, n = _freedom(first), _freedom(second)
    need(x >= 0)
    return _f_parts(x, m, n)[1]


def f_inv(p: float, first: float, second: float) -> float:
    """F.INV."""
    _probability(p, open_below=False)
    m, n = _freedom(first), _freedom(second)
    return _tail_inverse(p, lambda x: _f_parts(x, m, n)[0], lambda x: _f_parts(x, m, n)[1], 1.0)


def f_inv_right(p: float, first: float, second: float) -> float:
    """F.INV.RT."""
    _probability(p, open_above=False)
    m, n = _freedom(first), _freedom(second)
    if p == 1:
        return 0.0

    def misses(x: float) -> float:
        return p - _f_parts(x, m, n)[1]

    return crossing(misses, 1e-300, upper_bound(misses, 1.0))


PLAIN: dict[str, Callable[..., Any]] = {
    "PHI": density,
    "GAUSS": lambda z: math.erf(z / math.sqrt(2)) / 2,
    "NORM.DIST": norm_dist,
    "NORMDIST": norm_dist,
    "NORM.S.DIST": lambda z, cumulative: normal_below(z) if cumulative else density(z),
    "NORMSDIST": normal_below,
    "NORM.INV": norm_inv,
    "NORMINV": norm_inv,
    "NORM.S.INV": normal_quantile,
    "NORMSINV": normal_quantile,
    "LOGNORM.DIST": lognorm_dist,
    "LOGNORMDIST": lognorm_dist,
    "LOGNORM.INV": lambda p, mean, deviation: math.exp(norm_inv(p, mean, deviation)),
    "LOGINV": lambda p, mean, deviation: math.exp(norm_inv(p, mean, deviation)),
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
    "FISHER": math.atanh,
    "FISHERINV": math.tanh,
}

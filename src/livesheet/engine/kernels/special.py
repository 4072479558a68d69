"""The logarithm of the gamma function, and Bessel functions: SciPy's. The standard library has fewer digits, or none."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.special import gammaln, iv, jv, kv, yv

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

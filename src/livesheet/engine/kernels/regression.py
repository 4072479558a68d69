"""Two and more sets of numbers: correlation, covariance, lines, least squares of several variables, exponentials."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ..values.cells import NA, NUM, Cells, Numbers
from ..values.coerce import Problem, to_truth
from .math import paired

_DEPENDENT = 1e-11
"""A column whose part that the columns before it cannot explain is smaller than this share of it depends on them."""


class Sums(NamedTuple):
    """Of pairs (x, y): how many, their means, and the sums of squares and products of their differences from these."""

    n: int
    x: float
    y: float
    xx: float
    yy: float
    xy: float


def sums(x: Numbers, y: Numbers) -> Sums:
    """The sums of pairs; #DIV/0! of none."""
    if not len(x):
        raise Problem("#DIV/0!")
    mean_x, mean_y = float(x.mean()), float(y.mean())
    dx, dy = x - mean_x, y - mean_y
    return Sums(len(x), mean_x, mean_y, float(np.sum(dx * dx)), float(np.sum(dy * dy)), float(np.sum(dx * dy)))


def _positive(*values: float) -> None:
    if min(values) <= 0:
        raise Problem("#DIV/0!")


def correlation(first: Cells, second: Cells) -> float:
    """CORREL, PEARSON."""
    found = sums(*paired(first, second))
    _positive(found.xx, found.yy)
    return max(-1.0, min(1.0, found.xy / math.sqrt(found.xx * found.yy)))


def r_squared(known_y: Cells, known_x: Cells) -> float:
    """RSQ."""
    return correlation(known_y, known_x) ** 2


def covariance(first: Cells, second: Cells, sample: bool) -> float:
    """COVARIANCE.S and .P."""
    found = sums(*paired(first, second))
    _positive(found.n - sample)
    return found.xy / (found.n - sample)


def slope(known_y: Cells, known_x: Cells) -> float:
    """SLOPE."""
    y, x = paired(known_y, known_x)
    found = sums(x, y)
    _positive(found.xx)
    return found.xy / found.xx


def intercept(known_y: Cells, known_x: Cells) -> float:
    """INTERCEPT."""
    y, x = paired(known_y, known_x)
    found = sums(x, y)
    _positive(found.xx)
    return found.y - found.xy / found.xx * found.x


def standard_error(known_y: Cells, known_x: Cells) -> float:
    """STEYX."""
    y, x = paired(known_y, known_x)
    found = sums(x, y)
    _positive(found.n - 2, found.xx)
    return math.sqrt(max(0.0, found.yy - found.xy**2 / found.xx) / (found.n - 2))


def forecast(x: float, known_y: Cells, known_x: Cells) -> float:
    """FORECAST.LINEAR."""
    ys, xs = paired(known_y, known_x)
    found = sums(xs, ys)
    _positive(found.xx)
    return found.y + found.xy / found.xx * (x - found.x)


# --- several variables -----------------------------------------------------------------------------------------------


class Fit(NamedTuple):
    """Least squares: the coefficients of the variables, the constant, their standard errors, and how good it is."""

    coefficients: Numbers
    constant: float
    errors: Numbers
    constant_error: float
    explained: float
    left: float
    freedom: int


def variables(known_y: Numbers, known_x: Numbers | None) -> tuple[Numbers, Numbers, bool]:
    """(y, one column for each variable, whether they stand in rows). #REF! when the sizes do not fit."""
    if known_x is None:
        known_x = np.arange(1.0, known_y.size + 1).reshape(known_y.shape)
    height, width = known_y.shape
    if known_x.shape == known_y.shape:
        return known_y.ravel(), known_x.reshape(-1, 1), height == 1 and width > 1
    if width == 1 and known_x.shape[0] == height:
        return known_y.ravel(), known_x, False
    if height == 1 and known_x.shape[1] == width:
        return known_y.ravel(), known_x.T, True
    raise Problem("#REF!")


def fitted(y: Numbers, x: Numbers, with_constant: bool) -> Fit:
    """Least squares by orthogonalisation. A variable that depends on those before it gets the coefficient 0."""
    n, k = x.shape
    mean_x, mean_y = (x.mean(axis=0), float(y.mean())) if with_constant else (np.zeros(k), 0.0)
    kept, basis, triangle = _orthogonal(x - mean_x, x)
    target = y - mean_y
    along = basis.T @ target
    inverse = np.linalg.inv(triangle) if len(kept) else np.zeros((0, 0))
    coefficients = np.zeros(k)
    coefficients[kept] = inverse @ along
    constant = mean_y - float(mean_x @ coefficients)
    explained = float(along @ along)
    rest = y - x @ coefficients - constant
    left = float(rest @ rest)
    freedom = n - len(kept) - with_constant
    variance = left / freedom if freedom > 0 else 0.0
    errors = np.zeros(k)
    errors[kept] = np.sqrt(variance * np.sum(inverse * inverse, axis=1))
    away = inverse.T @ mean_x[kept]
    constant_error = math.sqrt(variance * (1 / n + float(away @ away))) if with_constant else math.nan
    return Fit(coefficients, constant, errors, constant_error, explained, left, freedom)


def _orthogonal(columns: Numbers, original: Numbers) -> tuple[list[int], Numbers, Numbers]:
    """(the columns kept, an orthonormal basis of them, the triangle that makes them from it)."""
    kept = list(range(columns.shape[1]))
    while True:
        basis, triangle = np.linalg.qr(columns[:, kept])
        size = np.zeros(len(kept))
        size[: len(triangle)] = np.abs(np.diagonal(triangle))
        dependent = np.flatnonzero(size <= _DEPENDENT * np.linalg.norm(original[:, kept], axis=0))
        if not len(dependent):
            return kept, basis, triangle
        del kept[dependent[0]]  # those after it are measured anew, without it


def _checked(known_y: Numbers, known_x: Numbers | None, logarithmic: bool) -> tuple[Numbers, Numbers, bool]:
    y, x, in_rows = variables(known_y, known_x)
    if logarithmic:
        if np.any(y <= 0):
            raise Problem("#NUM!")
        y = np.log(y)
    return y, x, in_rows


def _line(logarithmic: bool) -> Callable[..., Cells]:
    def of(known_y: Numbers, known_x: Numbers | None = None, constant: Any = None, stats: bool = False) -> Cells:
        y, x, _ = _checked(known_y, known_x, logarithmic)
        with_constant = constant is None or to_truth(constant)
        fit = fitted(y, x, with_constant)
        values = np.append(fit.coefficients[::-1], fit.constant)
        if logarithmic:
            values = np.exp(values)
        if not stats:
            return Cells(values[None])
        return _with_statistics(values, fit)

    return of


def _with_statistics(values: Numbers, fit: Fit) -> Cells:
    """The five rows of LINEST; #N/A where there is nothing to say."""
    k = len(fit.coefficients)
    used = int(np.count_nonzero(fit.errors > 0)) or int(np.count_nonzero(fit.coefficients)) or k
    table = np.full((5, k + 1), math.nan)
    codes = np.full((5, k + 1), NA, np.uint8)
    table[0] = values
    table[1] = np.append(fit.errors[::-1], fit.constant_error)
    together = fit.explained + fit.left
    table[2, :2] = (fit.explained / together if together else 1.0), math.sqrt(fit.left / max(fit.freedom, 1))
    share = fit.left / fit.freedom if fit.freedom > 0 else 0.0
    table[3, :2] = (fit.explained / used / share if share else math.inf), fit.freedom
    table[4, :2] = fit.explained, fit.left
    codes[:2] = 0
    codes[2:, :2] = 0
    codes[1, -1] = NA if math.isnan(fit.constant_error) else 0
    codes = np.where(np.isinf(table), np.uint8(NUM), codes)
    return Cells(np.where(codes != 0, np.nan, table), codes)


def _along(logarithmic: bool) -> Callable[..., Numbers]:
    def of(
        known_y: Numbers, known_x: Numbers | None = None, new_x: Numbers | None = None, constant: Any = None
    ) -> Numbers:
        y, x, in_rows = _checked(known_y, known_x, logarithmic)
        fit = fitted(y, x, constant is None or to_truth(constant))
        if new_x is None:
            new_x = known_x if known_x is not None else np.arange(1.0, known_y.size + 1).reshape(known_y.shape)
        if x.shape[1] == 1:
            found = new_x * fit.coefficients[0] + fit.constant
        else:
            places = new_x.T if in_rows else new_x
            if places.shape[1] != x.shape[1]:
                raise Problem("#REF!")
            found = (places @ fit.coefficients + fit.constant)[:, None]
            found = found.T if in_rows else found
        return np.asarray(np.exp(found) if logarithmic else found, np.float64)

    return of


PLAIN: dict[str, Callable[..., Any]] = {
    "CORREL": correlation,
    "PEARSON": correlation,
    "RSQ": r_squared,
    "COVAR": lambda first, second: covariance(first, second, sample=False),
    "COVARIANCE.P": lambda first, second: covariance(first, second, sample=False),
    "COVARIANCE.S": lambda first, second: covariance(first, second, sample=True),
    "SLOPE": slope,
    "INTERCEPT": intercept,
    "STEYX": standard_error,
    "FORECAST": forecast,
    "FORECAST.LINEAR": forecast,
    "LINEST": _line(False),
    "LOGEST": _line(True),
    "TREND": _along(False),
    "GROWTH": _along(True),
}

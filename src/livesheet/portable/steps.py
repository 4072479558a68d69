"""What the functions share: polynomials, the error of a quotient, arrays in pieces."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from functools import reduce
from typing import Any, TypeAlias

import numpy as np

Real: TypeAlias = Any
"""A float, or an array of them: both know the same operators, with the same bits."""

_SPLITTER = 134217729.0  # 2^27 + 1

PIECE = 4096
"""Numbers of a long array that are computed together: with their intermediate results they fit the processor's cache."""

np.empty(64 * PIECE)
"""Freed at once. GNU's C library learns from it to keep so much freed memory; else it hands the pages of a piece's results
back to the system and fetches them again for the next piece, which takes twice as long as all the arithmetic."""


def polynomial(coefficients: tuple[float, ...], x: Real) -> Real:
    """c0 + c1 x + c2 x^2 + ..., by Horner's rule."""
    total = coefficients[-1] * x
    total += coefficients[-2]
    for coefficient in coefficients[-3::-1]:
        total *= x
        total += coefficient
    return total


def hypot(*sides: Any) -> Any:
    """sqrt(x^2 + y^2 + ...) of lengths as drawings have them: beyond 1e150 it overflows."""
    square = reduce(operator.add, (side * side for side in sides))
    return math.sqrt(square) if np.ndim(square) == 0 else np.sqrt(square)


def head(x: Real) -> Real:
    """The upper half of a number's digits (26 of them): products of two heads are exact. T. J. Dekker 1971."""
    large = x * _SPLITTER
    return large - (large - x)


def remainder(n: Real, q: Real, d: Real) -> Real:
    """n - q d without a rounding of the product, where q is n / d rounded. T. J. Dekker 1971."""
    q1, d1 = head(q), head(d)
    q2, d2 = q - q1, d - d1
    product = q * d
    return (n - product) - (((q1 * d1 - product) + (q1 * d2 + q2 * d1)) + q2 * d2)


def in_pieces(function: Callable[..., Any], *arrays: Any, results: int = 1) -> Any:
    """A function of arrays, called for a piece after the other where they are long. Of several results, one array."""
    arrays = tuple(np.broadcast_arrays(*arrays)) if len(arrays) > 1 else arrays
    size = arrays[0].size
    if size <= PIECE:
        return function(*arrays)
    flat = [np.ravel(array) for array in arrays]
    found = np.empty((results, size))
    for start in range(0, size, PIECE):
        found[:, start : start + PIECE] = function(*(array[start : start + PIECE] for array in flat))
    return found.reshape(arrays[0].shape if results == 1 else (results, *arrays[0].shape))

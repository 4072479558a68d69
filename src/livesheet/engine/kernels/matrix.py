"""Matrices."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ..values.calling import Problem
from ..values.cells import MOST_CELLS, Cells, Numbers, too_large

_MOST_EXACT = 100
"""Rows of a matrix whose determinant is found in whole numbers: their time grows with the cube, a second for 150."""


def _square(matrix: Numbers) -> None:
    if matrix.shape[0] != matrix.shape[1]:
        raise Problem("#VALUE!")


def product(left: Numbers, right: Numbers) -> Numbers:
    """MMULT."""
    if left.shape[1] != right.shape[0]:
        raise Problem("#VALUE!")
    if left.shape[0] * right.shape[1] > MOST_CELLS:
        raise too_large(left.shape[0], right.shape[1])
    return np.asarray(left @ right, np.float64)


def inverse(matrix: Numbers) -> Numbers:
    """MINVERSE: #NUM! of a singular matrix."""
    _square(matrix)
    found = np.linalg.inv(matrix)
    if not np.all(np.isfinite(found)):
        raise Problem("#NUM!")
    return np.asarray(found, np.float64)


def determinant(matrix: Numbers) -> float:
    """MDETERM: exact for matrices of small whole numbers, else by elimination."""
    _square(matrix)
    found = float(np.linalg.det(matrix))
    small = len(matrix) <= _MOST_EXACT
    if small and np.all(matrix == np.rint(matrix)) and abs(found) < 2.0**50 and np.abs(matrix).max() < 2.0**40:
        return float(_whole_determinant([[int(item) for item in row] for row in matrix.tolist()]))
    return found


def _whole_determinant(rows: list[list[int]]) -> int:
    """Bareiss' elimination without fractions."""
    sign, before, n = 1, 1, len(rows)
    for k in range(n - 1):
        pivot = next((i for i in range(k, n) if rows[i][k]), None)
        if pivot is None:
            return 0
        if pivot != k:
            rows[k], rows[pivot] = rows[pivot], rows[k]
            sign = -sign
        for i in range(k + 1, n):
            for j in range(k + 1, n):
                rows[i][j] = (rows[i][j] * rows[k][k] - rows[i][k] * rows[k][j]) // before
        before = rows[k][k]
    return sign * rows[-1][-1]


def unit(size: float) -> Numbers:
    """MUNIT."""
    n = math.trunc(size)
    if not 1 <= n <= 4096:
        raise Problem("#VALUE!")
    return np.eye(n)


PLAIN: dict[str, Callable[..., Any]] = {
    "MMULT": product,
    "MINVERSE": inverse,
    "MDETERM": determinant,
    "MUNIT": unit,
    "TRANSPOSE": lambda table: Cells(table.numbers.T, table.codes.T),
}

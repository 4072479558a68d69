"""The mean of a quantity over the motion, and in which motions all rows count alike in it."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from mechsheet.kinematics.driving import step_of
from mechsheet.kinematics.numeric import Array
from mechsheet.model import Mechanism

LEAST_OF_TURN = 4
"""Fewer rows are no turn."""


def mean_of_motion(columns: Array, there: Any, alike: Any) -> Array:
    """The mean of a quantity over the motion, for each row of `columns` (..., n): by the trapezoidal rule between neighbours
    that are both there, so that the row that closes a turn is not counted twice; 0 where nothing is there.

    there  which values exist (..., n);  alike: where all of them count alike (...): of listed values, and of a turn
           without the row that closes it. They also do where no two that are there are neighbours.
    """
    counts = np.asarray(there, bool)
    known = np.where(counts, columns, 0.0)
    pairs = np.asarray(counts[..., 1:] & counts[..., :-1], float)
    weights = np.zeros(counts.shape)
    weights[..., 1:] += pairs / 2
    weights[..., :-1] += pairs / 2
    alike = np.asarray(alike, bool) | ~pairs.any(axis=-1)
    weights = np.where(alike[..., None], counts, weights)
    return np.asarray((known * weights).sum(axis=-1) / np.maximum(weights.sum(axis=-1), 1.0))


def rows_count_alike(mechanism: Mechanism, rows: Array, tied: bool) -> bool:
    """Whether in a mean over the motion all rows count alike: of listed values, and of whole turns without the row that
    would close them.

    rows  the driver's values [rad or length unit];  tied: whether gears or racks are on the way, which close later
    """
    driver = mechanism.driver
    if driver.values or tied or not driver.link or driver.law is not None or len(rows) < LEAST_OF_TURN:
        return bool(driver.values)
    turns = abs(step_of(rows)) * len(rows) / math.tau
    return abs(round(turns) - turns) < 1e-9 and round(turns) > 0

"""Rows between which a mechanism leaps: to another branch, or because the steps are too coarse to follow it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mechsheet.reference import Solution

LEAP = 4.0
"""A step so many times as large as those before and after it is a leap."""

ROUNDING = 1e-9
"""Moves below this part of the size, and turns below this [rad], are rounding."""


def leaps(solution: Solution) -> NDArray[np.bool_]:
    """(n,) True in a row that exists, as the row before does, to which the mechanism leaps from there.

    A leap: the farthest move of a point, or the largest turn of a link, is more than `LEAP` times as large as in the step
    before and in the step after; or a link turns by more than half a turn. The driver's own angle steps as it likes.
    """
    mechanism = solution.mechanism
    fixed = mechanism.ground.points
    moves = [np.hypot(*np.diff(places, axis=0).T) for name, places in solution.points.items() if name not in fixed]
    angles = [
        np.abs(np.diff(solution.poses[link.name][:, 2]))
        for link in mechanism.links[1:]
        if link.angle_symbol != mechanism.driver.symbol
    ]
    flags = np.zeros(len(solution.driver), dtype=bool)
    if len(flags) < 2:
        return flags
    for steps, rounding in ((moves, ROUNDING * solution.size), (angles, ROUNDING)):
        if steps:
            flags[1:] |= _stands_out(np.max(np.stack(steps), axis=0), rounding)
    for turned in angles:
        flags[1:] |= np.nan_to_num(turned) > np.pi
    return flags


def _stands_out(step: NDArray[np.float64], rounding: float) -> NDArray[np.bool_]:
    """Steps (NaN where a row is missing) that are much larger than both neighbours; a missing neighbour does not count."""
    padded = np.concatenate([[np.nan], step, [np.nan]])
    before, after = padded[:-2], padded[2:]
    alone = np.isnan(before) & np.isnan(after)
    largest = np.fmax(before, after)
    with np.errstate(invalid="ignore"):
        found: NDArray[np.bool_] = ~alone & (step > LEAP * largest + rounding)
    return found

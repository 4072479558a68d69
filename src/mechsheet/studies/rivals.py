"""Rows of many designs that may have more beside them than what was found: see `sheet/checks/rivals.py`."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from mechsheet.sheet.checks.one_extreme import SETTLED

Array = NDArray[np.float64]


def promised(
    upwards: bool,
    column: Array,
    here: NDArray[np.intp],
    span: tuple[NDArray[np.int64], NDArray[np.int64]],
    wraps: Array,
    most: Array,
    worst: Array,
) -> Array:
    """The most that a row promises beside it that is neither near the one the probes begin from nor a twin of the best one;
    infinite the other way where there is none.

    column  the quantity, designs by rows;  here: the row, from 0;  span: the first and the last one, from 1
    wraps   1, 2 where these are neighbours (one row twice, or not), else 0;  most, worst: the extremes of the rows
    """
    y = column if upwards else -column
    designs, rows = y.shape
    each = np.arange(designs)
    first, last = (np.asarray(end, np.int64) - 1 for end in span)
    number = np.arange(rows)[None, :]
    inside = (number > first[:, None]) & (number < last[:, None]) & (np.abs(number - here[:, None]) > 1)
    whole = last - first + 1 == rows
    before, own, after = y[:, :-2], y[:, 1:-1], y[:, 2:]
    # of a closed turn the row before the last is the first one's neighbour; of a part of the rows no peak is asked for
    near = np.abs(np.abs(number - here[:, None]) - rows + 1) <= (wraps == 1)[:, None]
    inside[:, 1:-1] &= ((own >= before) & (own >= after) & ~near[:, 1:-1]) | ~whole[:, None]
    promise = np.full(y.shape, -np.inf)
    promise[:, 1:-1] = 1.5 * own - (before + after) / 4
    twin = (most if upwards else -most) - SETTLED * np.abs(most - worst)
    found = np.max(np.where(inside & (y < twin[:, None]), promise, -np.inf), axis=1)

    def at(place: NDArray[np.int64]) -> Array:
        return y[each, np.clip(place, 0, rows - 1)]

    for end, other, inward in ((first, last, 1), (last, first, -1)):
        value, next_, third = (at(end + step * inward) for step in range(3))
        outside = np.where(wraps == 0, 3 * (value - next_) + third, np.where(wraps == 1, at(other - inward), at(other)))
        apart = (np.abs(here - end) > 1) & ((wraps == 0) | (np.abs(here - other) > 1))
        rival = apart & (value >= outside) & (value >= next_) & (value < twin)
        found = np.where(rival, np.fmax(found, 1.5 * value - (outside + next_) / 4), found)
    # where the quantity has no value in some row of the span, the sheet says nothing
    missing = (np.isnan(y) & (number >= first[:, None]) & (number <= last[:, None])).any(axis=1)
    found = np.where(missing | (last - first < 2), -np.inf, found)
    return found if upwards else -found


def beyond(upwards: bool, rival: Array, found: Array, most: Array, worst: Array) -> NDArray[np.bool_]:
    """Whether that is more than what was found."""
    allowed = SETTLED * np.abs(most - worst)
    return np.asarray(rival > found + allowed if upwards else rival < found - allowed)

"""How many of the rows that a description asks for a workbook's own rows answer."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from mechsheet import reference
from mechsheet.diagnostics import MechanismError
from mechsheet.homework.expected_values import Array, Truth, truth_of
from mechsheet.homework.understanding import Understanding

COARSE = 2.0
"""Between two rows of a sheet what is asked is answered when they are no farther apart than so many of the steps asked for:
a step of 20 degrees in place of 15 is the sheet's own business, one of 90 is not."""
EXACT = 1e-6
"""Steps that agree to this part of them are equal."""


def rows_answered(found: Understanding) -> NDArray[np.bool_]:
    """Which of the rows that the description asks for, with the sheet's dimensions, a table answers; with dimensions that
    give no rows its own count."""
    asked = _asked_values(found.truth)
    if asked is None:
        return np.ones(1, bool)
    return answered(asked, found.truth.driver, not found.mechanism.driver.joint)


def over_asked_rows(found: Understanding) -> Truth | None:
    """The mechanism of the sheet in the rows that the description asks for."""
    asked = _asked_values(found.truth)
    truth = found.truth
    return None if asked is None else truth_of(truth.mechanism, truth.dimensions, asked, truth.poses)


def _asked_values(truth: Truth) -> Array | None:
    try:
        return reference.driver_values(truth.mechanism, truth.dimensions)
    except (MechanismError, KeyError, ArithmeticError):
        return None


def answered(asked: Array, given: Array, turns: bool) -> NDArray[np.bool_]:
    """Which of the values asked for the `given` rows answer: those that are within half a step of one, or between two that
    are at most COARSE steps apart. `turns`: an angle may be given a whole turn away, and 0 is 360 of a whole turn."""
    step = _steps(asked) * (1 + EXACT)
    ordered = np.unique(given)
    if not turns:
        return _near(asked, ordered, step)
    if np.ptp(ordered) >= math.tau - COARSE * float(step.min()):
        once = np.remainder(ordered, math.tau)
        around = np.unique(np.concatenate([once - math.tau, once, once + math.tau]))
        return _near(np.remainder(asked, math.tau), around, step)
    away = math.tau * round(float(np.mean(asked) - np.mean(ordered)) / math.tau)
    return max((_near(asked, ordered + turn, step) for turn in (0.0, away)), key=np.count_nonzero)


def _near(asked: Array, ordered: Array, step: Array) -> NDArray[np.bool_]:
    after = np.searchsorted(ordered, asked)
    below = ordered[np.maximum(after - 1, 0)]
    above = ordered[np.minimum(after, len(ordered) - 1)]
    nearest = np.minimum(np.abs(asked - below), np.abs(above - asked))
    between = (below <= asked) & (asked <= above) & (above - below <= COARSE * step)
    return np.asarray(between | (nearest <= step / 2))


def _steps(asked: Array) -> Array:
    """The step at each of the values asked for: the larger of those to the values beside it; one value has every other."""
    ordered = np.unique(asked)
    if len(ordered) < 2:
        return np.full(len(asked), math.inf)
    gaps = np.diff(ordered)
    at = np.searchsorted(ordered, asked)
    steps: Array = np.maximum(gaps[np.maximum(at - 1, 0)], gaps[np.minimum(at, len(gaps) - 1)])
    return steps

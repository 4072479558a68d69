"""Axes of a curve: from where to where, with which steps, and where a number of it stands."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from livesheet.workbook import Axis
from mechsheet.plotting.scenes import Points

MOST_TICKS = 7
DEGREES = (1, 2, 5, 10, 15, 30, 45, 60, 90, 180, 360, 720)


@dataclass(frozen=True, slots=True)
class Scale:
    """low and high end up at `start` and `end` (pixels); ticks are the numbers to be written beside the axis."""

    low: float
    high: float
    start: float
    end: float
    ticks: tuple[float, ...]

    def place(self, values: Points) -> Points:
        """Pixels of numbers."""
        return self.start + (values - self.low) / (self.high - self.low) * (self.end - self.start)


def scale_of(axis: Axis, numbers: Iterable[Points], start: float, end: float) -> Scale:
    """The axis as the workbook wants it; what it leaves open is chosen so that all numbers are seen."""
    if axis.low is not None and axis.high is not None:
        step = axis.step or nice_step((axis.high - axis.low) / (MOST_TICKS - 1), "°" in axis.title)
        first, last = math.ceil(axis.low / step - 1e-9), math.floor(axis.high / step + 1e-9)
        return Scale(axis.low, axis.high, start, end, tuple(step * n for n in range(first, last + 1)))
    found = np.concatenate([column[np.isfinite(column)] for column in numbers])
    low, high = (float(found.min()), float(found.max())) if len(found) else (0.0, 1.0)
    if high - low <= 1e-9 * max(abs(low), abs(high)):
        low, high = low - 1.0, high + 1.0
    low, high = low if axis.low is None else axis.low, high if axis.high is None else axis.high
    step = nice_step((high - low) / (MOST_TICKS - 1), "°" in axis.title)
    first, last = math.floor(low / step + 1e-9), math.ceil(high / step - 1e-9)
    return Scale(first * step, last * step, start, end, tuple(n * step for n in range(first, last + 1)))


def nice_step(least: float, degrees: bool) -> float:
    """The smallest sensible step not under `least`: a part of a turn, or 1, 2, 5 times a power of ten."""
    if degrees and 1 < least <= DEGREES[-1]:
        return next(float(step) for step in DEGREES if step >= least)
    power = 10.0 ** math.floor(math.log10(least))
    return next(digit * power for digit in (1.0, 2.0, 5.0, 10.0) if digit * power >= least * (1 - 1e-9))


def tick_text(value: float) -> str:
    """A number beside the axis, without the dust of its rounding."""
    return f"{value:.6g}".replace("-", "−") if abs(value) > 1e-12 else "0"

"""How near two answers are, and how near they must be at a dead centre."""

from __future__ import annotations

import math

import numpy as np

from mechsheet.checking.inputs import Array

DEAD_CENTRE = 1e-6
"""At a dead centre a position is as uncertain as the square root of rounding: two answers that both close the loops to
CLOSED agree when they are this near."""

CLOSED = 1e-11
"""A closure residual, as a part of the size, that is nothing but rounding."""


def apart_of(ours: Array, theirs: Array, turns: bool, scale: float | Array) -> Array:
    """How far two columns are apart, row by row: as a part of the scale; of one that `turns`, but for whole turns [rad]."""
    with np.errstate(invalid="ignore"):
        gap = ours - theirs
        return np.abs(np.remainder(gap + math.pi, math.tau) - math.pi) if turns else np.abs(gap / scale)

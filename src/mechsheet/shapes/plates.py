"""The inside of plates, as lines: rings about the middle, the outline smaller and smaller.

Charts of spreadsheets fill nothing, but a line that is wide enough does; and names keep away from lines.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mechsheet.kinematics.numeric import Array

MOST_RINGS = 16
"""A plate as large as the window has fewer."""


APART = 0.8
"""How far a ring is from the next, in widths of the line: round corners leave gaps at sharp ones."""


def ways_in(count: int) -> tuple[float, ...]:
    """How far from the outline to the middle so many rings are; the last leaves half a line's width in the middle."""
    return tuple(number / (count + 0.5) for number in range(1, count + 1))


def rings(outline: Array, count: int) -> Array:
    """One line (n, 2) around and around, from a closed outline inwards."""
    middle = outline[:-1].mean(axis=0)
    return np.concatenate([outline, *(outline + way * (middle - outline) for way in ways_in(count))])


def rings_needed(outline: Array, width: float) -> int:
    """How many rings fill a closed outline, by a line of a width: none where its corners lie on a line."""
    middle = outline[:-1].mean(axis=0)
    depth = max(_distances(middle, outline), default=0.0)
    return min(MOST_RINGS, max(0, math.ceil(depth / (APART * width) - 0.5)))


def _distances(place: Array, outline: Array) -> Sequence[float]:
    """From a place to the lines through the sides of an outline."""
    sides, ways = np.diff(outline, axis=0), place - outline[:-1]
    lengths = np.hypot(*sides.T)
    areas = np.abs(sides[:, 0] * ways[:, 1] - sides[:, 1] * ways[:, 0])
    return [float(area / length) for area, length in zip(areas, lengths, strict=True) if length > 0]

"""Where names stand: near what they are of, where no line, ring or other name is, as far as boxes round the texts can say.

All places are in half windows from the middle of the window. Of each name many places around its point are looked at, near
ones first; the first that covers nothing is taken. Where there is none, a name that is needed stands where it covers the
least, and any other is left out.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from livesheet import portable
from mechsheet.kinematics.numeric import Array

POINTS = 180.0
"""Points of a printer that half a window is high."""

WIDE = 0.66
"""How wide most letters are, in heights of the text; those that are wider or narrower have widths of their own."""

WIDTHS = {
    **dict.fromkeys("mwMW", 0.98), **dict.fromkeys("₀₁₂₃₄₅₆₇₈₉ₙ²³", 0.42), **dict.fromkeys(" .,;:|'!ilj°()", 0.36)
}  # fmt: skip

TALL, DEEP = 0.74, 0.98
"""How high the letters of a text are over its whole height; where some go below the line."""

BELOW = frozenset("_,;gjpqy\u00e7\u015f\u00c7\u015eμ")

PAD = 0.008
"""What stays free around a text."""

DIRECTIONS = 24
GAPS = (0.034, 0.055, 0.085, 0.125, 0.175, 0.24)
"""How far from a place its name begins."""

RINGS = (slice(0, 2 * DIRECTIONS), slice(2 * DIRECTIONS, None))
"""Places that are looked at together."""

FIRST_DIRECTION = 60.0
"""In degrees; of equally good places that nearest to this direction is taken."""

OVER_NAME, OVER_LINE, OUTSIDE, OVER_PATH, FURTHER, TURNED = 1000.0, 300.0, 2000.0, 20.0, 100.0, 1.0
"""What counts against a place: a name or a ring under it, a line, the edge of the window, a path; its distance, its side."""


@dataclass(frozen=True, slots=True)
class Boxes:
    """Rectangles: middles (n, 2) and half sides (n, 2)."""

    middles: Array
    halves: Array

    def near(self, at: Array, reach: Array) -> Boxes:
        """Those that come so near to a place."""
        beside, above = (np.abs(self.middles - at) <= self.halves + reach).T
        there = beside & above
        return Boxes(self.middles[there], self.halves[there])


@dataclass(frozen=True, slots=True)
class Lines:
    """Straight lines from place to place, (n, 2) both; half their widths (n,)."""

    starts: Array
    ends: Array
    widths: Array

    def near(self, at: Array, reach: Array) -> Lines:
        """Those that come so near to a place."""
        middle, half = (self.starts + self.ends) / 2, np.abs(self.ends - self.starts) / 2 + self.widths[:, None]
        beside, above = (np.abs(middle - at) <= half + reach).T
        there = beside & above
        return Lines(self.starts[there], self.ends[there], self.widths[there])


def half_box(text: str, size: float) -> Array:
    """Half the sides of a text's box; `size` in points."""
    wide = sum(WIDTHS.get(letter, WIDE) for letter in text)
    high = DEEP if BELOW & set(text) else TALL
    return np.array([wide * size / POINTS / 2 + PAD, high * size / POINTS / 2 + PAD])


def crossed(boxes: Boxes, lines: Lines) -> Array:
    """How many lines each box meets: a line and a box are apart where one of three directions parts them.

    Few are as near as that in x and in y; across the line only these are looked at.
    """
    middle, half = (lines.starts + lines.ends) / 2, (lines.ends - lines.starts) / 2
    offset_x, offset_y = (boxes.middles[:, None, axis] - middle[:, axis] for axis in (0, 1))
    room = [boxes.halves[:, None, axis] + lines.widths for axis in (0, 1)]
    near_x, near_y = (room[axis] + np.abs(half[:, axis]) for axis in (0, 1))
    box, line = np.nonzero((np.abs(offset_x) <= near_x) & (np.abs(offset_y) <= near_y))
    way_x, way_y = half[line].T
    across = np.abs(offset_x[box, line] * way_y - offset_y[box, line] * way_x)
    meets = across <= room[0][box, line] * np.abs(way_y) + room[1][box, line] * np.abs(way_x)
    return np.asarray(np.bincount(box[meets], minlength=len(boxes.middles)))


def covered(boxes: Boxes, others: Boxes) -> Array:
    """How many other boxes each box meets."""
    beside, above = (
        np.abs(boxes.middles[:, None, axis] - others.middles[:, axis])
        < boxes.halves[:, None, axis] + others.halves[:, axis]
        for axis in (0, 1)
    )
    return np.asarray(np.count_nonzero(beside & above, axis=1))


class Sheet:
    """What is drawn in a position, to be filled with names."""

    def __init__(self, lines: Lines, paths: Lines, taken: Boxes) -> None:
        self.lines, self.paths, self.taken = lines, paths, taken

    def take(self, at: Array, half: Array) -> None:
        """Nothing else stands in this box."""
        self.taken = Boxes(np.vstack([self.taken.middles, at]), np.vstack([self.taken.halves, half]))

    def on_no_line(self, boxes: Boxes) -> NDArray[np.bool_]:
        """Which boxes lie in the window and meet no line; none whose middle is NaN."""
        inside = (np.abs(boxes.middles) + boxes.halves <= 1.0).all(axis=1)
        return np.asarray(inside & (crossed(boxes, self.lines) == 0))

    def takes(self, at: Array, half: Array) -> bool:
        """Take this box where it meets no other one."""
        free = not bool(covered(Boxes(at[None], half[None]), self.taken).any())
        if free:
            self.take(at, half)
        return free

    def place(
        self, texts: tuple[str, ...], size: float, at: Array, beside: float, needed: bool
    ) -> tuple[str, Array] | None:
        """Which of the texts, longer ones first, has room, and where its middle is; None where none has."""
        least, best = math.inf, (texts[0], at, np.zeros(2))
        for text in texts:
            half = half_box(text, size)
            for ring in RINGS:  # farther ones only where no near one is free
                ways = _ways(half, beside)[ring]
                reach = np.abs(ways).max(axis=0) + half
                taken, lines, paths = self.taken.near(at, reach), self.lines.near(at, reach), self.paths.near(at, reach)
                middles = at + ways
                boxes = Boxes(middles, np.broadcast_to(half, middles.shape))
                hidden = OVER_NAME * covered(boxes, taken) + OVER_LINE * crossed(boxes, lines)
                hidden += OUTSIDE * (np.abs(middles) + half > 1.0).any(axis=1)
                cost = hidden + OVER_PATH * (crossed(boxes, paths) > 0) + _PREFERENCE[ring]
                index = int(np.argmin(cost))
                if cost[index] < least:
                    least, best = float(cost[index]), (text, middles[index], half)
                if least < OVER_PATH:
                    break
            if least < OVER_LINE:
                break
        if least >= OVER_LINE and not needed:
            return None
        text, middle, half = best
        self.take(middle, half)
        return text, middle


_ANGLES = np.radians(np.arange(DIRECTIONS) * (360.0 / DIRECTIONS))
_UNITS = np.column_stack([portable.cos(_ANGLES), portable.sin(_ANGLES)])
_TURN = np.abs((_ANGLES - math.radians(FIRST_DIRECTION) + math.pi) % math.tau - math.pi)
_PREFERENCE = np.concatenate([FURTHER * gap + TURNED * _TURN + 1e-3 * np.arange(DIRECTIONS) for gap in GAPS])


def _ways(half: Array, beside: float) -> Array:
    """From a place to the middles of boxes around it, one ring after another."""
    reach = np.abs(_UNITS) @ half  # of a box along a direction
    return np.concatenate([_UNITS * (gap + beside + reach)[:, None] for gap in GAPS])

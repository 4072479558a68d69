"""One judge's answers against the engine's: the comparison, its running tally, and what counts as agreement."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import Scalar

Array = NDArray[np.float64]

TOLERANCE = 1e-9
"""Largest difference that counts as agreement: of lengths as a part of the mechanism's size, of angles in radians."""


@dataclass(frozen=True, slots=True)
class Comparison:
    """One judge's answers against the engine's.

    judge   "stored values", "reference", or the name of a program
    cells   how many values were compared
    worst   largest difference (lengths as a part of the size, angles in radians, other numbers relative), 0 if none
    where   cell and quantity of the worst difference;  ours, theirs  the two values there
    agrees  nothing differs by more than the tolerance, and errors stand in the same cells
    subject whose values `ours` are
    """

    judge: str
    cells: int
    worst: float = 0.0
    where: str = ""
    ours: str = ""
    theirs: str = ""
    agrees: bool = True
    subject: str = "engine"


@dataclass
class Tally:
    """The running worst of a comparison."""

    judge: str
    cells: int = 0
    worst: float = -1.0
    where: str = ""
    ours: str = ""
    theirs: str = ""
    agrees: bool = True
    tolerance: float = TOLERANCE

    def note(self, difference: float, where: str, ours: Scalar, theirs: Scalar) -> None:
        """Count one pair; NaN or infinity is a difference in kind (a number against an error)."""
        self.cells += 1
        if not math.isfinite(difference):
            difference = math.inf
        if difference > self.tolerance:
            self.agrees = False
        if difference > self.worst:
            self.worst, self.where = difference, where
            self.ours, self.theirs = text_of(ours), text_of(theirs)

    def note_column(self, symbol: str, apart: Array, address: Callable[[int], str], ours: Array, theirs: Array) -> None:
        """Count a column, and note the row where the two are farthest apart; `address`: the cell in a row."""
        self.cells += len(apart) - 1
        row = int(np.argmax(apart))
        self.note(float(apart[row]), f"{address(row)} ({symbol}, row {row})", float(ours[row]), float(theirs[row]))

    def result(self) -> Comparison:
        """The finished comparison."""
        return Comparison(self.judge, self.cells, max(self.worst, 0.0), self.where, self.ours, self.theirs, self.agrees)


def text_of(value: Scalar) -> str:
    """A value as a report shows it: numbers with all digits, nothing for an empty cell."""
    if value is None:
        return ""
    if isinstance(value, str):
        return value
    return repr(value) if isinstance(value, float) else str(value)

"""Single numbers from a whole sweep: what a summary is, and the cell of a sheet that holds it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechsheet.formula.nodes import Symbol
from mechsheet.homework.agreement import Reading, allowance, units_of
from mechsheet.homework.truth import Array, Kind, Quantity, Truth, truth_of
from mechsheet.kinematics.means import mean_of_motion
from mechsheet.kinematics.numeric import value
from mechsheet.model import Summary, Take

FINER = 20
"""Positions between two rows that are looked at for an extreme."""
MOST_ROWS = 5000
"""With more rows an extreme between two of them is no other number."""
CLOSED = 1e-6
"""So much of a turn the rows may lack that go around."""


@dataclass(frozen=True, slots=True)
class Span:
    """What a summary may be: from the rows alone, to the extreme between the rows; internal units."""

    kind: Kind
    low: float
    high: float

    def holds(self, numbers: Array, reading: Reading, allowed: float) -> NDArray[np.bool_]:
        """Which numbers are it."""
        values = reading.unit * numbers
        return np.asarray((self.low - allowed <= values) & (values <= self.high + allowed))

    @property
    def quantity(self) -> Quantity:
        """Its ends as a quantity: what units and how much of a difference are allowed."""
        return Quantity("", self.kind, np.array([self.low, self.high]))


def taken(column: Array, take: Take, kind: Kind, alike: bool = False) -> float:
    """The number that a summary takes from a column; `alike`: in a mean all rows count alike."""
    there = np.isfinite(column)
    known = column[there]
    if not len(known):
        return math.nan
    if kind == "angle" and len(take.ways) > 1:  # a way that an angle has gone has no turns to choose
        known = np.unwrap(known)
    averaged = np.asarray(value(take.row(Symbol("x")), {"x": column}))
    parts = {"least": known.min(), "largest": known.max(), "first": known[0], "last": known[-1]}
    return float(value(take.value, parts | {"mean": mean_of_motion(averaged, there, alike)}))


def span_of(truth: Truth, symbol: str) -> Span:
    """What a summary may be."""
    if symbol not in truth.spans:
        truth.spans[symbol] = _span(truth, truth.summary(symbol))
    return truth.spans[symbol]


def _span(truth: Truth, summary: Summary) -> Span:
    kind = truth.kinds.get(summary.of, "number")
    column = truth.columns[summary.of]
    if "mean" in summary.take.parts:
        turns = float(truth.driver[-1] - truth.driver[0]) / math.tau
        closed = truth.mechanism.driver.link and round(turns) != 0 and abs(turns - round(turns)) < CLOSED
        # over a part of a turn the mean of the rows is an answer too, over a turn it counts the closing row twice
        means = [taken(column, summary.take, kind, alike) for alike in ((False,) if closed else (False, True))]
        return Span(kind, min(means), max(means))
    plain = taken(column, summary.take, kind)
    if not summary.take.ways:
        return Span(kind, plain, plain)
    rows = len(truth.driver)
    if rows > MOST_ROWS:
        return Span(kind, plain, plain)
    finer = np.interp(np.arange((rows - 1) * FINER + 1) / FINER, np.arange(rows), truth.driver)
    between = truth_of(truth.mechanism, truth.dimensions, finer, truth.poses)
    exact = plain if between is None else taken(between.columns[summary.of], summary.take, kind)
    return Span(kind, min(plain, exact), max(plain, exact))


def reading_of_number(number: float, span: Span, size: float, tolerance: float) -> Reading | None:
    """The unit in which a number is a summary."""
    for unit in units_of(span.quantity):
        reading = Reading(unit)
        if span.holds(np.array(number), reading, allowance(span.quantity, size, tolerance)):
            return reading
    return None


def holding(numbers: Array, span: Span, size: float, tolerance: float) -> NDArray[np.bool_]:
    """Which numbers are a summary, in whatever unit."""
    allowed = allowance(span.quantity, size, tolerance)
    found = np.zeros(numbers.shape, bool)
    for unit in units_of(span.quantity):
        found |= span.holds(numbers, Reading(unit), allowed)
    return found

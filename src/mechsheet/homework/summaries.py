"""Single numbers from a whole sweep: what a summary is, and the cell of a sheet that holds it."""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import Symbol
from mechsheet.homework.agreement import Reading, allowance, units_of
from mechsheet.homework.expected_values import Array, Kind, Span, Truth, truth_of
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.whole_turns import mean_of_motion
from mechsheet.model import Summary, Take

FINER = 20
"""Positions between two rows that are looked at for an extreme."""
MOST_ROWS = 5000
"""With more rows an extreme between two of them is no other number."""
CLOSED = 1e-6
"""So much of a turn the rows may lack that go around."""


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
    finer = _finer(truth, summary)
    shift = truth.shifts.get(summary.of)
    plain = _values(truth, finer, summary, lambda column: column)
    if shift is None:
        return Span(kind, min(plain), max(plain), plain[0])
    own = _values(truth, finer, summary, shift.counted)
    return Span(kind, min(plain), max(plain), own[0], (min(own), max(own)))


def _finer(truth: Truth, summary: Summary) -> Truth | None:
    """The mechanism with positions between the rows too, where an extreme between two of them may be another number."""
    rows = len(truth.driver)
    if "mean" in summary.take.parts or not summary.take.ways or rows > MOST_ROWS:
        return None
    finer = np.interp(np.arange((rows - 1) * FINER + 1) / FINER, np.arange(rows), truth.driver)
    return truth_of(truth.mechanism, truth.dimensions, finer, truth.poses)


def _values(truth: Truth, finer: Truth | None, summary: Summary, counted: Callable[[Array], Array]) -> list[float]:
    """What may be answered, with the column as `counted`: first what the rows alone give."""
    kind = truth.kinds.get(summary.of, "number")
    column = counted(truth.columns[summary.of])
    if "mean" in summary.take.parts:
        turns = float(truth.driver[-1] - truth.driver[0]) / math.tau
        closed = truth.mechanism.driver.link and round(turns) != 0 and abs(turns - round(turns)) < CLOSED
        # over a part of a turn the mean of the rows is an answer too, over a turn it counts the closing row twice
        return [taken(column, summary.take, kind, alike) for alike in ((False,) if closed else (False, True))]
    found = [taken(column, summary.take, kind)]
    return found if finer is None else [*found, taken(counted(finer.columns[summary.of]), summary.take, kind)]


def reading_of_number(number: float, span: Span, size: float, tolerance: float) -> Reading | None:
    """The unit in which a number is a summary."""
    for unit in units_of(span.quantity):
        reading = Reading(unit)
        if holds(span, np.array(number), reading, allowance(span.quantity, size, tolerance)):
            return reading
    return None


def holds(span: Span, numbers: Array, reading: Reading, allowed: float) -> NDArray[np.bool_]:
    """Which numbers are it."""
    values = reading.unit * numbers
    ends = [(span.low, span.high), *([span.own] if span.own else [])]
    return np.asarray(sum((low - allowed <= values) & (values <= high + allowed) for low, high in ends), bool)


def holding(numbers: Array, span: Span, size: float, tolerance: float) -> NDArray[np.bool_]:
    """Which numbers are a summary, in whatever unit."""
    allowed = allowance(span.quantity, size, tolerance)
    found = np.zeros(numbers.shape, bool)
    for unit in units_of(span.quantity):
        found |= holds(span, numbers, Reading(unit), allowed)
    return found

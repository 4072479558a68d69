"""Single numbers from a whole sweep: what a summary is, and the cell of a sheet that holds it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from mechsheet.homework.agreement import Reading, allowance, units_of
from mechsheet.homework.truth import Array, Kind, Quantity, Truth, truth_of
from mechsheet.model import Summary

FINER = 20
"""Positions between two rows that are looked at for an extreme."""


@dataclass(frozen=True, slots=True)
class Span:
    """What a summary may be: from the rows alone, to the extreme between the rows; internal units."""

    kind: Kind
    low: float
    high: float

    def holds(self, number: float, reading: Reading, allowed: float) -> bool:
        """Whether a number is it."""
        value = reading.unit * number
        return self.low - allowed <= value <= self.high + allowed


def taken(column: Array, take: str, kind: Kind) -> float:
    """The number that a summary takes from a column."""
    known = column[np.isfinite(column)]
    if not len(known):
        return math.nan
    if take == "range":
        known = np.unwrap(known) if kind == "angle" else known
        return float(np.ptp(known))
    if take == "max":
        return float(known.max())
    if take == "min":
        return float(known.min())
    if take == "mean":
        return float(known.mean())
    return float(known[0] if take == "first" else known[-1])


def span_of(truth: Truth, summary: Summary) -> Span:
    """What a summary may be."""
    kind = truth.kinds.get(summary.of, "number")
    column = truth.columns[summary.of]
    plain = taken(column, summary.take, kind)
    if summary.take in ("first", "last", "mean"):
        return Span(kind, plain, plain)
    rows = len(truth.driver)
    finer = np.interp(np.arange((rows - 1) * FINER + 1) / FINER, np.arange(rows), truth.driver)
    between = truth_of(truth.mechanism, truth.dimensions, finer, truth.poses)
    exact = plain if between is None else taken(between.columns[summary.of], summary.take, kind)
    return Span(kind, min(plain, exact), max(plain, exact))


def reading_of_number(number: float, span: Span, size: float, tolerance: float) -> Reading | None:
    """The unit in which a number is a summary."""
    quantity = Quantity("", span.kind, np.array([span.low, span.high]))
    allowed = allowance(quantity, size, tolerance)
    for unit in units_of(quantity):
        reading = Reading(unit)
        if span.holds(number, reading, allowed):
            return reading
    return None

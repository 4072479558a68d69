"""Whether a column of a sheet is a quantity of the mechanism, and in what unit, sense and zero it is written."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechsheet.homework.expected_values import Array, Quantity

DEGREE = math.pi / 180
POWERS = (1.0, 0.1, 10.0, 0.01, 100.0, 1e-3, 1e3)
"""Length units that people mix: mm, cm, m."""
TINY = 1e-9
"""Smaller sizes are nothing."""
FEWEST = 3
"""Rows that must be there before two columns can be called equal."""


@dataclass(frozen=True, slots=True)
class Reading:
    """How a column says a quantity: quantity = sense * unit * column - offset, angles modulo a turn."""

    unit: float = 1.0
    sense: int = 1
    offset: float = 0.0

    @property
    def plain(self) -> bool:
        """Whether it is the quantity itself, in whatever unit."""
        return self.sense == 1 and self.offset == 0.0

    def of(self, column: Array) -> Array:
        """A column in internal units."""
        return self.sense * self.unit * column - self.offset


def wrapped(angle: Array) -> Array:
    """Angles within half a turn."""
    found: Array = np.remainder(angle + math.pi, math.tau) - math.pi
    return found


def allowance(quantity: Quantity, size: float, tolerance: float) -> float:
    """How far two values of a quantity may be apart."""
    if quantity.kind == "angle":
        return tolerance
    if quantity.kind == "length":
        return tolerance * size
    found = np.abs(quantity.values[np.isfinite(quantity.values)])
    return tolerance * max(float(found.max(initial=0.0)), 1e-12)


def units_of(quantity: Quantity) -> Sequence[float]:
    """The factors in which a quantity may be written."""
    if quantity.kind == "angle":
        return (1.0, DEGREE)
    if quantity.kind == "length":
        return POWERS
    return (1.0, DEGREE, math.tau / 60)  # of rates also degrees and turns a minute


def gaps(columns: Array, quantity: Quantity, reading: Reading) -> Array:
    """How far columns, shape (..., rows), are from a quantity in each row that exists; inf where they hold no number."""
    with np.errstate(all="ignore"):
        apart = reading.of(columns) - quantity.values
        if quantity.kind == "angle":
            apart = wrapped(apart)
    apart = np.abs(apart)
    known = np.isfinite(quantity.values)
    return np.where(known, np.where(np.isnan(apart), math.inf, apart), 0.0)


def agrees(columns: Array, quantity: Quantity, reading: Reading, allowed: float) -> NDArray[np.bool_]:
    """Which of the columns, shape (..., rows), are the quantity, read so."""
    if np.isfinite(quantity.values).sum() < min(FEWEST, len(quantity.values)):
        return np.zeros(columns.shape[:-1], bool)
    found: NDArray[np.bool_] = gaps(columns, quantity, reading).max(axis=-1) <= allowed
    return found


def likely(columns: Array, quantity: Quantity, allowed: float) -> NDArray[np.bool_]:
    """Which of the columns, shape (columns, rows), may say a quantity at all: all that `reading_of` finds are among them.

    An angle counted from anywhere differs from it by the same in each row.
    """
    known = np.isfinite(quantity.values)
    found: NDArray[np.bool_] = np.asarray(np.isfinite(columns[:, known]).all(axis=1), bool)
    if known.sum() < min(FEWEST, len(known)):
        return np.zeros(len(columns), bool)
    whole, values = columns[np.ix_(found, known)], quantity.values[known]
    good = np.zeros(len(whole), bool)
    for unit in units_of(quantity):
        for sense in (1,) if quantity.kind == "number" else (1, -1):
            apart = sense * unit * whole - values
            if quantity.kind == "angle":
                apart = wrapped(apart - apart[:, :1])
            good |= np.abs(apart).max(axis=1, initial=0.0) <= 2 * allowed
    found[found] = good
    return found


def plain_reading(column: Array, quantity: Quantity, allowed: float) -> Reading | None:
    """The unit in which a column is the quantity itself."""
    for unit in units_of(quantity):
        reading = Reading(unit)
        if agrees(column, quantity, reading, allowed):
            return reading
    return None


def reading_of(column: Array, quantity: Quantity, allowed: float, zeros: Iterable[float] = ()) -> Reading | None:
    """How a column says a quantity: itself first, then in the other sense or from another zero.

    zeros  angles among the dimensions: an angle may be counted from there, besides from 0, a quarter or half a turn
    """
    found = plain_reading(column, quantity, allowed)
    if found is not None or quantity.kind == "number":
        return found
    known = np.flatnonzero(np.isfinite(quantity.values) & np.isfinite(column))
    if not len(known):
        return None
    for unit in units_of(quantity):
        for sense in (1, -1):
            offset = 0.0
            if quantity.kind == "angle":
                offset = _zero(float(sense * unit * column[known[0]] - quantity.values[known[0]]), allowed, zeros)
            reading = Reading(unit, sense, offset)
            if agrees(column, quantity, reading, allowed):
                return reading
    return None


def otherwise(columns: Array, quantity: Quantity, allowed: float, zeros: Sequence[float]) -> NDArray[np.bool_]:
    """Which of the columns, shape (columns, rows), say an angle in some sense from one of these zeros."""
    found = np.zeros(len(columns), bool)
    known = np.flatnonzero(np.isfinite(quantity.values))
    if quantity.kind != "angle" or len(known) < FEWEST:
        return found
    offsets = np.array(zeros)
    for unit in units_of(quantity):
        for sense in (1, -1):
            apart = sense * unit * columns[:, known] - quantity.values[known]
            from_zero = np.abs(wrapped(apart[:, :1] - offsets))
            nearest = offsets[np.argmin(np.where(np.isnan(from_zero), math.inf, from_zero), axis=1)]
            found |= np.abs(wrapped(apart - nearest[:, None])).max(axis=1) <= allowed
    return found


def nearest_unit(column: Array, quantity: Quantity) -> float:
    """The unit in which numbers that are not a quantity are of its size: how much they change, or how large one is."""

    def size(values: Array) -> float:
        there = values[np.isfinite(values)]
        return max(float(np.ptp(there) if len(there) > 1 else np.abs(there).max(initial=0.0)), TINY)

    return min(units_of(quantity), key=lambda unit: abs(math.log(size(unit * column) / size(quantity.values))))


def most_like(column: Array, quantity: Quantity, allowed: float, zeros: Iterable[float] = ()) -> Reading | None:
    """How a column says a quantity in more than half of its rows; as `reading_of` where it does in all."""
    best: tuple[int, Reading] | None = None
    turning = quantity.kind == "angle"
    offsets = np.array(zeros_of(zeros) if turning else [0.0])
    for unit in units_of(quantity):
        for sense in (1,) if quantity.kind == "number" else (1, -1):
            apart = sense * unit * column - quantity.values - offsets[:, None]
            counts = (np.abs(wrapped(apart) if turning else apart) <= allowed).sum(axis=1)
            place = int(np.argmax(counts))
            if best is None or counts[place] > best[0]:
                best = int(counts[place]), Reading(unit, sense, float(offsets[place]))
    known = int(np.isfinite(quantity.values).sum())
    return None if best is None or 2 * best[0] <= known else best[1]


def zeros_of(zeros: Iterable[float]) -> list[float]:
    """From where an angle may be counted, the usual first."""
    angles = (0.0, *(sign * zero for zero in zeros for sign in (1, -1)))
    return [quarter + angle for quarter in (0.0, math.pi, math.pi / 2, -math.pi / 2) for angle in angles]


def _zero(offset: float, allowed: float, zeros: Iterable[float]) -> float:
    """The zero that is meant by an offset found from one row; the offset 0 where none is near."""
    near = (zero for zero in zeros_of(zeros) if abs(math.remainder(offset - zero, math.tau)) <= allowed)
    return next(near, 0.0)

"""The designs of a study by their numbers, from 0 on: nothing holds all of them.

A grid is counted like a number of many digits, the last dimension first. Point n of Sobol's sequence is, bit by bit, an
exclusive or of a few points: of the powers of two that n is made of (their Gray code is linear, and so is its scrambling).
Source: scipy.stats.qmc.Sobol; Antonov, Saleev, An economic method of computing LP tau-sequences, 1979.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from decimal import Decimal
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from mechsheet.model import Range, Study
from mechsheet.studies.packages import sobol

Array = NDArray[np.float64]
Numbers = NDArray[np.int64]

LOW_BITS = 12
"""Points of so many bits are kept: a chunk of designs that follow one another differs in these."""

BITS = 30
"""Of each coordinate of a Sobol point: its range in 2^30 steps."""


class Sampling(Protocol):
    """Where designs come from. `total`: how many there are."""

    total: int

    def values(self, numbers: Numbers) -> Array:
        """The varied dimensions of designs, in their own units: a row for each design, a column for each dimension."""
        ...


def sampling_of(study: Study) -> Sampling:
    """The sampling that a study asks for."""
    return Sobol(study.vary, study.count, study.seed) if study.sample == "sobol" else Grid(study.vary)


class Grid:
    """All combinations of the ranges."""

    def __init__(self, vary: Sequence[Range]) -> None:
        self.vary = tuple(vary)
        self.lengths = [one.count for one in vary]
        self.total = math.prod(self.lengths)
        self._listed = [np.array(one.values, float) for one in vary]
        self._decimals = [_decimals(one) for one in vary]

    def values(self, numbers: Numbers) -> Array:
        """As `Sampling.values`: low + n step, rounded to the decimals that low and step are written with."""
        found = np.empty((len(numbers), len(self.vary)))
        rest = numbers
        for column in reversed(range(len(self.vary))):
            rest, place = np.divmod(rest, self.lengths[column])
            one = self.vary[column]
            if one.values:
                found[:, column] = self._listed[column][place]
            else:
                found[:, column] = np.round(one.low + place * one.step, self._decimals[column])
        return found


def _decimals(one: Range) -> int:
    """As many as the two numbers have, at most 15."""
    exponents = [Decimal(repr(number)).normalize().as_tuple().exponent for number in (one.low, one.step)]
    return min(15, max(0, *(-exponent for exponent in exponents if isinstance(exponent, int))))


class Sobol:
    """So many points of a scrambled Sobol sequence in the box of the ranges."""

    def __init__(self, vary: Sequence[Range], count: int, seed: int) -> None:
        self.total = count
        self._low = np.array([one.low for one in vary])
        self._way = np.array([one.high - one.low for one in vary])
        self._first, self._powers = _powers(len(self._low), max(1, (count - 1).bit_length()), seed)

        self._lowest = self._combined(np.arange(2**LOW_BITS, dtype=np.int64), self._powers[:LOW_BITS])

    def _combined(self, numbers: Numbers, powers: Sequence[Numbers]) -> Numbers:
        """The exclusive or of those powers that are bits of the numbers."""
        points = np.zeros((len(numbers), len(self._low)), np.int64)
        for bit, power in enumerate(powers):
            points ^= np.where((numbers >> bit & 1)[:, None], power, 0)
        return points

    def values(self, numbers: Numbers) -> Array:
        """As `Sampling.values`."""
        high, place = np.unique(numbers >> LOW_BITS, return_inverse=True)
        points = self._lowest[numbers & (2**LOW_BITS - 1)]
        points ^= (self._combined(high, self._powers[LOW_BITS:]) ^ self._first)[place]
        return np.asarray(self._low + self._way * (points * 2.0**-BITS))


def _powers(width: int, bits: int, seed: int) -> tuple[Numbers, list[Numbers]]:
    """Point 0 in steps of 2^-30, and by what points 1, 2, 4, 8 ... differ from it."""
    engine = sobol().Sobol(width, scramble=True, bits=BITS, seed=np.random.default_rng(seed))
    first = _steps(engine.random(1))
    found, at = [], 1
    for bit in range(bits):
        engine.fast_forward(2**bit - at)
        found.append(_steps(engine.random(1)) ^ first)
        at = 2**bit + 1
    return first, found


def _steps(points: Array) -> Numbers:
    return np.asarray(np.rint(points[0] * 2.0**BITS), np.int64)

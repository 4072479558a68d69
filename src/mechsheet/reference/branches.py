"""One block over many rows: every row solved on the same branch.

The branch of a block is the sign of its Jacobian's determinant: it is constant along smooth motion, changes only where
two assemblies meet, and is kept past such rows and past rows that do not exist. A block of one loop has at most two
solutions in each row, of opposite signs, so there the sign alone names one, and rows are solved independently of each other.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from . import newton
from .geometry import Array, whole_turns
from .newton import CLOSED
from .system import Block, linearised

Mask = NDArray[np.bool_]

FLAT = 1e-5
"""Below this determinant (of unit columns) a position is looked at more closely: a dead centre may be near."""

_PROBES = 25
_GUESSES = 16
_MANY_GUESSES = 96
_FEW_GUESSES = 4
_SNAP = 4e-15
_NEAR_MISS = 1e-5
_CHUNK = 4096
_LEAP = 0.35


@dataclass(frozen=True, slots=True)
class Rows:
    """What became of a block's rows: states (m, columns), whether the row exists, whether its position is undetermined."""

    state: Array
    exists: Mask
    undetermined: Mask


def solutions(block: Block, states: Array, values: Array) -> list[Array]:
    """Distinct solutions of a block in each of m rows: for each row of `states` (m, columns) an array (s, columns).

    None in a row (s = 0) where the position cannot be, or is undetermined.
    """
    if block.linear:
        rows = linear(block, states, values)
        return [rows.state[i : i + 1][rows.exists[i : i + 1]] for i in range(len(states))]
    count = _MANY_GUESSES if block.large else _GUESSES
    tried = _tried(block, *newton.starts(block, states, values, count))
    return [
        _distinct(block, _Tried(tried.state[part], tried.miss[part], tried.det[part]), values[i : i + 1])
        for i, part in enumerate(slice(first, first + count) for first in range(0, len(tried.state), count))
    ]


def _distinct(block: Block, tried: _Tried, value: Array) -> Array:
    """The solutions among the tries of one row, each once, angles within half a turn of zero but where gears count turns."""
    columns = block.free_angles
    found: list[Array] = []
    for i in np.flatnonzero(tried.miss <= _NEAR_MISS):
        state = tried.state[i : i + 1]
        if any(newton.same_position(block, state, other)[0] for other in found):
            continue
        settled = _settled(block, state, value, tried.miss[i], tried.det[i])
        if settled.undetermined[0]:
            return state[:0]
        state = settled.state.copy()
        state[:, columns] -= whole_turns(state[:, columns])
        if settled.exists[0] and not any(newton.same_position(block, state, other)[0] for other in found):
            found.append(state)
    return np.concatenate(found) if found else tried.state[:0]


def linear(block: Block, state: Array, value: Array) -> Rows:
    """A block with one solution: exact in one step; parallel lines have none, or any."""
    columns = list(block.columns)
    solved = state.copy()
    solved[:, columns] = 0.0
    exists = np.ones(len(state), dtype=bool)
    undetermined = np.zeros(len(state), dtype=bool)
    residuals, jacobian = linearised(block, solved, value)
    if len(columns) > 1:
        singular = np.linalg.svd(jacobian, compute_uv=False)
        degenerate = singular[:, -1] <= CLOSED * singular[:, 0]
    else:
        degenerate = np.abs(jacobian[:, 0, 0]) <= CLOSED
    if degenerate.any():
        step = (np.linalg.pinv(jacobian[degenerate], rcond=CLOSED) @ -residuals[degenerate][..., None])[..., 0]
        left = residuals[degenerate] + (jacobian[degenerate] @ step[..., None])[..., 0]
        undetermined[degenerate] = np.max(np.abs(left), axis=1) <= CLOSED
        exists[degenerate] = False
        jacobian[degenerate] = np.eye(len(columns))
    for _ in range(2):  # the second step takes away the rounding of the first
        solved[:, columns] += newton.directions(jacobian, -residuals)
        residuals, _ = linearised(block, solved, value)
    return Rows(solved, exists, undetermined)


@dataclass(frozen=True, slots=True)
class _Tried:
    state: Array
    miss: Array
    det: Array


def _tried(block: Block, states: Array, values: Array) -> _Tried:
    """What the guesses lead to, in chunks that fit the cache."""
    parts = []
    for first in range(0, len(states), _CHUNK):
        part = slice(first, first + _CHUNK)
        state, miss = newton.polish(block, newton.descend(block, states[part], values[part]), values[part])
        parts.append((state, miss, newton.determinant(block, state, values[part])))
    if not parts:
        return _Tried(states, np.empty(0), np.empty(0))
    return _Tried(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


def _settled(block: Block, state: Array, value: Array, miss: float, det: float) -> Rows:
    """A position near a dead centre looked at closely: `state` (1, columns) is a solution, or the nearest miss.

    Where the dead centre itself closes to rounding, it is the position. Where it closes to CLOSED only, links that
    reach each other keep the position found; links that miss each other by so little meet at the dead centre.
    """
    closes = miss <= CLOSED
    yes, no = np.array([True]), np.array([False])
    if closes and abs(det) > FLAT:
        return Rows(state, yes, no)
    centre, gap = newton.dead_centre(block, state, value)
    if closes and gap > CLOSED:
        return Rows(state, yes, no)
    if gap > CLOSED:
        return Rows(state, no, no)
    if newton.movable(block, centre, value):
        return Rows(state, no, yes)
    if not closes or gap <= _SNAP:
        return Rows(centre, yes, no)
    return Rows(state, yes, no)


def sweep(block: Block, state: Array, value: Array, sign: float) -> Rows:
    """Every row of a block with one loop on the branch `sign` (+1.0 or -1.0).

    Some rows are solved from scratch, the rest by Newton's method from in between; what that leaves is tried from its
    neighbours and then from many guesses, so that no row depends on the one before.
    """
    m = len(state)
    work = _Sweep(block, state, value, sign)
    probes = np.unique(np.round(np.linspace(0, m - 1, min(m, _PROBES))).astype(int))
    work.from_scratch(probes, _GUESSES)
    others = np.setdiff1d(np.arange(m), probes)
    if len(others):
        work.from_between(others)
        work.from_neighbours(others[~work.good[others]], probes)
        work.from_scratch(others[work.miss[others] > CLOSED], _FEW_GUESSES)
    mirrored = np.flatnonzero(~work.good & (work.miss <= CLOSED) & (np.abs(work.det) > FLAT))
    work.from_scratch(np.setdiff1d(mirrored, probes), _GUESSES)
    return work.edges()


class _Sweep:
    """Rows of one block while they are being solved.

    state  the best found so far: on the branch where `good`, else the one with the least miss `miss`
    """

    def __init__(self, block: Block, state: Array, value: Array, sign: float) -> None:
        self.block, self.value, self.sign = block, value, sign
        self.columns = np.array(block.columns)
        self.state = state.copy()
        self.good = np.zeros(len(state), dtype=bool)
        self.miss = np.full(len(state), np.inf)
        self.det = np.zeros(len(state))

    def take(self, rows: NDArray[np.int_], tried: _Tried) -> None:
        """Keep the best of the tries for each row: tries of a row stand together."""
        if not len(rows):
            return
        count = len(tried.state) // len(rows)
        miss, det = tried.miss.reshape(-1, count), tried.det.reshape(-1, count)
        right = (miss <= CLOSED) & (det * self.sign > 0)
        # On the branch first, and there the firmest; then whatever misses least.
        rank = np.where(right, -1.0 - np.minimum(np.abs(det), 1.0), np.minimum(miss, 1e300))
        best = np.argmin(rank, axis=1)
        chosen = np.arange(len(rows)) * count + best
        hit = right[np.arange(len(rows)), best]
        use = hit | (~self.good[rows] & (tried.miss[chosen] < self.miss[rows]))
        self.state[rows[use]] = tried.state[chosen[use]]
        self.miss[rows[use]], self.det[rows[use]] = tried.miss[chosen[use]], tried.det[chosen[use]]
        self.good[rows] |= hit

    def from_scratch(self, rows: NDArray[np.int_], guesses: int) -> None:
        for first in range(0, len(rows), _CHUNK):
            part = rows[first : first + _CHUNK]
            states, values = newton.starts(self.block, self.state[part], self.value[part], guesses)
            self.take(part, _tried(self.block, states, values))

    def from_between(self, rows: NDArray[np.int_]) -> None:
        """Newton's method from the straight line between the nearest solved rows."""
        solved = np.flatnonzero(self.good)
        if not len(solved):
            return
        after = np.clip(np.searchsorted(solved, rows), 0, len(solved) - 1)
        left, right = solved[np.maximum(after - 1, 0)], solved[after]
        part = np.clip((rows - left) / np.maximum(right - left, 1), 0.0, 1.0)[:, None]
        change = self.state[np.ix_(right, self.columns)] - self.state[np.ix_(left, self.columns)]
        turning = list(self.block.angles)
        change[:, turning] -= whole_turns(change[:, turning])
        guesses = self.state[rows]
        guesses[:, self.columns] = self.state[np.ix_(left, self.columns)] + part * change
        guesses = newton.placed(self.block, guesses, self.value[rows])
        state, miss = newton.polish(self.block, guesses, self.value[rows])
        self.take(rows, _Tried(state, miss, newton.determinant(self.block, state, self.value[rows])))

    def from_neighbours(self, rows: NDArray[np.int_], probes: NDArray[np.int_]) -> None:
        """Marquardt's method from the nearest solved row on either side and from the nearest probe."""
        if not len(rows):
            return
        solved = np.flatnonzero(self.good)
        origins = [_nearest(probes, rows)]
        if len(solved):
            after = np.searchsorted(solved, rows)
            origins += [solved[np.maximum(after - 1, 0)], solved[np.minimum(after, len(solved) - 1)]]
        guesses = np.repeat(self.state[rows], len(origins), axis=0)
        chosen = np.stack(origins, axis=1).ravel()
        guesses[:, self.columns] = self.state[np.ix_(chosen, self.columns)]
        values = np.repeat(self.value[rows], len(origins))
        self.take(rows, _tried(self.block, newton.placed(self.block, guesses, values), values))

    def edges(self) -> Rows:
        """Rows next to a dead centre settled one by one."""
        exists = self.good.copy()
        undetermined = np.zeros(len(exists), dtype=bool)
        doubtful = np.where(self.good, np.abs(self.det) <= FLAT, self.miss <= _NEAR_MISS)
        for i in np.flatnonzero(doubtful):
            row = slice(i, i + 1)
            miss = self.miss[i]
            if not self.good[i] and miss <= CLOSED:
                if abs(self.det[i]) > FLAT:
                    continue
                miss = np.inf  # closed, but on the other branch: only the dead centre itself belongs to both
            settled = _settled(self.block, self.state[row], self.value[row], miss, self.det[i])
            self.state[row] = settled.state
            exists[row], undetermined[row] = settled.exists, settled.undetermined
        return Rows(self.state, exists, undetermined)


def _nearest(marks: NDArray[np.int_], rows: NDArray[np.int_]) -> NDArray[np.int_]:
    after = np.clip(np.searchsorted(marks, rows), 1, max(len(marks) - 1, 1))
    before, after = marks[after - 1], marks[np.minimum(after, len(marks) - 1)]
    return np.where(rows - before <= after - rows, before, after)


def follow(block: Block, state: Array, value: Array, first: Array) -> Rows:
    """Every row of a block with several loops: `first` (1, columns) is row 0, each next row the nearest of its branch.

    Where Newton's method from the row before fails or leaps, the nearest solution of the same sign among all
    that many guesses lead to is taken; after rows that do not exist likewise.
    """
    columns = list(block.columns)
    rows = Rows(state.copy(), np.zeros(len(state), dtype=bool), np.zeros(len(state), dtype=bool))
    rows.state[0], rows.exists[0] = first[0], True
    sign = float(np.sign(newton.determinant(block, first, value[:1])[0]))
    last, trend = first[0, columns], np.zeros(len(columns))
    for i in range(1, len(state)):
        row = slice(i, i + 1)
        for guess in (last + trend, last):
            trial = state[row].copy()
            trial[:, columns] = guess
            found, miss = newton.polish(block, trial, value[row])
            det = newton.determinant(block, found, value[row])[0]
            leap = np.max(np.abs(found[0, columns] - last))
            if miss[0] <= CLOSED and det * sign > 0 and leap <= _LEAP:
                break
        else:
            trial = state[row].copy()
            trial[:, columns] = last
            candidates = solutions(block, state[row], value[row])[0]
            if len(candidates):
                dets = newton.determinant(block, candidates, np.repeat(value[row], len(candidates)))
                candidates = candidates[(dets * sign > 0) | (np.abs(dets) <= FLAT)]
            if not len(candidates):
                trend = np.zeros(len(columns))
                continue
            found = candidates[np.argmin(newton.difference(block, candidates, trial))][None, :]
            turning = block.free_angles
            found[:, turning] -= whole_turns(found[:, turning] - trial[:, turning])
        trend = found[0, columns] - last if rows.exists[i - 1] else np.zeros(len(columns))
        last = found[0, columns]
        rows.state[row], rows.exists[row] = found, True
    return rows

"""Which assembly a sweep starts from: the one nearest to the sketch."""

from __future__ import annotations

import numpy as np

from . import branches, newton
from .geometry import Array
from .sketch import Sketched
from .system import Block, System

_BEAM = 16
_TOGETHER = 32
_FLAT = 1e-6
_ASIDE = 1e-3
_OPEN = 1e6


def start_row(sketched: Sketched, block: Block, state: Array, value: Array) -> tuple[int | None, Array]:
    """The row whose assembly the sketch shows, and all the block's solutions there (s, columns); None without any.

    That is the first row in which the block closes; rough poses show the row whose driver value they have.
    """
    row = int(np.argmin(sketched.away(value)))
    candidates = branches.solutions(block, state[row : row + 1], value[row : row + 1])[0]
    if sketched.started and block.geared:
        candidates = _with_rough(sketched, block, state[row : row + 1], value[row : row + 1], candidates)
    if len(candidates):
        return row, candidates
    rows = np.arange(len(state))
    if not block.large:
        # Both branches exist in the same rows, so either finds them.
        rows = np.flatnonzero(branches.sweep(block, state, value, 1.0).exists)
    rows = rows[np.argsort(sketched.away(value[rows]), kind="stable")]
    for first in range(0, len(rows), _TOGETHER):
        part = rows[first : first + _TOGETHER]
        for row, candidates in zip(part, branches.solutions(block, state[part], value[part]), strict=True):
            if len(candidates):
                return int(row), candidates
    return None, candidates


def _with_rough(sketched: Sketched, block: Block, state: Array, value: Array, candidates: Array) -> Array:
    """The solutions, and before them the one that the rough poses lead to, in its own turns."""
    guess = state.copy()
    columns = list(block.columns)
    guess[:, columns] = sketched.rough(state)[:, columns]
    found, miss = newton.polish(block, newton.placed(block, guess, value), value)
    if miss[0] > newton.CLOSED:
        return candidates
    others = [each[None, :] for each in candidates if not newton.same_position(block, each[None, :], found)[0]]
    return np.concatenate([found, *others])


def branch(
    built: System, sketched: Sketched, index: int, first: int, candidates: Array, state: Array, value: Array
) -> float:
    """Sign of the branch that holds, in row `first`, the candidate nearest to the sketch.

    At a dead centre, where both branches meet, the sketch itself tells them apart, or the next row that exists does.
    """
    block = built.blocks[index]
    chosen = choose(built, sketched, index, candidates, value[first])
    det = newton.determinant(block, chosen, value[first : first + 1])[0]
    if abs(det) > _FLAT:
        return float(np.sign(det))
    side = _side(built, sketched, index, chosen, value[first : first + 1])
    if side:
        return side
    for i in (*range(first + 1, len(state)), *reversed(range(first))):
        candidates = branches.solutions(block, state[i : i + 1], value[i : i + 1])[0]
        if len(candidates):
            chosen = choose(built, sketched, index, candidates, value[i])
            det = newton.determinant(block, chosen, value[i : i + 1])[0]
            if abs(det) > _FLAT:
                return float(np.sign(det))
    return 1.0


def _side(built: System, sketched: Sketched, index: int, centre: Array, value: Array) -> float:
    """Sign of the branch on that side of a dead centre (1, columns) on which the sketch lies; 0 when it says nothing."""
    block = built.blocks[index]
    _, change = newton.weakest(block, centre, value)
    sides = np.repeat(centre, 2, axis=0)
    sides[:, list(block.columns)] += _ASIDE * np.array([[1.0], [-1.0]]) * change
    costs = sketched.cost(index, sides)
    if not abs(costs[0] - costs[1]) > _ASIDE * 1e-6:
        return 0.0
    nearer = sides[np.argmin(costs)][None, :]
    return float(np.sign(newton.determinant(block, nearer, value)[0]))


def choose(built: System, sketched: Sketched, index: int, candidates: Array, value: float) -> Array:
    """The candidate (1, columns) nearest to the sketch; of equals the one of positive determinant.

    The sketch may say something about this block, and about those that stand on it: of these the best assemblies count.
    """
    if len(candidates) == 1:
        return candidates
    block = built.blocks[index]
    last = max((wish.block for wish in sketched.entries), default=-1)
    costs = sketched.cost(index, candidates)
    if last > index:
        further = [
            _further(built, sketched, candidates[i : i + 1], value, index + 1, last + 1) for i in range(len(candidates))
        ]
        depths = np.array([depth for depth, _ in further])
        if not sketched.about(index):
            costs = np.array([cost for _, cost in further]) + _OPEN * (last + 1 - depths)
        elif depths.min() == depths.max():
            costs = costs + np.array([cost for _, cost in further])
    dets = newton.determinant(block, candidates, np.full(len(candidates), value))
    nearest = np.flatnonzero(costs <= np.min(costs) * (1 + 1e-9) + 1e-20)
    best = nearest[np.argmax(dets[nearest])]
    return candidates[best : best + 1]


def _further(built: System, sketched: Sketched, state: Array, value: float, index: int, stop: int) -> tuple[int, float]:
    """(the block up to which blocks from `index` to before `stop` close, how far the best assembly is from the sketch)."""
    depth, states = assembled(built, state, value, index, stop, sketched, _BEAM)
    cost = np.zeros(len(states))
    for i in range(index, depth):
        cost += sketched.cost(i, states)
    return depth, float(np.min(cost))


def assembled(
    built: System, state: Array, value: float, index: int, stop: int, sketched: Sketched | None, width: int
) -> tuple[int, Array]:
    """The block up to which blocks from `index` to before `stop` close, and the assemblies (m, columns) up to there.

    Where there are more than `width`, the nearest to the sketch.
    """
    states, cost = state, np.zeros(len(state))
    for i in range(index, stop):
        grown = branches.solutions(built.blocks[i], states, np.full(len(states), value))
        if not any(len(part) for part in grown):
            return i, states
        cost = np.repeat(cost, [len(part) for part in grown])
        states = np.concatenate(grown)
        if sketched is not None:
            cost = cost + sketched.cost(i, states)
        keep = np.argsort(cost, kind="stable")[:width]
        states, cost = states[keep], cost[keep]
    return stop, states

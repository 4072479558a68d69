"""The same positions with slightly other dimensions: Newton's method from each position that is known."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from . import geometry
from .newton import polish
from .poses import unsolved
from .solution import Solution, solution_of
from .system import system

CLOSED = 1e-11
"""Largest miss of a position that exists, in the system's own lengths."""


def nearby(solution: Solution, dimensions: Mapping[str, float]) -> Solution:
    """The positions of a solution at the same values of the driver, with some dimensions a little different.

    dimensions  values by symbol, in internal units; the others are those of `solution`

    A row that cannot be closed near where it was does not exist. Beside a dead centre another assembly may be nearer.
    """
    old = solution.system
    built = system(solution.mechanism, geometry.dimension_values(solution.mechanism, {**_own(solution), **dimensions}))
    value = solution.driver / built.scale if solution.mechanism.driver.joint else solution.driver
    state = solution.state.copy()
    places = slice(3, built.columns - built.given)
    for axis in (0, 1):
        own = state[:, places][:, axis::3]
        own[:] = (own * old.scale + old.origin[axis] - built.origin[axis]) / built.scale
    given = list(built.prescribed)
    state[:, given] = unsolved(built, value, np.arange(float(len(value))))[:, given]
    alive = solution.exists & built.finite
    for block in built.blocks:
        rows = np.flatnonzero(alive)
        if len(rows):
            state[rows], miss = polish(block, state[rows], value[rows])
            alive[rows] = miss < CLOSED
    return solution_of(built, solution.driver, value, state, state, alive, np.zeros_like(alive))


def _own(solution: Solution) -> dict[str, float]:
    """The values of the dimensions that are given."""
    return {dim.symbol: solution.dimensions[dim.symbol] for dim in solution.mechanism.dimensions if not dim.derived}

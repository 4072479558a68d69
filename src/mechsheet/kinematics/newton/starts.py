"""All assemblies of a group in one position, found by Newton's method from starts spread over all that can be."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mechsheet.kinematics.equations import System
from mechsheet.kinematics.newton.system import SETTLED, refined, step_of
from mechsheet.kinematics.numeric import Array

STARTS = {1: 400, 2: 30, 3: 12, 4: 7}
"""Starts along each unknown, by the number of unknowns."""

DENSER = 2.5
LONGEST_STEP = 0.6
"""Radians, or parts of the size."""

TURNS = 2
"""With gears so many times the starts, over as many turns."""

BOUNDED = 30
ALIKE = 1e-6
REACH = 2.5
"""Displacements are sought up to so many times the largest length."""


MOST_FOUND = 100
"""More assemblies than this are none: the group moves, and every start leads to another position of its motion."""


def assemblies_in(system: System, known: Mapping[str, Any], turning: Sequence[bool], size: float) -> list[Array]:
    """Every solution in one position, each once, angles within half a turn of 0, in the order of their first unknown.

    known    values of what the system reads, in that position
    turning  which unknowns are angles

    Of an angle-only group the determinants' signs add up to 0 (it can be deformed into one without assemblies): where they
    do not, some assembly was missed and more starts are tried. With gears an angle says in which of its turns it is: those
    up to a whole turn from 0 are looked through, and of what looks alike the one with the smallest angles is taken.
    More than `MOST_FOUND` are not looked for.
    """
    count = STARTS[len(system.unknowns)]
    found = _from(system, known, turning, size, count if system.periodic else round(count * TURNS))
    if len(found) <= MOST_FOUND and all(turning) and system.periodic and abs(sum(sign for _, sign in found)) > 0.5:
        found = _from(system, known, turning, size, round(count * DENSER))
    return [state for state, _ in sorted(found, key=lambda each: tuple(each[0]))]


def _from(
    system: System, known: Mapping[str, Any], turning: Sequence[bool], size: float, count: int
) -> list[tuple[Array, float]]:
    """(state, sign of the determinant) of each solution that a grid of starts leads to."""
    axes = []
    for place, turns in enumerate(turning):
        steps = (np.arange(count) + 0.5 + 0.013 * place) / count
        turn = math.tau * (1 if system.periodic else TURNS)
        axes.append(turn * (steps - 0.5) if turns else size * REACH * (2 * steps - 1))
    grid = [part.ravel() for part in np.meshgrid(*axes, indexing="ij")]
    unknowns = grid
    step = step_of(system, known)
    with np.errstate(all="ignore"):
        for _ in range(BOUNDED):
            following = step(unknowns).unknowns
            unknowns = [
                old + np.clip(np.nan_to_num(new - old), -longest, longest)
                for old, new, longest in zip(
                    unknowns, following, (LONGEST_STEP * (1.0 if turns else size) for turns in turning), strict=True
                )
            ]
        unknowns, residual, determinant = refined(system, known, unknowns, 4)
        there = np.flatnonzero(residual <= SETTLED)
    found: list[tuple[Array, float]] = []
    states = np.array(unknowns)[:, there].T
    angles = np.array(turning)
    scale = np.where(angles, 1.0, size)
    signs = np.sign(determinant[there])
    if system.periodic:
        states[:, angles] -= math.tau * np.round(states[:, angles] / math.tau)
    else:
        inside = np.flatnonzero(np.all(np.abs(states[:, angles]) <= math.pi * TURNS, axis=1))
        nearest = inside[np.argsort(np.abs(states[inside][:, angles]).max(axis=1).round(6), kind="stable")]
        states, signs = states[nearest], signs[nearest]
    for state, sign in zip(states, signs, strict=True):
        if not found or np.min(_apart(state, np.array([other for other, _ in found]), angles, scale)) >= ALIKE:
            found.append((state, float(sign)))
            if len(found) > MOST_FOUND:
                break
    return found


def _apart(one: Array, others: Array, angles: Array, scale: Array) -> Array:
    gap = one - others
    gap = np.where(angles, gap - math.tau * np.round(gap / math.tau), gap)
    return np.asarray(np.max(np.abs(gap) / scale, axis=1))

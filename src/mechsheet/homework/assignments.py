"""Which of a sheet's numbers may be which dimension of a mechanism: all ways at once, by the equations in numpy."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import TypeAlias

import numpy as np

from livesheet.formula.nodes import Root
from mechsheet.homework.agreement import DEGREE, FEWEST, wrapped
from mechsheet.homework.expected_values import Array, Truth
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import evaluate_equation
from mechsheet.model import Dimension, Mechanism

MOST_CELLS = 9
"""Numbers that are tried for dimensions; with more of them some have to be called by name."""
MOST_ROWS = 400_000
"""Positions computed for one mechanism."""
SAMPLE = 5
"""Rows of the sheet that are looked at."""
KEPT = 6
"""Ways that are looked at closely."""


Assignment: TypeAlias = dict[str, int | None]
"""Dimension -> the index of its number; None for a dimension taken as 0."""


def ways(dimensions: Sequence[Dimension], numbers: Sequence[float]) -> Iterator[tuple[int | None, ...]]:
    """Every way to give each dimension a number of its own; one length at most may be 0 without a cell."""
    places = range(len(numbers))
    yield from itertools.permutations(places, len(dimensions))
    for zero, dim in enumerate(dimensions):
        if dim.unit.kind == "length":
            for rest in itertools.permutations(places, len(dimensions) - 1):
                yield (*rest[:zero], None, *rest[zero:])


def likely_assignments(
    mechanism: Mechanism,
    equations: Equations,
    dimensions: Sequence[Dimension],
    numbers: Sequence[float],
    driver: Array,
    columns: Array,
) -> list[Assignment]:
    """The ways with which some column, shape (columns, rows), is what a driven link does, the best first.

    numbers  what stands in the cells;  driver  its values in internal units
    """
    rows = _rows(columns)
    if rows is None or len(numbers) > MOST_CELLS or any(isinstance(e.expression, Root) for e in equations.columns):
        return []
    tried = list(ways(dimensions, numbers))
    modes = [group.mode for group in equations.groups if group.mode]
    signs = list(itertools.product((1.0, -1.0), repeat=len(modes)))
    if not tried or len(tried) * len(signs) * len(rows) > MOST_ROWS:
        return []
    values = np.array([[0.0 if n is None else numbers[n] for n in way] for way in tried])
    for column, dim in enumerate(dimensions):
        if dim.unit.kind == "angle":
            values[:, column] *= np.where(np.abs(values[:, column]) > 2 * np.pi, DEGREE, 1.0)
    size = float(np.abs(values).max(initial=0.0))
    best = np.zeros(len(tried), int)
    for signed in signs:
        known = dict(zip((dim.symbol for dim in dimensions), values.T, strict=True))
        known |= {mode: np.full(len(tried), sign) for mode, sign in zip(modes, signed, strict=True)}
        found = _computed(mechanism, equations, known, driver[rows])
        best = np.maximum(best, _matches(mechanism, found, columns[:, rows], 1e-4 * size))
    order = [int(n) for n in np.argsort(-best, kind="stable")[:KEPT] if best[n]]
    return [dict(zip((dim.symbol for dim in dimensions), tried[n], strict=True)) for n in order]


def modes_of(truth: Truth, equations: Equations) -> dict[str, int]:
    """The assembly modes of the equations with which the links stand as they do in a truth."""
    modes = [group.mode for group in equations.groups if group.mode]
    row = np.flatnonzero(truth.exists)[:SAMPLE]
    given = {dim.symbol: np.array([truth.dimensions[dim.symbol]]) for dim in truth.mechanism.dimensions if not dim.path}
    angles = [link.angle_symbol for link in truth.mechanism.links[1:] if link.angle_symbol in truth.columns]
    best: tuple[float, dict[str, int]] = (math.inf, {})
    for signs in itertools.product((1, -1), repeat=len(modes)):
        chosen = dict(zip(modes, signs, strict=True))
        known = given | {mode: np.array([float(sign)]) for mode, sign in chosen.items()}
        found = _computed(truth.mechanism, equations, known, truth.driver[row])
        apart = [np.abs(wrapped(found[angle][0] - truth.columns[angle][row])) for angle in angles if angle in found]
        worst = float(np.nan_to_num(np.array(apart), nan=math.inf).max(initial=0.0))
        if worst < best[0]:
            best = worst, chosen
    return best[1]


def _rows(columns: Array) -> Array | None:
    """A few rows in which most columns have numbers."""
    full = np.flatnonzero(np.isfinite(columns).mean(axis=0) >= 0.5)
    if len(columns) == 0 or len(full) < FEWEST:
        return None
    found: Array = np.unique(full[np.linspace(0, len(full) - 1, SAMPLE).astype(int)])
    return found


def _computed(
    mechanism: Mechanism, equations: Equations, given: Mapping[str, Array], driver: Array
) -> dict[str, Array]:
    """Every symbol for every way and row, shape (ways, rows); what else there is of dimensions is as described."""
    count, rows = len(next(iter(given.values()))), len(driver)
    known: dict[str, Array] = {mechanism.driver.symbol: np.tile(driver, count)}
    for dim in mechanism.dimensions:
        if not dim.derived and isinstance(dim.value, float):
            known[dim.symbol] = np.full(count * rows, dim.value)
    known |= {symbol: np.repeat(column, rows) for symbol, column in given.items()}
    for equation in (*equations.constants, *equations.columns):
        if equation.symbol not in known:
            try:
                known[equation.symbol] = evaluate_equation(equation, known, count * rows)
            except KeyError:
                known[equation.symbol] = np.full(count * rows, np.nan)
    return {symbol: np.reshape(column, (count, rows)) for symbol, column in known.items()}


def _matches(mechanism: Mechanism, found: Mapping[str, Array], columns: Array, allowed: float) -> Array:
    """For every way how many columns are what a link that is not driven does: its angle, displacement, points."""
    driven = {mechanism.ground.name, mechanism.driver.link}
    near = {point for link in mechanism.links if link.name in driven for point in link.points}
    angles = [link.angle_symbol for link in mechanism.links if link.name not in driven]
    lengths = [joint.symbol for joint in mechanism.joints if joint.symbol != mechanism.driver.symbol]
    lengths += [symbol for symbol in found if symbol.endswith((".x", ".y")) and symbol[:-2] not in near]
    count = len(next(iter(found.values())))
    seen = np.zeros((count, len(columns)), bool)
    for symbol in (*angles, *lengths):
        if symbol not in found:
            continue
        turning = symbol in angles
        for unit in (1.0, DEGREE) if turning else (1.0,):
            for sense in (1, -1):
                apart = sense * unit * columns[None] - found[symbol][:, None]
                if turning:
                    apart = wrapped(apart - apart[..., :1])
                with np.errstate(invalid="ignore"):
                    seen |= np.abs(apart).max(axis=-1) <= (1e-4 if turning else allowed)
    total: Array = seen.sum(axis=1)
    return total

"""Poses of all links over the driver's sweep, by Newton's method, straight from the model."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ..model import Mechanism
from . import assembly, branches, further_drivers, geometry
from .assembly import Pose, Sketched
from .branches import Mask, Rows
from .geometry import Array, whole_turns
from .newton import polish
from .solution import Solution, poses_of, solution_of
from .system import System, residual, system

_INSERTED_TURN = np.radians(1.0)
_INSERTED_SLIDE = 0.01


def solve(
    mechanism: Mechanism,
    dimensions: Mapping[str, float] | None = None,
    start: Mapping[str, Pose] | None = None,
    values: Array | None = None,
) -> Solution:
    """Positions over the whole sweep.

    dimensions  replaces dimension values by symbol (internal units)
    start       rough poses (x, y, theta) by link in one row, which their driver value tells; without them each loop takes
                the assembly nearest to the mechanism's own sketch, in the first row in which it closes
    values      driver values in place of the mechanism's

    Raises MechanismError when conditions and unknowns do not match, or a name is not known.
    """
    numbers = geometry.dimension_values(mechanism, dimensions)
    driver = geometry.driver_values(mechanism, numbers) if values is None else np.array(values, dtype=float)
    built = system(mechanism, numbers)
    sketched = Sketched(built, start)
    scaled = driver / built.scale if mechanism.driver.joint else driver
    if sketched.at is not None:  # a row of its own before the others: it need not be one of them
        scaled = np.concatenate([[sketched.at], scaled])
    path, asked = _with_steps_between(built, scaled)
    before = len(scaled) - len(driver)
    rows_of_path = np.maximum(np.interp(np.arange(len(path)), asked, np.arange(len(asked))) - before, 0.0)
    asked = asked[before:]
    state = unsolved(built, path, rows_of_path)
    alive = np.isfinite(path) & built.finite
    undetermined = np.zeros(len(path), dtype=bool)
    for i in range(len(built.blocks)):
        rows = np.flatnonzero(alive)
        if len(rows):
            found = _over_rows(built, sketched, i, state[rows], path[rows])
            state[rows] = found.state
            undetermined[rows] = found.undetermined
            alive[rows] = found.exists
            state[np.ix_(rows[~found.exists], np.array(built.blocks[i].columns))] = np.nan
            _count_turns(built, sketched, i, state, path, rows[found.exists])
    state, alive, undetermined, path = state[asked], alive[asked], undetermined[asked], path[asked]
    reached = state.copy()
    state[~alive] = np.nan
    _continuous(built, sketched, state, path, alive)
    reached[alive] = state[alive]
    return solution_of(built, driver, path, state, reached, alive, undetermined)


def unsolved(built: System, value: Array, rows: Array | None = None) -> Array:
    """States (m, columns) at driver values as the system has them: what is given, NaN else."""
    state = np.full((len(value), built.columns), np.nan)
    state[:, :3] = 0.0
    state[:, 3 * len(built.bodies) + 2 : built.columns - built.given : 3] = 0.0
    scale = built.scale if built.mechanism.driver.joint else 1.0
    state[:, list(built.prescribed)] = further_drivers.columns(built, value * scale, rows)
    return state


def _count_turns(
    built: System, sketched: Sketched, index: int, state: Array, value: Array, rows: NDArray[np.int_]
) -> None:
    """Angles of a block that a gear reads, without jumps and from the right turn on, in place: half a turn of it counts.

    The first is within half a turn of zero, or of the rough poses where they are.
    """
    block = built.blocks[index]
    columns = [column for column in block.free_angles if column in built.read_by_ties]
    if block.linear or not columns or not len(rows):
        return
    first = 1 if sketched.at is not None else 0
    own = rows[rows >= first] if len(rows[rows >= first]) else rows
    place = int(np.argmin(sketched.away(value[own]))) if sketched.started else 0
    for turning in columns:
        angle = np.unwrap(state[own, turning])
        target = (sketched.turn(turning) or 0.0) if sketched.started else 0.0
        state[own, turning] = angle - whole_turns(angle[place] - target)


def _with_steps_between(built: System, driver: Array) -> tuple[Array, NDArray[np.int_]]:
    """Driver values to solve, and which of them were asked for.

    A block with several loops has several solutions of one sign: to follow the right one, steps must be small.
    """
    if not any(block.large for block in built.blocks) or len(driver) < 2:
        return driver, np.arange(len(driver))
    longest = _INSERTED_SLIDE if built.mechanism.driver.joint else _INSERTED_TURN
    steps = np.nan_to_num(np.abs(np.diff(driver)), nan=0.0, posinf=0.0)
    parts = np.maximum(np.ceil(steps / longest - 1e-9), 1).astype(int)
    pieces = [a + (b - a) * np.arange(n) / n for a, b, n in zip(driver[:-1], driver[1:], parts, strict=True)]
    return np.concatenate([*pieces, driver[-1:]]), np.concatenate([[0], np.cumsum(parts)])


def _over_rows(built: System, sketched: Sketched, index: int, state: Array, value: Array) -> Rows:
    """One block over the rows in which all that it needs exists."""
    block = built.blocks[index]
    if block.linear:
        return branches.linear(block, state, value)
    first, candidates = assembly.start_row(sketched, block, state, value)
    if not block.large:
        sign = 1.0 if first is None else assembly.branch(built, sketched, index, first, candidates, state, value)
        return branches.sweep(block, state, value, sign)
    if first is None:
        none = np.zeros(len(state), dtype=bool)
        return Rows(state, none, none)
    chosen = assembly.choose(built, sketched, index, candidates, value[first])
    after = branches.follow(block, state[first:], value[first:], chosen)
    before = branches.follow(block, state[first::-1], value[first::-1], chosen)
    return Rows(
        np.concatenate([before.state[:0:-1], after.state]),
        np.concatenate([before.exists[:0:-1], after.exists]),
        np.concatenate([before.undetermined[:0:-1], after.undetermined]),
    )


def assemblies(
    mechanism: Mechanism, dimensions: Mapping[str, float] | None, value: float
) -> list[dict[str, tuple[float, float, float]]]:
    """All assemblies that are found at one driver value: poses (x, y, theta) of every link by name.

    Angles that loops decide are within half a turn of zero.
    """
    built = system(mechanism, geometry.dimension_values(mechanism, dimensions))
    if not built.finite:
        return []
    scaled = value / built.scale if mechanism.driver.joint else value
    state = np.nan_to_num(unsolved(built, np.array([scaled])))
    depth, states = assembly.assembled(built, state, scaled, 0, len(built.blocks), None, 4096)
    if depth < len(built.blocks):
        return []
    return [
        {name: (float(x), float(y), float(theta)) for name, (x, y, theta) in zip(built.bodies, poses, strict=True)}
        for poses in np.stack([poses_of(built, states)[name] for name in built.bodies], axis=1)
    ]


def _continuous(built: System, sketched: Sketched, state: Array, value: Array, alive: Mask) -> None:
    """Angles without jumps of a turn over the rows that exist, in place.

    The first is within half a turn of zero or of what the sketch says. Angles tied to others keep their exact tie.
    """
    rows = np.flatnonzero(alive)
    if not len(rows):
        return
    for block in built.blocks:
        if block.linear:
            if block.angles:
                state[rows] = branches.linear(block, state[rows], value[rows]).state
            continue
        for i in block.angles:
            column_index = block.columns[i]
            if column_index in built.read_by_ties or i in block.geared:
                continue
            angle = np.unwrap(state[rows, column_index])
            target = sketched.turn(column_index) or 0.0
            state[rows, column_index] = angle - whole_turns(angle[0] - target)
        for equation in block.equations:
            if equation.kind == "angle":
                theta = 3 * equation.body + 2 if 3 * equation.body + 2 in block.columns else 3 * equation.on + 2
                side = 1.0 if theta == 3 * equation.body + 2 else -1.0
                miss, _ = residual(equation, state[rows], value[rows])
                state[rows, theta] -= side * whole_turns(miss)


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

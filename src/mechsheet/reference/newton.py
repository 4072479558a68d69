"""Newton's method on one block, for many positions at once.

All functions take the state (m, columns) whose other columns are known, and the driver's value (m,); they return new
arrays. Numbers are those of `system`: lengths of the order of one, so tolerances are absolute.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .geometry import Array, whole_turns
from .system import Block, linearised

CLOSED = 1e-12
"""Largest miss of a position that exists: rounding, and the miss of links that meet exactly at a dead centre."""

_SLACK = 1e-6
_PATIENCE = 30
_MARQUARDT_STEPS = 60


def directions(jacobian: Array, right: Array) -> Array:
    """Solution (m, k) of jacobian (m, k, k) @ d = right (m, k); the shortest of the best where it is singular."""
    try:
        return np.asarray(np.linalg.solve(jacobian, right[..., None])[..., 0])
    except np.linalg.LinAlgError:
        return np.asarray((np.linalg.pinv(jacobian, rcond=1e-14) @ right[..., None])[..., 0])


def miss(block: Block, state: Array, residuals: Array) -> Array:
    """Worst residual (m,), as a part of the farthest coordinate where that is beyond 1: its rounding grows with it."""
    farthest = np.max(np.abs(state[:, list(block.coordinates)]), axis=1, initial=1.0)
    return np.asarray(np.max(np.abs(residuals), axis=1) / farthest)


def polish(block: Block, state: Array, value: Array) -> tuple[Array, Array]:
    """Newton steps as long as they at least halve the miss: state, miss (m,)."""
    columns = list(block.columns)
    best = state.copy()
    least = np.full(len(state), np.inf)
    rows = np.arange(len(state))
    current = state.copy()
    for _ in range(_PATIENCE):
        residuals, jacobian = linearised(block, current, value[rows])
        now = miss(block, current, residuals)
        better = now < least[rows]
        going = (now < 0.5 * least[rows]) & (now > 0)
        best[rows[better]] = current[better]
        least[rows[better]] = now[better]
        if not going.any():
            break
        rows, current = rows[going], current[going]
        residuals = residuals[going]
        current[:, columns] += _bounded(block, directions(jacobian[going], -residuals), residuals)
    return best, least


def _bounded(block: Block, step: Array, residuals: Array) -> Array:
    """A step (m, k) in which no angle changes by more than a radian, and no place by much more than what is missing.

    Each unknown by itself: a short link may ask for thousands of turns, and must not hold up the long ones.
    """
    missing = np.max(np.abs(residuals), axis=1, keepdims=True)
    longest = np.where([column % 3 == 2 for column in block.columns], 1.0, np.maximum(4 * missing, 1.0))
    return np.clip(step, -longest, longest)


def descend(block: Block, state: Array, value: Array) -> Array:
    """Levenberg and Marquardt's method: state where the sum of squared residuals is locally least (roughly).

    It gets to a position from afar, and where there is none, to the nearest miss.
    """
    columns = list(block.columns)
    result = state.copy()
    rows = np.arange(len(state))
    damping = np.full(len(state), 1e-2)
    residuals, jacobian = linearised(block, result, value)
    cost = np.sum(residuals**2, axis=1)
    stalled = np.zeros(len(state), dtype=int)
    for _ in range(_MARQUARDT_STEPS):
        transposed = jacobian.transpose(0, 2, 1)
        normal = transposed @ jacobian
        diagonal = np.einsum("mii->mi", normal)
        diagonal += damping[:, None] * (diagonal + 1e-9)
        trial = result[rows]
        step = directions(normal, -(transposed @ residuals[..., None])[..., 0])
        trial[:, columns] += _bounded(block, step, residuals)
        new_residuals, new_jacobian = linearised(block, trial, value[rows])
        new_cost = np.sum(new_residuals**2, axis=1)
        taken = new_cost < cost
        stalled = np.where(taken & (new_cost < 0.9 * cost), 0, stalled + 1)
        result[rows[taken]] = trial[taken]
        residuals[taken], jacobian[taken] = new_residuals[taken], new_jacobian[taken]
        cost = np.where(taken, new_cost, cost)
        damping = np.where(taken, damping * 0.1, damping * 6)
        going = (cost > 1e-14) & (stalled < 6)
        if not going.any():
            break
        rows, damping, cost, stalled = rows[going], damping[going], cost[going], stalled[going]
        residuals, jacobian = residuals[going], jacobian[going]
    return result


def determinant(block: Block, state: Array, value: Array) -> Array:
    """Determinant (m,) of the block's Jacobian, angles times their reach: its sign is the branch, 0 a dead centre."""
    _, jacobian = linearised(block, state, value)
    return np.asarray(np.linalg.det(jacobian / np.array(block.reach)))


def weakest(block: Block, state: Array, value: Array) -> tuple[Array, Array]:
    """Least singular value (m,) of that Jacobian, and the change of the unknowns (m, k) that it resists least."""
    _, jacobian = linearised(block, state, value)
    reach = np.array(block.reach)
    _, singular, right = np.linalg.svd(jacobian / reach)
    change = right[:, -1, :] / reach
    return singular[:, -1], change / np.max(np.abs(change), axis=1, keepdims=True)


def dead_centre(block: Block, state: Array, value: Array) -> tuple[Array, float]:
    """The position nearest to `state` (1, columns) where the determinant vanishes, and its miss.

    Gauss-Newton on residuals and determinant together. There, Newton's method alone would halve its error at each
    step and stop at the root of the rounding error; the determinant crosses zero at full speed and is exact.
    """
    columns = list(block.columns)
    k = len(columns)
    current = state.copy()
    aside = 1e-6
    probes = aside * np.concatenate([np.eye(k), -np.eye(k)])
    best, least = current, np.inf
    for _ in range(12):
        residuals, jacobian = linearised(block, current, value)
        around = np.repeat(current, 2 * k + 1, axis=0)
        around[: 2 * k, columns] += probes
        _, nearby = linearised(block, around, np.repeat(value, 2 * k + 1))
        dets = np.linalg.det(nearby / np.array(block.reach))
        slope = (dets[:k] - dets[k : 2 * k]) / (2 * aside)
        error = float(miss(block, current, residuals)[0]) + abs(float(dets[-1]))
        if error < least:
            best, least = current.copy(), error
        stacked = np.vstack([jacobian[0], slope])
        right = np.append(residuals[0], dets[-1])
        current = current.copy()
        step = np.linalg.lstsq(stacked, right, rcond=1e-13)[0]
        current[:, columns] -= _bounded(block, step[None, :], residuals)
    residuals, _ = linearised(block, best, value)
    return best, float(miss(block, best, residuals)[0])


def movable(block: Block, state: Array, value: Array) -> bool:
    """Whether the unknowns can move while everything known stands still: `state` (1, columns) is one of a continuum.

    It is pushed aside in the weakest direction and brought back in all others; a dead centre does not close there.
    """
    slack, change = weakest(block, state, value)
    if slack[0] > _SLACK:
        return False
    columns = list(block.columns)
    pushed = state.copy()
    pushed[:, columns] += 0.1 * change
    for _ in range(8):
        residuals, jacobian = linearised(block, pushed, value)
        inverse = np.linalg.pinv(jacobian / np.array(block.reach), rcond=_SLACK)
        step = (inverse @ residuals[..., None])[..., 0] / np.array(block.reach)
        pushed[:, columns] -= _bounded(block, step, residuals)
    residuals, _ = linearised(block, pushed, value)
    apart = np.max(np.abs(pushed[0, columns] - state[0, columns]))
    return bool(
        miss(block, pushed, residuals)[0] <= 2 * CLOSED
        and apart > 0.02
        and weakest(block, pushed, value)[0][0] < _SLACK
    )


def starts(block: Block, state: Array, value: Array, count: int) -> tuple[Array, Array]:
    """`count` spread-out guesses for each position: states (m * count, columns) and values, guesses of a position together.

    Angles follow the additive recurrence of the generalised golden ratio: as good as random, and the same always. Where
    gears count turns they are spread over one turn to either side.
    """
    angles = [block.columns[i] for i in block.angles]
    ratio = 1.5
    for _ in range(40):
        ratio = (1 + ratio) ** (1 / (len(angles) + 1))
    powers = ratio ** -np.arange(1.0, len(angles) + 1)
    spread = 2 * np.pi * ((0.5 + np.arange(count)[:, None] * powers) % 1)
    geared = [list(block.angles).index(i) for i in block.geared]
    spread[:, geared] = 2 * spread[:, geared] - 2 * np.pi
    guesses = np.repeat(state, count, axis=0)
    values = np.repeat(value, count)
    guesses[:, angles] = np.tile(spread, (len(state), 1))
    return placed(block, guesses, values), values


def placed(block: Block, guesses: Array, value: Array) -> Array:
    """Guesses (m, columns) made to agree with themselves: angles tied to each other, then the places that suit them best."""
    columns = np.array(block.columns)
    places = np.flatnonzero(columns % 3 != 2)
    tied = [i for i, equation in enumerate(block.equations) if equation.kind == "angle"]
    moved = guesses.copy()
    moved[:, columns[places]] = 0.0
    residuals, jacobian = linearised(block, moved, value)
    if tied:
        moved[:, columns] -= residuals[:, tied] @ np.linalg.pinv(jacobian[0, tied]).T
        residuals, jacobian = linearised(block, moved, value)
    if len(places):
        part = jacobian[:, :, places]
        normal = part.transpose(0, 2, 1) @ part + 1e-9 * np.eye(len(places))
        moved[:, columns[places]] = directions(normal, -(part.transpose(0, 2, 1) @ residuals[..., None])[..., 0])
    return moved


def same_position(block: Block, one: Array, other: Array) -> NDArray[np.bool_]:
    """Whether two states agree in a block's unknowns to 1e-6, angles modulo a turn."""
    return difference(block, one, other) < 1e-6


def difference(block: Block, one: Array, other: Array) -> Array:
    """Largest difference of a block's unknowns between states (…, columns), angles modulo a turn."""
    columns = list(block.columns)
    apart = one[..., columns] - other[..., columns]
    turning = list(block.angles)
    apart[..., turning] -= whole_turns(apart[..., turning])
    return np.asarray(np.max(np.abs(apart), axis=-1))

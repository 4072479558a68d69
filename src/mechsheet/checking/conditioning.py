"""How well outputs are determined where they are steep: at poles, at the edge of a function's range, at a jump.

An output is evaluated again for variables that are off by a hair, one after the other. Where that leaves it as it is, it is
determined, and two judges must agree as they do elsewhere. Where it leaps to another value, to an infinite one or to none,
only rounding decides, and each of these answers is as good as the other.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from mechsheet import reference
from mechsheet.checking.inputs import Array

HAIR = 1e-12
"""How far off, as a part of the size, or in radians: a thousand times what rounding makes."""

FAR = 1e9
"""So many times the unit (or the size, of a length) is a pole, when a hair away from it."""

JUMP = 1e-3
"""So many times the unit (or the size) within two hairs is a jump, as of a direction where there is none."""

REACH = 4.0
"""At the edge of a function's range, as of a root, the value itself is so many times as far away as those a hair and two
hairs inside are apart, at most."""


def excused(
    solution: reference.Solution, found: Mapping[str, Array], symbol: str, ours: Array, scale: float
) -> NDArray[np.bool_]:
    """Rows in which the value `ours` (NaN: an error) of an output is one of those that rounding may give.

    found  the reference's variables and outputs;  scale  what a difference of this output is compared with
    """
    near = _near(solution, found, symbol)
    far = FAR * scale
    with np.errstate(all="ignore"):
        tame = np.where(np.abs(near) < far, near, np.nan)  # neither a pole nor without a value
        low, high = np.fmin.reduce(tame), np.fmax.reduce(tame)
        room = REACH * (high - low)
        within = (ours >= low - room) & (ours <= high + room)
        pole = (np.abs(near) >= far).any(axis=0)
        nothing = pole | ~np.isfinite(near).all(axis=0) | (high - low > JUMP * scale)
        return np.asarray(np.where(np.isnan(ours), nothing, within | (pole & (np.abs(ours) >= far))), dtype=bool)


def _near(solution: reference.Solution, found: Mapping[str, Array], symbol: str) -> Array:
    """(k, n) values of an output: the reference's own, and with each variable off by one and two hairs either way.

    Rows that do not exist have NaN, which is within nothing.
    """
    mechanism = solution.mechanism
    own = {output.symbol for output in mechanism.outputs}
    angles = {link.angle_symbol for link in mechanism.links}
    if not mechanism.driver.joint:
        angles.add(mechanism.driver.symbol)
    positions = {name: column for name, column in found.items() if name not in own}
    values = [found[symbol]]
    for name, column in positions.items():
        hair = HAIR * (1.0 if name in angles else solution.size)
        for off in (-2 * hair, -hair, hair, 2 * hair):
            values.append(reference.outputs(solution, positions | {name: column + off})[symbol])
    return np.where(solution.exists, np.stack(values), np.nan)

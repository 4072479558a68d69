"""A linkage's columns of positions against the reference, row by row, as far as the assembly that is meant reaches.

Behind a limit position any assembly may be found, and none of them is meant: there it is held only that a position that is
shown closes. Where the two part, the reference is asked once more in small steps whether the assembly ends there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from leaping import leaps

from mechsheet import reference
from mechsheet.description import loads
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.doubts.sketched import doubts
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Mechanism

ALIKE = 1e-6
"""Radians or parts of the size: nearer than this two positions are one, if perhaps badly rounded."""

FINE = 64
"""Steps between two rows, to see whether an assembly ends between them."""


@dataclass(frozen=True)
class Compared:
    """What became of the rows.

    rows      so many have the same position here and there, around the one at which Newton's method begins
    worst     the largest difference there;  gap: of closure in all rows that are shown, those behind a limit, too
    ends      how many of the ends of that stretch are limit positions;  told: rows lost, and told to be
    amiss     what nothing explains, in words
    """

    rows: int
    worst: float
    gap: float
    ends: int
    told: int
    amiss: tuple[str, ...]


def compared(text: str) -> Compared:
    """Equations against the reference. Raises MechanismError for what is no mechanism."""
    mechanism = loads(text, "drawn.toml")
    equations = solve(mechanism)
    driver = driver_values(mechanism, dimension_values(mechanism))
    values = sweep(mechanism, equations, driver)
    there = equations.closed(values)
    home = next(group.system.row for group in equations.groups if group.system is not None)
    gaps = np.flatnonzero(~there)
    first, last = gaps[gaps < home].max(initial=-1) + 1, gaps[gaps > home].min(initial=len(driver)) - 1
    poses = {name: tuple(float(np.round(part[home], 9)) for part in pose)
             for name, pose in _poses(mechanism, values, equations).items()}  # fmt: skip
    alike, worst = [home], 0.0
    ends = told = 0
    amiss = []
    for step, limit in ((1, last), (-1, first)):
        rows = np.arange(home, limit + step, step)
        theirs = reference.solve(mechanism, start=poses, values=driver[rows])
        gap = _gaps(mechanism, {name: column[rows] for name, column in values.items()}, theirs)
        same = np.nan_to_num(gap, nan=1.0) < ALIKE
        count = len(rows) if same.all() else int(np.argmin(same))
        alike += rows[1:count].tolist()
        worst = max(worst, float(np.max(gap[:count], initial=0.0)))
        following = home + step * count
        if 0 <= following < len(driver):
            last_alike = driver[following - step]
            path = np.linspace(last_alike, driver[following], FINE + 1)
            start = {name: tuple(float(part[count - 1]) for part in pose.T) for name, pose in theirs.poses.items()}
            finer = reference.solve(mechanism, start=start, values=path)
            if not finer.exists.all() or leaps(finer).any():
                ends += 1
            elif not there[following] and doubts(mechanism, equations):
                told += 1
            else:
                amiss.append(f"row {following}: {'lost' if not there[following] else 'elsewhere'}")
    closure, _ = reference.worst(reference.residuals(mechanism, theirs.dimensions, values))
    size = theirs.size
    return Compared(len(alike), worst, float(np.max(closure[there], initial=0.0)) / size, ends, told, tuple(amiss))


def _poses(mechanism: Mechanism, values, equations):
    """x, y and angle of each moving link's frame, a column each."""
    from mechsheet.kinematics.numeric import value

    return {
        link.name: (
            np.broadcast_to(value(equations.poses[link.name].x, values), values[link.angle_symbol].shape),
            np.broadcast_to(value(equations.poses[link.name].y, values), values[link.angle_symbol].shape),
            values[link.angle_symbol],
        )
        for link in mechanism.links[1:]
    }


def _gaps(mechanism: Mechanism, values, solution) -> np.ndarray:
    """How far the farthest variable is off in each row [radians, or parts of the size]; NaN where there is no position."""
    angles = {link.angle_symbol for link in mechanism.links}
    found = []
    for name, column in reference.variables(solution).items():
        if name in values:
            gap = values[name] - column
            found.append(np.abs(gap - math.tau * np.round(gap / math.tau) if name in angles else gap / solution.size))
    return np.max(found, axis=0)

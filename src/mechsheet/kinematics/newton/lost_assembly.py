"""Whether Newton's method, led with the dimensions from the described ones to others, has kept its assembly.

The steps are equal, so the determinant keeps its sign, each unknown its trend and the residual its size as long as the
assembly goes on; where it ends Newton's method is thrown far, to another assembly or to none.
Source: E. L. Allgower, K. Georg, Introduction to Numerical Continuation Methods (steps, and how to tell a leap).
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np

from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.equations import Equations, System
from mechsheet.kinematics.lengths import largest_length
from mechsheet.kinematics.newton.system import CLOSED, FIRST_PASSES, LED, SETTLED, moved, scalar_step, way_to
from mechsheet.model import Mechanism

TREND = 0.4
"""Radians, or parts of the size, by which an unknown may leave its trend from one step to the next."""

STEADY = 6
"""So many times the residual that the first step leaves for its pass to mend may any other leave."""


LEAP = 45.0
"""An unknown that leaves its trend by more [deg] from one row to the next may have leapt to another assembly."""


def scales(mechanism: Mechanism, equations: Equations, system: System) -> tuple[float, ...]:
    """In what each unknown of a group is measured: 1 for an angle, else the largest length."""
    size = largest_length(mechanism, dimension_values(mechanism)) or 1.0
    return tuple(1.0 if equations.of(name).unit.kind == "angle" else size for name in system.variables)


def trends(mechanism: Mechanism, equations: Equations, system: System) -> tuple[float, ...]:
    """By how much each unknown of a group may leave its trend: radians, or a length."""
    return tuple(TREND * scale for scale in scales(mechanism, equations, system))


def led(
    system: System, start: Sequence[float], there: Mapping[str, float], most: Sequence[float]
) -> list[float] | None:
    """The unknowns to which the start values lead where other dimensions are; None where the assembly ends on the way.

    there  what the system reads, and what that follows from, in the row at which it begins;  most: see `trends`
    """
    step, unknowns = scalar_step(system), start
    path: list[Sequence[float]] = []
    residuals, determinants = [], []
    for given in way_to(system, there, np.minimum(np.arange(FIRST_PASSES + 1) / LED, 1.0)):
        try:
            here = step(unknowns, given)
        except (ArithmeticError, ValueError):
            return None
        path.append(unknowns)
        residuals.append(here.residual)
        determinants.append(here.determinant)
        unknowns = moved(step, unknowns, given)
    leaps = np.abs(np.diff(np.array(path), 2, axis=0)) < np.array(most)
    steady = np.array(residuals[2:]) < max(STEADY * residuals[1], SETTLED)
    same = np.array(determinants) * determinants[0] > 0
    kept = residuals[-1] <= CLOSED and bool(np.all(leaps) and np.all(steady) and np.all(same))
    return [float(number) for number in path[-1]] if kept else None

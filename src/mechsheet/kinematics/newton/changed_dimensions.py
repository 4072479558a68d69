"""Other dimensions than the described ones: whether the assembly is still the same.

A sketch picks the assembly that is nearest to it. Where dimensions have changed much, that may be another than the described
one has become: the one in which a workbook of the description ends up when the same dimensions are typed into its cells. So
Newton's method is led with the dimensions from the described ones to the others, in equal steps: the determinant keeps its
sign, each unknown its trend and the residual its size as long as the assembly goes on; where it ends Newton's method is
thrown far, to another assembly or to none.
Source: E. L. Allgower, K. Georg, Introduction to Numerical Continuation Methods (steps, and how to tell a leap).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.build_equations import write_stepped
from mechsheet.kinematics.dimensions import dimension_values, largest_length
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.equations import Equations, Group, System
from mechsheet.kinematics.newton.system import CLOSED, FIRST_PASSES, LED, SETTLED, moved, scalar_step, way_to
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Mechanism

ALIKE = 1e-3
"""Radians, or parts of the size: start values are rounded."""


def assembly_doubts(before: Mechanism, mechanism: Mechanism, equations: Equations) -> list[Fault]:
    """A warning for the first group that Newton's method solves, and that the sketch puts into another assembly now.

    before  the mechanism with the described dimensions;  mechanism, equations: with others
    """
    try:
        described = write_stepped(before).groups
    except MechanismError:
        return []
    pairs = [
        (old, new)
        for old, new in zip(described, equations.groups, strict=False)
        if old.links == new.links and new.system
    ]
    values = sweep(mechanism, equations, driver_values(mechanism, dimension_values(mechanism)))
    there = {name: column.tolist() for name, column in values.items()}
    for old, new in pairs:
        system = old.system
        if system is None or old.system == new.system:
            continue
        row = min(system.row, len(there[system.driver]) - 1)
        known = {name: column[row] for name, column in there.items()}
        start = system.starts[old.assembly]
        found = led(system, start, known, trends(mechanism, equations, system))
        if found is None:
            return [_ended(new)]
        if not _same(mechanism, equations, system, found, [known[name] for name in system.unknowns]):
            return [_another(mechanism, equations, new, found)]
    return []


def _same(
    mechanism: Mechanism, equations: Equations, system: System, one: Sequence[float], other: Sequence[float]
) -> bool:
    """Whether two sets of unknowns are one position; a turn more of an angle is none of another assembly."""
    for name, scale, here, there in zip(
        system.variables, scales(mechanism, equations, system), one, other, strict=True
    ):
        gap = (here - there) / scale
        if equations.of(name).unit.kind == "angle" and np.isfinite(gap):
            gap = math.remainder(gap, math.tau)
        if not abs(gap) < ALIKE:
            return False
    return True


def _ended(group: Group) -> Fault:
    message = say(
        "on the way from the described dimensions to these the assembly of {links} ends: the sketch means another now",
        links=group.label,
    )
    return Fault(message, key="assembly", hint=_hint(group, 0))


def _another(mechanism: Mechanism, equations: Equations, group: Group, found: Sequence[float]) -> Fault:
    message = say(
        "with these dimensions the sketch means another assembly of {links} than the described one, with which a workbook "
        "goes on when they are typed",
        links=group.label,
    )
    numbers = [
        number
        for number, start in enumerate(group.system.starts if group.system else (), 1)
        if group.system and _same(mechanism, equations, group.system, found, start)
    ]
    return Fault(message, key="assembly", hint=_hint(group, numbers[0] if numbers else 0))


def _hint(group: Group, number: int) -> str:
    """How to ask for the assembly that goes on; number: which one it is now, 0 where it is none of the first row."""
    if number:
        return say("--set {mode}={number} takes that one", mode=group.mode, number=number)
    return say("sketch the position that is meant, or choose with --set {mode}=1 ... {count}", mode=group.mode,
               count=len(group.assemblies))  # fmt: skip


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

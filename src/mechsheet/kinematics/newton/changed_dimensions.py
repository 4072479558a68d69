"""Other dimensions than the described ones, given before anything is built: does the sketch still mean the same assembly?

A sketch picks the assembly that is nearest to it. Where dimensions have changed much, that may be another than the described
one has become: the one in which a workbook of the description ends up when the same dimensions are typed into its cells.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.build_equations import write_stepped
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.equations import Equations, Group, System
from mechsheet.kinematics.newton.lost_assembly import led, scales, trends
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

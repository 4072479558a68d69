"""The driver's effort found twice, and in every row how large it and the largest joint force are."""

from __future__ import annotations

from typing import Literal

from livesheet.formula.nodes import Call, Node, Symbol
from mechsheet.kinematics.equations import JOINT_FORCES
from mechsheet.sheet.geometry import largest_length
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula

Effort = tuple[Literal["torque", "effort", "force"], int, Node]

AGREES = 1e-9
"""Efforts that differ by less than this part of the largest term are the same."""


def effort_columns(plan: Plan, sheet: str, row: int) -> list[Effort]:
    """(what, 0, formula of `sheet` for a row of the table); an empty text in rows without forces.

    torque  by how much the effort from the reactions and that by virtual work differ, as a part of itself and of the
            largest joint force (at the largest length, where it is a torque)
    """
    if not plan.efforts:
        return []
    effort, work = (Symbol(name) for name in plan.efforts)
    normal = plan.equations.equations.forces("normal")
    forces = tuple(
        Call("ABS", (Symbol(name),)) if name in normal else Symbol(name)
        for name in plan.equations.equations.forces(*JOINT_FORCES)
    )
    largest: Node = Call("MAX", forces) if forces else formula("0*effort", effort=effort)
    scale = largest
    if plan.equations.of(plan.efforts[0]).unit.kind == "moment":
        metre = plan.mechanism.dynamics.metre if plan.mechanism.dynamics else None
        scale = formula("metre*lever*force", metre=metre or 1.0, lever=largest_length(plan.equations), force=largest)
    differ = formula("ABS(effort-work)/MAX(ABS(effort)+scale,1E-300)", effort=effort, work=work, scale=scale)
    found: list[tuple[Literal["torque", "effort", "force"], Node]] = [
        ("torque", differ), ("effort", Call("ABS", (effort,))),
    ]  # fmt: skip
    if forces:
        found.append(("force", largest))
    return [(kind, 0, plan.at.bind(formula('IFERROR(value,"")', value=value), sheet, row)) for kind, value in found]

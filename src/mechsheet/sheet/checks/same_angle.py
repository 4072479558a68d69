"""Outputs that are the angle of transmission of a group under another name: theta14 - theta13.

The links of an RRR group stand at that angle to each other, to the left or to the right: in the equations
theta13 = theta14 - mode*mu. So the extremes of the output are those of mu, which the first sheet has already.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from livesheet.formula.nodes import Binary, Node, Symbol
from mechsheet.kinematics.equations import Group
from mechsheet.model import Way
from mechsheet.sheet.places import Extreme
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula


@dataclass(frozen=True, slots=True)
class SameAngle:
    """An output that is the transmission angle of a group, in radians there, times its mode or times minus that."""

    group: Group
    minus: bool
    in_degrees: bool

    def extreme(self, found: Mapping[tuple[Way, str], Extreme], way: Way) -> tuple[Node, Node]:
        """The smallest or the largest value of the output, and the driver's value there, of what is found of all."""
        same, turned = (found[each, self.group.transmission] for each in (way, "max" if way == "min" else "min"))
        left = formula("mode<0" if self.minus else "mode>0", mode=Symbol(self.group.mode))
        value = formula("IF(left,same,-turned)", left=left, same=same.value.cell, turned=turned.value.cell)
        if self.in_degrees:
            value = formula("DEGREES(value)", value=value)
        return value, formula("IF(left,same,turned)", left=left, same=same.occurs.cell, turned=turned.occurs.cell)


def same_angle(plan: Plan, symbol: str) -> SameAngle | None:
    """The transmission angle that an output is; None where it is none, or where bands need its own derivatives."""
    output = next((each for each in plan.mechanism.outputs if each.symbol == symbol), None)
    if output is None or plan.mechanism.bands is not None or plan.rows_only:
        return None
    match output.formula:
        case Binary("-", Symbol(one), Symbol(other)):
            in_degrees = plan.mechanism.shown(output.unit).in_degrees
            for group in plan.found.transmission:
                if group.kind == "RRR" and _is_less(plan, other, one, group):
                    return SameAngle(group, False, in_degrees)
                if group.kind == "RRR" and _is_less(plan, one, other, group):
                    return SameAngle(group, True, in_degrees)
    return None


def _is_less(plan: Plan, angle: str, of: str, group: Group) -> bool:
    """Whether an angle is found as another one less the angle of transmission."""
    found = (each.expression for each in plan.equations.columns if each.symbol == angle)
    less = formula("of-mode*mu", of=Symbol(of), mode=Symbol(group.mode), mu=Symbol(group.transmission))
    return next(found, None) == less

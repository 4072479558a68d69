"""What is said of angles of transmission: one angle between 0 and 90 degrees for each group, the worst first.

An output may be one under another name: theta14 - theta13.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from livesheet.formula.nodes import Binary, Node, Symbol, Text
from mechsheet.kinematics.equations import Group
from mechsheet.model import Mechanism, Way
from mechsheet.sheet.places import Extreme
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.units import RAD, behind_number

POOR = 40.0
"""Angles of transmission [deg] below this are poor: most of the force only loads the joints."""


def poor_limit(mechanism: Mechanism) -> float:
    """`POOR` in the unit that the mechanism's angles are shown in."""
    return POOR if mechanism.angle_unit.in_degrees else round(math.radians(POOR), 3)


def worst_words(plan: Plan, worst: Node, place: Node, poor: Node, of_rows: Node | bool) -> Node:
    """The worst angle, where it is, and whether that is good, in words.

    place    the value of the driver there
    of_rows  whether it is of rows only: there may be worse between them, so that it is good is not known
    """
    angle, driver = plan.mechanism.angle_unit, plan.mechanism.driver.unit
    before, between, after = plan.text("verdict.worst", angle="#", place="#").split("#")
    rounded = formula("ROUND(angle,digits)", angle=worst, digits=1 if angle.in_degrees else 2)
    where = formula("ROUND(place,digits)", place=place, digits=2 if driver.symbol == RAD.symbol else 1)
    words = joined(before, rounded, behind_number(angle.text) + between, where, behind_number(driver.text) + after)
    fair: Node = Text("" if of_rows is True else plan.text("verdict.fair"))
    if isinstance(of_rows, Node):
        fair = formula('IF(of_rows,"",fair)', of_rows=of_rows, fair=fair)
    return formula("words&IF(poor,bad,fair)", words=words, poor=poor, bad=plan.text("verdict.poor"), fair=fair)


def worst_of_rows(plan: Plan, worst: Node, poor: Node) -> Node:
    """The worst angle of the rows, in words: where nobody looks between them."""
    angle = plan.mechanism.angle_unit
    before, after = plan.text("verdict.worst.rows", angle="#").split("#")
    rounded = formula("ROUND(angle,digits)", angle=worst, digits=1 if angle.in_degrees else 2)
    words = joined(before, rounded, behind_number(angle.text) + after)
    return formula('words&IF(poor,bad,"")', words=words, poor=poor, bad=plan.text("verdict.poor"))


RIGHT, STRAIGHT = formula("PI()/2"), formula("PI()")
"""A right angle and a straight one, in radians."""


def acute(low: Node, high: Node, from_right: bool, right: Node = RIGHT, straight: Node = STRAIGHT) -> tuple[Node, Node]:
    """An angle of transmission folded to 0 to 90 degrees, of an angle that goes from `low` to `high`.

    from_right  the angle is what is missing to a right one (a rod against its guide); else it is the angle between two
                links, up to a straight one

    What it is at `low` and at `high`, of which the smaller is the worst of all.
    """
    if from_right:
        return formula("right+low", right=right, low=low), formula("right-high", right=right, high=high)
    return low, formula("straight-high", straight=straight, high=high)


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

"""What is said of angles of transmission: one angle between 0 and 90 degrees for each group, the worst first."""

from __future__ import annotations

import math

from livesheet.formula.nodes import Node, Text
from mechsheet.model import Mechanism
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

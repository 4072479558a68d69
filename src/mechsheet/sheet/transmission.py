"""What is said of angles of transmission: one angle between 0 and 90 degrees for each group, the worst first."""

from __future__ import annotations

import math

from livesheet.formula.nodes import Node, RangeRef, Text
from mechsheet.model import Mechanism
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.units import behind_number

POOR = 40.0
"""Angles of transmission [deg] below this are poor: most of the force only loads the joints."""


def poor_limit(mechanism: Mechanism) -> float:
    """`POOR` in the unit that the mechanism's angles are shown in."""
    return POOR if mechanism.angle_unit.in_degrees else round(math.radians(POOR), 3)


def some_poor(mechanism: Mechanism, angles: RangeRef) -> Node:
    """Whether one of the angles is poor; those that there are none of do not count."""
    return formula('COUNTIF(angles,"<"&limit)>0', angles=angles, limit=poor_limit(mechanism))


def angle_words(plan: Plan, angle: Node) -> tuple[Node, str]:
    """An angle as words say it, and its unit."""
    unit = plan.mechanism.angle_unit
    return formula("ROUND(angle,digits)", angle=angle, digits=1 if unit.in_degrees else 2), behind_number(unit.text)


def from_to(plan: Plan, worst: Node, best: Node, poor: Node) -> Node:
    """From where to where it goes, and whether that is good, in words.

    Of rows only there may be worse between them: that it is good is not known; nor need any row be at the best.
    """
    up_to: Node = joined(" … ", *angle_words(plan, best))
    bad, fair = (Text(f": {plan.text(f'verdict.{word}')}") for word in ("poor", "fair"))
    if not plan.rows_only:
        up_to, known = (
            formula('IF(rows_only,"",said)', rows_only=plan.searched.rows_only.cell, said=said)
            for said in (up_to, fair)
        )
    else:
        up_to, known = Text(""), Text("") if plan.between_unseen else fair
    words = joined(*angle_words(plan, worst))
    return formula("words&up_to&IF(poor,bad,known)", words=words, up_to=up_to, poor=poor, bad=bad, known=known)


def acute(low: Node, high: Node, from_right: bool) -> tuple[tuple[Node, Node], Node]:
    """An angle of transmission in radians, folded to 0 to 90 degrees, of an angle that goes from `low` to `high`.

    from_right  the angle is what is missing to a right one (a rod against its guide); else it is the angle between two
                links, up to 180 degrees

    What it is at `low` and at `high`, of which the smaller is the worst of all; and the best of all, a right angle where
    one lies between them.
    """
    if from_right:
        return (formula("PI()/2+low", low=low), formula("PI()/2-high", high=high)), formula(
            "PI()/2-MAX(0,low,-high)", low=low, high=high
        )
    return (low, formula("PI()-high", high=high)), formula("PI()/2-MAX(0,low-PI()/2,PI()/2-high)", low=low, high=high)

"""How far a group is from its limit."""

from __future__ import annotations

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Call, Node
from mechsheet.kinematics.equations import Group


def gap_of(group: Group) -> Node:
    """By how much a group's links reach each other: positive where it closes, 0 at its limit, negative beyond.

    Of a triangle the smaller of a + b - s and s - |a - b|; of a right triangle the hypotenuse less the leg.
    """
    if len(group.sides) == 2:
        hypotenuse, leg = group.sides
        return al.sub(hypotenuse, leg if al.is_zero(leg) else Call("ABS", (leg,)))
    a, b, s = group.sides
    return Call("MIN", (al.sub(al.add(a, b), s), al.sub(s, Call("ABS", (al.sub(a, b),)))))

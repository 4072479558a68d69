"""What every kind of dyad hands back, and what several of them need."""

from __future__ import annotations

from dataclasses import dataclass

from mechsheet.formula import algebra as al
from mechsheet.formula.algebra import Angle
from mechsheet.formula.nodes import Call, Node, Symbol
from mechsheet.kinematics.equations import Condition
from mechsheet.kinematics.ledger import Ledger
from mechsheet.model import Words
from mechsheet.units import LENGTH
from mechsheet.words.equations import NOTHING


@dataclass(frozen=True, slots=True)
class Solved:
    """A dyad that has been written down; see `equations.Group` for the fields."""

    mode: str
    assemblies: tuple[Words, ...]
    closes: str
    apart: Node | None
    degenerate: Node | None
    pins: tuple[str, ...]
    unknowns: tuple[str, ...]
    label: Words
    transmission: str = ""
    sides: tuple[Node, ...] = ()


ONE_ASSEMBLY = (NOTHING,)


def half_turn_unless(mode: Node) -> Node:
    """0 for mode +1, pi for mode -1."""
    return al.div(al.mul(al.PI, al.sub(al.ONE, mode)), al.TWO)


def leg(ledger: Ledger, base: str, hypotenuse: Node, other: Node, label: Words, separate: Condition) -> Symbol:
    """sqrt(hypotenuse^2 - other^2) of a right triangle as a column, where it has one and `separate` holds.

    Written (c - a)(c + a), which keeps its digits at the limit. A shortfall below the tolerance is a dead centre.
    """
    if al.is_zero(other):
        return ledger.column(base, hypotenuse, LENGTH, label, exists=[separate])
    reaches = Condition(al.sub(hypotenuse, Call("ABS", (other,))), al.neg(ledger.tolerance), reach=True)
    product = al.mul(al.sub(hypotenuse, other), al.add(hypotenuse, other))
    return ledger.column(base, Call("SQRT", (product,)), LENGTH, label, exists=[separate, reaches])


def along_and_across(x: Node, y: Node, delta: Angle) -> tuple[Node, Node]:
    """Components of (x, y) along the direction delta and across it (to the left)."""
    c, s = al.cos(delta), al.sin(delta)
    return (
        al.add(al.mul(x, c), al.mul(y, s)),
        al.sub(al.mul(y, c), al.mul(x, s)),
    )

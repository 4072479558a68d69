"""What every kind of dyad hands back, and what several of them need."""

from __future__ import annotations

from dataclasses import dataclass

from mechsheet.formula.nodes import Call, Node, Symbol
from mechsheet.kinematics import algebra as al
from mechsheet.kinematics.algebra import Angle
from mechsheet.kinematics.ledger import Ledger
from mechsheet.model import Words


@dataclass(frozen=True, slots=True)
class Solved:
    """A dyad that has been written down; see `equations.Group` for the fields."""

    mode: str
    mode_words: tuple[Words, Words]
    closes: str
    degenerate: Node | None
    pins: tuple[str, ...]
    label: Words
    transmission: str = ""
    sides: tuple[Node, ...] = ()


NO_MODE = (Words("", ""), Words("", ""))


def half_turn_unless(mode: Node) -> Node:
    """0 for mode +1, pi for mode -1."""
    return al.div(al.mul(al.PI, al.sub(al.ONE, mode)), al.TWO)


def leg(ledger: Ledger, base: str, hypotenuse: Node, other: Node, label: Words, also: Node | None = None) -> Symbol:
    """sqrt(hypotenuse^2 - other^2) of a right triangle as a column; #N/A where the other leg is longer.

    Written (c - a)(c + a), which keeps its digits at the limit. A shortfall below the tolerance is a dead centre: 0.
    """
    if al.is_zero(other):
        open_: Node | None = also
        value = hypotenuse
    else:
        open_ = al.less(al.sub(hypotenuse, Call("ABS", (other,))), al.neg(ledger.tolerance))
        if also is not None:
            open_ = Call("OR", (also, open_))
        product = al.mul(al.sub(hypotenuse, other), al.add(hypotenuse, other))
        value = Call("SQRT", (Call("MAX", (al.ZERO, product)),))
    if open_ is not None:
        value = Call("IF", (open_, Call("NA"), value))
    return ledger.column(base, value, "length", label)


def along_and_across(x: Node, y: Node, delta: Angle) -> tuple[Node, Node]:
    """Components of (x, y) along the direction delta and across it (to the left)."""
    c, s = al.cos(delta), al.sin(delta)
    return (
        al.add(al.mul(x, c), al.mul(y, s)),
        al.sub(al.mul(y, c), al.mul(x, s)),
    )

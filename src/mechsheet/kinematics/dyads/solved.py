"""What every kind of dyad hands back, and what several of them need."""

from __future__ import annotations

from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Call, Node, Symbol
from livesheet.said import Words
from mechsheet.kinematics.equations import Condition, System
from mechsheet.kinematics.ledger import Ledger
from mechsheet.units import LENGTH
from mechsheet.words.equations import NOTHING, phrase

DEAD = 1e-5
"""Below this sine of the angle between its parts a group counts as being at a dead centre: then no rate is a number."""


@dataclass(frozen=True, slots=True)
class Determinant:
    """What the rates of a dyad are divided by: w1 x w2, where w is the closing point's velocity per unit of an unknown.

    node     over what the positions have already;  lengths  of how many lengths it is a product
    turned   True for a node that is minus that
    dead     what must hold for rates to be numbers; None where the node is a number and never vanishes
    """

    node: Node
    lengths: int
    turned: bool
    dead: Condition | None

    @property
    def product(self) -> Node:
        """w1 x w2."""
        return al.neg(self.node) if self.turned else self.node


@dataclass(frozen=True, slots=True)
class Solved:
    """A dyad that has been written down; see `equations.Group` for the fields."""

    mode: str
    assemblies: tuple[Words, ...]
    closes: str
    apart: Node | None
    pins: tuple[str, ...]
    unknowns: tuple[str, ...]
    label: Words
    determinant: Determinant
    transmission: str = ""
    sides: tuple[Node, ...] = ()
    system: System | None = None
    degenerate: Node | None = None


ONE_ASSEMBLY = (NOTHING,)


def lines_cross(sine: Node, turned: bool) -> Determinant:
    """Of two lines with this sine of the angle between them."""
    dead = None if al.value_of(sine) is not None else Condition(Call("ABS", (sine,)), al.number(DEAD))
    return Determinant(sine, 0, turned, dead)


def leg_left(mode: Node, leg: Node, hypotenuse: Node, turned: bool) -> Determinant:
    """Of a right triangle whose leg vanishes at the dead centre."""
    return Determinant(al.mul(mode, leg), 1, turned, Condition(leg, al.mul(al.number(DEAD), hypotenuse)))


def half_turn_unless(mode: Node) -> Node:
    """0 for mode +1, pi for mode -1."""
    return al.div(al.mul(al.PI, al.sub(al.ONE, mode)), al.TWO)


def known_way(
    ledger: Ledger, name: str, start: tuple[str, Node, Node], end: tuple[str, Node, Node]
) -> tuple[Symbol, Symbol]:
    """The distance (a column of that name) and the direction from one known point to another, each (name, x, y)."""
    (p, xp, yp), (q, xq, yq) = start, end
    x = ledger.hoist(f"{name}_x", al.sub(xq, xp), LENGTH, phrase("part_of_way", start=p, end=q, axis="x"))
    y = ledger.hoist(f"{name}_y", al.sub(yq, yp), LENGTH, phrase("part_of_way", start=p, end=q, axis="y"))
    length = ledger.column(
        name, al.sqrt(al.add(al.square(x), al.square(y))), LENGTH, phrase("distance", start=p, end=q)
    )
    return length, ledger.direction("phi", x, y, phrase("direction_of", what=f"{p}→{q}"))


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

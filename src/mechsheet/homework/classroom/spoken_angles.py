"""Angles as a person says them: `plus β + 90°`, not `less (−β − π/2)`.

An angle is a sum, what is added before what is taken off; its numbers are one, in degrees where the description's angles
are.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Node, Number, Unary, symbols
from livesheet.formula.scalar import evaluate
from mechsheet.units import DEG

READABLE = 4
"""Decimals of a number of degrees: a person draws no finer, and marks allow a hundred times more."""


@dataclass(frozen=True, slots=True)
class SpokenAngle:
    """A sum of angles: `plus` and `minus` are its terms without their signs, those with symbols first."""

    plus: tuple[Node, ...] = ()
    minus: tuple[Node, ...] = ()

    @property
    def negative(self) -> bool:
        """Whether nothing is added."""
        return not self.plus

    @property
    def terms(self) -> int:
        """How many there are; none for an angle of 0."""
        return len(self.plus) + len(self.minus)

    def negated(self) -> SpokenAngle:
        """The same angle the other way round."""
        return replace(self, plus=self.minus, minus=self.plus)

    @property
    def node(self) -> Node:
        """As a formula."""
        total: Node = al.ZERO
        for term in self.plus:
            total = al.add(total, term)
        for term in self.minus:
            total = al.sub(total, term)
        return total


def spoken(angle: Node, in_degrees: bool) -> SpokenAngle:
    """An angle in radians as a sum; `in_degrees`: its numbers are said in degrees."""
    ways: dict[int, list[Node]] = {1: [], -1: []}
    constant = 0.0
    for sign, term in _terms(angle, 1):
        if in_degrees and not symbols(term):
            constant += sign * evaluate(term, {})
        else:
            ways[sign].append(term)
    degrees = round(DEG.to_shown(constant), READABLE)
    if degrees:
        ways[1 if degrees > 0 else -1].append(al.call("RADIANS", Number(abs(degrees))))
    return SpokenAngle(tuple(ways[1]), tuple(ways[-1]))


def _terms(node: Node, sign: int) -> list[tuple[int, Node]]:
    """The terms of a sum with their signs; the sign of a product is that of its first factor."""
    match node:
        case Number(value) if value < 0:
            return [(-sign, Number(-value))]
        case Unary("-", operand):
            return _terms(operand, -sign)
        case Binary("+" | "-" as op, left, right):
            return [*_terms(left, sign), *_terms(right, sign if op == "+" else -sign)]
        case Binary("*" | "/" as op, left, right):
            inside = _terms(left, sign)
            return [(inside[0][0], Binary(op, inside[0][1], right))] if len(inside) == 1 else [(sign, node)]
    return [(sign, node)]

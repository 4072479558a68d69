"""How everything changes while the mechanism moves: velocities and accelerations of its symbols, from its equations.

A group's unknowns u follow from its closure F(u, known) = 0:

    J u'  = - (dF/dknown) known'                          J = dF/du, two rows, two columns
    J u'' = - (what is left of F'' where every u'' is 0)

All else follows by the chain rule. A prime in a name is one derivative: `theta13'`, `theta13''`. Whether the derivative is
by time or by the driver (or by a dimension: the design's own derivatives) is decided by what is given for the first symbols.
Source: Soeylemez, Mechanisms, section 4.3 (velocity and acceleration from the loop closure equations).
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Node, Symbol, symbols, transform
from mechsheet.kinematics.equations import Equations, Group
from mechsheet.kinematics.numeric import Array, value

PRIME = "'"


@dataclass(frozen=True, slots=True)
class Linear:
    """matrix (unknowns) = right: two linear equations, as expressions over positions and lower derivatives."""

    unknowns: tuple[str, str]
    matrix: tuple[tuple[Node, Node], tuple[Node, Node]]
    right: tuple[Node, Node]

    @property
    def determinant(self) -> Node:
        """0 where the group is at a dead centre."""
        (a, b), (c, d) = self.matrix
        return al.sub(al.mul(a, d), al.mul(b, c))

    @property
    def solution(self) -> tuple[Node, Node]:
        """Both unknowns by Cramer's rule."""
        (a, b), (c, d) = self.matrix
        p, q = self.right
        det = self.determinant
        return (
            al.div(al.sub(al.mul(p, d), al.mul(b, q)), det),
            al.div(al.sub(al.mul(a, q), al.mul(p, c)), det),
        )


def rate(node: Node, moving: Collection[str]) -> Node:
    """The derivative of an expression whose symbols in `moving` change: the sum of d node / d x times x'."""
    changing = [name for name in symbols(node) if name.removesuffix(PRIME).removesuffix(PRIME) in moving]
    return al.total(al.mul(derivative(node, name), Symbol(name + PRIME)) for name in changing)


def group_rates(equations: Equations, group: Group, moving: Collection[str]) -> tuple[Linear, Linear]:
    """The two linear systems of a group: for the first and for the second derivatives of its unknowns.

    Besides its unknowns the closure may read angles that follow in the same group (of the second link of a pair that the
    driver turns against each other, of a link on a slide): they are written out.
    """
    following = _following(equations, group)
    gap = tuple(_written_out(part, following) for part in group.closure.gap)
    first = tuple(rate(part, moving) for part in gap)
    second = tuple(rate(part, moving) for part in first)
    return _linear(group, first, PRIME), _linear(group, second, PRIME * 2)


def rates_over(
    equations: Equations, values: Mapping[str, Array], given: Mapping[str, tuple[float, float]]
) -> dict[str, Array]:
    """First and second derivatives of every symbol over the rows of a sweep, by name with primes.

    values  every symbol's column, as `sweep` gives them;  given  symbol -> its first and second derivative (the driver's
    by itself are 1 and 0). A dead centre gives what division by a vanishing determinant gives.
    """
    found: dict[str, Array] = dict(values)
    for name, (first, second) in given.items():
        found |= {name + PRIME: np.asarray(first), name + PRIME * 2: np.asarray(second)}
    moving = set(given)
    decided = {name: group for group in equations.groups for name in group.unknowns}
    with np.errstate(all="ignore"):
        for equation in equations.all:
            if equation.symbol in decided and equation.symbol + PRIME not in found:
                group = decided[equation.symbol]
                moving |= set(group.unknowns)
                for system in group_rates(equations, group, moving):
                    for name, solution in zip(system.unknowns, system.solution, strict=True):
                        found[name] = value(solution, found)
            if equation.symbol + PRIME not in found and moving.intersection(equation.reads):
                moving.add(equation.symbol)
                once = rate(equation.expression, moving)
                found[equation.symbol + PRIME] = value(once, found)
                found[equation.symbol + PRIME * 2] = value(rate(once, moving), found)
    return {name: column for name, column in found.items() if name.endswith(PRIME)}


def _linear(group: Group, rates: Iterable[Node], primes: str) -> Linear:
    """What is linear in the unknowns' highest derivatives, taken apart."""
    u, v = (name + primes for name in group.unknowns)
    zero: Mapping[str, Node] = {u: al.ZERO, v: al.ZERO}
    rows = list(rates)
    matrix = tuple((derivative(row, u), derivative(row, v)) for row in rows)
    right = tuple(al.neg(_written_out(row, zero)) for row in rows)
    return Linear((u, v), (matrix[0], matrix[1]), (right[0], right[1]))


def _following(equations: Equations, group: Group) -> dict[str, Node]:
    """Symbols that come with or after the group's unknowns (angles of links that it turns), over what comes before."""
    found: dict[str, Node] = {}
    begun = False
    for equation in equations.columns:
        begun = begun or equation.symbol in group.unknowns
        if begun and equation.group == group.number and equation.symbol not in group.unknowns:
            found[equation.symbol] = _written_out(equation.expression, found)
    wanted = set(group.closure.reads)
    return {name: form for name, form in found.items() if name in wanted}


def _written_out(node: Node, forms: Mapping[str, Node]) -> Node:
    def change(part: Node) -> Node:
        return forms.get(part.name, part) if isinstance(part, Symbol) else al.tidied(part)

    return transform(node, change)

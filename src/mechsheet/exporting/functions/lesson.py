"""A mechanism as a chain of simpler ones, each a call of a basic function: the output of one is the input of the next.

The loop closure of a dyad is brought to the form

    RRR   a e^(i alpha) + K = b e^(i beta)                 RRP   a e^(i alpha) + K = s e^(i delta)
    RPR   (s + p + i h) e^(i delta) = -K                   two lines   K + s e^(i delta) = t e^(i epsilon)

with K known. Where K is one turning vector and something fixed, r e^(i phi) - g e^(i gamma), the dyad is a four-bar, a
slider-crank or a crank with a slotted lever, seen from the ground in the direction gamma:
DörtÇubuk(r; a; b; g; Config; phi - gamma) + gamma. Else it is the dyad's own function, with K in place of its first pin.
Source of the way: Soeylemez, Mechanisms, section 3.8 (five-link mechanism).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from random import Random

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Call, Direction, Node, Previous, Root, Symbol, TriangleAngle, symbols, transform
from livesheet.formula.scalar import evaluate
from mechsheet.compiled import Compiled
from mechsheet.kinematics.dimensions import dimension_order
from mechsheet.kinematics.equations import Group, Vector

TRIED = 3
"""Sets of dimensions with which two expressions are compared: those that agree in all of them are the same."""
SPREAD = 0.2
"""By which part of themselves dimensions differ there from those described."""
SAME = 1e-9


@dataclass(frozen=True, slots=True)
class Link:
    """A column: the symbol that it shows, and the call over dimensions, modes, the driver and columns before it [rad]."""

    symbol: str
    call: Node


class _NoCallError(Exception):
    """A group that no basic function computes."""


def chain_of(compiled: Compiled) -> tuple[Link, ...]:
    """The columns: of each group the angle of the link on the ground, or the displacement, and what later ones read.

    Nothing where a group is solved by Newton's method, and with gears, racks and further drivers.
    """
    try:
        chain = _Chain(compiled)
        found = [(group, chain.calls(group)) for group in compiled.equations.groups]
    except _NoCallError:
        return ()
    kept: list[Link] = []
    needed = {chain.output(group) for group, _ in found}
    for _, calls in reversed(found):
        for symbol, call in reversed(calls.items()):
            if symbol in needed:
                needed.update(symbols(call))
                kept.append(Link(symbol, call))
    return tuple(reversed(kept))


HALF = Angle(degrees=180.0)


class _Chain:
    """What a mechanism's loops are written over: dimensions, modes, the driver, the unknowns of its groups."""

    def __init__(self, compiled: Compiled) -> None:
        self.equations = compiled.equations
        self.mechanism = compiled.mechanism
        self.modes = compiled.modes
        self.driver = compiled.mechanism.driver.symbol
        self.unknowns = {name for group in self.equations.groups for name in group.unknowns}
        self.expressions = {equation.symbol: equation.expression for equation in self.equations.columns}
        self.dimensions = {dim.symbol for dim in self.mechanism.dimensions}
        self.fixed = self.dimensions | {equation.symbol for equation in self.equations.constants}
        if self.equations.tied or compiled.mechanism.given_by_row:
            raise _NoCallError
        self.tried = list(_tried(compiled))

    def output(self, group: Group) -> str:
        """The unknown that is the group's output: of two links the one on the ground, the second where both are or none."""
        if group.kind == "RRP":
            return group.unknowns[1]
        if group.kind in ("PRP", "RPP"):
            fixed = (
                v.length.name for v in group.closure.vectors if isinstance(v.length, Symbol) and self._fixed(v.angle)
            )
            return next((name for name in fixed if name in group.unknowns), group.unknowns[0])
        ground = self.mechanism.ground.points
        first = group.kind == "RPR" or (group.pins[0] in ground and group.pins[1] not in ground)
        return group.unknowns[0 if first else 1]

    def calls(self, group: Group) -> dict[str, Node]:
        """Each unknown of a group as a call."""
        terms = [*self._terms(group.closure.left, 1), *self._terms(group.closure.right, -1)]
        kinds = {"RRR": self._rrr, "RRP": self._rrp, "RPR": self._rpr, "PRP": self._lines, "RPP": self._lines}
        if group.kind not in kinds or not terms:
            raise _NoCallError
        return kinds[group.kind](group, terms)

    # the three kinds

    def _rrr(self, group: Group, terms: list[Vector]) -> dict[str, Node]:
        first, second = group.unknowns
        (a, alpha), terms = self._arm(terms, first)
        (b, beta), known = self._arm(terms, second)
        beta += HALF  # a e^(i alpha) + K = b e^(i beta)
        mode = Symbol(group.mode)
        if (pair := self._pair(known)) is not None:
            crank, phi, ground, gamma = pair
            given: tuple[Node, ...] = (crank, a, b, ground, mode, _said(phi - gamma))
            calls = [Angle(Call(name, given)) + gamma for name in ("FourBarCoupler", "FourBar")]
        else:
            given = (*_parts(known), a, al.ZERO, al.ZERO, b, mode)
            calls = [Angle(Call(name, given)) for name in ("DyadRRRFirst", "DyadRRR")]
        return {first: _said(calls[0] - alpha), second: _said(calls[1] - beta)}

    def _rrp(self, group: Group, terms: list[Vector]) -> dict[str, Node]:
        first, slide = group.unknowns
        along, terms = _slide(terms, slide)
        (a, alpha), known = self._arm(terms, first)
        delta = along + HALF
        mode = Symbol(group.mode)
        turning, fixed = self._split(known)
        if turning is not None and self._fixed(delta):
            x, y = _parts([_turned(term, -delta) for term in fixed])
            given: tuple[Node, ...] = (turning.length, a, al.neg(y), mode, _said(turning.angle - delta))
            angle = Angle(Call("SliderCrankCoupler", given)) + delta
            way = al.add(Call("SliderCrank", given), x)
        else:
            given = (*_parts(known), a, al.ZERO, al.ZERO, _said(delta), mode)
            angle, way = Angle(Call("DyadRRPFirst", given)), Call("DyadRRP", given)
        return {first: _said(angle - alpha), slide: way}

    def _rpr(self, group: Group, terms: list[Vector]) -> dict[str, Node]:
        lever, slide = group.unknowns
        along = next((term.angle for term in terms if term.length == Symbol(slide)), None)
        if along is None:
            raise _NoCallError
        offset = self._offset(along, lever)
        carried = [term for term in terms if lever in symbols(term.angle.node) and term.length != Symbol(slide)]
        known = [term for term in terms if lever not in symbols(term.angle.node)]
        p, h = _parts([Vector(term.length, self._offset(term.angle, lever) - offset) for term in carried])
        to_pin = [_turned(term, HALF) for term in known]
        mode = Symbol(group.mode)
        if (pair := self._pair(to_pin)) is not None:
            crank, phi, ground, gamma = pair
            angle = _said(phi - gamma)
            given: tuple[Node, ...] = (crank, ground, h, mode, angle)
            whole = self._zero(h) and self.modes[group.mode] == 1
            call = Call("lever", (crank, ground, angle)) if whole else Call("InvertedSliderCrank", given)
            delta = Angle(call) + gamma
            way: Node = Call("InvertedSliderCrankSlide", given)
        else:
            given = (al.ZERO, al.ZERO, *_parts(to_pin), h, mode)
            delta, way = Angle(Call("DyadRPR", given)), Call("DyadRPRSlide", given)
        return {lever: _said(delta - offset), slide: al.sub(way, p)}

    def _lines(self, group: Group, terms: list[Vector]) -> dict[str, Node]:
        one, other = group.unknowns
        delta, terms = _slide(terms, one)
        epsilon, known = _slide(terms, other)
        given = (*_parts(known), _said(delta), al.ZERO, al.ZERO, _said(epsilon + HALF))
        return {one: Call("DyadPRP", given), other: Call("DyadPRPSecond", given)}

    # vectors

    def _terms(self, side: Sequence[Vector], sign: int) -> Iterator[Vector]:
        """The vectors of a side of a loop, over what the chain has; those of the other side turned round."""
        for vector in side:
            angle = Angle(self._inlined(vector.angle.node), vector.angle.degrees)
            yield Vector(self._inlined(vector.length), angle if sign > 0 else angle + HALF)

    def _inlined(self, node: Node) -> Node:
        """An expression with everything put in place that is neither given nor an unknown of a group."""

        def change(part: Node) -> Node:
            if isinstance(part, Symbol) and part.name in self.expressions and part.name not in self.unknowns:
                return self._inlined(self.expressions[part.name])
            if isinstance(part, Direction | TriangleAngle | Root | Previous):
                raise _NoCallError
            return part

        return al.tidied(transform(node, change))

    def _offset(self, angle: Angle, unknown: str) -> Angle:
        """By how much an angle is more than an unknown."""
        rest = transform(angle.node, lambda part: al.ZERO if part == Symbol(unknown) else al.tidied(part))
        if not self._fixed(Angle(rest)) or self._differ(al.sub(angle.node, rest), Symbol(unknown)):
            raise _NoCallError
        return Angle(rest, angle.degrees)

    def _arm(self, terms: list[Vector], unknown: str) -> tuple[tuple[Node, Angle], list[Vector]]:
        """The vector that turns with an unknown, as its length and by how much it is ahead of it; the other terms."""
        own = [
            Vector(term.length, self._offset(term.angle, unknown))
            for term in terms
            if unknown in symbols(term.angle.node)
        ]
        if not own:
            raise _NoCallError
        return self._vector(own), [term for term in terms if unknown not in symbols(term.angle.node)]

    def _vector(self, terms: list[Vector]) -> tuple[Node, Angle]:
        """The sum of fixed terms: its length and its direction, as dimensions where there are such."""
        if len(terms) == 1:
            return terms[0].length, terms[0].angle
        x, y = _parts(terms)
        length, angle = al.sqrt(al.add(al.square(x), al.square(y))), al.atan2(x, y)
        named = self._named(length, "length")
        turned = self._named(angle, "angle")
        return named or Call("length", (x, y)), Angle(turned or Call("angle", (x, y)))

    def _split(self, terms: list[Vector]) -> tuple[Vector | None, list[Vector]]:
        """The one turning vector of a fixed length, if there is just one, and the fixed ones."""
        turning = [term for term in terms if not self._fixed(term.angle) or not self._fixed(Angle(term.length))]
        fixed = [term for term in terms if term not in turning]
        only = turning[0] if len(turning) == 1 and self._fixed(Angle(turning[0].length)) else None
        return only, fixed

    def _pair(self, terms: list[Vector]) -> tuple[Node, Angle, Node, Angle] | None:
        """K as r e^(i phi) - g e^(i gamma): r, phi, g, gamma; None where it is something else."""
        turning, fixed = self._split(terms)
        if turning is None or not fixed:
            return None
        ground, gamma = self._vector([_turned(term, HALF) for term in fixed])
        return turning.length, turning.angle, ground, _within(gamma)

    # what is the same

    def _fixed(self, angle: Angle) -> bool:
        return self.fixed.issuperset(symbols(angle.node))

    def _zero(self, node: Node) -> bool:
        own = self.dimensions.issuperset(symbols(node))
        return own and all(abs(evaluate(node, values)) < SAME for values in self.tried)

    def _differ(self, one: Node, other: Node) -> bool:
        """Whether two expressions differ with some of the dimensions tried, the unknowns and modes being any numbers."""
        names = {*symbols(one), *symbols(other)} - self.dimensions
        any_of = {name: 0.3 + 0.1 * number for number, name in enumerate(sorted(names))}
        return any(
            abs(evaluate(one, any_of | values) - evaluate(other, any_of | values)) > SAME for values in self.tried
        )

    def _named(self, node: Node, kind: str) -> Node | None:
        """The dimension that an expression is, or minus it, or a half turn from it."""
        if not self.dimensions.issuperset(symbols(node)):
            return None
        wanted = [evaluate(node, values) for values in self.tried]
        forms = _FORMS if kind == "angle" else _FORMS[:1]
        for sign, turn in forms:
            for dim in self.mechanism.dimensions:
                found = [sign * values[dim.symbol] + turn for values in self.tried]
                if dim.unit.kind == kind and all(_alike(w, f, kind) for w, f in zip(wanted, found, strict=True)):
                    own = Symbol(dim.symbol) if sign > 0 else al.neg(Symbol(dim.symbol))
                    return al.add(own, al.PI) if turn else own
        return None


_FORMS = ((1, 0.0), (-1, 0.0), (1, math.pi), (-1, math.pi))
"""What an angle may be of a dimension: itself, minus it, half a turn from it: the plainest first."""


def _alike(one: float, other: float, kind: str) -> bool:
    apart = one - other
    return abs(math.remainder(apart, math.tau) if kind == "angle" else apart) <= SAME * max(1.0, abs(one))


def _tried(compiled: Compiled) -> Iterator[dict[str, float]]:
    """The dimensions as described, and others near them, derived ones following."""
    mechanism = compiled.mechanism
    given = {dim.symbol: dim.value for dim in mechanism.dimensions}
    random = Random(0)
    for number in range(1 + TRIED):
        values: dict[str, float] = {}
        for symbol in dimension_order(mechanism):
            quantity = given[symbol]
            if isinstance(quantity, float):
                values[symbol] = quantity * (1 + (random.uniform(-SPREAD, SPREAD) if number else 0.0))
                continue
            try:
                values[symbol] = evaluate(quantity, values)
            except (ArithmeticError, ValueError):
                break
        else:
            yield values


def _turned(vector: Vector, by: Angle) -> Vector:
    return replace(vector, angle=vector.angle + by)


def _slide(terms: list[Vector], slide: str) -> tuple[Angle, list[Vector]]:
    """The direction of the displacement, and the other terms."""
    along = [term.angle for term in terms if term.length == Symbol(slide)]
    rest = [term for term in terms if term.length != Symbol(slide)]
    if len(along) != 1 or any(slide in (*symbols(term.length), *symbols(term.angle.node)) for term in rest):
        raise _NoCallError
    return along[0], rest


def _parts(terms: Iterable[Vector]) -> tuple[Node, Node]:
    """x and y of a sum."""
    listed = [Vector(term.length, _within(term.angle)) for term in terms]
    return (
        al.total(al.mul(term.length, al.cos(term.angle)) for term in listed),
        al.total(al.mul(term.length, al.sin(term.angle)) for term in listed),
    )


def _within(angle: Angle) -> Angle:
    """The same direction, its degrees from -180 (excluded) to 180."""
    return replace(angle, degrees=180.0 - (180.0 - angle.degrees) % 360.0)


def _said(angle: Angle) -> Node:
    """A direction as an expression without whole turns."""
    return _within(angle).expression()

"""Velocities and accelerations of a group that Newton's method solves: its equations F(x) = 0, differentiated.

    J x' = -F',    J x'' = -F''        F', F'': what is left of the derivatives of F where x', then x'', is 0

J is the Jacobian of the last pass. A link between two carriers gives the same place twice: P + w of the link itself, and Q
of the body that it meets there. The gap between the two ways is linear in the rates; across the link's own unknown (along
w, or along the normal n of its line d) it is one of the group's equations, along it it gives the link's own rate:

    distance of two pins     w . (P' - Q') = 0,    w . (P'' - Q'') = theta'^2 l^2,       theta' = w x (Q' - P') / l^2
    distance from a line     n . (B' - P') = 0,    n . (B'' - P'') = -2 s' delta',       s' = d . (P' - B')
    a pin of two carriers    P' - Q' = 0,          P'' - Q'' = 0
    a gear, a rack           sum of A v' = 0,      sum of A v'' = 0,             v angles and displacements (`ties`)

B is the place at P of the body with the line, delta its angle. Source: the implicit function theorem; Soeylemez,
Mechanisms, section 3.9 for F and J; Uicker, Pennock and Shigley, Theory of Machines and Mechanisms, section 3.12.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Binary as NodeBinary
from livesheet.formula.nodes import Call, Node, Number, Symbol, renamed, transform
from livesheet.formula.vectors import NOWHERE, Vector, dot, minus, negative, turned
from mechsheet.kinematics.dyads.solved import DEAD
from mechsheet.kinematics.equations import Condition, System
from mechsheet.kinematics.gear_relations import terms_of
from mechsheet.kinematics.graph import Assembly, Slide
from mechsheet.kinematics.newton.chains import Binary
from mechsheet.kinematics.newton.newton_equations import Cramer, Solution, cramer, holder
from mechsheet.kinematics.rates.motions import Motions, PointRate, Rate
from mechsheet.kinematics.rates.rate_columns import COEFFICIENTS, LONGEST, RateColumns, order_words
from mechsheet.model import Rack, Relation
from mechsheet.units import NUMBER, Unit
from mechsheet.words.equations import phrase

SIDES = ((al.ONE, al.ZERO), (al.ZERO, al.ONE))


@dataclass(frozen=True, slots=True)
class Own:
    """The rate of a link between two carriers: it moves the place by `along` for each unit of the symbol.

    square  |along|^2
    """

    symbol: str
    along: Vector
    square: Node


@dataclass(frozen=True, slots=True)
class Closing:
    """A place that is reached in two ways.

    gap    by how much the rates over the one exceed those over the other
    free   the same without the link's own rate
    bend   what the link's own first rate adds to the second derivative along `asked`, where `free` has lost it
    asked  the directions along which the gap is an equation of the group, in the order of its equations
    point  of a link that stands on the ground, the point at its other end: `free` is minus its rates; else ""
    power  of a length, that its equations have: of a gear 0, and the gap is along x alone
    """

    gap: PointRate
    free: PointRate
    bend: Node
    asked: tuple[Vector, ...]
    own: Own | None
    point: str = ""
    power: int = 1


def known_pins(motions: Motions, solution: Solution) -> list[str]:
    """The points of a group that bodies solved before it have."""
    graph = motions.poses.graph
    points = dict.fromkeys(point for body in solution.chain.bodies for point in graph.points[body])
    return [point for point in points if any(body in motions.motion for body in graph.bodies_at(point))]


class Closings:
    """Of one group: its bodies get their motions, over the rates of the unknowns."""

    def __init__(self, motions: Motions, solution: Solution, known: Mapping[str, PointRate]) -> None:
        """`known`: the rates of `known_pins`."""
        self.motions, self.poses, self.solution, self.known = motions, motions.poses, solution, known
        self.chain = solution.chain

    def write(self) -> list[Closing]:
        """In the order of the group's equations."""
        motions = self.motions
        for carrier, symbol in zip(self.chain.carriers, self.solution.system.variables, strict=True):
            joint = carrier.reached
            if isinstance(joint, str):
                motions.pinned(carrier.assembly, joint, self._at(joint, carrier.assembly), motions.rates.of(symbol))
            else:
                motions.guided(carrier.assembly, joint)
        found = [self._over(binary) for binary in self.chain.binaries]
        found += [self._at_pin(*shut) for shut in self.chain.shut]
        return found + [self._tied(relation) for relation in self.chain.relations]

    def _at(self, point: str, but: Assembly = ()) -> PointRate:
        """The rates of a point as the body has them with which it was found."""
        if point in self.known:
            return self.known[point]
        return self.motions.motion[holder(self.poses, self.chain, point, but)](self.poses.xy[point])

    def _over(self, binary: Binary) -> Closing:
        if isinstance(binary.other, str):
            return self._over_pins(binary.assembly, binary.pin, binary.other)
        return self._on_line(binary.assembly, binary.pin, binary.other)

    def _over_pins(self, assembly: Assembly, first: str, second: str) -> Closing:
        span = self.solution.spans[assembly]
        symbol = self.poses.links[assembly[0]].angle_symbol
        rate = self.motions.rates.of(symbol)
        self.motions.pinned(assembly, first, self._at(first, assembly), rate)
        over = self.motions.motion[self.motions.with_point(assembly, second)](self.poses.xy[second])
        there = self._at(second, assembly)
        gap = PointRate(minus(over.first, there.first), minus(over.second, there.second))
        own = Own(symbol, turned(span.way), al.square(span.length))
        bend = al.mul(al.square(rate.first), own.square)
        stands = all(map(al.is_zero, self._at(first, assembly).first)) and len(assembly) == 1
        return self._closing(assembly, gap, own, (negative(span.way),), bend, second if stands else "")

    def _on_line(self, assembly: Assembly, first: str, slide: Slide) -> Closing:
        motions = self.motions
        symbol = motions.guided(assembly, slide)
        rate = motions.rates.of(symbol)
        inside = slide.side(assembly)
        place, there = self.poses.xy[first], self._at(first, assembly)
        over = motions.motion[motions.with_point(assembly, first)](place)
        gap = PointRate(minus(over.first, there.first), minus(over.second, there.second))
        d = motions.direction(slide)
        along, slid = (d, rate.first) if inside == slide.body else (negative(d), al.neg(rate.first))
        bend = al.neg(al.mul(al.mul(al.TWO, slid), motions.turning[slide.other(inside)].first))
        return self._closing(assembly, gap, Own(symbol, along, al.ONE), (negative(turned(d)),), bend, "")

    def _closing(
        self, assembly: Assembly, gap: PointRate, own: Own, asked: tuple[Vector, ...], bend: Node, point: str
    ) -> Closing:
        rates = [f"{own.symbol}{part}" for part in COEFFICIENTS]
        first = without(gap.first, rates)
        if len(assembly) == 1:
            return Closing(gap, PointRate(first, without(gap.second, rates)), bend, asked, own, point)
        # what is driven in the link itself moves with its angular velocity, too: that stays where it stands
        return Closing(gap, PointRate(first, without(gap.second, rates[1:])), al.ZERO, asked, own)

    def _at_pin(self, point: str, one: Assembly, other: Assembly) -> Closing:
        motions = self.motions
        there = motions.motion[motions.with_point(other, point)](self.poses.xy[point])
        here = self._at(point, other)
        if one:
            here = motions.motion[motions.with_point(one, point)](self.poses.xy[point])
        gap = PointRate(minus(here.first, there.first), minus(here.second, there.second))
        return Closing(gap, gap, al.ZERO, SIDES, None)

    def _tied(self, relation: Relation) -> Closing:
        """A gear, a belt or a rack; the gap of a gear as a length: over the largest one."""
        terms = terms_of(relation)
        rates = {name: self.motions.of_tie(name, self._slid) for name in terms}
        first, second = (
            al.total(al.mul(factor, getattr(rates[name], part)) for name, factor in terms.items())
            for part in ("first", "second")
        )
        rack = isinstance(relation, Rack)
        size = al.ONE if rack else self.poses.ledger.size()
        free = PointRate((first, al.ZERO), (second, al.ZERO))
        gap = PointRate((al.mul(size, first), al.ZERO), (al.mul(size, second), al.ZERO))
        return Closing(gap, free, al.ZERO, SIDES[:1], None, power=1 if rack else 0)

    def _slid(self, symbol: str) -> Rate:
        driven = symbol in self.poses.mechanism.driven_symbols
        return self.motions.rates.of_drive(symbol) if driven else self.motions.rates.of(symbol)


def known_sides(closing: Closing, free: Vector, order: int) -> list[Node]:
    """The right sides -F' (`order` 1) or -F'' (2) of its equations; `free`: the closing's, the rates looked for left out."""
    bend = closing.bend if order == 2 else al.ZERO
    return [al.sub(dot(negative(asked), free), bend) for asked in closing.asked]


def own_rate(own: Own, free: Vector) -> Node:
    """The rate of a link between two carriers, over those of the unknowns."""
    return al.div(dot(negative(own.along), free), own.square)


def solved(system: System, right: Sequence[Node], transposed: bool = False) -> Cramer:
    """J d = right, or J^T d = right. Minors of J alone that the last pass has are read there; the others are new."""
    matrix = [list(row) for row in (zip(*system.jacobian, strict=True) if transposed else system.jacobian)]
    found = cramer(matrix, right)
    tail = system.determinant.removeprefix("det")
    there = set() if transposed else {each.symbol for each in system.body}
    kept = {name: f"{name}{tail}" for name, _ in found.minors if name[0] in "SC" and f"{name}{tail}" in there}
    return Cramer(
        tuple((name, renamed(node, kept)) for name, node in found.minors if name not in kept),
        Symbol(system.determinant),
        tuple(renamed(node, kept) for node in found.numerators),
    )


def dead(system: System, slides: Sequence[bool], size: Node, split: Callable[[Node], Node]) -> Condition:
    """|det J| against the product of the sizes of its rows (Hadamard): what a sine is between two directions.

    slides  of each unknown, whether it is a displacement: it counts by the largest length `size`;  split  a column where
    a row's size is long
    """
    sizes: list[Node] = []
    for row in system.jacobian:
        parts = [
            al.mul(size, Call("ABS", (part,))) if slide else Call("ABS", (part,))
            for part, slide in zip(row, slides, strict=True)
            if not al.is_zero(part)
        ]
        sizes.append(al.total(parts) if len(system.jacobian) < 3 else split(al.total(parts)))
    margin: Node = Call("ABS", (Symbol(system.determinant),))
    least = al.number(DEAD)
    for each in sizes:
        least = al.mul(least, each)
    for _ in filter(None, slides):
        margin = al.mul(margin, size)
    return Condition(margin, least)


def without(vector: Vector, names: Iterable[str]) -> Vector:
    """The vector where some symbols are 0."""
    zero = frozenset(names)

    def change(part: Node) -> Node:
        match part:
            case Symbol(name):
                return al.ZERO if name in zero else part
            case NodeBinary("^", base, Number(_)) if al.is_zero(base):
                return base
        return al.tidied(part)

    return transform(vector[0], change), transform(vector[1], change)


class ChainColumns:
    """Of one group."""

    def __init__(
        self, columns: RateColumns, system: System, closings: Sequence[Closing], points: dict[str, PointRate]
    ) -> None:
        """`points`: the rates of points that have columns; more are added."""
        self.columns, self.system, self.closings, self.points = columns, system, closings, points
        self.owns = [(place, closing.own) for place, closing in enumerate(closings) if closing.own is not None]
        self.gaps: list[Vector] = [NOWHERE] * len(closings)

    def write(self) -> tuple[Symbol, list[str]]:
        """D, and the symbols of which there are coefficients now."""
        system, columns = self.system, self.columns
        slides = [not turns for turns in columns.ledger.turning(system)]
        columns.angles.update(name for name, slide in zip(system.variables, slides, strict=True) if not slide)
        label = phrase("determinant")
        alive = dead(system, slides, columns.ledger.size(), lambda node: columns.define("r", node, NUMBER, label))
        det = columns.define("D", Symbol(system.determinant), NUMBER, label, alive)
        for order in (1, 2):
            names = [f"{name}{COEFFICIENTS[order - 1]}" for name in system.variables]
            self._unknowns(det, names, order)
            for place, own in self.owns:
                self._own(place, own, names, order)
        for closing in self.closings:
            if closing.point:
                parts = [[Symbol(f"{closing.point}.{axis}{part}") for axis in "xy"] for part in COEFFICIENTS]
                self.points[closing.point] = PointRate((parts[0][0], parts[0][1]), (parts[1][0], parts[1][1]))
        return det, [*system.variables, *(own.symbol for _, own in self.owns)]

    def _unknowns(self, det: Symbol, names: Sequence[str], order: int) -> None:
        columns = self.columns
        label = phrase("newton_minor")
        found = solved(self.system, self._right_sides(names, order))
        minors = {name: columns.define(name, node, NUMBER, label).name for name, node in found.minors}
        for name, node in zip(self.system.variables, found.numerators, strict=True):
            numerator = columns.within(renamed(node, minors), "n", NUMBER, label)
            columns.coefficient(name, order, al.div(numerator, det))

    def _right_sides(self, names: Sequence[str], order: int) -> list[Node]:
        """-F' or -F''; each is read for every unknown: in columns, unless it is simple."""
        found: list[Node] = []
        for place, closing in enumerate(self.closings):

            def write(free: Vector, closing: Closing = closing) -> list[Node]:
                return known_sides(closing, free, order)

            self.gaps[place] = self._short(place, order, without(self._free(place, order), names), write)
            for node in write(self.gaps[place]):
                base = f"{'uk'[order - 1]}{len(found) + 1}"
                label = phrase("known_side_of", number=str(len(found) + 1), order=order_words(order))
                found.append(self.columns.hoist(base, node, self._unit(closing, order), label))
        return found

    def _own(self, place: int, own: Own, names: Sequence[str], order: int) -> None:
        """The rate of a link between two carriers, when those of the unknowns are known: they add what is linear in them."""
        free: list[Node] = []
        for known, whole in zip(self.gaps[place], self._free(place, order), strict=True):
            free.append(al.total([known, *(al.mul(derivative(whole, name), Symbol(name)) for name in names)]))

        def write(gap: Vector) -> list[Node]:
            return [own_rate(own, gap)]

        gap = free[0], free[1]
        point = self.closings[place].point
        if point:
            gap = negative(self.columns.point(point, order, minus(NOWHERE, gap)))
        else:
            gap = self._short(place, order, gap, write)
        self.columns.coefficient(own.symbol, order, own_rate(own, gap))

    def _free(self, place: int, order: int) -> Vector:
        return self.closings[place].free.of(order)

    def _short(self, place: int, order: int, gap: Vector, write: Callable[[Vector], list[Node]]) -> Vector:
        """The gap between the two ways to a place, in columns where what is written with it becomes long."""
        if max(map(self.columns.length, write(gap))) <= LONGEST:
            return gap
        number, words = str(place + 1), order_words(order)
        return self.columns.hoist_vector(
            f"g{number}", gap, order, lambda axis: phrase("gap_part", number=number, axis=axis, order=words)
        )

    def _unit(self, closing: Closing, order: int) -> Unit:
        """Of an equation: a distance is asked as a square, an offset or a pin as a length, a gear as an angle."""
        squared = closing.own is not None and closing.own.square != al.ONE
        return self.columns.unit(2 if squared else closing.power, order)

"""The equations of a group of class III or higher: its carriers, what its other links ask of them, and their derivatives.

    distance of two pins P, Q of a link l      F = ((xP - xQ)^2 + (yP - yQ)^2 - l^2) / 2,   dF = (P - Q) . (dP - dQ)
    distance of a pin P from a line along d    F = d x (P - B) - h,                         dF = d x (dP - dB)
    a pin between two carriers                 F = P - Q, both parts,                       dF = dP - dQ

B being the place at P of the link that carries the line. A place P of a carrier moves with one unknown alone by
dP = J (P - A) for the angle about its pin A (J turns by a right angle), by the line's direction for the displacement along
it; with the unknown of a carrier below, as the pin A moves, or as the carrier below does where it slides on that one.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Call, Node, Number, Symbol, renamed, symbols
from livesheet.formula.vectors import NOWHERE, Vector, cross, dot, minus, negative, turned
from livesheet.said import Words
from mechsheet.kinematics.equations import Condition, Equation, System
from mechsheet.kinematics.gear_relations import terms_of
from mechsheet.kinematics.graph import Assembly
from mechsheet.kinematics.newton.chains import Binary, Carrier, Chain
from mechsheet.kinematics.newton.system import CLOSED
from mechsheet.kinematics.poses import Guide, Poses
from mechsheet.model import Rack, Relation
from mechsheet.units import ANGLE, LENGTH, NUMBER, Unit
from mechsheet.words.equations import body_words, link_words, phrase, several

ITERATED = "{symbol} n"
"""The symbol of a quantity within a pass, before it is asked whether it fits (no description can use a blank in a name)."""


@dataclass(frozen=True, slots=True)
class Demand:
    """One equation: F, its derivative by each unknown, and the power of a length that it has."""

    value: Node
    slopes: tuple[Node, ...]
    power: int
    label: Words


@dataclass(frozen=True, slots=True)
class Span:
    """From the first to the second pin of a link between two carriers: the way over its columns, and its length."""

    way: Vector
    length: Node


@dataclass(frozen=True, slots=True)
class Solution:
    """A group that has been written down.

    spans  of each link between carriers that has two pins, by its assembly
    """

    chain: Chain
    system: System
    label: Words
    pins: tuple[str, ...]
    spans: Mapping[Assembly, Span]


class ChainWriter:
    """Writes one group into the ledger."""

    def __init__(self, poses: Poses, chain: Chain) -> None:
        self.poses, self.ledger, self.chain = poses, poses.ledger, chain
        self.carrier = {body: each for each in chain.carriers for body in each.assembly}
        self.variables: dict[Assembly, str] = {}
        self.guides: dict[Assembly, Guide] = {}
        self.lengths: dict[Assembly, Node] = {}
        self.spans: dict[Assembly, Span] = {}

    def write(self) -> Solution:
        """Carriers, equations, passes; then the poses of the links between them."""
        ledger = self.ledger
        start = len(ledger.columns)
        mode = ledger.mode()
        self.poses.to_close = frozenset(point for point, _, _ in self.chain.shut)
        for carrier in self.chain.carriers:
            self._reach(carrier)
        demands = [self._asked(each) for each in self.chain.binaries]
        demands += [demand for shut in self.chain.shut for demand in self._closed(*shut)]
        demands += [self._tied(relation) for relation in self.chain.relations]
        self.poses.to_close = frozenset()
        system = self._system(start, demands, mode.name)
        for binary in self.chain.binaries:
            self._pose(binary)
        for base, symbol in (("residual", system.residual), ("det", system.determinant)):
            ledger.column(base, Symbol(symbol), NUMBER, phrase(f"newton_{base}"))
        links = several(self.poses.name(each) for each in self.chain.assemblies)
        pins = tuple(dict.fromkeys(point for body in self.chain.bodies for point in self._joints(body)))
        label = phrase("group_pins", links=links, pins=", ".join(pins)) if pins else links
        return Solution(self.chain, system, label, pins, self.spans)

    def _joints(self, body: str) -> list[str]:
        graph = self.poses.graph
        return [point for point in graph.points[body] if len(graph.bodies_at(point)) > 1]

    # --- carriers -----------------------------------------------------------------------------------------------

    def _reach(self, carrier: Carrier) -> None:
        """Its angle or displacement, as a number for now, and with it its pose and points."""
        poses, assembly = self.poses, carrier.assembly
        joint = carrier.reached
        if isinstance(joint, str):
            body = assembly[0]
            link = poses.links.get(body)
            symbol = link.angle_symbol if link else self.ledger.reserve(f"delta_{poses.graph.blocks[body].symbol}")
            if link:
                words = phrase("angle_of_link", number=str(link.number), link=link_words(link))
            else:
                words = phrase("angle_of", link=poses.name((body,)))
            self.ledger.define(symbol, Number(0.0), ANGLE, words, "variable" if link else "intermediate")
            poses.fix(assembly, Angle(Symbol(symbol)), poses.point(assembly, joint), *poses.xy[joint])
        else:
            guide = poses.guide(joint, assembly)
            symbol = guide.symbol
            poses.displacement(symbol, Number(0.0))
            self.guides[assembly] = guide
            poses.fix_on_guide(assembly, guide, Symbol(symbol))
        self.variables[assembly] = symbol

    def _moves(self, body: str, place: Vector, unknown: Assembly) -> Vector:
        """How a place of a body moves with the unknown of a carrier alone."""
        carrier = self.carrier.get(body)
        if carrier is None:
            return NOWHERE
        joint = carrier.reached
        own = carrier.assembly == unknown
        if isinstance(joint, str):
            pin = self.poses.xy[joint]
            return (
                turned(minus(place, pin)) if own else self._moves(self._holder(joint, carrier.assembly), pin, unknown)
            )
        if own:
            guide = self.guides[carrier.assembly]
            return guide.direction if guide.sign > 0 else negative(guide.direction)
        return self._moves(joint.beyond(carrier.assembly), place, unknown)

    def _holder(self, point: str, but: Assembly = ()) -> str:
        """The body, known or a carrier, with which the point was found."""
        return holder(self.poses, self.chain, point, but)

    # --- what is asked ------------------------------------------------------------------------------------------

    def _asked(self, binary: Binary) -> Demand:
        """The equation of a link with two joints."""
        poses, assembly, first, second = self.poses, binary.assembly, binary.pin, binary.other
        p, body_p = poses.xy[first], self._holder(first, assembly)
        if isinstance(second, str):
            q, body_q = poses.xy[second], self._holder(second, assembly)
            length, _ = poses.arm(assembly, first, second)
            self.lengths[assembly] = length
            way = minus(p, q)
            value = al.div(al.sub(al.total(map(al.square, way)), al.square(length)), al.TWO)
            slopes = tuple(
                dot(way, minus(self._moves(body_p, p, each), self._moves(body_q, q, each))) for each in self.unknowns
            )
            label = phrase("newton_distance", start=first, end=second, link=poses.name(assembly))
            return Demand(value, slopes, 2, label)
        guide = poses.guide(second, assembly)
        self.guides[assembly] = guide
        carrier, direction = second.beyond(assembly), guide.direction
        offset = (poses.point(assembly, first) - guide.moving).turned(guide.angle - guide.delta)[1]
        value = al.sub(cross(direction, minus(p, (guide.x, guide.y))), offset)
        slopes = tuple(
            cross(direction, minus(self._moves(body_p, p, each), self._moves(carrier, p, each)))
            for each in self.unknowns
        )
        return Demand(value, slopes, 1, phrase("newton_offset", point=first, symbol=second.joint.symbol))

    def _closed(self, point: str, one: Assembly, other: Assembly) -> list[Demand]:
        """Both parts of a pin between two carriers, or between one and what is known."""
        poses = self.poses
        bodies = [
            next((body for body in assembly if point in poses.graph.points[body]), "") or self._holder(point)
            for assembly in (one, other)
        ]
        pose = poses.known[bodies[1]]
        x, y = (poses.own_point(bodies[1], point) - pose.base).turned(pose.angle)
        there = al.add(pose.x, x), al.add(pose.y, y)
        here = poses.xy[point]
        gap = minus(here, there)
        moved = [
            minus(self._moves(bodies[0], here, each), self._moves(bodies[1], there, each)) for each in self.unknowns
        ]
        return [
            Demand(
                gap[axis], tuple(each[axis] for each in moved), 1, phrase("newton_pin", point=point, axis="xy"[axis])
            )
            for axis in (0, 1)
        ]

    def _tied(self, relation: Relation) -> Demand:
        """The equation of a gear, a belt or a rack: angles and displacements are unknowns, or known."""
        terms = terms_of(relation)
        parts = [al.mul(factor, self._angle_or_way(name)) for name, factor in terms.items()]
        slopes = [
            al.total(factor for name, factor in terms.items() if self._moved_by(name) == unknown)
            for unknown in self.unknowns
        ]
        power = 1 if isinstance(relation, Rack) else 0
        names = several(body_words(self.poses.mechanism, name) for name in (relation.link, *self._others(relation)))
        return Demand(al.sub(al.total(parts), relation.phase), tuple(slopes), power, phrase("newton_tie", links=names))

    def _others(self, relation: Relation) -> tuple[str, ...]:
        return (relation.arm,) if isinstance(relation, Rack) else (relation.on, relation.arm)

    def _angle_or_way(self, name: str) -> Node:
        return self.poses.known[name].angle.expression() if name in self.poses.graph.bodies else Symbol(name)

    def _moved_by(self, name: str) -> Assembly:
        """The carrier whose unknown an angle, or a displacement, follows; nothing for what is known."""
        if name not in self.poses.graph.bodies:
            return next((assembly for assembly, symbol in self.variables.items() if symbol == name), ())
        carrier = self.carrier.get(name)
        if carrier is None:
            return ()
        joint = carrier.reached
        return carrier.assembly if isinstance(joint, str) else self._moved_by(joint.beyond(carrier.assembly))

    @property
    def unknowns(self) -> tuple[Assembly, ...]:
        """The carriers, each with one unknown."""
        return tuple(each.assembly for each in self.chain.carriers)

    # --- the system ---------------------------------------------------------------------------------------------

    def _system(self, start: int, demands: Sequence[Demand], mode: str) -> System:
        """Put the passes before the columns that were written from `start` on, and let these read what they arrive at."""
        ledger = self.ledger
        variables = tuple(self.variables[each] for each in self.unknowns)
        written = ledger.columns[start:]
        iterated = {name: ITERATED.format(symbol=name) for name in variables}
        read = {name for demand in demands for node in (demand.value, *demand.slopes) for name in symbols(node)}
        needed: set[str] = set()
        for equation in reversed(written):
            if equation.symbol in read:
                needed.add(equation.symbol)
                read.update(equation.reads)
        moving = set(variables)
        for equation in written:
            if not moving.isdisjoint(equation.reads):
                moving.add(equation.symbol)
                if equation.symbol in needed:
                    iterated[equation.symbol] = ITERATED.format(symbol=equation.symbol)
        body = [
            replace(_reading(each, iterated), symbol=iterated[each.symbol], role="iteration")
            for each in written
            if each.symbol in iterated and each.symbol not in variables
        ]
        count = len(variables)
        names = [self._name("F", row) for row in range(1, count + 1)]
        entries = [[self._name("J", row, column) for column in range(1, count + 1)] for row in range(1, count + 1)]
        size = ledger.size()
        jacobian: list[list[Node]] = []
        for row, demand in enumerate(demands):
            unit = self._unit(demand.power)
            body.append(self._part(names[row], renamed(demand.value, iterated), unit, demand.label))
            slopes: list[Node] = []
            for column, slope in enumerate(demand.slopes):
                node = renamed(slope, iterated)
                if not al.is_simple(node):
                    label = phrase("newton_slope", row=str(row + 1), symbol=variables[column])
                    body.append(self._part(entries[row][column], node, self._unit(demand.power), label))
                    node = Symbol(entries[row][column])
                slopes.append(node)
            jacobian.append(slopes)
        found: Cramer = cramer(jacobian, [Symbol(name) for name in names])
        minors = {name: self._name(name) for name, _ in found.minors}
        for name, node in found.minors:
            body.append(self._part(minors[name], renamed(node, minors), NUMBER, phrase("newton_minor")))
        determinant, residual = self._name("det"), self._name("residual")
        det = self._part(determinant, renamed(found.determinant, minors), NUMBER, phrase("newton_det"))
        largest = al.largest([
            al.div(Call("ABS", (Symbol(name),)), (al.ONE, size, al.square(size))[demand.power])
            for name, demand in zip(names, demands, strict=True)
        ])  # fmt: skip
        body += [det, self._part(residual, largest, NUMBER, phrase("newton_residual"))]
        system = System(
            tuple(iterated[name] for name in variables), variables, tuple(body), tuple(names),
            tuple(tuple(row) for row in jacobian), determinant, residual,
            tuple(al.div(renamed(node, minors), Symbol(determinant)) for node in found.numerators),
            _given(body, iterated), mode, ledger.driver, periodic=not self.chain.relations,
        )  # fmt: skip
        fits = Condition(al.sub(al.number(CLOSED), Symbol(residual)), al.ZERO)
        heads = [
            replace(each, symbol=iterated[each.symbol], expression=root, role="iteration")
            for root, each in zip(system.roots(), (ledger.of(name) for name in variables), strict=True)
        ]
        after = [
            replace(each, expression=Symbol(iterated[each.symbol]), exists=(fits,))
            if each.symbol in variables
            else each
            for each in written
            if each.symbol in moving
        ]
        before = [each for each in written if each.symbol not in moving]
        ledger.columns[start:] = [*before, *heads, *body, *after]
        for each in (*heads, *body):  # until the passes have been made
            ledger.values[each.symbol] = np.zeros(ledger.rows)
        return system

    def _part(self, symbol: str, node: Node, unit: Unit, label: Words) -> Equation:
        return Equation(symbol, node, "iteration", unit, label, self.ledger.group)

    def _name(self, base: str, *places: int) -> str:
        """F_1 of the first group, F_1_2 of the second: as headings have it, F with subscripts."""
        numbers = [*places, self.ledger.group] if self.ledger.group > 1 else places
        return ITERATED.format(symbol="_".join((base, *(str(number) for number in numbers))))

    def _unit(self, power: int) -> Unit:
        length = self.poses.mechanism.length_unit
        return Unit("number", length + {1: "", 2: "²"}[power]) if power else NUMBER

    # --- the links between the carriers ---------------------------------------------------------------------------

    def _pose(self, binary: Binary) -> None:
        """Between its pins, or along its line."""
        poses, assembly, first, second = self.poses, binary.assembly, binary.pin, binary.other
        p = poses.xy[first]
        place = poses.point(assembly, first)
        if isinstance(second, str):
            q = poses.xy[second]
            _, line = poses.arm(assembly, first, second)
            words = phrase("direction_of", what=f"{first}→{second}")
            name = f"{first}{second}"
            s_x, s_y = (
                self.ledger.hoist(
                    f"s_{axis}_{name}", part, LENGTH, phrase("part_of_way", start=first, end=second, axis=axis)
                )
                for axis, part in zip("xy", minus(q, p), strict=True)
            )
            self.spans[assembly] = Span((s_x, s_y), self.lengths[assembly])
            phi = self.ledger.direction(f"phi_{name}", s_x, s_y, words)
            poses.fix(assembly, Angle(phi) - line, place, *p)
            return
        guide = self.guides[assembly]
        x, y = (place - guide.moving).turned(guide.angle)
        way = minus(minus(p, (guide.x, guide.y)), (x, y))
        poses.displacement(guide.symbol, guide.signed(dot(way, guide.direction)))
        poses.fix(assembly, guide.angle, place, *p)


def holder(poses: Poses, chain: Chain, point: str, but: Assembly = ()) -> str:
    """The body that a point of a group was found with: one solved before, else the first carrier that has it."""
    bodies = [body for body in poses.graph.bodies_at(point) if body not in but]
    known = [body for body in bodies if body in chain.known]
    return (known or [body for carrier in chain.carriers for body in carrier.assembly if body in bodies])[0]


def _given(body: Sequence[Equation], iterated: dict[str, str]) -> tuple[str, ...]:
    """What the body reads besides itself and the unknowns."""
    own = {*iterated.values(), *(equation.symbol for equation in body)}
    found = dict.fromkeys(name for equation in body for name in equation.reads)
    return tuple(name for name in found if name not in own)


def _reading(equation: Equation, names: dict[str, str]) -> Equation:
    return replace(
        equation,
        expression=renamed(equation.expression, names),
        exists=tuple(replace(each, margin=renamed(each.margin, names)) for each in equation.exists),
    )


# --- J^-1 F in formulas ------------------------------------------------------------------------------------

Matrix = Sequence[Sequence[Node]]


@dataclass(frozen=True, slots=True)
class Cramer:
    """The determinant of J, and what is divided by it; `minors` are named parts that they read."""

    minors: tuple[tuple[str, Node], ...]
    determinant: Node
    numerators: tuple[Node, ...]


def cramer(matrix: Matrix, right: Sequence[Node]) -> Cramer:
    """The solution of  matrix d = right: Cramer's rule for up to three unknowns, minors of two rows (Laplace) for four."""
    if len(matrix) == 4:
        return _four(matrix, right)
    columns = range(len(matrix))
    numerators = (
        _determinant([[right[row] if at == column else matrix[row][at] for at in columns] for row in columns])
        for column in columns
    )
    return Cramer((), _determinant(matrix), tuple(numerators))


def _determinant(m: Matrix) -> Node:
    if len(m) == 1:
        return m[0][0]
    if len(m) == 2:
        return al.sub(al.mul(m[0][0], m[1][1]), al.mul(m[0][1], m[1][0]))
    parts = [al.mul(m[0][at], _determinant([[*row[:at], *row[at + 1 :]] for row in m[1:]])) for at in range(3)]
    return al.add(al.sub(parts[0], parts[1]), parts[2])


_PAIRS = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))


def _four(m: Matrix, right: Sequence[Node]) -> Cramer:
    """By the minors of the upper and of the lower two rows. Source: D. Eberly, The Laplace Expansion Theorem."""
    minors: list[tuple[str, Node]] = []

    def minor(letter: str, top: int, pair: tuple[int, int]) -> Node:
        i, j = pair
        node = al.sub(al.mul(m[top][i], m[top + 1][j]), al.mul(m[top + 1][i], m[top][j]))
        if al.is_simple(node):
            return node
        name = f"{letter}{i + 1}{j + 1}"
        minors.append((name, node))
        return Symbol(name)

    s = [minor("S", 0, pair) for pair in _PAIRS]
    c = [minor("C", 2, pair) for pair in _PAIRS]

    def combined(*terms: tuple[int, Node, Node]) -> Node:
        total: Node = al.ZERO
        for sign, one, other in terms:
            part = al.mul(one, other)
            total = al.add(total, part) if sign > 0 else al.sub(total, part)
        return total

    determinant = combined((1, s[0], c[5]), (-1, s[1], c[4]), (1, s[2], c[3]),
                           (1, s[3], c[2]), (-1, s[4], c[1]), (1, s[5], c[0]))  # fmt: skip
    f = right
    # the minors of pairs of rows with the right side in them: u of the upper two rows, w of the lower two
    u = [al.sub(al.mul(f[0], m[1][at]), al.mul(f[1], m[0][at])) for at in range(4)]
    w = [al.sub(al.mul(f[2], m[3][at]), al.mul(f[3], m[2][at])) for at in range(4)]
    named: list[list[Node]] = []
    for letter, nodes in (("U", u), ("W", w)):
        row: list[Node] = []
        for at, node in enumerate(nodes):
            if not al.is_simple(node):
                minors.append((f"{letter}{at + 1}", node))
                node = Symbol(f"{letter}{at + 1}")
            row.append(node)
        named.append(row)
    upper, lower = named
    numerators = (
        combined((1, upper[1], c[5]), (-1, upper[2], c[4]), (1, upper[3], c[3]),
                 (1, s[3], lower[3]), (-1, s[4], lower[2]), (1, s[5], lower[1])),
        combined((-1, upper[0], c[5]), (1, upper[2], c[2]), (-1, upper[3], c[1]),
                 (-1, s[1], lower[3]), (1, s[2], lower[2]), (-1, s[5], lower[0])),
        combined((1, upper[0], c[4]), (-1, upper[1], c[2]), (1, upper[3], c[0]),
                 (1, s[0], lower[3]), (-1, s[2], lower[1]), (1, s[4], lower[0])),
        combined((-1, upper[0], c[3]), (1, upper[1], c[1]), (-1, upper[2], c[0]),
                 (-1, s[0], lower[2]), (1, s[1], lower[1]), (-1, s[3], lower[0])),
    )  # fmt: skip
    return Cramer(tuple(minors), determinant, numerators)

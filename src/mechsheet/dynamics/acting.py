"""What acts on each body: its weight and inertia, loads, and what the groups solved before it exert; its sum and its moment.

    S = m (g - a_G) + sum of F,      M(X) = (G-X) x S + sum of (p-G) x F + sum of T - J alpha

with all else gathered in G, so that weight and inertia need no columns beside S. Of a body without a mass centre
M(X) = sum of (p-X) x F + sum of T. Lengths times `metre` where torques are in N m.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from livesheet.formula.vectors import NOWHERE, Vector, cross, dot, minus, negative, plus, size, together
from livesheet.said import Words
from mechsheet.dynamics.columns import LONGEST, Columns
from mechsheet.kinematics.build_equations import Found
from mechsheet.kinematics.equations import Condition
from mechsheet.kinematics.points_in_link import PointInLink, PointsInLink, cartesian
from mechsheet.kinematics.poses import Poses
from mechsheet.kinematics.rates.motions import Motions
from mechsheet.model import GivenPoint, Link, Load, Mass, Spring, center_symbol
from mechsheet.units import LENGTH, Unit
from mechsheet.words.equations import body_words, link_words, phrase


@dataclass(frozen=True, slots=True)
class Force:
    """A force and the place where it acts."""

    vector: Vector
    at: Vector


@dataclass
class Acting:
    """On one body. `own`: how many of the forces and couples are its weight, its inertia and its loads."""

    center: Vector | None = None
    forces: list[Force] = field(default_factory=list)
    couples: list[Node] = field(default_factory=list)
    own: tuple[int, int] = (0, 0)
    sum: Vector | None = None

    def settle(self) -> None:
        """What has come so far is the body's own."""
        self.own = (len(self.forces), len(self.couples))

    def add(self, force: Force, couple: Node = al.ZERO) -> None:
        """Count to it what is not 0."""
        if not all(map(al.is_zero, force.vector)):
            self.forces.append(force)
        if not al.is_zero(couple):
            self.couples.append(couple)


def sum_of(forces: Iterable[Force]) -> Vector:
    """All forces together."""
    return together(force.vector for force in forces)


def moment_of(forces: Iterable[Force], about: Vector) -> Node:
    """Of all forces together about a place, a force times a length."""
    return al.total(cross(minus(force.at, about), force.vector) for force in forces)


class ActingForces:
    """Of all bodies, by name; each body's own are written down when it is first asked for.

    motions  by the driver's variable
    """

    def __init__(self, found: Found) -> None:
        dynamics, motions = found.poses.mechanism.dynamics, found.rates.by_driver
        if dynamics is None or motions is None:
            raise ValueError("forces need influence coefficients, and masses or loads")
        self.found, self.dynamics, self.motions = found, dynamics, motions
        self.poses: Poses = found.poses
        self.columns = Columns(self.poses, dynamics)
        self._bodies: dict[str, Acting] = {}
        self._hung: dict[str, Acting] = {}
        self._pulls: dict[int, Vector] = {}
        self._lengths: dict[int, Node] = {}

    def of(self, body: str) -> Acting:
        """What acts on a body so far."""
        if body not in self._bodies:
            acting = self._bodies[body] = Acting()
            if body in self.poses.links:
                link = self.poses.links[body]
                for mass in self.dynamics.masses:
                    if mass.link == body:
                        self._weigh(acting, mass, link)
                for load in self.dynamics.loads:
                    if load.link == body:
                        self._load(acting, load, link)
                for spring in self.dynamics.springs:
                    for at, (name, point) in zip((0, 1), spring.ends, strict=True):
                        if name == body:
                            force = self.pull(spring)
                            force = force if at == 0 else negative(force)
                            acting.forces.append(Force(force, self.poses.xy[point]))
            acting.settle()
            hung = self._hung.pop(body, Acting())
            acting.forces += hung.forces
            acting.couples += hung.couples
        return self._bodies[body]

    def hang(self, body: str, force: Force, couple: Node = al.ZERO) -> None:
        """What a group solved before exerts on a body whose turn comes later; nothing hangs on the ground."""
        if body == self.poses.mechanism.ground.name:
            return
        known = self._bodies.get(body)
        if known is not None and known.sum is not None:
            raise ValueError(f"what acts on {body} has been summed up already")
        hung = self._hung.setdefault(body, Acting()) if known is None else known
        hung.add(force, couple)

    def total(self, body: str) -> Vector:
        """The sum of all forces on a body, which must be complete by now."""
        acting = self.of(body)
        if acting.sum is None:
            total, name = sum_of(acting.forces), f"S{self.number(body)}"
            acting.sum = self.columns.pair(name, total, self.columns.force, "sum_of_forces", link=self.words(body))
        return acting.sum

    def moment(self, body: str, about: Vector, whole: bool = False) -> Node:
        """The moment of all that acts on a body, about a place.

        whole  as an expression for a column that says nothing else, not as a column of its own
        """
        acting = self.of(body)
        forces = acting.forces
        if acting.center is not None and len(forces) > 1:
            gathered = Force(self.total(body), acting.center)
            arms = moment_of([gathered], about)
            arms = al.total([arms, *(moment_of([force], gathered.at) for force in forces)])
        elif len(forces) == 1:
            arms = moment_of([Force(self.total(body), forces[0].at)], about)
        else:
            arms = moment_of(forces, about)
        return self.torque(f"M{self.number(body)}", arms, acting.couples, self.words(body), whole)

    def torque(self, base: str, arms: Node, couples: list[Node], what: Words, whole: bool = False) -> Node:
        """metre (force times length) + couples, as a column; the first arms in columns of their own where it is long."""
        columns = self.columns
        label = phrase("sum_of_moments", link=what)
        rest = columns.lengths.of(al.total([columns.metre, *couples]))
        unit = Unit("moment", f"{self.dynamics.force_unit} {self.poses.mechanism.length_unit}")
        arms = columns.lengths.split(arms, lambda part: columns.grey(base, part, unit, label), LONGEST - rest)
        torque = al.total([al.mul(columns.metre, arms), *couples])
        return torque if whole else columns.grey(base, torque, columns.torque, label)

    def words(self, body: str) -> Words:
        """The body in words."""
        return body_words(self.poses.mechanism, body)

    def both(self, one: str, other: str) -> dict[str, Words]:
        """Who acts on whom, as the parts of a label."""
        return {"one": self.words(one), "other": self.words(other)}

    def number(self, body: str) -> str:
        """The number of a link, the symbol of a block's slide."""
        links, graph = self.poses.links, self.poses.graph
        return str(links[body].number) if body in links else graph.blocks[body].symbol

    # ---- weight and inertia

    def _weigh(self, acting: Acting, mass: Mass, link: Link) -> None:
        if mass.mass is not None:
            center = self.mass_centre(mass, link)
            vector = self.field(mass, center, link)
            if not all(map(al.is_zero, vector)):
                acting.center = center
                acting.forces.append(Force(vector, center))
        couple = self.inertia_couple(mass)
        if not al.is_zero(couple):
            acting.couples.append(couple)

    def mass_centre(self, mass: Mass, link: Link) -> Vector:
        """Where it is; in columns of its own where it is no point of the link."""
        name = center_symbol(link.number)
        known = tuple(Symbol(f"{name}.{axis}") for axis in "xy")
        if not isinstance(mass.center, str) and all(each.name in self.poses.ledger.values for each in known):
            return known[0], known[1]
        return self.place(link, mass.center, name, phrase("mass_centre", link=link_words(link)))

    def field(self, mass: Mass, center: Vector, link: Link) -> Vector:
        """m (g - a_G), the weight and the force of inertia; a_G in columns."""
        if mass.mass is None:
            return NOWHERE
        parts = self.acceleration(mass, center, link)
        found = []
        for gravity, part in zip(self.dynamics.gravity, parts, strict=True):
            both = al.mul(mass.mass, al.sub(gravity, al.mul(self.columns.metre, part)))
            found.append(al.neg(al.mul(al.mul(mass.mass, self.columns.metre), part)) if al.is_zero(gravity) else both)
        return found[0], found[1]

    def acceleration(self, mass: Mass, center: Vector, link: Link) -> Vector:
        """Of a mass centre, as columns."""
        motions: Motions | None = self.found.rates.by_time
        if motions is None:
            return NOWHERE
        named = isinstance(mass.center, str)
        if named:
            found = motions.of_point(str(mass.center), self.columns.lengths.of).second
        else:
            found = motions.motion[link.name](center).second
        name = str(mass.center) if named else center_symbol(link.number)
        unit = LENGTH.per_time().per_time()
        parts: list[Node] = []
        for axis, node in zip("xy", found, strict=True):
            symbol = f"{name}.a{axis}"
            if symbol in self.poses.ledger.values:
                parts.append(Symbol(symbol))
                continue
            label = phrase("point_a_part", point=name, axis=axis)
            parts.append(self.columns.grey(symbol, node, unit, label, own_name=True))
        return parts[0], parts[1]

    def inertia_couple(self, mass: Mass) -> Node:
        """-J alpha."""
        motions = self.found.rates.by_time
        if mass.inertia is None or motions is None:
            return al.ZERO
        return al.neg(al.mul(mass.inertia, motions.turning[mass.link].second))

    # ---- loads

    def _load(self, acting: Acting, load: Load, link: Link) -> None:
        if load.torque is not None:
            label = phrase("load", name=load.name)
            acting.couples.append(self.columns.grey(load.name, load.torque, self.columns.torque, label))
        if load.force is not None:
            at = self.place(link, load.point, load.name, phrase("loaded_place", name=load.name))
            acting.forces.append(Force(self._in_ground(load, link), at))

    def _in_ground(self, load: Load, link: Link) -> Vector:
        """The components of a force in the ground's frame, as columns where they differ from row to row."""
        parts = load.force or NOWHERE
        base = load.name
        if load.in_link:
            parts = PointInLink(*parts).turned(self.poses.known[link.name].angle)
        return self.columns.pair(base, parts, self.columns.force, "load_part", name=load.name)

    def pull(self, spring: Spring) -> Vector:
        """The force of a spring on its first end, towards the second; #N/A where the two coincide.

        f = k (L - L0) + c L',    L' = (p2 - p1) . (v2 - v1) / L
        """
        if spring.order in self._pulls:
            return self._pulls[spring.order]
        columns, ledger = self.columns, self.poses.ledger
        (_, start), (_, end) = spring.ends
        way, length = minus(self.poses.xy[end], self.poses.xy[start]), self.length(spring)
        tension = al.mul(spring.stiffness, al.sub(length, spring.free_length))
        motions = self.found.rates.by_time
        if motions is not None and not al.is_zero(spring.damping):
            one, other = (motions.of_point(point, columns.lengths.of).first for point in (start, end))
            parts = columns.pair(
                f"{spring.name}_v", minus(other, one), LENGTH.per_time(), "spring_velocity", name=spring.name
            )
            tension = al.add(tension, al.div(al.mul(spring.damping, dot(way, parts)), length))
        apart = Condition(length, ledger.tolerance)
        words = phrase("spring_force", name=spring.name)
        force = ledger.define(columns.name(spring.name), tension, columns.force, words, "dynamic", [apart])
        parts = al.div(al.mul(force, way[0]), length), al.div(al.mul(force, way[1]), length)
        self._pulls[spring.order] = columns.pair(spring.name, parts, columns.force, "load_part", name=spring.name)
        return self._pulls[spring.order]

    def length(self, spring: Spring) -> Node:
        """How long a spring is, as a column."""
        if spring.order not in self._lengths:
            (_, start), (_, end) = spring.ends
            label = phrase("spring_length", name=spring.name, start=start, end=end)
            length = size(minus(self.poses.xy[end], self.poses.xy[start]))
            self._lengths[spring.order] = self.columns.grey(f"{spring.name}_l", length, LENGTH, label)
        return self._lengths[spring.order]

    # ---- places

    def place(self, link: Link, given: str | GivenPoint, name: str, label: Words) -> Vector:
        """Coordinates of a point, or of a place in a link's frame."""
        if isinstance(given, str):
            return self.poses.xy[given]
        own = PointsInLink(Link(link.name, link.number, {**link.points, name: given}, link.label), self.poses.ledger)
        pose = self.poses.known[link.name]
        way = own.point(name) - pose.base
        if not pose.base.is_zero and self.poses.ledger.is_constant(al.add(way.u, way.v)):
            # in cells of its own: each of the two is read twice
            words = phrase("way_in_link", point=name, link=link_words(link))
            u = self.columns.grey(f"u_{name}", way.u, LENGTH, words)
            way = cartesian(u, self.columns.grey(f"v_{name}", way.v, LENGTH, words))
        x, y = way.turned(pose.angle)
        parts = []
        for axis, node in zip("xy", plus((pose.x, pose.y), (x, y)), strict=True):
            symbol = f"{name}.{axis}"
            words = phrase("part_of", what=label, axis=axis)
            parts.append(
                self.columns.grey(symbol, node, LENGTH, words, own_name=symbol not in self.poses.ledger.values)
            )
        return parts[0], parts[1]

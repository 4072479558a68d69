"""Forces of gears, belts and racks: what holds the bodies that they decide.

A tie is a condition sum of A v = phase on angles and displacements v. What it exerts along v is A lambda, and for each v
that it decides, with Q all else that acts along it,

    sum of A lambda + Q = 0

lambda of a gear is its torque on `link`. Two wheels touch at the pitch point C, which divides the line of their axes; with
e from the axis of `on` to that of `link`, L its length, n = J e, and i the ratio

    C = O_on + i L e / (i - 1),    force on `link`: t n - sign(i) |t| tan(pressure angle) e,    t = lambda (i - 1) / L

On a rack t = lambda along its line, and C lies the pitch radius away from the pinion's axis. Of a belt, and of wheels
about one axis, only the torque is known: what the pretension adds to the pins is not.
Source: Shigley, Mechanical Engineering Design, force analysis of spur gears; virtual work.
"""

from __future__ import annotations

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node
from livesheet.formula.vectors import NOWHERE, Vector, dot, minus, negative, plus, times, turned
from mechsheet.dynamics.acting import ActingForces, Force, moment_of, sum_of
from mechsheet.dynamics.joints import Joints
from mechsheet.kinematics.gear_relations import Held, Tied, axis_of, eliminated, terms_of
from mechsheet.kinematics.graph import Slide
from mechsheet.model import Gear, Rack, Relation, pair_symbol
from mechsheet.units import LENGTH
from mechsheet.words.equations import phrase

ALIKE = 1e-9
"""A ratio that differs from 1 by less: the wheels turn alike, and their pitch point is far away."""


class Teeth:
    """Of one mechanism."""

    def __init__(self, acting: ActingForces, joints: Joints) -> None:
        self.acting, self.joints, self.columns = acting, joints, acting.columns
        self.poses, self.graph, self.motions = acting.poses, acting.poses.graph, acting.motions

    def write(self, tied: Tied) -> None:
        """The forces of the ties of a step, then those by which its bodies are held."""
        for relation, effort in zip(tied.relations, self._efforts(tied), strict=True):
            self.exert(relation, effort)
        for held in reversed(tied.bodies):
            total = negative(self.acting.total(held.body))
            if isinstance(held.at, Slide):
                at = self._place(held)
                normal = dot(total, turned(self.motions.direction(held.at)))
                self.joints.slide(held.at, held.body, normal, al.neg(self.acting.moment(held.body, at)), at)
            else:
                self.joints.outer(held.at, held.body, total)

    # --- lambda -----------------------------------------------------------------------------------------------

    def _place(self, held: Held) -> Vector:
        """Where a body is held."""
        return self.poses.xy[held.at.joint.point if isinstance(held.at, Slide) else held.at]

    def _efforts(self, tied: Tied) -> list[Node]:
        known = {held.variable: self._along(tied, held) for held in tied.bodies}
        rows = []
        for variable, effort in known.items():
            terms = {
                str(number): self._coefficient(relation, variable)
                for number, relation in enumerate(tied.relations)
                if variable in terms_of(relation)
            }
            rows.append((terms, al.neg(effort)))
        numbers = [str(number) for number in range(len(tied.relations))]
        found = eliminated(rows, numbers, self.poses.ledger.number)
        return [found[number] for number in numbers]

    def _coefficient(self, relation: Relation, variable: str) -> Node:
        """What a unit of lambda does along a variable: of a rack it is a force, that turns the pinion."""
        node = terms_of(relation)[variable]
        return al.mul(node, self.columns.metre) if isinstance(relation, Rack) and variable != relation.joint else node

    def _along(self, tied: Tied, held: Held) -> Node:
        """What acts along what the ties decide, but for them: on the body, and on those of the step that hang on it."""
        own = self.acting.of(held.body)
        if isinstance(held.at, Slide):
            sign = al.ONE if held.body == held.at.body else al.number(-1.0)
            return al.mul(sign, dot(sum_of(own.forces), self.motions.direction(held.at)))
        about = self._place(held)
        forces = list(own.forces)
        for other in tied.bodies:
            if other is not held and not isinstance(other.at, Slide) and self._hangs(other, held):
                forces.append(Force(sum_of(self.acting.of(other.body).forces), self._place(other)))
        name = f"Q{self.acting.number(held.body)}"
        return self.acting.torque(name, moment_of(forces, about), own.couples, self.acting.words(held.body))

    def _hangs(self, one: Held, other: Held) -> bool:
        """Whether a body is pivoted on another one of the step."""
        return isinstance(one.at, str) and one.at != other.at and one.at in self.graph.points[other.body]

    # --- what they exert --------------------------------------------------------------------------------------

    def exert(self, relation: Relation, effort: Node) -> None:
        """What a tie with this lambda exerts on the bodies that it ties."""
        if isinstance(relation, Rack):
            self._rack(relation, effort)
        elif relation.kind == "gear" and not self._one_axis(relation):
            self._gear(relation, effort)
        else:
            self._couples(relation, effort)

    def _axes(self, gear: Gear) -> tuple[Vector, Vector]:
        link, on = (axis_of(self.graph, wheel, gear.arm) for wheel in (gear.link, gear.on))
        return self.poses.xy[link], self.poses.xy[on]

    def _one_axis(self, gear: Gear) -> bool:
        """Whether the wheels have one axis, or turn alike: then there is no pitch point."""
        places = [
            self.poses.own_point(gear.arm, axis_of(self.graph, wheel, gear.arm)) for wheel in (gear.link, gear.on)
        ]
        way = places[0] - places[1]
        number = self.poses.ledger.number
        return max(abs(number(way.u)), abs(number(way.v))) == 0 or abs(number(gear.ratio) - 1) < ALIKE

    def _named(self, on: str, link: str) -> str:
        links = self.poses.links
        return pair_symbol("G", links[on].number, links[link].number)

    def _couples(self, gear: Gear, effort: Node) -> None:
        """The torques on the three links."""
        name = self._named(gear.on, gear.link)
        label = phrase("belt_torque", **self.acting.both(gear.on, gear.link))
        torque = self.columns.black(f"{name}.m", effort, self.columns.torque, label, "couple")
        for body, factor in terms_of(gear).items():
            self.acting.hang(body, Force(NOWHERE, NOWHERE), al.mul(factor, torque))

    def _gear(self, gear: Gear, effort: Node) -> None:
        link, on = self._axes(gear)
        way = minus(link, on)
        start, end = (axis_of(self.graph, wheel, gear.arm) for wheel in (gear.on, gear.link))
        length, _ = self.poses.arm((gear.arm,), start, end)
        beyond = al.sub(gear.ratio, al.ONE)
        tangent = al.div(al.mul(effort, beyond), al.mul(length, self.columns.metre))
        along = (al.div(way[0], length), al.div(way[1], length))
        away = al.neg(Call("SIGN", (gear.ratio,)))
        pitch = plus(on, times(al.div(gear.ratio, beyond), way))
        self._tooth(gear, (gear.on, gear.link), tangent, turned(along), times(away, along), pitch)

    def _rack(self, rack: Rack, effort: Node) -> None:
        """Of the pinion on the rack, which is the side of the sliding joint that is not its arm."""
        slide = self.graph.slide(rack.joint)
        bar = slide.other(rack.arm)
        sign = al.ONE if bar == slide.body else al.number(-1.0)
        d = self.motions.direction(slide)
        n = turned(d)
        axis = self.poses.xy[axis_of(self.graph, rack.link, rack.arm)]
        pitch = minus(axis, times(al.mul(sign, rack.radius), n))
        away = times(al.neg(al.mul(sign, Call("SIGN", (rack.radius,)))), n)
        self._tooth(rack, (rack.link, bar), al.mul(sign, effort), d, away, pitch)

    def _tooth(
        self, relation: Relation, links: tuple[str, str], tangent: Node, along: Vector, away: Vector, pitch: Vector
    ) -> None:
        """The force of the first link on the second: so much along the pitch line, and what pushes the two apart."""
        one, other = links
        name, columns = self._named(one, other), self.columns
        words = self.acting.both(one, other)
        t = columns.black(f"{name}.t", tangent, columns.force, phrase("tooth_tangent", **words), "normal")
        tan = al.call("TAN", relation.pressure)
        apart = al.mul(Call("ABS", (t,)), tan)
        force = columns.pair(name, plus(times(t, along), times(apart, away)), columns.force, "tooth_part", **words)
        if not al.is_zero(tangent):
            size = al.div(Call("ABS", (t,)), al.call("COS", relation.pressure))
            columns.black(name, size, columns.force, phrase("tooth_force", **words), "size")
        at = columns.pair(f"C_{name}", pitch, LENGTH, "pitch_point", **words)
        self.acting.hang(other, Force(force, at))
        self.acting.hang(one, Force(negative(force), at))

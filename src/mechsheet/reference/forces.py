"""All reactions at once: what holds the conditions of the joints, as Lagrange multipliers.

    J^T lambda = -Q        J: Jacobian of the conditions, Q: weights, forces of inertia and loads along the poses

A multiplier is the force (or torque) on the condition's body by the body `on`, along the condition: for a meeting the parts
of the pin's force, for a line the normal force, for an angle a couple, for the driven condition the driver's effort. All
are torques here: the state has its own lengths.
Source: Haug, Computer Aided Kinematics and Dynamics of Mechanical Systems, section 6.6.

The multiplier of a gear is the torque on its `link`, that of a rack the force on the joint's link along the line. A force
at the pitch point, where the two bodies move alike, does the same work; with it the pins hold what they hold in truth.
Belts, and wheels about one axis, keep their torques.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import Binary, Node, Number

from ..model import CONTACT, Cam, Dynamics, Gear, GivenPoint, Link, Mechanism, Rack, Spring, pair_symbol, touched_by
from .cams import profile
from .expressions import column as over_rows
from .expressions import number
from .geometry import ROUNDING, Array, link_points
from .rates import by_time, changes, gradients, of_poses, solved
from .solution import Solution, over_all_rows, reached
from .system import Equation, System, residual

_UNSTRETCHED = 1e-9
"""A spring whose preload presses cam and follower together by less than this part of itself does not hold them."""


def forces(solution: Solution) -> dict[str, Array]:
    """F34, F34.x, F34.y, F14.n, F14.c, F14.t, T12 by name, (n,) each; NaN in rows that do not exist.

    Nothing for a mechanism without masses and loads. Near a dead centre they grow beyond reason.
    """
    dynamics = solution.mechanism.dynamics
    if dynamics is None:
        return {}
    found = _held(solution, dynamics)
    if CONTACT in found:
        springs = _pressing_springs(solution.mechanism, dynamics)
        for spring in springs if len(springs) == 1 else ():
            found[spring.hold] = _holding(solution, dynamics, spring, found[CONTACT])
    return found


def _pressing_springs(mechanism: Mechanism, dynamics: Dynamics) -> list[Spring]:
    """Those between the ground and what the cam touches; where there are none, all that are not at the cam."""
    at_cam = [spring for spring in dynamics.springs if mechanism.cam and _is_at(spring, mechanism.cam.link)]
    near = {mechanism.ground.name, _touched(mechanism)}
    found = [spring for spring in dynamics.springs if {name for name, _ in spring.ends} == near]
    return found or [spring for spring in dynamics.springs if spring not in at_cam]


def _is_at(spring: Spring, link: str) -> bool:
    return any(name == link for name, _ in spring.ends)


def _holding(solution: Solution, dynamics: Dynamics, spring: Spring, pressed: Array) -> Array:
    """The free length with which a cam's contact force would be 0: it is linear in it, so that two of them say where."""
    by = solution.size
    longer = replace(spring, free_length=Binary("+", spring.free_length, Number(by)))
    springs = tuple(longer if each is spring else each for each in dynamics.springs)
    other = _held(solution, replace(dynamics, springs=springs))[CONTACT]
    own, stiff = (number(node, solution.dimensions) for node in (spring.free_length, spring.stiffness))
    bears = np.abs(other - pressed) > _UNSTRETCHED * abs(stiff) * by
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.where(bears, own - pressed * by / (other - pressed), np.nan)


def _held(solution: Solution, dynamics: Dynamics) -> dict[str, Array]:
    rows = np.flatnonzero(solution.exists)
    built, state = solution.system, solution.state[rows]
    equations, unknown = built.equations, built.unknown
    applied = Applied(solution, dynamics, rows)
    jacobian, _ = gradients(equations, state, np.zeros_like(state))
    cam = solution.mechanism.cam
    pressed = -1 if cam is None else next(place for place, each in enumerate(equations) if _is_follower(solution, each))
    if cam is not None:
        jacobian[:, pressed] = along_poses(applied, [_pressing(applied, cam)])
    jacobian = jacobian[:, :, unknown]
    acting = applied.along_poses()
    multipliers = solved(np.swapaxes(jacobian, 1, 2), -acting[:, unknown, None])
    ties = {each.of: value for each, value in zip(equations, multipliers.T, strict=True) if _is_tie(each)}
    at_teeth, contacts = tooth_forces(solution.mechanism, applied, ties)
    if contacts:  # with these the ties hold nothing any more, and the pins what they hold in truth
        acting = acting + along_poses(applied, contacts)
        multipliers = solved(np.swapaxes(jacobian, 1, 2), -acting[:, unknown, None])
    held = [place for place in range(len(equations)) if place != pressed]
    named = _named(solution.mechanism, built, [equations[place] for place in held], multipliers[:, held], applied)
    named |= at_teeth | ({} if cam is None else {CONTACT: multipliers[:, pressed]})
    return {name: over_all_rows(solution, rows, values) for name, values in named.items()}


def _is_follower(solution: Solution, equation: Equation) -> bool:
    """Whether it is the condition that drives what a cam moves."""
    follower = solution.mechanism.follower
    if follower is None or not follower.joint:
        return follower is not None and equation.of == f"driver {follower.symbol}"
    return equation.kind == "displacement" and equation.of == follower.joint


def _pressing(applied: Applied, cam: Cam) -> Contact:
    """A force of 1 of the cam on what it touches."""
    shape = profile(applied.solution, cam)
    at, normal = shape.at[applied.rows], shape.normal[applied.rows]
    touched = _touched(applied.solution.mechanism)
    place = (np.array([at.real, at.imag]) - applied.built.origin[:, None]) / applied.built.scale
    return Contact(touched, cam.link, np.array([normal.real, normal.imag]), place)


def _touched(mechanism: Mechanism) -> str:
    """The link on which a cam presses."""
    touched = None if mechanism.cam is None else touched_by(mechanism.cam, mechanism.links)
    return "" if touched is None else touched.name


def _is_tie(equation: Equation) -> bool:
    """Whether it is the condition of a gear, a belt or a rack."""
    return equation.of.startswith("relation ")


class Applied:
    """What is known to act, in some rows.

    unit  the torque that a unit of force does over a unit of the system's lengths
    """

    def __init__(self, solution: Solution, dynamics: Dynamics, rows: NDArray[np.intp]) -> None:
        self.solution, self.dynamics, self.rows = solution, dynamics, rows
        self.built: System = solution.system
        self.state = solution.state[rows]
        self.metre = dynamics.metre or 1.0
        self.unit = self.built.scale * self.metre
        known = reached(solution) | by_time(solution)
        self.known = {name: np.asarray(values)[rows] for name, values in known.items()}
        self.known |= {name: np.full(len(rows), value) for name, value in solution.dimensions.items()}
        self.links: Mapping[str, Link] = {link.name: link for link in solution.mechanism.links}
        driver = solution.mechanism.driver
        per = self.built.scale if driver.joint else 1.0
        moves = driver.speed is not None
        names = solution.mechanism.driver_rates
        self.speed, self.acceleration = ((self.known[name] if moves else np.zeros(len(rows))) / per for name in names)
        self.first, self.second = of_poses(self.built, self.state, solution.driver[rows])

    def along_poses(self) -> Array:
        """Q (m, columns), as torques."""
        total: Array = np.zeros_like(self.state)
        gravity = [self.values(part) for part in self.dynamics.gravity]
        for mass in self.dynamics.masses:
            if mass.mass is not None:
                weight = self.values(mass.mass)
                for axis, field in zip(self.place(mass.link, mass.center), gravity, strict=True):
                    along, acceleration = self.moved(axis)
                    total += ((field - self.unit * acceleration) * weight * self.unit)[:, None] * along
            if mass.inertia is not None:
                along, acceleration = self.moved(self.turn(mass.link))
                total += (-self.values(mass.inertia) * acceleration)[:, None] * along
        for load in self.dynamics.loads:
            if load.torque is not None:
                total += self.values(load.torque)[:, None] * self.moved(self.turn(load.link))[0]
            if load.force is not None:
                x, y = (self.values(part) for part in load.force)
                if load.in_link:
                    turned = self.state[:, self.built.column(load.link) + 2]
                    c, s = np.cos(turned), np.sin(turned)
                    x, y = x * c - y * s, x * s + y * c
                for axis, part in zip(self.place(load.link, load.point), (x, y), strict=True):
                    total += (part * self.unit)[:, None] * self.moved(axis)[0]
        for spring in self.dynamics.springs:
            for end, pull in zip(spring.ends, self._pulls(spring), strict=True):
                for axis, part in zip(self.place(*end), pull, strict=True):
                    total += (part * self.unit)[:, None] * self.moved(axis)[0]
        return total

    def _pulls(self, spring: Spring) -> tuple[Array, Array]:
        """The forces (2, m) of a spring on its two ends."""
        places, velocities = [], []
        for end in spring.ends:
            axes = self.place(*end)
            places.append(np.array([self.coordinate(axis) for axis in axes]))
            moved = [self.moved(axis)[0] for axis in axes]
            velocities.append(np.array([np.einsum("mc,mc->m", each, self.first) * self.speed for each in moved]))
        scale = self.built.scale
        way, opens = (places[1] - places[0]) * scale, (velocities[1] - velocities[0]) * scale
        length = np.hypot(*way)
        length = np.where(length > ROUNDING * self.solution.size, length, np.nan)  # ends that coincide: no direction
        with np.errstate(invalid="ignore", divide="ignore"):
            stretched = self.values(spring.stiffness) * (length - self.values(spring.free_length))
            pull = (stretched + self.values(spring.damping) * (way * opens).sum(axis=0) / length) * way / length
        return pull, -pull

    def coordinate(self, axis: Equation) -> Array:
        """The value of a place's coordinate, in the system's own lengths, counted from its origin."""
        value, _ = residual(axis, self.state, np.zeros(len(self.state)))
        return value

    def values(self, node: Node) -> Array:
        """Of an expression, row by row."""
        return over_rows(node, self.known, len(self.rows))

    def place(self, link: str, given: str | GivenPoint) -> tuple[Equation, Equation]:
        """The coordinates of a place of a link, as conditions whose residuals they are."""
        own = self.links[link]
        if isinstance(given, str):
            spot = self.built.points[link][given]
        else:
            spot = link_points(replace(own, points={**own.points, "": given}), self.solution.dimensions)[""]
        body, place = self.built.bodies[link], self.built.local(link, spot)
        return Equation("meet x", body, 0, place), Equation("meet y", body, 0, place)

    def turn(self, link: str) -> Equation:
        """The angle of a link, likewise."""
        return Equation("angle", self.built.bodies[link], 0)

    def moved(self, quantity: Equation) -> tuple[Array, Array]:
        """The gradient (m, columns) of a quantity, and its second derivative by time (m,)."""
        gradient, once, twice = changes(quantity, self.state, self.first, self.second)
        return gradient, twice * self.speed**2 + once * self.acceleration


def _named(
    mechanism: Mechanism, built: System, equations: list[Equation], multipliers: Array, applied: Applied
) -> dict[str, Array]:
    """The multipliers under the names that people read.

    A slide acts on its joint's point; where that is a pin as well, the pin hands its force on to the joint's link, which is
    no part of the pin's own force.
    """
    unit = applied.unit
    through_pin: dict[tuple[str, int], Array] = {}
    numbers = {body: link.number for link in mechanism.links for body in (built.bodies[link.name],)}
    joints = {joint.name: joint for joint in mechanism.joints}
    on_pin: dict[tuple[str, int], dict[str, Array]] = {}
    found: dict[str, Array] = {}
    for equation, value in zip(equations, multipliers.T, strict=True):
        if equation.kind in ("meet x", "meet y"):
            on_pin.setdefault((equation.of, equation.body), {})[equation.kind[-1]] = value / unit
        elif _is_tie(equation):
            continue
        elif equation.of in joints:
            joint = joints[equation.of]
            name = pair_symbol("F", numbers[built.bodies[joint.on]], numbers[built.bodies[joint.link]])
            part = {"line": "n", "angle": "c", "displacement": "t"}[equation.kind]
            found[f"{name}.{part}"] = value if part == "c" else value / unit
            if part != "c":
                direction = applied.state[:, 3 * equation.on + 2] + equation.angle + (np.pi / 2 if part == "n" else 0.0)
                key = joint.point, built.bodies[joint.link]
                handed = value / unit * np.array([np.cos(direction), np.sin(direction)])
                through_pin[key] = through_pin.get(key, 0.0) + handed
        else:
            symbol = equation.of.removeprefix("driver ") or mechanism.driver.symbol
            driver = mechanism.driver_of(symbol)
            base = built.bodies[driver.relative_to or mechanism.ground.name]
            found[pair_symbol("T", numbers[base], numbers[built.bodies[driver.link]])] = value
    for point, owner, other in _pins(mechanism, built):
        force = np.array([on_pin[point, other][axis] for axis in "xy"]) - through_pin.get((point, other), 0.0)
        name = pair_symbol("F", numbers[owner], numbers[other])
        found |= {f"{name}.x": force[0], f"{name}.y": force[1], name: np.hypot(*force)}
    return found


def _pins(mechanism: Mechanism, built: System) -> list[tuple[str, int, int]]:
    """(point, owner, other) of every pair at a pin: the owner is the first link that has it."""
    at: dict[str, list[int]] = {}
    for link in mechanism.links:
        for point in link.points:
            at.setdefault(point, []).append(built.bodies[link.name])
    return [(point, owner, other) for point, (owner, *others) in at.items() for other in others]


# --- teeth of gears and racks ----------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Contact:
    """A force (2, m) on a body at a place (2, m) in the system's own lengths; the opposite one on `other`."""

    body: str
    other: str
    force: Array
    at: Array


def tooth_forces(
    mechanism: Mechanism, applied: Applied, multipliers: dict[str, Array]
) -> tuple[dict[str, Array], list[Contact]]:
    """G25 and its tangential part G25.t, or the torque G25.m, by name; and the forces at the teeth.

    multipliers  of the relations, by the name of their conditions
    """
    named: dict[str, Array] = {}
    contacts: list[Contact] = []
    for order, relation in enumerate(mechanism.relations):
        effort = multipliers[f"relation {order}"]
        if isinstance(relation, Rack):
            one, other, tangent, contact = _rack(mechanism, applied, relation, effort)
        else:
            one, other = relation.on, relation.link
            found = _gear(applied, relation, effort)
            if found is None:
                named[f"{_name(mechanism, one, other)}.m"] = effort
                continue
            tangent, contact = found
        name = _name(mechanism, one, other)
        named |= {f"{name}.t": tangent, name: np.hypot(*contact.force)}
        contacts.append(contact)
    return named, contacts


def along_poses(applied: Applied, contacts: list[Contact]) -> Array:
    """What the forces at the teeth do along the poses (m, columns), as torques."""
    total: Array = np.zeros_like(applied.state)
    for contact in contacts:
        for link, sign in ((contact.body, 1.0), (contact.other, -1.0)):
            first = applied.built.column(link)
            force = sign * applied.unit * contact.force
            arm = contact.at - applied.state[:, first : first + 2].T
            total[:, first : first + 2] += force.T
            total[:, first + 2] += arm[0] * force[1] - arm[1] * force[0]
    return total


def _name(mechanism: Mechanism, one: str, other: str) -> str:
    numbers = {link.name: link.number for link in mechanism.links}
    return pair_symbol("G", numbers[one], numbers[other])


def _axis(applied: Applied, wheel: str, arm: str) -> Array:
    """Where a wheel turns on its arm (2, m)."""
    point = next(point for point in applied.links[wheel].points if point in applied.links[arm].points)
    return np.array([applied.coordinate(axis) for axis in applied.place(arm, point)])


def _gear(applied: Applied, gear: Gear, torque: Array) -> tuple[Array, Contact] | None:
    values = applied.solution.dimensions
    ratio, pressure = number(gear.ratio, values), number(gear.pressure, values)
    start, end = (_axis(applied, wheel, gear.arm) for wheel in (gear.on, gear.link))
    length = np.hypot(*(end - start))
    if gear.kind == "belt" or abs(ratio - 1) < 1e-9 or not np.all(length > 0):
        return None
    e = (end - start) / length
    n = np.array([-e[1], e[0]])
    at = start + ratio / (ratio - 1) * length * e
    tangent = torque / applied.unit * (ratio - 1) / length
    force = tangent * n - np.sign(ratio) * np.abs(tangent) * np.tan(pressure) * e
    return tangent, Contact(gear.link, gear.on, force, at)


def _rack(mechanism: Mechanism, applied: Applied, rack: Rack, effort: Array) -> tuple[str, str, Array, Contact]:
    joint = next(joint for joint in mechanism.joints if joint.symbol == rack.joint)
    bar = joint.link if rack.arm == joint.on else joint.on
    sign = 1.0 if bar == joint.link else -1.0
    values = applied.solution.dimensions
    radius = number(rack.radius, values) / applied.built.scale
    direction = applied.state[:, applied.built.column(joint.on) + 2] + number(joint.angle, values)
    d = np.array([np.cos(direction), np.sin(direction)])
    n = np.array([-d[1], d[0]])
    tangent = sign * effort / applied.unit
    push = np.abs(tangent) * np.tan(number(rack.pressure, values))
    force = tangent * d - sign * np.sign(radius) * push * n
    return (
        rack.link,
        bar,
        tangent,
        Contact(bar, rack.link, force, _axis(applied, rack.link, rack.arm) - sign * radius * n),
    )

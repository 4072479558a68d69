"""The loop closure equations in complex form: one for each dyad, between the way round one side and the way round the other.

    sum of r e^(i theta)  (left)  =  sum of r e^(i theta)  (right)

A loop leaves a joint of the ground (the driver's, where it passes that) and reaches the dyad's inner joint over the links
that are solved and the dyad's first link, on the other side over its second link. Each link gives the vector from one of
its joints to the next; a sliding joint gives its displacement. Source: Soeylemez, Mechanisms, section 3.6-3.8.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Binary, Node, Number, Symbol, Unary
from mechsheet.kinematics.assur import Contact, Dyad, Pin, Step, bodies_of
from mechsheet.kinematics.equations import NO_LOOP, Loop, Vector
from mechsheet.kinematics.newton.chains import Chain
from mechsheet.kinematics.points_in_link import PointInLink, angle_of
from mechsheet.kinematics.poses import Poses


@dataclass(frozen=True, slots=True)
class _Step:
    """Over a body from one joint to another."""

    body: str
    start: Contact
    end: Contact

    @property
    def reverse(self) -> _Step:
        return _Step(self.body, self.end, self.start)


def loops_of(poses: Poses, steps: Iterable[Step]) -> tuple[Loop, ...]:
    """The loop of each dyad, in order of solution; none of a group that Newton's method solves."""
    mechanism = poses.mechanism
    driver = mechanism.driver
    solved = {mechanism.ground.name}
    found = []
    for dyad in steps:
        if not isinstance(dyad, Dyad):
            found += [NO_LOOP] if isinstance(dyad, Chain) else []
            solved.update(bodies_of(dyad))
            continue
        # a dyad on the driven pair closes over the pair, seen from the link in whose frame it is solved
        angles = {body: poses.members[body].angle if dyad.frame else pose.angle for body, pose in poses.known.items()}
        known = _route(poses, set(dyad.frame) or solved, dyad.outer[0], dyad.outer[1])
        first = _route(poses, set(dyad.first), dyad.outer[0], dyad.inner)
        second = _route(poses, set(dyad.second), dyad.outer[1], dyad.inner)
        found.append(_loop(poses, angles, (known, first, second), driver.link or driver.joint))
        if not dyad.frame:
            solved |= {*dyad.first, *dyad.second}
    return tuple(found)


def _touches(poses: Poses, body: str, contact: Contact) -> bool:
    if isinstance(contact, Pin):
        return contact.point in poses.graph.points[body]
    return body in (contact.body, contact.on)


def _route(poses: Poses, allowed: set[str], start: Contact, end: Contact) -> list[_Step]:
    """The shortest way from joint to joint over the allowed bodies; of equal ones the first in the description's order."""
    bodies = [body for body in poses.graph.bodies if body in allowed]
    ways: list[list[_Step]] = []
    waiting: list[tuple[str, Contact, list[_Step]]] = [
        (body, start, []) for body in bodies if _touches(poses, body, start)
    ]
    seen = {body for body, _, _ in waiting}
    while waiting and not ways:
        following = []
        for body, joint, before in waiting:
            if _touches(poses, body, end):
                ways.append([*before, _Step(body, joint, end)])
                continue
            for other in bodies:
                if other not in seen and (shared := _shared(poses, body, other)) is not None:
                    seen.add(other)
                    following.append((other, shared, [*before, _Step(body, joint, shared)]))
        waiting = following
    return ways[0]


def _shared(poses: Poses, body: str, other: str) -> Contact | None:
    """A joint between two bodies."""
    for point in poses.graph.points[body]:
        if point in poses.graph.points[other]:
            return Pin(point)
    return next((slide for slide in poses.graph.slides_of(body) if slide.other(body) == other), None)


def _loop(
    poses: Poses, angles: Mapping[str, Angle], steps: tuple[list[_Step], list[_Step], list[_Step]], driven: str
) -> Loop:
    """The loop cut at the ground, or at the first solved body where the ground is not on it."""
    known, first, second = steps
    ground = poses.mechanism.ground.name
    base = next((index for index, step in enumerate(known) if step.body == ground), 0)
    left = [step.reverse for step in reversed(known[:base])] + first
    right = known[base + 1 :] + second
    crosses = known[base + 1].body if base + 1 < len(known) else ""
    if crosses == driven:  # it starts where the driver does, as one draws it
        left = [known[base].reverse, *left]
    else:
        right = [known[base], *right]
    sides: tuple[list[Vector], list[Vector]] = ([], [])
    for side, way in enumerate((left, right)):
        for step in way:
            for sign, vector in _vectors(poses, angles[step.body], step):
                sides[side if sign > 0 else 1 - side].append(vector)
    ways = tuple(tuple(pair for step in way if (pair := _names(step))[0] != pair[1]) for way in (left, right))
    return Loop(tuple(sides[0]), tuple(sides[1]), ways[0], ways[1])


def _names(step: _Step) -> tuple[str, str]:
    return _name(step.start), _name(step.end)


def _name(contact: Contact) -> str:
    """The point at which a joint is: that of the pin, or the one that slides."""
    return contact.point if isinstance(contact, Pin) else contact.joint.point


def _vectors(poses: Poses, angle: Angle, step: _Step) -> list[tuple[int, Vector]]:
    """From joint to joint on a body, as vectors from its origin with their signs."""
    start, end = (_located(poses, step.body, angle, contact) for contact in (step.start, step.end))
    found = [(-sign, vector) for sign, vector in start if (sign, vector) not in end]
    return found + [(sign, vector) for sign, vector in end if (sign, vector) not in start]


def _located(poses: Poses, body: str, angle: Angle, contact: Contact) -> list[tuple[int, Vector]]:
    """From the body's origin to a joint's point."""
    if isinstance(contact, Pin):
        return _parts(poses.own_point(body, contact.point), angle)
    joint = contact.joint
    if body == contact.body:
        return _parts(poses.own_point(body, joint.point), angle)
    displacement = _signed(Symbol(joint.symbol), angle + angle_of(joint.angle))
    return [*_parts(poses.through(joint), angle), displacement]


def _parts(place: PointInLink, angle: Angle) -> list[tuple[int, Vector]]:
    """A place as one vector where it has a length and a direction, else as its two coordinates."""
    if place.is_zero:
        return []
    if place.polar:
        length, own = place.polar
        return [_signed(length, angle + own)]
    parts = ((place.u, Angle()), (place.v, Angle(degrees=90)))
    return [_signed(length, angle + own) for length, own in parts if not al.is_zero(length)]


def _signed(length: Node, angle: Angle) -> tuple[int, Vector]:
    """A minus in front of a length, and a half turn in its direction, as a sign: it changes the side of the equation."""
    sign = 1
    positive = _without_minus(length)
    if positive is not None:
        sign, length = -sign, positive
    turn = angle.degrees % 360
    if turn >= 180:
        sign, turn = -sign, turn - 180
    return sign, Vector(length, Angle(angle.node, turn))


def _without_minus(length: Node) -> Node | None:
    """x of -x and of -x/2; None where no minus stands in front."""
    match length:
        case Unary("-", operand):
            return operand
        case Number(value) if value < 0:
            return Number(-value)
        case Binary("*" | "/", left, right):
            plain = _without_minus(left)
            return None if plain is None else Binary(length.op, plain, right)
    return None

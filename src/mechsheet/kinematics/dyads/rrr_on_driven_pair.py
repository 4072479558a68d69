"""A dyad RRR on the driven pair, away from the ground: a cylinder between two links that move, say, with both its links.

The driver's value and the lengths make pair and dyad one triangle P, Q, R, which moves as a whole. So the dyad is solved in
the frame of its first link, or of the pair (the one that is joined to what is known), by the law of cosines; the others are
members of that frame, and the groups that follow see one link.

    s         from P to Q, over the pair (a cylinder: its length from pin to pin)
    psi, mu   angles at P and R:  cos(psi) = (a^2 + s^2 - b^2) / (2 a s),  cos(mu) = (a^2 + b^2 - s^2) / (2 a b)
    direction of P->Q = direction of P->R - mode psi,   direction of Q->R = direction of P->R + mode mu

mode +1: P, Q, R counter-clockwise, wherever they are.
"""

from __future__ import annotations

from collections.abc import Mapping

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import TriangleAngle, symbols
from mechsheet.kinematics.assur import Dyad, Pin
from mechsheet.kinematics.dyads.rrr import three_pins, triangle_exists
from mechsheet.kinematics.dyads.solved import Solved
from mechsheet.kinematics.points_in_link import PointInLink, arm_of, cartesian, number
from mechsheet.kinematics.poses import Assembly, Member, Poses
from mechsheet.model import Sketch
from mechsheet.units import ANGLE
from mechsheet.words.equations import phrase

FLAT = 0.05
"""A sketched triangle whose height is less than this part of its longest side does not say on which side its corner is."""


def solve_within(poses: Poses, dyad: Dyad) -> Solved:
    """Write the dyad's equations down; pair and links become members of the first link's frame."""
    ledger = poses.ledger
    p, q, r = dyad.pins
    a, line_a = poses.arm(dyad.first, p, r)
    b, line_b = poses.arm(dyad.second, q, r)
    at_p, at_q = poses.point(dyad.frame, p), poses.point(dyad.frame, q)
    label = phrase("length_in_link", start=p, end=q, link=poses.name(dyad.frame))
    s, line_s = arm_of(ledger, at_q - at_p, None, f"{p}{q}", label)
    mode = ledger.mode()
    exists = triangle_exists(ledger, (a, b, s))
    psi = ledger.column("psi", TriangleAngle(b, a, s), ANGLE, phrase("angle", name=f"{q}{p}{r}"), exists)
    mu = ledger.column("mu", TriangleAngle(s, a, b), ANGLE, phrase("angle", name=f"{p}{r}{q}"), exists)
    (first,), (second,) = dyad.first, dyad.second
    between = Angle(al.mul(mode, psi))
    if dyad.whole[0] == first:
        turned = _turn_pair(poses, dyad, (p, q), at_p, line_a - between - line_s)
        along, corner = line_a, poses.own_point(first, r)
    else:
        turned = _turn(poses, dyad.first, line_s + between - line_a, str(poses.links[first].number))
        poses.members[first] = member(turned, at_p, poses.own_point(first, p), p)
        along, corner = turned + line_a, poses.point(dyad.first, r)
    turn = _turn(poses, dyad.second, along + Angle(al.mul(mode, mu)) - line_b, str(poses.links[second].number))
    poses.members[second] = member(turn, corner, poses.own_point(second, r), r)
    return three_pins(poses, dyad, mode, (psi, mu), (a, b, s), (symbols(turned.node)[0], symbols(turn.node)[0]))


def _turn(poses: Poses, bodies: Assembly, angle: Angle, name: str) -> Angle:
    label = phrase("turned_in_pair", link=poses.name(bodies))
    return Angle(poses.ledger.column(f"turn_{name}", angle.node, ANGLE, label), angle.degrees)


def _turn_pair(poses: Poses, dyad: Dyad, pins: tuple[str, str], before: PointInLink, angle: Angle) -> Angle:
    """The pair (and what is with it already), turned about P (`before` in its frame), from its frame to the first link's."""
    turn = _turn(poses, dyad.frame, angle, "pair")
    at = poses.own_point(dyad.first[0], pins[0])
    for body in dyad.frame:
        known = poses.members[body]
        origin = at
        if known.origin != before:
            x, y = (known.origin - before).turned(turn)
            origin = cartesian(al.add(at.u, x), al.add(at.v, y))
        pin = next((point for point in (*pins, known.pin) if point in poses.graph.points[body]), "")
        poses.members[body] = Member(turn + known.angle, origin, pin)
    return turn


def member(turn: Angle, at: PointInLink, own: PointInLink, pin: str = "") -> Member:
    """The body turned by `turn` whose place `own` lies at the place `at` of the assembly's frame."""
    if own.is_zero:
        return Member(turn, at, pin)
    x, y = own.turned(turn)
    return Member(turn, at - cartesian(x, y), pin)


def sketched_mode(sketch: Sketch, dyad: Dyad, dimensions: Mapping[str, float]) -> int | None:
    """On which side of P->Q the sketch has the inner pin; None where it does not say. The triangle is the same anywhere."""
    points = [contact.point for contact in (*dyad.outer, dyad.inner) if isinstance(contact, Pin)]
    if not all(point in sketch.points for point in points):
        return None
    p, q, r = (complex(*(number(part, dimensions) for part in sketch.points[point])) for point in points)
    area, longest = ((q - p).conjugate() * (r - p)).imag, max(abs(q - p), abs(r - p), abs(r - q))
    if abs(area) <= FLAT * longest**2:
        return None
    return 1 if area > 0 else -1

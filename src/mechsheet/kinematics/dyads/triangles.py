"""Dyads of three pins, RRR: the pins are the corners of a triangle, which the law of cosines solves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Binary, Call, Node, Symbol, TriangleAngle, symbols
from mechsheet.kinematics.assur import Dyad
from mechsheet.kinematics.dyads.solved import DEAD, Determinant, Solved, known_way
from mechsheet.kinematics.equations import Condition
from mechsheet.kinematics.graph import Assembly
from mechsheet.kinematics.ledger import Ledger
from mechsheet.kinematics.points_in_link import PointInLink, arm_of, cartesian, number, triangle_closes
from mechsheet.kinematics.poses import Member, Poses
from mechsheet.model import Sketch
from mechsheet.units import ANGLE
from mechsheet.words.equations import phrase


def solve_rrr(poses: Poses, dyad: Dyad) -> Solved:
    """Write down a dyad whose outer pins are known, P of the first link and Q of the second; R is the inner one.

        s cos(phi) = xP - xQ,  s sin(phi) = yP - yQ            from the second outer pin to the first
        psi       = angle at Q:  cos(psi) = (s^2 + b^2 - a^2) / (2 s b)
        mu        = angle at R (transmission angle):  cos(mu) = (a^2 + b^2 - s^2) / (2 a b)
        direction of Q->R = phi - mode psi,   direction of P->R = direction of Q->R - mode mu

    mode +1: P, Q, R counter-clockwise. Source: Soeylemez, Mechanisms, section 3.8 (four-bar).
    """
    ledger = poses.ledger
    p, q, r = dyad.pins
    (xp, yp), (xq, yq) = poses.xy[p], poses.xy[q]
    a, line_a = poses.arm(dyad.first, p, r)
    b, line_b = poses.arm(dyad.second, q, r)
    mode = ledger.mode()
    s, phi = known_way(ledger, "s", (q, xq, yq), (p, xp, yp))
    exists = triangle_exists(ledger, (a, b, s))
    psi = ledger.column("psi", TriangleAngle(a, b, s), ANGLE, phrase("angle", name=f"{p}{q}{r}"), exists)
    mu = ledger.column(
        "mu", TriangleAngle(s, a, b), ANGLE,
        phrase("transmission_angle", name=f"{p}{r}{q}"), exists,
    )  # fmt: skip
    to_r = Angle(al.sub(phi, al.mul(mode, psi)))
    poses.fix(dyad.second, to_r - line_b, poses.point(dyad.second, q), xq, yq)
    # theta13 = theta14 - mu, as the text has it, where the second link's x axis is its arm; else from the arm itself.
    second = poses.known[dyad.second[0]].angle + line_b
    poses.fix(dyad.first, second - Angle(al.mul(mode, mu)) - line_a, poses.point(dyad.first, p), xp, yp)
    unknowns = (poses.angle_unknown(dyad.first), poses.angle_unknown(dyad.second))
    return replace(three_pins(poses, dyad, mode, (psi, mu), (a, b, s), unknowns), transmission=mu.name)


def triangle_exists(ledger: Ledger, sides: tuple[Node, Node, Node]) -> tuple[Condition, Condition]:
    """The pins are apart (those that coincide leave a link free to turn about them), and the sides form a triangle."""
    return Condition(al.smallest(sides), ledger.tolerance), triangle_closes(ledger, *sides)


def three_pins(
    poses: Poses,
    dyad: Dyad,
    mode: Symbol,
    angles: tuple[Symbol, Symbol],
    sides: tuple[Node, Node, Node],
    unknowns: tuple[str, str],
) -> Solved:
    """What is known of a dyad of three pins: at the corners of a triangle, two of whose sides are links.

    angles  at the corner on the outer pins' line, and between the links;  sides  both links', and between the outer pins
    """
    p, q, r = dyad.pins
    corner, between = angles
    a, b, _ = sides
    separate, reaches = triangle_exists(poses.ledger, sides)
    sine = al.sin(Angle(between))
    return Solved(
        mode.name,
        (phrase("left_of", point=r, start=p, end=q), phrase("right_of", point=r, start=p, end=q)),
        closes=corner.name,
        apart=sine,  # the area of the triangle
        pins=(p, q, r),
        unknowns=unknowns,
        label=phrase("group_pins", links=poses.both(dyad), pins=f"{p}, {q}, {r}"),
        determinant=Determinant(
            al.mul(al.mul(al.mul(mode, a), b), sine), 2, True, Condition(Call("ABS", (sine,)), al.number(DEAD))
        ),
        sides=sides,
        degenerate=Call("AND", (separate.fails, Binary(">=", reaches.margin, reaches.least))),
    )


FLAT = 0.05
"""A sketched triangle whose height is less than this part of its longest side does not say on which side its corner is."""


def solve_within(poses: Poses, dyad: Dyad) -> Solved:
    """Write down a dyad on the driven pair, away from the ground: a cylinder between two links that move, say.

    The driver's value and the lengths make pair and dyad one triangle P, Q, R, which moves as a whole. So the dyad is solved
    in the frame of its first link, or of the pair (the one that is joined to what is known); the others become members of
    that frame, and the groups that follow see one link.

        s         from P to Q, over the pair (a cylinder: its length from pin to pin)
        psi, mu   angles at P and R:  cos(psi) = (a^2 + s^2 - b^2) / (2 a s),  cos(mu) = (a^2 + b^2 - s^2) / (2 a b)
        direction of P->Q = direction of P->R - mode psi,   direction of Q->R = direction of P->R + mode mu

    mode +1: P, Q, R counter-clockwise, wherever they are.
    """
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
    if not all(point in sketch.points for point in dyad.pins):
        return None
    p, q, r = (complex(*(number(part, dimensions) for part in sketch.points[point])) for point in dyad.pins)
    area, longest = ((q - p).conjugate() * (r - p)).imag, max(abs(q - p), abs(r - p), abs(r - q))
    if abs(area) <= FLAT * longest**2:
        return None
    return 1 if area > 0 else -1

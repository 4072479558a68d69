"""The dyad RRR: two links with three revolute joints, closed by the law of cosines.

    s cos(phi) = xP - xQ,  s sin(phi) = yP - yQ            from the second outer pin Q to the first, P
    psi       = angle at Q:  cos(psi) = (s^2 + b^2 - a^2) / (2 s b)
    mu        = angle at the inner pin R (transmission angle):  cos(mu) = (a^2 + b^2 - s^2) / (2 a b)
    direction of Q->R = phi - mode psi,   direction of P->R = direction of Q->R - mode mu

mode +1: P, Q, R counter-clockwise. Source: Soeylemez, Mechanisms, section 3.8 (four-bar).
"""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Binary, Call, Node, Symbol, TriangleAngle
from mechsheet.kinematics.assur import Dyad
from mechsheet.kinematics.dyads.solved import DEAD, Determinant, Solved, known_way
from mechsheet.kinematics.equations import Condition
from mechsheet.kinematics.ledger import Ledger
from mechsheet.kinematics.points_in_link import triangle_closes
from mechsheet.kinematics.poses import Poses
from mechsheet.units import ANGLE
from mechsheet.words.equations import phrase


def solve_rrr(poses: Poses, dyad: Dyad) -> Solved:
    """Write the dyad's equations down."""
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

"""The dyad RRR: two links with three revolute joints, closed by the law of cosines.

    s cos(phi) = xP - xQ,  s sin(phi) = yP - yQ            from the second outer pin Q to the first, P
    Delta     = area of the triangle with sides a, b, s    (Heron)
    psi       = angle at Q:  tan(psi) = 4 Delta / (s^2 + b^2 - a^2)
    mu        = angle at the inner pin R (transmission angle):  tan(mu) = 4 Delta / (a^2 + b^2 - s^2)
    direction of Q->R = phi - mode psi,   direction of P->R = direction of Q->R - mode mu

mode +1: P, Q, R counter-clockwise. These are the text's formulas with acos written as the arc tangent of the two legs,
which keeps its digits at dead centres. Source: Soeylemez, Mechanisms, section 3.8 (four-bar).
"""

from __future__ import annotations

from mechsheet.formula.nodes import Call, Node
from mechsheet.kinematics import algebra as al
from mechsheet.kinematics.algebra import Angle
from mechsheet.kinematics.assur import Dyad, Pin
from mechsheet.kinematics.dyads import Solved
from mechsheet.kinematics.places import reaching, triangle_area
from mechsheet.kinematics.poses import Poses
from mechsheet.model import Words


def solve_rrr(poses: Poses, dyad: Dyad, always: bool) -> Solved:
    """Write the dyad's equations down. `always`: both outer pins exist in every row."""
    ledger = poses.ledger
    contacts = (dyad.outer[0], dyad.outer[1], dyad.inner)
    p, q, r = (contact.point for contact in contacts if isinstance(contact, Pin))
    (xp, yp), (xq, yq) = poses.xy[p], poses.xy[q]
    a, line_a = poses.arm(dyad.first, p, r)
    b, line_b = poses.arm(dyad.second, q, r)
    mode = ledger.mode()
    s_x = ledger.hoist("s_x", al.sub(xp, xq), "length", Words(f"{q}→{p}, x part", f"{q}→{p}, x bileşeni"))
    s_y = ledger.hoist("s_y", al.sub(yp, yq), "length", Words(f"{q}→{p}, y part", f"{q}→{p}, y bileşeni"))
    s = ledger.column(
        "s", al.sqrt(al.add(al.square(s_x), al.square(s_y))), "length", Words(f"distance {q}–{p}", f"{q}–{p} uzaklığı")
    )
    phi = ledger.direction("phi", s_x, s_y, always, Words(f"direction of {q}→{p}", f"{q}→{p} doğrultusu"))
    together = al.less(al.smallest((a, b, s)), ledger.tolerance)  # pins coincide: some link can turn about them
    area = triangle_area(
        ledger, "Delta", a, b, s, Words(f"area of triangle {p}{q}{r}", f"{p}{q}{r} üçgeninin alanı"), also=together
    )
    four_areas = al.mul(al.number(4), area)
    psi = ledger.column(
        "psi", al.atan2(_cosine_side(b, s, a), four_areas), "angle", Words(f"angle {p}{q}{r}", f"{p}{q}{r} açısı")
    )
    mu = ledger.column(
        "mu", al.atan2(_cosine_side(a, b, s), four_areas), "angle",
        Words(f"angle {p}{r}{q} (transmission)", f"{p}{r}{q} açısı (bağlama)"),
    )  # fmt: skip
    to_r = Angle(al.sub(phi, al.mul(mode, psi)))
    poses.fix(dyad.second, to_r - line_b, poses.place(dyad.second, q), xq, yq)
    # theta13 = theta14 - mu, as the text has it, where the second link's x axis is its arm; else from the arm itself.
    second = poses.known[dyad.second[0]].angle + line_b
    poses.fix(dyad.first, second - Angle(al.mul(mode, mu)) - line_a, poses.place(dyad.first, p), xp, yp)
    return Solved(
        mode.name,
        (
            Words(f"{r} left of {p}→{q}", f"{r}, {p}→{q} solunda"),
            Words(f"{r} right of {p}→{q}", f"{r}, {p}→{q} sağında"),
        ),
        closes=area.name if hasattr(area, "name") else s.name,
        degenerate=Call("AND", (together, reaching(ledger, a, b, s))),
        pins=(p, q, r),
        label=Words(
            f"{poses.both(dyad).en}: pins {p}, {q}, {r}",
            f"{poses.both(dyad).tr}: {p}, {q}, {r} mafsalları",
        ),
        transmission=mu.name,
        sides=(a, b, s),
    )


def _cosine_side(a: Node, b: Node, c: Node) -> Node:
    """a^2 + b^2 - c^2, which is 2 a b times the cosine of the angle between a and b."""
    return al.sub(al.add(al.square(a), al.square(b)), al.square(c))

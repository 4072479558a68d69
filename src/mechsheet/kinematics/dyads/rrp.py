"""The dyad RRP: a link with two pins and a link that slides on a known line (slider-crank).

The inner pin R moves on the line through (xL, yL) in the direction delta; P is the known pin, a the arm PR.

    t = along delta,  n = across it:  the vector from P to (xL, yL)
    w   = sqrt(a^2 - n^2)
    displacement  sign (mode' w - t),     tan(psi) = n / w
    direction of P->R = delta + psi (mode' = +1) or delta + pi - psi (mode' = -1)

mode +1 is the larger displacement (mode' = mode, or -mode when the line moves and the point stands still).
Source: Soeylemez, Mechanisms, section 3.8 (slider-crank): a3 sin(theta13) = a2 sin(theta12) - a1.
"""

from __future__ import annotations

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from mechsheet.kinematics.assur import Dyad, Pin
from mechsheet.kinematics.dyads.solved import Solved, along_and_across, half_turn_unless, leg, leg_left
from mechsheet.kinematics.equations import Condition
from mechsheet.kinematics.graph import Slide
from mechsheet.kinematics.poses import Poses
from mechsheet.units import ANGLE, LENGTH
from mechsheet.words.equations import phrase


def solve_rrp(poses: Poses, dyad: Dyad) -> Solved:
    """Write the dyad's equations down."""
    ledger = poses.ledger
    outer, slide, inner = dyad.outer[0], dyad.outer[1], dyad.inner
    if not (isinstance(outer, Pin) and isinstance(slide, Slide) and isinstance(inner, Pin)):
        raise TypeError(f"not an RRP dyad: {dyad}")
    p, r = outer.point, inner.point
    xp, yp = poses.xy[p]
    a, line_a = poses.arm(dyad.first, p, r)
    guide = poses.guide(slide, dyad.second)
    mode = ledger.mode()
    offset_x, offset_y = (poses.point(dyad.second, r) - guide.moving).turned(guide.angle)
    e_x = ledger.hoist(
        "e_x",
        al.sub(al.add(guide.x, offset_x), xp),
        LENGTH,
        phrase("to_guide", point=p, axis="x"),
    )
    e_y = ledger.hoist(
        "e_y",
        al.sub(al.add(guide.y, offset_y), yp),
        LENGTH,
        phrase("to_guide", point=p, axis="y"),
    )
    along, across = along_and_across(e_x, e_y, guide.delta)
    t = ledger.hoist(
        "t",
        along,
        LENGTH,
        phrase("along_guide", point=p),
    )
    n = ledger.hoist("n", across, LENGTH, phrase("across_guide", point=p))
    separate = Condition(a, ledger.tolerance)  # pins that coincide leave the link free to turn about them
    w = leg(ledger, "w", a, n, phrase("arm_along_guide", start=p, end=r), separate)
    psi = ledger.column("psi", al.atan2(w, n), ANGLE, phrase("angle_to_guide", start=p, end=r))
    sign = mode if guide.sign > 0 else al.neg(mode)
    reach = al.sub(al.mul(sign, w), t)
    poses.displacement(guide.symbol, reach if guide.sign > 0 else al.neg(reach))
    to_r = guide.delta + Angle(al.add(al.mul(sign, psi), half_turn_unless(sign)))
    poses.fix(dyad.first, to_r - line_a, poses.point(dyad.first, p), xp, yp)
    xr, yr = poses.xy[r]
    poses.fix(dyad.second, guide.angle, poses.point(dyad.second, r), xr, yr)
    return Solved(
        mode.name,
        (
            phrase("larger_of_two", symbol=guide.symbol),
            phrase("smaller_of_two", symbol=guide.symbol),
        ),
        closes=w.name,
        apart=w,
        pins=(p, r),
        unknowns=(poses.angle_unknown(dyad.first), guide.symbol),
        label=phrase("group_slide", links=poses.both(dyad), pins=f"{p}, {r}", slide=guide.symbol),
        determinant=leg_left(mode, w, a, turned=False),
        transmission=psi.name,
        sides=(a, n),
    )

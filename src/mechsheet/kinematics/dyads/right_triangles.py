"""Dyads of two pins and a slide, RPR and RRP: a leg w of a right triangle is found from the two other sides."""

from __future__ import annotations

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Binary, Call, Node
from livesheet.said import Words
from mechsheet.kinematics.assur import Dyad, Pin
from mechsheet.kinematics.dyads.solved import Solved, along_and_across, half_turn_unless, known_way, leg, leg_left
from mechsheet.kinematics.equations import Condition
from mechsheet.kinematics.graph import Slide
from mechsheet.kinematics.points_in_link import angle_of
from mechsheet.kinematics.poses import Poses
from mechsheet.units import ANGLE, LENGTH
from mechsheet.words.equations import phrase


def solve_rpr(poses: Poses, dyad: Dyad) -> Solved:
    """Write down two links that slide on each other, each pinned to something known (inverted slider-crank).

    P is the known pin of the link that carries the line, Q that of the link whose point moves along it; delta is the line's
    direction. In the line's frame the way from P to Q is (p + s, h): p and h are constants of the two links (h is what the
    line misses the pins by), so

        r, phi = distance and direction from P to Q
        w      = sqrt(r^2 - h^2),     s = mode w - p,     tan(chi) = h / w
        delta  = phi - chi (mode +1) or phi - pi + chi (mode -1)

    Source: Soeylemez, Mechanisms, section 3.8 (kol-kizak, h = 0) and the inverted slider-crank with offset.
    """
    ledger = poses.ledger
    slide = dyad.inner
    if not isinstance(slide, Slide):
        raise TypeError(f"not an RPR dyad: {dyad}")
    joint = slide.joint
    carrier, slider, pin_p, pin_q = dyad.by_line
    p, q = pin_p.point, pin_q.point
    (xp, yp), (xq, yq) = poses.xy[p], poses.xy[q]
    mode = ledger.mode()
    r, phi = known_way(ledger, "r", (p, xp, yp), (q, xq, yq))
    ahead, h = _offsets(poses, slide, carrier, slider, p, q)
    separate = Condition(r, ledger.tolerance)
    w = leg(ledger, "w", r, h, phrase("way_along", start=p, end=q, symbol=joint.symbol), separate)
    poses.displacement(joint.symbol, al.sub(al.mul(mode, w), ahead))
    delta = Angle(al.sub(phi, half_turn_unless(mode)))
    if not al.is_zero(h):
        words = phrase("angle_between", start=p, end=q, symbol=joint.symbol)
        chi = ledger.column("chi", al.atan2(w, h), ANGLE, words)
        delta = delta - Angle(al.mul(mode, chi))
    on_angle = delta - angle_of(joint.angle) - poses.members[slide.on].angle
    poses.fix(carrier, on_angle, poses.point(carrier, p), xp, yp)
    line = poses.known[slide.on].angle + angle_of(joint.angle) + angle_of(joint.orientation)
    poses.fix(slider, line - poses.members[slide.body].angle, poses.point(slider, q), xq, yq)
    return Solved(
        mode.name,
        _larger_or_smaller(joint.symbol),
        closes=w.name,
        apart=w,
        pins=(p, q),
        unknowns=(poses.angle_unknown(carrier), joint.symbol),
        label=phrase("group_slide", links=poses.both(dyad), pins=f"{p}, {q}", slide=joint.symbol),
        determinant=leg_left(mode, w, r, turned=True),
        sides=(r, h),
        degenerate=separate.fails
        if al.is_zero(h)
        else Call("AND", (separate.fails, Binary(">=", r, Call("ABS", (h,))))),
    )


def _offsets(
    poses: Poses, slide: Slide, carrier: tuple[str, ...], slider: tuple[str, ...], p: str, q: str
) -> tuple[Node, Node]:
    """(along, across) of the way P -> line's origin plus moving point -> Q, in the line's frame."""
    joint = slide.joint
    through = poses.in_assembly(slide.on, poses.through(joint), "guide")
    start = through - poses.point(carrier, p)
    moving = poses.in_assembly(slide.body, poses.own_point(slide.body, joint.point), "guide_block")
    end = poses.point(slider, q) - moving
    line = poses.members[slide.on].angle + angle_of(joint.angle)
    start_along, start_across = start.turned(-line)
    own = angle_of(joint.orientation) - poses.members[slide.body].angle
    end_along, end_across = end.turned(own)
    words = phrase("slot_offset")
    return (
        poses.ledger.hoist("p", al.add(start_along, end_along), LENGTH, words),
        poses.ledger.hoist("h", al.add(start_across, end_across), LENGTH, words),
    )


def solve_rrp(poses: Poses, dyad: Dyad) -> Solved:
    """Write down a link with two pins and a link that slides on a known line (slider-crank).

    The inner pin R moves on the line through (xL, yL) in the direction delta; P is the known pin, a the arm PR.

        t = along delta,  n = across it:  the vector from P to (xL, yL)
        w   = sqrt(a^2 - n^2)
        displacement  sign (mode' w - t),     tan(psi) = n / w
        direction of P->R = delta + psi (mode' = +1) or delta + pi - psi (mode' = -1)

    mode +1 is the larger displacement (mode' = mode, or -mode when the line moves and the point stands still).
    Source: Soeylemez, Mechanisms, section 3.8 (slider-crank): a3 sin(theta13) = a2 sin(theta12) - a1.
    """
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
    x, y = al.sub(al.add(guide.x, offset_x), xp), al.sub(al.add(guide.y, offset_y), yp)
    e_x = ledger.hoist("e_x", x, LENGTH, phrase("to_guide", point=p, axis="x"))
    e_y = ledger.hoist("e_y", y, LENGTH, phrase("to_guide", point=p, axis="y"))
    along, across = along_and_across(e_x, e_y, guide.delta)
    t = ledger.hoist("t", along, LENGTH, phrase("along_guide", point=p))
    n = ledger.hoist("n", across, LENGTH, phrase("across_guide", point=p))
    separate = Condition(a, ledger.tolerance)  # pins that coincide leave the link free to turn about them
    w = leg(ledger, "w", a, n, phrase("arm_along_guide", start=p, end=r), separate)
    psi = ledger.column("psi", al.atan2(w, n), ANGLE, phrase("angle_to_guide", start=p, end=r))
    sign = guide.signed(mode)
    reach = al.sub(al.mul(sign, w), t)
    poses.displacement(guide.symbol, guide.signed(reach))
    to_r = guide.delta + Angle(al.add(al.mul(sign, psi), half_turn_unless(sign)))
    poses.fix(dyad.first, to_r - line_a, poses.point(dyad.first, p), xp, yp)
    xr, yr = poses.xy[r]
    poses.fix(dyad.second, guide.angle, poses.point(dyad.second, r), xr, yr)
    return Solved(
        mode.name,
        _larger_or_smaller(guide.symbol),
        closes=w.name,
        apart=w,
        pins=(p, r),
        unknowns=(poses.angle_unknown(dyad.first), guide.symbol),
        label=phrase("group_slide", links=poses.both(dyad), pins=f"{p}, {r}", slide=guide.symbol),
        determinant=leg_left(mode, w, a, turned=False),
        transmission=psi.name,
        sides=(a, n),
    )


def _larger_or_smaller(symbol: str) -> tuple[Words, Words]:
    """What tells the two assemblies: the displacement."""
    return phrase("larger_of_two", symbol=symbol), phrase("smaller_of_two", symbol=symbol)

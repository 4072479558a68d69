"""A follower's motion over the angle of its cam: the segment in which a row lies, how much of it is passed, and its law.

    s = start + lift_i + by_i f(tau),    tau = (phi - phi_i)/over_i
    s' = by_i/over_i f'(tau),    s'' = by_i/over_i^2 f''(tau),    s''' = by_i/over_i^3 f'''(tau)

where phi is the angle within the turn. At an angle at which two segments meet the earlier one counts.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Call, Node, Number, Symbol, with_symbols
from mechsheet.kinematics.ledger import Ledger
from mechsheet.model import TAU, FurtherDriver, Segment, Segments
from mechsheet.units import ANGLE, LENGTH, NUMBER
from mechsheet.words.equations import phrase

MEETING = 1e-9
"""So far [rad] behind the angle where two segments meet the earlier one still counts: rounding decides nothing."""

_MIDDLE = math.pi - MEETING
"""The middle of what an angle is brought to; just below half a turn, so that a whole turn begins the next."""


def write_segments(driver: FurtherDriver, angle: str, ledger: Ledger) -> None:
    """Write the follower's value down, over the cam's `angle`; its derivatives by that angle are kept in `ledger.ways`."""
    motion = driver.segments
    if motion is None:
        raise ValueError(f"{driver.symbol} has no segments")
    within = _within(motion, angle, ledger)
    parts = motion.parts
    passed = [al.ZERO if each.law == "dwell" else al.div(al.sub(within, each.begins), each.over) for each in parts]
    tau = ledger.column("tau", _chosen(within, parts, passed), NUMBER, phrase("segment_passed"))
    at = [with_symbols(each.way[0], {TAU: tau}) for each in parts]
    lifts = [al.add(each.lift, al.mul(each.by, way)) for each, way in zip(parts, at, strict=True)]
    value = al.add(motion.start, _chosen(within, parts, lifts))
    unit = LENGTH if driver.joint else ANGLE
    ledger.define(driver.symbol, value, unit, phrase("follower"), "variable")
    ways = []
    for order in (1, 2, 3):
        over = [_power(each.over, order) for each in parts]
        rates = [
            al.mul(al.div(each.by, angles), with_symbols(each.way[order], {TAU: tau}))
            for each, angles in zip(parts, over, strict=True)
        ]
        ways.append(_chosen(within, parts, rates))
    ledger.ways[driver.symbol] = tuple(ways)


def _power(over: Node, order: int) -> Node:
    return over if order == 1 else al.square(over) if order == 2 else Binary("^", over, Number(3.0))


def _within(motion: Segments, angle: str, ledger: Ledger) -> Symbol:
    """The angle within the turn; of a motion that ends, not beyond its end and not before its beginning."""
    phi: Node = Symbol(angle)
    if motion.closed:
        middle = al.number(_MIDDLE)
        turned = al.sub(phi, middle)
        within: Node = al.add(al.atan2(Call("COS", (turned,)), Call("SIN", (turned,))), middle)
    else:
        last = motion.parts[-1]
        within = Call("MAX", (al.ZERO, Call("MIN", (phi, al.add(last.begins, last.over)))))
    return ledger.column(f"{angle}_t", within, ANGLE, phrase("within_turn"))


def _chosen(within: Node, parts: Sequence[Segment], values: Sequence[Node]) -> Node:
    """The value of the segment in which the angle lies."""
    node = values[0]
    for part, value in zip(parts[1:], values[1:], strict=True):
        if value != node:
            node = Call("IF", (Binary(">", al.sub(within, part.begins), Number(MEETING)), value, node))
    return node

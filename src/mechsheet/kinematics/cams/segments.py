"""A follower's motion over the angle of its cam: the segment in which a row lies, how much of it is passed, and its law.

    s = start + lift_i + by_i f(tau),    tau = (phi - phi_i)/over_i
    s' = by_i/over_i f'(tau),    s'' = by_i/over_i^2 f''(tau),    s''' = by_i/over_i^3 f'''(tau)

where phi is the angle within the turn. At an angle at which two segments meet the earlier one counts.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Literal

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, symbols, with_symbols
from mechsheet.kinematics.ledger import Ledger
from mechsheet.kinematics.numeric import Array, value
from mechsheet.model import EIGHTH, HALF, MEETING, MOST_RISING, PIECE, TAU, WAVE, FurtherDriver, Segment, Segments
from mechsheet.units import ANGLE, LENGTH, NUMBER, Unit
from mechsheet.words.equations import phrase

_MIDDLE = al.sub(al.PI, Number(MEETING))
"""The middle of what an angle is brought to; just below half a turn, so that a whole turn begins the next."""


SYMBOLS = {"begins": "phi_i", "over": "beta", "lift": "L", "by": "h"}
"""What columns of a row's segment are called."""


def write_segments(driver: FurtherDriver, angle: str, ledger: Ledger) -> None:
    """Write the follower's value down, over the cam's `angle`; its derivatives by that angle are kept in `ledger.ways`."""
    motion = driver.segments
    if motion is None:
        raise ValueError(f"{driver.symbol} has no segments")
    unit = LENGTH if driver.joint else ANGLE
    of_row = _OfRow(motion, angle, ledger)
    begins, over = (of_row.value(key, ANGLE) for key in ("begins", "over"))
    tau = ledger.column("tau", al.div(al.sub(of_row.within, begins), over), NUMBER, phrase("segment_passed"))
    lift, by = (of_row.value(key, unit) for key in ("lift", "by"))
    known = {TAU: tau} | _halves(motion, tau, ledger)
    ways = [of_row.way(order, known) for order in range(4)]
    value = al.add(motion.start, al.add(lift, al.mul(by, ways[0])))
    ledger.define(driver.symbol, value, unit, phrase("follower"), "variable")
    rates = [al.mul(al.div(by, _power(over, order)), way) for order, way in enumerate(ways[1:], 1)]
    ledger.ways[driver.symbol] = tuple(rates)


class _OfRow:
    """Columns of what holds of the segment in which a row lies."""

    def __init__(self, motion: Segments, angle: str, ledger: Ledger) -> None:
        self.parts, self.ledger = motion.parts, ledger
        self.within = _within(motion, angle, ledger)
        tests = (Binary(">", al.sub(self.within, each.begins), Number(MEETING)) for each in self.parts[1:])
        number = al.total([al.ONE, *(Call("IF", (test, al.ONE, al.ZERO)) for test in tests)])
        self.number = ledger.hoist("i", number, NUMBER, phrase("segment_number"))

    def value(self, key: Literal["begins", "over", "lift", "by"], unit: Unit) -> Node:
        """What segments have."""
        nodes = [getattr(each, key) for each in self.parts]
        return self.ledger.hoist(SYMBOLS[key], self._chosen(nodes), unit, phrase(f"segment_{key}"))

    def way(self, order: int, known: Mapping[str, Node]) -> Node:
        """f or a derivative of it; a dwell goes by whatever law the others have."""
        moving = {each.law: each.way[order] for each in self.parts if each.law != "dwell"}
        nodes = [*moving.values()] if len(moving) == 1 else [each.way[order] for each in self.parts]
        node = with_symbols(self._chosen(nodes), dict(known))
        return self.ledger.hoist(f"f_{order}" if order else "f", node, NUMBER, phrase(f"segment_law_{order}"))

    def _chosen(self, nodes: Sequence[Node]) -> Node:
        return nodes[0] if len(set(nodes)) == 1 else Call("CHOOSE", (self.number, *nodes))


def _halves(motion: Segments, tau: Symbol, ledger: Ledger) -> dict[str, Node]:
    """What laws that are made of pieces read; nothing where there are none.

    Which half it is decides alone: in the middle, whose derivatives are those of the first half, no MIN may take the other.
    """
    if not {WAVE, HALF, PIECE} & {name for each in motion.parts for way in each.way for name in symbols(way)}:
        return {}

    later = ledger.column("q", _later(tau), NUMBER, phrase("segment_half"))
    piece, wave = _of_half(tau, later)
    return {
        HALF: later,
        PIECE: ledger.column("p", piece, NUMBER, phrase("segment_piece")),
        WAVE: ledger.column("w", wave, NUMBER, phrase("segment_wave")),
    }


def _beyond(node: Node, part: float) -> Node:
    return Call("IF", (Binary(">", node, Number(part + MEETING)), al.ONE, al.ZERO))


def _later(tau: Node) -> Node:
    """1 in the later half of a segment."""
    return _beyond(tau, 0.5)


def _of_half(tau: Node, later: Node) -> tuple[Node, Node]:
    """Which piece of its half it is, and the wave's angle: both halves are alike, seen from their ends."""
    nearer = al.add(tau, al.mul(later, al.sub(al.ONE, al.mul(Number(2.0), tau))))
    piece = al.total([al.ONE, _beyond(nearer, EIGHTH), _beyond(nearer, MOST_RISING)])
    return piece, al.mul(al.mul(Number(4.0), al.PI), nearer)


def way_over(part: Segment, order: int, tau: Array) -> Array:
    """f, f', f'' or f''', by its order, of a segment's law at parts of it, as numbers."""
    known = {TAU: tau}
    known[HALF] = value(_later(Symbol(TAU)), known)
    known[PIECE], known[WAVE] = (value(node, known) for node in _of_half(Symbol(TAU), Symbol(HALF)))
    return np.broadcast_to(np.asarray(value(part.way[order], known), float), tau.shape)


def _power(over: Node, order: int) -> Node:
    return over if order == 1 else al.square(over) if order == 2 else Binary("^", over, Number(3.0))


def _within(motion: Segments, angle: str, ledger: Ledger) -> Symbol:
    """The angle within the turn; of a motion that ends, not beyond its end and not before its beginning."""
    phi: Node = Symbol(angle)
    if motion.closed:
        turned = al.sub(phi, _MIDDLE)
        within: Node = al.add(al.atan2(Call("COS", (turned,)), Call("SIN", (turned,))), _MIDDLE)
    else:
        last = motion.parts[-1]
        within = Call("MAX", (al.ZERO, Call("MIN", (phi, al.add(last.begins, last.over)))))
    return ledger.column(f"{angle}_t", within, ANGLE, phrase("within_turn"))

"""What a cam asks of its numbers, whatever is typed into their cells: segments within one turn, radii that can be."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Node, Number, symbols
from livesheet.said import Said, say
from mechsheet.kinematics.cams.segments import MEETING
from mechsheet.kinematics.dimensions import dimension_order
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import Mechanism, Segments

TURN = Number(math.tau + MEETING)
"""Where a turn ends, but for rounding."""


@dataclass(frozen=True, slots=True)
class Asked:
    """Something that must be above 0.

    symbol  the input to look at where it is not
    margin  what must be, over dimensions
    why     what is said where it is not, of the angle [degrees] that is a whole turn less the margin
    zero    whether 0 will do, too
    begins  where a segment begins that must end within the turn: of one that begins beyond it an earlier one is told
    """

    symbol: str
    margin: Node
    why: Callable[[float], Said]
    zero: bool = False
    begins: Node = al.ZERO

    @property
    def holds(self) -> Binary:
        """Whether it is."""
        return Binary(">=" if self.zero else ">", self.margin, al.ZERO)

    @property
    def earlier(self) -> Binary | None:
        """Whether it is another one's fault where it is not; None where it cannot be."""
        return None if self.begins == al.ZERO else Binary(">", self.begins, TURN)


def asked_by_cam(mechanism: Mechanism) -> tuple[Asked, ...]:
    """What the cam of a mechanism asks, nothing where there is none; the description that was read holds it all."""
    reads = _Inputs(mechanism)
    found: list[Asked] = []
    if mechanism.cam is not None:
        radius = al.as_node(mechanism.cam.base_radius)
        found += [Asked(symbol, radius, _base_circle) for symbol in reads.first_of(radius)]
        wheel = al.as_node(mechanism.cam.radius or 0.0)
        found += [Asked(symbol, wheel, _roller, zero=True) for symbol in reads.first_of(wheel)]
    if mechanism.segments is not None:
        found += _of_segments(mechanism.segments, reads)
    return tuple(found)


def refused_by_cam(mechanism: Mechanism, typed: Mapping[str, float]) -> Iterator[tuple[Asked, Said]]:
    """What does not hold with such inputs, and how that is said. What follows from no number is told elsewhere."""
    asked = asked_by_cam(mechanism)
    if not asked:
        return
    given = {dim.symbol: dim.value for dim in mechanism.dimensions}
    values: dict[str, float] = {}
    for symbol in dimension_order(mechanism):
        quantity = given[symbol]
        try:
            values[symbol] = typed[symbol] if isinstance(quantity, float) else number(quantity, values)
        except (ArithmeticError, ValueError):  # the start has no place on a base circle that cannot be
            values[symbol] = math.nan
    for each in asked:
        margin = float(value(each.margin, values))
        if each.earlier is not None and value(each.earlier, values):
            continue
        if margin < 0 or (margin == 0 and not each.zero):
            yield each, each.why(math.degrees(math.tau - margin))


def _of_segments(motion: Segments, reads: _Inputs) -> Iterator[Asked]:
    """Each goes over an angle and ends within the turn; of a closed motion something is left for the last."""
    *before, last = motion.parts
    named: tuple[str, ...] = ()
    for part in before if motion.closed else motion.parts:
        own = reads.first_of(part.over)
        for symbol in own:
            yield Asked(symbol, part.over, _segment)
        named = own or named  # what is no cell of its own may leave the turn by what is typed before it
        left: Node = al.sub(TURN, al.add(part.begins, part.over))
        why = _turn
        if motion.closed and part is before[-1]:
            left, why = al.sub(last.over, Number(MEETING)), _last
        for symbol in named:
            yield Asked(symbol, left, why, begins=part.begins)


class _Inputs:
    """Which inputs are read by what follows from them."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.dimensions = {dim.symbol: dim.value for dim in mechanism.dimensions}

    def first_of(self, node: Node) -> tuple[str, ...]:
        """The first input that is read, as a tuple of one; none by what reads none."""
        for symbol in symbols(node):
            given = self.dimensions.get(symbol)
            found = (symbol,) if isinstance(given, float) else () if given is None else self.first_of(given)
            if found:
                return found
        return ()


def _base_circle(_: float) -> Said:
    return say("the radius of the base circle must be greater than 0")


def _roller(_: float) -> Said:
    return say("a radius is not negative; 0 is a knife edge")


def _segment(_: float) -> Said:
    return say("a segment goes over an angle greater than 0")


def _turn(end: float) -> Said:
    return say("the segments leave the turn: they end at {end:.6g}°", end=end)


def _last(end: float) -> Said:
    return say("nothing is left of the turn: the segments before end at {end:.6g}°", end=end)

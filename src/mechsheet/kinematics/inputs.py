"""What is asked of inputs beyond their kind, whatever is typed into their cells: segments in one turn, radii that can be,
wheels with teeth, masses that are not negative.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, Unary, symbols, walk
from livesheet.said import Said, say
from mechsheet.kinematics.dimensions import dimension_order
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import MEETING, Gear, Mechanism, Segments

TURN = Number(math.tau + MEETING)
"""Where a turn ends, but for rounding."""


ALWAYS = ("ABS", "COS", "DEGREES", "MAX", "MIN", "RADIANS", "SIN", "SUMSQ")
"""Functions of the format that have a value for all numbers."""

FLUCTUATION = ("flywheel", "fluctuation")
"""The path of the coefficient by which a flywheel is sized."""


@dataclass(frozen=True, slots=True)
class Asked:
    """Something that must be above 0.

    symbol  the input to look at where it is not
    margin  what must be, over dimensions
    why     what is said where it is not, of the angle [degrees] that is a whole turn less the margin
    zero    whether 0 will do, too
    begins  where a segment begins that must end within the turn: of one that begins beyond it an earlier one is told
    reads   the inputs that are read where the margin may have no value although they are numbers, as 360/k has none
    """

    symbol: str
    margin: Node
    why: Callable[[float], Said]
    zero: bool = False
    begins: Node = al.ZERO
    reads: tuple[str, ...] = ()

    @property
    def holds(self) -> Binary:
        """Whether it is."""
        return Binary(">=" if self.zero else ">", self.margin, al.ZERO)

    @property
    def earlier(self) -> Binary | None:
        """Whether it is another one's fault where it is not; None where it cannot be."""
        return None if self.begins == al.ZERO else Binary(">", self.begins, TURN)


def asked_of(mechanism: Mechanism) -> tuple[Asked, ...]:
    """All of it; the description that was read holds it all."""
    reads = _Inputs(mechanism)
    found: list[Asked] = []
    if mechanism.cam is not None:
        radius = al.as_node(mechanism.cam.base_radius)
        found += [Asked(symbol, radius, _base_circle) for symbol in reads.first_of(radius)]
        wheel = al.as_node(mechanism.cam.radius or 0.0)
        found += [Asked(symbol, wheel, _roller, zero=True) for symbol in reads.first_of(wheel)]
        touches = mechanism.cam.touches
        if touches is not None:
            # the offset may be too large as well as the base circle too small: one of them is named
            named = reads.first_of(radius) or reads.first_of(touches)
            found += [Asked(symbol, touches, _out_of_reach, zero=True) for symbol in named]
    if mechanism.segments is not None:
        found += _of_segments(mechanism.segments, reads)
    found += _of_wheels(mechanism, reads)
    for dim in mechanism.dimensions:
        if dim.path[-1:] in (("mass",), ("inertia",)):
            found.append(Asked(dim.symbol, Symbol(dim.symbol), _weight, zero=True))
        if dim.path == FLUCTUATION:
            found.append(Asked(dim.symbol, Symbol(dim.symbol), _fluctuation))
    found = [each for each in found if isinstance(reads.dimensions.get(each.symbol), float)]
    return tuple(
        replace(each, reads=reads.behind_what_may_fail(each.margin)) if each.begins == al.ZERO else each
        for each in found
    )


def refused_of(mechanism: Mechanism, typed: Mapping[str, float]) -> Iterator[tuple[Asked, Said]]:
    """Of each input the first thing that does not hold, and how that is said."""
    asked = asked_of(mechanism)
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
    told: set[str] = set()
    for each in asked:
        with np.errstate(all="ignore"):
            margin = float(value(each.margin, values))
            if each.earlier is not None and (math.isnan(margin) or value(each.earlier, values)):
                continue
        if each.symbol not in told and not (0 < margin < math.inf or (margin == 0 and each.zero)):
            told.add(each.symbol)
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


def _of_wheels(mechanism: Mechanism, reads: _Inputs) -> Iterator[Asked]:
    """No wheel has 0 teeth or no radius, be it what is divided by."""
    for relation in mechanism.relations:
        for part in reads.parts_of(relation.ratio if isinstance(relation, Gear) else relation.radius):
            yield from (Asked(symbol, Call("ABS", (part,)), _wheel) for symbol in reads.first_of(part))


class _Inputs:
    """Which inputs are read by what follows from them."""

    def __init__(self, mechanism: Mechanism) -> None:
        self.dimensions = {dim.symbol: dim.value for dim in mechanism.dimensions}

    def behind_what_may_fail(self, node: Node) -> tuple[str, ...]:
        """All that are read, where what follows from them may have no value although all are numbers; else none."""
        trees, found = [node], []
        for tree in trees:
            for symbol in symbols(tree):
                given = self.dimensions.get(symbol)
                if isinstance(given, float):
                    found.append(symbol)
                elif given is not None:
                    trees.append(given)
        fails = any(_may_fail(part) for tree in trees for part in walk(tree))
        return tuple(dict.fromkeys(found)) if fails else ()

    def parts_of(self, node: Node) -> tuple[Node, ...]:
        """What is divided and what it is divided by, as of 24/18; what is no quotient itself."""
        match node:
            case Unary("-", operand):
                return self.parts_of(operand)
            case Symbol(name) if not isinstance(self.dimensions.get(name, 0.0), float):
                return self.parts_of(al.as_node(self.dimensions[name]))
            case Binary("/", left, right):
                return (left, right)
        return (node,)

    def first_of(self, node: Node) -> tuple[str, ...]:
        """The first input that is read, as a tuple of one; none by what reads none."""
        for symbol in symbols(node):
            given = self.dimensions.get(symbol)
            found = (symbol,) if isinstance(given, float) else () if given is None else self.first_of(given)
            if found:
                return found
        return ()


def _may_fail(part: Node) -> bool:
    """Whether an operation may have no value although all that it reads are numbers."""
    match part:
        case Binary("^", _, Number(exponent)):
            return exponent not in (1.0, 2.0)
        case Binary("/" | "^", _, _):
            return True
        case Call(name, _):
            return name not in ALWAYS
    return False


def _wheel(_: float) -> Said:
    return say("the teeth or the radius of a wheel must not be 0")


def _weight(_: float) -> Said:
    return say("a mass or a moment of inertia is not negative")


def _fluctuation(_: float) -> Said:
    return say("the coefficient of fluctuation must be greater than 0")


def _base_circle(_: float) -> Said:
    return say("the radius of the base circle must be greater than 0")


def _out_of_reach(_: float) -> Said:
    return say("the roller never touches a base circle of this radius")


def _roller(_: float) -> Said:
    return say("a radius is not negative; 0 is a knife edge")


def _segment(_: float) -> Said:
    return say("a segment goes over an angle greater than 0")


def _turn(end: float) -> Said:
    return say("the segments leave the turn: they end at {end:.6g}°", end=end)


def _last(end: float) -> Said:
    return say("nothing is left of the turn: the segments before end at {end:.6g}°", end=end)

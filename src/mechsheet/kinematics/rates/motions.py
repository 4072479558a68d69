"""How every body moves, over symbols: the rates of its places, and where the two sides of a dyad meet.

J v = (-v_y, v_x); d the direction of a line, n = J d; a prime is the derivative by the driver or by time, as `Rates` says.

    turning about a known place P     X' = P' + theta' J(X-P),     X'' = P'' + theta'' J(X-P) - theta'^2 (X-P)
    sliding on a solved body          X' = X_b' + s' d,            X'' = X_b'' + s'' d + 2 s' theta' n
      where X_b is the place of that body at X (the last term is Coriolis's)

So a dyad of any kind is two ways to the rates of one point, in which two unknown rates are linear.
Source: Soeylemez, Mechanisms, chapter 4; Uicker, Pennock and Shigley, Theory of Machines and Mechanisms, chapters 3 and 4.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass
from typing import Protocol, TypeAlias

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node
from livesheet.formula.vectors import NOWHERE, Vector, minus, plus, times, turned
from mechsheet.kinematics.assur import Drive, Dyad, Order, Pin
from mechsheet.kinematics.gear_relations import Tied
from mechsheet.kinematics.graph import Assembly, Slide
from mechsheet.kinematics.points_in_link import angle_of
from mechsheet.kinematics.poses import Poses


@dataclass(frozen=True, slots=True)
class Rate:
    """First and second derivative of an angle or a displacement."""

    first: Node
    second: Node

    @property
    def both(self) -> tuple[Node, Node]:
        """The first, and the second."""
        return self.first, self.second

    def __neg__(self) -> Rate:
        return Rate(al.neg(self.first), al.neg(self.second))

    def __add__(self, other: Rate) -> Rate:
        return Rate(al.add(self.first, other.first), al.add(self.second, other.second))

    def by_time(self, driver: Rate) -> Rate:
        """Of what these are by the driver's variable: q' omega12 and q'' omega12^2 + q' alpha12."""
        second = al.add(al.mul(self.second, al.square(driver.first)), al.mul(self.first, driver.second))
        return Rate(al.mul(self.first, driver.first), second)


@dataclass(frozen=True, slots=True)
class PointRate:
    """First and second derivative of a place."""

    first: Vector
    second: Vector

    def of(self, order: int) -> Vector:
        """The first or the second."""
        return self.first if order == 1 else self.second

    def by_time(self, driver: Rate) -> PointRate:
        """Of what these are by the driver's variable: x' omega12 and x'' omega12^2 + x' alpha12."""
        second = plus(times(al.square(driver.first), self.second), times(driver.second, self.first))
        return PointRate(times(driver.first, self.first), second)


Motion: TypeAlias = Callable[[Vector], PointRate]
"""The rates of the place of a body that is at some coordinates now."""

STANDING = Rate(al.ZERO, al.ZERO)
FIXED = PointRate(NOWHERE, NOWHERE)


class Rates(Protocol):
    """What the derivatives are called, and of which points they are known."""

    def of_drive(self, symbol: str) -> Rate:
        """Of what is driven, by its symbol."""

    def of(self, symbol: str) -> Rate:
        """An unknown angle's or displacement's."""

    def of_relative(self, symbol: str) -> Rate:
        """Of an angle against the driven pair's base, which follows from the driver alone."""

    def of_point(self, point: str) -> PointRate | None:
        """Those of a point that has columns of its own, else None."""


@dataclass(frozen=True, slots=True)
class Meeting:
    """Two ways to the rates of a dyad's closing point; `unknowns` are the symbols whose rates it decides."""

    ways: tuple[PointRate, PointRate]
    unknowns: tuple[str, str]


def about(place: Vector, moves: PointRate, turning: Rate) -> Motion:
    """Of a body that turns about a place that moves."""

    def motion(at: Vector) -> PointRate:
        arm = minus(at, place)
        square = al.square(turning.first)
        second = minus(plus(moves.second, times(turning.second, turned(arm))), times(square, arm))
        return PointRate(plus(moves.first, times(turning.first, turned(arm))), second)

    return motion


def along(carrier: Motion, turning: Rate, direction: Vector, slide: Rate) -> Motion:
    """Of a body that slides on a carrier, both turning alike."""
    coriolis = al.mul(al.TWO, al.mul(slide.first, turning.first))

    def motion(at: Vector) -> PointRate:
        carried = carrier(at)
        second = plus(plus(carried.second, times(slide.second, direction)), times(coriolis, turned(direction)))
        return PointRate(plus(carried.first, times(slide.first, direction)), second)

    return motion


def relative_name(poses: Poses, body: str) -> str:
    """What the angle of a link against the driven pair's base is called: only its derivatives have columns."""
    return f"rel_{poses.links[body].number}"


class Motions:
    """The motion of every solved body; `turning`: how fast each turns."""

    def __init__(self, poses: Poses, order: Order, rates: Rates, still: Drive | None = None) -> None:
        """`still`: the driven pair whose base stands still, instead of the ground."""
        self.poses, self.order, self.rates = poses, order, rates
        base = still.base if still else poses.mechanism.ground.name
        self.turning: dict[str, Rate] = {base: STANDING}
        self.motion: dict[str, Motion] = {base: lambda _: FIXED}
        if still:
            self.drive(still)

    # --- points -----------------------------------------------------------------------------------------------

    def of_point(self, point: str, length: Callable[[Node], float]) -> PointRate:
        """The rates of a point: its own columns, or the shortest way to write them, measured by `length`."""
        own = self.rates.of_point(point)
        if own is not None:
            return own
        bodies = [body for body in self.poses.graph.bodies_at(point) if body in self.motion]
        ways = [self.motion[body](self.poses.xy[point]) for body in bodies]
        return min(ways, key=lambda way: sum(map(length, (*way.first, *way.second))))

    # --- bodies -----------------------------------------------------------------------------------------------

    def direction(self, slide: Slide) -> Vector:
        """Of a sliding joint's line."""
        joint = slide.joint
        angle = self.poses.directions.get(joint.symbol)
        if angle is None:
            angle = self.poses.known[slide.on].angle + angle_of(joint.angle)
        return al.cos(angle), al.sin(angle)

    def drive(self, drive: Drive) -> None:
        """The moving side of a driven joint, when the motion of its base is known."""
        rate = self.rates.of_drive(drive.symbol)
        if isinstance(drive.joint, Pin):
            pin = drive.joint.point
            turning = self.turning[drive.base] + (rate if drive.positive else -rate)
            self._turns(drive.moving, pin, self.motion[drive.base](self.poses.xy[pin]), turning)
        else:
            self._slides(drive.moving, drive.joint, rate)

    def tie(self, tied: Tied, rates: Mapping[str, Rate]) -> None:
        """The bodies that gears and racks decide, by the rates of what these decide."""
        for held in tied.bodies:
            if isinstance(held.at, Slide):
                self._slides(held.body, held.at, rates[held.variable])
                continue
            at = self.poses.xy[held.at]
            moves = self.rates.of_point(held.at)
            if moves is None:
                carrier = next(body for body in self.poses.graph.bodies_at(held.at) if body in self.motion)
                moves = self.motion[carrier](at)
            self._turns(held.body, held.at, moves, rates[held.variable])

    def of_tie(self, name: str, slid: Callable[[str], Rate]) -> Rate:
        """Of what a gear or a rack reads: an angle, by the name of the body, or a displacement."""
        return self._angular(name, ()) if name in self.poses.graph.bodies else slid(name)

    def _angular(self, body: str, tried: tuple[str, ...]) -> Rate:
        """Of a body that is solved, or that slides on or is driven from one of which it is known."""
        if body in self.turning:
            return self.turning[body]
        for slide in self.poses.graph.slides_of(body):
            other = slide.other(body)
            if other not in tried and slide.body not in self.poses.graph.blocks:
                with suppress(KeyError):
                    return self._angular(other, (*tried, body))
        for drive in self.order.drives:
            if body in drive.bodies and isinstance(drive.joint, Pin):
                other, outwards = (drive.base, True) if body == drive.moving else (drive.moving, False)
                rate = self.rates.of_drive(drive.symbol)
                if other not in tried:
                    with suppress(KeyError):
                        return self._angular(other, (*tried, body)) + (rate if outwards == drive.positive else -rate)
        raise KeyError(body)

    def _turns(self, body: str, pin: str, moves: PointRate, turning: Rate) -> None:
        self.turning[body] = turning
        self.motion[body] = about(self.poses.xy[pin], moves, turning)

    def _slides(self, body: str, slide: Slide, rate: Rate) -> None:
        """A body on another whose motion is known; a positive displacement moves `slide.body` on `slide.on`."""
        carrier = slide.other(body)
        self.turning[body] = self.turning[carrier]
        own = rate if body == slide.body else -rate
        self.motion[body] = along(self.motion[carrier], self.turning[carrier], self.direction(slide), own)

    def _whole(self, assembly: Assembly, body: str) -> None:
        """The bodies of an assembly, of which one is known."""
        if len(assembly) == 2:
            drive = self.order.pair(assembly)
            self.drive(drive if drive.base == body else drive.reverse())
        if len(assembly) > 2:
            self._with_pair(assembly, body)

    def _with_pair(self, assembly: Assembly, known: str) -> None:
        """The bodies that move with the driven pair: each turns against its base as the driver says, about a shared pin."""
        drive = self.order.pair(assembly)
        base = self.turning[known] + -self.relative(known, drive)
        waiting = [body for body in assembly if body != known]
        while waiting:
            body, pin, carrier = next(
                (body, point, other)
                for body in waiting
                for other in assembly
                if other not in waiting
                for point in self.poses.graph.points[body]
                if point in self.poses.graph.points[other]
            )
            moves = self.motion[carrier](self.poses.xy[pin])
            self._turns(body, pin, moves, base + self.relative(body, drive))
            waiting.remove(body)

    def relative(self, body: str, drive: Drive) -> Rate:
        """How fast a body that moves with the driven pair turns against the pair's base."""
        if body == drive.base or (body == drive.moving and not isinstance(drive.joint, Pin)):
            return STANDING
        if body == drive.moving:
            rate = self.rates.of_drive(drive.symbol)
            return rate if drive.positive else -rate
        return self.rates.of_relative(relative_name(self.poses, body))

    def meet_within(self, dyad: Dyad) -> Meeting:
        """The two ways to the closing point of a dyad on the driven pair, whose base stands still here."""
        drive = self.order.pair(dyad.frame)
        p, q, r = dyad.pins
        ways = []
        for (body,), pin in zip(dyad.assemblies, (p, q), strict=True):
            moves = self.motion[self.with_point(dyad.frame, pin)](self.poses.xy[pin])
            self._turns(body, pin, moves, self.relative(body, drive))
            ways.append(self.motion[body](self.poses.xy[r]))
        names = [relative_name(self.poses, body) for (body,) in dyad.assemblies]
        return Meeting((ways[0], ways[1]), (names[0], names[1]))

    def with_point(self, assembly: Assembly, point: str) -> str:
        """The body of an assembly that has a point."""
        return next(body for body in assembly if point in self.poses.graph.points[body])

    # --- dyads ------------------------------------------------------------------------------------------------

    def _pinned(self, assembly: Assembly, pin: Pin, moves: PointRate) -> str:
        """An assembly at an outer pin: the angle that is unknown."""
        body = self.with_point(assembly, pin.point)
        symbol = self.poses.links[body].angle_symbol if body in self.poses.links else ""
        self._turns(body, pin.point, moves, self.rates.of(symbol))
        self._whole(assembly, body)
        return symbol

    def pinned(self, assembly: Assembly, point: str, moves: PointRate, turning: Rate) -> None:
        """An assembly that turns about a point, `turning` being that of its first body."""
        body = self.with_point(assembly, point)
        if body != assembly[0]:
            drive = self.order.pair(assembly)
            turning = turning + self.relative(body, drive) + -self.relative(assembly[0], drive)
        self._turns(body, point, moves, turning)
        self._whole(assembly, body)

    def guided(self, assembly: Assembly, slide: Slide) -> str:
        """An assembly on a guide of a solved body: the displacement that is unknown."""
        body = slide.side(assembly)
        self._slides(body, slide, self.rates.of(slide.joint.symbol))
        self._whole(assembly, body)
        return slide.joint.symbol

    def meet(self, dyad: Dyad, outer: Mapping[str, PointRate]) -> Meeting:
        """The two ways to a dyad's closing point.

        outer  the rates of its outer pins
        """
        if isinstance(dyad.inner, Pin):
            return self._meet_at_pin(dyad, dyad.inner, outer)
        first, second = dyad.outer
        if isinstance(first, Pin) and isinstance(second, Pin):
            return self._meet_on_slide(dyad, dyad.inner, outer)
        if isinstance(first, Pin) and isinstance(second, Slide):
            return self._meet_on_slides(dyad, dyad.inner, first, second, outer)
        raise TypeError(f"no such dyad: {dyad}")

    def _meet_at_pin(self, dyad: Dyad, inner: Pin, outer: Mapping[str, PointRate]) -> Meeting:
        """RRR, RRP, PRP: at the inner pin."""
        place = self.poses.xy[inner.point]
        unknowns, ways = [], []
        for assembly, contact in zip((dyad.first, dyad.second), dyad.outer, strict=True):
            if isinstance(contact, Pin):
                unknowns.append(self._pinned(assembly, contact, outer[contact.point]))
            else:
                unknowns.append(self.guided(assembly, contact))
            ways.append(self.motion[self.with_point(assembly, inner.point)](place))
        return Meeting((ways[0], ways[1]), (unknowns[0], unknowns[1]))

    def _meet_on_slide(self, dyad: Dyad, inner: Slide, outer: Mapping[str, PointRate]) -> Meeting:
        """RPR: at the outer pin of the link that does not carry the line."""
        carrier, slider, p, q = dyad.by_line
        angle = self._pinned(carrier, p, outer[p.point])
        self._slides(inner.body, inner, self.rates.of(inner.joint.symbol))
        self._whole(slider, inner.body)
        return Meeting(self._at_known(slider, q, outer[q.point]), (angle, inner.joint.symbol))

    def _at_known(self, assembly: Assembly, pin: Pin, moves: PointRate) -> tuple[PointRate, PointRate]:
        """An assembly that has slid to a known pin: both ways to its rates; it then turns about it."""
        body = self.with_point(assembly, pin.point)
        way = self.motion[body](self.poses.xy[pin.point])
        self._turns(body, pin.point, moves, self.turning[body])  # as sliding has it, and shorter
        self._whole(assembly, body)
        return way, moves

    def _meet_on_slides(
        self, dyad: Dyad, inner: Slide, pin: Pin, slide: Slide, outer: Mapping[str, PointRate]
    ) -> Meeting:
        """RPP: at the outer pin."""
        guide = self.guided(dyad.second, slide)
        body = inner.side(dyad.first)
        self._slides(body, inner, self.rates.of(inner.joint.symbol))
        self._whole(dyad.first, body)
        return Meeting(self._at_known(dyad.first, pin, outer[pin.point]), (guide, inner.joint.symbol))

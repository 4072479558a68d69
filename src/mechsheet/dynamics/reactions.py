"""Reactions of all joints, dyad by dyad in reverse order of solution; then the driver's effort.

S and M(X) of both assemblies hold all that acts on them but the dyad's own joints (`acting`); a = R-P, b = R-Q, d the
direction of a line, n = J d, D what the rates of the dyad are divided by. X is the force of 2 on 1 at the inner pin R.

    RRR  X = -(M1(P) b + M2(Q) a)/D
    RRP  X = ((S2.d) a - M1(P) n)/D
    RPR  force along n of the carrier on the other: N = (M1(P) + M2(Q))/D
    PRP  f1 = -S1.d1, f2 = S2.d2, X = (f1 d2_y - f2 d1_y, f2 d1_x - f1 d2_x)/D
    RPP  force along n2 of 2 on 1: N = -(S2.d1)/D
    cam  force along its normal n on the follower: N = -(S.P')/(n.P'), a prime by the follower's variable; where other links
         lie between, S.P' is the work of all that acts on any link, and N is known before all else

A spring whose free length L0 is longer by u pulls less by k u. So it just holds a follower on its cam where

    N = 0    for    L0 + N (n.P')/(k L'),    L' = w.(p2' - p1')/L,    w = p2 - p1 its way, n.P' the lever of N

What hangs on a pin besides is counted to the body that the pin was solved with. Source: the equilibrium of each assembly;
Uicker, Pennock and Shigley, Theory of Machines and Mechanisms, chapters 13 and 15.
"""

from __future__ import annotations

from livesheet.diagnostics import Fault
from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node
from livesheet.formula.vectors import (
    NOWHERE,
    Vector,
    cross,
    dot,
    minus,
    negative,
    over,
    plus,
    times,
    together,
    turned,
)
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.dynamics.acting import ActingForces, Force, moment_of, sum_of
from mechsheet.dynamics.chains import ChainReactions
from mechsheet.dynamics.joints import Joints
from mechsheet.dynamics.teeth import Teeth
from mechsheet.dynamics.whole_mechanism import own_works
from mechsheet.kinematics.assur import Drive, Dyad, Pin
from mechsheet.kinematics.cams.profile import Contact
from mechsheet.kinematics.equations import Condition
from mechsheet.kinematics.gear_relations import Tied
from mechsheet.kinematics.graph import Assembly, Slide
from mechsheet.kinematics.newton.chains import Chain
from mechsheet.model import FurtherDriver, Spring
from mechsheet.units import LENGTH
from mechsheet.words.equations import phrase


class Reactions:
    """Of one mechanism.

    on_pairs  by the symbol of what is driven: the force of a pin, at which more are joined, on both links turned about it
    """

    def __init__(self, acting: ActingForces) -> None:
        self.acting, self.found = acting, acting.found
        self.poses, self.motions, self.columns = acting.poses, acting.motions, acting.columns
        self.joints = Joints(acting)
        self.teeth = Teeth(acting, self.joints)
        self.contact = acting.found.rates.contact
        self.on_pairs: dict[str, Vector] = {}

    def write(self) -> dict[str, str]:
        """Write all columns down; the symbols of the efforts, by that of what is driven: a cam's follower has none."""
        efforts: dict[str, str] = {}
        ledger = self.poses.ledger
        ledger.group = len(self.found.order.groups)
        if self.contact is not None and not self.contact.direct:
            self._press(self.contact, self._work(self.contact))
        for step in reversed(self.found.order.steps):
            if isinstance(step, Drive) and self.contact is not None and step.symbol == self.contact.follower:
                self._pressed(step, self.contact)
            elif isinstance(step, Drive):
                efforts[step.symbol] = self._effort(step, on_known=True)
            elif isinstance(step, Tied):
                self.teeth.write(step)
            else:
                det = self.found.rates.determinants[ledger.group]
                if isinstance(step, Dyad) and step.frame:
                    self._triangle(step, det)
                elif isinstance(step, Dyad):
                    self._dyad(step, det)
                else:
                    solution = self.found.chains[ledger.group]
                    ChainReactions(solution, self.acting, self.joints, self.teeth).write(det)
                self._driven_inside(step, efforts)
                ledger.group -= 1
        ledger.group = 0
        return efforts

    def _driven_inside(self, group: Dyad | Chain, efforts: dict[str, str]) -> None:
        """The driven joints of pairs whose other joints are known by now: those of the group's links, or of its frame."""
        frame = group.frame if isinstance(group, Dyad) else ()
        for assembly in (*group.assemblies, frame):
            if len(assembly) < 2:
                continue
            drive = self.found.order.pair(assembly)
            if drive.symbol not in self.on_pairs:
                self._refuse_shared_pin(group, drive)
            if len(assembly) != 2:
                continue
            if self.contact is not None and drive.symbol == self.contact.follower:
                self._let_go(drive, *self._all_on(drive.moving, self._place_of(drive)), on_known=False)
            else:
                efforts[drive.symbol] = self._effort(drive, on_known=False, group=group)

    # --- sums over an assembly --------------------------------------------------------------------------------

    def _sum(self, assembly: Assembly) -> Vector:
        return together(self.acting.total(body) for body in assembly)

    def _moment(self, assembly: Assembly, about: Vector) -> Node:
        return al.total(self.acting.moment(body, about) for body in assembly)

    def _at(self, pin: Pin) -> Vector:
        return self.poses.xy[pin.point]

    # --- dyads ------------------------------------------------------------------------------------------------

    def _dyad(self, dyad: Dyad, det: Node) -> None:
        first, second = dyad.outer
        if isinstance(dyad.inner, Pin):
            if isinstance(first, Pin) and isinstance(second, Pin):
                return self._rrr(dyad, (first, second), dyad.inner, det)
            if isinstance(first, Pin) and isinstance(second, Slide):
                return self._rrp(dyad, first, dyad.inner, second, det)
            if isinstance(first, Slide) and isinstance(second, Slide):
                return self._prp(dyad, (first, second), dyad.inner, det)
        elif isinstance(first, Pin) and isinstance(second, Pin):
            return self._rpr(dyad, dyad.inner, det)
        elif isinstance(first, Pin) and isinstance(second, Slide):
            return self._rpp(dyad, first, dyad.inner, second, det)
        raise TypeError(f"no such dyad: {dyad}")

    def _inner(self, dyad: Dyad, pin: Pin, force: Vector) -> Vector:
        """Write the force of the second on the first at the inner pin down; the same over its columns."""
        one, other = (self.motions.with_point(assembly, pin.point) for assembly in (dyad.first, dyad.second))
        pairs = [self._turned_about(assembly, pin) for assembly in (dyad.first, dyad.second)]
        if pairs.count(None) != 1:
            return self.joints.inner(pin.point, one, other, force)
        if pairs[0] is not None:
            force = negative(self.joints.shared(pin.point, other, negative(force), self._at_pin(dyad, pin)))
            self.on_pairs[pairs[0].symbol] = force
        elif pairs[1] is not None:
            force = self.joints.shared(pin.point, one, force, self._at_pin(dyad, pin))
            self.on_pairs[pairs[1].symbol] = negative(force)
        return force

    def _outer(self, assembly: Assembly, pin: Pin, force: Vector) -> None:
        drive = self._turned_about(assembly, pin)
        if drive is None:
            self.joints.outer(pin.point, self.motions.with_point(assembly, pin.point), force)
        else:
            self.on_pairs[drive.symbol] = force

    def _turned_about(self, assembly: Assembly, pin: Pin) -> Drive | None:
        """The driver of a pair that is turned about a pin by which it is joined to others, too."""
        drive = self.found.order.pair(assembly) if len(assembly) == 2 else None
        if drive is None or (self.contact is not None and drive.symbol == self.contact.follower):
            return None
        return drive if isinstance(drive.joint, Pin) and drive.joint.point == pin.point else None

    def _at_pin(self, group: Dyad, pin: Pin) -> set[str]:
        return {body for body in group.bodies if pin.point in self.poses.graph.points[body]}

    def _rrr(self, dyad: Dyad, outer: tuple[Pin, Pin], inner: Pin, det: Node) -> None:
        p, q = outer
        r = self._at(inner)
        a, b = minus(r, self._at(p)), minus(r, self._at(q))
        m1, m2 = self._moment(dyad.first, self._at(p)), self._moment(dyad.second, self._at(q))
        force = _over(negative(plus(times(m1, b), times(m2, a))), al.mul(det, self.columns.metre))
        force = self._inner(dyad, inner, force)
        self._outer(dyad.first, p, minus(negative(self._sum(dyad.first)), force))
        self._outer(dyad.second, q, minus(force, self._sum(dyad.second)))

    def _triangle(self, dyad: Dyad, det: Node) -> None:
        """A dyad RRR on a driven pair: it moves with the pair, so that what holds all of them is known before."""
        outer, r = dyad.pins[:2], self._at(Pin(dyad.pins[2]))
        self._refuse_crowded(dyad)
        arms, moments, totals = [], [], []
        for (body,), point in zip(dyad.assemblies, outer, strict=True):
            held = self.joints.contacts.get(body, [])[:]
            p = self.poses.xy[point]
            total = self.acting.total(body)
            couples = [self.acting.moment(body, p), *self.joints.couples.get(body, [])]
            name = f"M{self.acting.number(body)}"
            moments.append(self.acting.torque(name, moment_of(held, p), couples, self.poses.name((body,))))
            totals.append(together((total, *(force.vector for force in held))))
            arms.append(minus(r, p))
        both = plus(times(moments[0], arms[1]), times(moments[1], arms[0]))
        force = self._inner(dyad, Pin(dyad.pins[2]), _over(negative(both), al.mul(det, self.columns.metre)))
        for (body,), point, total, on_it in zip(dyad.assemblies, outer, totals, (force, negative(force)), strict=True):
            self._on_pair(point, body, self.motions.with_point(dyad.frame, point), minus(negative(total), on_it))

    def _on_pair(self, point: str, body: str, other: str, force: Vector) -> None:
        """The force on a link where it is pinned to one with which it moves."""
        if self.joints.bearers[point] == body:
            self.joints.inner(point, body, other, force)
        else:
            self.joints.inner(point, other, body, negative(force))

    def _refuse_crowded(self, dyad: Dyad) -> None:
        for point in dyad.pins:
            if self.joints.bearers[point] not in dyad.whole:
                message = say(
                    "at {point} a driven pair, a link that moves with it and a third are joined: no forces yet",
                    point=point,
                )
                hint = say("take masses and loads away, or let the links be joined at two points")
                raise MechanismError(Fault(message, key="dynamics", hint=hint))

    def _rrp(self, dyad: Dyad, pin: Pin, inner: Pin, slide: Slide, det: Node) -> None:
        p, r = self._at(pin), self._at(inner)
        d = self.motions.direction(slide)
        n = turned(d)
        if slide.body not in dyad.second:
            det = al.neg(det)  # a.d: the displacement counts against the line's direction
        s2 = self._sum(dyad.second)
        m1 = over(self._moment(dyad.first, p), self.columns.metre)
        force = _over(minus(times(dot(s2, d), minus(r, p)), times(m1, n)), det)
        force = self._inner(dyad, inner, force)
        self._outer(dyad.first, pin, minus(negative(self._sum(dyad.first)), force))
        self._guide(dyad.second, slide, minus(force, s2), r)

    def _guide(self, assembly: Assembly, slide: Slide, force: Vector, at: Vector, couple: Node = al.ZERO) -> None:
        """The guide's normal force on an assembly that is held by `force` at a place, and its couple there."""
        normal = dot(force, turned(self.motions.direction(slide)))
        about = al.sub(couple, self._moment(assembly, at))
        self.joints.slide(slide, slide.side(assembly), normal, about, at)

    def _rpr(self, dyad: Dyad, inner: Slide, det: Node) -> None:
        carrier, slider, p, q = dyad.by_line
        m2 = self._moment(slider, self._at(q))
        moments = al.add(self._moment(carrier, self._at(p)), m2)
        normal = over(moments, al.mul(det, self.columns.metre))
        force = self.joints.slide(inner, inner.body, normal, al.neg(m2), self._at(q))
        self._outer(carrier, p, minus(force, self._sum(carrier)))
        self._outer(slider, q, minus(negative(self._sum(slider)), force))

    def _prp(self, dyad: Dyad, outer: tuple[Slide, Slide], inner: Pin, det: Node) -> None:
        (d1, d2), r = (self.motions.direction(slide) for slide in outer), self._at(inner)
        s1, s2 = self._sum(dyad.first), self._sum(dyad.second)
        f1, f2 = al.neg(self._along(dyad.first, s1, d1)), self._along(dyad.second, s2, d2)
        x = al.sub(al.mul(f1, d2[1]), al.mul(f2, d1[1]))
        y = al.sub(al.mul(f2, d1[0]), al.mul(f1, d2[0]))
        force = self._inner(dyad, inner, _over((x, y), det))
        self._guide(dyad.first, outer[0], minus(negative(s1), force), r)
        self._guide(dyad.second, outer[1], minus(force, s2), r)

    def _along(self, assembly: Assembly, total: Vector, d: Vector) -> Node:
        """S . d of an assembly, as a column: it is read twice."""
        what = self.poses.name(assembly)
        label = phrase("sum_along", link=what)
        return self.columns.grey(f"S{self.acting.number(assembly[0])}_d", dot(total, d), self.columns.force, label)

    def _rpp(self, dyad: Dyad, pin: Pin, inner: Slide, slide: Slide, det: Node) -> None:
        d1, p = self.motions.direction(slide), self._at(pin)
        s2 = self._sum(dyad.second)
        normal = al.neg(over(dot(s2, d1), det))
        couple = al.neg(self._moment(dyad.first, p))
        body = inner.side(dyad.first)
        force = self.joints.slide(inner, body, normal, couple, p)
        self._outer(dyad.first, pin, minus(negative(self._sum(dyad.first)), force))
        self._guide(dyad.second, slide, minus(force, s2), p, couple)

    # --- the driver -------------------------------------------------------------------------------------------

    def _refuse_shared_pin(self, group: Dyad | Chain, drive: Drive) -> None:
        if isinstance(drive.joint, Pin) and drive.joint.point in group.pins:
            message = say(
                "the driver turns two moving links about {point}, where a third one is joined: no forces there yet",
                point=drive.joint.point,
            )
            hint = say("take masses and loads away, or drive another link")
            raise MechanismError(Fault(message, key=self._key(drive), hint=hint))

    def _key(self, drive: Drive) -> str:
        """Where the description names the link that is driven."""
        driver = self.poses.mechanism.driver_of(drive.symbol)
        return f"drivers.{driver.order}.link" if isinstance(driver, FurtherDriver) else "driver.link"

    def _effort(self, drive: Drive, on_known: bool, group: Dyad | Chain | None = None) -> str:
        """The driven joint's own forces, from the equilibrium of the moving link alone.

        on_known  whether its base was known before it; else both its sides are of one `group`
        """
        moving, joint, at = drive.moving, drive.joint, self._place_of(drive)
        ground = self.poses.mechanism.ground.name
        if isinstance(joint, Pin) and drive.base == ground and not self.joints.contacts.get(moving):
            # alone it holds the link: its force is minus the sum of all others, which needs no columns besides
            acting = self.acting.of(moving)
            force = self.joints.outer(joint.point, moving, negative(sum_of(acting.forces)))
            acting.sum = negative(force)
            driver, moment = self.poses.mechanism.driver_of(drive.symbol), self.acting.moment(moving, at, whole=True)
            return self.joints.driving_torque(driver, al.neg(moment) if driver.link == moving else moment)
        total, moment = self._all_on(moving, at)
        if isinstance(joint, Pin):
            if on_known:
                self.joints.outer(joint.point, moving, negative(total))
            elif isinstance(group, Dyad) and drive.symbol in self.on_pairs:
                self._part(drive, joint, group, total)
            else:
                self.joints.inner_of_pair(joint.point, drive.base, moving, total)
            torque = al.neg(moment)
            if on_known:
                self.acting.hang(drive.base, Force(NOWHERE, NOWHERE), moment)
            driver = self.poses.mechanism.driver_of(drive.symbol)
            return self.joints.driving_torque(driver, torque if driver.link == moving else moment)
        if on_known:
            self.acting.hang(drive.base, Force(total, at), moment)
        return self.joints.driven_slide(joint, moving, negative(total), al.neg(moment))

    def _part(self, drive: Drive, pin: Pin, group: Dyad, total: Vector) -> None:
        """What a pin exerts on both links that are turned about it, in two. `total`: all else on the one that is driven."""
        on_both, beside = self.on_pairs[drive.symbol], self._at_pin(group, pin)
        on_moving = self.joints.shared(pin.point, drive.moving, negative(total), beside)
        on_base = self.joints.shared(pin.point, drive.base, minus(on_both, on_moving), beside)
        self.joints.close_shared(pin.point, plus(on_moving, on_base), beside)

    def _place_of(self, drive: Drive) -> Vector:
        joint = drive.joint
        return self.poses.xy[joint.point if isinstance(joint, Pin) else joint.joint.point]

    def _all_on(self, moving: str, at: Vector) -> tuple[Vector, Node]:
        """The sum of all that acts on a link but at its driven joint, and its moment about a place."""
        held: list[Force] = self.joints.contacts.get(moving, [])
        total = together((*(force.vector for force in held), self.acting.total(moving)))
        arms = al.mul(self.columns.metre, moment_of(held, at))
        return total, al.total([self.acting.moment(moving, at), arms, *self.joints.couples.get(moving, [])])

    # --- a cam ------------------------------------------------------------------------------------------------

    def _work(self, contact: Contact) -> Node:
        """What all that acts does, in forces, while the follower's variable grows and the cam stands."""
        works, turnings = own_works(self.acting, contact.moved, contact.turned)
        return al.total([*works, *(over(turning, self.columns.metre) for turning in turnings)])

    def _press(self, contact: Contact, work: Node) -> Vector:
        """N, which balances the work; the force over its column."""
        value, force = self.joints.pressed(contact, al.neg(over(work, contact.lever)))
        write_preload(self.acting, contact, value)
        return force

    def _pressed(self, drive: Drive, contact: Contact) -> None:
        """The force of a cam on its follower, where a drive's effort would be; what is left for the follower's joint."""
        joint, at = drive.joint, self._place_of(drive)
        total, moment = self._all_on(drive.moving, at)
        if contact.direct:
            work = (
                over(moment, self.columns.metre)
                if isinstance(joint, Pin)
                else dot(total, contact.moved(contact.link, at))
            )
            force = self._press(contact, work)
            total = plus(total, force)
            moment = al.add(moment, al.mul(self.columns.metre, cross(minus(contact.at, at), force)))
        self._let_go(drive, total, moment, on_known=True)

    def _let_go(self, drive: Drive, total: Vector, moment: Node, on_known: bool) -> None:
        """The joint of what a cam moves, which holds but does not drive; arguments as `_all_on` has them, and `_effort`."""
        joint, base = drive.joint, drive.base
        if isinstance(joint, Pin):
            if on_known:
                self.joints.outer(joint.point, drive.moving, negative(total))
            else:
                self.joints.inner_of_pair(joint.point, base, drive.moving, total)
            return
        if on_known:
            self.acting.hang(base, Force(total, self._place_of(drive)), moment)
        self.joints.guiding_slide(joint, drive.moving, negative(total), al.neg(moment))


def _over(parts: Vector, divisor: Node) -> Vector:
    return over(parts[0], divisor), over(parts[1], divisor)


def holding_spring(acting: ActingForces, contact: Contact) -> Spring | None:
    """The only spring between the ground and the link on which a cam presses, else the only one that the cam does not hold;
    None where there are several."""
    ground = acting.poses.mechanism.ground.name
    ends = [(spring, {name for name, _ in spring.ends}) for spring in acting.dynamics.springs]
    near = [spring for spring, links in ends if links == {ground, contact.link}]
    found = near or [spring for spring, links in ends if contact.cam not in links]
    return found[0] if len(found) == 1 else None


def write_preload(acting: ActingForces, contact: Contact, force: Node) -> None:
    """Write the column down, where one spring holds the follower; `force`: N."""
    spring = holding_spring(acting, contact)
    if spring is None:
        return
    places = [acting.poses.xy[point] for _, point in spring.ends]
    start, end = (contact.moved(link, at) for (link, _), at in zip(spring.ends, places, strict=True))
    opens = al.div(dot(minus(places[1], places[0]), minus(end, start)), acting.length(spring))
    if al.is_zero(opens):
        return
    longer = al.div(al.mul(force, contact.lever), al.mul(spring.stiffness, opens))
    label = phrase("spring_hold", name=spring.name)
    stretched = () if contact.direct else (Condition(Call("ABS", (opens,)), contact.least),)
    acting.columns.written(spring.hold, al.add(spring.free_length, longer), LENGTH, label, "hold", exists=stretched)

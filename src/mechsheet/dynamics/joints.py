"""The forces at each joint under the names that people read: who acts on whom, and what is handed on to the next group.

A pin belongs to the first link, in the description's order, that has its point; F34 is the force of link 3 on link 4. What
all bodies at a pin are acted on by is 0 together. A sliding joint acts from `on` on `link`: F14.n along the left normal of
its line, F14.c about its point. So what the block of a pin-slot joint presses on the pin acts on the joint's link; where
that is not the owner, the owner exerts on it what the pin exerts on both together.
"""

from __future__ import annotations

from collections.abc import Set

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node
from livesheet.formula.vectors import NOWHERE, Vector, cross, dot, minus, negative, plus, times, together, turned
from livesheet.said import Words
from mechsheet.dynamics.acting import ActingForces, Force
from mechsheet.kinematics.assur import bodies_of
from mechsheet.kinematics.cams.profile import Contact
from mechsheet.kinematics.equations import ForceKind
from mechsheet.kinematics.graph import Slide
from mechsheet.model import CONTACT, Driver, FurtherDriver, pair_symbol
from mechsheet.words.equations import phrase


class Joints:
    """Of one mechanism.

    contacts, couples  by body what the joints of its group exert on it
    """

    def __init__(self, acting: ActingForces) -> None:
        self.acting, self.columns = acting, acting.columns
        self.order, self.poses = acting.found.order, acting.poses
        self.mechanism = acting.poses.mechanism
        self.contacts: dict[str, list[Force]] = {}
        self.couples: dict[str, list[Node]] = {}
        self.pins: dict[str, dict[str, Vector]] = {}
        self.bearers = self._bearers()
        self.slotted = self._slotted()
        self._booked: set[tuple[str, str]] = set()

    def _slotted(self) -> dict[str, dict[str, set[str]]]:
        """By point the links, but its owner, that pin-slot joints name there: each with its blocks."""
        found: dict[str, dict[str, set[str]]] = {}
        for block, joint in self.poses.graph.blocks.items():
            if joint.link in self._links_at(joint.point)[1:]:
                found.setdefault(joint.point, {}).setdefault(joint.link, {joint.link}).add(block)
        return found

    def _bearers(self) -> dict[str, str]:
        """The body with which each point is solved first: what hangs on the point is counted to it."""
        graph = self.poses.graph
        order = [self.mechanism.ground.name]
        for step in self.order.steps:
            order += bodies_of(step)
        found: dict[str, str] = {}
        for body in order:
            for point in graph.points[body]:
                found.setdefault(point, body)
        return found

    # --- pins -------------------------------------------------------------------------------------------------

    def _links_at(self, point: str) -> list[str]:
        """The links at a point, its owner first."""
        return [link.name for link in self.mechanism.links if point in link.points]

    def _number(self, link: str) -> int:
        return self.poses.links[link].number

    def _named(self, point: str, other: str, force: Vector) -> Vector:
        """The force of a pin's owner on another link, as columns."""
        owner = self._links_at(point)[0]
        label = phrase("joint_force", **self.acting.both(owner, other), point=point)
        return self.columns.joint_force(pair_symbol("F", self._number(owner), self._number(other)), force, label)

    def _is_named(self, point: str, body: str) -> bool:
        """Whether the force of the pin on a body has columns that people read: no owner, no link with blocks."""
        return body in self._links_at(point)[1:] and body not in self.slotted.get(point, {})

    def _hidden(self, point: str, body: str, force: Vector) -> Vector:
        """The force of a pin on its owner or on a block, in grey columns where it is no sum of two others."""
        base = f"F_{self.acting.number(body)}"
        return self.columns.pair(base, force, self.columns.force, "force_on", link=self.acting.words(body), point=point)

    def _known(self, point: str) -> Vector:
        """The sum of the forces that are known already on the bodies at a pin."""
        return together(self.pins.get(point, {}).values())

    def _settle(self, point: str, body: str, force: Vector) -> None:
        self.pins.setdefault(point, {})[body] = force

    def _book_slotted(self, point: str) -> None:
        """The owner's forces on links with blocks, as soon as all that they need is known."""
        done = self.pins[point]
        rest = {body for body in self.poses.graph.bodies_at(point) if body not in done}
        for link, together_with in self.slotted.get(point, {}).items():
            if (point, link) in self._booked or (len(rest) > 1 and rest & together_with):
                continue
            if rest & together_with:  # it bears the pin, and holds what all others leave
                force = negative(together(each for body, each in done.items() if body not in together_with))
            else:
                force = together(done[body] for body in self.poses.graph.bodies_at(point) if body in together_with)
            self._named(point, link, force)
            self._booked.add((point, link))

    def outer(self, point: str, body: str, force: Vector) -> Vector:
        """The force of a pin on a body, whose place was known before the body's: it is handed on to who bears the pin.

        The same over its columns.
        """
        known = self._known(point)
        done = self.pins.get(point, {})
        rest = [other for other in self.poses.graph.bodies_at(point) if other != body and other not in done]
        last = rest[0] if len(rest) == 1 and self._is_named(point, rest[0]) else ""
        if self._is_named(point, body):
            force = self._named(point, body, force)
        elif last:  # it is the owner: what people read is the force on the other one
            other = self._named(point, last, minus(negative(force), known))
            force = minus(negative(other), known)
            last = ""
        else:
            force = self._hidden(point, body, force)
        self._settle(point, body, force)
        if last:
            self._named(point, last, negative(self._known(point)))
        self._book_slotted(point)
        at = self.poses.xy[point]
        self.contacts.setdefault(body, []).append(Force(force, at))
        self.acting.hang(self.bearers[point], Force(negative(force), at))
        return force

    def inner(self, point: str, one: str, other: str, force: Vector) -> Vector:
        """The force of the other on the one, to whom all else at the pin has been counted; the same over its columns."""
        known, at = self._known(point), self.poses.xy[point]
        if self._is_named(point, other):
            on_other = self._named(point, other, negative(force))
            force = negative(on_other)
            on_one = minus(force, known)
            if self._is_named(point, one):
                on_one = self._named(point, one, on_one)
        elif self._is_named(point, one):
            on_one = self._named(point, one, minus(force, known))
            force = plus(on_one, known)
            on_other = negative(force)
        else:
            force = self._hidden(point, one, force)
            on_one, on_other = minus(force, known), negative(force)
        self._settle(point, one, on_one)
        self._settle(point, other, on_other)
        self._book_slotted(point)
        self.contacts.setdefault(one, []).append(Force(force, at))
        self.contacts.setdefault(other, []).append(Force(on_other, at))
        return force

    def inner_of_pair(self, point: str, base: str, moving: str, total: Vector) -> None:
        """The pin about which the driver turns two moving links; `total` is all else that acts on the one that is driven."""
        if self.bearers[point] == moving:
            self.inner(point, moving, base, negative(total))
        else:
            self.inner(point, base, moving, total)

    def shared(self, point: str, body: str, force: Vector, group: Set[str]) -> Vector:
        """The force on a body at a pin about which a driver turns two of its group beside a third link: what hangs on it
        is counted to the body where that bears the pin. The same over its columns.

        group  the bodies of the group at the pin
        """
        hanging = NOWHERE
        if body == self.bearers[point]:
            hanging = together(each for other, each in self.pins.get(point, {}).items() if other not in group)
        write = self._named if self._is_named(point, body) else self._hidden
        own = write(point, body, minus(force, hanging))
        self._settle(point, body, own)
        force = plus(own, hanging)
        self.contacts.setdefault(body, []).append(Force(force, self.poses.xy[point]))
        return force

    def close_shared(self, point: str, on_both: Vector, group: Set[str]) -> None:
        """The rest at such a pin, whose force on the two is known: it is handed on to who bears the pin."""
        done = self.pins[point]
        rest = [body for body in self.poses.graph.bodies_at(point) if body not in done]
        if len(rest) == 1 and self._is_named(point, rest[0]):
            self._named(point, rest[0], negative(self._known(point)))
        self._book_slotted(point)
        bearer = self.bearers[point]
        if bearer not in group:
            self.acting.hang(bearer, Force(negative(on_both), self.poses.xy[point]))

    # --- slides -----------------------------------------------------------------------------------------------

    def _names(self, slide: Slide) -> tuple[str, dict[str, Words]]:
        joint = slide.joint
        name = pair_symbol("F", self._number(joint.on), self._number(joint.link))
        return name, self.acting.both(joint.on, joint.link)

    def slide(self, slide: Slide, body: str, normal: Node, couple: Node, at: Vector) -> Vector:
        """The normal force on a body of the group, and the couple about a place; the force over its columns.

        What they are about the joint's own point is handed on to the body at the other side, unless it is of the group too.
        """
        name, words = self._names(slide)
        joint, metre = slide.joint, self.columns.metre
        n = turned(self.acting.motions.direction(slide))
        sign = al.ONE if body == slide.body else al.number(-1.0)
        value = al.mul(sign, normal)
        value = self.columns.black(f"{name}.n", value, self.columns.force, phrase("normal_force", **words), "normal")
        on_link = self.columns.pair(name, times(value, n), self.columns.force, "slide_force", **words)
        force = times(sign, on_link)
        place = self.poses.xy[joint.point]
        turning: Node = al.ZERO
        if joint.kind == "prismatic":
            turning = al.mul(sign, al.add(couple, al.mul(metre, cross(minus(at, place), force))))
            label = phrase("couple", point=joint.point, **words)
            turning = self.columns.black(f"{name}.c", turning, self.columns.torque, label, "couple")
        own = al.mul(sign, turning)
        self._hold(body, force, own, place)
        other = slide.other(body)
        if self._of_one_group(body, other):
            self._hold(other, negative(force), al.neg(own), place)
        else:
            self.acting.hang(other, Force(negative(force), place), al.neg(own))
        return force

    def _of_one_group(self, one: str, other: str) -> bool:
        return any({one, other} <= {*dyad.first, *dyad.second} for dyad in self.order.dyads)

    def _hold(self, body: str, force: Vector, couple: Node, at: Vector) -> None:
        self.contacts.setdefault(body, []).append(Force(force, at))
        if not al.is_zero(couple):
            self.couples.setdefault(body, []).append(couple)

    # --- the driven joint -------------------------------------------------------------------------------------

    def driving_torque(self, driver: Driver | FurtherDriver, torque: Node) -> str:
        """T12: of `relative_to` on the driven link."""
        base = driver.relative_to or self.mechanism.ground.name
        name = pair_symbol("T", self._number(base), self._number(driver.link))
        label = phrase("driving_torque", **self.acting.both(base, driver.link))
        self.columns.written(name, torque, self.columns.torque, label, self._kind(driver.symbol))
        return name

    def _kind(self, symbol: str) -> ForceKind:
        """What the effort of a driver is to people who read it."""
        return "effort" if symbol == self.mechanism.driver.symbol else "besides"

    def driven_slide(self, slide: Slide, moving: str, force: Vector, couple: Node) -> str:
        """F14.t along the line of the driven slide, beside what it holds as any other: `force` is that on `moving`."""
        name, words = self._names(slide)
        along = dot(force if moving == slide.body else negative(force), self.acting.motions.direction(slide))
        label = phrase("driving_force", **words)
        self.columns.written(f"{name}.t", along, self.columns.force, label, self._kind(slide.joint.symbol))
        self.guiding_slide(slide, moving, force, couple)
        return f"{name}.t"

    def guiding_slide(self, slide: Slide, moving: str, force: Vector, couple: Node) -> None:
        """F14.n across the line of a driven slide, F14.c about its point: `force` is that on `moving`."""
        name, words = self._names(slide)
        if moving != slide.body:
            force, couple = negative(force), al.neg(couple)
        across = dot(force, turned(self.acting.motions.direction(slide)))
        self.columns.black(f"{name}.n", across, self.columns.force, phrase("normal_force", **words), "normal")
        if slide.joint.kind == "prismatic":
            label = phrase("couple", point=slide.joint.point, **words)
            self.columns.black(f"{name}.c", couple, self.columns.torque, label, "couple")

    # --- a cam ------------------------------------------------------------------------------------------------

    def pressed(self, contact: Contact, value: Node) -> tuple[Node, Vector]:
        """N, with which the cam presses on a link, which hands it on to the cam; its column, the force over it."""
        words = self.acting.both(contact.cam, contact.link)
        value = self.columns.written(CONTACT, value, self.columns.force, phrase("contact_force", **words), "normal")
        force = self.columns.pair(CONTACT, times(value, contact.normal), self.columns.force, "slide_force", **words)
        self.acting.hang(contact.cam, Force(negative(force), contact.at))
        if not contact.direct:  # else it is what the driven joint would do, and counted there
            self.acting.hang(contact.link, Force(force, contact.at))
        return value, force

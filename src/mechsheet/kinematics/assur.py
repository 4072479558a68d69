"""The order of solution: the driver first, then one Assur group after the other: dyads (class II) as long as there is one.

Where there is none, the smallest group of class III or higher is next (`newton`). A dyad is two bodies joined to each other
and each to something already solved. It is found from the graph alone, so any
number of four-bars, slider-cranks and the rest, in series or in parallel, come out in the order in which a person
would solve them. Source: L. V. Assur's classification; MeKin2D and others work at the same granularity.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal, TypeAlias, cast, get_args

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.gear_relations import Tied, next_tied
from mechsheet.kinematics.graph import Assembly, Graph, Slide
from mechsheet.kinematics.mobility import listed_names, stiff_faults
from mechsheet.kinematics.newton.chains import MOST_UNKNOWNS, Chain, TooManyUnknownsError, next_chain
from mechsheet.model import Driver, FurtherDriver, Mechanism, Rack, Relation


@dataclass(frozen=True, slots=True)
class Pin:
    """A revolute joint at a point."""

    point: str


Contact = Pin | Slide


@dataclass(frozen=True, slots=True)
class Drive:
    """A driven joint: `moving` against `base` (by angle about `joint`, or along it).

    symbol  of what is driven;  positive  True where the angle is that of `moving` from `base`, for a slide always
    """

    base: str
    moving: str
    joint: Contact
    symbol: str = ""
    positive: bool = True

    @property
    def bodies(self) -> tuple[str, str]:
        """Both."""
        return (self.base, self.moving)

    def reverse(self) -> Drive:
        """The same, the other body moving."""
        return Drive(self.moving, self.base, self.joint, self.symbol, not self.positive)


Kind: TypeAlias = Literal["RRR", "RRP", "RPR", "PRP", "RPP"]


@dataclass(frozen=True, slots=True)
class Dyad:
    """Two rigid assemblies of bodies. `outer` joins `first` (resp. `second`) to what is solved, `inner` joins them.

    kind  outer of the first, inner, outer of the second: RRR, RRP, RPR, PRP or RPP. Of RRP and RPP the first assembly
          has the R outside; otherwise the first is the one that comes first in the description.
    frame  the driven pair (with what moves with it already) in which the dyad is solved; empty: it is joined to the ground's
    whole  pair and dyad as one assembly, in the frame of the first of these bodies
    """

    kind: Kind
    first: Assembly
    second: Assembly
    outer: tuple[Contact, Contact]
    inner: Contact
    frame: Assembly = ()
    whole: Assembly = ()

    @property
    def assemblies(self) -> tuple[Assembly, ...]:
        """Both of them."""
        return self.first, self.second

    @property
    def bodies(self) -> tuple[str, ...]:
        """The bodies of both."""
        return (*self.first, *self.second)

    @property
    def by_line(self) -> tuple[Assembly, Assembly, Pin, Pin]:
        """Of RPR: the assembly that carries the line, the one that slides on it, and the outer pin of each."""
        p, q = self.outer
        if not (isinstance(self.inner, Slide) and isinstance(p, Pin) and isinstance(q, Pin)):
            raise TypeError(f"not an RPR dyad: {self}")
        return (self.first, self.second, p, q) if self.inner.on in self.first else (self.second, self.first, q, p)

    @property
    def outer_pins(self) -> tuple[str, ...]:
        """The points at which it is pinned to what is solved."""
        return tuple(contact.point for contact in self.outer if isinstance(contact, Pin))

    @property
    def pins(self) -> tuple[str, ...]:
        """The points of its revolute joints."""
        return tuple(contact.point for contact in (*self.outer, self.inner) if isinstance(contact, Pin))


Step = Drive | Tied | Dyad | Chain


@dataclass(frozen=True, slots=True)
class Order:
    """All driven joints, the driver's first, and the steps in order. Dyads that are joined to both sides of a driven joint
    alone move with these.

    A driven joint is a step of its own where one side of it is known before; otherwise both its sides move as one assembly.
    """

    drives: tuple[Drive, ...]
    steps: tuple[Step, ...]

    @property
    def drive(self) -> Drive:
        """The driver's own."""
        return self.drives[0]

    @property
    def dyads(self) -> tuple[Dyad, ...]:
        """The steps that are dyads."""
        return tuple(step for step in self.steps if isinstance(step, Dyad))

    @property
    def groups(self) -> tuple[Dyad | Chain, ...]:
        """The steps that are Assur groups."""
        return tuple(step for step in self.steps if isinstance(step, Dyad | Chain))

    def pair(self, assembly: Assembly) -> Drive:
        """The driven joint inside an assembly of bodies."""
        return next(drive for drive in self.drives if {*drive.bodies} <= {*assembly})


def order_of(mechanism: Mechanism, graph: Graph) -> Order:
    """How the mechanism is solved. MechanismError when a driver drives no joint, or a group takes too many unknowns."""
    drives = tuple(_drive(mechanism, driver, graph) for driver in mechanism.all_drivers)
    clusters: dict[Drive, Assembly] = {drive: drive.bodies for drive in drives}
    solved = {mechanism.ground.name}
    steps: list[Step] = []
    force = mechanism.solution.force
    while len(solved) < len(graph.bodies):
        pending = [drive for drive in drives if not {*drive.bodies} <= solved]
        step: Step | None = _next_drive(pending, solved)
        if step is None:
            done = _used(steps)
            step = next_tied(graph, done, solved, _oriented(graph, pending, solved))
        if step is None:
            assemblies = _assemblies(graph, [clusters[drive] for drive in pending], solved)
            if not force:
                step = _next_dyad(graph, assemblies, solved) or _grown(graph, assemblies, pending, clusters, solved)
            step = step or _next_chain(graph, assemblies, steps, solved, force)
        steps.append(step)
        solved.update(bodies_of(step))
    return Order(drives, tuple(steps))


def _used(steps: Sequence[Step]) -> list[Relation]:
    """Gears, belts and racks by which something has been solved."""
    return [relation for step in steps if isinstance(step, Tied | Chain) for relation in step.relations]


def _unused(graph: Graph, steps: Sequence[Step]) -> list[Relation]:
    used = _used(steps)
    return [relation for relation in graph.relations if relation not in used]


def _next_chain(graph: Graph, assemblies: list[Assembly], steps: list[Step], solved: set[str], force: bool) -> Chain:
    """The smallest group that Newton's method solves; `force` takes dyads so, too."""
    stiff = stiff_faults(graph)
    if stiff:
        raise MechanismError(stiff)
    left = _unused(graph, steps)
    try:
        chain = next_chain(graph, assemblies, solved, 2 if force else 4, left)
    except TooManyUnknownsError as error:
        raise MechanismError(_too_large(error.assemblies)) from error
    if chain is None:
        raise MechanismError(_tied_too_deep(graph, left[0]) if left else _too_large(assemblies))
    return chain


def _grown(
    graph: Graph,
    assemblies: list[Assembly],
    pending: list[Drive],
    clusters: dict[Drive, Assembly],
    solved: set[str],
) -> Dyad | None:
    """A dyad on both sides of a driven joint, which are one link with it from now on.

    A closed form, so it comes before any group that must be solved by iteration.
    """
    for drive in pending:
        inside = _within(graph, assemblies, clusters[drive], solved)
        if inside is not None:
            clusters[drive] = inside.whole
            return inside
    return None


def bodies_of(step: Step) -> tuple[str, ...]:
    """The bodies that are known after a step."""
    match step:
        case Drive():
            return step.bodies
        case Tied():
            return tuple(held.body for held in step.bodies)
        case Chain():
            return step.bodies
        case Dyad():  # one that moves with a driven pair is known when that is
            return () if step.frame else (*step.first, *step.second)


def _next_drive(pending: list[Drive], solved: set[str]) -> Drive | None:
    """The first driven joint of which one side is known."""
    for drive in pending:
        if drive.base in solved:
            return drive
        if drive.moving in solved:
            return drive.reverse()
    return None


def _oriented(graph: Graph, pending: list[Drive], solved: set[str]) -> set[str]:
    """Assembly whose angle is known: solved ones, those that slide on such a one, those that are driven from such a one."""
    found = set(solved)
    ways = [(slide.body, slide.on) for slide in graph.slides if slide.body not in graph.blocks]
    ways += [drive.bodies for drive in pending]
    for _ in ways:
        for one, other in ways:
            if one in found or other in found:
                found |= {one, other}
    return found


def _assemblies(graph: Graph, pairs: list[Assembly], solved: set[str]) -> list[Assembly]:
    """What is not solved, in the description's order: bodies alone, and both sides of a driven joint with what moves with
    them; of these the larger ones first."""
    grouped = [body for pair in pairs for body in pair]
    twice = [body for body in grouped if grouped.count(body) > 1]
    if twice:
        message = say(
            '"{twice}" is driven against two links that move with it: such a chain is not supported yet', twice=twice[0]
        )
        raise MechanismError(
            Fault(message, key="drivers", hint=say("let one of the driven joints be on a link that is known"))
        )
    found = [*pairs, *((body,) for body in graph.bodies if body not in solved and body not in grouped)]
    return sorted(found, key=lambda bodies: -1 if len(bodies) > 2 else graph.bodies.index(bodies[0]))


def _tied_too_deep(graph: Graph, relation: Relation) -> Fault:
    """A gear that could not be used."""
    message = say(
        "the {kind} between {names} is in no group of links that it could be solved with",
        kind=say("rack") if isinstance(relation, Rack) else say(relation.kind),
        names=listed_names(graph.tied(relation)),
    )
    hint = say("what it ties is held without it, or by more links than are solved all at once")
    return Fault(message, key=f"joints.{relation.order}", hint=hint)


def _drive(mechanism: Mechanism, driver: Driver | FurtherDriver, graph: Graph) -> Drive:
    ground = mechanism.ground.name
    if driver.joint:
        slide = next(slide for slide in graph.slides if slide.joint.name == driver.joint)
        if slide.body == ground:
            return Drive(slide.body, slide.on, slide, driver.symbol)
        return Drive(slide.on, slide.body, slide, driver.symbol)
    shared = [point for point in graph.points[driver.link] if point in graph.points[driver.relative_to]]
    if not shared:
        raise MechanismError(_no_pivot(driver, graph))
    if driver.link == ground:
        return Drive(driver.link, driver.relative_to, Pin(shared[0]), driver.symbol, False)
    return Drive(driver.relative_to, driver.link, Pin(shared[0]), driver.symbol)


def _no_pivot(driver: Driver | FurtherDriver, graph: Graph) -> Fault:
    neighbours = [
        body
        for body in graph.bodies
        if body != driver.link and body not in graph.blocks and set(graph.points[body]) & set(graph.points[driver.link])
    ]
    return Fault(
        say(
            'link "{link}" and link "{relative_to}" share no point: a link can only be turned about a revolute joint',
            link=driver.link,
            relative_to=driver.relative_to,
        ),
        key="driver.link" if isinstance(driver, Driver) else f"drivers.{driver.order}.link",
        hint=say(
            '"{link}" is joined to {others}: name one of them as relative_to',
            link=driver.link,
            others=", ".join(neighbours) or say("no link"),
        ),
    )


def _contacts(graph: Graph, assembly: Assembly, others: set[str]) -> list[Contact]:
    """Joints between an assembly and a set of bodies, pins first, a point once."""
    points = dict.fromkeys(point for body in assembly for point in graph.points[body])
    pins: list[Contact] = [Pin(point) for point in points if any(point in graph.points[body] for body in others)]
    slides: list[Contact] = [
        slide
        for body in assembly
        for slide in graph.slides_of(body)
        if slide.other(body) in others and slide.other(body) not in assembly
    ]
    return pins + slides


def _next_dyad(graph: Graph, assemblies: list[Assembly], solved: set[str]) -> Dyad | None:
    """The first pair of assemblies, in the description's order, that can be solved from what is known."""
    held = [(bodies, _contacts(graph, bodies, solved)) for bodies in assemblies]
    held = [(bodies, contacts) for bodies, contacts in held if len(contacts) == 1]
    known = {point for body in solved for point in graph.points[body]}
    for index, (first, outer_first) in enumerate(held):
        for second, outer_second in held[index + 1 :]:
            inner = [
                contact
                for contact in _contacts(graph, first, set(second))
                if not (isinstance(contact, Pin) and contact.point in known)
            ]
            if len(inner) == 1:
                return _dyad(first, second, outer_first[0], inner[0], outer_second[0])
    return None


def _within(graph: Graph, assemblies: list[Assembly], driven: Assembly, solved: set[str]) -> Dyad | None:
    """Two links that are joined to each other and each to the driven pair, by three pins; None where there are none.

    A link that is joined to what is solved comes first, if there is one: in its frame the whole is read best.
    """
    others = [bodies for bodies in assemblies if bodies != driven and bodies[0] not in graph.blocks]
    dyad = _next_dyad(graph, others, set(driven))
    if dyad is None or dyad.kind != "RRR":
        return None
    first, second, outer = dyad.first, dyad.second, dyad.outer
    if _contacts(graph, second, solved) and not _contacts(graph, first, solved):
        first, second, outer = second, first, outer[::-1]
    whole = (*first, *second, *driven) if _contacts(graph, first, solved) else (*driven, *first, *second)
    return Dyad("RRR", first, second, outer, dyad.inner, driven, whole)


def _dyad(first: Assembly, second: Assembly, outer_first: Contact, inner: Contact, outer_second: Contact) -> Dyad:
    if isinstance(outer_first, Slide) and isinstance(outer_second, Pin):
        first, second, outer_first, outer_second = second, first, outer_second, outer_first
    letters = "".join("R" if isinstance(contact, Pin) else "P" for contact in (outer_first, inner, outer_second))
    if letters not in get_args(Kind):
        raise MechanismError(
            Fault(
                say(
                    "links {first} and {second} are held by sliders alone ({outer_first}, {inner}, "
                    "{outer_second}): their angles are fixed and their position is not",
                    first=_names(first),
                    second=_names(second),
                    outer_first=_joint(outer_first),
                    inner=_joint(inner),
                    outer_second=_joint(outer_second),
                ),
                key="joints",
                hint=say("one of the three joints must be a revolute joint"),
            )
        )
    return Dyad(cast(Kind, letters), first, second, (outer_first, outer_second), inner)


def _joint(contact: Contact) -> str:
    return contact.point if isinstance(contact, Pin) else contact.joint.symbol


def _names(bodies: Assembly) -> str:
    return " + ".join(f'"{body}"' for body in bodies)


def _too_large(assemblies: Sequence[Assembly]) -> Fault:
    names = ", ".join(_names(bodies) for bodies in assemblies)
    return Fault(
        say(
            "links {names} form a group that must be solved all at once, and takes more than {most} unknowns",
            names=names,
            most=MOST_UNKNOWNS,
        ),
        key="links",
        hint=say("driving another link often helps"),
    )

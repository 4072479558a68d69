"""The order of solution: the driver first, then one Assur group after the other: dyads (class II) as long as there is one.

Where there is none, the smallest group of class III or higher is next (`newton`). A dyad is two bodies joined to each other
and each to something already solved. It is found from the graph alone, so any
number of four-bars, slider-cranks and the rest, in series or in parallel, come out in the order in which a person
would solve them. Source: L. V. Assur's classification; MeKin2D and others work at the same granularity.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from mechsheet.diagnostics import Fault, MechanismError
from mechsheet.kinematics.graph import Graph, Slide
from mechsheet.kinematics.mobility import stiff_faults
from mechsheet.kinematics.newton.chains import MOST_UNKNOWNS, Chain, TooManyUnknownsError, next_chain
from mechsheet.model import Driver, Mechanism


@dataclass(frozen=True, slots=True)
class Pin:
    """A revolute joint at a point."""

    point: str


Contact = Pin | Slide


@dataclass(frozen=True, slots=True)
class Drive:
    """The driven joint: `moving` against `base` (by angle about `joint`, or along it)."""

    base: str
    moving: str
    joint: Contact


@dataclass(frozen=True, slots=True)
class Dyad:
    """Two rigid assemblies of bodies. `outer` joins `first` (resp. `second`) to what is solved, `inner` joins them.

    kind  outer of the first, inner, outer of the second: RRR, RRP, RPR, PRP or RPP. Of RRP and RPP the first assembly
          has the R outside; otherwise the first is the one that comes first in the description.
    frame  the driven pair (with what moves with it already) in which the dyad is solved; empty: it is joined to the ground's
    whole  pair and dyad as one assembly, in the frame of the first of these bodies
    """

    kind: Literal["RRR", "RRP", "RPR", "PRP", "RPP"]
    first: tuple[str, ...]
    second: tuple[str, ...]
    outer: tuple[Contact, Contact]
    inner: Contact
    frame: tuple[str, ...] = ()
    whole: tuple[str, ...] = ()

    @property
    def assemblies(self) -> tuple[tuple[str, ...], ...]:
        """Both of them."""
        return self.first, self.second

    @property
    def bodies(self) -> tuple[str, ...]:
        """The bodies of both."""
        return (*self.first, *self.second)


@dataclass(frozen=True, slots=True)
class Order:
    """The driven joint, and the dyads in order. When `drive.base` is not the ground both sides move as one assembly, and
    dyads that are joined to it alone move with it."""

    drive: Drive
    dyads: tuple[Dyad | Chain, ...]


def order_of(mechanism: Mechanism, graph: Graph) -> Order:
    """How the mechanism is solved. MechanismError when the driver drives no joint, or a group is not of class II."""
    drive = _drive(mechanism, graph)
    ground = mechanism.ground.name
    assemblies: list[tuple[str, ...]] = []
    solved = {ground}
    if drive.base == ground:
        solved.add(drive.moving)
    else:
        assemblies.append((drive.base, drive.moving))
    grouped = solved | {drive.base, drive.moving}
    assemblies += [(body,) for body in graph.bodies if body not in grouped]
    assemblies.sort(key=lambda bodies: graph.bodies.index(bodies[0]))
    groups: list[Dyad | Chain] = []
    driven: tuple[str, ...] = (drive.base, drive.moving)
    force = mechanism.solution.force
    while assemblies:
        dyad = None if force else _next_dyad(graph, assemblies, solved)
        moving = dyad is None and not force and driven in assemblies
        if moving and (inside := _within(graph, assemblies, driven, solved)) is not None:
            # A closed form, so it comes before any group that must be solved by iteration: pair and dyad are one link now.
            groups.append(inside)
            assemblies = [bodies for bodies in assemblies if bodies not in (driven, inside.first, inside.second)]
            driven = inside.whole
            assemblies.insert(0, driven)
            continue
        group = dyad or _next_chain(graph, assemblies, solved, force)
        groups.append(group)
        assemblies = [bodies for bodies in assemblies if bodies not in group.assemblies]
        solved.update(group.bodies)
    return Order(drive, tuple(groups))


def _next_chain(graph: Graph, assemblies: list[tuple[str, ...]], solved: set[str], force: bool) -> Chain:
    """The smallest group that Newton's method solves; `force` takes dyads so, too."""
    stiff = stiff_faults(graph)
    try:
        chain = None if stiff else next_chain(graph, assemblies, solved, 2 if force else 4)
    except TooManyUnknownsError as error:
        raise MechanismError(_too_large(error.assemblies)) from error
    if chain is None:
        raise MechanismError(stiff or [_too_large(assemblies)])
    return chain


def _drive(mechanism: Mechanism, graph: Graph) -> Drive:
    driver = mechanism.driver
    ground = mechanism.ground.name
    if driver.joint:
        slide = next(slide for slide in graph.slides if slide.joint.name == driver.joint)
        base, moving = (slide.body, slide.on) if slide.body == ground else (slide.on, slide.body)
        return Drive(base, moving, slide)
    shared = [point for point in graph.points[driver.link] if point in graph.points[driver.relative_to]]
    if not shared:
        raise MechanismError(_no_pivot(driver, graph))
    base, moving = driver.relative_to, driver.link
    if moving == ground:
        base, moving = moving, base
    return Drive(base, moving, Pin(shared[0]))


def _no_pivot(driver: Driver, graph: Graph) -> Fault:
    neighbours = [
        body
        for body in graph.bodies
        if body != driver.link and body not in graph.blocks and set(graph.points[body]) & set(graph.points[driver.link])
    ]
    return Fault(
        f'link "{driver.link}" and link "{driver.relative_to}" share no point: '
        "a link can only be turned about a revolute joint",
        key="driver.link",
        hint=f'"{driver.link}" is joined to {", ".join(neighbours) or "no link"}: name one of them as relative_to',
    )


def _contacts(graph: Graph, assembly: tuple[str, ...], others: set[str]) -> list[Contact]:
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


def _next_dyad(graph: Graph, assemblies: list[tuple[str, ...]], solved: set[str]) -> Dyad | None:
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


def _within(graph: Graph, assemblies: list[tuple[str, ...]], driven: tuple[str, ...], solved: set[str]) -> Dyad | None:
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


def _dyad(
    first: tuple[str, ...], second: tuple[str, ...], outer_first: Contact, inner: Contact, outer_second: Contact
) -> Dyad:
    if isinstance(outer_first, Slide) and isinstance(outer_second, Pin):
        first, second, outer_first, outer_second = second, first, outer_second, outer_first
    letters = "".join("R" if isinstance(contact, Pin) else "P" for contact in (outer_first, inner, outer_second))
    kinds: dict[str, Literal["RRR", "RRP", "RPR", "PRP", "RPP"]] = {
        "RRR": "RRR", "RRP": "RRP", "RPR": "RPR", "PRP": "PRP", "RPP": "RPP",
    }  # fmt: skip
    if letters not in kinds:
        raise MechanismError(
            Fault(
                f"links {_names(first)} and {_names(second)} are held by sliders alone "
                f"({_joint(outer_first)}, {_joint(inner)}, {_joint(outer_second)}): "
                "their angles are fixed and their position is not",
                key="joints",
                hint="one of the three joints must be a revolute joint",
            )
        )
    return Dyad(kinds[letters], first, second, (outer_first, outer_second), inner)


def _joint(contact: Contact) -> str:
    return contact.point if isinstance(contact, Pin) else contact.joint.symbol


def _names(bodies: tuple[str, ...]) -> str:
    return " + ".join(f'"{body}"' for body in bodies)


def _too_large(assemblies: Sequence[tuple[str, ...]]) -> Fault:
    names = ", ".join(_names(bodies) for bodies in assemblies)
    return Fault(
        f"links {names} form a group that must be solved all at once, and takes more than {MOST_UNKNOWNS} unknowns",
        key="links",
        hint="driving another link often helps",
    )

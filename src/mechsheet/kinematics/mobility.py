"""Gruebler's count, and in words what is wrong when it is not the number of drivers.

M = 3 (n - 1) - 2 (revolute + prismatic) - (pin-slot) - (gears, belts, racks), a point that k links share counting as k - 1
revolute joints.
With the massless block of a pin-slot joint counted as a body the same number comes out of 3 (n - 1) - 2 j.
Source: Gruebler's criterion for planar mechanisms (any text on mechanisms).
"""

from __future__ import annotations

from collections.abc import Iterable

from livesheet.diagnostics import Fault
from livesheet.said import say, say_count
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.graph import Graph
from mechsheet.model import Gear, Mechanism

LARGEST_PART = 5
"""Parts of up to this many bodies are searched for joints too many: larger rigid parts are rare and slow to find."""

MOST_PARTS = 20_000
"""The search for rigid parts of a faulty mechanism ends after so many."""


class MobilityError(MechanismError):
    """Another number of degrees of freedom than of drivers; `missing`: how many more there should be (negative: fewer)."""

    def __init__(self, faults: Iterable[Fault], missing: int) -> None:
        self.missing = missing
        super().__init__(faults)


def mobility(graph: Graph, bodies: tuple[str, ...] | None = None) -> int:
    """Degrees of freedom of the bodies (default: all) against one of them."""
    inside = graph.bodies if bodies is None else bodies
    pins = sum(max(0, sum(point in graph.points[body] for body in inside) - 1) for point, _ in graph.pins)
    slides = sum(slide.body in inside and slide.on in inside for slide in graph.slides)
    ties = sum(all(body in inside for body in graph.tied(relation)) for relation in graph.relations)
    return 3 * (len(inside) - 1) - 2 * pins - 2 * slides - ties


def check_mobility(mechanism: Mechanism, graph: Graph) -> None:
    """Raise MobilityError, naming links, unless the mechanism has as many degrees of freedom as drivers."""
    count = mobility(graph)
    drivers = 1 + len(mechanism.drivers)
    if count == drivers:
        return
    faults = [Fault(_count_message(mechanism, graph, count), key="links", hint=_count_hint(count, drivers))]
    faults += stiff_faults(graph)
    faults += _driven_twice(mechanism) if count < drivers else []
    if count > drivers:
        faults += [
            Fault(
                say('the link "{name}" is marked as redundant, but may hold the others', name=each.link.name),
                key=f"links.{each.link.name}.redundant",
                hint=say("without the mark both its joints count"),
            )
            for each in mechanism.redundant
        ]
    faults += [
        Fault(
            say('"{body}" is loose: it has too few joints to be held by the rest', body=body),
            key=_key(graph, body),
            hint=say("join it to another link, or drive it ([[drivers]])"),
        )
        for body in _loose(graph)
        if body not in _held_by_drivers(mechanism)
    ]
    if count > drivers:
        faults += _once_beside_a_like(mechanism)
    raise MobilityError(faults, drivers - count)


def _held_by_drivers(mechanism: Mechanism) -> set[str]:
    """Links that a driver turns against a link to which they are pinned: a joint and the driver hold them."""
    points = {link.name: {*link.points} for link in mechanism.whole_links}
    return {
        driver.link
        for driver in mechanism.all_drivers
        if driver.link and points[driver.link] & points[driver.relative_to or mechanism.ground.name]
    }


def _once_beside_a_like(mechanism: Mechanism) -> list[Fault]:
    """Points that one link alone has and nothing reads, with a name like that of another link's: slips of the pen."""
    holders: dict[str, list[str]] = {}
    for one in mechanism.whole_links:
        for point in one.points:
            holders.setdefault(point, []).append(one.name)
    read = {joint.point for joint in mechanism.joints} | {str(joint.through) for joint in mechanism.joints}
    once = {point: names[0] for point, names in holders.items() if len(names) == 1 and point not in read}
    found = []
    for point, link in once.items():
        meant = next((other for other, names in holders.items() if link not in names and _one_more(point, other)), None)
        if meant is not None:
            message = say('the point "{point}" occurs once: nothing is joined there', point=point)
            hint = say('did you mean "{name}"?', name=meant)
            found.append(Fault(message, key=f"links.{link}.points.{point}", hint=hint))
    return found


def _one_more(long: str, short: str) -> bool:
    """Whether a name without one of its letters is another one. A digit is no slip: A0 is beside A on purpose."""
    return any(
        (long[:place] + long[place + 1 :]).lower() == short.lower() and not sign.isdigit()
        for place, sign in enumerate(long)
    )


def _key(graph: Graph, body: str) -> str:
    """Where a body stands in the description."""
    return "joints" if body in graph.blocks else f"links.{body}"


def _count_message(mechanism: Mechanism, graph: Graph, count: int) -> str:
    links = len(mechanism.links)
    revolute = sum(len(bodies) - 1 for _, bodies in graph.pins)
    prismatic = sum(joint.kind == "prismatic" for joint in mechanism.joints)
    slots = len(mechanism.joints) - prismatic
    revolute -= slots  # the block's own pin is part of the pin-slot joint
    terms = say(
        "3 x ({links} - 1) - 2 x {revolute} revolute - 2 x {prismatic} prismatic - {slots} pin-slot",
        links=links,
        revolute=revolute,
        prismatic=prismatic,
        slots=slots,
    )
    if graph.relations:
        terms = say("{terms} - {count} gear, belt or rack", terms=terms, count=len(graph.relations))
    drivers = 1 + len(mechanism.drivers)
    need = say_count("one driver needs 1", "{count} drivers need {count}", drivers)
    return say("the mobility is {count}, but {need}: {terms} = {count}", count=count, need=need, terms=terms)


def _count_hint(count: int, drivers: int) -> str:
    if count > drivers:
        given = say_count("one is given", "{count} are given", drivers)
        return say(
            "{count} drivers would be needed, {given}: join the loose links, remove {surplus} of the "
            "freedoms, or add [[drivers]]",
            count=count,
            given=given,
            surplus=count - drivers,
        )
    if 0 < count < drivers:
        return say("one driver too many: take {surplus} of the drivers away", surplus=drivers - count)
    if count == 0:
        return say("it is a structure: nothing can move. Remove a joint, or a link with two joints")
    return say(
        "there are more joints than a movable chain can have: remove some, or make two links that never move apart one"
    )


def stiff_faults(graph: Graph) -> list[Fault]:
    """One fault for each smallest part whose bodies cannot move against each other."""
    return [Fault(_stiff_message(graph, bodies), key=_key(graph, bodies[-1])) for bodies in _stiff(graph)]


def _stiff(graph: Graph) -> list[tuple[str, ...]]:
    """Smallest parts with M <= 0: joined bodies, two to LARGEST_PART of them, the first MOST_PARTS that are looked at."""
    neighbours = {body: _neighbours(graph, body) for body in graph.bodies}
    found: list[frozenset[str]] = []
    parts = [frozenset([body]) for body in graph.bodies]
    looked_at = 0
    for _ in range(LARGEST_PART - 1):
        larger: dict[frozenset[str], None] = {}
        for part in parts:
            around = dict.fromkeys(other for body in sorted(part) for other in neighbours[body] if other not in part)
            larger |= dict.fromkeys(part | {other} for other in around)
        parts = [part for part in larger if not any(stiff <= part for stiff in found)]
        looked_at += len(parts)
        if looked_at > MOST_PARTS:
            break
        found += [part for part in parts if mobility(graph, tuple(part)) <= 0]
    return [tuple(body for body in graph.bodies if body in part) for part in found]


def _driven_twice(mechanism: Mechanism) -> list[Fault]:
    """Drivers of links that gears tie to what other drivers drive."""
    driven = {driver.link for driver in mechanism.all_drivers if driver.link}
    faults = []
    for relation in mechanism.relations:
        both = [name for name in relation.turning if name in driven]
        if isinstance(relation, Gear) and {*relation.turning} <= driven | {mechanism.ground.name} and both:
            message = say(
                "a {kind} ties {both}, and each of them is driven: they cannot all be",
                kind=say(relation.kind),
                both=listed_names(tuple(both)),
            )
            faults.append(
                Fault(message, key=f"joints.{relation.order}", hint=say("take the gear or one of the drivers away"))
            )
    return faults


def _neighbours(graph: Graph, body: str) -> tuple[str, ...]:
    pinned = [other for point in graph.points[body] for other in graph.bodies_at(point)]
    sliding = [slide.other(body) for slide in graph.slides_of(body)]
    return tuple(dict.fromkeys(other for other in pinned + sliding if other != body))


def _stiff_message(graph: Graph, bodies: tuple[str, ...]) -> str:
    surplus = mobility(graph, bodies)
    joints = [point for point, at in graph.pins if sum(body in bodies for body in at) > 1]
    joints += [slide.joint.symbol for slide in graph.slides if slide.body in bodies and slide.on in bodies]
    named = {"bodies": listed_names(bodies), "joints": ", ".join(joints)}
    if surplus == 0:
        return say(
            "{bodies} cannot move against each other (joints {joints}): describe them as one link, or remove a joint",
            **named,
        )
    return say("{bodies} are over-constrained (joints {joints}): describe them as one link, or remove a joint", **named)


def _loose(graph: Graph) -> tuple[str, ...]:
    """Bodies with one joint or none."""
    return tuple(
        body for body in graph.bodies[1:] if sum(body in at for _, at in graph.pins) + len(graph.slides_of(body)) < 2
    )


def listed_names(names: tuple[str, ...]) -> str:
    """`"crank", "coupler" and "rocker"`."""
    quoted = [f'"{name}"' for name in names]
    if len(quoted) == 1:
        return quoted[0]
    return say("{first} and {last}", first=", ".join(quoted[:-1]), last=quoted[-1])

"""Gruebler's count, and in words what is wrong when it is not the number of drivers.

M = 3 (n - 1) - 2 (revolute + prismatic) - (pin-slot), a point that k links share counting as k - 1 revolute joints.
With the massless block of a pin-slot joint counted as a body the same number comes out of 3 (n - 1) - 2 j.
Source: Gruebler's criterion for planar mechanisms (any text on mechanisms).
"""

from __future__ import annotations

from mechsheet.diagnostics import Fault, MechanismError
from mechsheet.kinematics.graph import Graph
from mechsheet.model import Mechanism

LARGEST_PART = 5
"""Parts of up to this many bodies are searched for joints too many: larger rigid parts are rare and slow to find."""

MOST_PARTS = 20_000
"""The search for rigid parts of a faulty mechanism ends after so many."""


def mobility(graph: Graph, bodies: tuple[str, ...] | None = None) -> int:
    """Degrees of freedom of the bodies (default: all) against one of them."""
    inside = graph.bodies if bodies is None else bodies
    pins = sum(max(0, sum(point in graph.points[body] for body in inside) - 1) for point, _ in graph.pins)
    slides = sum(slide.body in inside and slide.on in inside for slide in graph.slides)
    return 3 * (len(inside) - 1) - 2 * pins - 2 * slides


def check_mobility(mechanism: Mechanism, graph: Graph) -> None:
    """Raise MechanismError, naming links, unless the mechanism has one degree of freedom."""
    count = mobility(graph)
    if count == 1:
        return
    faults = [Fault(_count_message(mechanism, graph, count), key="links", hint=_count_hint(count))]
    faults += stiff_faults(graph)
    faults += [
        Fault(
            f'"{body}" is loose: it has too few joints to be held by the rest',
            key=_key(graph, body),
            hint="every link but the ground needs at least two joints",
        )
        for body in _loose(graph)
    ]
    raise MechanismError(faults)


def _key(graph: Graph, body: str) -> str:
    """Where a body stands in the description."""
    return "joints" if body in graph.blocks else f"links.{body}"


def _count_message(mechanism: Mechanism, graph: Graph, count: int) -> str:
    links = len(mechanism.links)
    revolute = sum(len(bodies) - 1 for _, bodies in graph.pins)
    prismatic = sum(joint.kind == "prismatic" for joint in mechanism.joints)
    slots = len(mechanism.joints) - prismatic
    revolute -= slots  # the block's own pin is part of the pin-slot joint
    terms = f"3 x ({links} - 1) - 2 x {revolute} revolute - 2 x {prismatic} prismatic - {slots} pin-slot"
    return f"the mobility is {count}, but one driver needs 1: {terms} = {count}"


def _count_hint(count: int) -> str:
    if count > 1:
        return f"{count} drivers would be needed, one is given: join the loose links, or remove {count - 1} of the freedoms"
    if count == 0:
        return "it is a structure: nothing can move. Remove a joint, or a link with two joints"
    return (
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


def _neighbours(graph: Graph, body: str) -> tuple[str, ...]:
    pinned = [other for point in graph.points[body] for other in graph.bodies_at(point)]
    sliding = [slide.other(body) for slide in graph.slides_of(body)]
    return tuple(dict.fromkeys(other for other in pinned + sliding if other != body))


def _stiff_message(graph: Graph, bodies: tuple[str, ...]) -> str:
    surplus = mobility(graph, bodies)
    joints = [point for point, at in graph.pins if sum(body in bodies for body in at) > 1]
    joints += [slide.joint.symbol for slide in graph.slides if slide.body in bodies and slide.on in bodies]
    state = "cannot move against each other" if surplus == 0 else "are over-constrained"
    return f"{_listed(bodies)} {state} (joints {', '.join(joints)}): describe them as one link, or remove a joint"


def _loose(graph: Graph) -> tuple[str, ...]:
    """Bodies with one joint or none."""
    return tuple(
        body for body in graph.bodies[1:] if sum(body in at for _, at in graph.pins) + len(graph.slides_of(body)) < 2
    )


def _listed(names: tuple[str, ...]) -> str:
    quoted = [f'"{name}"' for name in names]
    return quoted[0] if len(quoted) == 1 else ", ".join(quoted[:-1]) + " and " + quoted[-1]

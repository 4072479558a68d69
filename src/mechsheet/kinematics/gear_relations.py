"""Gears, belts and racks as linear equations between angles and displacements, and the step in which they solve a link.

    gear, belt   angle(link) - angle(arm) = ratio (angle(on) - angle(arm)) + phase
    rack         displacement = radius (angle(link) - angle(arm)) + phase

Where as many of these as there are unknowns in them stand alone, they decide them; a link whose angle is decided so, and
that is pivoted on something known, is solved like a crank: a planet on its arm, the second crank of a geared five-bar.
Source: Willis's formula for epicyclic trains; Norton, Design of Machinery, sections 4.8 and 9.9.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import combinations

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node
from mechsheet.kinematics.graph import Graph, Slide
from mechsheet.model import Gear, Rack, Relation

MOST_TOGETHER = 4
"""So many relations are solved together at most: a planetary train with two sets of planets needs four."""


@dataclass(frozen=True, slots=True)
class Held:
    """A body that ties decide, and by what it is held on something known: a point that it turns about, or its slide.

    variable  the symbol that the ties decide: its angle, or the displacement
    """

    body: str
    at: str | Slide
    variable: str


@dataclass(frozen=True, slots=True)
class Tied:
    """A step of the solution: relations, and the bodies that they decide, in order."""

    relations: tuple[Relation, ...]
    bodies: tuple[Held, ...]

    @property
    def unknowns(self) -> tuple[str, ...]:
        """What the relations decide."""
        return tuple(held.variable for held in self.bodies)


Terms = dict[str, Node]
"""Variable -> its coefficient. A variable is a body's name (its angle), or the symbol of a displacement."""


def terms_of(relation: Relation) -> Terms:
    """The left side of a relation, brought to: sum of coefficient times variable = phase."""
    match relation:
        case Gear():
            arm = al.sub(relation.ratio, al.ONE)
            return {relation.link: al.ONE, relation.on: al.neg(relation.ratio), relation.arm: arm}
        case Rack():
            return {relation.joint: al.ONE, relation.link: al.neg(relation.radius), relation.arm: relation.radius}


def next_tied(graph: Graph, done: Iterable[Relation], solved: set[str], oriented: set[str]) -> Tied | None:
    """The fewest relations that together decide what is unknown in them, where all of that can then be placed.

    oriented  bodies whose angle is known, the solved ones among them
    """
    waiting = [relation for relation in graph.relations if relation not in tuple(done)]
    for count in range(1, min(len(waiting), MOST_TOGETHER) + 1):
        for chosen in combinations(waiting, count):
            unknown = _unknown(graph, chosen, solved, oriented)
            if len(unknown) == count and (bodies := _held(graph, unknown, solved)) is not None:
                return Tied(chosen, bodies)
    return None


def _unknown(graph: Graph, relations: Sequence[Relation], solved: set[str], oriented: set[str]) -> list[str]:
    found: dict[str, None] = {}
    for relation in relations:
        for variable in terms_of(relation):
            if variable in graph.bodies:
                known = variable in oriented
            else:
                slide = graph.slide(variable)
                known = slide.body in solved and slide.on in solved
            if not known:
                found[variable] = None
    return list(found)


def _held(graph: Graph, unknown: list[str], solved: set[str]) -> tuple[Held, ...] | None:
    """The bodies in an order in which each is held on what is known by then; None where there is no such order."""
    known, found, left = set(solved), [], list(unknown)
    while left:
        held = next((one for variable in left if (one := _on_known(graph, variable, known)) is not None), None)
        if held is None:
            return None
        found.append(held)
        known.add(held.body)
        left.remove(held.variable)
    return tuple(found)


def _on_known(graph: Graph, variable: str, known: set[str]) -> Held | None:
    if variable not in graph.bodies:
        slide = graph.slide(variable)
        sides = [side for side in (slide.body, slide.on) if side not in known]
        return Held(sides[0], slide, variable) if len(sides) == 1 else None
    for point in graph.points[variable]:
        if any(point in graph.points[body] for body in known):
            return Held(variable, point, variable)
    return None


def solved_for(
    tied: Tied, of: Callable[[str], Node], value: Callable[[Node], float], phased: bool = True
) -> dict[str, Node]:
    """Each unknown over what is known.

    of      a known variable: an angle, a displacement; or its derivative, then `phased` is False
    value   the number of a coefficient now: the largest is divided by
    """
    if len(tied.relations) == 1:
        return {tied.unknowns[0]: _alone(tied.relations[0], tied.unknowns[0], of, phased)}
    rows: list[tuple[Terms, Node]] = []
    for relation in tied.relations:
        terms = terms_of(relation)
        right = relation.phase if phased else al.ZERO
        for variable in [name for name in terms if name not in tied.unknowns]:
            right = al.sub(right, al.mul(terms.pop(variable), of(variable)))
        rows.append((terms, right))
    return eliminated(rows, list(tied.unknowns), value)


def axis_of(graph: Graph, wheel: str, arm: str) -> str:
    """The point about which a wheel turns on its arm."""
    return next(point for point in graph.points[wheel] if point in graph.points[arm])


def _alone(relation: Relation, unknown: str, of: Callable[[str], Node], phased: bool) -> Node:
    """One relation solved for one of its variables, as one writes it."""
    phase = relation.phase if phased else al.ZERO
    if isinstance(relation, Rack):
        if unknown == relation.joint:
            return al.add(al.mul(relation.radius, al.sub(of(relation.link), of(relation.arm))), phase)
        way = al.div(al.sub(of(relation.joint), phase), relation.radius)
        return al.add(of(relation.arm), way) if unknown == relation.link else al.sub(of(relation.link), way)
    if unknown == relation.link:
        arm = of(relation.arm)
        return al.add(al.add(arm, al.mul(relation.ratio, al.sub(of(relation.on), arm))), phase)
    if unknown == relation.on:
        arm = of(relation.arm)
        return al.add(arm, al.div(al.sub(al.sub(of(relation.link), arm), phase), relation.ratio))
    turned = al.sub(al.sub(of(relation.link), al.mul(relation.ratio, of(relation.on))), phase)
    return al.div(turned, al.sub(al.ONE, relation.ratio))


def eliminated(rows: list[tuple[Terms, Node]], unknowns: list[str], value: Callable[[Node], float]) -> dict[str, Node]:
    """Gauss's elimination with symbols; the pivot is the coefficient that is largest now."""
    done: list[tuple[str, Terms, Node]] = []
    while rows:
        sizes = [
            (abs(value(node)), -index, name) for index, (terms, _) in enumerate(rows) for name, node in terms.items()
        ]
        _, place, pivot = max(sizes)
        terms, right = rows.pop(-place)
        rest = []
        for others, other_right in rows:
            if pivot in others:
                factor = al.div(others[pivot], terms[pivot])
                others = {
                    name: al.sub(others.get(name, al.ZERO), al.mul(factor, terms.get(name, al.ZERO)))
                    for name in dict.fromkeys((*others, *terms))
                    if name != pivot
                }
                other_right = al.sub(other_right, al.mul(factor, right))
            rest.append((others, other_right))
        rows = rest
        done.append((pivot, terms, right))
    found: dict[str, Node] = {}
    for pivot, terms, right in reversed(done):
        for name, node in terms.items():
            if name != pivot:
                right = al.sub(right, al.mul(node, found[name]))
        found[pivot] = al.div(right, terms[pivot])
    return {name: found[name] for name in unknowns}

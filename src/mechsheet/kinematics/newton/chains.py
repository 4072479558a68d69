"""Assur groups of class III and higher: the smallest set of links that can be solved together, and how they are reached.

A set of L links is held by what is known when 3 L = 2 J, J being its joints among themselves and with what is known. Some of
its links are *carriers*, reached one from another over a joint each, with one unknown: the angle about a pin, or the
displacement along a slide. Each other link has two joints, and asks one thing of the carriers: the distance of two pins,
or the distance of a pin from a line. A pin between two carriers that is left over asks two things, a gear, belt or rack one,
of angles and displacements that must be those of carriers: a set that they tie is held when 3 L = 2 J + as many as they are.
So there are as many equations as unknowns, and fewest of both where as many links as possible are no carriers.
Source: I. I. Artobolevsky, Theory of Mechanisms: the class of a group is that of its highest closed contour.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, islice
from typing import TypeAlias

from mechsheet.kinematics.gear_relations import terms_of
from mechsheet.kinematics.graph import Assembly, Graph, Slide
from mechsheet.model import Relation

MOST_UNKNOWNS = 4
MOST_LINKS = 8
"""A group of more links has more than four unknowns."""

LEAST_TIED = 2
"""Links of which one has its angle from a gear alone are solved before; of two and more none may."""

MOST_TRIED = 20_000

MOST_WAYS = 500
"""So many ways of reaching its carriers are tried: two slides of one link must both be on it."""

CLASSES = {3: "III", 4: "IV", 5: "V", 6: "VI"}


Meeting: TypeAlias = str | Slide
"""A joint of an assembly: the name of a shared point, or a sliding joint."""


@dataclass(frozen=True, slots=True)
class Carrier:
    """An assembly that is reached over a joint with what is known or with an earlier carrier."""

    assembly: Assembly
    reached: Meeting


@dataclass(frozen=True, slots=True)
class Binary:
    """An assembly with a pin and one joint more: what it asks of the carriers is one equation."""

    assembly: Assembly
    pin: str
    other: Meeting


@dataclass(frozen=True, slots=True)
class Chain:
    """A group, ready to be written down.

    kind   its class: "III", "IV" (of a dyad "II")
    shut   pins between carriers that are left over: the point, and the two assemblies
    known  the bodies that are solved before; others at its pins are solved later
    relations  gears, belts and racks that tie its carriers, to each other or to what is known
    """

    kind: str
    carriers: tuple[Carrier, ...]
    binaries: tuple[Binary, ...]
    shut: tuple[tuple[str, Assembly, Assembly], ...]
    known: frozenset[str]
    relations: tuple[Relation, ...] = ()

    @property
    def assemblies(self) -> tuple[Assembly, ...]:
        """All of them, carriers first."""
        return (*(each.assembly for each in self.carriers), *(each.assembly for each in self.binaries))

    @property
    def bodies(self) -> tuple[str, ...]:
        """All bodies."""
        return tuple(body for assembly in self.assemblies for body in assembly)

    @property
    def pins(self) -> tuple[str, ...]:
        """The points of its revolute joints."""
        meetings = [carrier.reached for carrier in self.carriers]
        meetings += [end for binary in self.binaries for end in (binary.pin, binary.other)]
        points = [meeting for meeting in meetings if isinstance(meeting, str)]
        return tuple(dict.fromkeys([*points, *(point for point, _, _ in self.shut)]))


class TooManyUnknownsError(Exception):
    """The smallest group has more unknowns than are solved; `assemblies` are its members."""

    def __init__(self, assemblies: Sequence[Assembly]) -> None:
        super().__init__()
        self.assemblies = tuple(assemblies)


def next_chain(
    graph: Graph,
    assemblies: Sequence[Assembly],
    solved: set[str],
    least: int,
    relations: Sequence[Relation],
) -> Chain | None:
    """The smallest group of at least so many assemblies, the first in the description's order; None where there is none.

    relations  gears, belts and racks that nothing has been solved by yet: with them a group may be smaller
    Raises TooManyUnknownsError where there is one that cannot be written with four unknowns.
    """
    tried = 0
    for count in range(LEAST_TIED if relations else least, MOST_LINKS + 1):
        for members in combinations(assemblies, count) if relations or count % 2 == 0 else ():
            tried += 1
            if tried > MOST_TRIED:
                return None
            work = _Work(graph, members, solved, relations)
            if 2 * work.joints + len(work.relations) == 3 * count and (work.relations or count >= least):
                found = work.chain()
                if found is None:
                    raise TooManyUnknownsError(members)
                return found
    return None


class _Work:
    """One set of assemblies, and what is known beside it."""

    def __init__(
        self, graph: Graph, members: Sequence[Assembly], solved: set[str], relations: Sequence[Relation]
    ) -> None:
        self.graph, self.members, self.solved = graph, members, solved
        self.of = {body: assembly for assembly in members for body in assembly}
        self.fixed = {point for body in solved for point in graph.points[body]}
        self.points = {
            assembly: tuple(dict.fromkeys(point for body in assembly for point in graph.points[body]))
            for assembly in members
        }
        self.slides = [slide for slide in graph.slides if self._joins(slide)]
        here = solved | {*self.of}
        self.relations = [
            each for each in relations if {*graph.tied(each)} <= here and not {*graph.tied(each)} <= solved
        ]
        self.tied = {name for each in self.relations for name in terms_of(each)}
        holders = dict.fromkeys(point for assembly in members for point in self.points[assembly])
        self.holders = {point: [each for each in members if point in self.points[each]] for point in holders}

    def _joins(self, slide: Slide) -> bool:
        """Whether it joins two members, or one with what is known."""
        ends = [self.of.get(body) for body in (slide.body, slide.on)]
        if ends[0] == ends[1]:
            return False
        return all(
            end is not None or body in self.solved for end, body in zip(ends, (slide.body, slide.on), strict=True)
        )

    @property
    def joints(self) -> int:
        """Joints among the members and with what is known."""
        pins = sum(len(held) - 1 + (point in self.fixed) for point, held in self.holders.items())
        return pins + len(self.slides)

    def meetings(self, assembly: Assembly) -> list[Meeting]:
        """The joints of a member, pins first, a point once."""
        pins = [point for point in self.points[assembly] if point in self.fixed or len(self.holders[point]) > 1]
        return [*pins, *(slide for slide in self.slides if {slide.body, slide.on} & {*assembly})]

    def chain(self) -> Chain | None:
        """With the fewest unknowns; None where that takes more than four."""
        binary = [
            each
            for each in self.members
            if len(ends := self.meetings(each)) == 2 and isinstance(ends[0], str) and not self.tied.intersection(each)
        ]
        for count in range(len(self.members) // 2, min(MOST_UNKNOWNS, len(self.members)) + 1):
            for others in combinations(reversed(binary), len(self.members) - count):
                found = self._reached([each for each in self.members if each not in others], others)
                if found is not None:
                    return found
        return None

    def _reached(self, carriers: list[Assembly], others: Sequence[Assembly]) -> Chain | None:
        """The carriers in the order in which they are reached, and what the others ask; None where that cannot be."""
        ways = islice(self._ways(carriers, ()), MOST_WAYS)
        return next((found for placed in ways if (found := self._held(placed, others)) is not None), None)

    def _ways(self, carriers: list[Assembly], placed: tuple[Carrier, ...]) -> Iterator[tuple[Carrier, ...]]:
        """Every order in which the carriers can be reached, over which joints: over pins first."""
        if len(placed) == len(carriers):
            yield placed
        for step in self._steps(carriers, {each.assembly for each in placed}):
            yield from self._ways(carriers, (*placed, step))

    def _held(self, placed: tuple[Carrier, ...], others: Sequence[Assembly]) -> Chain | None:
        """The group where carriers are reached so; None where a sliding joint is left that nothing asks about."""
        there = {each.assembly for each in placed}
        used = {each.reached for each in placed}
        known = self.fixed | {point for each in there for point in self.points[each]}
        binaries = []
        for assembly in sorted(others, key=self.members.index):
            first, second = self.meetings(assembly)
            if not isinstance(first, str) or first not in known or not self._stands(second, assembly, known, there):
                return None
            binaries.append(Binary(assembly, first, second))
        shut = self._shut(placed)
        left = [slide for slide in self.slides if slide not in used and self._between(slide, there)]
        if left or len(placed) != len(binaries) + 2 * len(shut) + len(self.relations) or not self._slid(used):
            return None
        return Chain(self._class(), placed, tuple(binaries), shut, frozenset(self.solved), tuple(self.relations))

    def _slid(self, used: set[Meeting]) -> bool:
        """Whether the displacements that racks tie are unknowns, or of joints between what is known."""
        slides = [self.graph.slide(name) for name in self.tied if name not in self.graph.bodies]
        return all(slide in used or {slide.body, slide.on} <= self.solved for slide in slides)

    def _steps(self, carriers: list[Assembly], there: set[Assembly]) -> Iterator[Carrier]:
        """Carriers that can be reached now, over pins first."""
        for pins in (True, False):
            for assembly in carriers:
                for meeting in self.meetings(assembly) if assembly not in there else ():
                    known = self.fixed | {point for each in there for point in self.points[each]}
                    if isinstance(meeting, str) == pins and self._stands(meeting, assembly, known, there):
                        yield Carrier(assembly, meeting)

    def _stands(self, meeting: Meeting, assembly: Assembly, known: set[str], there: set[Assembly]) -> bool:
        """Whether the other side of a joint of an assembly is known or a carrier that has been reached."""
        if isinstance(meeting, str):
            return meeting in known
        other = meeting.beyond(assembly)
        return other in self.solved or self.of.get(other) in there

    def _between(self, slide: Slide, there: set[Assembly]) -> bool:
        return all(body in self.solved or self.of.get(body) in there for body in (slide.body, slide.on))

    def _shut(self, placed: Sequence[Carrier]) -> tuple[tuple[str, Assembly, Assembly], ...]:
        """Pins at which carriers meet that were reached over other joints."""
        found: list[tuple[str, Assembly, Assembly]] = []
        holder: dict[str, Assembly] = {}
        for carrier in placed:
            for point in self.points[carrier.assembly]:
                if carrier.reached == point:
                    continue
                if point in self.fixed:
                    found.append((point, (), carrier.assembly))
                elif point in holder:
                    found.append((point, holder[point], carrier.assembly))
                holder.setdefault(point, carrier.assembly)
        return tuple(found)

    def _class(self) -> str:
        """III, or the number of links in the smallest closed loop inside."""
        if len(self.members) == 2:
            return "II"
        joined: dict[Assembly, set[Assembly]] = {each: set() for each in self.members}
        for held in self.holders.values():
            for one, other in combinations(held, 2):
                joined[one].add(other)
                joined[other].add(one)
        for slide in self.slides:
            ends = [self.of[body] for body in (slide.body, slide.on) if body in self.of]
            if len(ends) == 2:
                joined[ends[0]].add(ends[1])
                joined[ends[1]].add(ends[0])
        for length in range(4, len(self.members) + 1):
            if any(_loop(joined, (start,), length) for start in self.members):
                return CLASSES.get(length, str(length))
        return "III"


def _loop(joined: dict[Assembly, set[Assembly]], way: tuple[Assembly, ...], length: int) -> bool:
    """Whether a way over so many members comes back to where it began."""
    if len(way) == length:
        return way[0] in joined[way[-1]]
    return any(_loop(joined, (*way, step), length) for step in joined[way[-1]] if step not in way)

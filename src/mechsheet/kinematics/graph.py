"""Which bodies touch where: the incidence that mobility and the order of solution are found from.

A body is a link, or the massless block that stands for a pin-slot joint: the block turns about the joint's point and
slides on the joint's `on`, so every sliding joint is one prismatic joint between two bodies, and five dyads suffice.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass
from typing import TypeAlias

from mechsheet.model import Gear, Joint, Mechanism, Relation
from mechsheet.words.equations import BLOCK

Assembly: TypeAlias = tuple[str, ...]
"""Bodies that move as one, in order: the frame of the first is the assembly's."""


@dataclass(frozen=True, slots=True)
class Slide:
    """A prismatic joint between two bodies: `body` (the one that has the point) slides along a line of `on`."""

    joint: Joint
    body: str
    on: str

    def other(self, body: str) -> str:
        """The body at the other side."""
        return self.on if body == self.body else self.body

    def side(self, assembly: Collection[str]) -> str:
        """The body of an assembly that is one of the two."""
        return self.body if self.body in assembly else self.on

    def beyond(self, assembly: Collection[str]) -> str:
        """The body at the other side of an assembly that has one of the two."""
        return self.other(self.side(assembly))


@dataclass(frozen=True, slots=True)
class Graph:
    """Bodies in order (ground first), the points of each, and the slides between them.

    blocks     names of the bodies that are blocks of pin-slot joints, mapped to their joint
    relations  gears, belts and racks: each takes one freedom from the bodies that it ties
    """

    bodies: tuple[str, ...]
    points: dict[str, tuple[str, ...]]
    slides: tuple[Slide, ...]
    blocks: dict[str, Joint]
    relations: tuple[Relation, ...] = ()

    def slide(self, symbol: str) -> Slide:
        """The sliding joint with this displacement."""
        return next(slide for slide in self.slides if slide.joint.symbol == symbol)

    def tied(self, relation: Relation) -> tuple[str, ...]:
        """The bodies whose motion against each other a relation ties."""
        if isinstance(relation, Gear):
            return relation.turning
        slide = self.slide(relation.joint)
        return tuple(dict.fromkeys((relation.link, slide.body, slide.on)))

    def bodies_at(self, point: str) -> tuple[str, ...]:
        """Bodies that share a point."""
        return tuple(body for body in self.bodies if point in self.points[body])

    def slides_of(self, body: str) -> tuple[Slide, ...]:
        """Prismatic joints at a body."""
        return tuple(slide for slide in self.slides if body in (slide.body, slide.on))

    @property
    def pins(self) -> tuple[tuple[str, tuple[str, ...]], ...]:
        """Points shared by two or more bodies, with those bodies."""
        names = dict.fromkeys(point for body in self.bodies for point in self.points[body])
        shared = ((point, self.bodies_at(point)) for point in names)
        return tuple((point, bodies) for point, bodies in shared if len(bodies) > 1)


def graph_of(mechanism: Mechanism) -> Graph:
    """The bodies and joints of a mechanism, blocks of pin-slot joints placed after the link they slide on."""
    after: dict[str, list[str]] = {}
    points = {link.name: tuple(link.points) for link in mechanism.links}
    blocks: dict[str, Joint] = {}
    slides = []
    for joint in mechanism.joints:
        if joint.kind == "prismatic":
            slides.append(Slide(joint, joint.link, joint.on))
            continue
        block = f"{BLOCK}{joint.symbol}"
        blocks[block] = joint
        points[block] = (joint.point,)
        after.setdefault(joint.on, []).append(block)
        slides.append(Slide(joint, block, joint.on))
    bodies: list[str] = []
    for link in mechanism.links:
        bodies += [link.name, *after.get(link.name, [])]
    return Graph(tuple(bodies), points, tuple(slides), blocks, mechanism.relations)

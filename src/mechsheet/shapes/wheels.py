"""Which wheels and belts there are, and how large the wheels are.

Pitch radii follow from the distance of the axes and the ratio i: |i / (i - 1)| and |1 / (i - 1)| of it. Pulleys have
no size in the description: they are drawn in the ratio, together half as large as their distance.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, symbols
from livesheet.formula.scalar import evaluate
from livesheet.formula.vectors import minus, size
from mechsheet.kinematics.equations import LinkPose
from mechsheet.model import Gear, Link, Mechanism, Rack

ALIKE = 1e-9
"""A ratio that differs from 1 by less has no pitch circles."""


@dataclass(frozen=True, slots=True)
class Wheel:
    """A circle about a point that turns with a link. `radius`: over dimensions and constants."""

    link: Link
    axis: str
    radius: Node

    @property
    def key(self) -> tuple[str, str, Node]:
        """What tells it from other wheels."""
        return self.link.name, self.axis, self.radius


@dataclass(frozen=True, slots=True)
class Belt:
    """Two pulleys, the one on `on` first; `crossed`: 1, or -1 where the belt is crossed."""

    wheels: tuple[Wheel, Wheel]
    crossed: float


def axis_between(wheel: Link, arm: Link) -> str:
    """The point about which a wheel turns on its arm."""
    return next(point for point in wheel.points if point in arm.points)


def wheels_of(
    mechanism: Mechanism, poses: Mapping[str, LinkPose], values: Mapping[str, float]
) -> tuple[list[Wheel], list[Belt]]:
    """All wheels, each once, and the belts; `values`: those of all dimensions."""
    links = {link.name: link for link in mechanism.links}
    wheels: list[Wheel] = []
    belts: list[Belt] = []
    for relation in mechanism.relations:
        wheel, arm = links[relation.link], links[relation.arm]
        if isinstance(relation, Rack):
            wheels.append(Wheel(wheel, axis_between(wheel, arm), Call("ABS", (relation.radius,))))
            continue
        pair = _pair(relation, links, poses, values)
        if pair is None:
            continue
        wheels += pair
        ratio = evaluate(relation.ratio, values)
        if relation.kind == "belt" or abs(ratio - 1) < ALIKE:
            belts.append(Belt(pair, 1.0 if ratio > 0 else -1.0))
    found: list[Wheel] = []
    for each in wheels:
        if not any(_alike(each, other, values) for other in found):
            found.append(each)
    return found, [
        Belt((_known(belt.wheels[0], found, values), _known(belt.wheels[1], found, values)), belt.crossed)
        for belt in belts
    ]


def _alike(one: Wheel, other: Wheel, values: Mapping[str, float]) -> bool:
    """Whether two circles are one: a planet has one pitch circle, with the sun and with the ring."""
    if one.link is not other.link or one.axis != other.axis:
        return False
    if one.radius == other.radius:
        return True
    if not {*symbols(one.radius), *symbols(other.radius)} <= values.keys():
        return False
    return math.isclose(evaluate(one.radius, values), evaluate(other.radius, values), rel_tol=ALIKE)


def _known(wheel: Wheel, found: Sequence[Wheel], values: Mapping[str, float]) -> Wheel:
    return next(other for other in found if _alike(wheel, other, values))


def _pair(
    gear: Gear, links: Mapping[str, Link], poses: Mapping[str, LinkPose], values: Mapping[str, float]
) -> tuple[Wheel, Wheel] | None:
    """Both wheels, the one on `on` first; None for wheels about one axis."""
    arm = links[gear.arm]
    on, link = links[gear.on], links[gear.link]
    start, end = axis_between(on, arm), axis_between(link, arm)
    if start == end:
        return None
    places = poses[arm.name].places
    length, ratio = size(minus(places[end], places[start])), al.call("ABS", gear.ratio)
    if gear.kind == "gear" and abs(evaluate(gear.ratio, values) - 1) >= ALIKE:
        least = al.div(length, al.call("ABS", al.sub(gear.ratio, al.ONE)))
    else:
        least = al.div(length, al.add(al.TWO, al.mul(al.TWO, ratio)))
    return Wheel(on, start, al.mul(ratio, least)), Wheel(link, end, least)

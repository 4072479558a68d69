"""The list: everything that a mechanism looks like, from back to front."""

from __future__ import annotations

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

from livesheet import portable
from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Symbol, symbols
from livesheet.formula.scalar import evaluate
from livesheet.formula.vectors import Vector, dot, minus, plus, size, times, together, turned
from mechsheet.kinematics.equations import Equations, LinkPose
from mechsheet.model import Gear, Joint, Link, Mechanism, Rack
from mechsheet.shapes.cams import cam_shapes
from mechsheet.shapes.colors import INK, PATHS, SERIES, pale
from mechsheet.shapes.described import (
    Described,
    block_has_line,
    corners,
    direction_of,
    line_end,
    moving_points,
    through_of,
    traced_points,
)
from mechsheet.shapes.forms import (
    BLOCK,
    BLOCK_HEIGHT,
    HALF,
    PAD,
    PIN,
    POINT,
    SUPPORT,
    WHEEL,
    Frame,
    Kind,
    Mark,
    Name,
    Path,
    Shape,
    Shapes,
    along,
    comb,
    place_of,
    plate,
    sized,
    telescope,
    unit,
)
from mechsheet.shapes.loads import acting, loaded_points
from mechsheet.words.symbols import plain

ALIKE = 1e-9
"""A ratio that differs from 1 by less has no pitch circles."""

BORE = 0.033
"""Half the width of a cylinder, in half windows."""

WIDTH = 1.25
"""Of the lines of wheels, belts and racks [points]."""

TEETH, TOOTH = 24, 0.014
"""Of a rack: how many, and half their height in half windows."""

RACK: Path = tuple((step / (2 * TEETH), TOOTH if step % 2 else -TOOTH) for step in range(2 * TEETH + 1))


def shapes_of(mechanism: Mechanism, equations: Equations, vectors: Collection[Kind] = ()) -> Shapes:
    """The list of a mechanism; `vectors`: which of `VECTORS` are wanted."""
    known, found = Described(mechanism, equations), Shapes()
    springs, loads = acting(known, found, vectors)
    for index, point in enumerate(traced_points(mechanism)):
        color = PATHS[index % len(PATHS)]
        found.shapes.append(Shape("path", plain(point), color, 1.0, corners=(place_of(point),)))
    cylinders = [joint for joint in mechanism.sliding if is_cylinder(known, joint)]
    guides = [_Guide(known, found, joint) for joint in mechanism.sliding if joint not in cylinders]
    found.shapes += _toothed(known, found)
    found.shapes += cam_shapes(known, found)
    found.shapes += [guide.rail() for guide in guides if guide.on_ground]
    anchors = loaded_points(known)
    held = [point for point in known.ground.points if point in known.pins or point in anchors]
    found.shapes += [_support(known, point) for point in held]
    found.shapes += [guide.slot() for guide in guides if not guide.on_ground]
    for link in mechanism.whole_links[1:]:
        if len(link.points) > 1:
            order = corners(link, known.dimensions)
            closed = (*order, order[0]) if len(order) > 2 else order
            places = tuple(map(place_of, closed))
            found.shapes.append(plate(known.called(link), known.color(link.name), places))
    found.shapes += [guide.block() for guide in guides]
    for joint in cylinders:
        found.shapes += _cylinder(known, found, joint)
    found.shapes += springs
    marked = dict.fromkeys((*known.pins, *moving_points(mechanism), *held))
    for point in marked:
        pin = point in known.pins
        at, radius = place_of(point), PIN if pin else POINT
        found.shapes.append(Mark("pin" if pin else "point", plain(point), at, radius, "FFFFFF" if pin else INK))
        found.around.append((at, al.ZERO))
    found.shapes += loads
    found.names[:0] = [Name(plain(point), place_of(point), needed=True) for point in marked]
    return found


def _support(known: Described, point: str) -> Shape:
    """The hatched support of a fixed point."""
    frame = Frame(place_of(point), (HALF, al.ZERO), (al.ZERO, HALF))
    return Shape("ground", known.text("drawing.support", point=plain(point)), INK, 1.0, frame, SUPPORT)


# --- slides ----------------------------------------------------------------------------------------------------------


class _Guide:
    """The line of a sliding joint: where it passes, in which direction, from where to where."""

    def __init__(self, known: Described, found: Shapes, joint: Joint) -> None:
        self.known, self.joint, self.mechanism = known, joint, known.mechanism
        self.through = through_of(self.mechanism, joint)
        self.way = along(direction_of(self.mechanism, joint))
        self.sleeve = block_has_line(self.mechanism, joint)
        slid: Node = Symbol(joint.symbol)
        least, most = found.extreme("min", slid), found.extreme("max", slid)
        ends = (al.sub(slid, most), al.sub(slid, least)) if self.sleeve else (least, most)
        self.start, self.end = al.sub(ends[0], sized(PAD)), al.add(ends[1], sized(PAD))
        self.on_ground = joint.on == known.ground.name

    def _named(self, key: str) -> str:
        return self.known.text(f"drawing.{key}", symbol=plain(self.joint.symbol))

    def along(self, way: Node) -> Vector:
        """A place of the line."""
        return plus(self.through, times(way, self.way))

    def rail(self) -> Shape:
        """A guide fixed to the ground: a hatched line under the block, as long as the stroke and a little more."""
        below = portable.cos(evaluate(direction_of(self.mechanism, self.joint), self.known.dimensions)) >= -1e-9
        side = -1.0 if below else 1.0
        path = tuple((a, side * (BLOCK_HEIGHT - b)) for a, b in comb(1.0, 11, 0.03, 0.0))
        reach = times(al.sub(self.end, self.start), self.way)
        frame = Frame(self.along(self.start), reach, times(HALF, turned(self.way)))
        return Shape("slide", self._named("rail"), INK, 1.0, frame, path)

    def slot(self) -> Shape:
        """A guide on a moving link: from a point of the link to the line, and along the line over the stroke."""
        owner = self.joint.link if self.sleeve else self.joint.on
        base = self.joint.point if self.sleeve else line_end(self.joint, self.mechanism)
        start = place_of(base) if base else self.through
        places = (start, self.through, self.along(self.start), self.along(self.end))
        return Shape("slide", self._named("slot"), self.known.color(owner), 2.0, corners=places)

    def block(self) -> Shape:
        """A rectangle that turns with its guide; a massless one is smaller, so that it is seen inside another one."""
        joint = self.joint
        at, owner, part = place_of(joint.point), joint.link, 1.0
        if self.sleeve:
            at, owner = self.through, joint.on
        elif joint.kind != "prismatic":
            owner, part = "", 0.7
        frame = Frame(at, times(sized(part), self.way), times(sized(part), turned(self.way)))
        color = self.known.color(owner) if owner else INK
        return Shape("slide", self._named("block"), color, 2.0, frame, BLOCK, fill=pale(color))


def is_cylinder(known: Described, joint: Joint) -> bool:
    """Whether a sliding joint is a barrel and its rod: two moving links, each with one pin alone, both pins on the line."""
    barrel, rod = known.links[joint.on], known.links[joint.link]
    eyes = [*barrel.points, *rod.points]
    if joint.kind != "prismatic" or known.ground in (barrel, rod) or len(eyes) != 2 or not set(eyes) <= set(known.pins):
        return False
    if isinstance(joint.through, str):
        return joint.through == eyes[0]
    through = al.as_node(joint.through[0]), al.as_node(joint.through[1])
    offset = minus(through, known.equations.poses[barrel.name].places[eyes[0]])
    aside = evaluate(dot(offset, turned(along(al.as_node(joint.angle)))), known.dimensions)
    return abs(aside) <= ALIKE * max(1.0, *map(abs, known.dimensions.values()))


def _cylinder(known: Described, found: Shapes, joint: Joint) -> Iterator[Shape]:
    """The rod from its eye into the barrel, and the barrel from the other eye, from pin to pin."""
    eye = place_of(next(iter(known.links[joint.on].points)))
    name = known.text("picture.cylinder", symbol=plain(joint.symbol))
    colors = known.color(joint.on), known.color(joint.link)
    yield from telescope(found, "cylinder", name, (eye, place_of(joint.point)), colors, BORE)


# --- wheels ----------------------------------------------------------------------------------------------------------


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
    """All wheels, each once, and the belts; `values`: those of all dimensions.

    Pitch radii follow from the distance of the axes and the ratio i: |i / (i - 1)| and |1 / (i - 1)| of it. Pulleys have no
    size in the description: they are drawn in the ratio, together half as large as their distance.
    """
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


def _toothed(known: Described, found: Shapes) -> Iterator[Shape]:
    """Wheels, belts and racks."""
    mechanism = known.mechanism
    if not mechanism.relations:
        return
    wheels, belts = wheels_of(mechanism, known.equations.poses, known.dimensions)
    for wheel in wheels:
        angle = al.ZERO if wheel.link is known.ground else Symbol(wheel.link.angle_symbol)
        rim = times(wheel.radius, along(angle))
        name = known.text("drawing.wheel", link=known.called(wheel.link))
        found.around.append((place_of(wheel.axis), wheel.radius))
        yield Shape(
            "gear", name, known.color(wheel.link.name), WIDTH, Frame(place_of(wheel.axis), rim, turned(rim)), WHEEL
        )
    for belt in belts:
        for side in (1.0, -1.0):
            yield _belt(known, belt, side)
    for rack in mechanism.relations:
        if isinstance(rack, Rack):
            yield _rack(known, found, rack)


def _belt(known: Described, belt: Belt, side: float) -> Shape:
    """One of the two straight parts: where both circles have one tangent.

    With e the direction from the first axis to the second and n across it, both radii point along
    u = e cos b + n sin b, cos b = (r1 - r2) / distance, r2 with a minus for a crossed belt.
    """
    one, other = belt.wheels
    way = minus(place_of(other.axis), place_of(one.axis))
    radii = one.radius, al.mul(al.number(belt.crossed), other.radius)
    cosine = al.div(al.sub(*radii), size(way))
    sine = al.mul(al.number(side), al.sqrt(al.call("MAX", al.ZERO, al.sub(al.ONE, al.square(cosine)))))
    out = plus(times(cosine, unit(way)), times(sine, turned(unit(way))))
    places = tuple(plus(place_of(wheel.axis), times(r, out)) for wheel, r in zip(belt.wheels, radii, strict=True))
    name = known.text("drawing.belt", link=known.called(other.link))
    return Shape("belt", name, SERIES[0], WIDTH, corners=places)


def _rack(known: Described, found: Shapes, rack: Rack) -> Shape:
    """A toothed bar on the pitch line, as long as the stroke and a little more, moving with what carries the teeth."""
    mechanism = known.mechanism
    joint = next(each for each in mechanism.sliding if each.symbol == rack.joint)
    guide = _Guide(known, found, joint)
    moving = rack.arm == joint.on
    bar = known.links[joint.link if moving else joint.on]
    axis = place_of(axis_between(known.links[rack.link], known.links[rack.arm]))
    slid = Symbol(rack.joint)
    # from the pinion's axis along the line: what of the bar lies beside it in the other positions
    first = al.sub(slid, guide.end) if moving else al.sub(guide.start, slid)
    beside = al.neg(rack.radius) if moving else rack.radius
    origin = together([axis, times(first, guide.way), times(beside, turned(guide.way))])
    frame = Frame(origin, times(al.sub(guide.end, guide.start), guide.way), times(HALF, turned(guide.way)))
    return Shape("rack", known.text("drawing.rack", link=known.called(bar)), known.color(bar.name), WIDTH, frame, RACK)

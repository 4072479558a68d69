"""The part [cam]: what its profile touches, and where its follower is on the base circle."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Any

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle, right_angle
from livesheet.formula.nodes import Call, Node
from livesheet.formula.vectors import Vector, cross, dot, minus, plus, times, turned
from livesheet.said import say
from mechsheet.description.joints import Ends
from mechsheet.description.kinds import ANGLE, LENGTH
from mechsheet.description.report import BAD
from mechsheet.description.scope import Scope, own_cell
from mechsheet.diagnostics import quoted
from mechsheet.model import Cam, Cartesian, Dimension, GivenPoint, Joint, Link, Polar, Quantity, touched_by
from mechsheet.units import unit_of

USUAL_OF_SLIDE, USUAL_OF_ROCKER = 30.0, 45.0
"""Pressure angles [degrees] up to which followers run well. Source: R. L. Norton, Design of Machinery, section 8.6."""

SQUARE = 1e-9
"""A sine below this is no direction in which a face could be moved."""


@dataclass(frozen=True, slots=True)
class ReadCam:
    """The cam, the cells of its lengths, and where the follower is on the base circle; None where that does not say."""

    cam: Cam
    dimensions: tuple[Dimension, ...]
    start: Node | None


def read(
    data: dict[str, Any], driver: Any, links: tuple[Link, ...], joints: tuple[Joint, ...], ends: Ends, scope: Scope
) -> ReadCam | None:
    """The cam, when no fault hides it; `driver`: the part [driver], which has segments."""
    cells: list[Dimension] = []
    length = unit_of(scope.length_unit, scope.length_unit)
    if data.get("center", BAD) is BAD or data.get("base_radius", BAD) is BAD:
        return None

    def cell(symbol: str, value: Any, kind: str, path: tuple[str, ...]) -> Node:
        unit = scope.angle_unit if kind == ANGLE else length
        return own_cell(scope, cells, symbol, value, kind, unit, ("cam", *path), "cam")

    radius = cell("base_radius", data["base_radius"], LENGTH, ("base_radius",))
    if scope.number(radius) <= 0:
        scope.report.at(("cam", "base_radius"), say("the radius of the base circle must be greater than 0"))
    slides = isinstance(driver, dict) and "joint" in driver and "link" not in driver
    usual = scope.angle_unit.written(math.radians(USUAL_OF_SLIDE if slides else USUAL_OF_ROCKER))
    limit = cell("alpha_limit", data.get("pressure_angle", usual), ANGLE, ("pressure_angle",))
    if data.get("turns", 1) == 0:
        scope.report.at(("cam", "turns"), say("1 turns the cam counter-clockwise, -1 clockwise; 0 is neither"))
    clockwise = data.get("turns", 1) == -1
    if "roller" in data:
        roller = data["roller"]
        if roller is BAD or BAD in (roller["point"], roller["radius"]):
            return None
        wheel = cell("roller_radius", roller["radius"], LENGTH, ("roller", "radius"))
        if scope.number(wheel) < 0:
            scope.report.at(("cam", "roller", "radius"), say("a radius is not negative; 0 is a knife edge"))
        if not _moves(roller["point"], links, ("cam", "roller", "point"), scope):
            return None
        cam = Cam(links[-1].name, data["center"], clockwise, radius, roller["point"], limit, wheel)
    else:
        face = data.get("face", BAD)
        if face is BAD or BAD in (face["link"], face["point"]):
            return None
        link, path = face["link"], ("cam", "face")
        if not ends.has_link(link, (*path, "link")) or not ends.has_point(link, face["point"], (*path, "point")):
            return None
        if link == links[0].name:
            scope.report.at((*path, "link"), say("the face is on the ground: the cam could not move it"))
            return None
        angle = cell("face_angle", face.get("angle", 0), ANGLE, ("face", "angle"))
        cam = Cam(links[-1].name, data["center"], clockwise, radius, face["point"], limit, None, link, angle)
    _turns_elsewhere(cam, driver, links, scope)
    start = None
    if isinstance(driver, dict) and "start" not in driver:
        begun = _Start(cam, driver, links, joints, scope).found()
        if begun is not None:
            start = begun.start
            cam = replace(cam, decides_start=True, offset=begun.offset, touches=begun.touches)
    return ReadCam(cam, tuple(cells), start)


def _turns_elsewhere(cam: Cam, driver: Any, links: tuple[Link, ...], scope: Scope) -> None:
    """Refuse a rocker that turns about the cam's own centre: no profile could turn it."""
    link = driver.get("link", BAD) if isinstance(driver, dict) else BAD
    touching = touched_by(cam, links)
    if touching is not None and link == touching.name and cam.center in touching.points:
        message = say(
            "the rocker turns about {center}, the centre of the cam: no profile could turn it", center=cam.center
        )
        scope.report.at(("cam", "center"), message)


def declare(cam: Cam, scope: Scope) -> None:
    """Enter the names of the cam's columns, which must be free."""
    scope.of_cam.update(cam.symbols)
    for name in dict.fromkeys(symbol.partition(".")[0] for symbol in cam.symbols):
        scope.symbols.claim(name, "column of the cam", ("cam",), say("rename it: the cam has a column of that name"))


def _moves(point: str, links: tuple[Link, ...], path: tuple[str, ...], scope: Scope) -> bool:
    owners = [link for link in links if point in link.points]
    if not owners:
        scope.report.at(path, say("no link has a point {point}", point=quoted(point)))
    elif owners[0] is links[0]:
        scope.report.at(
            path, say("{name} is a point of the ground: the cam could not move a roller there", name=quoted(point))
        )
        return False
    return bool(owners)


@dataclass(frozen=True, slots=True)
class _Begun:
    """Where the follower starts: its displacement or angle; `offset` and `touches` as a `Cam` has them."""

    start: Node
    offset: Node | None = None
    touches: Node | None = None


class _Start:
    """Where the follower stands when its roller or face touches the base circle, of a slide or a rocker on the ground.

    Of two such places it is the one from which the first rise goes outwards.
    """

    def __init__(
        self, cam: Cam, driver: dict[str, Any], links: tuple[Link, ...], joints: tuple[Joint, ...], scope: Scope
    ) -> None:
        self.cam, self.driver, self.links, self.joints, self.scope = cam, driver, links, joints, scope
        self.ground = links[0]

    def found(self) -> _Begun | None:
        """None where the base circle alone does not say it."""
        touching = touched_by(self.cam, self.links)
        where = self.ground.points.get(self.cam.center)
        center = None if where is None else _place(where)
        own = None if touching is None else _place(touching.points[self.cam.point])
        if touching is None or center is None or own is None:
            return None
        if "joint" in self.driver and "link" not in self.driver:
            joint = next((one for one in self.joints if one.name == self.driver["joint"]), None)
            if (
                joint is None
                or joint.kind != "prismatic"
                or (joint.link, joint.on) != (touching.name, self.ground.name)
            ):
                return None
            pin = _place(touching.points[joint.point])
            return None if pin is None else self._slide(joint, center, own, pin)
        link = self.driver.get("link", BAD)
        if link != touching.name or self.driver.get("relative_to", self.ground.name) != self.ground.name:
            return None
        shared = next((point for point in touching.points if point in self.ground.points), None)
        if shared is None or self.cam.radius is None:
            return None
        pivot, pin = _place(self.ground.points[shared]), _place(touching.points[shared])
        if pivot is None or pin is None:
            return None
        return self._rocker(minus(pivot, center), minus(own, pin))

    def _slide(self, joint: Joint, center: Vector, own: Vector, pin: Vector) -> _Begun | None:
        through = joint.through
        base = _place(self.ground.points[through]) if isinstance(through, str) else _place(Cartesian(*through))
        if base is None:
            return None
        line = _angle(joint.angle)
        aside = line + _angle(joint.orientation)
        along = _direction(line)
        way = plus(minus(base, center), _rotated(minus(own, pin), aside))
        outwards = self._outwards()
        if self.cam.radius is not None:
            reach = al.add(al.as_node(self.cam.base_radius), al.as_node(self.cam.radius))
            across, before = cross(way, along), dot(way, along)
            square = al.sub(al.square(reach), al.square(across))
            if self.scope.number(square) < 0:
                message = say("the slide passes the centre at {offset:.6g}: a base circle of {radius:.6g} does not reach it",
                              offset=abs(self.scope.number(across)), radius=self.scope.number(reach))  # fmt: skip
                self.scope.report.at(("cam", "base_radius"), message)
                return None
            root = al.sqrt(square)
            return _Begun(al.sub(root if outwards else al.neg(root), before), across, square)
        normal = _direction(aside + _angle(self.cam.face) + Angle(degrees=90))
        moved = dot(normal, along)
        if abs(self.scope.number(moved)) < SQUARE:
            message = say("the face is nowhere tangent to the cam: it lies along the way of the slide")
            self.scope.report.at(("cam", "face"), message)
            return None
        radius = al.as_node(self.cam.base_radius)
        far = radius if (self.scope.number(moved) > 0) == outwards else al.neg(radius)
        return _Begun(al.div(al.sub(far, dot(normal, way)), moved))

    def _rocker(self, pivot: Vector, arm: Vector) -> _Begun | None:
        reach = al.add(al.as_node(self.cam.base_radius), al.as_node(self.cam.radius or 0.0))
        far, long = (al.add(al.square(x), al.square(y)) for x, y in (pivot, arm))
        opposite, product = al.sub(al.sub(al.square(reach), far), long), al.mul(al.sqrt(far), al.sqrt(long))
        cosine = al.div(opposite, al.mul(al.TWO, product))
        if not abs(self.scope.number(cosine)) <= 1:
            self.scope.report.at(("cam", "base_radius"), say("the roller never touches a base circle of this radius"))
            return None
        between = Call("ACOS", (cosine,))
        facing = al.sub(al.atan2(*pivot), al.atan2(*arm))
        start = al.sub(facing, between) if self._outwards() else al.add(facing, between)
        return _Begun(start, touches=al.sub(al.mul(al.TWO, product), Call("ABS", (opposite,))))

    def _outwards(self) -> bool:
        """Whether the first part that moves goes towards larger values."""
        segments = self.driver.get("segments", ())
        for each in () if segments is BAD else segments:
            if each is BAD or each.get("law") == "dwell":
                continue
            way = each.get("by", each.get("to", 0.0))
            kind = LENGTH if "joint" in self.driver and "link" not in self.driver else ANGLE
            told = len(self.scope.report.faults)
            number = self.scope.number(self.scope.quantity(way, kind, ("driver", "segments")))
            del self.scope.report.faults[told:]
            return not number < 0
        return True


def _place(place: GivenPoint) -> Vector | None:
    match place:
        case Cartesian(x, y):
            return al.as_node(x), al.as_node(y)
        case Polar(r, angle):
            return times(al.as_node(r), _direction(_angle(angle)))
    return None


def _angle(quantity: Quantity) -> Angle:
    return right_angle(quantity) if isinstance(quantity, float) else Angle(quantity)


def _direction(angle: Angle) -> Vector:
    return al.cos(angle), al.sin(angle)


def _rotated(vector: Vector, angle: Angle) -> Vector:
    along = _direction(angle)
    return plus(times(vector[0], along), times(vector[1], turned(along)))

"""What is known so far: the pose of every solved body and the coordinates of every solved point, as formulas.

Bodies move alone or in assemblies: two links whose driven joint is not on the ground move as one rigid assembly whose
shape depends on the driver. `Member` says where a body stands in its assembly's frame (the frame of its first body).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Node, Symbol, symbols
from livesheet.formula.vectors import Vector, plus, times
from livesheet.said import Words
from mechsheet.kinematics.assur import Drive, Dyad, Pin
from mechsheet.kinematics.equations import LinkPose
from mechsheet.kinematics.gear_relations import Tied, solved_for
from mechsheet.kinematics.graph import Assembly, Graph, Slide
from mechsheet.kinematics.ledger import Ledger
from mechsheet.kinematics.points_in_link import ORIGIN, PointInLink, PointsInLink, angle_of, arm_of, cartesian
from mechsheet.model import Joint, Link, Mechanism
from mechsheet.units import ANGLE, LENGTH
from mechsheet.words.equations import body_words, link_words, listed, phrase


@dataclass(frozen=True, slots=True)
class Pose:
    """A solved body: its angle, and one of its points (its place in the body, its coordinates)."""

    angle: Angle
    base: PointInLink
    x: Node
    y: Node


@dataclass(frozen=True, slots=True)
class Member:
    """A body in its assembly: its angle from the assembly's frame, and where its own origin lies there.

    pin  a point that it shares with a body before it, from which its place is found once that one is solved
    """

    angle: Angle
    origin: PointInLink
    pin: str = ""


@dataclass(frozen=True, slots=True)
class Guide:
    """A line along which a point of an assembly moves, seen from what is solved: point = (x, y) + sign * s * direction.

    delta  direction of positive displacement;  angle  the (known) angle of the assembly;  moving  the place, in the
    assembly's frame, that moves along the line;  sign  -1 when the line belongs to the assembly and the point is fixed
    """

    x: Node
    y: Node
    delta: Angle
    sign: int
    angle: Angle
    moving: PointInLink
    symbol: str

    @property
    def direction(self) -> Vector:
        """That of positive displacement."""
        return al.cos(self.delta), al.sin(self.delta)

    def signed(self, way: Node) -> Node:
        """A way along the line as a displacement, or a displacement as a way."""
        return way if self.sign > 0 else al.neg(way)


STILL = Member(Angle(), ORIGIN)
"""Of a body whose frame is its assembly's."""


class Poses:
    """The state of the solution.

    xy  the coordinates of solved points;  directions  those of lines, by displacement
    """

    def __init__(self, mechanism: Mechanism, graph: Graph, ledger: Ledger) -> None:
        self.mechanism = mechanism
        self.graph = graph
        self.ledger = ledger
        self.links = {link.name: link for link in mechanism.links}
        self.points = {link.name: PointsInLink(link, ledger) for link in mechanism.links}
        self.members: dict[str, Member] = dict.fromkeys(graph.bodies, STILL)
        self.known: dict[str, Pose] = {}
        self.xy: dict[str, tuple[Node, Node]] = {}
        self.turned: list[tuple[str, Angle]] = []
        self.directions: dict[str, Angle] = {}
        self.to_close: frozenset[str] = frozenset()  # pins that equations bring together: each body keeps its own place
        numbers = {link.name: link.angle_symbol for link in mechanism.links}
        self.tied_angles = {numbers[name] for relation in mechanism.relations for name in relation.turning}
        self._ground(mechanism.ground)

    def _ground(self, ground: Link) -> None:
        self.known[ground.name] = Pose(Angle(), ORIGIN, al.ZERO, al.ZERO)
        for point in ground.points:
            place = self.points[ground.name].point(point)
            coordinates = []
            for axis, node in (("x", place.u), ("y", place.v)):
                label = phrase("fixed_point", point=point, axis=axis)
                symbol = self.ledger.define(f"{point}.{axis}", node, LENGTH, label, "constant")
                coordinates.append(node if al.is_simple(node) else symbol)
            self.xy[point] = (coordinates[0], coordinates[1])

    # --- points in the frame of an assembly -------------------------------------------------------------------

    def own_point(self, body: str, point: str) -> PointInLink:
        """Where a point is in its body's own frame (a block's only point is its origin)."""
        return ORIGIN if body in self.graph.blocks else self.points[body].point(point)

    def through(self, joint: Joint) -> PointInLink:
        """The point of `on` that a joint's line passes, in `on`'s own frame."""
        if isinstance(joint.through, str):
            return self.own_point(joint.on, joint.through)
        return cartesian(al.as_node(joint.through[0]), al.as_node(joint.through[1]))

    def in_assembly(self, body: str, place: PointInLink, name: str) -> PointInLink:
        """A place of a body in its assembly's frame; for a body that moves in it, columns of its coordinates."""
        member = self.members[body]
        if member.angle == Angle() and member.origin.is_zero:
            return place
        if place.is_zero:
            return member.origin
        x, y = place.turned(member.angle)
        label = phrase("in_driven_pair", name=name)
        u = self.ledger.hoist(f"u_{name}", al.add(member.origin.u, x), LENGTH, label)
        v = self.ledger.hoist(f"v_{name}", al.add(member.origin.v, y), LENGTH, label)
        return cartesian(u, v)

    def point(self, assembly: Assembly, point: str) -> PointInLink:
        """Where a point is in the assembly's frame."""
        body = next(body for body in assembly if point in self.graph.points[body])
        return self.in_assembly(body, self.own_point(body, point), point)

    def arm(self, assembly: Assembly, start: str, end: str) -> tuple[Node, Angle]:
        """Length (> 0) and direction in the assembly's frame of the arm from one of its points to another."""
        known = way = None
        for body in assembly:
            if body in self.points and {start, end} <= set(self.graph.points[body]):
                known = self.points[body].known_length(start, end)
                way = self.points[body].way(start, end) if self.members[body] == STILL else None
        way = way or self.point(assembly, end) - self.point(assembly, start)
        label = phrase("length_in_link", start=start, end=end, link=self.name(assembly))
        return arm_of(self.ledger, way, known, f"{start}{end}", label)

    def name(self, assembly: Assembly) -> Words:
        """The assembly in words."""
        return listed(body_words(self.mechanism, body) for body in assembly)

    def both(self, dyad: Dyad) -> Words:
        """The two assemblies of a dyad in words."""
        return phrase("and", first=self.name(dyad.first), second=self.name(dyad.second))

    def angle_unknown(self, assembly: Assembly) -> str:
        """The symbol that says how a solved assembly is turned: the angle of its first body."""
        return symbols(self.known[assembly[0]].angle.node)[0]

    # --- driven joints, gears ---------------------------------------------------------------------------------

    def turn_of(self, drive: Drive) -> Angle:
        """The driven angle, from `base` to `moving`."""
        return Angle(Symbol(drive.symbol)) if drive.positive else -Angle(Symbol(drive.symbol))

    def drive(self, drive: Drive) -> None:
        """Solve the moving side of a driven joint whose other side is known."""
        if isinstance(drive.joint, Slide):
            self._along(drive.joint, drive.moving, Symbol(drive.symbol))
            return
        point = drive.joint.point
        turn = self.known[drive.base].angle + self.turn_of(drive)
        self.fix((drive.moving,), turn, self.own_point(drive.moving, point), *self.xy[point])

    def _along(self, slide: Slide, body: str, displacement: Node) -> None:
        """Solve a body on the guide of a known one, at a known displacement."""
        self.fix_on_guide((body,), self.guide(slide, (body,)), displacement)

    def fix_on_guide(self, assembly: Assembly, guide: Guide, displacement: Node) -> None:
        """An assembly on a guide, at a displacement of the guide's joint."""
        way = times(guide.signed(displacement), guide.direction)
        self.fix(assembly, guide.angle, guide.moving, *plus((guide.x, guide.y), way))

    def tie(self, tied: Tied, drives: Sequence[Drive]) -> None:
        """Solve what gears and racks decide. Whole turns are theirs: none is taken out."""
        found = solved_for(tied, lambda name: self._of_tie(name, drives), self.ledger.number)
        for held in tied.bodies:
            if isinstance(held.at, Slide):
                self.displacement(held.variable, found[held.variable])
                self._along(held.at, held.body, Symbol(held.variable))
            else:
                place = self.own_point(held.body, held.at)
                self.fix((held.body,), Angle(found[held.variable]), place, *self.xy[held.at])
        self.turned.clear()

    def _of_tie(self, name: str, drives: Sequence[Drive]) -> Node:
        """What a gear or a rack reads: an angle, by the name of the body, or a displacement."""
        return self._angle(name, drives, ()).expression() if name in self.graph.bodies else Symbol(name)

    def _angle(self, body: str, drives: Sequence[Drive], tried: tuple[str, ...]) -> Angle:
        """The angle of a body that is solved, or that slides on or is driven from one whose angle is known."""
        if body in self.known:
            return self.known[body].angle
        for other, apart in self._beside(body, drives):
            if other not in tried:
                try:
                    return self._angle(other, drives, (*tried, body)) + apart
                except KeyError:
                    continue
        raise KeyError(body)

    def _beside(self, body: str, drives: Sequence[Drive]) -> Iterator[tuple[str, Angle]]:
        """Bodies against which this one keeps, or is driven to, an angle that is known."""
        for slide in self.graph.slides_of(body):
            kept = angle_of(slide.joint.angle) + angle_of(slide.joint.orientation)
            if slide.body not in self.graph.blocks:
                yield (slide.on, kept) if body == slide.body else (slide.body, -kept)
        for drive in drives:
            if body in drive.bodies and isinstance(drive.joint, Pin):
                yield (
                    (drive.base, self.turn_of(drive)) if body == drive.moving else (drive.moving, -self.turn_of(drive))
                )

    # --- what is solved ---------------------------------------------------------------------------------------

    def at(self, body: str, place: PointInLink, name: str) -> tuple[Node, Node]:
        """Coordinates of a place (in the body's own frame) of a solved body."""
        pose = self.known[body]
        x, y = (place - pose.base).turned(pose.angle)
        label = phrase("point_on", point=name, link=self.name((body,)))
        return (
            self.ledger.hoist(f"x_{name}", al.add(pose.x, x), LENGTH, label),
            self.ledger.hoist(f"y_{name}", al.add(pose.y, y), LENGTH, label),
        )

    def guide(self, slide: Slide, assembly: Assembly) -> Guide:
        """The line on which `assembly` slides, by its prismatic joint with a solved body."""
        joint = slide.joint
        inside = slide.side(assembly)
        solved = self.known[slide.other(inside)]
        label = phrase("direction_of_guide", symbol=joint.symbol)
        if inside == slide.body:
            delta = solved.angle + angle_of(joint.angle)
            angle = delta + angle_of(joint.orientation)
            through = self.xy.get(joint.through) if isinstance(joint.through, str) else None
            x, y = through or self.at(slide.on, self.through(joint), "guide")
            moving, sign = self.own_point(inside, joint.point), 1
        else:
            delta = solved.angle - angle_of(joint.orientation)
            angle = delta - angle_of(joint.angle)
            x, y = self.xy[joint.point]
            moving, sign = self.through(joint), -1
        delta = self.ledger.hoist_angle(f"delta_{joint.symbol}", delta, label)
        self.directions[joint.symbol] = delta
        place = self.in_assembly(inside, moving, "guide")
        return Guide(x, y, delta, sign, angle - self.members[inside].angle, place, joint.symbol)

    def link_pose(self, name: str) -> LinkPose:
        """The pose of a solved link's frame, and its points in it."""
        pose = self.known[name]
        x, y = pose.base.turned(pose.angle)
        places = {point: self.own_point(name, point) for point in self.graph.points[name]}
        return LinkPose(
            pose.angle.expression(),
            al.sub(pose.x, x),
            al.sub(pose.y, y),
            {point: (place.u, place.v) for point, place in places.items()},
        )

    def fix(self, assembly: Assembly, angle: Angle, base: PointInLink, x: Node, y: Node) -> None:
        """The assembly's pose is found: write down its angles and the points that were not known yet."""
        for body in assembly:
            member = self.members[body]
            own = self._body_angle(body, angle + member.angle)
            if body == assembly[0]:
                angle = own
            if member.pin:
                for before in assembly[: assembly.index(body)]:
                    self._points(before)
                self.known[body] = Pose(own, self.own_point(body, member.pin), *self.xy[member.pin])
                continue
            origin_x, origin_y = (member.origin - base).turned(angle)
            if member.origin == base:
                self.known[body] = Pose(own, ORIGIN, x, y)
            elif member == STILL:
                self.known[body] = Pose(own, base, x, y)
            else:
                name = f"origin_{self._number(body)}"
                label = phrase("origin", link=self.name((body,)))
                self.known[body] = Pose(
                    own,
                    ORIGIN,
                    self.ledger.hoist(f"x_{name}", al.add(x, origin_x), LENGTH, label),
                    self.ledger.hoist(f"y_{name}", al.add(y, origin_y), LENGTH, label),
                )
        for body in assembly:
            self._points(body)

    def _number(self, body: str) -> str:
        return str(self.links[body].number) if body in self.links else self.graph.blocks[body].symbol

    def _body_angle(self, body: str, angle: Angle) -> Angle:
        """Write `theta1n = angle` for a link; a block keeps its angle to itself."""
        if body in self.graph.blocks:
            words = phrase("angle_of", link=self.name((body,)))
            return self.ledger.hoist_angle("delta", angle, words)
        link = self.links[body]
        symbol = link.angle_symbol
        if symbol in self.mechanism.driven_symbols or symbol in self.ledger.values:
            return Angle(Symbol(symbol))  # driven, or an unknown of a group solved by Newton's method
        words = phrase("angle_of_link", number=str(link.number), link=link_words(link))
        self.turned.append((symbol, angle))
        return Angle(self.ledger.define(symbol, angle.expression(), ANGLE, words, "variable"))

    def _points(self, body: str) -> None:
        """Write down the points of a body that are not known yet, its origin first: from there the others read best."""
        for point in sorted(self.graph.points[body], key=lambda point: not self.own_point(body, point).is_zero):
            met = point in self.xy and point in self.to_close
            if point not in self.xy:
                self._point(body, point)
            if self.own_point(body, point).is_zero and not met:
                self.known[body] = Pose(self.known[body].angle, ORIGIN, *self.xy[point])

    def _point(self, body: str, point: str) -> None:
        pose = self.known[body]
        x, y = (self.own_point(body, point) - pose.base).turned(pose.angle)
        found = []
        for axis, base, part in (("x", pose.x, x), ("y", pose.y, y)):
            label = phrase("coordinate", point=point, axis=axis)
            found.append(self.ledger.define(f"{point}.{axis}", al.add(base, part), LENGTH, label, "point"))
        self.xy[point] = (found[0], found[1])

    def displacement(self, symbol: str, expression: Node) -> None:
        """Write down a sliding joint's displacement."""
        joint = next(joint for joint in self.mechanism.joints if joint.symbol == symbol)
        words = phrase("displacement", point=joint.point, link=self.name((joint.on,)))
        self.ledger.define(symbol, expression, LENGTH, words, "variable")

    def settle_turns(self) -> None:
        """Take whole turns out of the angles found last, so that the mean of each lies between -120 and 240 degrees."""
        for symbol, angle in self.turned:
            found = self.ledger.values[symbol]
            found = found[np.isfinite(found)]
            if not len(found):
                continue
            # The window leans to positive angles, as the text's tables do: a link that swings about 180 stays there.
            turns = math.ceil((math.degrees(float(found.mean())) - 240) / 360)
            if symbol in self.tied_angles:  # a gear reads its turns: they are counted from the first position
                turns = round(math.degrees(float(found[0])) / 360)
            if turns:
                self.ledger.replace_expression(symbol, (angle - Angle(degrees=360.0 * turns)).expression())
        self.turned.clear()

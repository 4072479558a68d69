"""Where the points of a mechanism are that is not solved (yet): as they were drawn.

A drawing that is not finished stands in its text as well: the ground's points have their places, all others are sketched
under [assembly]. What the sketch leaves out follows from the points of the same link.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from mechsheet.description.parts import Parts
from mechsheet.kinematics.points_in_link import number, number_points
from mechsheet.model import Joint, Link

Point = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Pose:
    """Where a link's frame lies in the ground's: its turn [rad] and its origin."""

    turn: float = 0.0
    x: float = 0.0
    y: float = 0.0

    def of(self, own: Point) -> Point:
        """A place of the link's frame in the ground's."""
        c, s = math.cos(self.turn), math.sin(self.turn)
        return self.x + own[0] * c - own[1] * s, self.y + own[0] * s + own[1] * c


def local_points(link: Link, numbers: Mapping[str, float]) -> dict[str, Point]:
    """The places of a link's points in its own frame; (nan, nan) where a fault hides them."""
    try:
        return number_points(link, numbers)
    except (KeyError, ArithmeticError, ValueError):
        return dict.fromkeys(link.points, (math.nan, math.nan))


def drawn_positions(parts: Parts, held: Mapping[str, Point]) -> dict[str, Point]:
    """A place for every point, in the ground's frame.

    held  where the page shows points now: for those that the sketch does not name
    """
    found: dict[str, Point] = {}
    if parts.links:
        found |= _finite(local_points(parts.links[0], parts.numbers))
    for point, place in parts.sketch.points.items():
        if point not in found:
            found |= _finite({point: (_number(place[0], parts), _number(place[1], parts))})
    known = [link for link in parts.links[1:] if link.points]
    for link in _best_known_first(known, found):
        _complete(link, parts, found, held)
    return found


def _finite(places: Mapping[str, Point]) -> dict[str, Point]:
    return {point: place for point, place in places.items() if all(map(math.isfinite, place))}


def _number(quantity: object, parts: Parts) -> float:
    try:
        return number(quantity, parts.numbers)  # type: ignore[arg-type]
    except (KeyError, ArithmeticError, ValueError):
        return math.nan


def _best_known_first(links: list[Link], found: Mapping[str, Point]) -> list[Link]:
    """Links whose points are mostly known come first: they decide about their neighbours."""
    return sorted(links, key=lambda link: -sum(point in found for point in link.points))


def _complete(link: Link, parts: Parts, found: dict[str, Point], held: Mapping[str, Point]) -> None:
    """Places for the points of a link that have none: as the link lies with those that have."""
    own = local_points(link, parts.numbers)
    missing = [point for point in link.points if point not in found]
    if not missing:
        return
    for point in missing:
        if point in held and all(map(math.isfinite, held[point])):
            found[point] = held[point]
    missing = [point for point in missing if point not in found]
    known = [point for point in link.points if point in found and all(map(math.isfinite, own[point]))]
    pose = placed([own[point] for point in known], [found[point] for point in known])
    for point in missing:
        found[point] = pose.of(own[point] if all(map(math.isfinite, own[point])) else (0.0, 0.0))


def placed(own: list[Point], there: list[Point]) -> Pose:
    """The pose that brings places of a link's frame nearest to places in the plane (least squares)."""
    if not own:
        return Pose()
    count = len(own)
    u, v = (sum(place[axis] for place in own) / count for axis in (0, 1))
    x, y = (sum(place[axis] for place in there) / count for axis in (0, 1))
    pairs = list(zip(own, there, strict=True))
    cross = sum((a[0] - u) * (b[1] - y) - (a[1] - v) * (b[0] - x) for a, b in pairs)
    along = sum((a[0] - u) * (b[0] - x) + (a[1] - v) * (b[1] - y) for a, b in pairs)
    return turned(math.atan2(cross, along) if cross or along else 0.0, (u, v), (x, y))


def turned(turn: float, own: Point, there: Point) -> Pose:
    """The pose with a turn that brings one place of the frame onto a place in the plane."""
    x, y = Pose(turn).of(own)
    return Pose(turn, there[0] - x, there[1] - y)


def drawn_pose(link: Link, parts: Parts, places: Mapping[str, Point]) -> Pose:
    """Where a link lies that is drawn by its points alone."""
    if link is parts.links[0]:
        return Pose()
    own = local_points(link, parts.numbers)
    names = [point for point in link.points if point in places and math.isfinite(own[point][0])]
    return placed([own[point] for point in names], [places[point] for point in names])


def drawn_poses(parts: Parts, places: Mapping[str, Point]) -> dict[str, Pose]:
    """Where all links lie that are drawn by their points; those with one point alone as their sliding joints turn them."""
    poses = {link.name: drawn_pose(link, parts, places) for link in parts.links}
    single = {link.name for link in parts.links[1:] if len(link.points) < 2}
    for joint in parts.joints:
        if joint.on in single and isinstance(joint.through, str) and {joint.through, joint.point} <= places.keys():
            (x, y), (u, v) = places[joint.through], places[joint.point]
            turn = math.atan2(v - y, u - x) - _number(joint.angle, parts)
            poses[joint.on] = _turned(poses[joint.on], turn, parts, joint.on, places)
    for joint in parts.joints:
        if joint.kind == "prismatic" and joint.link in single:
            turn = poses[joint.on].turn + _number(joint.angle, parts) + _number(joint.orientation, parts)
            poses[joint.link] = _turned(poses[joint.link], turn, parts, joint.link, places)
    return poses


def _turned(pose: Pose, turn: float, parts: Parts, name: str, places: Mapping[str, Point]) -> Pose:
    """The pose of a link of one point with another turn."""
    link = parts.link(name)
    if link is None or not math.isfinite(turn):
        return pose
    own = {point: place for point, place in local_points(link, parts.numbers).items() if point in places}
    return next((turned(turn, place, places[point]) for point, place in own.items()), Pose(turn, pose.x, pose.y))


def line_of(joint: Joint, on: Pose, numbers: Mapping[str, float]) -> tuple[Point | None, float]:
    """A place of a sliding joint's line (None: a point with a name) and its direction [rad], in the ground's frame.

    Raises ArithmeticError, KeyError or ValueError where its numbers have no value.
    """
    direction = on.turn + number(joint.angle, numbers)
    if isinstance(joint.through, str):
        return None, direction
    return on.of((number(joint.through[0], numbers), number(joint.through[1], numbers))), direction

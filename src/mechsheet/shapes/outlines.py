"""Where things stand on their links: the order of a polygon's corners, and places of a link as formulas."""

from __future__ import annotations

import math
from collections.abc import Mapping

from livesheet import portable
from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Node, Symbol
from mechsheet.kinematics.points_in_link import angle_of, cartesian, number_points
from mechsheet.model import Joint, Link, Mechanism


def corners(link: Link, dimensions: Mapping[str, float]) -> tuple[str, ...]:
    """The link's points in the order in which its outline passes them: around their middle."""
    if len(link.points) <= 3:
        return tuple(link.points)
    places = number_points(link, dimensions)
    x = math.fsum(place[0] for place in places.values()) / len(places)
    y = math.fsum(place[1] for place in places.values()) / len(places)
    return tuple(sorted(places, key=lambda point: portable.arctan2(places[point][1] - y, places[point][0] - x)))


def angle_of_link(mechanism: Mechanism, link: str) -> Angle:
    """The angle of a link's x axis; 0 for the ground."""
    if link == mechanism.ground.name:
        return Angle()
    return Angle(Symbol(next(found for found in mechanism.links if found.name == link).angle_symbol))


def direction_of(mechanism: Mechanism, joint: Joint) -> Node:
    """The direction of a sliding joint's line, from the ground's x axis."""
    return (angle_of_link(mechanism, joint.on) + angle_of(joint.angle)).expression()


def through_of(mechanism: Mechanism, joint: Joint) -> tuple[Node, Node]:
    """The point of `on` that the joint's line passes, in the ground's frame."""
    if isinstance(joint.through, str):
        return Symbol(f"{joint.through}.x"), Symbol(f"{joint.through}.y")
    place = cartesian(al.as_node(joint.through[0]), al.as_node(joint.through[1]))
    if joint.on == mechanism.ground.name:
        return place.u, place.v
    # back along the line from the point that is on it: the link need not have a point of its own
    direction = angle_of_link(mechanism, joint.on) + angle_of(joint.angle)
    s, x, y = Symbol(joint.symbol), Symbol(f"{joint.point}.x"), Symbol(f"{joint.point}.y")
    return al.sub(x, al.mul(s, al.cos(direction))), al.sub(y, al.mul(s, al.sin(direction)))


def line_end(joint: Joint, mechanism: Mechanism) -> str:
    """The point of `on` from which the joint's line is drawn."""
    if isinstance(joint.through, str):
        return joint.through
    return next(iter(next(link for link in mechanism.links if link.name == joint.on).points), "")


def block_has_line(mechanism: Mechanism, joint: Joint) -> bool:
    """True when the link with the point is drawn as a rod, and the line's link as the sleeve in which it slides."""
    sizes = {link.name: len(link.points) for link in mechanism.links}
    on_ground = mechanism.ground.name in (joint.on, joint.link)
    return joint.kind == "prismatic" and not on_ground and sizes[joint.link] >= max(2, sizes[joint.on])

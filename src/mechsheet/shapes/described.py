"""What the list of shapes asks of a mechanism and its equations.

Which points are drawn: pins, what moves, what leaves a path; where things stand on their links: the order of a polygon's
corners, and places of a link as formulas.
"""

from __future__ import annotations

import math
from collections.abc import Mapping

from livesheet import portable
from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Node, Symbol
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.points_in_link import angle_of, cartesian, number_points
from mechsheet.kinematics.rates.coefficients import free_points
from mechsheet.model import Joint, Link, Mechanism
from mechsheet.shapes.colors import link_color
from mechsheet.words.catalogue import words
from mechsheet.words.equations import link_words


class Described:
    """A mechanism, its equations, and what shapes ask of both."""

    def __init__(self, mechanism: Mechanism, equations: Equations) -> None:
        self.mechanism, self.equations = mechanism, equations
        self.dimensions = dimension_values(mechanism)
        self.links = {link.name: link for link in mechanism.links}
        self.driven = mechanism.driven_link
        self.pins = pins_of(mechanism)

    @property
    def ground(self) -> Link:
        """The fixed link."""
        return self.mechanism.ground

    def text(self, key: str, **parts: object) -> str:
        """A word of the drawing in the mechanism's language."""
        return words(self.mechanism.language, key, **parts)

    def called(self, link: Link) -> str:
        """What people call a link."""
        return link_words(link).of(self.mechanism.language)

    def color(self, link: str) -> str:
        """The colour of a link."""
        return link_color(self.links[link], self.driven)


# --- which points are drawn -------------------------------------------------------------------------------------------


def moving_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Points of moving links that are not fixed, in the order of the description."""
    names = dict.fromkeys(point for link in mechanism.links[1:] for point in link.points)
    return tuple(point for point in names if point not in mechanism.ground.points)


def pins_of(mechanism: Mechanism) -> tuple[str, ...]:
    """Points with a revolute joint: shared by links, or gliding in the slot of a link."""
    count: dict[str, int] = {}
    for link in mechanism.links:
        for point in link.points:
            count[point] = count.get(point, 0) + 1
    slots = {joint.point for joint in mechanism.joints if joint.kind == "pin-slot"}
    return tuple(point for point, links in count.items() if links > 1 or point in slots)


def points_with_rates(mechanism: Mechanism, equations: Equations) -> tuple[str, ...]:
    """Points that have a velocity and an acceleration."""
    points = {point for link in mechanism.links for point in link.points}
    found = (column.symbol.rpartition(".") for column in equations.columns if column.role == "rate")
    return tuple(point for point, _, part in found if part == "v" and point in points)


# --- paths -----------------------------------------------------------------------------------------------------------


def tracing_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Points of a single moving link (coupler points); without any, the moving joints."""
    points = dict.fromkeys(point for link in mechanism.links for point in link.points)
    return free_points(mechanism) or tuple(point for point in points if point not in mechanism.ground.points)


def remarkable_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Traced points whose paths are neither circles about a fixed pin nor straight guides."""
    fixed = set(mechanism.ground.points)
    plain_paths = {joint.point for joint in mechanism.joints if mechanism.ground.name == joint.on}
    guided = {each.link for each in mechanism.joints if each.kind == "prismatic" and each.on == mechanism.ground.name}
    for link in mechanism.links[1:]:
        if fixed & set(link.points) or link.name in guided:
            plain_paths |= set(link.points)
    return tuple(point for point in tracing_points(mechanism) if point not in plain_paths)


def traced_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Points whose paths are drawn behind the mechanism: those that have a chart, else those that deserve one."""
    asked = dict.fromkeys(point for chart in mechanism.charts for point in chart.paths)
    if not asked and not mechanism.charts:
        asked = dict.fromkeys(remarkable_points(mechanism))
    return tuple(asked) or tracing_points(mechanism)


# --- where things stand on their links --------------------------------------------------------------------------------


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
    return Angle(Symbol(mechanism.link(link).angle_symbol))


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
    return next(iter(mechanism.link(joint.on).points), "")


def block_has_line(mechanism: Mechanism, joint: Joint) -> bool:
    """True when the link with the point is drawn as a rod, and the line's link as the sleeve in which it slides."""
    sizes = {link.name: len(link.points) for link in mechanism.links}
    on_ground = mechanism.ground.name in (joint.on, joint.link)
    return joint.kind == "prismatic" and not on_ground and sizes[joint.link] >= max(2, sizes[joint.on])

"""What acts on a mechanism, as shapes: springs and dampers, forces, torques, weights; and velocities and joint forces.

All forces have one scale, so that what is drawn longer is larger: external forces, weights and, where they are asked
for, the forces of joints.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from livesheet.formula.vectors import NOWHERE, Vector, minus, plus, size, times, together, turned
from mechsheet.kinematics.equations import JOINT_FORCES
from mechsheet.kinematics.numeric import Array, value
from mechsheet.kinematics.points_in_link import angle_of, cartesian, polar
from mechsheet.model import (
    Cartesian,
    Distances,
    Dynamics,
    GivenPoint,
    Link,
    Load,
    Mass,
    Mechanism,
    Polar,
    Spring,
    center_symbol,
    pair_symbol,
    torque_unit,
)
from mechsheet.shapes.colors import ACCELERATION, FORCE, INK, SPRING, VELOCITY
from mechsheet.shapes.described import Described, direction_of, points_with_rates
from mechsheet.shapes.forms import (
    ARROW_HEAD,
    BOW,
    BOW_HEAD,
    COIL,
    HALF,
    LEAST,
    QUARTERS,
    ROUND,
    SHAFT,
    Frame,
    Kind,
    Name,
    Scale,
    Shape,
    Shapes,
    along,
    place_of,
    shown,
    sized,
    telescope,
    unit,
)
from mechsheet.words.symbols import plain

LONGEST = 0.36
"""How long the longest arrow of a kind is, in half windows."""

HEAD = 0.05
"""How long the tip of an arrow is, in half windows."""

NARROWEST, WIDEST = 0.05, 0.12
"""Radii of the round arrows of torques, of the least and of the largest, in half windows."""

CENTRE = 0.022
"""Radius of the mark of a mass centre, in half windows."""

COIL_ASIDE, DAMPER_BORE = 0.045, 0.014
"""Half the widths of a spring and of a damper, in half windows."""

COLORS: dict[Kind, str] = {"velocity": VELOCITY, "acceleration": ACCELERATION, "force": FORCE}


@dataclass(frozen=True, slots=True)
class Force:
    """A force that is drawn: as what, under which name, where, its components, and its size."""

    kind: Kind
    name: str
    text: str
    at: Vector
    parts: Vector
    strength: Node


VECTORS: tuple[Kind, ...] = ("velocity", "acceleration", "force")
"""Kinds of arrows that are drawn where they are asked for; forces are those of joints."""


def acting(known: Described, found: Shapes, vectors: Collection[Kind]) -> tuple[list[Shape], list[Shape]]:
    """Springs and dampers; and what lies on all else: marks of mass centres, arrows. Their names are written down."""
    dynamics = known.mechanism.dynamics
    behind: list[Shape] = []
    before: list[Shape] = []
    forces: list[Force] = []
    if dynamics is not None:
        for spring in dynamics.springs:
            behind += _spring(known, found, spring)
        for mass in dynamics.masses:
            if mass.mass is not None:
                before += _centre(known, found, mass)
                if not all(map(al.is_zero, dynamics.gravity)):
                    forces.append(_weight(known, dynamics, mass))
        forces += [_load(known, load) for load in dynamics.loads if load.force is not None]
        before += _torques(known, found, dynamics)
    rates: tuple[tuple[Kind, str], ...] = (("velocity", "/s"), ("acceleration", "/s²"))
    for kind, per in rates:
        if kind in vectors:
            before += _of_points(known, found, kind, f"{known.mechanism.length_unit}{per}")
    before += _forces(known, found, forces, list(_joint_forces(known)) if "force" in vectors else [])
    return behind, before


def first_shown(mechanism: Mechanism, closed: NDArray[np.bool_], values: Mapping[str, Array]) -> int:
    """The first of all positions in which every load acts that acts in any: a machine tool is shown as it cuts.

    Without such a one the first that there is, and without any the first row.
    """
    acts = closed.copy()
    for load in mechanism.dynamics.loads if mechanism.dynamics is not None else ():
        parts = load.force or (load.torque or al.ZERO,)
        with np.errstate(all="ignore"):
            strength = sum(np.abs(value(part, values, rooted=True)) for part in parts) + np.zeros(len(closed))
            there = strength[closed & np.isfinite(strength)]
            if len(there) and there.max() > 0:
                acts &= strength >= LEAST * there.max()
    return int(np.argmax(acts if acts.any() else closed))


def loaded_points(known: Described) -> tuple[str, ...]:
    """Points of the ground at which springs are held."""
    dynamics = known.mechanism.dynamics
    ends = [end for spring in dynamics.springs for end in spring.ends] if dynamics is not None else []
    return tuple(dict.fromkeys(point for _, point in ends if point in known.ground.points))


def _place(known: Described, link: Link, given: str | GivenPoint) -> Vector:
    """A point of a link, or a place in its frame."""
    if isinstance(given, str):
        return place_of(given or next(iter(link.points)))
    pose = known.equations.poses[link.name]
    ahead = along(pose.angle)
    u, v = _in_link(known, link, given)
    return together([(pose.x, pose.y), times(u, ahead), times(v, turned(ahead))])


def _in_link(known: Described, link: Link, given: GivenPoint) -> Vector:
    """A place in the frame of its link."""
    match given:
        case Cartesian(x, y):
            place = cartesian(al.as_node(x), al.as_node(y))
        case Polar(r, angle):
            place = polar(al.as_node(r), angle_of(angle))
        case Distances():
            return _by_distances(known, link, given)
    return place.u, place.v


def _by_distances(known: Described, link: Link, given: Distances) -> Vector:
    """Where two circles about points of the link meet: along the line from one to the other, and then across it."""
    places = known.equations.poses[link.name].places
    way = minus(places[given.second], places[given.first])
    b, c = al.as_node(given.first_distance), al.as_node(given.second_distance)
    length = size(way)
    reach = al.div(al.sub(al.add(al.square(b), al.square(length)), al.square(c)), al.mul(al.TWO, length))
    aside = al.sqrt(al.call("MAX", al.ZERO, al.sub(al.square(b), al.square(reach))))
    across = al.neg(aside) if given.side == "right" else aside
    return together([places[given.first], times(reach, unit(way)), times(across, turned(unit(way)))])


# --- springs ---------------------------------------------------------------------------------------------------------


def _spring(known: Described, found: Shapes, spring: Spring) -> Iterator[Shape]:
    """A coil that stretches from end to end, and in it the damper."""
    ends = place_of(spring.ends[0][1]), place_of(spring.ends[1][1])
    name = plain(spring.name)
    way = minus(ends[1], ends[0])
    if not al.is_zero(spring.damping):
        called = known.text("picture.damper", name=name)
        yield from telescope(found, "damper", called, ends, (SPRING, SPRING), DAMPER_BORE)
    if not al.is_zero(spring.stiffness):
        frame = Frame(ends[0], way, times(sized(COIL_ASIDE), turned(unit(way))))
        yield Shape("spring", known.text("picture.spring", name=name), SPRING, 1.25, frame, COIL)
    middle, unit_ = plus(ends[0], times(al.number(0.5), way)), known.mechanism.length_unit
    found.names.append(Name(name, middle, size(way), unit_, beside=COIL_ASIDE))


# --- masses ----------------------------------------------------------------------------------------------------------


def _centre(known: Described, found: Shapes, mass: Mass) -> Iterator[Shape]:
    """The mark of a mass centre; its name, where it is no point with a name of its own."""
    link = known.links[mass.link]
    at = _place(known, link, mass.center)
    name = known.text("picture.mass_centre", link=known.called(link))
    frame = Frame(at, (sized(CENTRE), al.ZERO), (al.ZERO, sized(CENTRE)))
    yield Shape("mass", name, INK, 0.75, frame, ROUND, fill="FFFFFF")
    yield Shape("mass", name, INK, 0.0, frame, QUARTERS, fill=INK)
    found.around.append((at, al.ZERO))
    if not isinstance(mass.center, str):
        found.names.append(Name(plain(center_symbol(link.number)), at))


def _weight(known: Described, dynamics: Dynamics, mass: Mass) -> Force:
    """The weight of a link."""
    link = known.links[mass.link]
    name = known.text("picture.weight", link=known.called(link))
    weight = times(mass.mass or al.ZERO, dynamics.gravity)
    return Force("weight", name, "", _place(known, link, mass.center), weight, size(weight))


# --- forces and torques ----------------------------------------------------------------------------------------------


def _load(known: Described, load: Load) -> Force:
    """An external force, in the ground's frame."""
    link = known.links[load.link]
    parts = load.force or (al.ZERO, al.ZERO)
    if load.in_link:
        ahead = along(known.equations.poses[link.name].angle)
        parts = plus(times(parts[0], ahead), times(parts[1], turned(ahead)))
    name = known.text("picture.load", name=plain(load.name))
    return Force("load", name, plain(load.name), _place(known, link, load.point), parts, size(load.force or parts))


def _torques(known: Described, found: Shapes, dynamics: Dynamics) -> Iterator[Shape]:
    """Round arrows about the pivots of the links, on the side away from the link."""
    loads = [(load, load.torque) for load in dynamics.loads if load.torque is not None]
    if not loads:
        return
    most = found.extreme("max", *(al.call("ABS", torque) for _, torque in loads))
    units = torque_unit(dynamics.force_unit, dynamics.metre, known.mechanism.length_unit)
    for load, torque in loads:
        middle, away = _turning(known, known.links[load.link])
        part = al.div(torque, most)
        strength = al.call("ABS", part)
        radius = al.mul(HALF, al.add(al.number(NARROWEST), al.mul(al.number(WIDEST - NARROWEST), strength)))
        frame = Frame(middle, times(radius, away), times(al.mul(al.call("SIGN", part), radius), turned(away)))
        name = known.text("picture.load", name=plain(load.name))
        yield Shape("torque", name, FORCE, 1.75, frame, BOW, size=strength)
        yield Shape("torque", name, FORCE, 0.5, frame, BOW_HEAD, fill=FORCE, size=strength)
        at = plus(middle, times(radius, away))
        found.names.append(Name(plain(load.name), at, torque, units, strength))


def _turning(known: Described, link: Link) -> tuple[Vector, Vector]:
    """About what a torque on a link is drawn, a fixed pin before its middle, and in which direction nothing of it lies."""
    places = [place_of(point) for point in link.points]
    pivot = next((point for point in link.points if point in known.ground.points), "")
    others = [place_of(point) for point in link.points if point != pivot]
    middle = times(al.number(1 / max(1, len(others))), together(others))
    if pivot and others:
        return place_of(pivot), unit(minus(place_of(pivot), middle))
    return (middle if others else places[0]), (al.ZERO, al.ONE)


def _of_points(known: Described, found: Shapes, kind: Kind, units: str) -> Iterator[Shape]:
    """The velocities or accelerations of the points that have any, by their derivatives."""
    omega, alpha = map(Symbol, known.mechanism.driver_rates)

    def part(place: str) -> Node:
        once, twice = Symbol(f"{place}.d"), Symbol(f"{place}.dd")
        if kind == "velocity":
            return al.mul(once, omega)
        return al.add(al.mul(twice, al.square(omega)), al.mul(once, alpha))

    arrows = []
    for point in points_with_rates(known.mechanism, known.equations):
        symbol = f"{point}.{kind[0]}"
        parts = part(f"{point}.x"), part(f"{point}.y")
        arrows.append(Force(kind, plain(symbol), plain(symbol), place_of(point), parts, Symbol(symbol)))
    if arrows:
        most = found.extreme("max", *(each.strength for each in arrows))
        found.scales.append(Scale(kind, most, LONGEST, units, COLORS[kind], shown(kind)))
        for arrow in arrows:
            yield from _arrow(found, arrow, kind, most)


def _forces(known: Described, found: Shapes, loads: Sequence[Force], joints: Sequence[Force]) -> Iterator[Shape]:
    """External forces and weights, and those of joints, on one scale."""
    dynamics = known.mechanism.dynamics
    units = dynamics.force_unit if dynamics is not None else ""
    mosts: list[Node] = []
    if loads:
        mosts.append(found.extreme("max", *(each.strength for each in loads)))
    if joints:
        mosts.append(al.mul(shown("force"), found.extreme("max", *(each.strength for each in joints))))
    most = al.largest(mosts) if mosts else al.ZERO
    if joints:
        found.scales.append(Scale("force", most, LONGEST, units, COLORS["force"], shown("force")))
    for force in (*loads, *joints):
        yield from _arrow(found, force, "force", most, units)


def _arrow(found: Shapes, force: Force, kind: Kind, most: Node, units: str = "") -> Iterator[Shape]:
    """A straight arrow, of the scale of a kind; where its size has a unit, it is written beside an external force."""
    part = al.div(force.strength, most)
    if force.kind in VECTORS:
        part = al.mul(shown(kind), part)
    way = times(al.div(al.mul(al.number(LONGEST), HALF), most), force.parts)
    tip, ahead = plus(force.at, way), times(al.div(sized(HEAD), force.strength), force.parts)
    shaft, head = Frame(force.at, way, NOWHERE), Frame(tip, ahead, turned(ahead))
    yield Shape(force.kind, force.name, COLORS[kind], 1.75, shaft, SHAFT, size=part)
    yield Shape(force.kind, force.name, COLORS[kind], 0.5, head, ARROW_HEAD, fill=COLORS[kind], size=part)
    if force.text:
        found.names.append(Name(force.text, tip, force.strength if force.kind == "load" else None, units, part))


def _joint_forces(known: Described) -> Iterator[Force]:
    """At a pin the force of its first link on each other one, at a slide the normal force on its link."""
    mechanism = known.mechanism
    pins = points_of_forces(mechanism)
    slides = {f"{pair_of(mechanism, joint.on, joint.link)}.n": joint for joint in mechanism.joints}
    columns = {column.symbol for column in known.equations.columns}
    for name in known.equations.forces(*JOINT_FORCES):
        if name not in columns:
            continue
        if name in pins:
            yield Force("force", plain(name), plain(name), place_of(pins[name]), place_of(name), Symbol(name))
        elif name in slides:  # of teeth the place is no point of the drawing
            parts = times(Symbol(name), turned(along(direction_of(mechanism, slides[name]))))
            strength = al.call("ABS", Symbol(name))
            yield Force("force", plain(name), plain(name), place_of(slides[name].point), parts, strength)


def points_of_forces(mechanism: Mechanism) -> dict[str, str]:
    """The point at which each joint force acts, by its symbol."""
    at: dict[str, list[str]] = {}
    for link in mechanism.links:
        for point in link.points:
            at.setdefault(point, []).append(link.name)
    return {pair_of(mechanism, owner, other): point for point, (owner, *others) in at.items() for other in others}


def pair_of(mechanism: Mechanism, one: str, other: str) -> str:
    """The symbol of the force of one link on another."""
    numbers = {link.name: link.number for link in mechanism.links}
    return pair_symbol("F", numbers[one], numbers[other])

"""What acts on a mechanism, as shapes: springs and dampers, forces, torques, weights; and velocities and joint forces.

All forces have one scale, so that what is drawn longer is larger: external forces, weights and, where they are asked
for, the forces of joints.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from mechsheet.kinematics.vectors import NOWHERE, Vector, minus, plus, size, times, together, turned
from mechsheet.model import Dynamics, Link, Load, Mass, Spring, center_symbol, torque_unit
from mechsheet.model import Place as GivenPlace
from mechsheet.shapes.described import Described
from mechsheet.shapes.forms import (
    ARROW_HEAD,
    BOW,
    BOW_HEAD,
    COIL,
    HALF,
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
    sized,
    telescope,
    unit,
)
from mechsheet.sheet.checks.geometry import place
from mechsheet.sheet.drawing.arrows import pair_of, points_of_forces
from mechsheet.sheet.drawing.frames import INK
from mechsheet.sheet.drawing.outlines import direction_of
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.symbols import plain
from mechsheet.words import pictures

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

FORCE_COLOR, SPRING_COLOR = "E6007E", "546E7A"
"""No link has these colours."""

COLORS: dict[Kind, str] = {"velocity": "0070C0", "acceleration": "C00000", "force": FORCE_COLOR}


@dataclass(frozen=True, slots=True)
class Force:
    """A force that is drawn: as what, under which name, where, and its components."""

    kind: Kind
    name: str
    text: str
    at: Vector
    parts: Vector


VECTORS: tuple[Kind, ...] = ("velocity", "acceleration", "force")
"""Kinds of arrows that are drawn where they are asked for; forces are those of joints."""


def acting(known: Described, found: Shapes, plan: Plan, vectors: Collection[Kind]) -> tuple[list[Shape], list[Shape]]:
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
    force_unit = dynamics.force_unit if dynamics is not None else ""
    rates: tuple[tuple[Kind, str], ...] = (("velocity", "/s"), ("acceleration", "/s²"))
    for kind, per in rates:
        if kind in vectors:
            arrows = _of_points(known, plan, kind)
            before += _arrows(found, arrows, kind, f"{known.mechanism.length_unit}{per}", bar=True)
    if "force" in vectors:
        forces += _joint_forces(known, plan)
    before += _arrows(found, forces, "force", force_unit, bar="force" in vectors)
    return behind, before


def loaded_points(known: Described) -> tuple[str, ...]:
    """Points of the ground at which springs are held."""
    dynamics = known.mechanism.dynamics
    ends = [end for spring in dynamics.springs for end in spring.ends] if dynamics is not None else []
    return tuple(dict.fromkeys(point for _, point in ends if point in known.ground.points))


def _place(known: Described, link: Link, given: str | GivenPlace) -> Vector:
    """A point of a link, or a place in its frame."""
    if isinstance(given, str):
        return place_of(given or next(iter(link.points)))
    u, v = place(Link(link.name, link.number, {**link.points, "#": given}), "#")
    pose = known.equations.poses[link.name]
    ahead = along(pose.angle)
    return together([(pose.x, pose.y), times(u, ahead), times(v, turned(ahead))])


# --- springs ---------------------------------------------------------------------------------------------------------


def _spring(known: Described, found: Shapes, spring: Spring) -> Iterator[Shape]:
    """A coil that stretches from end to end, and in it the damper."""
    ends = place_of(spring.ends[0][1]), place_of(spring.ends[1][1])
    language, name = known.mechanism.language, plain(spring.name)
    way = minus(ends[1], ends[0])
    if not al.is_zero(spring.damping):
        called = pictures.DAMPER.of(language).format(name=name)
        yield from telescope(found, "damper", called, ends, (SPRING_COLOR, SPRING_COLOR), DAMPER_BORE)
    if not al.is_zero(spring.stiffness):
        frame = Frame(ends[0], way, times(sized(COIL_ASIDE), turned(unit(way))))
        yield Shape("spring", pictures.SPRING.of(language).format(name=name), SPRING_COLOR, 1.5, frame, COIL)
    found.names.append(Name(name, plus(ends[0], times(al.number(0.5), way)), beside=COIL_ASIDE))


# --- masses ----------------------------------------------------------------------------------------------------------


def _centre(known: Described, found: Shapes, mass: Mass) -> Iterator[Shape]:
    """The mark of a mass centre; its name, where it is no point with a name of its own."""
    link = known.links[mass.link]
    at = _place(known, link, mass.center)
    name = pictures.MASS_CENTRE.of(known.mechanism.language).format(link=known.called(link))
    frame = Frame(at, (sized(CENTRE), al.ZERO), (al.ZERO, sized(CENTRE)))
    yield Shape("mass", name, INK, 0.75, frame, ROUND, fill="FFFFFF")
    yield Shape("mass", name, INK, 0.0, frame, QUARTERS, fill=INK)
    found.around.append((at, al.ZERO))
    if not isinstance(mass.center, str):
        found.names.append(Name(plain(center_symbol(link.number)), at))


def _weight(known: Described, dynamics: Dynamics, mass: Mass) -> Force:
    """The weight of a link."""
    link = known.links[mass.link]
    name = pictures.WEIGHT.of(known.mechanism.language).format(link=known.called(link))
    weight = times(mass.mass or al.ZERO, dynamics.gravity)
    return Force("weight", name, "", _place(known, link, mass.center), weight)


# --- forces and torques ----------------------------------------------------------------------------------------------


def _load(known: Described, load: Load) -> Force:
    """An external force, in the ground's frame."""
    link = known.links[load.link]
    parts = load.force or (al.ZERO, al.ZERO)
    if load.in_link:
        ahead = along(known.equations.poses[link.name].angle)
        parts = plus(times(parts[0], ahead), times(parts[1], turned(ahead)))
    name = pictures.LOAD.of(known.mechanism.language).format(name=plain(load.name))
    return Force("load", name, plain(load.name), _place(known, link, load.point), parts)


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
        radius = formula(
            "half*(least+more*strength)", half=HALF, least=NARROWEST, more=WIDEST - NARROWEST, strength=strength
        )
        frame = Frame(middle, times(radius, away), times(al.mul(al.call("SIGN", part), radius), turned(away)))
        name = pictures.LOAD.of(known.mechanism.language).format(name=plain(load.name))
        yield Shape("torque", name, FORCE_COLOR, 1.75, frame, BOW, size=strength)
        yield Shape("torque", name, FORCE_COLOR, 0.5, frame, BOW_HEAD, fill=FORCE_COLOR, size=strength)
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


def _of_points(known: Described, plan: Plan, kind: Kind) -> list[Force]:
    """The velocities or accelerations of the points that have any, by their derivatives."""
    omega, alpha = map(Symbol, known.mechanism.driver_rates)

    def part(place: str) -> Node:
        once, twice = Symbol(f"{place}.d"), Symbol(f"{place}.dd")
        if kind == "velocity":
            return al.mul(once, omega)
        return formula("twice*omega^2+once*alpha", twice=twice, once=once, omega=omega, alpha=alpha)

    return [
        Force(kind, plain(f"{point}.{kind[0]}"), plain(f"{point}.{kind[0]}"), place_of(point),
              (part(f"{point}.x"), part(f"{point}.y")))
        for point in plan.moving_points
    ]  # fmt: skip


def _joint_forces(known: Described, plan: Plan) -> Iterator[Force]:
    """At a pin the force of its first link on each other one, at a slide the normal force on its link."""
    mechanism = known.mechanism
    pins = points_of_forces(mechanism)
    slides = {f"{pair_of(mechanism, joint.on, joint.link)}.n": joint for joint in mechanism.joints}
    for name in plan.held_columns:
        if name in pins:
            yield Force("force", plain(name), plain(name), place_of(pins[name]), place_of(name))
        elif name in slides:  # of teeth the place is no point of the drawing
            across = turned(along(direction_of(mechanism, slides[name])))
            yield Force("force", plain(name), plain(name), place_of(slides[name].point), times(Symbol(name), across))


def _arrows(found: Shapes, forces: Sequence[Force], kind: Kind, units: str, bar: bool) -> Iterator[Shape]:
    """Straight arrows of one scale; with their values, where no scale bar says how large they are."""
    if not forces:
        return
    most = found.extreme("max", *(size(force.parts) for force in forces))
    if bar:
        found.scales.append(Scale(kind, most, LONGEST, units, COLORS[kind]))
    for force in forces:
        strength = size(force.parts)
        part = al.div(strength, most)
        way = times(formula("longest*half/most", longest=LONGEST, half=HALF, most=most), force.parts)
        tip, ahead = plus(force.at, way), times(sized(HEAD), unit(force.parts))
        shaft, head = Frame(force.at, way, NOWHERE), Frame(tip, ahead, turned(ahead))
        yield Shape(force.kind, force.name, COLORS[kind], 1.75, shaft, SHAFT, size=part)
        yield Shape(force.kind, force.name, COLORS[kind], 0.5, head, ARROW_HEAD, fill=COLORS[kind], size=part)
        if force.text:
            found.names.append(Name(force.text, tip, None if bar else strength, units, part))

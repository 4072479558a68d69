"""What a cam looks like: its profile, pitch curve and base circle, which turn with it, and what touches it."""

from __future__ import annotations

from collections.abc import Iterator

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from livesheet.formula.vectors import Vector, minus, plus, size, times, turned
from mechsheet.model import Cam
from mechsheet.shapes.colors import INK
from mechsheet.shapes.described import Described
from mechsheet.shapes.forms import CIRCLE, PAD, Frame, Shape, Shapes, along, place_of, sized, unit

PALE = "A0A8B0"
PRESSED = 0.35
"""How far the line along which the cam presses is drawn, in half windows."""


def cam_shapes(known: Described, found: Shapes) -> Iterator[Shape]:
    """All of it, the profile last; nothing where there is no cam."""
    cam = known.mechanism.cam
    if cam is None:
        return
    center, color = place_of(cam.center), known.color(cam.link)
    out = along(Symbol(known.links[cam.link].angle_symbol))
    frame = Frame(center, out, turned(out))
    base = al.as_node(cam.base_radius)
    yield Shape("cam", known.text("drawing.cam.base"), PALE, 0.75, _about(center, base), CIRCLE)
    if cam.radius is not None:
        yield Shape("cam", known.text("drawing.cam.pitch"), PALE, 0.75, frame, corners=(place_of("pitch"),))
    yield Shape("cam", known.called(known.links[cam.link]), color, 2.5, frame, corners=(place_of("cam"),))
    found.around.append((center, size(place_of("cam"))))
    yield from _roller(known, cam, center, out) if cam.radius is not None else _face(known, cam, found)


def _about(center: Vector, radius: Node) -> Frame:
    return Frame(center, (radius, al.ZERO), (al.ZERO, radius))


def _roller(known: Described, cam: Cam, center: Vector, out: Vector) -> Iterator[Shape]:
    """The roller, and the line along which the cam presses; a knife edge has neither."""
    radius, at = al.as_node(cam.radius or 0.0), place_of(cam.point)
    if al.is_zero(radius):
        return
    yield Shape("cam", known.text("drawing.cam.roller"), INK, 1.25, _about(at, radius), CIRCLE)
    x, y = place_of("cam")
    touched = plus(center, plus(times(x, out), times(y, turned(out))))
    end = plus(touched, times(sized(PRESSED), unit(minus(at, touched))))
    yield Shape("cam", known.text("drawing.cam.line"), PALE, 1.0, corners=(touched, end))


def _face(known: Described, cam: Cam, found: Shapes) -> Iterator[Shape]:
    """The face, as long as it is touched and a little more."""
    angle = al.add(Symbol(known.links[cam.follower].angle_symbol), al.as_node(cam.face))
    way, at, contact = along(angle), place_of(cam.point), Symbol("contact")
    least, most = found.extreme("min", contact), found.extreme("max", contact)
    ends = (al.sub(least, sized(PAD)), al.add(most, sized(PAD)))
    places = tuple(plus(at, times(end, way)) for end in ends)
    yield Shape("cam", known.text("drawing.cam.face"), known.color(cam.follower), 2.5, corners=places)

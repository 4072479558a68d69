"""Cams as data: the segments of a motion over the cam's angle, and the roller or face that a cam's profile is made for."""

from __future__ import annotations

import math
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Number

from .symbols import Quantity

SEGMENT_LAWS = (
    "dwell", "uniform", "parabolic", "harmonic", "cycloidal", "3-4-5", "4-5-6-7", "modified trapezoid", "modified sine",
)  # fmt: skip
"""Names of the laws by which a follower goes from one height to the next."""

LAWS_THAT_LEAP = {"uniform": 1, "parabolic": 2, "harmonic": 2}
"""The order of the derivative that leaps where such a segment begins or ends: velocity, acceleration."""

CONTACT = "N"
"""The force with which a cam presses on its follower."""

BASE = "base"
"""The radius of the base circle with which the pressure angle would be just the usual one, row by row."""

TAU, WAVE, HALF, PIECE = "tau", "w", "half", "piece"
"""Stand in a law for the part of the segment that has been passed; and in one that is made of pieces for 4 pi times that
part, counted from the nearer end, 1 in the second half, and the number of the piece."""


MEETING = 1e-9
"""So far [rad] behind the angle where two segments meet the earlier one still counts: rounding decides nothing."""

EIGHTH, MOST_RISING = 0.125, 0.375
"""Parts of a segment at which the pieces of a modified law meet."""

INNER_SEAMS = {
    "parabolic": (0.5,),
    "harmonic": (0.5,),
    "cycloidal": (0.25, 0.5, 0.75),
    "3-4-5": ((3 - math.sqrt(3)) / 6, 0.5, (3 + math.sqrt(3)) / 6),
    "4-5-6-7": ((5 - math.sqrt(5)) / 10, 0.5, (5 + math.sqrt(5)) / 10),
    "modified trapezoid": (EIGHTH, MOST_RISING, 0.5, 1 - MOST_RISING, 1 - EIGHTH),
    "modified sine": (EIGHTH, 0.5, 1 - EIGHTH),
}
"""Parts of a segment at which the pieces of its law meet, or its velocity or acceleration are extreme: of a segment narrower
than a row the rows show neither."""

BEHIND = 1e-7
"""So far [rad] behind a seam the later piece is asked: beyond `MEETING`, which laws count in parts of a segment, too."""


@dataclass(frozen=True, slots=True)
class Segment:
    """A part of the motion, over the cam's angle.

    law     one of `SEGMENT_LAWS`
    begins, over  at which angle of the cam, and over how much of it [rad], over dimensions
    lift, by  how far from the start it begins, and how far it goes
    way     f, f', f'', f''' over these
    """

    law: str
    begins: Node
    over: Node
    lift: Node
    by: Node
    way: tuple[Node, Node, Node, Node]


@dataclass(frozen=True, slots=True)
class Segments:
    """The motion of a follower over one turn of its cam.

    start   where it is at angle 0
    parts   one after another
    closed  whether it comes back and goes on with every turn; else it stays where it ends
    """

    start: Node
    parts: tuple[Segment, ...]
    closed: bool = True

    @property
    def seams(self) -> tuple[Node, ...]:
        """Angles at which pieces of the motion meet, where what follows from it may be extreme without turning back; and
        those at which laws have their largest velocities and accelerations.

        Of two segments, and where the acceleration leaps within one, the last of the earlier piece and the first of the
        later.
        """
        found: list[Node] = [al.ZERO]
        for place, part in enumerate(self.parts):
            found += _both_sides(part.begins) if place else []
            for share in INNER_SEAMS.get(part.law, ()):
                angle = al.add(part.begins, al.mul(Number(share), part.over))
                found += _both_sides(angle) if part.law == "parabolic" else [angle]
        last = self.parts[-1]
        end = al.add(last.begins, last.over)
        return tuple(dict.fromkeys([*found, al.sub(Number(math.tau), Number(BEHIND)) if self.closed else end]))


def _both_sides(angle: Node) -> list[Node]:
    return [angle, al.add(angle, Number(BEHIND))]


@dataclass(frozen=True, slots=True)
class Cam:
    """A cam: the link that turns with the driver, and what its profile touches.

    link         its name;  center: the point of the ground about which it turns
    clockwise    whether it turns so while its angle grows
    base_radius  of the base circle, over dimensions
    point        the roller's centre, or a point of the face
    pressure_angle  up to which followers are said to run well [rad]
    radius       of the roller; None for a flat face
    follower     the link with the face, "" for a roller;  face: direction of the face against its x axis [rad]
    decides_start  whether the base circle says where the follower starts
    offset       by how much a roller's slide passes the centre, where the base circle decides its start; else None
    touches      what is below 0 where the roller of a follower that starts on the base circle never touches it; else None
    """

    link: str
    center: str
    clockwise: bool
    base_radius: Quantity
    point: str
    pressure_angle: Quantity
    radius: Quantity | None = None
    follower: str = ""
    face: Quantity = 0.0
    decides_start: bool = False
    offset: Quantity | None = None
    touches: Node | None = None

    @property
    def symbols(self) -> tuple[str, ...]:
        """What its columns are called: pitch curve, profile, curvature, pressure angle, radius of curvature, contact, base
        circle."""
        own = ("contact",) if self.radius is None else ("pitch.x", "pitch.y", "kappa")
        base = () if self.offset is None else (BASE,)
        return (*own, *base, "cam.x", "cam.y", "alpha", "rho")

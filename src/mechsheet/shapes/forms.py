"""What the list of shapes consists of: kinds, forms in a frame of their own, shapes, names."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from livesheet import portable
from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from livesheet.formula.vectors import Vector, minus, plus, size, times, turned
from mechsheet.shapes.colors import pale

Kind: TypeAlias = Literal[
    "link", "ground", "slide", "cylinder", "gear", "belt", "rack", "cam", "spring", "damper", "load", "torque", "weight",
    "mass", "path", "pin", "point", "velocity", "acceleration", "force", "scale", "name", "caption",
]  # fmt: skip
ARROWS = ("load", "torque", "weight", "velocity", "acceleration", "force")
"""Kinds whose size says how large something is."""

HALF = Symbol("#half")
"""Half the side of the window, in the length unit: symbols are so many of it large, whatever the mechanism's dimensions."""

PAD = 0.1
"""How far a guide reaches beyond the stroke, in half windows: a little more than half a block's length."""

PLATE, BORDER = 10.0, 1.25
"""How wide a link is drawn, and the border of it [points]."""

LEAST = 0.1
"""Of what is less than this part of the largest of its kind no arrow is drawn: it would be all tip."""

Path: TypeAlias = tuple[tuple[float, float], ...]


@dataclass(frozen=True, slots=True)
class Frame:
    """Where a form stands: its corner (a, b) lies at  origin + a along + b across."""

    origin: Vector
    along: Vector
    across: Vector


@dataclass(frozen=True, slots=True)
class Shape:
    """A line through corners: `path` in a `frame`, or `corners` one by one. A cam's curve has one corner, in its frame: its
    places in all positions are the line in each.

    color  RRGGBB;  fill  of what the line encloses, or "";  width  in points of a printer
    border of a plate, [points]: so much of its line is its edge, the rest is filled as what it encloses; 0: a line
    size   of an arrow: which part it is of the largest of its kind; less than LEAST is not drawn
    """

    kind: Kind
    name: str
    color: str
    width: float
    frame: Frame | None = None
    path: Path = ()
    corners: tuple[Vector, ...] = ()
    fill: str = ""
    size: Node | None = None
    border: float = 0.0

    @property
    def vectors(self) -> tuple[Vector, ...]:
        """What its place follows from: the origin and the two vectors of its frame, or its corners."""
        frame = self.frame
        return self.corners if frame is None else (frame.origin, frame.along, frame.across)

    @property
    def is_curve(self) -> bool:
        """Whether it is a curve of a cam."""
        return self.frame is not None and not self.path


@dataclass(frozen=True, slots=True)
class Mark:
    """A disc at a place; `radius` in half windows."""

    kind: Kind
    name: str
    at: Vector
    radius: float
    fill: str


@dataclass(frozen=True, slots=True)
class Name:
    """A text that stands near a place, where there is room.

    value, unit  what is written behind it, `name = 12 N`; None for a name alone
    size         as of a shape
    needed       whether it stands there also where it covers something
    beside       how far from the place it begins, in half windows
    """

    text: str
    at: Vector
    value: Node | None = None
    unit: str = ""
    size: Node | None = None
    needed: bool = False
    beside: float = 0.0


@dataclass(frozen=True, slots=True)
class Extreme:
    """A number of the whole motion that shapes read as `symbol`: the least or the largest of some quantities."""

    symbol: str
    take: Literal["min", "max"]
    of: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Scale:
    """How long arrows of a kind are: the largest, `most`, is `longest` half windows long.

    shown  1 where its bar is drawn, 0 where the kind is hidden
    """

    kind: Kind
    most: Node
    longest: float
    unit: str
    color: str
    shown: Node = al.ONE


def shown(kind: Kind) -> Symbol:
    """1 where arrows of a kind are drawn, 0 where they are hidden."""
    return Symbol(f"#shown {kind}")


# --- the window ------------------------------------------------------------------------------------------------------

MARGIN = 1.3
"""How much larger than everything in all positions the window is; supports, guides and names need room."""

EDGE = 0.93
"""Where arrows end at the latest, from the middle of the window [half windows]; their names need room, too."""

LEFT, BOTTOM = -0.95, -0.95
"""Where the scale bar of lengths starts."""

BAR_START, BAR_RISE = -0.36, 0.09
"""Where the scale bars of arrows begin, beside that of lengths, and how far one stands above the other."""

BAR_ROOM = 0.27
"""What the lowest scale bars with their labels, and above them a support or the end of a rail need [half windows]."""

CAPTION_AT = (-0.97, 0.93)

LETTERS, CAPTION = 9.0, 11.0
"""Heights of names and of the caption [points]."""

PIN, POINT = 0.025, 0.0167
"""Radii of a ring at a revolute joint and of a dot."""


def room_of_bars(count: int) -> float:
    """What stays free at the lower edge, so that the scale bar of lengths, and so many of arrows beside it, lie on no link
    and on no support [half windows]."""
    return BAR_ROOM + BAR_RISE * max(0, count - 1)


# --- vectors ---------------------------------------------------------------------------------------------------------


def place_of(point: str) -> Vector:
    """The place of a point."""
    return Symbol(f"{point}.x"), Symbol(f"{point}.y")


def sized(part: float) -> Node:
    """So many half windows, in the length unit."""
    return al.mul(al.number(part), HALF)


def along(direction: Node) -> Vector:
    """The unit vector in a direction."""
    return al.call("COS", direction), al.call("SIN", direction)


def unit(vector: Vector) -> Vector:
    """The unit vector along another."""
    return al.div(vector[0], size(vector)), al.div(vector[1], size(vector))


# --- forms -----------------------------------------------------------------------------------------------------------


def arc(start: float, stop: float, steps: int) -> Path:
    """Corners on a circle of radius 1, from angle to angle [degrees]."""
    angles = [math.radians(start + (stop - start) * step / steps) for step in range(steps + 1)]
    return tuple((portable.cos(angle), portable.sin(angle)) for angle in angles)


CIRCLE: Path = arc(0.0, 360.0, 72)
"""Fine enough for a screen; a drawing for CAD has a true circle."""

WHEEL: Path = ((0.0, 0.0), *arc(0.0, 360.0, 48))
"""From the middle to a mark on the rim, and once around."""

ROUND: Path = arc(0.0, 360.0, 24)
QUARTERS: Path = ((0.0, 0.0), *arc(0.0, 90.0, 6), (0.0, 0.0), *arc(180.0, 270.0, 6), (0.0, 0.0))
"""With `ROUND` about it the mark of a mass centre."""


BLOCK_LENGTH, BLOCK_HEIGHT = 0.075, 0.045
"""Half the sides of a sliding block."""

BLOCK: Path = tuple(
    (a * BLOCK_LENGTH, b * BLOCK_HEIGHT) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))
)  # fmt: skip

SUPPORT_DEPTH = 0.075


def comb(length: float, strokes: int, depth: float, lean: float, start: float = 0.0) -> Path:
    """A base line along +a with strokes to the side of -b: ground. One line that goes back on itself."""
    path: list[tuple[float, float]] = []
    for n in range(strokes):
        at = start + length * n / (strokes - 1)
        path += [(at, 0.0), (at - lean, -depth), (at, 0.0)]
    return tuple(path)


def _support() -> Path:
    """A triangle under the pin on a hatched line."""
    half = 0.05
    hatch = tuple((a, b - SUPPORT_DEPTH) for a, b in comb(0.13, 5, 0.025, 0.025, -0.065))
    return ((0.0, 0.0), (-half, -SUPPORT_DEPTH), (half, -SUPPORT_DEPTH), (0.0, 0.0), (-half, -SUPPORT_DEPTH), *hatch)


SUPPORT = _support()

SHAFT: Path = ((0.0, 0.0), (1.0, 0.0))
ARROW_HEAD: Path = ((-0.75, -0.4), (0.25, 0.0), (-0.75, 0.4), (-0.75, -0.4))
"""Round the end of a shaft, so that this is nowhere to be seen."""

BOW: Path = arc(-135.0, 135.0, 24)
BOW_HEAD: Path = ((-0.83, 0.83), (-1.03, 0.38), (-0.56, 0.56), (-0.83, 0.83))
"""A round arrow counter-clockwise, its gap at -a; and its tip."""


def zigzag(turns: int, start: float, stop: float) -> Path:
    """From 0 to 1 along a, in between to and fro across."""
    step = (stop - start) / (2 * turns)
    teeth = tuple((start + (n + 0.5) * step, 1.0 if n % 2 else -1.0) for n in range(2 * turns))
    return ((0.0, 0.0), (start, 0.0), *teeth, (stop, 0.0), (1.0, 0.0))


COIL = zigzag(5, 0.16, 0.84)
BARREL: Path = (
    (0.0, 0.0), (0.06, 0.0), (0.06, 1.0), (1.0, 1.0), (1.0, -1.0), (0.06, -1.0), (0.06, 0.0), (0.0, 0.0),
)  # fmt: skip
"""From its eye, 1 long and 1 to either side."""

PULLED_IN, PUSHED_OUT = 0.8, 0.3
"""How long a barrel is drawn: so much of the least distance of the pins, at least so much of the largest."""


# --- the list --------------------------------------------------------------------------------------------------------


@dataclass
class Shapes:
    """The list.

    extremes  what shapes read of the whole motion, in order
    shapes    from back to front, marks before what lies on them
    around    what the window holds in every position: places, and radii about them
    scales    of the arrows that have one
    """

    extremes: list[Extreme] = field(default_factory=list)
    shapes: list[Shape | Mark] = field(default_factory=list)
    names: list[Name] = field(default_factory=list)
    around: list[tuple[Vector, Node]] = field(default_factory=list)
    scales: list[Scale] = field(default_factory=list)

    def extreme(self, take: str, *of: Node) -> Symbol:
        """The symbol of an extreme."""
        known = next((each for each in self.extremes if (each.take, each.of) == (take, of)), None)
        if known is None:
            known = Extreme(f"#{take} {len(self.extremes) + 1}", "min" if take == "min" else "max", of)
            self.extremes.append(known)
        return Symbol(known.symbol)


def plate(name: str, color: str, places: tuple[Vector, ...]) -> Shape:
    """A link: a bar with round ends, or a plate with round corners."""
    return Shape("link", name, color, PLATE, corners=places, fill=pale(color), border=BORDER)


def telescope(
    found: Shapes, kind: Kind, name: str, ends: tuple[Vector, Vector], colors: tuple[str, str], bore: float
) -> Iterator[Shape]:
    """A rod that slides in a barrel; the barrel begins at the first end, and is as long as both can be pushed together."""
    way = minus(ends[1], ends[0])
    distance = size(way)
    least, most = found.extreme("min", distance), found.extreme("max", distance)
    barrel = al.call("MAX", al.mul(al.number(PULLED_IN), least), al.mul(al.number(PUSHED_OUT), most))
    ahead = unit(way)
    middle = plus(ends[0], times(al.div(barrel, al.TWO), ahead))
    yield Shape(kind, name, colors[1], 3.0, corners=(middle, ends[1]))
    frame = Frame(ends[0], times(barrel, ahead), times(sized(bore), turned(ahead)))
    yield Shape(kind, name, colors[0], 2.0, frame, BARREL, fill="FFFFFF")

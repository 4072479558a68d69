"""The list of shapes in numbers: a mechanism at one position, as any program can draw it.

Places are in the mechanism's length unit, y upwards; widths of lines and heights of letters in points of a printer, of which
the window is 360 high.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from livesheet.formula.nodes import Node
from livesheet.formula.vectors import Vector
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import Array, value
from mechsheet.model import Mechanism
from mechsheet.shapes.colors import INK
from mechsheet.shapes.forms import (
    ARROWS,
    BAR_RISE,
    BAR_START,
    BOTTOM,
    CAPTION,
    CAPTION_AT,
    CIRCLE,
    EDGE,
    HALF,
    LEAST,
    LEFT,
    LETTERS,
    MARGIN,
    Kind,
    Mark,
    Scale,
    Shape,
    room_of_bars,
    shown,
)
from mechsheet.shapes.listing import shapes_of
from mechsheet.shapes.loads import VECTORS
from mechsheet.shapes.names import POINTS, Boxes, Lines, Sheet, half_box
from mechsheet.units import behind_number
from mechsheet.words.catalogue import words
from mechsheet.words.equations import body_words
from mechsheet.words.symbols import plain

FITTED = 8
"""How often a window is made larger for arrows, which grow with it, each time by less than half as much."""

CORNERS = 16
"""An outline of more corners, a traced one for example, is coarser inside, where names are the only ones to ask."""

NAMELESS = 6
"""So many rings in a plate leave no room for a name."""

RING = 1.5
"""Width of the line of a ring [points]."""


@dataclass(frozen=True, slots=True)
class Stroke:
    """A line through `points` (n, 2), with gaps where they are NaN; `width` in points, colours as RRGGBB, no `fill` "".

    border  of a plate, as of a shape
    circle  whether it stands for a circle through its points
    """

    kind: Kind
    name: str
    points: Array
    color: str
    width: float
    fill: str = ""
    border: float = 0.0
    circle: bool = False


@dataclass(frozen=True, slots=True)
class Disc:
    """A circle; `fill` and `line` as RRGGBB; (nan, nan) where there is none."""

    kind: Kind
    name: str
    x: float
    y: float
    radius: float
    fill: str
    line: str


@dataclass(frozen=True, slots=True)
class Label:
    """A text at (x, y), `size` points high: its middle, or its left end; (nan, nan) where there is no room for it."""

    kind: Kind
    text: str
    x: float
    y: float
    size: float
    middle: bool = True


Item = Stroke | Disc | Label


def painted(items: Iterable[Item]) -> Iterator[Item]:
    """What is painted of the items that are there, from back to front."""
    return (layer for item in items if there(item) for layer in layers_of(item))


def layers_of(item: Item) -> tuple[Item, ...]:
    """What is painted of an item, with round ends: of a plate its border, and on it its inside."""
    if not isinstance(item, Stroke) or not item.border:
        return (item,)
    inside = replace(item, color=item.fill, width=item.width - 2 * item.border, border=0.0)
    return replace(item, fill=item.color, border=0.0), inside


def places_of(item: Item) -> Array:
    """The corners of a line (n, 2), or the one place of a circle or of a text."""
    return item.points if isinstance(item, Stroke) else np.array([[item.x, item.y]])


def there(item: Item) -> bool:
    """Whether anything of an item is to be drawn."""
    return bool(np.isfinite(places_of(item)).any())


@dataclass(frozen=True, slots=True)
class Window:
    """The square that is seen, the same in all positions: its middle and half its side."""

    x: float
    y: float
    half: float


@dataclass(frozen=True, slots=True)
class Scene:
    """One position: its items from back to front, as many in every position; the caption is the last."""

    items: tuple[Item, ...]
    window: Window

    @property
    def caption(self) -> str:
        """Where the driver stands, and why there is no position."""
        return str(getattr(self.items[-1], "text", ""))


class Solved(Protocol):
    """A mechanism with the values of its equations in some positions."""

    @property
    def mechanism(self) -> Mechanism:
        """The mechanism."""

    @property
    def equations(self) -> Equations:
        """Its equations."""

    @property
    def driver(self) -> Array:
        """The driver's value in every position."""

    @property
    def values(self) -> Mapping[str, Array]:
        """Every symbol's values."""


class Positions:
    """All positions of a mechanism; `vectors` as of `shapes_of`."""

    def __init__(self, compiled: Solved, vectors: Collection[Kind] = ()) -> None:
        self.compiled = compiled
        self.list = shapes_of(compiled.mechanism, compiled.equations, vectors)
        self.rows = len(compiled.driver)
        self._known: dict[str, Any] = {**compiled.values, **{shown(kind).name: 1.0 for kind in VECTORS}}
        self._seen: dict[Any, Any] = {}
        self._places: dict[int, Array] = {}
        for extreme in self.list.extremes:
            found = np.concatenate([self.column(node) for node in extreme.of])
            found = found[np.isfinite(found)]
            take = np.min if extreme.take == "min" else np.max
            self._known[extreme.symbol] = float(take(found)) if len(found) else math.nan
        self.window = self._window()

    def at(self, row: int) -> Scene:
        """A position."""
        drawn, fixed = self._without_names(row)
        return Scene((*drawn, *self._names(row, drawn, fixed), *fixed), self.window)

    def _without_names(self, row: int) -> tuple[tuple[Item, ...], tuple[Label, ...]]:
        """What is drawn, and the texts that have places of their own, the caption last."""
        bars, texts = self._bars
        drawn = [self._item(index, shape, row) for index, shape in enumerate(self.list.shapes)]
        return (*drawn, *bars), (*texts, self._caption(row))

    def known(self, symbol: str) -> float:
        """A number of the whole motion that shapes read: one of the list's extremes, or half the window's side."""
        return float(self._known[symbol])

    # --- formulas in numbers -----------------------------------------------------------------------------------------

    def column(self, node: Node) -> Array:
        """The values of a tree in all positions."""
        with np.errstate(all="ignore"):
            found = value(node, self._known, rooted=True, seen=self._seen)
        return np.broadcast_to(np.asarray(found, float), (self.rows,))

    def _vector(self, vector: Vector) -> Array:
        """(rows, 2)."""
        return np.column_stack([self.column(part) for part in vector])

    def columns(self, shape: Shape) -> Array:
        """The vectors of a shape's frame, or its corners (rows, count, 2); NaN where it is not there."""
        found = np.stack([self._vector(vector) for vector in shape.vectors], axis=1)
        there = np.asarray(np.isfinite(found).all(axis=(1, 2)))
        if shape.size is not None:
            with np.errstate(invalid="ignore"):
                there &= self.column(shape.size) >= LEAST
        return np.where(there[:, None, None], found, math.nan)

    def curve(self, shape: Shape) -> Array:
        """The line (n, 2) of a cam's curve, in its frame."""
        return self._trace(self._vector(shape.corners[0]))

    def _corners(self, shape: Shape) -> Array:
        """(rows, corners, 2)."""
        found = self.columns(shape)
        if shape.frame is None or not shape.path:
            return found
        path = np.array(shape.path)
        return np.asarray(found[:, :1] + path[None, :, :1] * found[:, 1:2] + path[None, :, 1:] * found[:, 2:])

    # --- the window --------------------------------------------------------------------------------------------------

    def _window(self) -> Window:
        """A square about everything in all positions; larger where arrows would leave it, higher where bars stand in it."""
        low, high = np.full(2, math.inf), np.full(2, -math.inf)
        for place, radius in self.list.around:
            at, out = self._vector(place), self.column(radius)[:, None]
            low = np.fmin(low, np.fmin.reduce(at - out))
            high = np.fmax(high, np.fmax.reduce(at + out))
        low, high = (np.where(np.isfinite(end), end, 0.0) for end in (low, high))
        middle, sides = (low + high) / 2, high - low
        above = 1 - 1 / MARGIN
        raised = max(0.0, room_of_bars(len(self.list.scales)) - above) / 2
        half = least = max(sides[0], sides[1] * (1 - above) / (1 - above - raised)) * MARGIN / 2 or 1.0
        arrows = [shape for shape in self.list.shapes if isinstance(shape, Shape) and shape.kind in ARROWS]
        for _ in range(FITTED):
            self._known[HALF.name] = half
            seen = middle - (0.0, raised * half)
            far = [np.abs(self._corners(shape) - seen) for shape in arrows]
            half = max([least, *(float(np.fmax.reduce(each, axis=None, initial=0.0)) / EDGE for each in far)])
        self._known[HALF.name] = half
        self._seen.clear()  # what follows from the size of the window
        return Window(float(middle[0]), float(middle[1]) - raised * float(half), float(half))

    # --- items -------------------------------------------------------------------------------------------------------

    def _item(self, index: int, shape: Shape | Mark, row: int) -> Item:
        if index not in self._places:
            places = self._vector(shape.at) if isinstance(shape, Mark) else self._corners(shape)
            self._places[index] = self._trace(places[:, 0]) if shape.kind == "path" else places
        places = self._places[index]
        if isinstance(shape, Shape) and shape.is_curve:
            origin, along, across = self.columns(shape)[row]
            curve = self.curve(shape)
            points = origin + curve[:, :1] * along + curve[:, 1:] * across
            return Stroke(shape.kind, shape.name, points, shape.color, shape.width, shape.fill)
        if isinstance(shape, Mark):
            x, y = places[row].tolist()
            return Disc(shape.kind, shape.name, x, y, shape.radius * self.window.half, shape.fill, INK)
        points = places if shape.kind == "path" else places[row]
        circle = shape.path is CIRCLE
        return Stroke(shape.kind, shape.name, points, shape.color, shape.width, shape.fill, shape.border, circle)

    def _trace(self, places: Array) -> Array:
        """A path has the positions of the sweep, without one that was asked for outside of it."""
        return places[: getattr(self.compiled, "sweep", len(places))]

    @cached_property
    def _bars(self) -> tuple[tuple[Stroke, ...], tuple[Label, ...]]:
        """Scale bars: of lengths, and of arrows that have no values beside them; and what they say."""
        half = self.window.half
        length = longest(half / 2)
        corners = [(LEFT, BOTTOM), (LEFT + length / half, BOTTOM)]
        bars = [Stroke("scale", self._text("drawing.bar"), self._in_window(corners), INK, 2.0)]
        text = f"{length:.10g} {self.compiled.mechanism.length_unit}".rstrip()
        texts = [self._label("scale", text, (LEFT + length / half / 2, BOTTOM + 0.07), LETTERS)]
        for number, scale in enumerate(self.list.scales):
            made = self._bar(scale, BOTTOM + BAR_RISE * number)
            if made is not None:
                bars.append(made[0])
                texts.append(made[1])
        return tuple(bars), tuple(texts)

    def _bar(self, scale: Scale, height: float) -> tuple[Stroke, Label] | None:
        most = float(self.column(scale.most)[0])
        if not most > 0:
            return None
        amount = longest(most)
        end = BAR_START + amount / most * scale.longest
        corners = self._in_window([(BAR_START, height), (end, height)])
        line = Stroke("scale", self._text("drawing.bar"), corners, scale.color, 2.0)
        text = f"{amount:.10g} {scale.unit}".rstrip()
        return line, self._label("scale", text, (end + 0.02, height), LETTERS, middle=False)

    def _text(self, key: str, **parts: object) -> str:
        return words(self.compiled.mechanism.language, key, **parts)

    def _in_window(self, places: Sequence[tuple[float, float]]) -> Array:
        window = self.window
        return np.array(places) * window.half + (window.x, window.y)

    def _label(self, kind: Kind, text: str, at: tuple[float, float], size: float, middle: bool = True) -> Label:
        x, y = self._in_window([at])[0].tolist()
        return Label(kind, text, x, y, size, middle)

    def _caption(self, row: int) -> Label:
        """The driver's value in the upper left corner; of a position that does not exist why there is none."""
        driver = self.compiled.mechanism.driver
        shown = round(float(driver.unit.to_shown(float(self.compiled.driver[row]))), 3) + 0.0
        text = f"{plain(driver.symbol)} = {shown:.10g}{behind_number(driver.unit.text)}"
        for group in self.compiled.equations.groups:
            if not math.isfinite(self.compiled.values[group.closes][row]):
                mechanism = self.compiled.mechanism
                links = ", ".join(body_words(mechanism, name).of(mechanism.language) for name in group.links)
                text += f" – {self._text(group.status, links=links)}"
                break
        return self._label("caption", text, CAPTION_AT, CAPTION, middle=False)

    # --- names -------------------------------------------------------------------------------------------------------

    def _names(self, row: int, drawn: Sequence[Item], fixed: Sequence[Label]) -> Iterator[Label]:
        """The names where there is room; those of points first."""
        for name, (at, *_), found in zip(self.list.names, self._named, self._placed(row, drawn, fixed), strict=True):
            text, beside = found or (name.text, np.full(2, math.nan))
            x, y = (at[row] + beside * self.window.half).tolist()
            yield Label("name", text, x, y, LETTERS)

    def _placed(
        self, row: int, drawn: Sequence[Item], fixed: Sequence[Label], letters: float = LETTERS,
        before: Array | None = None,
    ) -> Iterator[tuple[str, Array] | None]:  # fmt: skip
        """What each name says and how far from its place its middle is, None for one that is not there or has no room.

        before  how far from its place each stood a moment ago: it stays there where that is free, and says all or nothing
        """
        sheet = self.sheet(drawn)
        for label in fixed:
            half = half_box(label.text, label.size * letters / LETTERS)
            sheet.take(self._of_window(label) + np.array([0.0 if label.middle else half[0], 0.0]), half)
        places = np.array([at[row] for at, *_ in self._named]).reshape(-1, 2)
        places = (places - (self.window.x, self.window.y)) / self.window.half
        wholes = [
            name.text if amount is None else f"{name.text} = {in_digits(amount[row])} {name.unit}".rstrip()
            for name, (_, _, amount) in zip(self.list.names, self._named, strict=True)
        ]
        # all of them are asked at once: one after another took two fifths longer
        halves = np.array([half_box(whole, letters) for whole in wholes]).reshape(-1, 2)
        stay = Boxes(places + (math.nan if before is None else before), halves)
        stays = sheet.on_no_line(stay)
        for index, (name, (at, size, _)) in enumerate(zip(self.list.names, self._named, strict=True)):
            if not np.isfinite(at[row]).all() or (size is not None and not size[row] >= LEAST):
                yield None
                continue
            whole, place = wholes[index], places[index]
            if stays[index] and sheet.takes(stay.middles[index], stay.halves[index]):
                yield whole, stay.middles[index] - place
                continue
            texts = (whole,) if before is not None else tuple(dict.fromkeys((whole, name.text)))
            found = sheet.place(texts, letters, place, name.beside, name.needed)
            yield None if found is None else (found[0], found[1] - place)

    def beside(self, rows: Sequence[int], letters: float = LETTERS) -> Array:
        """How far from its place each name stands in some rows, one after another, (rows, names, 2) [half windows].

        A name stays where it was in the row before as long as it can, also while there is nothing to name; NaN: no room.
        """
        found = np.full((len(rows), len(self.list.names), 2), math.nan)
        before = found[0].copy()
        for number, row in enumerate(rows):
            drawn, fixed = self._without_names(row)
            for index, place in enumerate(self._placed(row, drawn, fixed, letters, before)):
                if place is not None:
                    before[index] = place[1]
                if place is not None or not np.isfinite(self._named[index][0][row]).all():
                    found[number, index] = before[index]
        return found

    @cached_property
    def _named(self) -> list[tuple[Array, Array | None, Array | None]]:
        """Of every name in all positions: its place, its size, its value."""

        def column(node: Node | None) -> Array | None:
            return None if node is None else self.column(node)

        return [(self._vector(name.at), column(name.size), column(name.value)) for name in self.list.names]

    def _of_window(self, item: Disc | Label) -> Array:
        return np.array([item.x - self.window.x, item.y - self.window.y]) / self.window.half

    def sheet(self, drawn: Sequence[Item]) -> Sheet:
        """What names must not cover, and the paths that they had better not."""
        strokes = [_filled(item) for item in drawn if isinstance(item, Stroke)]
        discs = [item for item in drawn if isinstance(item, Disc) and math.isfinite(item.x)]
        half = np.array([disc.radius for disc in discs]) / self.window.half
        taken = Boxes(
            np.array([self._of_window(disc) for disc in discs]).reshape(-1, 2),
            np.column_stack([half, half]).reshape(-1, 2),
        )
        return Sheet(
            self._lines([stroke for stroke in strokes if stroke.kind != "path"]),
            self._lines([stroke for stroke in strokes if stroke.kind == "path"]),
            taken,
        )

    def _lines(self, strokes: Sequence[Stroke]) -> Lines:
        window = self.window
        places = [(stroke.points - (window.x, window.y)) / window.half for stroke in strokes]
        starts = np.concatenate([np.zeros((0, 2)), *(each[:-1] for each in places)])
        ends = np.concatenate([np.zeros((0, 2)), *(each[1:] for each in places)])
        widths = np.concatenate(
            [
                np.zeros(0),
                *(np.full(len(each) - 1, s.width / 2 / POINTS) for s, each in zip(strokes, places, strict=True)),
            ]
        )
        there = np.isfinite(starts).all(axis=1) & np.isfinite(ends).all(axis=1)
        return Lines(starts[there], ends[there], widths[there])


def _filled(stroke: Stroke) -> Stroke:
    """A plate with its inside as lines, since no name stands on it."""
    if not stroke.border or len(stroke.points) < 4:
        return stroke
    corners = stroke.points[: -1 : math.ceil((len(stroke.points) - 1) / CORNERS)]
    inside = rings(np.vstack([corners, corners[:1]]), NAMELESS)
    return replace(stroke, points=np.vstack([stroke.points, inside[len(corners) :]]))


def in_digits(amount: float, digits: int = 3) -> str:
    """So many digits of a value, as people write numbers."""
    rounded = float(f"{amount:.{digits}g}") + 0.0
    text = f"{rounded:.0f}" if abs(rounded) >= 10.0 ** (digits - 1) else f"{rounded:g}"
    return text.replace("-", "−")


def longest(room: float) -> float:
    """The largest of 1, 2 and 5 times a power of ten that a scale bar has room for."""
    power = 10.0 ** math.floor(math.log10(room))
    return max(part * power for part in (1.0, 2.0, 5.0) if part * power <= room * (1 + 1e-12))


# --- the inside of plates, as lines: charts fill nothing, but a line that is wide enough does ------------------------

MOST_RINGS = 16
"""A plate as large as the window has fewer."""

APART = 0.8
"""How far a ring is from the next, in widths of the line: round corners leave gaps at sharp ones."""


def ways_in(count: int) -> tuple[float, ...]:
    """How far from the outline to the middle so many rings are; the last leaves half a line's width in the middle."""
    return tuple(number / (count + 0.5) for number in range(1, count + 1))


def rings(outline: Array, count: int) -> Array:
    """One line (n, 2) around and around, from a closed outline inwards."""
    middle = outline[:-1].mean(axis=0)
    return np.concatenate([outline, *(outline + way * (middle - outline) for way in ways_in(count))])


def rings_needed(outline: Array, width: float) -> int:
    """How many rings fill a closed outline, by a line of a width: none where its corners lie on a line."""
    middle = outline[:-1].mean(axis=0)
    depth = max(_distances(middle, outline), default=0.0)
    return min(MOST_RINGS, max(0, math.ceil(depth / (APART * width) - 0.5)))


def _distances(place: Array, outline: Array) -> Sequence[float]:
    """From a place to the lines through the sides of an outline."""
    sides, ways = np.diff(outline, axis=0), place - outline[:-1]
    lengths = np.hypot(*sides.T)
    areas = np.abs(sides[:, 0] * ways[:, 1] - sides[:, 1] * ways[:, 0])
    return [float(area / length) for area, length in zip(areas, lengths, strict=True) if length > 0]

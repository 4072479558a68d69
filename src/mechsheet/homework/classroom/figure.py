"""The figure of a task: the mechanism in one position of the description's own dimensions, with the points' names.

Its places are rounded to what an eye can tell, in parts of the drawing: no answer can be read from them.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from livesheet.workbook import Anchor, Area, Cell, Chart, Series, SeriesRef, Sheet
from mechsheet.model import Mechanism
from mechsheet.plotting.sampling import sample
from mechsheet.plotting.scenes import Stage, extent, without_caption
from mechsheet.shapes.names import POINTS
from mechsheet.shapes.positions import Disc, Item, Label, Scene, Stroke, Window, layers_of, there
from mechsheet.sheet.drawing.drawing import DRAWING_INNER, POINTS_OF_A_PIXEL
from mechsheet.sheet.drawing.frames import HIDDEN_AXIS
from mechsheet.words.catalogue import said

DIGITS = 3
"""Decimals of a place, where the longer side of the drawing is 2."""
WIDEST, HIGHEST = 600, 420
"""How large a figure may be on the task's sheet, as wide as paper has room for [pixels]."""
SMALLEST = 2
"""Points of the smallest circle, as spreadsheets have it."""
INSIDE = 0.75
"""The radius of a circle within its line."""
MOVES = 1e-9
"""Points whose distance changes by less stand still against each other."""


@dataclass(frozen=True, slots=True)
class Figure:
    """A drawing, before it stands on a sheet. It has the shape of the mechanism: what is long and low is wide."""

    scene: Scene
    language: str

    def on(self, row: int) -> tuple[Chart, Sheet]:
        """The chart below a row of the task's sheet, and the sheet of its numbers."""
        title = said(self.language, "task.figure")
        shown = without_caption(self.scene, False)
        frame = _Frame.around(shown, self.scene.window)
        cells: list[Cell] = []
        series: list[Series] = []
        covering: list[Series] = []
        for number, item in enumerate(filter(there, shown)):
            top = 3 * number  # an empty row between them: they are no table
            words = item.text if isinstance(item, Label) else item.name
            cells.append(Cell(top, 0, words or None))
            places = frame.places(item)
            for axis in (0, 1):
                cells += [Cell(top + axis, col, place) for col, place in enumerate(places[:, axis].tolist(), 1)]
            x, y = (SeriesRef(title, Area(top + axis, 1, top + axis, len(places))) for axis in (0, 1))
            layers = [frame.series(each, words, x, y) for each in _layers(item)]
            series += layers
            if len(layers) > 1 or isinstance(item, Disc):
                covering = [*reversed(layers), *covering]
        across, up = (replace(HIDDEN_AXIS, low=-half, high=half, step=half / 2) for half in frame.halves)
        chart = Chart(
            "",
            Anchor(row, 0, frame.width, frame.height),
            (*covering, *series),  # some programs draw the first on top, others the last
            across,
            up,
            legend="",
            inner=DRAWING_INNER,
            alt_text=title,
        )
        # hidden: who prints the whole workbook wants no sheets of numbers
        return chart, Sheet(title, tuple(cells), hidden=True)

    def below(self, other: bool) -> str:
        """What stands below it: which position it shows, and that a student's own dimensions may be `other` ones."""
        scale = said(self.language, "task.scale") if other else ""
        return ".  ".join(filter(None, (self.scene.caption, scale)))


@dataclass(frozen=True, slots=True)
class _Frame:
    """What a figure shows, as large as there is room for: its middle, the half of its longer side [length units], how long
    its sides are, of which the longer one is 2, and a pixel's length."""

    middle: NDArray[np.float64]
    half: float
    halves: tuple[float, float]
    pixel: float
    window: Window

    @classmethod
    def around(cls, items: Sequence[Item], window: Window) -> _Frame:
        """The frame of what is drawn."""
        low, high = extent(items, window)
        sides = high - low
        across, up = np.round(sides / sides.max(), DIGITS).tolist()
        pixel = max(sides[0] / WIDEST, sides[1] / HIGHEST)
        return cls((low + high) / 2, float(sides.max() / 2), (across, up), float(pixel), window)

    @property
    def width(self) -> int:
        """In pixels."""
        return round(2 * self.half * self.halves[0] / self.pixel)

    @property
    def height(self) -> int:
        """In pixels."""
        return round(2 * self.half * self.halves[1] / self.pixel)

    @property
    def points(self) -> float:
        """Of the half window, of which a drawing's lines have a width in points."""
        return self.window.half / self.pixel * POINTS_OF_A_PIXEL

    def places(self, item: Item) -> NDArray[np.float64]:
        """An item's places, from -1 to 1 along the longer side."""
        points = item.points if isinstance(item, Stroke) else np.array([[item.x, item.y]])
        points = points[np.isfinite(points).all(axis=1)]
        return np.asarray(np.round((points - self.middle) / self.half, DIGITS), float)

    def series(self, item: Item, words: str, x: SeriesRef, y: SeriesRef) -> Series:
        """A line, a circle or a name of the chart. Lines grow with the drawing, letters do not."""
        match item:
            case Stroke():
                wide = round(item.width * self.points / POINTS, 2)
                return Series(words, x, y, line=item.color, width=wide, in_legend=False)
            case Disc():
                size = max(SMALLEST, round(2 * item.radius / self.pixel * POINTS_OF_A_PIXEL))
                return Series(words, x, y, marker="circle", marker_size=size, marker_line=item.line,
                              marker_fill=item.fill, in_legend=False)  # fmt: skip
        side: Literal["center", "right"] = "center" if item.middle else "right"
        return Series(words, x, y, show_name=True, label_side=side, label_size=item.size, in_legend=False)


def _layers(item: Item) -> tuple[Item, ...]:
    """What is painted of an item; a circle as a disc on a larger one, since LibreOffice draws no line around a marker."""
    if not isinstance(item, Disc):
        return layers_of(item)
    inside = replace(item, line=item.fill, radius=item.radius * INSIDE)
    return replace(item, fill=item.line), inside


def figure_of(mechanism: Mechanism) -> Figure:
    """The figure; of all positions that in which the points are farthest apart from one another."""
    found = sample(mechanism, None, mechanism.language)
    stage = Stage(found)
    names = dict.fromkeys(point for link in mechanism.links for point in link.points)
    spots = [np.column_stack([found.values[f"{name}.{axis}"] for axis in "xy"]) for name in names]
    apart = [np.hypot(*(one - other).T) for one, other in itertools.combinations(spots, 2)]
    apart = [each for each in apart if np.ptp(each[np.isfinite(each)]) > MOVES] or [np.zeros(len(found.exists))]
    nearest = np.where(found.exists, np.min(apart, axis=0), -np.inf)[: found.sweep]
    return Figure(stage.drawing(int(np.nanargmax(nearest))), mechanism.language)

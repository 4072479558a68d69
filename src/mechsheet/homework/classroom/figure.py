"""The figure of a task: the mechanism in one position of the description's own dimensions, with the points' names.

Its places are rounded to what an eye can tell, in parts of the drawing: no answer can be read from them.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from livesheet.workbook import Anchor, Area, Cell, Chart, Series, SeriesRef, Sheet
from mechsheet.model import Mechanism
from mechsheet.plotting.sampling import sample
from mechsheet.plotting.scenes import Stage
from mechsheet.shapes.positions import Disc, Item, Label, Scene, Stroke, layers_of, there
from mechsheet.sheet.drawing.drawing import DRAWING_INNER
from mechsheet.sheet.drawing.frames import HIDDEN_AXIS
from mechsheet.words.homework import said

DIGITS = 3
"""Decimals of a place, where the drawing is 2 wide."""
SIZE = 420
"""Width and height on the task's sheet [pixels]."""
SMALLEST = 2
"""Points of the smallest circle, as spreadsheets have it."""
MOVES = 1e-9
"""Points whose distance changes by less stand still against each other."""


POINTS = 0.75
"""Points of a pixel."""


@dataclass(frozen=True, slots=True)
class Figure:
    """A drawing, before it stands on a sheet."""

    scene: Scene
    language: str

    def on(self, row: int) -> tuple[Chart, Sheet]:
        """The chart below a row of the task's sheet, and the sheet of its numbers."""
        title = said(self.language, "task.figure")
        cells: list[Cell] = []
        series: list[Series] = []
        for number, item in enumerate(filter(there, self.scene.items)):
            top = 3 * number  # an empty row between them: they are no table
            words = item.text if isinstance(item, Label) else item.name
            cells.append(Cell(top, 0, words or None))
            places = self._places(item)
            for axis in (0, 1):
                cells += [Cell(top + axis, col, place) for col, place in enumerate(places[:, axis].tolist(), 1)]
            x, y = (SeriesRef(title, Area(top + axis, 1, top + axis, len(places))) for axis in (0, 1))
            border, *inside = layers_of(item)  # programs draw the first on top, or the last
            series += [self._series(each, words, x, y) for each in (*inside, border, *inside)]
        anchor = Anchor(row, 0, SIZE, SIZE)
        chart = Chart(
            "", anchor, tuple(series), HIDDEN_AXIS, HIDDEN_AXIS, legend="", inner=DRAWING_INNER, alt_text=title
        )
        return chart, Sheet(title, tuple(cells))

    def _places(self, item: Item) -> NDArray[np.float64]:
        """Its places, from -1 to 1 in the window."""
        window = self.scene.window
        points = item.points if isinstance(item, Stroke) else np.array([[item.x, item.y]])
        points = points[np.isfinite(points).all(axis=1)]
        return np.asarray(np.round((points - (window.x, window.y)) / window.half, DIGITS), float)

    def _series(self, item: Item, words: str, x: SeriesRef, y: SeriesRef) -> Series:
        match item:
            case Stroke():
                return Series(words, x, y, line=item.color, width=item.width, in_legend=False)
            case Disc():
                size = max(SMALLEST, round(item.radius / self.scene.window.half * SIZE * POINTS))
                return Series(words, x, y, marker="circle", marker_size=size, marker_line=item.line,
                              marker_fill=item.fill, in_legend=False)  # fmt: skip
        side: Literal["center", "right"] = "center" if item.middle else "right"
        return Series(words, x, y, show_name=True, label_side=side, label_size=item.size, in_legend=False)


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

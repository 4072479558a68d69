"""The figure of a task: the workbook's drawing in one position of the description's own dimensions, with the points' names.

Its places are rounded to what an eye can tell, in parts of the drawing: no answer can be read from them.
"""

from __future__ import annotations

import itertools
from dataclasses import dataclass, replace

import numpy as np

from mechsheet.model import Mechanism
from mechsheet.plotting.sampling import sample
from mechsheet.plotting.scenes import Scene, Stage
from mechsheet.sheet.workbook import Anchor, Area, Cell, Chart, Series, SeriesRef, Sheet
from mechsheet.words.homework import said

DIGITS = 3
"""Decimals of a place, where the drawing is 2 wide."""
SIZE = 420
"""Width and height on the task's sheet [pixels]."""
MOVES = 1e-9
"""Points whose distance changes by less stand still against each other."""


@dataclass(frozen=True, slots=True)
class Figure:
    """A drawing, before it stands on a sheet."""

    chart: Chart
    scene: Scene
    language: str

    def on(self, row: int) -> tuple[Chart, Sheet]:
        """The chart below a row of the task's sheet, and the sheet of its numbers."""
        title = said(self.language, "task.figure")
        cells: list[Cell] = []
        series: list[Series] = []
        for number, piece in enumerate(self.scene):
            there = piece.points[np.isfinite(piece.points).all(axis=1)]
            if not len(there):
                continue
            top = 3 * number  # an empty row between them: they are no table
            cells.append(Cell(top, 0, piece.words or None))
            for axis in (0, 1):
                places = np.round(there[:, axis], DIGITS).tolist()
                cells += [Cell(top + axis, col, place) for col, place in enumerate(places, 1)]
            x, y = (SeriesRef(title, Area(top + axis, 1, top + axis, len(there))) for axis in (0, 1))
            series.append(replace(piece.series, name=piece.words, x=x, y=y))
        anchor = Anchor(row, 0, SIZE, SIZE)
        return replace(self.chart, anchor=anchor, series=tuple(series), title=title), Sheet(title, tuple(cells))


def figure_of(mechanism: Mechanism) -> Figure:
    """The figure; of all positions that in which the points are farthest apart from one another."""
    found = sample(mechanism, None, mechanism.language)
    stage = Stage(found)
    names = dict.fromkeys(point for link in mechanism.links for point in link.points)
    spots = [np.column_stack([found.values[f"{name}.{axis}"] for axis in "xy"]) for name in names]
    apart = [np.hypot(*(one - other).T) for one, other in itertools.combinations(spots, 2)]
    apart = [each for each in apart if np.ptp(each[np.isfinite(each)]) > MOVES] or [np.zeros(len(found.exists))]
    nearest = np.where(found.exists, np.min(apart, axis=0), -np.inf)[: found.sweep]
    return Figure(stage.charts[0], stage.drawing(int(np.nanargmax(nearest))), mechanism.language)

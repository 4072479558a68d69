"""A mechanism at any position, as numbers: what a picture shows, before any picture format is known.

The mechanism itself is drawn from the list of shapes; the curves of a page are the workbook's charts.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from livesheet.engine import Values
from livesheet.formula.nodes import CellRef, ErrorValue
from livesheet.workbook import Chart, Series, SeriesRef
from mechsheet.plotting.sampling import Sample
from mechsheet.shapes.loads import VECTORS
from mechsheet.shapes.names import half_box
from mechsheet.shapes.positions import Item, Label, Positions, Scene, Stroke, Window, places_of
from mechsheet.sheet.places import there

Points = NDArray[np.float64]

AROUND = 0.04
"""What stays free around a drawing [half windows]."""

CLOSED = 1e-6
"""A sweep whose last picture is this near the first (in half windows) comes round."""


@dataclass(frozen=True, slots=True)
class Piece:
    """One series of a chart at one position.

    points  (n, 2) in the chart's units; NaN where there is nothing
    words   the series' name, which is the text of a label
    """

    series: Series
    points: Points
    words: str


Curves = tuple[Piece, ...]
"""The pieces of a chart from back to front."""


class Stage:
    """A sample's mechanism and its charts, to be looked at in any of its rows."""

    def __init__(self, sample: Sample) -> None:
        self.sample = sample

    @cached_property
    def positions(self) -> Positions:
        """The mechanism in all positions."""
        return Positions(self.sample, VECTORS if self.sample.vectors else ())

    def drawing(self, row: int) -> Scene:
        """The mechanism at a position."""
        return self.positions.at(row)

    # --- charts ------------------------------------------------------------------------------------------------------

    @property
    def charts(self) -> tuple[Chart, ...]:
        """The charts of the first sheet but its drawing, which comes first."""
        return self.sample.layout.sheets[0].charts[1:]

    @cached_property
    def _position(self) -> tuple[int, int, int]:
        spot = there(self.sample.plan.places.position)
        return self.sample.cells.plan.layout.sheets[spot.sheet], spot.row, spot.col

    def at(self, row: int, charts: Sequence[Chart]) -> list[Curves]:
        """Charts with the position cell at `row`; afterwards it is where the workbook has it."""
        cells = self.sample.cells
        cells.set(self._position, float(row))
        values = cells.asked()
        found = [tuple(self._piece(values, series) for series in _shown(chart)) for chart in charts]
        cells.reset(self._position)
        return found

    def _piece(self, values: Values, series: Series) -> Piece:
        columns = [self._numbers(values, ref) for ref in (series.x, series.y)]
        points = np.column_stack(columns)
        points[~np.isfinite(points).all(axis=1)] = math.nan
        return Piece(series, points, _words(values, series.name))

    def _numbers(self, values: Values, ref: SeriesRef) -> Points:
        """The numbers of a series; a row that stands after the sweep belongs to no curve."""
        area, plan = ref.area, self.sample.plan
        last = area.last_row
        if (area.first_row, area.last_row) == (plan.at.first, plan.at.last):
            last = area.first_row + self.sample.sweep - 1
        return values.arrays(ref.sheet, area.first_col, area.first_row, last)[0]


def _shown(chart: Chart) -> list[Series]:
    """The series of a chart without those that come again later: programs that draw the other way round need both."""
    return [series for index, series in enumerate(chart.series) if series not in chart.series[index + 1 :]]


def _words(values: Values, name: str | CellRef) -> str:
    if isinstance(name, str):
        return name
    value = values.get(name.sheet or "", name.row, name.col)
    return "" if value is None or isinstance(value, ErrorValue) else str(value)


def comes_round(first: Scene, last: Scene) -> bool:
    """True when the last position of a sweep looks like the first: an animation can go on from there."""
    drawn = ((a, b) for a, b in zip(first.items, last.items, strict=True) if not isinstance(a, Label))
    pairs = [(places_of(a), places_of(b)) for a, b in drawn]
    return all(np.allclose(a, b, rtol=0, atol=CLOSED * first.window.half, equal_nan=True) for a, b in pairs)


def without_caption(scene: Scene, scaled: bool) -> list[Item]:
    """What is drawn where the caption stands below. `scaled`: with the bar of lengths; where arrows have bars, too, all of
    them are needed to tell which is which."""
    bars = sum(item.kind == "scale" and isinstance(item, Stroke) for item in scene.items)
    besides = ("caption",) if bars > 1 or scaled else ("caption", "scale")
    return [item for item in scene.items if item.kind not in besides]


def extent(items: Sequence[Item], window: Window) -> tuple[Points, Points]:
    """The lower left and the upper right corner of what is drawn in the window."""
    found = []
    for item in items:
        half = half_box(item.text, item.size) * window.half if isinstance(item, Label) else np.zeros(2)
        found += [places_of(item) - half, places_of(item) + half]
    places, middle = np.concatenate(found), np.array([window.x, window.y])
    low, high = np.nanmin(places, axis=0), np.nanmax(places, axis=0)
    around = AROUND * window.half
    return np.maximum(low, middle - window.half) - around, np.minimum(high, middle + window.half) + around


def journey(stage: Stage, most: int) -> tuple[list[int], bool]:
    """Rows of an animation in order, from the row shown on, at most `most` of them, and whether the sweep comes round.

    Positions that do not exist are left out. A sweep that does not come round is run to and fro.
    """
    sample = stage.sample
    rows = [row for row in range(sample.sweep) if sample.exists[row]]
    if len(rows) < 2:
        return rows, False
    whole = len(rows) == sample.sweep
    closed = whole and comes_round(stage.drawing(rows[0]), stage.drawing(rows[-1]))
    every = math.ceil((len(rows) - 1) / (most if closed else most // 2))
    chosen = rows[:-1:every] if closed else [*rows[:-1:every], rows[-1]]
    if not closed:
        chosen += chosen[-2:0:-1]
    start = min(range(len(chosen)), key=lambda index: abs(chosen[index] - sample.shown))
    return chosen[start:] + chosen[:start], closed

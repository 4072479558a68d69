"""What the chart of a workbook with the drawing shows, at any position and with any dimensions, as its cells have it."""

from itertools import combinations, pairwise

import numpy as np

from livesheet.evaluation import live
from mechsheet.compiled import Compiled
from mechsheet.description import Overrides, loads
from mechsheet.shapes.colors import PATHS
from mechsheet.sheet.drawing.drawing import DRAWING_INNER

POINTS_OF_A_PIXEL = 0.75
NEAR = 0.01
"""How densely places of a line are looked at, in half windows."""


class Drawn:
    """The drawing of a workbook at any position, as its cells have it."""

    def __init__(self, text, **options):
        self.compiled = Compiled(loads(text, overrides=Overrides(**options)))
        self.plan = self.compiled.plan
        self.cells = live(self.compiled.layout, often=True)
        self.chart = next(
            each for sheet in self.compiled.layout.sheets for each in sheet.charts if each.name == "drawing"
        )
        self.half = self.chart.anchor.width * DRAWING_INNER[2] * POINTS_OF_A_PIXEL / 2

    def at(self, row):
        """(series, points, words) of all series."""
        spot = self.plan.places.position
        self.cells.set((self.cells.plan.layout.sheets[spot.sheet], spot.row, spot.col), float(row))
        values = self.cells.asked()
        for series in self.chart.series:
            columns = [
                values.arrays(ref.sheet, ref.area.first_col, ref.area.first_row, ref.area.last_row)[0]
                for ref in (series.x, series.y)
            ]
            name = series.name
            words = name if isinstance(name, str) else values.get(name.sheet, name.row, name.col)
            yield series, np.column_stack(columns), str(words)

    def box(self, series, place, words):
        """Left, right, low, high of the letters themselves in the window; a text stands in the middle of its height."""
        from matplotlib.font_manager import FontProperties
        from matplotlib.textpath import TextPath

        found = TextPath((0, 0), words, prop=FontProperties(family="DejaVu Sans", size=series.label_size)).get_extents()
        wide, high = found.width / self.half, found.height / self.half
        left = place[0] if series.label_side == "right" else place[0] - wide / 2
        return left, left + wide, place[1] - high / 2, place[1] + high / 2

    def conflicts(self, row):
        """What lies on what."""
        boxes, lines, rings = [], [], []
        for series, points, words in self.at(row):
            there = np.isfinite(points).all(axis=1)
            if series.show_name and there[0] and words:
                boxes.append((words, self.box(series, points[0], words), isinstance(series.name, str)))
            elif series.line and series.line not in PATHS:
                lines += [(words, places) for places in _dots(points)]
            elif series.marker:
                radius = series.marker_size / 2 / self.half
                rings += [(place, radius) for place in points[there]]
        for (one, a, _), (other, b, _) in combinations(boxes, 2):
            if a[0] < b[1] and b[0] < a[1] and a[2] < b[3] and b[2] < a[3]:
                yield one, other
        for words, (left, right, low, high), is_name in boxes:
            for line, places in lines if is_name else ():
                if ((places > (left, low)) & (places < (right, high))).all(axis=1).any():
                    yield words, line
            for place, radius in rings if is_name else ():
                near = np.clip(place, (left, low), (right, high))
                if np.hypot(*(near - place)) < radius:
                    yield words, "ring"


def _dots(points):
    for start, end in pairwise(points):
        if np.isfinite(start).all() and np.isfinite(end).all():
            count = int(np.ceil(np.hypot(*(end - start)) / NEAR)) + 1
            yield start + (end - start) * np.linspace(0, 1, count)[:, None]

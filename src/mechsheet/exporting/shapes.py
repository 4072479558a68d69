"""What the drawing shows at a position, in the mechanism's own length unit: for files that other programs draw.

The shapes are those of the workbook's drawing, computed by the engine; here only its window is taken back, so that a length
of 70 mm is 70 long.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechsheet.diagnostics import Fault, MechanismError, MechsheetError
from mechsheet.exporting.job import Job
from mechsheet.plotting.figures import BESIDE, PIXELS, SIDES
from mechsheet.plotting.sampling import LEAST, sample
from mechsheet.plotting.scenes import Piece, Stage
from mechsheet.said import say
from mechsheet.sheet.drawing.drawing import SIZE
from mechsheet.sheet.workbook import Series

Points = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class Stroke:
    """A line through `points` (n, 2); `width` in points of a printer, `color` as RRGGBB."""

    name: str
    points: Points
    color: str
    width: float


@dataclass(frozen=True, slots=True)
class Disc:
    """A circle; `fill` and `line` as RRGGBB, or ""."""

    x: float
    y: float
    radius: float
    fill: str
    line: str


@dataclass(frozen=True, slots=True)
class Label:
    """A text at (x, y), `height` high; `side` says on which side of the place it stands."""

    x: float
    y: float
    text: str
    height: float
    side: str


Shape = Stroke | Disc | Label


@dataclass(frozen=True, slots=True)
class Drawn:
    """One position: shapes from back to front, the points by name, the square window (middle, half side)."""

    shapes: tuple[Shape, ...]
    points: dict[str, tuple[float, float]]
    middle: tuple[float, float]
    half: float
    title: str
    unit: str


def drawings(job: Job) -> Iterator[Drawn]:
    """The positions that a job asks for. Raises MechanismError where there is none."""
    mechanism = job.mechanism
    found = sample(mechanism, job.at, None, max(LEAST, job.frames or 0))
    if not any(found.exists):
        raise MechanismError(Fault(say("no position of the sweep exists"), key="driver"))
    rows = [found.shown]
    if job.frames:
        there = [row for row in range(found.sweep) if found.exists[row]]
        if job.frames > len(there):
            fault = say(
                "{frames} frames: the sweep has 1 position to draw"
                if len(there) == 1
                else "{frames} frames: the sweep has {count} positions to draw",
                frames=job.frames,
                count=len(there),
            )
            raise MechsheetError(Fault(fault, key="frames"))
        rows = [there[round(place)] for place in np.linspace(0, len(there) - 1, job.frames).tolist()]
    stage = Stage(found)
    for row in rows:
        yield _drawn(stage, row)


def _drawn(stage: Stage, row: int) -> Drawn:
    found = stage.sample
    x, y, half = (found.number(found.plan.window[key], row) for key in ("x", "y", "half"))
    shapes = [shape for piece in stage.drawing(row) for shape in _shapes(piece, np.array([x, y]), half)]
    mechanism, language = found.plan.mechanism, found.plan.language
    names = dict.fromkeys(point for link in mechanism.links for point in link.points)
    spots = found.plan.at.spots
    points = {name: (found.number(spots[f"{name}.x"], row), found.number(spots[f"{name}.y"], row)) for name in names}
    return Drawn(tuple(shapes), points, (x, y), half, mechanism.title.of(language), mechanism.length_unit)


def _shapes(piece: Piece, middle: Points, half: float) -> Iterator[Shape]:
    """The shapes of one series."""
    series = piece.series
    places = piece.points * half + middle
    places = places[np.isfinite(places).all(axis=1)]
    pixel = 2 * half / SIZE
    if not len(places):
        return
    if series.line:
        yield Stroke(piece.words, places, series.line, series.width)
    if series.marker:
        radius = series.marker_size * PIXELS / 2 * pixel
        line = "" if series.marker_line == series.marker_fill else series.marker_line
        for x, y in places.tolist():
            yield Disc(x, y, radius, series.marker_fill, line)
    if series.show_name and piece.words:
        x, y = (places[0] + _beside(series) * pixel).tolist()
        yield Label(x, y, piece.words, series.label_size * PIXELS * pixel, series.label_side)


def _beside(series: Series) -> Points:
    """How far from its marker a label stands, in pixels; y upwards."""
    if not series.marker:
        return np.zeros(2)
    across, down = SIDES[series.label_side]
    return np.array([across, -down]) * (series.marker_size * PIXELS / 2 + BESIDE)

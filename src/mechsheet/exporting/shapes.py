"""A mechanism at the positions that an export asks for, from the list of shapes: for files that other programs draw."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechanismError, MechsheetError
from mechsheet.exporting.job import Job
from mechsheet.plotting.sampling import LEAST, sample
from mechsheet.shapes.names import POINTS
from mechsheet.shapes.positions import Positions, Scene


@dataclass(frozen=True, slots=True)
class Drawn:
    """One position, in the mechanism's own length unit: the scene, and all points by name."""

    scene: Scene
    points: dict[str, tuple[float, float]]
    title: str
    unit: str

    def length(self, points: float) -> float:
        """So many points of a printer, in the length unit."""
        return points * self.scene.window.half / POINTS


def drawings(job: Job) -> Iterator[Drawn]:
    """The positions that a job asks for. Raises MechanismError where there is none."""
    mechanism = job.mechanism
    fine = len(job.compiled.driver) if mechanism.cam is not None else 0  # a profile is as fine as its rows
    found = sample(mechanism, job.at, None, max(LEAST, job.frames or 0, fine))
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
    positions = Positions(found)
    names = dict.fromkeys(point for link in mechanism.links for point in link.points)
    columns = {name: (found.values[f"{name}.x"], found.values[f"{name}.y"]) for name in names}
    title = mechanism.title.of(mechanism.language)
    for row in rows:
        points = {name: (float(x[row]), float(y[row])) for name, (x, y) in columns.items()}
        yield Drawn(positions.at(row), points, title, mechanism.length_unit)

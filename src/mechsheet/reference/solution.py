"""Positions of a mechanism over a sweep, as they were found: where every link, point and slide is."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..model import Joint, Mechanism
from . import geometry
from .branches import Mask
from .expressions import number
from .geometry import Array
from .system import System, residual


@dataclass(frozen=True, slots=True)
class Solution:
    """Positions of a mechanism over n driver values. Lengths in the file's unit, angles in radians.

    driver         (n,) the driver's values
    exists         (n,) whether the links can be joined there on the chosen branches, in one determined position
    undetermined   (n,) whether the row has no numbers because some link can move with the driver held
    poses          link → (n, 3): x, y of its frame's origin and its angle, continuous over the rows that exist; NaN else
    displacements  symbol of each sliding joint → (n,)
    points         point → (n, 2) in the ground frame
    residual       (n,) worst residual of all constraints, as a length (angles times `size`)
    size           characteristic length, to measure errors by
    system, state  the constraints, and the poses (n, columns) in their own lengths: what further analyses start from
    reached        the same poses, and in rows that do not exist those that come before the loop that cannot be closed;
                   angles there may be whole turns away
    """

    mechanism: Mechanism
    dimensions: Mapping[str, float]
    driver: Array
    exists: Mask
    undetermined: Mask
    poses: Mapping[str, Array]
    displacements: Mapping[str, Array]
    points: Mapping[str, Array]
    residual: Array
    size: float
    system: System
    state: Array
    reached: Array


def reached(solution: Solution) -> dict[str, Array]:
    """The variables without the outputs, and in rows that do not exist those that are decided before it comes to that."""
    return motion_of(solution, *_places(solution.system, solution.reached))


def motion_of(
    solution: Solution, poses: Mapping[str, Array], displacements: Mapping[str, Array], points: Mapping[str, Array]
) -> dict[str, Array]:
    """Every variable by its symbol: angles and displacements, the driver, `P.x`, `P.y` of each point."""
    found: dict[str, Array] = {}
    for link in solution.mechanism.links[1:]:
        found[link.angle_symbol] = poses[link.name][:, 2]
    found.update(displacements)
    driver = solution.mechanism.driver
    for place, other in zip(solution.system.prescribed, solution.mechanism.drivers, strict=True):
        scale = solution.system.scale if other.joint else 1.0
        found.setdefault(other.symbol, solution.state[:, place] * scale)
    found[driver.symbol] = solution.driver
    for point, places in points.items():
        found[f"{point}.x"], found[f"{point}.y"] = places[:, 0], places[:, 1]
    return found


def over_all_rows(solution: Solution, rows: NDArray[np.intp], values: Array) -> Array:
    """A column (n,) with values in some rows, NaN in the others."""
    column = np.full(len(solution.driver), np.nan)
    column[rows] = values
    return column


def solution_of(
    built: System, driver: Array, value: Array, state: Array, reached: Array, alive: Mask, undetermined: Mask
) -> Solution:
    """What states of a system say; NaN in rows that are not alive."""
    worst = np.zeros(len(driver))
    for equation in built.equations:
        worst = np.maximum(worst, np.abs(residual(equation, state, value)[0]))
    worst[~alive] = np.nan
    poses, slides, points = _places(built, state)
    for each in (*poses.values(), *points.values()):
        each[~alive] = np.nan
    return Solution(
        mechanism=built.mechanism,
        dimensions=built.dimensions,
        driver=driver,
        exists=alive,
        undetermined=undetermined,
        poses=poses,
        displacements=slides,
        points=points,
        residual=worst * built.scale,
        size=geometry.size(built.mechanism, built.dimensions),
        system=built,
        state=state,
        reached=reached,
    )


def poses_of(built: System, state: Array) -> dict[str, Array]:
    """By link (n, 3): x and y of its frame's origin in the file's unit, and its angle."""
    found = {}
    for name in built.bodies:
        first = built.column(name)
        pose = state[:, first : first + 3] * [built.scale, built.scale, 1.0]
        if first:
            pose[:, :2] += built.origin
        found[name] = pose
    return found


def _places(built: System, state: Array) -> tuple[dict[str, Array], dict[str, Array], dict[str, Array]]:
    """Poses by link, displacements by symbol, places by point, in the file's unit."""
    mechanism = built.mechanism
    owners = {point: link.name for link in reversed(mechanism.links) for point in link.points}
    points = {
        point: point_positions(built, owners[point], point, state) * built.scale + built.origin
        for point in dict.fromkeys(p for link in mechanism.links for p in link.points)
    }
    slides = {joint.symbol: displacement(built, joint, state) * built.scale for joint in mechanism.joints}
    return poses_of(built, state), slides, points


def point_positions(system: System, link: str, point: str, states: Array) -> Array:
    """Places (m, 2) of a link's point, in the system's own lengths from its own origin."""
    first = system.column(link)
    x, y = system.points[link][point] / system.scale
    return _moved(system, first, states, x, y)


def _moved(system: System, first: int, states: Array, x: float, y: float) -> Array:
    """Places (m, 2) of (x, y) in the frame of the body whose columns begin at `first`."""
    c, s = np.cos(states[:, first + 2]), np.sin(states[:, first + 2])
    moved = states[:, first : first + 2] + np.stack([c * x - s * y, s * x + c * y], axis=1)
    return np.asarray(moved - system.origin / system.scale if first == 0 else moved)


def displacement(system: System, joint: Joint, states: Array, link: str = "") -> Array:
    """Displacement (m,) of a sliding joint, in the system's own lengths; `link` is another link that has its point."""
    first = system.column(joint.on)
    x, y = geometry.through(joint, system.points, system.dimensions) / system.scale
    theta = states[:, first + 2]
    line = _moved(system, first, states, x, y)
    direction = theta + number(joint.angle, system.dimensions)
    away = point_positions(system, link or joint.link, joint.point, states) - line
    return np.asarray(np.cos(direction) * away[:, 0] + np.sin(direction) * away[:, 1])

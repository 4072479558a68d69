"""The profile of a cam from the poses of its follower and their rates, as curves in the complex plane of the cam.

A roller's centre P goes along z = P exp(-i s phi), s = 1 for a cam that turns counter-clockwise, else -1; its curve has the
curvature Im(conj(z') z'')/|z'|^3. A flat face is a family of lines Re(conj(n) X) = p; its envelope also fulfils the
derivative of that by the cam's angle, two linear equations for X, and its rate two more.
Source: any text on plane curves; nothing is taken from the workbook's formulas.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..model import Cam, FurtherDriver, Mechanism, Quantity, touched_by
from .expressions import number
from .geometry import Array
from .rates import by_prescribed, rates
from .solution import Solution

_REST = 1e-9
"""A point that moves by less than this part of the size in a radian of the follower, or of the follower's way, shows no
direction."""

_STRAIGHT = 1e-9
"""A curvature below this part of one over the size is that of a straight line."""

Plane = NDArray[np.complex128]


@dataclass(frozen=True, slots=True)
class Profile:
    """Of a cam: its columns by their names (n,); where it presses, and in which direction, in the ground's frame."""

    columns: dict[str, Array]
    at: Plane
    normal: Plane


def profile(solution: Solution, cam: Cam) -> Profile:
    """The profile, row by row."""
    known = rates(solution)
    sense = -1.0 if cam.clockwise else 1.0
    turn = np.exp(-1j * sense * solution.driver)
    center = _complex(solution.points[cam.center])
    place = _complex(solution.points[cam.point]) - center
    once, twice = (known[f"{cam.point}.x"][order] + 1j * known[f"{cam.point}.y"][order] for order in (0, 1))
    curve = place * turn
    first = (once - 1j * sense * place) * turn
    second = (twice - 2j * sense * once - place) * turn
    with np.errstate(all="ignore"):
        if cam.radius is None:
            columns, contact, normal = _of_face(solution, cam, known, curve, first, second, turn)
        else:
            columns, contact, normal = _of_roller(solution, cam, known, curve, first, second, turn)
        return Profile(columns, contact / turn + center, normal / turn)


def _of_roller(
    solution: Solution,
    cam: Cam,
    known: dict[str, tuple[Array, Array]],
    z: Plane,
    first: Plane,
    second: Plane,
    turn: Plane,
) -> tuple[dict[str, Array], Plane, Plane]:
    sense = -1.0 if cam.clockwise else 1.0
    radius = number(cam.radius or 0.0, solution.dimensions)
    kappa = -sense * (np.conj(first) * second).imag / np.abs(first) ** 3
    normal = 1j * sense * first / np.abs(first)
    outline = z - radius * normal
    rho = np.where(np.abs(kappa) * solution.size < _STRAIGHT, np.nan, 1.0 / kappa - radius)
    way = _way(solution, cam, z / turn)
    columns = {
        "pitch.x": z.real, "pitch.y": z.imag, "cam.x": outline.real, "cam.y": outline.imag, "kappa": kappa, "rho": rho,
        "alpha": sense * _between(way, normal / turn),
    }  # fmt: skip
    if cam.offset is not None:
        columns["base"] = _base(solution, cam, known, z / turn, way / np.abs(way))
    return columns, z, normal


def _base(solution: Solution, cam: Cam, known: dict[str, tuple[Array, Array]], place: Plane, way: Plane) -> Array:
    """The base circle with which the normal would lean by the usual angle: along the way it has u, across it e + s' of this
    cam's sense."""
    roller, usual, radius = (
        number(each or 0.0, solution.dimensions) for each in (cam.radius, cam.pressure_angle, cam.base_radius)
    )
    once = known[f"{cam.point}.x"][0] + 1j * known[f"{cam.point}.y"][0]
    u, e = (np.conj(way) * place).real, (np.conj(way) * place).imag
    across = np.abs(e + (-1.0 if cam.clockwise else 1.0) * (np.conj(way) * once).real)
    begun = np.sqrt((radius + roller) ** 2 - e**2)
    return np.asarray(np.hypot(np.maximum(0.0, begun + across / math.tan(usual) - np.abs(u)), e) - roller)


def _of_face(
    solution: Solution,
    cam: Cam,
    known: dict[str, tuple[Array, Array]],
    z: Plane,
    first: Plane,
    second: Plane,
    turn: Plane,
) -> tuple[dict[str, Array], Plane, Plane]:
    sense = -1.0 if cam.clockwise else 1.0
    link = solution.mechanism.link(cam.follower)
    once, twice = known[link.angle_symbol]
    angle = solution.poses[cam.follower][:, 2] + number(cam.face, solution.dimensions)
    turning = once - sense
    n = 1j * np.exp(1j * angle) * turn
    n1, n2 = 1j * turning * n, (1j * twice - turning**2) * n
    p = (np.conj(n) * z).real
    p1 = (np.conj(n1) * z + np.conj(n) * first).real
    p2 = (np.conj(n2) * z + 2.0 * np.conj(n1) * first + np.conj(n) * second).real
    point = _solved(n, n1, p, p1)
    moved = _solved(n, n1, np.zeros_like(p), p2 - (np.conj(n2) * point).real)
    rho = (moved * np.conj(1j * n)).real / turning
    contact = ((point - z) * np.conj(-1j * n)).real
    way = _way(solution, cam, point / turn)
    columns = {
        "cam.x": point.real, "cam.y": point.imag, "contact": contact, "rho": rho * np.sign(p),
        "alpha": sense * _between(way, n / turn),
    }  # fmt: skip
    return columns, point, n * np.sign(p)


def _solved(n: Plane, n1: Plane, p: Array, p1: Array) -> Plane:
    """X of Re(conj(n) X) = p and Re(conj(n1) X) = p1."""
    det = n.real * n1.imag - n.imag * n1.real
    x, y = (p * n1.imag - p1 * n.imag) / det, (n.real * p1 - n1.real * p) / det
    return _complex(np.stack([x, y], axis=1))


def _way(solution: Solution, cam: Cam, place: Plane) -> Plane:
    """The direction in which the follower moves a place of its own, seen from the cam's centre: at a dwell, too."""
    mechanism = solution.mechanism
    moved = mechanism.follower
    touching = touched_by(cam, mechanism.links)
    assert moved is not None and touching is not None
    line = _line(mechanism, moved, touching.name)
    if line is not None:
        return np.full(len(place), np.exp(1j * number(line, solution.dimensions)))
    center = _complex(solution.points[cam.center])
    ground = mechanism.ground
    if moved.link == touching.name and moved.relative_to == ground.name:
        pivot = next(point for point in touching.points if point in ground.points)
        return np.asarray(1j * (place + center - _complex(solution.points[pivot])))
    built, rows = solution.system, np.flatnonzero(solution.exists)
    column = built.prescribed[mechanism.drivers.index(moved)]
    moves = by_prescribed(built, solution.state[rows], column)
    first, pose = built.column(touching.name), solution.poses[touching.name]
    way = np.full(len(place), np.complex128(np.nan))
    scale = 1.0 if moved.joint else built.scale
    x, y, turn = (moves[:, first + part] for part in range(3))
    arm = (place + center - _complex(pose))[rows]
    way[rows] = (x + 1j * y) * scale + 1j * turn * arm / (built.scale if moved.joint else 1.0)
    return np.where(np.abs(way) < _REST * (1.0 if moved.joint else solution.size), np.complex128(np.nan), way)


def _line(mechanism: Mechanism, moved: FurtherDriver, touching: str) -> Quantity | None:
    """The direction of the slide on the ground that is driven, where it carries what the cam touches."""
    joint = next((one for one in mechanism.joints if one.name == moved.joint), None)
    if joint is None or joint.kind != "prismatic" or {joint.link, joint.on} != {touching, mechanism.ground.name}:
        return None
    return joint.angle if joint.on == mechanism.ground.name else None


def _between(way: Plane, normal: Plane) -> Array:
    """The angle from one direction to the other, either way along each: within a quarter turn."""
    angle = np.angle(normal * np.conj(way))
    return np.asarray(angle - np.pi * np.round(angle / np.pi))


def _complex(points: Array) -> Plane:
    return np.asarray(points[:, 0] + 1j * points[:, 1])

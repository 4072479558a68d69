"""A body guided through three poses by two cranks: circles through three points, and two vectors that are unknown.

A pose is the place P of the body's own origin and its angle; a point of the body is named by where it is at the first.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

SINGULAR = 1e-12
"""What of their product is left of two vectors that point the same way, or of a determinant that is none."""
NAN = complex(math.nan, math.nan)


@dataclass(frozen=True)
class Crank:
    """A crank that guides the body: its fixed pivot, its moving one at the first pose, and its turns from there, radians."""

    fixed: complex
    moving: complex
    turns: tuple[float, float]

    @property
    def length(self) -> float:
        """Between its pivots."""
        return abs(self.moving - self.fixed)

    @property
    def exists(self) -> bool:
        """Whether the task has a solution."""
        return cmath.isfinite(self.fixed) and cmath.isfinite(self.moving)


NO_CRANK = Crank(NAN, NAN, (math.nan, math.nan))


@dataclass(frozen=True)
class Pose:
    """Where the body's origin is, as x + iy, and how the body is turned, radians."""

    place: complex
    angle: float


def carried(poses: Sequence[Pose], point: complex) -> list[complex]:
    """Where a point of the body, named by its place at the first pose, is at each pose."""
    first = poses[0]
    return [pose.place + (point - first.place) * cmath.exp(1j * (pose.angle - first.angle)) for pose in poses]


def seen(poses: Sequence[Pose], point: complex) -> list[complex]:
    """Where a point of the ground appears from the body at each pose, drawn at its first pose."""
    first = poses[0]
    return [first.place + (point - pose.place) * cmath.exp(1j * (first.angle - pose.angle)) for pose in poses]


def centre(points: Sequence[complex]) -> complex:
    """The centre of the circle through three points, equally far from all, linear; NaN for points on a line."""
    first, second, third = points
    sides = np.array(
        [[second.real - first.real, second.imag - first.imag], [third.real - first.real, third.imag - first.imag]]
    )
    squares = np.sum(sides**2, axis=1)
    if not abs(np.linalg.det(sides)) > SINGULAR * max(squares.max(), abs(second - third) ** 2):
        return NAN
    x, y = np.linalg.solve(sides, squares / 2)
    return first + complex(x, y)


def by_moving(poses: Sequence[Pose], moving: complex) -> Crank:
    """The crank that holds a point of the body: its pivot is the centre of the circle through the point's three places."""
    fixed = centre(carried(poses, moving))
    return _crank(poses, fixed, moving)


def by_fixed(poses: Sequence[Pose], fixed: complex) -> Crank:
    """The crank about a point of the ground: seen from the body that point moves on a circle about the crank's end."""
    moving = centre(seen(poses, fixed))
    return _crank(poses, fixed, moving)


def by_turns(poses: Sequence[Pose], turns: tuple[float, float]) -> Crank:
    """The crank that turns by given angles: W (e^(i beta) - 1) + Z (e^(i alpha) - 1) = P - P1 at the second and third pose.

    Source: R. L. Norton, Design of Machinery, section 5.7 (the standard form of a dyad).
    """
    first = poses[0]
    rows = [
        [cmath.exp(1j * beta) - 1, cmath.exp(1j * (pose.angle - first.angle)) - 1]
        for beta, pose in zip(turns, poses[1:], strict=True)
    ]
    matrix = np.array(rows)
    if not abs(np.linalg.det(matrix)) > SINGULAR * float(np.abs(matrix).max() ** 2):
        return NO_CRANK
    arm, rest = np.linalg.solve(matrix, np.array([pose.place - first.place for pose in poses[1:]]))
    moving = first.place - complex(rest)
    return Crank(moving - complex(arm), moving, turns)


def _crank(poses: Sequence[Pose], fixed: complex, moving: complex) -> Crank:
    if not (cmath.isfinite(fixed) and cmath.isfinite(moving)):
        return Crank(fixed, moving, (math.nan, math.nan))
    at = carried(poses, moving)
    second, third = (cmath.phase((place - fixed) / (at[0] - fixed)) if at[0] != fixed else math.nan for place in at[1:])
    return Crank(fixed, moving, (second, third))

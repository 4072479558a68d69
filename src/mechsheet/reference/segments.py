"""How a follower moves over the angle of its cam: f'' of each law, integrated twice.

Derived here once more, so that nothing is taken from the description's own formulas: a law says how f'' goes, piece by
piece; f' and f follow by Gauss's quadrature, f''' by a complex step.
Source of the laws: R. L. Norton, Design of Machinery, chapter 8.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..model import Segments
from .expressions import number

Array: TypeAlias = NDArray[np.float64]
_Piece: TypeAlias = tuple[float, Callable[[Any], Any]]

_MEETING = 1e-9
"""At an angle [rad] at which segments meet, and so far behind it, the earlier one counts; within a law likewise."""

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(24)
"""Enough for half a wave of a sine, to the last digit."""

_STEP = 1e-30
_TRAPEZOID = 8.0 * np.pi / (2.0 + np.pi)
_SINE = 4.0 * np.pi**2 / (4.0 + np.pi)


def _mirrored(*half: _Piece) -> list[_Piece]:
    """The whole law of which these are the pieces up to the middle: f'' of the second half is its opposite, seen from
    behind."""
    ends = [0.0, *(end for end, _ in half)]
    behind = [
        (1.0 - start, lambda x, acceleration=acceleration: -acceleration(1.0 - x))
        for start, (_, acceleration) in zip(ends[-2::-1], half[::-1], strict=True)
    ]
    return [*half, *behind]


_LAWS: Mapping[str, tuple[float, list[_Piece]]] = {
    "dwell": (0.0, [(1.0, lambda x: 0.0 * x)]),
    "uniform": (1.0, [(1.0, lambda x: 0.0 * x)]),
    "parabolic": (0.0, [(0.5, lambda x: 4.0 + 0.0 * x), (1.0, lambda x: -4.0 + 0.0 * x)]),
    "harmonic": (0.0, [(1.0, lambda x: np.pi**2 / 2.0 * np.cos(np.pi * x))]),
    "cycloidal": (0.0, [(1.0, lambda x: 2.0 * np.pi * np.sin(2.0 * np.pi * x))]),
    "3-4-5": (0.0, [(1.0, lambda x: 60.0 * x - 180.0 * x**2 + 120.0 * x**3)]),
    "4-5-6-7": (0.0, [(1.0, lambda x: 420.0 * x**2 - 1680.0 * x**3 + 2100.0 * x**4 - 840.0 * x**5)]),
    "modified trapezoid": (
        0.0,
        _mirrored(
            (0.125, lambda x: _TRAPEZOID * np.sin(4.0 * np.pi * x)),
            (0.375, lambda x: _TRAPEZOID + 0.0 * x),
            (0.5, lambda x: _TRAPEZOID * np.cos(4.0 * np.pi * (x - 0.375))),
        ),
    ),
    "modified sine": (
        0.0,
        _mirrored(
            (0.125, lambda x: _SINE * np.sin(4.0 * np.pi * x)),
            (0.5, lambda x: _SINE * np.sin(4.0 * np.pi * x / 3.0 + np.pi / 3.0)),
        ),
    ),
}
"""f' at the beginning, and f'' with the end of each piece."""


def law(name: str, x: Array) -> tuple[Array, Array, Array, Array]:
    """f, f', f'' and f''' of a law at parts (m,) of its segment."""
    first, pieces = _LAWS[name]
    f, f1, f2, f3 = (np.zeros_like(x) for _ in range(4))
    begin, way, speed = 0.0, 0.0, first
    for order, (end, acceleration) in enumerate(pieces):
        here = (x > begin + (_MEETING if order else -np.inf)) & (x <= end + (_MEETING if end < 1.0 else np.inf))
        at = x[here]
        moved, gained = _integrated(acceleration, begin, at)
        f[here], f1[here] = way + speed * (at - begin) + moved, speed + gained
        f2[here] = acceleration(at)
        f3[here] = acceleration(at + 1j * _STEP).imag / _STEP
        moved, gained = _integrated(acceleration, begin, np.array([end]))
        way, speed = float(way + speed * (end - begin) + moved[0]), float(speed + gained[0])
        begin = end
    return f, f1, f2, f3


def _integrated(acceleration: Callable[[Any], Any], begin: float, end: Array) -> tuple[Array, Array]:
    """The double and the single integral of f'' from the beginning of a piece: of (end - x) f''(x), of f''(x)."""
    half = (end - begin)[:, None] / 2.0
    x = begin + half * (1.0 + _POINTS)
    values = acceleration(x) * half * _WEIGHTS
    return ((end[:, None] - x) * values).sum(axis=1), values.sum(axis=1)


def motion(segments: Segments, dimensions: Mapping[str, float], angle: Array) -> tuple[Array, Array, Array, Array]:
    """The follower's value and its first three derivatives by the cam's angle, at angles (m,)."""
    begins = np.array([number(each.begins, dimensions) for each in segments.parts])
    over = np.array([number(each.over, dimensions) for each in segments.parts])
    if segments.closed:
        within = angle - 2.0 * np.pi * np.floor(angle / (2.0 * np.pi) + _MEETING)
    else:
        within = np.clip(angle, 0.0, begins[-1] + over[-1])
    which = np.searchsorted(begins[1:] + _MEETING, within, side="left")
    found = np.zeros((4, len(angle)))
    for place, each in enumerate(segments.parts):
        here = which == place
        by, lift = (number(node, dimensions) for node in (each.by, each.lift))
        ways = law(each.law, (within[here] - begins[place]) / over[place])
        for order, way in enumerate(ways):
            found[order, here] = by / over[place] ** order * way
        found[0, here] += lift
    found[0] += number(segments.start, dimensions)
    return found[0], found[1], found[2], found[3]

"""A four-bar whose output angle follows its input angle through given pairs: linear equations, and least squares.

With a2 and a4 signed, the loop a2 e^(i theta) + (coupler) = a1 + a4 e^(i psi), its coupler taken out by the squared
modulus, is linear in three unknowns (F. Freudenstein, Approximate synthesis of four-bar linkages, Trans. ASME 77, 1955):

    k1 cos psi - k2 cos theta + k3 = cos(theta - psi),    a2 = a1 / k1,  a4 = a1 / k2
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Angles: TypeAlias = Sequence[float] | NDArray[np.float64]
"""Radians, (n,)."""

SINGULAR = 1e-12
"""Smallest singular value of the equations, relative to the largest, from which on they say something about all three."""


@dataclass(frozen=True)
class FourBar:
    """A four-bar with its ground link on +x: A0 at 0, B0 at a1.

    a1, a2, a3, a4           lengths, in the unit of a1; NaN where there is no such mechanism
    theta_offset, psi_offset what is added to an angle of the task to get the link's own, radians: 0 or pi
    """

    a1: float
    a2: float
    a3: float
    a4: float
    theta_offset: float = 0.0
    psi_offset: float = 0.0

    @property
    def exists(self) -> bool:
        """Whether the task has a solution."""
        return all(map(math.isfinite, (self.a1, self.a2, self.a3, self.a4)))


NO_FOUR_BAR = FourBar(*[math.nan] * 6)


def equations(theta: Angles, psi: Angles) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Left-hand sides (n, 3) and right-hand sides (n,) of Freudenstein's equation for pairs of angles in radians."""
    at, to = np.asarray(theta, dtype=float), np.asarray(psi, dtype=float)
    return np.stack([np.cos(to), -np.cos(at), np.ones(len(at))], axis=1), np.cos(at - to)


def function(theta: Angles, psi: Angles, a1: float) -> FourBar:
    """The four-bar that meets three pairs of angles (radians), or fits more of them best in the equation's own error.

    No mechanism where the pairs do not determine the three unknowns, where a link would be infinitely long, and where
    the coupler's square is not positive.
    """
    left, right = equations(theta, psi)
    spread = np.linalg.svd(left, compute_uv=False)
    if len(right) < 3 or not spread[-1] > SINGULAR * spread[0]:
        return NO_FOUR_BAR
    solution = np.linalg.solve(left, right) if len(right) == 3 else np.linalg.lstsq(left, right, rcond=None)[0]
    k1, k2, k3 = map(float, solution)
    if min(abs(k1), abs(k2)) <= SINGULAR * max(abs(k1), abs(k2), 1.0):
        return NO_FOUR_BAR
    a2, a4 = a1 / k1, a1 / k2
    square = a1**2 + a2**2 + a4**2 - 2 * a2 * a4 * k3
    if not square > 0:
        return NO_FOUR_BAR
    return FourBar(
        a1,
        abs(a2),
        math.sqrt(square),
        abs(a4),
        math.pi if a2 < 0 else 0.0,
        math.pi if a4 < 0 else 0.0,
    )


def sides(found: FourBar, theta: Angles, psi: Angles) -> NDArray[np.float64]:
    """(n,) On which side of A→B0 the joint B lies at each pair: +1 right (psi grows clockwise of it), -1 left, 0 on it.

    +1 is the assembly in which A, B0, B go round counter-clockwise, as the workbook's modes count it.
    """
    a = found.a2 * np.exp(1j * (np.asarray(theta) + found.theta_offset))
    b = found.a1 + found.a4 * np.exp(1j * (np.asarray(psi) + found.psi_offset))
    return np.asarray(np.sign(((found.a1 - a).conjugate() * (b - a)).imag))


def chebyshev(first: float, last: float, points: int) -> NDArray[np.float64]:
    """(points,) The zeros of the Chebyshev polynomial of that degree, taken from -1..1 to first..last, in that order."""
    angles = (2 * np.arange(points, 0, -1) - 1) * np.pi / (2 * points)
    return (first + last) / 2 + (last - first) / 2 * np.cos(angles)

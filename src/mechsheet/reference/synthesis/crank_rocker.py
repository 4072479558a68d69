"""A crank-rocker by the swing of its rocker and the crank's turn meanwhile: its two dead centres as complex equations.

    (1 + lam) Z1 - Z2 = 1,    e^(i phi) (1 - lam) Z1 - Z2 e^(i psi) = 1

where Z1 and Z2 are the crank and the rocker at the outer dead centre in lengths of the fixed link, and lam = a3 / a2.
Source: E. Söylemez, Mechanisms, section 7.1, "The classical transmission angle problem", equations 7 to 12.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

FROM, TO = 1.0005, 400.0
"""The lam among which a best one is looked for."""
_PLACES = 2000
_GOLDEN = (math.sqrt(5) - 1) / 2
_STEP, _CLOSE = 5e-3, 1e-5


@dataclass(frozen=True)
class CrankRocker:
    """Lengths in the unit of a1, lam = a3 / a2, and the least transmission angle of a turn, radians.

    mu_min is NaN where the two dead centres lie on both sides of the fixed link, which no assembly passes: then the lengths
    satisfy the equations and the mechanism does not have the swing. It has for lam < (1 + m) / (1 - m), where m is the
    smaller of u and 1/u, u = -cos(phi - psi/2) / cos(psi/2).
    """

    a1: float
    a2: float
    a3: float
    a4: float
    lam: float
    mu_min: float

    @property
    def exists(self) -> bool:
        """Whether the task has a solution."""
        return all(map(math.isfinite, (self.a2, self.a3, self.a4)))


NO_CRANK_ROCKER = CrankRocker(*[math.nan] * 6)


def crank_turn(time_ratio: float) -> float:
    """phi of a time ratio, radians: the crank's turn over that of the whole return."""
    return math.pi * 2 * time_ratio / (time_ratio + 1)


def by_lam(psi: float, phi: float, a1: float, lam: float) -> CrankRocker:
    """The crank-rocker with coupler and crank in the ratio lam; psi and phi in radians."""
    if not (math.isfinite(lam) and lam > 1 and in_domain(psi, phi)):
        return NO_CRANK_ROCKER
    crank, rocker = outer(psi, phi, lam)
    a2, a4 = a1 * abs(crank), a1 * abs(rocker)
    together = rocker.imag * (rocker * cmath.exp(1j * psi)).imag > 0
    return CrankRocker(a1, a2, lam * a2, a4, lam, least_transmission(a1, a2, lam * a2, a4) if together else math.nan)


def outer(psi: float, phi: float, lam: float) -> tuple[complex, complex]:
    """Z1 and Z2: crank and rocker at the outer dead centre, in lengths of the fixed link."""
    left = np.array([[1 + lam, -1], [cmath.exp(1j * phi) * (1 - lam), -cmath.exp(1j * psi)]])
    crank, rocker = np.linalg.solve(left, np.array([1, 1]))
    return complex(crank), complex(rocker)


def by_crank(psi: float, phi: float, a1: float, a2: float) -> CrankRocker:
    """The crank-rocker with a crank of length a2: lam by bisection, the crank shrinks while lam grows."""
    return by_lam(psi, phi, a1, meets(lambda lam: by_lam(psi, phi, a1, lam).a2, a2))


def best(psi: float, phi: float, a1: float) -> CrankRocker:
    """The crank-rocker whose least transmission angle is largest; none where that only grows with lam."""
    if not in_domain(psi, phi):
        return NO_CRANK_ROCKER
    return by_lam(psi, phi, a1, highest(lambda lam: by_lam(psi, phi, a1, lam).mu_min))


def in_domain(psi: float, phi: float) -> bool:
    """Whether a crank-rocker has this swing and turn: 90° + psi/2 < phi < 270° + psi/2."""
    return 0 < psi < math.pi and math.pi / 2 + psi / 2 < phi < 3 * math.pi / 2 + psi / 2


def least_transmission(a1: float, a2: float, a3: float, a4: float) -> float:
    """The smallest angle between the lines of coupler and rocker over a turn, radians; NaN where the crank has no turn."""
    angles = []
    for diagonal in (abs(a1 - a2), a1 + a2):
        cosine = (a3**2 + a4**2 - diagonal**2) / (2 * a3 * a4)
        if abs(cosine) > 1:
            return math.nan
        angles.append(math.acos(cosine))
    return min(*angles, *(math.pi - angle for angle in angles))


def meets(value: Callable[[float], float], wanted: float) -> float:
    """The lam from 1 to 1e9 at which a monotone value is `wanted`, by bisection of ln(lam - 1); else NaN."""
    left, right = math.log(1e-13), math.log(1e9)
    ends = [value(1.0 + math.exp(at)) - wanted for at in (left, right)]
    if not ends[0] * ends[1] < 0:
        return math.nan
    for _ in range(200):
        middle = (left + right) / 2
        if (value(1.0 + math.exp(middle)) - wanted) * ends[0] > 0:
            left = middle
        else:
            right = middle
    return 1.0 + math.exp((left + right) / 2)


def highest(value: Callable[[float], float]) -> float:
    """The lam at which an angle is largest, by golden section of ln lam; NaN where that is the last one.

    Near its largest value nothing changes but in half of the digits; the others are those at which its cosine stands still.
    """
    places = np.linspace(math.log(FROM), math.log(TO), _PLACES)
    values = [value(math.exp(at)) for at in places]
    if not np.any(np.isfinite(values)):
        return math.nan
    top = int(np.nanargmax(values))
    if top == _PLACES - 1:
        return math.nan
    left, right = places[max(top - 1, 0)], places[top + 1]
    for _ in range(80):
        inner, outer = right - _GOLDEN * (right - left), left + _GOLDEN * (right - left)
        if value(math.exp(inner)) > value(math.exp(outer)):
            right = outer
        else:
            left = inner
    return math.exp(_at_rest(lambda at: math.cos(value(math.exp(at))), (left + right) / 2))


def _at_rest(value: Callable[[float], float], near: float) -> float:
    """Where the derivative is 0, by bisection of a central difference of the eighth order; `near` where it has no sign."""

    def slope(at: float) -> float:
        pairs = ((value(at + n * _STEP) - value(at - n * _STEP)) for n in (1, 2, 3, 4))
        return sum(weight * pair for weight, pair in zip((672, -168, 32, -3), pairs, strict=True))

    left, right = near - _CLOSE, near + _CLOSE
    rising = slope(left) > 0
    if not slope(left) * slope(right) < 0:
        return near
    for _ in range(60):
        middle = (left + right) / 2
        if (slope(middle) > 0) == rising:
            left = middle
        else:
            right = middle
    return (left + right) / 2

"""Quick returns: an eccentric slider-crank and a slotted lever by their stroke and time ratio."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

from .crank_rocker import highest, meets


@dataclass(frozen=True)
class SliderCrank:
    """Crank a2, connecting rod a3 = lam a2, eccentricity c, in the unit of the stroke; least transmission angle, radians.

    mu_min is NaN where the slider does not reach both ends in one assembly: lam < 1 / tan(alpha / 2)^2 must hold.
    """

    a2: float
    a3: float
    c: float
    lam: float
    mu_min: float

    @property
    def exists(self) -> bool:
        """Whether the task has a solution."""
        return all(map(math.isfinite, (self.a2, self.a3, self.c)))


NO_SLIDER_CRANK = SliderCrank(*[math.nan] * 5)


def by_lam(stroke: float, time_ratio: float, lam: float) -> SliderCrank:
    """The slider-crank with rod and crank in the ratio lam.

    Seen from the crank's pivot the slider's ends are at lam + 1 cranks, and alpha = pi (t - 1) / (t + 1) round from it at
    lam - 1; the guide is the line through both, its distance the eccentricity.
    """
    alpha = math.pi * (time_ratio - 1) / (time_ratio + 1)
    if not (math.isfinite(lam) and lam > 1 and stroke > 0 and time_ratio > 0):
        return NO_SLIDER_CRANK
    far, near = complex(lam + 1), (lam - 1) * cmath.exp(1j * alpha)
    a2 = stroke / abs(near - far)
    c = (far.conjugate() * near).imag / abs(near - far) * a2
    # the near end must lie on the slider's side of the crank's pivot, or the slider never gets there
    turns = (near.conjugate() * (far - near)).real > 0
    return SliderCrank(a2, lam * a2, c, lam, math.acos((a2 + abs(c)) / (lam * a2)) if turns else math.nan)


def by_crank(stroke: float, time_ratio: float, a2: float) -> SliderCrank:
    """The slider-crank with a crank of length a2, which shrinks while lam grows."""
    return by_lam(stroke, time_ratio, meets(lambda lam: by_lam(stroke, time_ratio, lam).a2, a2))


def by_eccentricity(stroke: float, time_ratio: float, c: float) -> SliderCrank:
    """The slider-crank with eccentricity c, which grows with lam."""
    return by_lam(stroke, time_ratio, meets(lambda lam: by_lam(stroke, time_ratio, lam).c, c))


def best(stroke: float, time_ratio: float) -> SliderCrank:
    """The slider-crank whose least transmission angle is largest; none for a time ratio of 1."""
    return by_lam(stroke, time_ratio, highest(lambda lam: by_lam(stroke, time_ratio, lam).mu_min))


@dataclass(frozen=True)
class SlottedLever:
    """Distance of the fixed pivots and length of the lever, in the unit of the stroke, and half the swing, radians."""

    centre: float
    lever: float
    half_swing: float


def slotted_lever(stroke: float, time_ratio: float, crank: float) -> SlottedLever:
    """The crank and slotted lever (crank shaper): at the dead centres the lever touches the crank's circle.

    There the crank stands square to it, so between them it turns 2 pi / (1 + t) on the short way, and the lever the rest
    of half a turn. None for a time ratio of 1 or less.
    """
    if not time_ratio > 1:
        return SlottedLever(math.nan, math.nan, math.nan)
    touch = crank * cmath.exp(1j * math.pi / (1 + time_ratio))  # the fixed pivots on the real axis, the crank's at 0
    centre = abs(touch) ** 2 / touch.real
    half = cmath.phase(centre - touch.conjugate())
    return SlottedLever(centre, stroke / abs(cmath.exp(2j * half) - 1), half)


def whitworth(time_ratio: float, crank: float) -> float:
    """How far the second pivot of a Whitworth quick return stands off, where the crank turns fully round both.

    The dead centres are where the crank's circle meets the line through the second pivot, 2 pi / (1 + t) apart.
    """
    ends = [crank * cmath.exp(1j * sign * math.pi / (1 + time_ratio)) for sign in (1, -1)]
    return (ends[0] + ends[1]).real / 2 if time_ratio > 1 else math.nan

"""Mechanisms that a synthesis gives, written as descriptions of plain numbers, and what they do by Newton's method.

Nothing of the synthesis is used here but its lengths and pivots: the loops are closed by solving the links' poses.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from reference_cases import mechanism

from mechsheet.model import Mechanism
from mechsheet.reference import Solution, rates, solve
from mechsheet.reference.synthesis.functions import FourBar
from mechsheet.reference.synthesis.guidance import Crank, Pose

FULL = 2 * math.pi


def outputs(found: FourBar, theta: Sequence[float] | NDArray[np.float64], side: float) -> NDArray[np.float64]:
    """(n,) The output angle of a function generator at input angles, on the assembly `side`; NaN where links do not meet.

    By circles about A and B0: B = A + (B0 - A)(u + i side v) with u + i v from the three sides. In (-pi, pi].
    """
    a = found.a2 * np.exp(1j * (np.asarray(theta, dtype=float) + found.theta_offset))
    way = found.a1 - a
    length = np.abs(way)
    with np.errstate(invalid="ignore", divide="ignore"):
        u = (length**2 + found.a3**2 - found.a4**2) / (2 * length**2)
        v = np.sqrt((found.a3 / length) ** 2 - u**2)
        b = a + way * (u + 1j * side * v)
        return np.asarray(np.angle((b - found.a1) * np.exp(-1j * found.psi_offset)))


def listed(point: complex) -> str:
    """A point as a description writes it."""
    return f"[{point.real!r}, {point.imag!r}]"


def four_bar(a1: float, a2: float, a3: float, a4: float, sketch: complex, at: float) -> Mechanism:
    """A four-bar with its ground link on +x; `sketch` is where B roughly is at the crank angle `at`, radians."""
    return mechanism(f"""
            [links.ground]
            points = {{ A0 = [0, 0], B0 = [{a1!r}, 0] }}
            [links.crank]
            points = {{ A0 = [0, 0], A = [{a2!r}, 0] }}
            [links.coupler]
            points = {{ A = [0, 0], B = [{a3!r}, 0] }}
            [links.rocker]
            points = {{ B0 = [0, 0], B = [{a4!r}, 0] }}
            [driver]
            link = "crank"
            values = [{math.degrees(at)!r}]
            [assembly]
            B = {listed(sketch)}
            """)


def slider_crank(a2: float, a3: float, c: float) -> Mechanism:
    """An eccentric slider-crank, its guide c above the crank's pivot."""
    return mechanism(f"""
            [links.ground]
            points = {{ A0 = [0, 0] }}
            [links.crank]
            points = {{ A0 = [0, 0], A = [{a2!r}, 0] }}
            [links.rod]
            points = {{ A = [0, 0], B = [{a3!r}, 0] }}
            [links.slider]
            points = {{ B = [0, 0] }}
            [[joints]]
            type = "prismatic"
            link = "slider"
            on = "ground"
            point = "B"
            through = [0, {c!r}]
            symbol = "s14"
            [driver]
            link = "crank"
            values = [0]
            [assembly]
            B = [{a3 + a2!r}, {c!r}]
            """)


def slotted_lever(centre: float, lever: float, crank: float) -> Mechanism:
    """A crank pin in the slot of a lever whose pivot is `centre` below; C is the lever's end."""
    return mechanism(f"""
            [links.ground]
            points = {{ A0 = [0, 0], B0 = [0, {-centre!r}] }}
            [links.crank]
            points = {{ A0 = [0, 0], A = [{crank!r}, 0] }}
            [links.lever]
            points = {{ B0 = [0, 0], C = [{lever!r}, 0] }}
            [[joints]]
            type = "pin-slot"
            point = "A"
            on = "lever"
            through = "B0"
            symbol = "s3"
            [driver]
            link = "crank"
            values = [90]
            [assembly]
            s3 = {centre + crank!r}
            """)


def guided(cranks: Sequence[Crank], poses: Sequence[Pose], at: int) -> Mechanism:
    """The body on its two cranks at one pose: the first crank turned as the synthesis says, the body sketched near there."""
    first, second = cranks
    turn = (0.0, *first.turns)[at]
    along = second.moving - first.moving
    angle = poses[at].angle - poses[0].angle
    sketch = poses[at].place + (second.moving - poses[0].place) * cmath.exp(1j * angle)
    body = (poses[0].place - first.moving) * abs(along) / along  # the body's own point, in the frame of its link
    start = math.atan2((first.moving - first.fixed).imag, (first.moving - first.fixed).real)
    return mechanism(f"""
            [links.ground]
            points = {{ A0 = {listed(first.fixed)}, B0 = {listed(second.fixed)} }}
            [links.crank]
            points = {{ A0 = [0, 0], A = [{first.length!r}, 0] }}
            [links.body]
            points = {{ A = [0, 0], B = [{abs(along)!r}, 0], P = {listed(body)} }}
            [links.other]
            points = {{ B0 = [0, 0], B = [{second.length!r}, 0] }}
            [driver]
            link = "crank"
            values = [{math.degrees(start + turn)!r}]
            [assembly]
            B = {listed(sketch)}
            """)


def rests(whole: Mechanism, symbol: str) -> list[tuple[float, float]]:
    """The crank angles of a turn at which a variable stands still, and its value there, by bisection of its rate."""

    def at(values: np.ndarray) -> Solution:
        return solve(whole, values=values)

    def rate(values: np.ndarray) -> np.ndarray:
        return rates(at(values))[symbol][0]

    # an odd number of places, turned a little: none of them is at rest by chance
    places = 0.01234 + np.linspace(0, FULL, 181)
    values = rate(places)
    assert np.all(np.isfinite(values)), "the crank does not turn fully"
    left = np.flatnonzero(np.sign(values[:-1]) != np.sign(values[1:]))
    lows, highs = places[left].copy(), places[left + 1].copy()
    rising = values[left] > 0
    for _ in range(50):
        middles = (lows + highs) / 2
        before = (rate(middles) > 0) == rising
        lows, highs = np.where(before, middles, lows), np.where(before, highs, middles)
    found = at(lows)
    column = found.displacements[symbol] if symbol in found.displacements else unwrapped(found, symbol)
    return list(zip(lows.tolist(), column.tolist(), strict=True))


def unwrapped(found: Solution, symbol: str) -> np.ndarray:
    """An angle by its symbol; solved at a few far places it may be whole turns away."""
    link = next(link for link in found.mechanism.links[1:] if link.angle_symbol == symbol)
    angle = found.poses[link.name][:, 2]
    return np.asarray(angle - FULL * np.round((angle - angle[0]) / FULL))


def apart(first: float | np.ndarray, second: float | np.ndarray) -> float:
    """The largest angle between angles, radians, whatever turns they count."""
    return float(np.max(np.abs(np.angle(np.exp(1j * (np.asarray(first) - np.asarray(second)))))))

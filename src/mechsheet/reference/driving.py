"""How the driver moves in time: its values and their first and second derivatives, row by row.

A motion law goes from start to stop in T seconds; x = t/T is the part of the time, f(x) that of the way. Derived here once
more, by hand, so that nothing is taken from the description's own formulas.
Source: Norton, Design of Machinery, chapter 8.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ..model import TIME, Law, Mechanism
from .expressions import column as over_rows
from .expressions import number

Array: TypeAlias = NDArray[np.float64]
_Curves: TypeAlias = Callable[[Array], tuple[Array, Array, Array]]

_MIDDLE = 5e-10
"""So far beyond the half of the time a parabolic motion still speeds up: rounding decides nothing."""


def _parabolic(x: Array) -> tuple[Array, Array, Array]:
    late = x > 0.5 + _MIDDLE
    rest = 1.0 - x
    return (
        np.where(late, 1.0 - 2.0 * rest * rest, 2.0 * x * x),
        np.where(late, 4.0 * rest, 4.0 * x),
        np.where(late, -4.0, 4.0),
    )


def _harmonic(x: Array) -> tuple[Array, Array, Array]:
    half = np.pi * x / 2.0
    return np.sin(half) ** 2, np.pi * np.sin(half) * np.cos(half), np.pi**2 / 2.0 * (1.0 - 2.0 * np.sin(half) ** 2)


def _cycloidal(x: Array) -> tuple[Array, Array, Array]:
    turn = 2.0 * np.pi * x
    return x - np.sin(turn) / (2.0 * np.pi), 2.0 * np.sin(turn / 2.0) ** 2, 2.0 * np.pi * np.sin(turn)


def _polynomial(x: Array) -> tuple[Array, Array, Array]:
    way = np.polynomial.Polynomial([0.0, 0.0, 0.0, 10.0, -15.0, 6.0])
    return way(x), way.deriv(1)(x), way.deriv(2)(x)


_LAWS: dict[str, _Curves] = {
    "constant": lambda x: (x, np.ones_like(x), np.zeros_like(x)),
    "accelerated": lambda x: (x * x, 2.0 * x, np.full_like(x, 2.0)),
    "parabolic": _parabolic,
    "harmonic": _harmonic,
    "cycloidal": _cycloidal,
    "polynomial": _polynomial,
}


def by_law(law: Law, dimensions: Mapping[str, float]) -> tuple[Array, Array, Array, Array]:
    """Time [s], value, speed and acceleration of the driver in every row."""
    start, stop, duration = (dimensions[name] for name in (law.start, law.stop, law.duration))
    part = np.arange(law.rows) / (law.rows - 1)
    way, once, twice = _LAWS[law.name](part)
    rise = stop - start
    return duration * part, start + rise * way, rise / duration * once, rise / duration**2 * twice


def driver_rates(mechanism: Mechanism, dimensions: Mapping[str, float], driver: Array) -> dict[str, Array]:
    """The driver's speed and acceleration under their names, and the time of a law; none for a driver without a speed.

    driver  its values; where they are not the mechanism's own rows, nobody knows the time or the listed speeds: NaN
    """
    given, rows = mechanism.driver, len(driver)
    names = mechanism.driver_rates
    if given.law is not None:
        time, _, *rates = by_law(given.law, dimensions)
        found = dict(zip((TIME, *names), (time, *rates), strict=True))
        return found if len(time) == rows else dict.fromkeys(found, np.full(rows, np.nan))
    if given.speed is None or given.acceleration is None:
        return {}
    lists = dict(zip(names, (given.speeds, given.accelerations), strict=True))
    known: dict[str, Array] = {name: np.array(value) for name, value in dimensions.items()} | {given.symbol: driver}
    for name, listed in lists.items():
        if listed:
            values = np.array([number(each, dimensions) for each in listed])
            known[name] = values if len(values) == rows else np.full(rows, np.nan)
    return {
        name: over_rows(node, known, rows) for name, node in zip(names, (given.speed, given.acceleration), strict=True)
    }

"""Values of what is driven besides the driver, and how they change with it."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..model import Mechanism
from .expressions import column as over_rows
from .expressions import number
from .geometry import Array
from .segments import motion
from .system import System

_STEP = 0.02
_FIRST = np.array([3, -32, 168, -672, 0, 672, -168, 32, -3]) / 840
_SECOND = np.array([-9, 128, -1008, 8064, -14350, 8064, -1008, 128, -9]) / 5040
"""Weights of central differences of the eighth order."""


def values(
    mechanism: Mechanism, dimensions: Mapping[str, float], driver: Array, rows: Array | None = None
) -> dict[str, Array]:
    """By symbol, at values (m,) of the driver, all in the file's units and radians.

    rows  (m,) the row (from 0) at which each is, a fraction between two; those that are listed need it, else the first
          value stands for all
    """
    known: dict[str, Array] = {name: np.array(value) for name, value in dimensions.items()}
    known[mechanism.driver.symbol] = driver
    found = {}
    for other in mechanism.drivers:
        if other.segments is not None:
            column = motion(other.segments, dimensions, driver)[0]
        elif other.follows is not None:
            column = over_rows(other.follows, known, len(driver))
        else:
            listed = np.array([number(value, dimensions) for value in other.values])
            at = np.zeros(len(driver)) if rows is None else rows
            column = np.interp(at, np.arange(len(listed)), listed)
        found[other.symbol] = known[other.symbol] = column
    return found


def columns(built: System, driver: Array, rows: Array | None = None) -> Array:
    """The same (m, further drivers) as the state has them; `driver` in the file's unit."""
    found = values(built.mechanism, built.dimensions, driver, rows)
    scales = [built.scale if other.joint else 1.0 for other in built.mechanism.drivers]
    each = [found[other.symbol] / scale for other, scale in zip(built.mechanism.drivers, scales, strict=True)]
    return np.stack(each, axis=1) if each else np.zeros((len(driver), 0))


def derivatives(built: System, driver: Array) -> tuple[Array, Array]:
    """First and second derivatives of these columns by the driver as the system has it; `driver` in the file's unit."""
    scale = built.scale if built.mechanism.driver.joint else 1.0
    at = [columns(built, driver + place * _STEP * scale) for place in range(-4, 5)]
    first, second = (
        sum(weight * value for weight, value in zip(weights, at, strict=True)) for weights in (_FIRST, _SECOND)
    )
    first, second = np.asarray(first) / _STEP, np.asarray(second) / _STEP**2
    for place, other in enumerate(built.mechanism.drivers):
        if other.segments is not None:  # whose derivatives are known, and leap where differences cannot see it
            unit = built.scale if other.joint else 1.0
            _, once, twice, _ = motion(other.segments, built.dimensions, driver)
            first[:, place], second[:, place] = once * scale / unit, twice * scale**2 / unit
    return first, second

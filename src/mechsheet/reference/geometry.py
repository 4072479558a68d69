"""Numbers of a mechanism: dimensions, driver values, and points in their links' frames."""

from __future__ import annotations

import itertools
import math
from collections.abc import Mapping
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import near_miss
from livesheet.formula.nodes import symbols
from livesheet.said import say
from mechsheet.diagnostics import MechanismError

from ..model import Cartesian, Distances, GivenPoint, Joint, Link, Mechanism, Polar
from .driving import by_law
from .expressions import number

Array: TypeAlias = NDArray[np.float64]
PointsByLink: TypeAlias = Mapping[str, Mapping[str, Array]]
"""Link name → point name → (x, y) in the link's frame."""

STEP_TOLERANCE = 1e-9
"""A stop that misses the last step by less than this part of a step is a row."""

ROUNDING = 1e-12
"""Lengths that miss each other by less than this part of their sum meet."""


def whole_turns(angle: Array) -> Array:
    """The whole turns nearest to angles, in radians: what is left without them is within half a turn."""
    return np.asarray(2 * np.pi * np.round(angle / (2 * np.pi)))


def dimension_values(mechanism: Mechanism, dimensions: Mapping[str, float] | None = None) -> dict[str, float]:
    """Every dimension's value in internal units, in the order of the file.

    `dimensions` replaces values by symbol. What a synthesis finds is found again here (`synthesis`), not by its steps.
    Raises MechanismError for a symbol that is not a dimension, and for dimensions that need each other in a circle.
    """
    given = dict(dimensions or {})
    known = {dimension.symbol: dimension for dimension in mechanism.dimensions}
    unknown = [symbol for symbol in given if symbol not in known]
    if unknown:
        raise MechanismError(
            say(
                '"{unknown}" is no dimension; {near_miss}', unknown=unknown[0], near_miss=near_miss(unknown[0], known)
            ).rstrip("; ")
        )
    values: dict[str, float] = {}
    task = mechanism.synthesis
    found = frozenset[str]() if task is None else frozenset(task.results.values()) & frozenset(task.steps)

    def settle(symbol: str, asked: tuple[str, ...]) -> None:
        if symbol in values:
            return
        if symbol in asked:
            raise MechanismError(say("dimensions in a circle: {names}", names=" → ".join((*asked, symbol))))
        if symbol not in known:
            raise MechanismError(
                say('"{asked}" needs "{symbol}", which is no dimension', asked=asked[-1], symbol=symbol)
            )
        quantity = known[symbol].value
        if symbol in given:
            values[symbol] = float(given[symbol])
            return
        if task is not None and symbol in found:
            from .synthesis.results import results

            for name in (*task.inputs, *(set(task.results.values()) - set(task.steps))):
                settle(name, (*asked, symbol))
            values.update({name: value for name, value in results(task, values).items() if name not in given})
            return
        if not isinstance(quantity, float):
            for name in symbols(quantity):
                settle(name, (*asked, symbol))
        values[symbol] = number(quantity, values)

    for symbol in known:
        settle(symbol, ())
    return {symbol: values[symbol] for symbol in known}


def driver_values(mechanism: Mechanism, dimensions: Mapping[str, float]) -> Array:
    """The driver's values over the sweep, in internal units: start + n*step up to stop, the values listed, or by its law.

    `dimensions` are all dimension values (`dimension_values`). Stop is included when the steps land on it within
    1e-9 of a step. Raises MechanismError when the steps never get to stop.
    """
    driver = mechanism.driver
    if driver.law is not None:
        return by_law(driver.law, dimensions)[1]
    if driver.values:
        return np.array([number(value, dimensions) for value in driver.values])
    start, stop, step = (number(value, dimensions) for value in (driver.start, driver.stop, driver.step))
    if start == stop:
        return np.array([start])
    steps = (stop - start) / step if step else np.nan
    if not np.isfinite(steps) or steps < 0:
        raise MechanismError(
            say(
                "the driver does not get from {start:g} to {stop:g} in steps of {step:g}",
                start=start,
                stop=stop,
                step=step,
            )
        )
    return np.asarray(start + np.arange(int(np.floor(steps + STEP_TOLERANCE)) + 1) * step)


def points_in_links(mechanism: Mechanism, dimensions: Mapping[str, float]) -> dict[str, dict[str, Array]]:
    """Every point of every link in the link's own frame; NaN where its distances make no triangle."""
    return {link.name: link_points(link, dimensions) for link in mechanism.links}


def link_points(link: Link, dimensions: Mapping[str, float]) -> dict[str, Array]:
    """Points of one link in its frame. Raises MechanismError when points are given by each other in a circle."""
    found: dict[str, Array] = {}

    def locate(point: str, asked: tuple[str, ...]) -> Array:
        if point in asked:
            raise MechanismError(
                say('points of "{name}" in a circle: {names}', name=link.name, names=" → ".join((*asked, point)))
            )
        if point not in found:
            place: GivenPoint = link.points[point]
            match place:
                case Cartesian(x, y):
                    found[point] = np.array([number(x, dimensions), number(y, dimensions)])
                case Polar(r, angle):
                    direction = number(angle, dimensions)
                    found[point] = number(r, dimensions) * np.array([np.cos(direction), np.sin(direction)])
                case Distances(first, first_distance, second, second_distance, side):
                    found[point] = _by_distances(
                        locate(first, (*asked, point)),
                        number(first_distance, dimensions),
                        locate(second, (*asked, point)),
                        number(second_distance, dimensions),
                        1.0 if side == "left" else -1.0,
                    )
        return found[point]

    return {point: locate(point, ()) for point in link.points}


def _by_distances(p: Array, from_p: float, q: Array, from_q: float, side: float) -> Array:
    """The point at given distances from p and q, left (+1) or right (-1) of the way from p to q.

    With d = |pq|: along = (from_p² - from_q² + d²) / 2d, and across is the triangle's area by Heron's formula over d / 2:
    where the three lie in line its last factors are 0 or rounding, while from_p² - along² would lose half its digits.
    """
    base = q - p
    length = math.sqrt(float(base[0] * base[0] + base[1] * base[1]))
    if not length > 0:
        return np.array([np.nan, np.nan])
    along = ((from_p - from_q) * (from_p + from_q) + length * length) / (2 * length)
    gaps = (length + from_p - from_q, from_q + length - from_p, from_q - length + from_p)
    if min(gaps) < -ROUNDING * (abs(from_p) + abs(from_q) + length):
        return np.array([np.nan, np.nan])
    across = side * math.sqrt(max(0.0, (length + from_p + from_q) * math.prod(gaps))) / (2 * length)
    unit = base / length
    return np.asarray(p + along * unit + across * np.array([-unit[1], unit[0]]))


def through(joint: Joint, located: PointsByLink, dimensions: Mapping[str, float]) -> Array:
    """The point of `on`'s frame that a sliding joint's line passes."""
    if isinstance(joint.through, str):
        return located[joint.on][joint.through]
    return np.array([number(coordinate, dimensions) for coordinate in joint.through])


def size(mechanism: Mechanism, dimensions: Mapping[str, float]) -> float:
    """Characteristic length: the largest distance between two points of one link, lines' `through` points included.

    A mechanism without any length has the largest displacement that drives it, or 1.
    """
    located = points_in_links(mechanism, dimensions)
    marks = {name: list(points.values()) for name, points in located.items()}
    for joint in mechanism.joints:
        marks[joint.on].append(through(joint, located, dimensions))
    spans = [float(np.hypot(*(p - q))) for points in marks.values() for p, q in itertools.combinations(points, 2)]
    if mechanism.driver.joint:
        spans.extend(np.abs(driver_values(mechanism, dimensions)))
    largest = max((span for span in spans if np.isfinite(span)), default=0.0)
    return largest if largest > 0 else 1.0

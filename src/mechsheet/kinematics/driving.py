"""What is given row by row: the driver's values, and where it moves by a law or by a list, what belongs to each of them."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from mechsheet.kinematics.numeric import Array, interpolated, value
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import TIME, Driver, Mechanism


def driver_values(mechanism: Mechanism, dimensions: Mapping[str, float]) -> Array:
    """The driver's values, row by row: start + n step (no drift; stop is included when the steps land on it), those that
    are listed, or those of its motion law."""
    return given_values(mechanism, dimensions)[mechanism.driver.symbol]


def given_values(mechanism: Mechanism, dimensions: Mapping[str, float]) -> dict[str, Array]:
    """Of every row the driver's value, and what `given_by_row` names."""
    driver = mechanism.driver
    if driver.law is not None:
        return given_at(mechanism, dimensions, np.arange(1.0, driver.law.rows + 1, dtype=np.float64))
    if driver.values:
        listed = mechanism.listed.items()
        return {name: np.array([number(each, dimensions) for each in values]) for name, values in listed}
    start, stop, step = (number(part, dimensions) for part in (driver.start, driver.stop, driver.step))
    count = math.floor((stop - start) / step + 1e-9) + 1
    return {driver.symbol: np.asarray(start + step * np.arange(count), dtype=np.float64)}


def listed_values(mechanism: Mechanism, dimensions: Mapping[str, float], driver: Array) -> dict[str, Array]:
    """What is driven besides and has its values listed, row by row, at values of the driver: its own, or the first of them.

    At other values of the driver it has those of the rows around them.
    """
    if not mechanism.listed_symbols:
        return {}
    given = given_values(mechanism, dimensions)
    own = given[mechanism.driver.symbol]
    besides = {symbol: given[symbol] for symbol in mechanism.listed_symbols}
    if np.array_equal(driver, own[: len(driver)]):
        return {symbol: column[: len(driver)] for symbol, column in besides.items()}
    order = np.argsort(own, kind="stable")
    return {symbol: interpolated(driver, own[order], column[: len(own)][order]) for symbol, column in besides.items()}


def given_at(mechanism: Mechanism, dimensions: Mapping[str, float], places: Array) -> dict[str, Array]:
    """The same of a motion law at places between the rows, which count from 1."""
    driver, law = mechanism.driver, mechanism.driver.law
    if law is None:
        raise ValueError("the driver moves by no law")
    time = (places - 1.0) * dimensions[law.duration] / (law.rows - 1)
    known: dict[str, Array | float] = {**dimensions, TIME: time}
    return {driver.symbol: np.asarray(value(law.value, known), dtype=np.float64), TIME: time}


def given_between(
    mechanism: Mechanism, dimensions: Mapping[str, float], given: Mapping[str, Array], places: Array
) -> dict[str, Array]:
    """What is given at places between the rows (counted from 1) of a sweep that steps, or of a law."""
    driver = mechanism.driver
    if driver.law is not None:
        return given_at(mechanism, dimensions, places)
    rows = given[driver.symbol]
    return {driver.symbol: np.asarray(rows[0] + (places - 1.0) * step_of(rows))}


def at_values(driver: Driver, values: Array) -> Driver:
    """The driver at these values one by one, for positions alone: of a motion law the time is read, but not known."""
    times = driver.times if driver.law is None else (math.nan,) * len(values)
    return replace(driver, values=tuple(values.tolist()), law=None, times=times)


def step_of(rows: Array) -> float:
    """How far a driver that steps goes from row to row, of its values in the rows."""
    return float(rows[-1] - rows[0]) / max(1, len(rows) - 1)


def rates_at(mechanism: Mechanism, dimensions: Mapping[str, float], given: Mapping[str, Array]) -> dict[str, Array]:
    """The driver's speed and acceleration where its value and what is given beside it are known."""
    driver, known = mechanism.driver, {**dimensions, **given}
    if driver.speed is None or driver.acceleration is None:
        return {}
    rows = given[driver.symbol].shape
    nodes = zip(mechanism.driver_rates, (driver.speed, driver.acceleration), strict=True)
    return {name: np.broadcast_to(np.asarray(value(node, known), dtype=np.float64), rows) for name, node in nodes}


def place_of(mechanism: Mechanism, dimensions: Mapping[str, float], wanted: float) -> float:
    """The place, counted in rows from 1, at which a motion law has a value; the nearest end where it never has."""
    law = mechanism.driver.law
    if law is None:
        raise ValueError("the driver moves by no law")
    low, high = 1.0, float(law.rows)

    def at(place: float) -> float:
        return float(given_at(mechanism, dimensions, np.array([place]))[mechanism.driver.symbol][0])

    rising = at(high) > at(low)
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if (at(middle) < wanted) == rising else (low, middle)
    return (low + high) / 2

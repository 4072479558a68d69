"""The values of a mechanism's dimensions, derived ones after those that they follow from, and which of them are lengths.

The largest length is what tolerances and roundings are parts of.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from graphlib import TopologicalSorter

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Number, Symbol, symbols
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.numeric import Array
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import Cartesian, Dimension, Distances, Mechanism, Polar, Quantity


def dimension_values(mechanism: Mechanism) -> dict[str, float]:
    """All dimensions in internal units, derived ones computed; NaN for what follows from a task without a solution."""
    values: dict[str, float] = {}
    given = {dim.symbol: dim.value for dim in mechanism.dimensions}
    for symbol in dimension_order(mechanism):
        quantity = given[symbol]
        if not isinstance(quantity, float) and any(math.isnan(values[name]) for name in symbols(quantity)):
            values[symbol] = math.nan  # as #N/A does in cells, also where a comparison asks for it
            continue
        try:
            values[symbol] = number(quantity, values)
        except (ArithmeticError, ValueError):
            if mechanism.synthesis is None:
                raise
            values[symbol] = math.nan
    return values


def dimension_order(mechanism: Mechanism) -> tuple[str, ...]:
    """Symbols of all dimensions, each after those it is derived from: inputs first, then step by step what follows.

    In each step those that can be computed stand as they are described, so that sheets and programs list them so. Raises
    CycleError (a ValueError) where dimensions are derived from each other, which the reader of descriptions has refused.
    """
    inputs = [dim.symbol for dim in mechanism.dimensions if isinstance(dim.value, float)]
    reads = {dim.symbol: symbols(dim.value) for dim in mechanism.dimensions if not isinstance(dim.value, float)}
    places = {symbol: place for place, symbol in enumerate(reads)}
    sorter = TopologicalSorter({symbol: places.keys() & names for symbol, names in reads.items()})
    sorter.prepare()
    derived: list[str] = []
    while sorter.is_active():
        ready = sorted(sorter.get_ready(), key=places.__getitem__)
        derived += ready
        sorter.done(*ready)
    return (*inputs, *derived)


def largest_given(mechanism: Mechanism) -> Node:
    """MAX of the sizes of all lengths given: input dimensions, and plain numbers in places; where there are none, the
    largest length that there is."""
    found = {} if mechanism.synthesis is None else mechanism.synthesis.taken
    lengths: list[Node] = [
        Symbol(dim.symbol) if isinstance(dim.value, float) and dim.value > 0 else Call("ABS", (Symbol(dim.symbol),))
        for dim in mechanism.dimensions
        if is_length(dim) and (not dim.derived or dim.symbol in found)
    ]
    plain = [abs(value) for value in _lengths_of_places(mechanism) if isinstance(value, float)]
    if plain and max(plain) > 0:
        lengths.append(Number(max(plain)))
    if not lengths:
        lengths.append(Number(largest_length(mechanism, dimension_values(mechanism)) or 1.0))
    return al.largest(lengths)


def is_length(dimension: Dimension) -> bool:
    """True for a dimension in the length unit, mass centres and loaded places apart."""
    return dimension.unit.kind == "length" and not dimension.unit.per and not dimension.path


def largest_length(mechanism: Mechanism, dimensions: Mapping[str, float]) -> float:
    """The largest size of all lengths: dimensions, derived ones too, lengths in places, and the way of a driven slide.

    dimensions  all their values; what has no value (NaN) does not count. 0.0 where there is no length at all
    """
    sizes = [dimensions[dim.symbol] for dim in mechanism.dimensions if is_length(dim)]
    sizes += [number(quantity, dimensions) for quantity in _lengths_of_places(mechanism)]
    if mechanism.driver.joint:
        sizes += [float(value) for value in driver_values(mechanism, dimensions)]
    return max((abs(size) for size in sizes if math.isfinite(size)), default=0.0)


def _lengths_of_places(mechanism: Mechanism) -> list[Quantity]:
    """All lengths in the places of points and of lines."""
    found: list[Quantity] = []
    for link in mechanism.links:
        for place in link.points.values():
            match place:
                case Cartesian(x, y):
                    found += [x, y]
                case Polar(r, _):
                    found.append(r)
                case Distances(_, first, _, second, _):
                    found += [first, second]
    for joint in mechanism.joints:
        if not isinstance(joint.through, str):
            found += joint.through
    return found


def extent(mechanism: Mechanism, values: Mapping[str, Array]) -> float:
    """The larger side of the smallest upright rectangle around all points in all rows; 1.0 where they are one place.

    values  columns of `P.x` and `P.y` in the length unit; rows that do not exist (NaN) do not count
    """
    points = dict.fromkeys(point for link in mechanism.links for point in link.points)
    columns = [np.array([values[f"{point}.{axis}"] for point in points]) for axis in "xy"]
    spans = [np.ptp(found) for found in (column[np.isfinite(column)] for column in columns) if len(found)]
    return float(max(spans, default=0.0)) or 1.0

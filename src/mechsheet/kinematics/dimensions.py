"""The values of a mechanism's dimensions: inputs, and those that are derived from them, in an order that allows it."""

from __future__ import annotations

import math
from graphlib import TopologicalSorter

from livesheet.formula.nodes import symbols
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import Mechanism


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

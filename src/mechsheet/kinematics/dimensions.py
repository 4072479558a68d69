"""The values of a mechanism's dimensions: inputs, and those that are derived from them, in an order that allows it."""

from __future__ import annotations

import math

from mechsheet.formula.nodes import symbols
from mechsheet.kinematics.places import number
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
    """Symbols of all dimensions, each after those it is derived from."""
    known = dict.fromkeys(dim.symbol for dim in mechanism.dimensions if not dim.derived)
    pending = {dim.symbol: set(symbols(dim.value)) for dim in mechanism.dimensions if not isinstance(dim.value, float)}
    while pending:
        ready = [symbol for symbol, reads in pending.items() if reads <= known.keys()]
        if not ready:
            raise ValueError(f"circular dimensions: {sorted(pending)}")  # the reader has refused these
        for symbol in ready:
            known[symbol] = None
            del pending[symbol]
    return tuple(known)

"""Derived dimensions that do not exist for the inputs in the cells (arccos 1.05): nothing may be shown from them."""

from __future__ import annotations

from collections.abc import Collection, Mapping

from livesheet.formula.scalar import evaluate
from livesheet.said import reason, say
from mechsheet.kinematics.dimensions import dimension_order
from mechsheet.model import Mechanism
from mechsheet.sheet.columns.lowering import Assignments


def missing_dimensions(mechanism: Mechanism, inputs: Mapping[str, float]) -> dict[str, str]:
    """Derived dimensions that have no value, and those that read them: symbol -> why not."""
    by_symbol = {dim.symbol: dim for dim in mechanism.dimensions}
    values = dict(inputs)
    missing: dict[str, str] = {}
    for symbol in dimension_order(mechanism):
        value = by_symbol[symbol].value
        if isinstance(value, float):
            continue
        try:
            values[symbol] = evaluate(value, values)
        except KeyError as error:
            missing[symbol] = say("{name} has no value", name=error.args[0])
        except (ArithmeticError, ValueError) as error:
            missing[symbol] = reason(error)
    return missing


def readers(equations: Assignments, symbols: Collection[str]) -> set[str]:
    """Symbols of all equations that read one of `symbols`, straight or through others."""
    found = set(symbols)
    for equation in equations.all:  # each is solved before it is read
        if found & {*equation.reads, *equation.reads_previous}:
            found.add(equation.symbol)
    return found - set(symbols)

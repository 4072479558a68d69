"""What quantities are found from: how large the terms are that cancel where one is nothing but rounding."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from livesheet.formula.nodes import Binary, Node, Number, Symbol, Unary
from mechsheet.kinematics.equations import FORCES, RATES, Equations
from mechsheet.kinematics.numeric import Array, value

ROUNDING = 1e-9
"""What is less than this part of its terms in every row is rounding: far more than is lost, far less than is meant."""

CANCELS = (*RATES, *FORCES, "output")
"""Roles of quantities whose terms are looked at through those that they are found from."""


def only_rounding(equations: Equations, values: Mapping[str, Array]) -> dict[str, float]:
    """Quantities that are not 0, but nothing beside their terms in any row: how large these become."""
    known = {name: np.abs(column) for name, column in values.items()}
    found = {}
    for equation in equations.columns:
        symbol = equation.symbol
        if equation.role not in CANCELS or symbol not in values:
            continue
        with np.errstate(all="ignore"):
            terms = _terms(equation.expression, values, known)
        size = values[symbol] if terms is None else np.maximum(np.abs(values[symbol]), terms)
        known[symbol] = np.abs(size)
        largest, most = (float(np.nanmax(np.abs(each), initial=0.0)) for each in (values[symbol], size))
        if 0 < largest <= ROUNDING * most:
            found[symbol] = most
    return found


def _terms(node: Node, values: Mapping[str, Array], sizes: Mapping[str, Array]) -> Array | None:
    """The sum of the sizes of what a tree adds up; None where it reads what has no values."""
    match node:
        case Symbol(name):
            return sizes.get(name)
        case Unary(_, operand):
            return _terms(operand, values, sizes)
        case Binary("+" | "-" | "*" | "/" as op, left, right):
            one = _terms(left, values, sizes)
            other = _number(right, values) if op == "/" else _terms(right, values, sizes)
            if one is None or other is None:
                return None
            return np.asarray(one + other if op in "+-" else one * other if op == "*" else one / other)
    return _number(node, values)


def _number(node: Node, values: Mapping[str, Array]) -> Array | None:
    if isinstance(node, Number):
        return np.asarray(abs(node.value))
    try:
        return np.asarray(np.abs(value(node, values, rooted=True)))
    except (KeyError, ValueError):
        return None

"""Values of equations in numpy: enough to pick assembly modes, and to look at a mechanism without any sheet.

A position that does not exist (NA()) is NaN here. Only the functions that equations use are known.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from mechsheet.formula.nodes import Binary, Call, Node, Number, Previous, Symbol, Unary
from mechsheet.kinematics.equations import Equation

Array = NDArray[np.float64]


def _round(x: Any, digits: Any) -> Any:
    """Half away from zero, as spreadsheets round."""
    scale = 10.0**digits
    return np.sign(x) * np.floor(np.abs(x) * scale + 0.5) / scale


FUNCTIONS: dict[str, Callable[..., Any]] = {
    "ABS": np.abs,
    "ACOS": np.arccos,
    "AND": lambda *args: np.logical_and.reduce(np.broadcast_arrays(*args)),
    "ASIN": np.arcsin,
    "ATAN": np.arctan,
    "ATAN2": lambda x, y: np.arctan2(y, x),  # the sheet's order is x first, numpy's y first
    "COS": np.cos,
    "DEGREES": np.degrees,
    "EXP": np.exp,
    "IF": np.where,
    "ISNUMBER": lambda x: ~np.isnan(x),
    "LN": np.log,
    "MAX": lambda *args: _fold(np.maximum, args),
    "MIN": lambda *args: _fold(np.minimum, args),
    "NA": lambda: np.nan,
    "NOT": np.logical_not,
    "OR": lambda *args: np.logical_or.reduce(np.broadcast_arrays(*args)),
    "PI": lambda: np.pi,
    "RADIANS": np.radians,
    "ROUND": _round,
    "SIGN": np.sign,
    "SIN": np.sin,
    "SQRT": np.sqrt,
    "SUMSQ": lambda *args: sum(arg * arg for arg in args),
    "TAN": np.tan,
}

OPERATORS: dict[str, Callable[[Any, Any], Any]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "^": np.power,
    "<": np.less,
    "<=": np.less_equal,
    ">": np.greater,
    ">=": np.greater_equal,
    "=": np.equal,
}


def _fold(function: Callable[[Any, Any], Any], args: tuple[Any, ...]) -> Any:
    result = args[0]
    for arg in args[1:]:
        result = function(result, arg)
    return result


def value(node: Node, known: Mapping[str, Any], above: Mapping[str, Any] | None = None) -> Any:
    """The value of a tree, whole columns at once. `known` holds this row's symbols, `above` the previous row's."""
    match node:
        case Number(number):
            return number
        case Symbol(name):
            return known[name]
        case Previous(name):
            return (above or {})[name]
        case Unary("-", operand):
            return -value(operand, known, above)
        case Unary("+", operand):
            return value(operand, known, above)
        case Unary("%", operand):
            return value(operand, known, above) / 100
        case Binary(op, left, right):
            return OPERATORS[op](value(left, known, above), value(right, known, above))
        case Call(name, args) if name in FUNCTIONS:
            return FUNCTIONS[name](*(value(arg, known, above) for arg in args))
    raise ValueError(f"no numeric meaning here: {node}")


def evaluate_column(equation: Equation, known: Mapping[str, Array], rows: int) -> Array:
    """One equation over all rows; one that reads the row above is taken row by row."""
    with np.errstate(all="ignore"):
        if equation.first is None:
            return np.broadcast_to(np.asarray(value(equation.expression, known), float), (rows,))
        result = np.empty(rows)
        wanted = {*equation.reads, *equation.reads_previous} - {equation.symbol}
        running = {name: known[name] for name in wanted} | {equation.symbol: result}
        for row in range(rows):
            now = {name: column[row] for name, column in running.items()}
            if row == 0:
                result[row] = value(equation.first, now)
            else:
                result[row] = value(equation.expression, now, {name: col[row - 1] for name, col in running.items()})
        return result

"""Value of an expression of the model, computed with numpy.

A second evaluator on purpose: the reference judges the equations, which `formula` and `kinematics` evaluate. The tree is the
model's data; that it is what the text says is the parser's matter, whose trees are written out in its own tests.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, Unary
from livesheet.said import say
from mechsheet.diagnostics import MechanismError

from ..model import Quantity

Value = Any
"""A float or an array of floats; arrays broadcast."""

_FUNCTIONS: Mapping[str, Callable[..., Value]] = {
    "SIN": np.sin,
    "COS": np.cos,
    "TAN": np.tan,
    "ASIN": np.arcsin,
    "ACOS": np.arccos,
    "ATAN": np.arctan,
    "ATAN2": lambda x, y: np.arctan2(y, x),
    "SQRT": np.sqrt,
    "SUMSQ": lambda *args: reduce(np.add, map(np.square, args)),
    "ABS": np.abs,
    "SIGN": np.sign,
    "MIN": lambda *args: reduce(np.minimum, args),
    "MAX": lambda *args: reduce(np.maximum, args),
    "EXP": np.exp,
    "LN": np.log,
    "RADIANS": np.radians,
    "DEGREES": np.degrees,
    "NA": lambda: np.float64(np.nan),
    "ROUND": lambda x, digits: np.sign(x) * np.floor(np.abs(x) * 10.0**digits + 0.5) / 10.0**digits,
    "PI": lambda: np.float64(np.pi),
    "IF": np.where,
}

_OPERATORS: Mapping[str, Callable[[Value, Value], Value]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "^": np.power,
    ">": np.greater,
}


def evaluate(quantity: Quantity, values: Mapping[str, Value]) -> Value:
    """Value of a quantity, with the named quantities in `values` (floats or arrays, in internal units).

    Outside a function's range the value is NaN or infinite, as IEEE 754 has it; nothing is raised for that. Raises
    MechanismError for a name that `values` lacks, and for what is no expression of a description (a cell, a text).
    """
    if isinstance(quantity, float | int):
        return np.float64(quantity)

    def compute(node: Node) -> Value:
        match node:
            case Number(number):
                return np.float64(number)
            case Symbol(name) if name in values:
                return np.asarray(values[name], dtype=float)[()]
            case Symbol(name):
                raise MechanismError(say('"{name}" is not defined', name=name))
            case Unary("-", operand):
                return -compute(operand)
            case Unary("+", operand):
                return compute(operand)
            case Binary(operator, left, right) if operator in _OPERATORS:
                return _OPERATORS[operator](compute(left), compute(right))
            case Call(name, args) if name in _FUNCTIONS:
                return _FUNCTIONS[name](*map(compute, args))
        raise MechanismError(say("{node} is no expression of a description", node=node))

    with np.errstate(all="ignore"):
        return compute(quantity)


def number(quantity: Quantity, values: Mapping[str, float]) -> float:
    """`evaluate` for a single number."""
    return float(evaluate(quantity, values))


def column(quantity: Quantity, values: Mapping[str, NDArray[np.float64]], rows: int) -> NDArray[np.float64]:
    """`evaluate` over a sweep: an array of `rows` values, also where the expression is constant."""
    return np.array(np.broadcast_to(evaluate(quantity, values), (rows,)), dtype=float)

"""Value of a description expression, computed on Python's own syntax tree with numpy.

A second evaluator on purpose: the reference judges what the program's expression tree produces, so it may not share it.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Mapping
from functools import lru_cache, reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..diagnostics import MechanismError
from ..model import Quantity

Value = Any
"""A float or an array of floats; arrays broadcast."""

_TOKEN = re.compile(
    r"\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?)"
    r"|(?P<name>[^\W\d][\w']*(?:\.[^\W\d][\w']*)?)"
    r"|(?P<mark>[-+*/^(),]))"
)

_FUNCTIONS: Mapping[str, Callable[..., Value]] = {
    "sin": np.sin,
    "cos": np.cos,
    "tan": np.tan,
    "asin": np.arcsin,
    "acos": np.arccos,
    "atan": np.arctan,
    "atan2": np.arctan2,
    "sqrt": np.sqrt,
    "hypot": np.hypot,
    "abs": np.abs,
    "sign": np.sign,
    "min": lambda *args: reduce(np.minimum, args),
    "max": lambda *args: reduce(np.maximum, args),
    "exp": np.exp,
    "ln": np.log,
    "radians": np.radians,
    "degrees": np.degrees,
}

_OPERATORS: Mapping[type[ast.operator], Callable[[Value, Value], Value]] = {
    ast.Add: np.add,
    ast.Sub: np.subtract,
    ast.Mult: np.multiply,
    ast.Div: np.divide,
    ast.Pow: np.power,
}


@lru_cache(maxsize=4096)
def _parsed(text: str) -> tuple[ast.expr, tuple[str, ...]]:
    """Syntax tree of an expression in which the n-th name is spelled `_n`, and the names.

    Names are replaced because a dimension may be called `lambda`, and because Python folds some Unicode letters.
    """
    pieces: list[str] = []
    names: list[str] = []
    position = 0
    while position < len(text.rstrip()):
        token = _TOKEN.match(text, position)
        if token is None:
            raise MechanismError(f'cannot read "{text}" from "{text[position:]}" on')
        position = token.end()
        if token["number"]:
            pieces.append(repr(float(token["number"])))
        elif token["name"]:
            pieces.append(f"_{len(names)}")
            names.append(token["name"])
        else:
            pieces.append("**" if token["mark"] == "^" else token["mark"])
    try:
        tree = ast.parse(" ".join(pieces), mode="eval").body
    except SyntaxError as error:
        raise MechanismError(f'"{text}" is no expression') from error
    return tree, tuple(names)


def names_in(text: str) -> tuple[str, ...]:
    """Names of the quantities that an expression reads (not its functions, not `pi`), each once, in reading order."""
    _, names = _parsed(text)
    return tuple(dict.fromkeys(name for name in names if name not in _FUNCTIONS and name != "pi"))


def evaluate(quantity: Quantity, values: Mapping[str, Value]) -> Value:
    """Value of a quantity, with the named quantities in `values` (floats or arrays, in internal units).

    Outside a function's range the value is NaN or infinite, as IEEE 754 has it; nothing is raised for that.
    Raises MechanismError where the text is no expression or names something that `values` lacks.
    """
    if not isinstance(quantity, str):
        return np.float64(quantity)
    tree, names = _parsed(quantity)

    def compute(node: ast.expr) -> Value:
        match node:
            case ast.Constant(value=float(number)):
                return np.float64(number)
            case ast.Name(id=placeholder):
                name = names[int(placeholder[1:])]
                if name in values:
                    return np.asarray(values[name], dtype=float)[()]
                if name == "pi":
                    return np.float64(np.pi)
                raise MechanismError(f'"{quantity}" names "{name}", which is not defined')
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -compute(operand)
            case ast.UnaryOp(op=ast.UAdd(), operand=operand):
                return compute(operand)
            case ast.BinOp(left=left, op=operator, right=right) if type(operator) in _OPERATORS:
                return _OPERATORS[type(operator)](compute(left), compute(right))
            case ast.Call(func=ast.Name(id=placeholder), args=args, keywords=[]):
                function = names[int(placeholder[1:])]
                if function in _FUNCTIONS and args:
                    return _FUNCTIONS[function](*map(compute, args))
        raise MechanismError(f'"{quantity}" is no expression of a description')

    with np.errstate(all="ignore"):
        return compute(tree)


def number(quantity: Quantity, values: Mapping[str, float]) -> float:
    """`evaluate` for a single number."""
    return float(evaluate(quantity, values))


def column(quantity: Quantity, values: Mapping[str, NDArray[np.float64]], rows: int) -> NDArray[np.float64]:
    """`evaluate` over a sweep: an array of `rows` values, also where the expression is constant."""
    return np.array(np.broadcast_to(evaluate(quantity, values), (rows,)), dtype=float)

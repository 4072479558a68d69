"""Numeric value of an expression tree of symbols and mathematics, on Python floats.

Function names and argument order are the spreadsheet's, as everywhere in `formula` (ATAN2 takes x first), but
a position that does not exist is an exception here, not an error value: whoever asks for one number wants to
hear why there is none.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping

from livesheet import portable
from livesheet.formula.nodes import Binary, Boolean, Call, Node, Number, Previous, Symbol, Unary
from livesheet.said import say


def evaluate(node: Node, values: Mapping[str, float]) -> float:
    """The value of `node` with its symbols taken from `values` (angles in radians).

    Raises KeyError for a symbol that `values` lacks, ArithmeticError or ValueError with a readable message
    where no finite real value exists (division by zero, the arc cosine of 2, an overflow), and ValueError for
    a node that is no number in this sense (texts, cell references, functions outside `FUNCTIONS`).
    """
    result = _value(node, values)
    if not math.isfinite(result):
        raise OverflowError(say("the result is not a finite number"))
    return result


def _value(node: Node, values: Mapping[str, float]) -> float:
    match node:
        case Number(value):
            return value
        case Boolean(flag):
            return float(flag)
        case Symbol(name) | Previous(name):
            return values[name]
        case Unary(op, operand):
            return _UNARY[op](_value(operand, values))
        case Binary(op, left, right) if op in _BINARY:
            return _BINARY[op](_value(left, values), _value(right, values))
        case Call("IF", (condition, then, otherwise)):
            # Only the branch that is taken may fail: IF exists to guard the other one.
            return _value(then if _value(condition, values) != 0 else otherwise, values)
        case Call(name, args) if name in FUNCTIONS:
            return _call(name, [_value(arg, values) for arg in args])
        case Call(name, _):
            raise ValueError(f"{name} has no numeric value here")
        case _:
            raise ValueError(f"{type(node).__name__} has no numeric value here")


def _call(name: str, args: list[float]) -> float:
    fewest, most, function = FUNCTIONS[name]
    if not fewest <= len(args) <= most:
        raise ValueError(f"{name} does not take {len(args)} argument{'s' * (len(args) != 1)}")
    return function(*args)


def _divide(left: float, right: float) -> float:
    if right == 0:
        raise ZeroDivisionError(say("division by zero"))
    return left / right


def _power(base: float, exponent: float) -> float:
    if base == 0 and exponent < 0:
        raise ZeroDivisionError(say("zero to the power of {exponent:g} is a division by zero", exponent=exponent))
    if base == 0 and exponent == 0:
        raise ValueError(say("zero to the power of zero is not defined"))  # spreadsheets answer #NUM!
    if base < 0 and not exponent.is_integer():
        raise ValueError(
            say("{base:g} to the power of {exponent:g} is not a real number", base=base, exponent=exponent)
        )
    found: float = base * base if exponent == 2 else portable.power(base, exponent)
    if math.isinf(found):
        raise OverflowError(say("{base:g} to the power of {exponent:g} is too large", base=base, exponent=exponent))
    return found


def _square_root(x: float) -> float:
    if x < 0:
        raise ValueError(say("the square root of {x:g} is not a real number", x=x))
    return math.sqrt(x)


def _logarithm(x: float) -> float:
    if x <= 0:
        raise ValueError(say("the logarithm of {x:g} is not a real number", x=x))
    found: float = portable.log(x)
    return found


def _arc(function: Callable[[float], float], word: str) -> Callable[[float], float]:
    def checked(x: float) -> float:
        if abs(x) > 1:
            raise ValueError(
                say("the {function} of {x:g} does not exist: it must lie between -1 and 1", function=say(word), x=x)
            )
        return function(x)

    return checked


def _atan2(x: float, y: float) -> float:
    if x == 0 and y == 0:
        raise ValueError(say("the direction of the point (0, 0) is not defined"))
    found: float = portable.arctan2(y, x)
    return found


def _exponential(x: float) -> float:
    found: float = portable.exp(x)
    if math.isinf(found):
        raise OverflowError(say("exp({x:g}) is too large", x=x))
    return found


def _modulo(x: float, divisor: float) -> float:
    if divisor == 0:
        raise ZeroDivisionError(say("division by zero"))
    return x - divisor * math.floor(x / divisor)


def _nothing() -> float:
    raise ValueError(say("there is none"))


def _rounded(x: float, digits: float) -> float:
    """Half away from zero, as spreadsheets round."""
    scale = 10.0**digits
    return math.copysign(math.floor(abs(x) * scale + 0.5) / scale, x)


def _sign(x: float) -> float:
    return float((x > 0) - (x < 0))


_MANY = 255

FUNCTIONS: dict[str, tuple[int, int, Callable[..., float]]] = {
    "ABS": (1, 1, abs),
    "ACOS": (1, 1, _arc(portable.arccos, "arc cosine")),
    "AND": (1, _MANY, lambda *flags: float(all(flags))),
    "ASIN": (1, 1, _arc(portable.arcsin, "arc sine")),
    "ATAN": (1, 1, portable.arctan),
    "ATAN2": (2, 2, _atan2),
    "COS": (1, 1, portable.cos),
    "DEGREES": (1, 1, math.degrees),
    "EXP": (1, 1, _exponential),
    "INT": (1, 1, lambda x: float(math.floor(x))),
    "LN": (1, 1, _logarithm),
    "MAX": (1, _MANY, lambda *args: max(args)),
    "MIN": (1, _MANY, lambda *args: min(args)),
    "MOD": (2, 2, _modulo),
    "NOT": (1, 1, lambda flag: float(not flag)),
    "OR": (1, _MANY, lambda *flags: float(any(flags))),
    "PI": (0, 0, lambda: math.pi),
    "POWER": (2, 2, _power),
    "NA": (0, 0, _nothing),
    "RADIANS": (1, 1, math.radians),
    "ROUND": (2, 2, _rounded),
    "SIGN": (1, 1, _sign),
    "SIN": (1, 1, portable.sin),
    "SQRT": (1, 1, _square_root),
    "SUM": (1, _MANY, lambda *terms: math.fsum(terms)),
    "SUMSQ": (1, _MANY, lambda *terms: math.fsum(term * term for term in terms)),
    "TAN": (1, 1, portable.tan),
}
"""Fewest and most arguments, and the function itself."""

_UNARY: dict[str, Callable[[float], float]] = {"-": lambda x: -x, "+": lambda x: x, "%": lambda x: x / 100}

_BINARY: dict[str, Callable[[float, float], float]] = {
    "+": lambda left, right: left + right,
    "-": lambda left, right: left - right,
    "*": lambda left, right: left * right,
    "/": _divide,
    "^": _power,
    "=": lambda left, right: float(left == right),
    "<>": lambda left, right: float(left != right),
    "<": lambda left, right: float(left < right),
    "<=": lambda left, right: float(left <= right),
    ">": lambda left, right: float(left > right),
    ">=": lambda left, right: float(left >= right),
}

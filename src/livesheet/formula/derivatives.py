"""The derivative of an expression by one of its symbols, as an expression.

The usual rules; besides them
    Direction(y, x)              (x dy - y dx) / (x^2 + y^2)
    TriangleAngle(o; b, c) = g   from o^2 = b^2 + c^2 - 2 b c cos(g):
                                 dg = (o do - (b - c cos(g)) db - (c - b cos(g)) dc) / (b c sin(g))
    |u|                          sign(u) du;  max, min: that of the argument that is taken
What is 0 or 1 is left out, so that a derivative reads as a person would write it. Source: any text on calculus.
"""

from __future__ import annotations

from collections.abc import Callable

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Boolean, Call, Direction, Node, Number, Symbol, TriangleAngle, Unary

Rule = Callable[[Node], Node]

_RULES: dict[str, Rule] = {
    "SIN": lambda u: Call("COS", (u,)),
    "COS": lambda u: al.neg(Call("SIN", (u,))),
    "TAN": lambda u: al.div(al.ONE, al.square(Call("COS", (u,)))),
    "ASIN": lambda u: al.div(al.ONE, Call("SQRT", (al.sub(al.ONE, al.square(u)),))),
    "ACOS": lambda u: al.neg(al.div(al.ONE, Call("SQRT", (al.sub(al.ONE, al.square(u)),)))),
    "ATAN": lambda u: al.div(al.ONE, al.add(al.ONE, al.square(u))),
    "SQRT": lambda u: al.div(al.ONE, al.mul(al.TWO, Call("SQRT", (u,)))),
    "ABS": lambda u: Call("SIGN", (u,)),
    "EXP": lambda u: Call("EXP", (u,)),
    "LN": lambda u: al.div(al.ONE, u),
    "RADIANS": lambda _: al.div(al.PI, Number(180.0)),
    "DEGREES": lambda _: al.div(Number(180.0), al.PI),
    "SIGN": lambda _: al.ZERO,
    "ROUND": lambda _: al.ZERO,
}
"""Function of one argument -> its derivative by that argument."""

WITHIN_BOUNDS = frozenset(("SIN", "COS", "ASIN", "ACOS", "ATAN", "ATAN2", "SIGN"))
"""Functions that no argument leads beyond all bounds."""

KEEP_BOUNDS = frozenset(("SQRT", "SUMSQ", "ABS", "MIN", "MAX", "EXP", "RADIANS", "DEGREES", "PI"))
"""Functions that no bounded arguments do."""


def derivative(node: Node, symbol: str) -> Node:
    """d node / d symbol. Raises ValueError for a node that has none (a text, a cell, a function without a rule)."""
    match node:
        case Number() | Boolean():
            return al.ZERO
        case Symbol(name):
            return al.ONE if name == symbol else al.ZERO
        case Unary("-", operand):
            return al.neg(derivative(operand, symbol))
        case Unary("+", operand):
            return derivative(operand, symbol)
        case Unary("%", operand):
            return al.div(derivative(operand, symbol), Number(100.0))
        case Binary(op, left, right) if op in "+-*/^":
            return _of_operator(op, left, right, symbol)
        case Direction(y, x):
            return _of_direction(y, x, symbol)
        case TriangleAngle():
            return _of_triangle(node, symbol)
        case Call(name, args):
            return _of_function(name, args, symbol)
    raise ValueError(f"{type(node).__name__} has no derivative")


def _of_operator(op: str, left: Node, right: Node, symbol: str) -> Node:
    if op == "^":
        return _of_power(left, right, symbol)
    dl, dr = derivative(left, symbol), derivative(right, symbol)
    match op:
        case "+":
            return al.add(dl, dr)
        case "-":
            return al.sub(dl, dr)
        case "*":
            return al.add(al.mul(dl, right), al.mul(left, dr))
    if al.is_zero(dr):
        return al.div(dl, right)
    return al.div(al.sub(al.mul(dl, right), al.mul(left, dr)), al.square(right))


def _of_power(base: Node, exponent: Node, symbol: str) -> Node:
    d_base, d_exponent = derivative(base, symbol), derivative(exponent, symbol)
    plain = al.value_of(exponent)
    if plain is not None:
        lower = base if plain == 2 else al.ONE if plain == 1 else Binary("^", base, al.number(plain - 1))
        return al.mul(al.mul(al.number(plain), lower), d_base)
    power: Node = Binary("^", base, exponent)
    by_base = al.mul(al.mul(exponent, Binary("^", base, al.sub(exponent, al.ONE))), d_base)
    if al.is_zero(d_exponent):
        return by_base
    return al.add(by_base, al.mul(al.mul(power, Call("LN", (base,))), d_exponent))


def _of_direction(y: Node, x: Node, symbol: str) -> Node:
    dy, dx = derivative(y, symbol), derivative(x, symbol)
    return al.div(al.sub(al.mul(x, dy), al.mul(y, dx)), al.add(al.square(x), al.square(y)))


def _of_triangle(angle: TriangleAngle, symbol: str) -> Node:
    o, b, c = angle.opposite, angle.beside, angle.other
    do, db, dc = (derivative(side, symbol) for side in (o, b, c))
    cosine = Call("COS", (angle,))
    changes = al.mul(o, do)
    changes = al.sub(changes, al.mul(al.sub(b, al.mul(c, cosine)), db))
    changes = al.sub(changes, al.mul(al.sub(c, al.mul(b, cosine)), dc))
    return al.div(changes, al.mul(al.mul(b, c), Call("SIN", (angle,))))


def _of_function(name: str, args: tuple[Node, ...], symbol: str) -> Node:
    if name in _RULES and (len(args) == 1 or name == "ROUND"):
        inner = derivative(args[0], symbol)
        return al.ZERO if al.is_zero(inner) else al.mul(_RULES[name](args[0]), inner)
    match name, args:
        case "PI", ():
            return al.ZERO
        case "ATAN2", (x, y):
            return _of_direction(y, x, symbol)
        case "SUMSQ", _:
            return al.total(al.mul(al.mul(al.TWO, arg), derivative(arg, symbol)) for arg in args)
        case "IF", (test, then, otherwise):
            return _chosen(test, derivative(then, symbol), derivative(otherwise, symbol))
        case "CHOOSE", (number, *values):
            rates = tuple(derivative(value, symbol) for value in values)
            return rates[0] if len(set(rates)) == 1 else Call("CHOOSE", (number, *rates))
        case (("MAX" | "MIN"), (only,)):
            return derivative(only, symbol)
        case (("MAX" | "MIN"), (*before, last)):
            rest = Call(name, tuple(before)) if len(before) > 1 else before[0]
            test = Binary(">=" if name == "MAX" else "<=", rest, last)
            return _chosen(test, derivative(rest, symbol), derivative(last, symbol))
    raise ValueError(f"{name} has no derivative here")


def _chosen(test: Node, then: Node, otherwise: Node) -> Node:
    return then if then == otherwise else Call("IF", (test, then, otherwise))

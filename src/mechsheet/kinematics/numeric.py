"""Values of equations in numpy, over a whole sweep at once: no sheet, no engine, no loop over rows.

A position that does not exist is NaN. Only the functions that equations use are known.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Callable, Mapping
from functools import reduce
from typing import Any

import numpy as np
from numpy.typing import NDArray

from livesheet import portable
from livesheet.formula.nodes import Binary, Boolean, Call, Direction, Node, Number, Symbol, TriangleAngle, Unary
from mechsheet.kinematics.equations import FORCES, RATES, Equation, Equations

Array = NDArray[np.float64]


def _round(x: Any, digits: Any) -> Any:
    """Half away from zero, as spreadsheets round."""
    scale = 10.0**digits
    return np.sign(x) * np.floor(np.abs(x) * scale + 0.5) / scale


def _chosen(number: Any, *values: Any) -> Any:
    """The value of each row's number, from 1."""
    result = values[0]
    for place, each in enumerate(values[1:], 2):
        result = np.where(np.asarray(number) >= place, each, result)
    return result


FUNCTIONS: dict[str, Callable[..., Any]] = {
    "ABS": np.abs,
    "ACOS": portable.arccos,
    "AND": lambda *args: reduce(np.logical_and, args),
    "ASIN": portable.arcsin,
    "ATAN": portable.arctan,
    "ATAN2": lambda x, y: portable.arctan2(y, x),  # the sheet's order is x first, numpy's y first
    "CHOOSE": _chosen,
    "COS": portable.cos,
    "DEGREES": np.degrees,
    "EXP": portable.exp,
    "IF": np.where,
    "IFERROR": lambda x, other: np.where(np.isfinite(x), x, other),
    "ISNUMBER": lambda x: ~np.isnan(x),
    "LN": portable.log,
    "MEDIAN": lambda *args: np.median(np.broadcast_arrays(*args), axis=0),
    "MAX": lambda *args: reduce(np.maximum, args),
    "MIN": lambda *args: reduce(np.minimum, args),
    "MOD": np.mod,
    "NA": lambda: np.nan,
    "NOT": np.logical_not,
    "OR": lambda *args: reduce(np.logical_or, args),
    "PI": lambda: np.pi,
    "RADIANS": np.radians,
    "ROUND": _round,
    "ROUNDDOWN": lambda x, digits: np.trunc(x * 10.0**digits) / 10.0**digits,
    "ROUNDUP": lambda x, digits: np.copysign(np.ceil(np.abs(x) * 10.0**digits), x) / 10.0**digits,
    "SIGN": np.sign,
    "SIN": portable.sin,
    "SQRT": np.sqrt,
    "SUMSQ": lambda *args: reduce(operator.add, (arg * arg for arg in args)),
    "TAN": portable.tan,
}

OPERATORS: dict[str, Callable[[Any, Any], Any]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": np.divide,
    "^": portable.power,
    "<": np.less,
    "<=": np.less_equal,
    ">": np.greater,
    ">=": np.greater_equal,
    "=": np.equal,
}


def value(node: Node, known: Mapping[str, Any], rooted: bool = False, seen: dict[Any, Any] | None = None) -> Any:
    """The value of a tree, whole columns at once. `known` holds the symbols' columns.

    rooted  what stands under a root is a rounding error where it is negative, and counts as 0
    seen    keeps the sine and cosine of each angle for the other trees over the same `known`
    """

    def of(part: Node) -> Any:
        return value(part, known, rooted, seen)

    match node:
        case Number(number) | Boolean(number):
            return number
        case Symbol(name):
            return known[name]
        case Unary("-", operand):
            return -of(operand)
        case Unary("+", operand):
            return of(operand)
        case Unary("%", operand):
            return of(operand) / 100
        case Binary("^", base, Number(2.0)):
            number = of(base)
            return number * number
        case Binary(op, left, right):
            return OPERATORS[op](of(left), of(right))
        case Call("SQRT", (square,)) if rooted:
            return np.sqrt(np.maximum(0.0, of(square)))
        case Call("SIN" | "COS", (angle,)) if seen is not None:
            if (angle, rooted) not in seen:
                seen[angle, rooted] = portable.sin_and_cos(of(angle))
            return seen[angle, rooted][node.name == "COS"]
        case Call(name, args) if name in FUNCTIONS:
            return FUNCTIONS[name](*map(of, args))
        case Direction(y, x):
            return without_jumps(portable.arctan2(value(y, known), value(x, known)))
        case TriangleAngle(opposite, beside, other):
            return triangle_angle(*(value(side, known) for side in (opposite, beside, other)))
    raise ValueError(f"no numeric meaning here: {node}")


def triangle_angle(opposite: Any, beside: Any, other: Any) -> Any:
    """The angle [rad] opposite the first side, from Heron's area: acos would lose half the digits near 0 and pi.

    tan = 4 area / (beside^2 + other^2 - opposite^2). Source: W. Kahan, "Miscalculating area and angles of a needle-like
    triangle".
    """
    a, b, c = beside, other, opposite
    both, less = a + b, a - b
    product = (both + c) * (both - c) * (c + less) * (c - less)
    return portable.arctan2(np.sqrt(np.maximum(0.0, product)), a * a + b * b - c * c)


def interpolated(x: Array, known: Array, values: Array) -> Array:
    """The values at x on straight lines between those at ascending `known` places; beyond the ends the outermost.

    (`numpy.interp` rounds once less where the processor can.)
    """
    if len(known) == 1:
        return np.full(len(x), values[0])
    left = np.clip(np.searchsorted(known, x, side="right") - 1, 0, len(known) - 2)
    with np.errstate(all="ignore"):
        slope = (values[left + 1] - values[left]) / (known[left + 1] - known[left])
        between = (np.clip(x, known[0], known[-1]) - known[left]) * slope
    return np.where(x >= known[-1], values[-1], values[left] + between)


def without_jumps(angles: Any) -> Any:
    """The angles [rad] with whole turns added, so that none is more than half a turn from the one before.

    After a position without one an angle begins anew, within half a turn: nobody knows how the mechanism came there.
    """
    angles = np.asarray(angles, float)
    if angles.ndim == 0 or len(angles) < 2:
        return angles
    known = np.isfinite(angles)
    if known.all():
        return _unwrapped(angles)
    result = angles.copy()
    for first, end in runs_of(known):
        result[first:end] = _unwrapped(angles[first:end])
    return result


def runs_of(there: Any) -> list[tuple[int, int]]:
    """First row, and the row after the last, of each run of rows that are there."""
    edges = np.flatnonzero(np.diff(np.asarray(there, bool), prepend=False, append=False))
    return [(int(first), int(end)) for first, end in edges.reshape(-1, 2)]


def _unwrapped(angles: Array) -> Array:
    """Turns are counted where an angle jumps, which is in few places."""
    steps = (angles[:-1] - angles[1:]) / math.tau
    jumps = np.flatnonzero(np.abs(steps) >= 0.5)
    if not len(jumps):
        return angles
    turns = np.zeros(len(angles))
    turns[jumps + 1] = _round(steps[jumps], 0)
    return np.asarray(angles + math.tau * np.cumsum(turns))


def evaluate_equation(
    equation: Equation, known: Mapping[str, Any], rows: int, seen: dict[Any, Any] | None = None
) -> Array:
    """One equation over all rows; NaN where it does not exist. `seen` keeps where the same conditions fail, and what
    `value` keeps."""
    with np.errstate(all="ignore"):
        result = value(equation.expression, known, bool(equation.exists), seen)
        if equation.exists:
            fails = None if seen is None else seen.get(equation.exists)
            if fails is None:
                fails = np.logical_or.reduce(
                    [np.broadcast_to(value(each.fails, known), (rows,)) for each in equation.exists]
                )
                if seen is not None:
                    seen[equation.exists] = fails
            if np.any(fails):
                result = np.where(fails, np.nan, result)
        return np.broadcast_to(np.asarray(result, float), (rows,))


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

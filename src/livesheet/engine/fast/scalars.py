"""Operations on single numbers that give numpy's bits at Python's speed.

A call of numpy for one number costs as much as twenty operations of Python. Python's `math` is the C library's; numpy's is
that too, or code of its own for the processor at hand, which may differ in the last bit. So each function is tried on some
thousand numbers once: where one bit differs, numpy itself is called. What is computed is the same in either case.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from ..kernels.math import FAST, Arithmetic
from ..values.cells import NEAR

_TRIED = 4096
"""Numbers that a function is tried on. Two libraries differ in one of a hundred, or never."""
_STRIDE = 1597
"""From a number to the one that it is paired with."""

_MATH: dict[str, Callable[..., float]] = {
    "sin": math.sin, "cos": math.cos, "tan": math.tan, "arcsin": math.asin, "arccos": math.acos, "arctan": math.atan,
    "sinh": math.sinh, "cosh": math.cosh, "tanh": math.tanh, "arcsinh": math.asinh, "arccosh": math.acosh,
    "arctanh": math.atanh, "radians": math.radians, "degrees": math.degrees, "sqrt": math.sqrt, "exp": math.exp,
    "log": math.log, "log10": math.log10, "arctan2": math.atan2, "copysign": math.copysign,
}  # fmt: skip

SINGLE = {
    "add": "{0} + {1}",
    "subtract": "{0} - {1}",
    "multiply": "{0} * {1}",
    "divide": "{0} / {1}",
    "square": "{0} * {0}",
    "negative": "-{0}",
    "absolute": "abs({0})",
    "minimum": "{0} if {0} < {1} else {1}",
    "maximum": "{0} if {0} > {1} else {1}",
    "less": "{0} < {1}",
    "less_equal": "{0} <= {1}",
    "greater": "{0} > {1}",
    "greater_equal": "{0} >= {1}",
    "not_equal": "{0} != {1}",
    "logical_and": "{0} and {1}",
    "logical_or": "{0} or {1}",
    "logical_not": "not {0}",
    "where": "{1} if {0} else {2}",
    "snap": "0.0 if abs({0}) < NEAR * abs({1}) and abs({0}) < 1 else {0}",
}
"""How Python says an operation on single numbers; the others are functions."""


@cache
def scalar(op: str, arithmetic: Arithmetic = FAST) -> Callable[..., float]:
    """A numpy operation, or what stands for it, as a function of floats. Outside its domain it raises ValueError or
    ArithmeticError, or gives what is not finite (numpy's own, where its errors are not raised)."""
    own = arithmetic.operations.get(op)
    if own is not None:
        return own
    by_numpy = getattr(np, op)
    by_math = _MATH.get(op)
    if by_math is not None and _agree(by_math, by_numpy, op):
        return by_math
    return lambda *numbers: float(by_numpy(*numbers))


@cache
def scalar_power(exponent: float, arithmetic: Arithmetic) -> Callable[[float], float]:
    """x^exponent as a function of x. numpy has short cuts for some exponents."""
    own = arithmetic.operations.get("power")
    if own is not None:
        return lambda x: float(own(x, exponent))
    ways: tuple[Callable[[float], float], ...] = (lambda x: math.pow(x, exponent), math.sqrt, lambda x: 1.0 / x)
    tried = _samples("power")[:: _TRIED // 512].tolist()
    with np.errstate(all="ignore"):
        expected = [float(np.power(np.float64(number), np.float64(exponent))) for number in tried]
    for way in ways:
        try:
            if [way(number) for number in tried] == expected:
                return way
        except (ValueError, OverflowError):
            continue
    return lambda x: float(np.power(x, exponent))


def _agree(by_math: Callable[..., float], by_numpy: Any, op: str) -> bool:
    args = [_samples(op)]
    if by_numpy.nin == 2:  # in any order: pairs of all ratios, also near 1
        args.append(args[0][(np.arange(_TRIED) * _STRIDE + 1) % _TRIED])
    with np.errstate(all="ignore"):
        expected = by_numpy(*args)
    found = np.array([by_math(*numbers) for numbers in zip(*(arg.tolist() for arg in args), strict=True)])
    return bool(np.array_equal(found.view(np.int64), expected.view(np.int64)))


def _samples(op: str) -> Any:
    """Numbers in the domain of an operation, large and small ones, scattered as multiples of the golden ratio are."""
    part = 2 * np.sqrt(np.arange(1, _TRIED + 1) * 0.6180339887498949 % 1) - 1
    if op in ("arcsin", "arccos", "arctanh"):
        return part
    wide = part * np.repeat([1.0, 7.0, 700.0, 1e-3], _TRIED // 4)
    if op in ("sinh", "cosh", "exp"):
        return np.clip(wide, -700, 700)
    if op == "arccosh":
        return 1 + np.abs(wide)
    return np.abs(wide) if op in ("sqrt", "log", "log10", "power") else wide


def sign(number: float) -> float:
    """-1, 0 or 1."""
    return 1.0 if number > 0 else -1.0 if number < 0 else 0.0


def trunc(number: float) -> float:
    """Without decimals, with its sign also where that leaves nothing."""
    return math.copysign(abs(number) // 1.0, number)


def snap(result: float, left: float) -> float:
    """A sum, with what is left over from cancellation taken as 0 (`kernels.math.snapped`)."""
    return 0.0 if abs(result) < NEAR * abs(left) and abs(result) < 1 else result

"""Functions of numbers, cell by cell: each takes float64 arrays and returns values, with error codes where it has its own.

What is not finite in a result becomes #NUM!, unless the kernel names another error.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from ..values.cells import DIV0, NEAR, NUM

Result: TypeAlias = Any
"""Values, or (values, error codes with 0 where there is none)."""

BELOW_HALF = 0.49999999999999994
"""The largest number below a half: added before cutting off, it rounds no sum up to the next whole number by itself."""


def snapped(result: Any, left: Any) -> Any:
    """A sum or difference, with what is left over from cancellation (below NEAR of an operand, and below 1) taken as 0.

    Excel does this where + or - is the last operation of a formula: 0.1+0.2-0.3 is 0 there.
    """
    size = np.abs(result)
    return np.where((size < NEAR * np.abs(left)) & (size < 1), 0.0, result)


def power(base: Any, exponent: Any) -> Result:
    """base^exponent: 0^0 and roots of negatives are #NUM!, 0 to a negative power is #DIV/0!."""
    if np.ndim(exponent) == 0 and exponent == 2.0:
        return np.square(base)
    zero = np.equal(base, 0)
    codes = np.where(zero & np.equal(exponent, 0), np.uint8(NUM), np.uint8(0))
    return np.power(base, exponent), np.where(zero & np.less(exponent, 0), np.uint8(DIV0), codes)


def divide(left: Any, right: Any) -> Result:
    """left / right, #DIV/0! where right is 0."""
    return np.divide(left, right), np.where(np.equal(right, 0), np.uint8(DIV0), np.uint8(0))


def atan2(x: Any, y: Any) -> Result:
    """The direction of (x, y) from +x, -pi..pi [rad]; x first; #DIV/0! where both are 0."""
    nowhere = np.equal(x, 0) & np.equal(y, 0)
    return np.arctan2(y, x), np.where(nowhere, np.uint8(DIV0), np.uint8(0))


def modulo(number: Any, divisor: Any) -> Result:
    """number - divisor*INT(number/divisor): the sign is the divisor's."""
    result = number - divisor * np.floor(np.divide(number, divisor))
    return result, np.where(np.equal(divisor, 0), np.uint8(DIV0), np.uint8(0))


def half_away(number: Any) -> Any:
    """Rounded to a whole number, halves away from zero."""
    return np.trunc(number + np.copysign(BELOW_HALF, number))


def _scaled(number: Any, digits: Any, whole: Callable[[Any], Any]) -> Any:
    """`whole` of |number| at `digits` decimals. Beyond 15 digits there is nothing to round."""
    digits = np.trunc(digits)
    factor = np.power(10.0, np.clip(np.abs(digits), 0, 308))
    size = np.abs(number)
    up = np.where(digits >= 0, size * factor, size / factor)
    # A decimal fraction times its power of ten misses the whole number by rounding errors: those are not digits.
    near = np.rint(up)
    up = np.where(np.abs(up - near) <= 4e-16 * up, near, up)
    result = np.where(digits >= 0, whole(up) / factor, whole(up) * factor)
    untouched = ~np.isfinite(up) | (np.isfinite(up) & (up >= 2.0**52) & (digits >= 0))
    return np.where(
        np.equal(digits, 0) & ~untouched,
        np.copysign(whole(size), number),
        np.where(untouched, number, np.copysign(result, number)),
    )


def rounded(number: Any, digits: Any) -> Any:
    """To `digits` decimals, halves away from zero (2.675 to two decimals is 2.68, as a person reads it)."""
    return half_away(number) if np.ndim(digits) == 0 and digits == 0 else _scaled(number, digits, _half_up)


def _half_up(size: Any) -> Any:
    # 267.49999999999994 is 2.675 times 100: a half that multiplication has shaved.
    return np.floor(size + 0.5 + size * 2.0**-52)


def rounded_up(number: Any, digits: Any) -> Any:
    """Away from zero to `digits` decimals."""
    return _scaled(number, digits, np.ceil)


def rounded_down(number: Any, digits: Any) -> Any:
    """Towards zero to `digits` decimals."""
    return _scaled(number, digits, np.floor)


def _step(number: Any, step: Any, whole: Callable[[Any], Any]) -> Any:
    count = np.divide(number, step)
    near = np.rint(count)
    count = np.where(np.abs(count - near) <= 4e-16 * np.abs(count), near, count)
    return whole(count) * step


def floor_to(number: Any, step: Any) -> Result:
    """Down to a multiple of `step`; with both negative, towards zero."""
    result = np.where(np.equal(number, 0), 0.0, _step(number, step, np.floor))
    codes = np.where((np.greater(number, 0)) & (np.less(step, 0)), np.uint8(NUM), np.uint8(0))
    codes = np.where(np.equal(step, 0) & ~np.equal(number, 0), np.uint8(DIV0), codes)
    return result, codes


def ceiling_to(number: Any, step: Any) -> Result:
    """Up to a multiple of `step`; with both negative, away from zero; step 0 gives 0."""
    result = np.where(np.equal(step, 0), 0.0, _step(number, step, np.ceil))
    return result, np.where((np.greater(number, 0)) & (np.less(step, 0)), np.uint8(NUM), np.uint8(0))


def logarithm(number: Any, base: Any = 10.0) -> Result:
    """The logarithm to a base; #NUM! where number or base is not positive, #DIV/0! to base 1."""
    if np.ndim(base) == 0 and base == 10.0:
        return np.log10(number)
    if np.ndim(base) == 0 and base == 2.0:
        return np.log2(number)
    codes = np.where(np.less_equal(number, 0) | np.less_equal(base, 0), np.uint8(NUM), np.uint8(0))
    return np.log(number) / np.log(base), np.where((codes == 0) & np.equal(base, 1), np.uint8(DIV0), codes)


MAPS: dict[str, Callable[..., Result]] = {
    "SIN": np.sin,
    "COS": np.cos,
    "TAN": np.tan,
    "ASIN": np.arcsin,
    "ACOS": np.arccos,
    "ATAN": np.arctan,
    "ATAN2": atan2,
    "SINH": np.sinh,
    "COSH": np.cosh,
    "TANH": np.tanh,
    "ASINH": np.arcsinh,
    "ACOSH": np.arccosh,
    "ATANH": np.arctanh,
    "RADIANS": np.radians,
    "DEGREES": np.degrees,
    "SQRT": np.sqrt,
    "ABS": np.abs,
    "SIGN": np.sign,
    "EXP": np.exp,
    "LN": np.log,
    "LOG": logarithm,
    "LOG10": np.log10,
    "POWER": power,
    "MOD": modulo,
    "INT": np.floor,
    "ROUND": rounded,
    "ROUNDUP": rounded_up,
    "ROUNDDOWN": rounded_down,
    "TRUNC": lambda number, digits=0.0: rounded_down(number, digits),
    "FLOOR": floor_to,
    "CEILING": ceiling_to,
}
"""Function -> its array code."""

OPERATORS: dict[str, Callable[[Any, Any], Result]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": divide,
    "^": power,
}

"""Mathematics: operators and functions of numbers, cell by cell, with error codes where they have their own; series.

What is not finite in a result becomes #NUM!, unless the function names another error. The elementary functions have numpy's
code, the fastest there is, or that of `portable`, the same everywhere (`Arithmetic`).
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping
from functools import cache, partial
from typing import Any, TypeAlias

import numpy as np

from ... import portable
from ...formula.nodes import Scalar
from ..values.cells import DIV0, NEAR, NUM, NUMBER, Cells, Numbers
from ..values.coerce import Problem, raise_first, to_number

Result: TypeAlias = Any
"""Values, or (values, error codes with 0 where there is none)."""

BELOW_HALF = 0.49999999999999994
"""The largest number below a half: added before cutting off, it rounds no sum up to the next whole number by itself."""


def snapped(result: Any, left: Any) -> Any:
    """A sum or difference, with what is left over from cancellation (below NEAR of an operand, and below 1) taken as 0.

    Excel does this where + or - is the last operation of a formula: 0.1+0.2-0.3 is 0 there.
    """
    size = np.abs(result)
    if type(size) is np.float64:
        return np.float64(0.0) if size < NEAR * np.abs(left) and size < 1 else result
    return np.where((size < NEAR * np.abs(left)) & (size < 1), 0.0, result)


def power(base: Any, exponent: Any, raised: Callable[[Any, Any], Any] = np.power) -> Result:
    """base^exponent: 0^0 and roots of negatives are #NUM!, 0 to a negative power is #DIV/0!."""
    if np.ndim(exponent) == 0 and exponent == 2.0:
        return np.square(base)
    zero = np.equal(base, 0)
    codes = np.where(zero & np.equal(exponent, 0), np.uint8(NUM), np.uint8(0))
    return raised(base, exponent), np.where(zero & np.less(exponent, 0), np.uint8(DIV0), codes)


def divide(left: Any, right: Any) -> Result:
    """left / right, #DIV/0! where right is 0."""
    zero = np.equal(right, 0)
    return np.divide(left, right), np.where(zero, np.uint8(DIV0), np.uint8(0)) if np.count_nonzero(zero) else None


def atan2(x: Any, y: Any, direction: Callable[[Any, Any], Any] = np.arctan2) -> Result:
    """The direction of (x, y) from +x, -pi..pi [rad]; x first; #DIV/0! where both are 0."""
    nowhere = np.equal(x, 0) & np.equal(y, 0)
    return direction(y, x), np.where(nowhere, np.uint8(DIV0), np.uint8(0))


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
    factor = np.take(_POWERS_OF_TEN, np.clip(np.abs(digits), 0, 308).astype(np.intp), mode="clip")
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


def rounded_one(number: float, digits: int) -> float:
    """`rounded` of one number to 1 to 307 decimals, or as many places before them (negative), at Python's speed."""
    factor = _FACTORS[abs(digits)]
    size = abs(number)
    up = size * factor if digits > 0 else size / factor
    if not math.isfinite(up) or (digits > 0 and up >= 2.0**52):
        return number
    near = float(round(up))
    if abs(up - near) <= 4e-16 * up:
        up = near
    whole = (up + 0.5 + up * 2.0**-52) // 1.0
    return math.copysign(whole / factor if digits > 0 else whole * factor, number)


_FACTORS = [float(f"1e{places}") for places in range(309)]  # to the last bit, which a power function need not give
_POWERS_OF_TEN = np.array(_FACTORS)


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
    """A multiple of `step`; quotients that miss a whole number by rounding errors are whole."""
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


OPERATORS: dict[str, Callable[[Any, Any], Result]] = {
    "+": np.add,
    "-": np.subtract,
    "*": np.multiply,
    "/": divide,
    "^": power,
}


# --- multiples, whole numbers, numerals, series ----------------------------------------------------------------------


FARTHEST_ANGLE = 2.0**27
"""Excel's limit for the arguments of COT, SEC and CSC."""

MOST_WHOLE = 2.0**53
"""Whole numbers from here on are not exact."""


def _marked(result: Any, condition: Any, code: int) -> Result:
    return result, np.where(condition, np.uint8(code), np.uint8(0))


def _reciprocal(function: Callable[[Any], Any], limited: bool) -> Callable[[Any], Result]:
    def of(angle: Any) -> Result:
        below = function(angle)
        codes = np.where(np.equal(below, 0), np.uint8(DIV0), np.uint8(0))
        if limited:
            codes = np.where(np.greater_equal(np.abs(angle), FARTHEST_ANGLE), np.uint8(NUM), codes)
        return np.divide(1.0, below), codes

    return of


def arc_cotangent(number: Any) -> Result:
    """ACOT: between 0 and pi [rad]."""
    return np.where(np.less(number, 0), np.pi, 0.0) + np.arctan(np.divide(1.0, number))


def even(number: Any) -> Result:
    """EVEN: away from zero to an even number."""
    return np.copysign(np.ceil(np.abs(number) / 2) * 2, number)


def odd(number: Any) -> Result:
    """ODD: away from zero to an odd number; 0 gives 1."""
    size = np.maximum(np.ceil((np.abs(number) - 1) / 2) * 2 + 1, 1.0)
    return np.where(np.less(number, 0), -size, size)


def quotient(number: Any, divisor: Any) -> Result:
    """QUOTIENT: the whole part of a division."""
    return _marked(np.trunc(np.divide(number, divisor)), np.equal(divisor, 0), DIV0)


def to_multiple(number: Any, step: Any) -> Result:
    """MROUND: the nearest multiple, halves away from zero; #NUM! when the signs differ."""
    result = half_away(np.divide(number, np.where(np.equal(step, 0), 1.0, step))) * step
    return _marked(result, np.less(np.multiply(np.sign(number), np.sign(step)), 0), NUM)


def _stepped(number: Any, step: Any, whole: Callable[[Any], Any]) -> Any:
    """A multiple of |step|; 0 of 0."""
    nothing = np.equal(step, 0)
    return np.where(nothing, 0.0, _step(number, np.where(nothing, 1.0, np.abs(step)), whole))


def ceiling_math(number: Any, step: Any = 1.0, mode: Any = 0.0) -> Result:
    """CEILING.MATH: up to a multiple; with a mode, negative numbers go away from zero."""
    away = np.less(number, 0) & np.not_equal(mode, 0)
    return np.where(away, _stepped(number, step, np.floor), _stepped(number, step, np.ceil))


def floor_math(number: Any, step: Any = 1.0, mode: Any = 0.0) -> Result:
    """FLOOR.MATH: down to a multiple; with a mode, negative numbers go towards zero."""
    inwards = np.less(number, 0) & np.not_equal(mode, 0)
    return np.where(inwards, _stepped(number, step, np.ceil), _stepped(number, step, np.floor))


# --- whole numbers ---------------------------------------------------------------------------------------------------


def whole(number: float, least: float = 0.0, most: float = MOST_WHOLE) -> int:
    """The whole part of a number, which must lie between two bounds; else #NUM!."""
    if not least <= math.trunc(number) <= most:
        raise Problem("#NUM!")
    return math.trunc(number)


def all_whole(lists: tuple[list[Scalar], ...]) -> list[int]:
    """The whole parts of all values but blanks; texts that show no number and truth values are #VALUE!."""
    values = [value for part in lists for value in part if value is not None]
    if any(isinstance(value, bool) for value in values):
        raise Problem("#VALUE!")
    return [whole(to_number(value)) for value in values]


def least_multiple(*parts: list[Scalar]) -> float:
    """LCM."""
    values = all_whole(parts)
    found = math.lcm(*values) if values else 0
    if found >= MOST_WHOLE:
        raise Problem("#NUM!")
    return float(found)


def factorial(number: float) -> float:
    """FACT."""
    return float(math.factorial(whole(number, 0, 170)))


def double_factorial(number: float) -> float:
    """FACTDOUBLE: every second factor."""
    return float(math.prod(range(whole(number, -1, 300), 0, -2)))


def _chosen(number: int, chosen: int) -> float:
    """The binomial coefficient; #NUM! where it is certainly beyond the largest number."""
    if min(chosen, number - chosen) > 1030:
        raise Problem("#NUM!")
    return float(math.comb(number, chosen))


def combinations(number: float, chosen: float) -> float:
    """COMBIN."""
    return _chosen(whole(number), whole(chosen, 0, math.trunc(number)))


def combinations_repeated(number: float, chosen: float) -> float:
    """COMBINA: with repetition."""
    many, picked = whole(number), whole(chosen)
    if many == 0 and picked > 0:
        raise Problem("#NUM!")
    return _chosen(max(many + picked - 1, 0), picked) if picked else 1.0


def permutations(number: float, chosen: float) -> float:
    """PERMUT."""
    picked = whole(chosen, 0, math.trunc(number))
    if picked > 170:
        raise Problem("#NUM!")
    return float(math.perm(whole(number), picked))


def multinomial(*parts: list[Scalar]) -> float:
    """MULTINOMIAL: (a + b + ...)! / (a! b! ...)."""
    result, together = 1.0, 0
    for number in all_whole(parts):
        together += number
        result *= _chosen(together, number)
    return result


# --- series ----------------------------------------------------------------------------------------------------------


def power_series(x: float, first: float, step: float, coefficients: Numbers) -> float:
    """SERIESSUM: the sum of a_i x^(first + i step)."""
    if x == 0 and (first == 0 or step == 0):
        raise Problem("#NUM!")  # 0^0
    return math.fsum(c * math.pow(x, first + i * step) for i, c in enumerate(coefficients.tolist()))


def paired(left: Cells, right: Cells) -> tuple[Numbers, Numbers]:
    """The numbers that stand in the same places of two arrays of one size; #N/A when the sizes differ."""
    if left.numbers.size != right.numbers.size:
        raise Problem("#N/A")
    raise_first(left.codes)
    raise_first(right.codes)
    both = (left.codes.ravel() == NUMBER) & (right.codes.ravel() == NUMBER)
    return left.numbers.ravel()[both], right.numbers.ravel()[both]


def _of_pairs(function: Callable[[Numbers, Numbers], Any]) -> Callable[[Cells, Cells], float]:
    return lambda left, right: float(np.sum(function(*paired(left, right))))


# --- numerals --------------------------------------------------------------------------------------------------------

_ROMAN = {"I": 1, "V": 5, "X": 10, "L": 50, "C": 100, "D": 500, "M": 1000}
_LETTERS = "MDCLXVI"


@cache
def _roman_tokens(form: int) -> list[tuple[int, str]]:
    """The signs and the pairs that mean a difference, largest first. Each form allows a smaller sign before a large one."""
    tokens = [(value, letter) for letter, value in _ROMAN.items()]
    for place, letter in enumerate(_LETTERS[:-1]):
        nearest = place + 2 - place % 2
        for before in _LETTERS[nearest : nearest + form + 1]:
            tokens.append((_ROMAN[letter] - _ROMAN[before], before + letter))
    return sorted(tokens, reverse=True)


def roman(number: float, form: Any = 0.0) -> str:
    """ROMAN: the form is 0 (classic, TRUE) to 4 (shortest, FALSE)."""
    style = (0 if form else 4) if isinstance(form, bool) else math.trunc(to_number(form))
    rest = math.trunc(number)
    if not (0 <= rest <= 3999 and 0 <= style <= 4):
        raise Problem("#VALUE!")
    text = ""
    for value, token in _roman_tokens(style):
        text += token * (rest // value)
        rest %= value
    return text


def arabic(text: str) -> float:
    """ARABIC: what a Roman numeral means."""
    body = text.strip().upper()
    sign = -1.0 if body.startswith("-") else 1.0
    body = body.removeprefix("-")
    if len(body) > 255 or not re.fullmatch("[IVXLCDM]*", body):
        raise Problem("#VALUE!")
    digits = [_ROMAN[letter] for letter in body]
    following = [*digits[1:], 0]
    return sign * sum(-value if value < after else value for value, after in zip(digits, following, strict=False))


DIGITS = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZ"


def in_base(number: float, radix: float, least: float = 0.0) -> str:
    """BASE: a whole number written in a base, at least so many digits long."""
    rest, base, length = whole(number, 0, MOST_WHOLE - 1), whole(radix, 2, 36), whole(least, 0, 255)
    text = ""
    while rest:
        rest, digit = divmod(rest, base)
        text = DIGITS[digit] + text
    return (text or "0").rjust(length, "0")


def decimal(text: str, radix: float) -> float:
    """DECIMAL: the number that a text writes in a base."""
    base = whole(radix, 2, 36)
    body = text.strip().upper()
    if len(body) > 255 or any(letter not in DIGITS[:base] for letter in body):
        raise Problem("#NUM!")
    return float(int(body, base)) if body else 0.0


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
    "COT": _reciprocal(np.tan, True), "SEC": _reciprocal(np.cos, True), "CSC": _reciprocal(np.sin, True),
    "COTH": _reciprocal(np.tanh, False), "SECH": _reciprocal(np.cosh, False), "CSCH": _reciprocal(np.sinh, False),
    "ACOT": arc_cotangent,
    "ACOTH": lambda number: np.arctanh(np.divide(1.0, number)),
    "SQRTPI": lambda number: np.sqrt(np.multiply(number, np.pi)),
    "EVEN": even, "ODD": odd, "QUOTIENT": quotient, "MROUND": to_multiple,
    "CEILING.MATH": ceiling_math, "FLOOR.MATH": floor_math,
    "CEILING.PRECISE": ceiling_math, "ISO.CEILING": ceiling_math, "FLOOR.PRECISE": floor_math,
}  # fmt: skip
"""Function -> its array code."""

PLAIN: dict[str, Callable[..., Any]] = {
    "GCD": lambda *parts: float(math.gcd(*all_whole(parts))),
    "LCM": least_multiple,
    "FACT": factorial,
    "GAMMA": math.gamma,
    "FACTDOUBLE": double_factorial,
    "COMBIN": combinations,
    "COMBINA": combinations_repeated,
    "PERMUT": permutations,
    "PERMUTATIONA": lambda number, chosen: math.pow(whole(number), whole(chosen)),
    "MULTINOMIAL": multinomial,
    "SERIESSUM": power_series,
    "SUMX2MY2": _of_pairs(lambda x, y: x * x - y * y),
    "SUMX2PY2": _of_pairs(lambda x, y: x * x + y * y),
    "SUMXMY2": _of_pairs(lambda x, y: (x - y) ** 2),
    "ROMAN": roman,
    "ARABIC": arabic,
    "BASE": in_base,
    "DECIMAL": decimal,
}


class Arithmetic:
    """What stands instead of numpy's own code.

    functions   worksheet function, or ^ -> array code, as in `math.MAPS`
    operations  numpy's name of a function -> its code: of floats a float, of arrays an array; a last argument beyond is
                where the result goes, as numpy has it
    """

    def __init__(
        self, functions: Mapping[str, Callable[..., Any]], operations: Mapping[str, Callable[..., Any]]
    ) -> None:
        self.functions = functions
        self.operations = operations


FAST = Arithmetic({}, {})

_OPERATIONS: dict[str, Callable[[Any], Any]] = {
    "sin": portable.sin, "cos": portable.cos, "tan": portable.tan, "arcsin": portable.arcsin,
    "arccos": portable.arccos, "arctan": portable.arctan, "exp": portable.exp, "log": portable.log,
    "log10": portable.log10,
}  # fmt: skip


def _placed(function: Callable[..., Any], takes: int) -> Callable[..., Any]:
    """A function that puts its result into an array where there is one argument more than it takes; of single numbers it
    raises FloatingPointError where the result is not finite, as numpy does."""

    def called(*args: Any) -> Any:
        if len(args) == takes:
            found = function(*args)
            if isinstance(found, float) and not math.isfinite(found):
                raise FloatingPointError("not a finite number")
            return found
        np.copyto(args[takes], function(*args[:takes]))
        return args[takes]

    return called


PORTABLE = Arithmetic(
    {
        "SIN": portable.sin, "COS": portable.cos, "TAN": portable.tan, "ASIN": portable.arcsin,
        "ACOS": portable.arccos, "ATAN": portable.arctan, "EXP": portable.exp, "LN": portable.log,
        "LOG10": portable.log10, "ATAN2": partial(atan2, direction=portable.arctan2),
        "POWER": partial(power, raised=portable.power), "^": partial(power, raised=portable.power),
    },
    {name: _placed(function, 1) for name, function in _OPERATIONS.items()}
    | {"arctan2": _placed(portable.arctan2, 2), "power": _placed(portable.power, 2)},
)  # fmt: skip
"""For all that descriptions and the workbooks made of them use; other functions are numpy's here too."""

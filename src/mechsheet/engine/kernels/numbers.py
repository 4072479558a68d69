"""More mathematics: reciprocal trigonometry, multiples, whole numbers, numerals, series."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from ...formula.nodes import Scalar
from ..values.calling import Problem, raise_first, to_number
from ..values.cells import DIV0, NUM, NUMBER, Cells, Numbers
from .math import Result, half_away

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
    """A multiple of |step|; quotients that miss a whole number by rounding errors are whole."""
    step = np.abs(step)
    count = np.divide(number, np.where(np.equal(step, 0), 1.0, step))
    near = np.rint(count)
    count = np.where(np.abs(count - near) <= 4e-16 * np.abs(count), near, count)
    return np.where(np.equal(step, 0), 0.0, whole(count) * step)


def ceiling_math(number: Any, step: Any = 1.0, mode: Any = 0.0) -> Result:
    """CEILING.MATH: up to a multiple; with a mode, negative numbers go away from zero."""
    away = np.less(number, 0) & np.not_equal(mode, 0)
    return np.where(away, _stepped(number, step, np.floor), _stepped(number, step, np.ceil))


def floor_math(number: Any, step: Any = 1.0, mode: Any = 0.0) -> Result:
    """FLOOR.MATH: down to a multiple; with a mode, negative numbers go towards zero."""
    inwards = np.less(number, 0) & np.not_equal(mode, 0)
    return np.where(inwards, _stepped(number, step, np.ceil), _stepped(number, step, np.floor))


MAPS: dict[str, Callable[..., Result]] = {
    "COT": _reciprocal(np.tan, True), "SEC": _reciprocal(np.cos, True), "CSC": _reciprocal(np.sin, True),
    "COTH": _reciprocal(np.tanh, False), "SECH": _reciprocal(np.cosh, False), "CSCH": _reciprocal(np.sinh, False),
    "ACOT": arc_cotangent,
    "ACOTH": lambda number: np.arctanh(np.divide(1.0, number)),
    "SQRTPI": lambda number: np.sqrt(np.multiply(number, np.pi)),
    "EVEN": even, "ODD": odd, "QUOTIENT": quotient, "MROUND": to_multiple,
    "CEILING.MATH": ceiling_math, "FLOOR.MATH": floor_math,
    "CEILING.PRECISE": ceiling_math, "ISO.CEILING": ceiling_math, "FLOOR.PRECISE": floor_math,
}  # fmt: skip


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


PLAIN: dict[str, Callable[..., Any]] = {
    "GCD": lambda *parts: float(math.gcd(*all_whole(parts))),
    "LCM": least_multiple,
    "FACT": factorial,
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

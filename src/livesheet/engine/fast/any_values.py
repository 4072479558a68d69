"""What formulas written as Python functions call: see `any_kind`."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from ...formula.nodes import Scalar
from ..kernels.math import BELOW_HALF, rounded_one
from ..values.calling import to_number
from ..values.cells import DIV0, NA, NEAR, NUM, VALUE
from ..values.coerce import MOST_CHARACTERS, text_to_number, to_text
from ..values.typed_numbers import Serial
from .scalars import snap, trunc

COMPARED = {"=": "equal", "<>": "unequal", "<": "less", "<=": "at_most", ">": "more", ">=": "at_least"}


class CellError(Exception):
    """An error value on its way to the cell."""

    def __init__(self, code: int) -> None:
        super().__init__(code)
        self.code = code


class LeftError(Exception):
    """Something that only the interpreter can do."""


def _finite(number: float) -> float:
    if number - number != 0.0:
        raise CellError(NUM)
    return number


def _fail(code: int) -> float:
    raise CellError(code)


def _number(value: Scalar) -> float:
    if isinstance(value, float):
        return value
    if not isinstance(value, str):
        return to_number(value)
    shown = text_to_number(value)
    if shown is None:
        raise CellError(VALUE)
    if isinstance(shown, Serial):
        raise LeftError
    return shown


def _only_number(value: Scalar) -> float:
    if isinstance(value, float):
        return value
    raise LeftError


def _number_in(value: Scalar) -> float:
    """N: a text counts as 0."""
    return 0.0 if isinstance(value, str) else to_number(value)


def _shown(value: Scalar) -> Scalar:
    return 0.0 if value is None else value


def _over(left: float, right: float) -> float:
    if right == 0:
        raise CellError(DIV0)
    return _finite(left / right)


def raised(exponent: float, function: Callable[[float], float]) -> Callable[[float], float]:
    """A power as a function of its base, with the errors that cells show."""

    def power(base: float) -> float:
        if base == 0:
            if exponent < 0:
                raise CellError(DIV0)
            return _zero((base, 0.0))
        try:
            return _finite(function(base))
        except (ValueError, ArithmeticError):
            raise CellError(NUM) from None

    return power


def guarded(function: Callable[..., float]) -> Callable[..., float]:
    """A function of numbers that is #NUM! outside its domain."""

    def checked(*numbers: float) -> float:
        try:
            return _finite(function(*numbers))
        except (ValueError, ArithmeticError):
            raise CellError(NUM) from None

    return checked


def direction(function: Callable[[float, float], float]) -> Callable[[float, float], float]:
    """ATAN2, which takes x first and is #DIV/0! of nothing."""

    def atan2(x: float, y: float) -> float:
        if x == 0 == y:
            raise CellError(DIV0)
        return function(y, x)

    return atan2


def _modulo(number: float, divisor: float) -> float:
    if divisor == 0:
        raise CellError(DIV0)
    return _finite(number - divisor * ((number / divisor) // 1.0))


def _total(*numbers: float) -> float:
    result = 0.0  # so that the sum of -0 is 0
    for number in numbers:
        result += number
    return _finite(result)


def _zero(numbers: tuple[float, ...]) -> float:
    """The zero among numbers; of 0 and -0 numpy has a way of its own to take one."""
    signs = {math.copysign(1.0, number) for number in numbers if number == 0}
    if len(signs) > 1:
        raise LeftError
    return math.copysign(0.0, min(signs, default=1.0))


def _only_truth(value: Scalar) -> bool:
    if isinstance(value, float | bool):
        return bool(value)
    raise LeftError


def _joined_texts(left: Scalar, right: Scalar) -> str:
    text = to_text(left) + to_text(right)
    if len(text) > MOST_CHARACTERS:
        raise CellError(VALUE)
    return text


def power_of(function: Callable[[float, float], float]) -> Callable[[float, float], float]:
    """A power whose exponent is computed, with the errors that cells show."""

    def power(base: float, exponent: float) -> float:
        if exponent == 2.0:
            return _finite(base * base)
        if base == 0 and exponent <= 0:
            raise CellError(DIV0 if exponent < 0 else NUM)
        try:
            return _finite(function(base, exponent))
        except (ValueError, ArithmeticError):
            raise CellError(NUM) from None

    return power


def _truth(value: Scalar) -> bool:
    if isinstance(value, str):
        word = value.strip().upper()
        if word not in ("TRUE", "FALSE"):
            raise CellError(VALUE)
        return word == "TRUE"
    return bool(value)


def _compared(op: str) -> Callable[[Scalar, Scalar], bool]:
    """As `values.coerce.compared`: numbers before texts before truth values, a blank as the other side asks."""

    def compare(left: Scalar, right: Scalar) -> bool:
        if left.__class__ is float and right.__class__ is float:
            return numeric(left, right)
        left, right = _beside(left, right), _beside(right, left)
        kinds = _kind(left), _kind(right)
        if kinds[0] != kinds[1]:
            return op == "<>" or (op != "=" and (kinds[0] < kinds[1]) == (op[0] == "<"))
        if isinstance(left, str) and isinstance(right, str):
            a, b = left.casefold(), right.casefold()
            return numeric(0.0 if a <= b else 1.0, 0.0 if b <= a else 1.0)
        return numeric(to_number(left), to_number(right))

    numeric: Callable[[Any, Any], bool] = {
        "<": _less,
        "<=": _at_most,
        ">": _more,
        ">=": _at_least,
        "=": equal,
        "<>": _unequal,
    }[op]
    return compare


def _beside(value: Scalar, other: Scalar) -> Scalar:
    if value is not None:
        return value
    if isinstance(other, str):
        return ""
    return False if isinstance(other, bool) else 0.0


def _kind(value: Scalar) -> int:
    return 1 if isinstance(value, str) else 2 if isinstance(value, bool) else 0


def _less(left: float, right: float) -> bool:
    return left < right - NEAR * abs(right)


def _at_most(left: float, right: float) -> bool:
    return left <= right + NEAR * abs(right)


def _more(left: float, right: float) -> bool:
    return left > right + NEAR * abs(right)


def _at_least(left: float, right: float) -> bool:
    return left >= right - NEAR * abs(right)


def equal(left: float, right: float) -> bool:
    """Whether two numbers are equal, nearly as Excel has it."""
    return right - NEAR * abs(right) <= left <= right + NEAR * abs(right)


def _unequal(left: float, right: float) -> bool:
    return not right - NEAR * abs(right) <= left <= right + NEAR * abs(right)


def _iferror(first: Callable[[], Scalar], second: Callable[[], Scalar]) -> Scalar:
    try:
        return first()
    except CellError:
        return second()


def _ifna(first: Callable[[], Scalar], second: Callable[[], Scalar]) -> Scalar:
    try:
        return first()
    except CellError as problem:
        if problem.code != NA:
            raise
        return second()


EXACT: dict[str, Callable[[float], float]] = {"absolute": abs, "floor": lambda number: number // 1.0}
NAMES: dict[str, Any] = {
    "finite": _finite, "fail": _fail, "number": _number, "only_number": _only_number, "shown": _shown,
    "plus": lambda a, b: _finite(a + b), "minus": lambda a, b: _finite(a - b), "times": lambda a, b: _finite(a * b),
    "over": _over, "plus_snapped": lambda a, b: snap(_finite(a + b), a), "squared": lambda a: _finite(a * a),
    "minus_snapped": lambda a, b: snap(_finite(a - b), a), "modulo": _modulo, "total": _total,
    "joined": _joined_texts, "only_truth": _only_truth,
    "least": lambda *numbers: min(numbers, default=0.0) or _zero(numbers),
    "greatest": lambda *numbers: max(numbers, default=0.0) or _zero(numbers),
    "number_in": _number_in, "truth": _truth, "rounded_one": rounded_one,
    "rounded_whole": lambda a: trunc(a + math.copysign(BELOW_HALF, a)), "iferror": _iferror, "ifna": _ifna,
    **{name: _compared(op) for op, name in COMPARED.items()},
}  # fmt: skip

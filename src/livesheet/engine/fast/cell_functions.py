"""What formulas written as Python functions (`cell_code`) call, and the cells of one evaluation as they read them.

What is more than arithmetic, a comparison of numbers and of plain words is the interpreter's.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from ...formula.book import Settings
from ...formula.nodes import Boolean, Missing, Node, Number, Scalar, Text
from ...time_limit import TimeLimitError
from ..interpreter.evaluator import Evaluator
from ..kernels.math import BELOW_HALF, rounded_one
from ..kernels.table import KERNELS
from ..values.cells import BLANK, ERROR, ERROR_NAMES, NEAR, TEXT, Cells, Frame, NotReadyError, error_code
from ..values.coerce import MOST_CHARACTERS, Problem, Serial, number_shown, text_to_number, to_number, to_text, to_truth
from .scalars import snap, trunc

COMPARED = {"=": "equal", "<>": "unequal", "<": "less", "<=": "at_most", ">": "more", ">=": "at_least"}


class LeftError(Exception):
    """Something that only the interpreter can do."""


def _finite(number: float) -> float:
    if number - number != 0.0:
        raise Problem("#NUM!")
    return number


def _fail(code: int) -> float:
    raise Problem(ERROR_NAMES[code - ERROR])


def _number(value: Scalar) -> float:
    if isinstance(value, float):
        return value
    if not isinstance(value, str):
        return to_number(value)
    shown = text_to_number(value)
    if shown is None:
        raise Problem("#VALUE!")
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
        raise Problem("#DIV/0!")
    return _finite(left / right)


def guarded(function: Callable[..., float]) -> Callable[..., float]:
    """A function of numbers that is #NUM! outside its domain."""

    def checked(*numbers: float) -> float:
        try:
            return _finite(function(*numbers))
        except (ValueError, ArithmeticError):
            raise Problem("#NUM!") from None

    return checked


def raised(exponent: float, function: Callable[[float], float]) -> Callable[[float], float]:
    """A power as a function of its base, with the errors that cells show."""
    checked = guarded(function)

    def power(base: float) -> float:
        if base == 0:
            if exponent < 0:
                raise Problem("#DIV/0!")
            return _zero((base, 0.0))
        return checked(base)

    return power


def direction(function: Callable[[float, float], float]) -> Callable[[float, float], float]:
    """ATAN2, which takes x first and is #DIV/0! of nothing."""

    def atan2(x: float, y: float) -> float:
        if x == 0 == y:
            raise Problem("#DIV/0!")
        return function(y, x)

    return atan2


def _modulo(number: float, divisor: float) -> float:
    if divisor == 0:
        raise Problem("#DIV/0!")
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
        raise Problem("#VALUE!")
    return text


def power_of(function: Callable[[float, float], float]) -> Callable[[float, float], float]:
    """A power whose exponent is computed, with the errors that cells show."""
    checked = guarded(function)

    def power(base: float, exponent: float) -> float:
        if exponent == 2.0:
            return _finite(base * base)
        if base == 0 and exponent <= 0:
            raise Problem("#DIV/0!" if exponent < 0 else "#NUM!")
        return checked(base, exponent)

    return power


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
    except Problem:
        return second()


def _ifna(first: Callable[[], Scalar], second: Callable[[], Scalar]) -> Scalar:
    try:
        return first()
    except Problem as problem:
        if problem.code != "#N/A":
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
    "number_in": _number_in, "truth": to_truth, "rounded_one": rounded_one,
    "rounded_whole": lambda a: trunc(a + math.copysign(BELOW_HALF, a)), "iferror": _iferror, "ifna": _ifna,
    **{name: _compared(op) for op, name in COMPARED.items()},
}  # fmt: skip


MOST = 256
"""Cells of a line: numpy takes as long for them as Python."""
_AS_EXCEL = Settings()
_ANYWHERE = Frame(0, 0, 0, 1, 1)

Places = Sequence[int]
"""Where the cells of a line, a short row or column, lie: a range where they lie side by side; -1 for an empty cell."""


class CellCode(NamedTuple):
    """How the cells of a column are computed.

    leading  the places of cells that are read before anything is computed, and how much further each is in the next row: the
             first error among them is the value; of IFERROR it decides about the next of such lists, or
    instead  the number that is the value then
    value    a cell's value as a function of (what is computed so far, the row: 0 is the block's first); None where only the
             interpreter knows it, or nobody has asked for code
    """

    leading: tuple[tuple[tuple[int, int], ...], ...]
    instead: float | None
    value: Callable[[Memory, int], Scalar] | None


class Memory:
    """The flat array of one evaluation as Python reads it fastest."""

    def __init__(self, ev: Evaluator) -> None:
        self.ev = ev
        self.numbers: Any = ev.numbers.data
        self.codes: Any = ev.codes.data
        self.texts = ev.texts

    # single cells

    def look(self, place: int) -> Scalar:
        """What stands at a place (-1: nothing). Raises Problem for an error."""
        if place < 0:
            return None
        code = self.codes[place]
        if not code:
            number: float = self.numbers[place]
            return number
        if code >= ERROR:
            raise Problem(ERROR_NAMES[code - ERROR])
        if code == BLANK:
            return None
        return self.texts.text(self.numbers[place]) if code == TEXT else bool(self.numbers[place])

    def code(self, place: int) -> int:
        """What kind of value stands at a place."""
        found: int = BLANK if place < 0 else self.codes[place]
        return found

    def fill(self, code: CellCode, down: int, place: int) -> bool:
        """Compute a cell; whether that could be done by code."""
        leading, instead, value_of = code
        for places in leading:  # an exception takes ten times as long
            error = 0
            for at, step in places:
                error = self.codes[at + step * down]
                if error:
                    break
            if error < ERROR:
                break
        else:
            self.numbers[place], self.codes[place] = (math.nan, error) if instead is None else (instead, 0)
            return True
        if value_of is None:
            return False
        try:
            value = value_of(self, down)
        except Problem as problem:
            self.numbers[place], self.codes[place] = math.nan, error_code(problem.code)
        except LeftError:
            return False
        else:
            if value.__class__ is float:
                self.numbers[place], self.codes[place] = value, 0
            else:
                self.numbers[place], self.codes[place] = self.texts.encode(value)
        return True

    def called(self, name: str, *values: Scalar) -> Scalar:
        """A function of single values, by its kernel."""
        try:
            with np.errstate(all="ignore"):
                found = KERNELS[name](self.ev, tuple(map(_written, values)), _ANYWHERE, False)
        except TimeLimitError:
            raise
        except Exception:
            raise LeftError from None  # the interpreter says what becomes of the cell, and remarks it
        return self._single(found)

    def interpreted(self, part: Node, first: tuple[int, int, int], down: int) -> Scalar:
        """A part of a cell's formula by the interpreter: the cell so far `down` from the `first`, (sheet, row, column).

        Ranges are arrays there, as they are where lists of values are asked for: what is not one value then is left to it.
        """
        sheet, row, col = first
        try:
            with np.errstate(all="ignore"):
                found = self.ev.value(part, Frame(sheet, row + down, col, 1, 1, down), True)
        except (NotReadyError, TimeLimitError):
            raise
        except Exception:
            raise LeftError from None
        return self._single(found)

    def _single(self, found: Cells) -> Scalar:
        if np.ndim(found.numbers) or np.ndim(found.codes):
            raise LeftError  # an array
        code = 0 if found.codes is None else int(found.codes)
        if code >= ERROR:
            raise Problem(ERROR_NAMES[code - ERROR])
        return self.texts.decode(float(found.numbers), code)

    # lines

    def indexed(self, places: Places, number: float) -> Scalar:
        """INDEX of cells in a line; what lies outside of them is the interpreter's."""
        if not 1 <= number < len(places) + 1:
            raise LeftError
        return self.look(places[int(number) - 1])

    def part(self, places: Places, first: Callable[[], float], last: Callable[[], float]) -> Places:
        """`INDEX(line, first):INDEX(line, last)`."""
        try:
            low, high = sorted((first(), last()))
        except Problem:
            raise LeftError from None
        if not (low >= 1 and high < len(places) + 1):
            raise LeftError
        return places[int(low) - 1 : int(high)]

    def in_line(self, places: Places) -> list[float]:
        """The numbers of a line; blanks, texts and truth values do not count. Raises Problem for the first error."""
        codes = self._codes(places)
        if isinstance(places, range) and not any(codes):
            whole: list[float] = self.numbers[places.start : places.stop].tolist()
            return whole
        for code in codes:
            if code >= ERROR:
                raise Problem(ERROR_NAMES[code - ERROR])
        return [self.numbers[place] for place, code in zip(places, codes, strict=True) if not code]

    def count(self, places: Places) -> int:
        """How many numbers."""
        return self._codes(places).count(0)

    def _codes(self, places: Places) -> Sequence[int]:
        if isinstance(places, range):
            return bytes(self.codes[places.start : places.stop])
        return [self.code(place) for place in places]

    def match(self, wanted: Scalar, places: Places) -> float:
        """Where a number, or a word, stands first, from 1. Raises Problem where it does not."""
        is_wanted = self._test(wanted)
        for at, place in enumerate(places, 1):
            if is_wanted(place):
                return float(at)
        raise Problem("#N/A")

    def count_if(self, *asked: tuple[Places, Scalar]) -> float:
        """COUNTIFS: several lines of as many cells, and what is asked for in each."""
        return float(len(self._fitting(asked)))

    def in_line_if(self, places: Places, *asked: tuple[Places, Scalar]) -> list[float]:
        """As `in_line`, of the cells beside which all fit what is asked for."""
        return self.in_line([places[down] for down in self._fitting(asked)])

    def _fitting(self, asked: tuple[tuple[Places, Scalar], ...]) -> Sequence[int]:
        found: Sequence[int] = range(len(asked[0][0]))
        for places, wanted in asked:
            fits = self._test(wanted, shown=True)
            found = [down for down in found if fits(places[down])]
        return found

    def criterion(self, place: int) -> Scalar:
        """What stands in a cell that says what is asked for."""
        if self.code(place) >= ERROR:
            raise LeftError
        return self.look(place)

    def _test(self, wanted: Scalar, shown: bool = False) -> Callable[[int], bool]:
        """Whether a place holds a number, or a word. `shown`: to criteria a text that shows a number is that number."""
        if isinstance(wanted, float):
            return lambda place: self._is_number(wanted, place, shown)
        if not isinstance(wanted, str) or self.texts.settings != _AS_EXCEL or not _is_word(wanted):
            raise LeftError
        word, known = wanted.casefold(), dict[float, bool]()

        def is_word(place: int) -> bool:
            if self.code(place) != TEXT:
                return False
            key = self.numbers[place]
            if key not in known:
                known[key] = self.texts.text(key).casefold() == word
            return known[key]

        return is_word

    def _is_number(self, wanted: float, place: int, shown: bool) -> bool:
        code = self.code(place)
        number = self.numbers[place] if not code else None
        if shown and code == TEXT:
            number = number_shown(self.texts.text(self.numbers[place]), self.texts)
        return number is not None and equal(number, wanted)


@lru_cache(1024)
def _is_word(text: str) -> bool:
    """Whether a text means nothing but itself where it is looked for: no number, no truth value, no pattern."""
    return text.isalpha() and text.upper() not in ("TRUE", "FALSE") and text_to_number(text) is None


def _written(value: Scalar) -> Node:
    """A value as it would be written in a formula."""
    match value:
        case bool():
            return Boolean(value)
        case float():
            return Number(value)
        case str():
            return Text(value)
    return Missing()  # an error never gets here: it is raised

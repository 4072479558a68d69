"""Functions of texts, scalar by scalar."""

from __future__ import annotations

import re
from collections.abc import Callable
from decimal import ROUND_HALF_UP, Decimal
from typing import TYPE_CHECKING, Any

import numpy as np

from ...formula.nodes import ErrorValue, Missing, Node, Scalar
from ..texts.number_formats import WIDE, formatted
from ..values.calling import EPOCHS
from ..values.cells import BLANK, Cells, codes_of
from ..values.coerce import each, text_to_number, to_text
from ..values.frames import Frame

if TYPE_CHECKING:
    from ..interpreter.evaluator import Evaluator

Args = tuple[Node, ...]
VALUE = ErrorValue("#VALUE!")


def _number(value: Scalar) -> float | None:
    """A scalar as a number, None for a text that shows none."""
    if value is None:
        return 0.0
    if isinstance(value, str):
        return text_to_number(value)
    return float(value) if isinstance(value, bool | float | int) else None


def text(value: Scalar, pattern: Scalar, epochs: float = 0.0) -> Scalar:
    """TEXT(value, format). The format's decimal sign is the point; #VALUE! for what is no format."""
    number = _number(value)
    shown = to_text(value) if number is None or isinstance(value, bool) else number
    if pattern is None or pattern == "":
        return "" if isinstance(shown, float) else shown
    found = formatted(shown, to_text(pattern), epochs)
    return VALUE if found is None else found


def _text(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    epochs = EPOCHS if ev.layout.date1904 else 0.0
    kernel: Callable[..., Cells] = _each(lambda value, pattern: text(value, pattern, epochs))
    return kernel(ev, args, frame, spread)


def fixed(value: Scalar, decimals: Scalar = 2.0, plain: Scalar = False) -> Scalar:
    """FIXED(number, decimals, no commas)."""
    number, places = _number(value), _number(decimals)
    if number is None or places is None:
        return VALUE
    whole_places = int(places)
    if whole_places < 0:
        scale = Decimal(10) ** -whole_places
        number = float((Decimal(f"{number:.15g}") / scale).quantize(Decimal(1), ROUND_HALF_UP, WIDE) * scale)
    comma = "0" if _number(plain) else "#,##0"
    if whole_places > 127:
        return VALUE
    return formatted(number, comma + ("." + "0" * whole_places if whole_places > 0 else ""))


def _counted(value: Scalar, many: Scalar) -> tuple[str, int] | None:
    number = _number(many)
    return None if number is None or number < 0 else (to_text(value), int(number))


def left(value: Scalar, many: Scalar = 1.0) -> Scalar:
    """LEFT."""
    parts = _counted(value, many)
    return VALUE if parts is None else parts[0][: parts[1]]


def right(value: Scalar, many: Scalar = 1.0) -> Scalar:
    """RIGHT."""
    parts = _counted(value, many)
    return VALUE if parts is None else parts[0][max(0, len(parts[0]) - parts[1]) :]


def mid(value: Scalar, first: Scalar, many: Scalar) -> Scalar:
    """MID: from the `first`-th character (counted from 1)."""
    parts, start = _counted(value, many), _number(first)
    if parts is None or start is None or start < 1:
        return VALUE
    return parts[0][int(start) - 1 : int(start) - 1 + parts[1]]


def rept(value: Scalar, many: Scalar) -> Scalar:
    """REPT: #VALUE! beyond what a cell can hold (32,767 characters)."""
    parts = _counted(value, many)
    return VALUE if parts is None or len(parts[0]) * parts[1] > 32767 else parts[0] * parts[1]


def value_(shown: Scalar) -> Scalar:
    """VALUE: the number that a text shows."""
    number = None if isinstance(shown, bool) else _number(shown)
    return VALUE if number is None else number


def _each(function: Callable[..., Scalar]) -> Any:
    def kernel(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
        cells = tuple(
            Cells(np.float64(0), np.uint8(BLANK)) if isinstance(arg, Missing) else ev.value(arg, frame, spread)
            for arg in args
        )
        return each(function, cells, ev.texts)

    return kernel


def concat(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    """CONCAT: like CONCATENATE, but takes ranges too, row by row."""
    del spread
    parts: list[Cells] = []
    for arg in args:
        cells = ev.value(arg, frame, spread=True)
        if len(cells.shape) <= 2:
            parts.append(cells)
            continue
        shape = cells.shape
        numbers, codes = np.broadcast_to(cells.numbers, shape), np.broadcast_to(codes_of(cells), shape)
        for i in range(shape[0]):
            for j in range(shape[1]):
                tail = tuple(n for n in shape[2:] if n > 1) or ()
                parts.append(Cells(numbers[i, j].reshape(tail), codes[i, j].reshape(tail)))
    return each(lambda *values: "".join(map(to_text, values)), tuple(parts), ev.texts)


KERNELS: dict[str, Any] = {
    "TEXT": _text, "FIXED": _each(fixed), "VALUE": _each(value_), "CONCAT": concat,
    "CONCATENATE": _each(lambda *values: "".join(map(to_text, values))),
    "LEN": _each(lambda value: float(len(to_text(value)))), "LEFT": _each(left), "RIGHT": _each(right),
    "MID": _each(mid), "REPT": _each(rept), "UPPER": _each(lambda value: to_text(value).upper()),
    "LOWER": _each(lambda value: to_text(value).lower()),
    "TRIM": _each(lambda value: re.sub(" +", " ", to_text(value)).strip(" ")),
    "EXACT": _each(lambda a, b: to_text(a) == to_text(b)),
}  # fmt: skip

"""Texts that show numbers and dates in a format: TEXT, FIXED, DOLLAR."""

from __future__ import annotations

import math
from collections.abc import Callable
from decimal import ROUND_HALF_UP, Decimal
from typing import Any

from ...formula.nodes import Scalar
from ..interpreter.calling import Args
from ..interpreter.closures import Evaluation
from ..texts.number_formats import WIDE, formatted
from ..values.cells import Cells, Frame
from ..values.coerce import Problem, Serial, since_epoch, to_text
from .text import VALUE, _each, number_or_none


def text(value: Scalar, pattern: Scalar, epochs: float = 0.0) -> Scalar:
    """TEXT(value, format). The format's decimal sign is the point; #VALUE! for what is no format."""
    number = number_or_none(value)
    if isinstance(number, Serial):
        number = since_epoch(number, epochs)
    shown = to_text(value) if number is None or isinstance(value, bool) else number
    if pattern is None or pattern == "":
        return "" if isinstance(shown, float) else shown
    found = formatted(shown, to_text(pattern), epochs)
    return VALUE if found is None else found


def _text(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    epochs = ev.texts.epochs
    kernel: Callable[..., Cells] = _each(lambda value, pattern: text(value, pattern, epochs))
    return kernel(ev, args, frame, spread)


_MOST_PLACES = 127
"""Decimals that FIXED and DOLLAR show."""


def fixed(number: float, decimals: float = 2.0, plain: bool = False) -> str:
    """FIXED(number, decimals, no commas)."""
    return _with_places(number, decimals, "{0}" if plain else "#,##{0}")


def dollar(number: float, decimals: float = 2.0) -> str:
    """DOLLAR."""
    return _with_places(number, decimals, "$#,##{0};($#,##{0})")


def _with_places(number: float, decimals: float, pattern: str) -> str:
    """A number in a format in which {0} stands for a zero and the decimals."""
    places = math.trunc(decimals)
    if places > _MOST_PLACES:
        raise Problem("#VALUE!")
    zeros = "0." + "0" * places if places > 0 else "0"
    return formatted(_to_tens(number, places), pattern.format(zeros)) or ""


def _to_tens(number: float, places: int) -> float:
    """Rounded to tens, hundreds ... where there are fewer than no decimals; else as it is."""
    if places >= 0:
        return number
    scale = Decimal(10) ** -places
    return float((Decimal(f"{number:.15g}") / scale).quantize(Decimal(1), ROUND_HALF_UP, WIDE) * scale)


KERNELS: dict[str, Any] = {"TEXT": _text}

PLAIN: dict[str, Callable[..., Any]] = {"FIXED": fixed, "DOLLAR": dollar}

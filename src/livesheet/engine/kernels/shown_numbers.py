"""Texts that show numbers and dates in a format: TEXT, FIXED, DOLLAR."""

from __future__ import annotations

import math
from collections.abc import Callable
from decimal import ROUND_HALF_UP, Decimal
from typing import TYPE_CHECKING, Any

from ...formula.nodes import Node, Scalar
from ..texts.number_formats import WIDE, formatted
from ..values.calling import Problem, since_epoch
from ..values.cells import Cells
from ..values.coerce import to_text
from ..values.frames import Frame
from ..values.typed_numbers import Serial
from .text import VALUE, _each, _number

if TYPE_CHECKING:
    from ..interpreter.evaluator import Evaluator

Args = tuple[Node, ...]


def text(value: Scalar, pattern: Scalar, epochs: float = 0.0) -> Scalar:
    """TEXT(value, format). The format's decimal sign is the point; #VALUE! for what is no format."""
    number = _number(value)
    if isinstance(number, Serial):
        number = since_epoch(number, epochs)
    shown = to_text(value) if number is None or isinstance(value, bool) else number
    if pattern is None or pattern == "":
        return "" if isinstance(shown, float) else shown
    found = formatted(shown, to_text(pattern), epochs)
    return VALUE if found is None else found


def _text(ev: Evaluator, args: Args, frame: Frame, spread: bool) -> Cells:
    epochs = ev.texts.epochs
    kernel: Callable[..., Cells] = _each(lambda value, pattern: text(value, pattern, epochs))
    return kernel(ev, args, frame, spread)


def fixed(value: Scalar, decimals: Scalar = 2.0, plain: Scalar = False) -> Scalar:
    """FIXED(number, decimals, no commas)."""
    number, places = _number(value), _number(decimals)
    if number is None or places is None:
        return VALUE
    whole_places = int(places)
    number = _to_tens(number, whole_places)
    comma = "0" if _number(plain) else "#,##0"
    if whole_places > 127:
        return VALUE
    return formatted(number, comma + ("." + "0" * whole_places if whole_places > 0 else ""))


def _to_tens(number: float, places: int) -> float:
    """Rounded to tens, hundreds ... where there are fewer than no decimals; else as it is."""
    if places >= 0:
        return number
    scale = Decimal(10) ** -places
    return float((Decimal(f"{number:.15g}") / scale).quantize(Decimal(1), ROUND_HALF_UP, WIDE) * scale)


def dollar(number: float, decimals: float = 2.0) -> str:
    """DOLLAR."""
    places = math.trunc(decimals)
    if places > 127:
        raise Problem("#VALUE!")
    number = _to_tens(number, places)
    body = "$#,##0" + ("." + "0" * places if places > 0 else "")
    return formatted(number, f"{body};({body})") or ""


KERNELS: dict[str, Any] = {"TEXT": _text, "FIXED": _each(fixed)}

PLAIN: dict[str, Callable[..., Any]] = {"DOLLAR": dollar}

"""What a user puts into a cell: numbers of every type, and what is refused because a cell of numbers would not take it."""

from __future__ import annotations

import math
import re
from numbers import Real
from typing import Any

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import ErrorValue, Scalar
from livesheet.said import say

_COMMA = re.compile(r"[+-]?[0-9]+,[0-9]+(?:[eE][+-]?[0-9]+)?")
_SHOWN = 40


def cell_value(where: str, value: Any, held: Scalar, force: bool = False) -> Scalar | Fault:
    """A value as a cell holds it, or why it is refused.

    held   what the cell holds in the file: where that is a number, only numbers are taken
    force  take anything that a cell can hold (texts, truth values, nothing), whatever the cell holds
    """
    if isinstance(value, ErrorValue):
        return value
    is_truth = isinstance(value, bool | np.bool_)
    if not is_truth and _is_number(value):
        number = float(value)
        if math.isfinite(number):
            return number
        return Fault(say("{number} is no number that a cell can hold", number=number), key=where)
    if not (value is None or is_truth or isinstance(value, str)):
        kind = type(value).__name__
        return Fault(
            say("a {kind} is no value of one cell: {value}", kind=kind, value=_shown(value)),
            key=where,
            hint=say("one number, for example 66.5"),
        )
    scalar: Scalar = bool(value) if is_truth else value
    if force:
        return scalar
    if isinstance(scalar, str) and _COMMA.fullmatch(scalar.strip()) and not isinstance(held, str):
        hint = say("write {number}", number=scalar.strip().replace(",", "."))
        return Fault(say("expected a number, found {value}", value=_shown(scalar)), key=where, hint=hint)
    if isinstance(held, float):
        return Fault(say("expected a number, found {value}", value=_shown(scalar)), key=where, hint=_hint(scalar, held))
    return scalar


def _is_number(value: Any) -> bool:
    if isinstance(value, Real | str | None):
        return isinstance(value, Real)
    from decimal import Decimal  # the last of all types to be asked for, and slow to load

    return isinstance(value, Decimal)


def typed(where: str, text: str, held: Scalar) -> Scalar | Fault:
    """As `cell_value` for what is typed: `65`, `TRUE`, `'65` (a text whatever the cell holds), anything else a text."""
    if text.startswith("'"):
        return text[1:]
    if text.upper() in ("TRUE", "FALSE"):
        return cell_value(where, text.upper() == "TRUE", held)
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    return cell_value(where, number if math.isfinite(number) and "_" not in text else text, held)


def _hint(value: Scalar, held: float) -> str:
    if isinstance(value, bool):
        return f"write {int(value)}"
    return f"the cell holds a number: write one, for example {held:.12g}"


def _shown(value: object) -> str:
    text = f'"{value}"' if isinstance(value, str) else repr(value)
    return text if len(text) <= _SHOWN else text[:_SHOWN] + "…"

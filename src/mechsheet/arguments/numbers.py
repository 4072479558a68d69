"""Numbers as people give them to the library: of any numeric type, and nothing that only looks like one."""

from __future__ import annotations

import math
from decimal import Decimal
from numbers import Integral, Real
from typing import Any

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError


def number_given(value: Any, key: str) -> float:
    """The number that an argument is: int, float, Fraction, Decimal, or a scalar of numpy; `key` names the argument.

    Raises MechsheetError for truth values, texts, everything else, and what is not finite.
    """
    if getattr(value, "shape", None) == () and hasattr(value, "item"):
        value = value.item()  # a numpy scalar, or an array of one number without axes
    if isinstance(value, bool) or not isinstance(value, Real | Decimal):
        raise MechsheetError(
            Fault(say("expected a number, found {value!r:.60}", value=value), key=key, hint=_hint(value))
        )
    try:
        found = float(value)
    except (OverflowError, ValueError):  # too many digits; a Decimal that signals
        found = math.nan
    if not math.isfinite(found):
        raise MechsheetError(Fault(say("expected a finite number, found {value!s:.60}", value=value), key=key))
    return found


def whole_number_given(value: Any, key: str) -> int:
    """The same for a count: a float is refused unless it is whole."""
    found = number_given(value, key)
    if not found.is_integer():
        raise MechsheetError(Fault(say("expected a whole number, found {found:g}", found=found), key=key))
    return int(found)


def number_text(value: Any, key: str) -> str:
    """The number as a description writes it: whole numbers without a point. Raises as `number_given`."""
    found = number_given(value, key)
    return str(int(value)) if isinstance(value, Integral) else repr(found)


def _hint(value: object) -> str:
    if not isinstance(value, str):
        return ""
    try:
        return say("write {number:g}, without quotes", number=float(value.replace(",", ".")))
    except ValueError:
        return ""

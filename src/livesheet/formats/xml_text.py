"""Text inside XML, and values of cells as both formats spell them. Dates are numbers in formulas."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from datetime import date

from livesheet.formula.nodes import ErrorValue, Scalar

_ILLEGAL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
_NEGATIVE_ZERO = "-0"
_OOXML_ESCAPE = re.compile("(_x[0-9A-Fa-f]{4}_)")


def legal(text: str, instead: str = "") -> str:
    """The text without the characters that XML cannot hold in any spelling, or with another one in their place."""
    return _ILLEGAL.sub(instead, text)


def escaped(text: str) -> str:
    """Text between tags, without characters that XML cannot hold."""
    return legal(text).replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def attribute(text: str) -> str:
    """Text between double quotes; line breaks and tabs survive."""
    text = escaped(text).replace('"', "&quot;")
    return text.replace("\n", "&#10;").replace("\r", "&#13;").replace("\t", "&#9;")


def ooxml_escaped(text: str) -> str:
    """Text between tags of an OOXML part: characters that XML cannot hold become `_x0001_`, as Excel writes them."""
    if "_x" in text:
        text = _OOXML_ESCAPE.sub(r"_x005F\1", text)
    text = text.replace("\r", "_x000D_")
    text = _ILLEGAL.sub(lambda match: f"_x{ord(match.group()):04X}_", text)
    return text.replace("&", "&amp;").replace("<", "&lt;").replace(">", "&gt;")


def number(value: float) -> str:
    """The shortest text that reads back as the same float64, and 0 for -0, which no spreadsheet program writes.

    A number that is not finite is a bug of the caller.
    """
    if not math.isfinite(value):
        raise ValueError(f"{value} reached a file writer")
    return float.__repr__(float(value) + 0.0).removesuffix(".0")


def numbers(values: Sequence[Scalar]) -> list[str] | None:
    """The texts of a column of floats, or None when anything else is among them. Raises ValueError as `number`."""
    try:
        # float.__repr__ refuses everything that is no float, and numpy's floats are floats to it.
        texts = [text.removesuffix(".0") for text in map(float.__repr__, values)]
    except TypeError:
        return None
    if not all(map(math.isfinite, values)):  # type: ignore[arg-type]
        raise ValueError("a number that is not finite reached a file writer")
    if _NEGATIVE_ZERO in texts:
        texts = ["0" if text == _NEGATIVE_ZERO else text for text in texts]
    return texts


def plain_value(value: Scalar, place: str) -> float | str | bool | ErrorValue:
    """The value of a formula cell, which must have one: a file without values would be shown as zeros."""
    if value is None:
        raise ValueError(f"{place}: a formula cell without a value reached a file writer")
    return value


NULL_DATE = date(1899, 12, 30)
"""Day 0 where a document does not say otherwise (OpenDocument 1.3 part 3, 19.614)."""
NULL_DATE_1904 = date(1904, 1, 1)

_DATE = re.compile(r"([0-9]{4})-([0-9]{2})-([0-9]{2})(?:T([0-9]{2}):([0-9]{2}):([0-9]{2}(?:\.[0-9]+)?))?Z?")


def finite(text: str) -> float | None:
    """A number, None when `text` is none."""
    try:
        value = float(text)
    except ValueError:
        return None
    return value if math.isfinite(value) and "_" not in text else None


def day_number(text: str, null_date: date) -> float | None:
    """`2024-02-29T12:00:00` as days since `null_date`, None when it is no date."""
    match = _DATE.fullmatch(text)
    if match is None:
        return None
    year, month, day, hours, minutes, seconds = match.groups()
    if (year, month, day) == ("1900", "02", "29"):  # a day of Excel's calendar only
        month, day = "02", "28"
    try:
        days = (date(int(year), int(month), int(day)) - null_date).days
    except ValueError:
        return None
    return days + (3600 * int(hours or 0) + 60 * int(minutes or 0) + float(seconds or 0)) / 86400

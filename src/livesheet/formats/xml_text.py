"""Text inside XML, and cell values as both formats write them."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence

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

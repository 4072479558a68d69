"""Symbols as people write them, in cells."""

from __future__ import annotations

from livesheet.workbook import Rich
from mechsheet.words.symbols import parts


def rich(symbol: str, after: str = "") -> Rich | str:
    """The symbol with its subscript, for a cell; `after` is appended as it is (" [°]")."""
    letter, subscript = parts(symbol)
    if not subscript:
        return letter + after
    return Rich(tuple(part for part in ((letter, "italic"), (subscript, "sub"), (after, "")) if part[0]))

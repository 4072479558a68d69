"""Texts that are searched for, as the workbook has it: with wildcards, as regular expressions, or as they stand."""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Protocol

from ...formula.book import Settings
from ...said import say
from ..values.frames import UnsupportedError
from .expressions import expression
from .wildcards import Wildcards

_IGNORING_CASE = 1.0
_SPECIAL = re.compile(r"[?*+.\[\]^$\\<>()|]")
"""What makes a text a regular expression to LibreOffice; any other text is taken as it stands, which is quicker."""


class Pattern(Protocol):
    """A text that is searched for, without regard to case.

    of_numbers  whether numbers fit by the text that shows them
    """

    of_numbers: bool

    def fits(self, text: str) -> bool:
        """Whether a cell's text is what is searched for."""

    def search(self, text: str, start: int) -> int:
        """Where it stands in a text first; -1 nowhere."""


@lru_cache(maxsize=1024)
def pattern_of(text: str, settings: Settings) -> Pattern:
    """The pattern that a text is in a workbook with these settings."""
    if settings.searching == "wildcards":
        return _OfWildcards(text, settings.whole_cells)
    if settings.searching == "expressions" and _SPECIAL.search(text):
        return _Expression(text, settings.whole_cells)
    return _Plain(text, settings.whole_cells)


class _OfWildcards:
    of_numbers = False

    def __init__(self, text: str, whole: bool) -> None:
        self.wildcards = Wildcards(text)
        self.whole = whole

    def fits(self, text: str) -> bool:
        return self.wildcards.fullmatch(text) if self.whole else self.search(text, 0) >= 0

    def search(self, text: str, start: int) -> int:
        return self.wildcards.search(text, start)


class _Plain:
    of_numbers = False

    def __init__(self, text: str, whole: bool) -> None:
        self.text = text.casefold()
        self.expression = re.compile(re.escape(text), re.IGNORECASE)
        self.whole = whole

    def fits(self, text: str) -> bool:
        return text.casefold() == self.text if self.whole else self.search(text, 0) >= 0

    def search(self, text: str, start: int) -> int:
        found = self.expression.search(text, start)
        return -1 if found is None else found.start()


class _Expression:
    """A regular expression. LibreOffice's notation has more than Python's; what Python does not take is refused."""

    of_numbers = True

    def __init__(self, text: str, whole: bool) -> None:
        self.text = text
        self.whole = whole

    def _first(self, text: str, start: int) -> tuple[int, int] | None:
        """The first match; an empty one is none, as in LibreOffice."""
        try:
            re.compile(self.text)
        except (re.error, OverflowError, RecursionError) as problem:
            raise UnsupportedError(
                say('"{text}" is no regular expression, as which this workbook takes it', text=self.text[:40])
            ) from problem
        found = expression(self.text, text, _IGNORING_CASE).search(text, start)
        return found.span() if found is not None and found.end() > found.start() else None

    def fits(self, text: str) -> bool:
        found = self._first(text, 0)
        return found is not None and (not self.whole or found == (0, len(text)))

    def search(self, text: str, start: int) -> int:
        found = self._first(text, start)
        return -1 if found is None else found[0]

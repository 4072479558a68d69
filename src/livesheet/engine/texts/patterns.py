"""Texts that are searched for, as the workbook has it: with wildcards, as regular expressions, or as they stand.

Formulas are not trusted: wildcards are matched part by part from the left, in time that does not grow with the number of
asterisks, and regular expressions that could take very long are refused.
"""

from __future__ import annotations

import re
from functools import lru_cache
from typing import Protocol

from ...formula.book import Settings
from ...said import say
from ..values.cells import UnsupportedError
from ..values.coerce import Problem

_LONGEST_PATTERN = 1000
_MOST_STEPS = 1e8
_QUANTIFIER = re.compile(r"[*+]|\{\d*(?:,\d*)?\}")


@lru_cache(maxsize=256)
def _compiled(pattern: str, ignore_case: bool) -> tuple[re.Pattern[str] | None, int]:
    """(the expression, how many parts of it are repeated; -1 when repeated parts stand inside repeated parts)."""
    try:
        return re.compile(pattern, re.IGNORECASE if ignore_case else 0), _repetitions(pattern)
    except (re.error, OverflowError, RecursionError):
        return None, 0


def _repetitions(pattern: str) -> int:
    count, place = 0, 0
    repeats = [False]
    closed = False
    while place < len(pattern):
        character = pattern[place]
        found = _QUANTIFIER.match(pattern, place)
        if character == "\\":
            place, closed = place + 2, False
            continue
        if character == "[":
            end = pattern.find("]", place + 2)
            place, closed = (len(pattern) if end < 0 else end + 1), False
            continue
        if found is not None:
            if closed:
                return -1
            count, repeats[-1] = count + 1, True
            place = found.end()
            continue
        closed = False
        if character == "(":
            repeats.append(False)
        elif character == ")" and len(repeats) > 1:
            closed = repeats.pop()
            repeats[-1] = repeats[-1] or closed
        place += 1
    return count


def expression(pattern: str, text: str, ignore_case: float = 0.0) -> re.Pattern[str]:
    """The expression, fit for a text: #VALUE! for what is none. Raises UnsupportedError for one that could take too long."""
    if len(pattern) > _LONGEST_PATTERN or ignore_case not in (0, 1):
        raise Problem("#VALUE!")
    found, repetitions = _compiled(pattern, bool(ignore_case))
    if found is None:
        raise Problem("#VALUE!")
    if repetitions < 0 or (repetitions > 1 and float(max(len(text), 2)) ** repetitions > _MOST_STEPS):
        raise UnsupportedError(say("a regular expression that could take very long"))
    return found


class Wildcards:
    """A text with wildcards, compared without regard to case: `*` any characters, `?` one, `~` before them themselves. A
    tilde before any other character is not seen."""

    def __init__(self, text: str) -> None:
        parts: list[str] = [""]
        place = 0
        while place < len(text):
            character = text[place]
            if character == "~":
                place += 1
                parts[-1] += re.escape(text[place : place + 1])
            elif character == "*":
                parts.append("")
            else:
                parts[-1] += "." if character == "?" else re.escape(character)
            place += 1
        self._parts = [re.compile(part, re.IGNORECASE | re.DOTALL) for part in parts]
        self._end = re.compile(f"(?:{parts[-1]})\\Z", re.IGNORECASE | re.DOTALL)

    def fullmatch(self, text: str) -> bool:
        """Whether the whole text fits."""
        first, *others = self._parts
        if not others:
            return first.fullmatch(text) is not None
        found = first.match(text)
        for part in others[:-1]:
            found = part.search(text, found.end()) if found is not None else None
        return found is not None and self._end.search(text, found.end()) is not None

    def search(self, text: str, start: int) -> int:
        """Where a part of the text fits first; -1 nowhere."""
        found = self._parts[0].search(text, start)
        place = found.start() if found is not None else -1
        for part in self._parts[1:]:
            found = part.search(text, found.end()) if found is not None else None
        return place if found is not None else -1


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

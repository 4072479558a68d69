"""Wildcards: `*` any characters, `?` one, `~` before them themselves. A tilde before any other character is not seen.

Matched part by part from the left, in time that does not grow with the number of asterisks: formulas are not trusted.
"""

from __future__ import annotations

import re


class Wildcards:
    """A text with wildcards, compared without regard to case."""

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

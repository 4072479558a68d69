"""Wildcards: `*` any characters, `?` one, `~` before them themselves. A tilde before any other character is not seen."""

from __future__ import annotations

import re
from functools import lru_cache


@lru_cache(maxsize=1024)
def pattern_of(text: str, lazy: bool = False) -> re.Pattern[str]:
    """The pattern that a text with wildcards means, without regard to case. `lazy`: `*` takes as little as it can."""
    parts, place = [], 0
    while place < len(text):
        character = text[place]
        if character == "~":
            place += 1
            parts.append(re.escape(text[place : place + 1]))
        elif character == "*":
            parts.append(".*?" if lazy else ".*")
        else:
            parts.append("." if character == "?" else re.escape(character))
        place += 1
    return re.compile("".join(parts), re.IGNORECASE | re.DOTALL)

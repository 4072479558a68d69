"""Regular expressions of formulas, which are not trusted: those that could take very long are refused."""

from __future__ import annotations

import re
from functools import lru_cache

from ...said import say
from ..values.calling import Problem
from ..values.frames import UnsupportedError

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

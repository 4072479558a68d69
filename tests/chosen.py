"""Which of many alike cases run: in CI all of them, elsewhere a part that is another one from module to module."""

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TypeVar

IN_CI = bool(os.environ.get("MECHSHEET_CI"))

ALWAYS = ("adjustable-pump", "fivelink", "four-bar")
"""A two-way table, Turkish, the plain one."""

EVERY = 7
"""Of the other templates every so-manieth."""

Case = TypeVar("Case", str, Path)


def some(cases: Iterable[Case], turn: int, every: int = EVERY) -> list[Case]:
    """Templates by name or path: ALWAYS, and of the others every so-manieth, from `turn` on."""
    found = list(cases)
    others = [case for case in found if Path(case).stem not in ALWAYS]
    taken = set(found if IN_CI else others[turn % every :: every])
    return [case for case in found if case in taken or Path(case).stem in ALWAYS]


def part(cases: Iterable[object], of: int, turn: int = 0) -> list:
    """Cases of any kind: all in CI, elsewhere every so-manieth."""
    found = list(cases)
    return found if IN_CI else found[turn % of :: of]


def first(cases: Sequence, count: int) -> Sequence:
    """All in CI, elsewhere the first of them."""
    return cases if IN_CI else cases[:count]


def examples(count: int) -> int:
    """How many examples hypothesis draws: all in CI, elsewhere a third."""
    return count if IN_CI else -(-count // 3)

"""Which of many alike cases run: all of them on `make full`, a part elsewhere.

The part is another one from module to module, so that together they see every template and every kind of case.
"""

import os
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import TypeVar

ALL = bool(os.environ.get("MECHSHEET_ALL"))
IN_CI = ALL or bool(os.environ.get("MECHSHEET_CI"))

ALWAYS = ("adjustable-pump", "fivelink", "four-bar")
"""A two-way table, Turkish, the plain one."""

EVERY = 9
"""Of the other templates every so-manieth."""

ITERATED = ("double-butterfly", "planar-3rpr", "stephenson-ii-class-iv", "stephenson-iii-output", "sun-and-planet")
"""Templates with groups that Newton's method solves: there are no pages and functions of these."""

LOADED = (
    "cam-valve", "desk-lamp", "double-wishbone", "engine", "four-bar-forces", "planar-3rpr", "scissor-lift-between-arms",
    "shaper", "six-link-dwell", "slotted-lever", "toggle-press",
)  # fmt: skip
"""Templates with masses or loads."""

LISTED = ("five-bar-robot",)
"""Templates whose two drivers are listed row by row: there is nothing between the rows."""

CAMS = ("cam-flat", "cam-linkage", "cam-rocker", "cam-slide", "cam-valve")
"""Templates with a cam: higher derivatives leap where two segments of its follower's motion meet."""

STEPWISE = ("crank-rocker-swing", "function-generator", "rigid-body-guidance")
"""Templates whose task takes more steps than fit on a page."""

TASKS = (*STEPWISE, "quick-return-lever", "quick-return-slider")
"""Templates whose dimensions a task finds: there are no functions of these."""

Case = TypeVar("Case", str, Path)


def but(cases: Iterable[Case], *names: str) -> list[Case]:
    """Templates by name or path, without some."""
    return [case for case in cases if Path(case).stem not in names]


def some(cases: Iterable[Case], turn: int, every: int = EVERY) -> list[Case]:
    """Templates by name or path: ALWAYS, and of the others every so-manieth, from `turn` on."""
    found = list(cases)
    taken = set(part([case for case in found if Path(case).stem not in ALWAYS], every, turn))
    return [case for case in found if case in taken or Path(case).stem in ALWAYS]


def part(cases: Iterable[object], of: int, turn: int = 0) -> list:
    """Cases of any kind: every so-manieth, from `turn` on."""
    found = list(cases)
    return found if ALL else found[turn % of :: of]


def first(cases: Sequence, count: int) -> Sequence:
    """The first of them."""
    return cases if ALL else cases[:count]


def examples(count: int) -> int:
    """How many examples hypothesis draws, of `count` that it draws in a full run."""
    return count if ALL else -(-count // 6)

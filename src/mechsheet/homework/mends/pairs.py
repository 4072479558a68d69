"""Two slips of the hand in one formula, taken back: pairs of single changes, the lightest pairs first."""

from __future__ import annotations

import heapq
from collections.abc import Iterator

from livesheet.formula.nodes import Node
from mechsheet.homework.mends.candidates import Candidate, Surroundings, candidates

MOST_PAIRS = 5000
"""Pairs for one formula."""
LIGHT = 1.6
"""The heaviest change that is tried with another one."""
MOST_FIRST = 150
"""Changes after which a second one is tried."""

KIND = "two changes"


def pairs(formula: Node, around: Surroundings) -> list[Candidate]:
    """Two changes of a formula, each formula once, the lightest first; single ones are not among them.

    A typed number or a term that is missing is not tried together with another change: there would be too many. Nor is an
    anchor: a cell held fast in a row where it happens to be 0 puts right whatever it is added to.
    """
    single = [one for one in candidates(formula, around) if one.weight <= LIGHT and one.kind != "anchor"]
    seen = {formula, *(one.formula for one in single)}
    found = heapq.nsmallest(MOST_PAIRS, _pairs(single, around, seen), key=lambda one: one.weight)
    return list({one.formula: one for one in reversed(found)}.values())[::-1]


def _pairs(single: list[Candidate], around: Surroundings, seen: set[Node]) -> Iterator[Candidate]:
    for first in single[:MOST_FIRST]:
        for second in candidates(first.formula, around):
            if second.weight > LIGHT:
                break
            if second.formula not in seen and second.kind != "anchor":
                yield Candidate(second.formula, KIND, first.weight + second.weight)

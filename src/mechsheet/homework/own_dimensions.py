"""A student's own dimensions against those in the sheet: which cells hold others, and what depends on them."""

from __future__ import annotations

from collections.abc import Sequence

from mechsheet import reference
from mechsheet.homework.agreement import Reading, gaps
from mechsheet.homework.expected_values import truth_of
from mechsheet.homework.inputs import Input
from mechsheet.homework.judging import Judged
from mechsheet.homework.summaries import span_of
from mechsheet.homework.understanding import Understanding

OTHER = 1e-3
"""A number that differs by more than this part of a dimension is another one, not the same one rounded."""


def is_other(value: float, own: float) -> bool:
    """Whether a number is another one than a student's own."""
    return abs(value - own) > OTHER * max(abs(own), 1e-12)


def other_dimensions(found: Understanding) -> list[Input]:
    """The cells whose values are not the mechanism's own."""
    own = reference.dimension_values(found.mechanism)
    derived = {dim.symbol for dim in found.mechanism.dimensions if dim.derived}
    return [
        one
        for one in found.inputs
        if one.symbol not in derived and is_other(found.truth.dimensions[one.symbol], own[one.symbol])
    ]


def changed_by(judged: Judged, others: Sequence[Input]) -> list[str]:
    """The asked quantities that have other values with the mechanism's own dimensions; all where that has no position."""
    if not others:
        return []
    found, truth = judged.found, judged.truth
    own = truth_of(found.mechanism, {}, truth.driver, truth.poses)
    if own is None:
        return list(judged.asked)
    changed = []
    for symbol in judged.asked:
        if symbol in truth.columns:
            quantity = own.quantity(symbol)
            apart = gaps(truth.columns[symbol], quantity, Reading()).max(initial=0.0) > found.allowed(quantity)
        else:
            one, other = span_of(truth, symbol), span_of(own, symbol)
            apart = abs(one.high - other.high) + abs(one.low - other.low) > found.tolerance * max(
                abs(other.high), 1e-12
            )
        if apart:
            changed.append(symbol)
    return changed

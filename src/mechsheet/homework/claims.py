"""Which column is the answer to a quantity: what is headed by a name is the answer to that name, right or wrong.

A column that nobody has headed may be the answer where none is headed so; but of several such columns of which one happens
to be right nobody can tell which was meant.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence

import numpy as np

from mechsheet.homework.agreement import Reading
from mechsheet.homework.expected_values import Array
from mechsheet.homework.series import Series
from mechsheet.homework.understanding import Understanding

ReadAs = Callable[[Series, str], Reading | None]
"""How a series says a quantity, None where it does not."""


def claimed(found: Understanding, symbol: str) -> list[Series]:
    """The series that are headed by a quantity's name, in the workbook's order: those headed by nothing else, or where there
    are none those whose heading says more; computed ones, or where there are none typed ones."""
    headed = [series for series in found.series if found.called(series).symbols == {symbol}]
    alone = [series for series in headed if found.called(series).alone]
    chosen = alone or headed
    return [series for series in chosen if series.main is not None] or chosen


def answers(found: Understanding, symbol: str, read_as: ReadAs) -> tuple[Sequence[Series], Series | None]:
    """(the series that may be the answer to a quantity, the one that is called so and is wrong or None).

    Of several that are headed by its name the last one counts. Without any it may be each one that is not headed by the
    name of something else.
    """
    claims = claimed(found, symbol)
    if claims:
        last = claims[-1]
        if read_as(last, symbol) is not None:
            return [series for series in claims if read_as(series, symbol) is not None], None
        if not _begins(found, claims, symbol, read_as):
            return [], last
    return [series for series in found.series if not _of_another(found, series, symbol, read_as)], None


def _begins(found: Understanding, claims: Sequence[Series], symbol: str, read_as: ReadAs) -> bool:
    """Whether what is called so is typed, and the right column is computed from it: an iteration's first values."""
    if any(series.main is not None for series in claims):
        return False
    right = [series for series in found.series if series.main is not None and read_as(series, symbol) is not None]
    return any(all(_reads(found, series, claim) for claim in claims) for series in right)


def _reads(found: Understanding, series: Series, other: Series) -> bool:
    """Whether a computed series depends on another one."""
    graph = found.graph
    direct = graph.readers_of(other.cells)
    return bool(graph.below(direct) & set(series.strips(found.work)))


def _of_another(found: Understanding, series: Series, symbol: str, read_as: ReadAs) -> bool:
    """Whether a series is headed by the name of another quantity, which it is not."""
    called = found.called(series)
    if not called.alone or len(called.symbols) != 1 or symbol in called.symbols:
        return False
    (other,) = called.symbols
    return read_as(series, symbol) is not None and read_as(series, other) is None


def exchanged(found: Understanding, symbol: str, others: Iterable[str], claim: Series, read_as: ReadAs) -> str:
    """Which other quantity a column headed by a name is instead, where its own stands under that heading; else ""."""
    for other in others:
        there = claimed(found, other)
        if there and _plainly(read_as(claim, other)) and _plainly(read_as(there[-1], symbol)):
            return other
    return ""


def _plainly(reading: Reading | None) -> bool:
    return reading is not None and reading.plain


def rivals(found: Understanding, answer: Series, spare: Sequence[Series], column: Callable[[Series], Array]) -> int:
    """How many of the `spare` series, which are nothing of the mechanism, might as well have been meant as the answer: of
    its kind, computed or typed; that move; that say no name; of which nothing is computed, and that say nothing of it."""

    def rival(series: Series) -> bool:
        if (series.main is None) is not (answer.main is None) or found.called(series).symbols:
            return False
        numbers = column(series)
        numbers = numbers[np.isfinite(numbers)]
        moves = len(numbers) > 2 and not np.allclose(np.diff(numbers, 2), 0.0, atol=1e-9 * np.abs(numbers).max())
        if not moves or _reads(found, answer, series) or _reads(found, series, answer):
            return False
        return not read_on(found, series)

    return sum(map(rival, spare))


def read_on(found: Understanding, series: Series) -> bool:
    """Whether another column is computed from a series."""
    graph = found.graph
    readers = graph.readers_of(series.cells)
    return any(
        (graph.work.strips[number].sheet, graph.work.strips[number].line) != (series.sheet, series.line)
        and graph.work.strips[number].length > 1
        for number in readers
    )

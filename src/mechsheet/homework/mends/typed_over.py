"""Numbers typed over the formulas of a column: they stand out without any search, so they are the first faults told."""

from __future__ import annotations

import itertools
from collections.abc import Iterator, Mapping

import numpy as np

from livesheet.formula.nodes import Number
from mechsheet.homework.formula_strips import Strip
from mechsheet.homework.mends.faults import Mend, goals_of, mended_sheet, newly_right
from mechsheet.homework.series import Series
from mechsheet.homework.verdicts import Finding, Sheet, in_convention

FEW = 0.25
"""With more typed numbers than this part of its rows a column is one of numbers as well as of formulas."""
ROUNDED = 1e-9
"""What differs by less than this part of it is the formula's own value, pasted."""

KIND = "typed over"


def typed_over(sheet: Sheet, results: Mapping[str, Finding]) -> tuple[list[Mend], Sheet, dict[str, Finding]]:
    """The numbers that stand in place of a column's formula where what is wrong depends on them: (mends, the sheet with all
    of them, what is found in it)."""
    found: list[tuple[Strip, Sheet]] = []
    whole = sheet
    goals = {series.key: series for _, series in goals_of(sheet, results)}
    for series, strip in _typed(sheet) if goals else ():
        assert series.main is not None
        mended = mended_sheet(whole, strip, sheet.found.work.bound(series.main.at(strip.start), strip))
        if _matters(sheet, strip, goals) and _differs(sheet, mended, strip):
            found.append((strip, mended))
            whole = mended
    after = dict(results)
    if found:
        whole, seen = in_convention(whole)
        after |= seen
    if any(one.verdict == "right" and after[symbol].verdict != "right" for symbol, one in results.items()):
        return [], sheet, dict(results)
    right = newly_right(results, after)
    mends = []
    for strip, mended in found:
        number = mended.found.work.strip_at((strip.sheet, strip.start, strip.line))
        assert number is not None
        formula = sheet.found.work.bound(mended.found.work.strips[number].at(strip.start), strip)
        rights = tuple(symbol for symbol in right if _leads_to(sheet, strip, after[symbol].series))
        mends.append(Mend(strip, formula, KIND, 0.0, rights))
    return mends, whole, after


def _typed(sheet: Sheet) -> Iterator[tuple[Series, Strip]]:
    """Series with the numbers typed in them, those that follow each other as one strip; not where an iteration starts."""
    found = sheet.found
    graph, work = found.graph, found.work
    for series in found.series:
        main = series.main
        if main is None:
            continue
        number = work.strips.index(main)
        own = (main.sheet, main.line)
        iterates = any(((a.sheet or main.sheet), a.col) == own and not a.row_abs for a, _ in graph.corners(number))
        computed = {
            pos for other in series.strips(work) for pos in range(work.strips[other].start, work.strips[other].end)
        }
        there = np.flatnonzero(np.isfinite(sheet.column(series))).tolist()
        typed = [series.origin + row for row in there if series.origin + row not in computed]
        if len(typed) > FEW * series.rows:
            continue
        for _, run in itertools.groupby(enumerate(typed), lambda pair: pair[1] - pair[0]):
            start, *_ = places = [pos for _, pos in run]
            if not (iterates and start < main.start):
                value = work.number((series.sheet, start, series.line))
                yield series, Strip(series.sheet, series.line, start, len(places), Number(value))


def _differs(sheet: Sheet, mended: Sheet, strip: Strip) -> bool:
    """Whether the column's formula gives other numbers there."""
    typed, computed = (strip.column(one.found.work) for one in (sheet, mended))
    return bool(
        np.isfinite(computed).all() and (np.abs(typed - computed) > ROUNDED * np.maximum(1.0, np.abs(computed))).any()
    )


def _matters(sheet: Sheet, strip: Strip, goals: Mapping[tuple[str, int, int], Series]) -> bool:
    return any(_leads_to(sheet, strip, series) for series in goals.values())


def _leads_to(sheet: Sheet, strip: Strip, series: Series | None) -> bool:
    """Whether a series holds these cells, or depends on them."""
    if series is None:
        return False
    if (series.sheet, series.line) == (strip.sheet, strip.line) and strip.start < series.origin + series.rows:
        return strip.end > series.origin
    graph = sheet.found.graph
    readers = graph.readers_of(strip)
    return bool(graph.below(readers) & set(series.strips(sheet.found.work)))

"""A few rows of a table, in which most candidates are already seen to be wrong: what depends on a change row by row need not
be computed in all rows for each of them."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from mechsheet.formula.nodes import Node, shifted
from mechsheet.homework.series import Graph, Series
from mechsheet.homework.upright import Strip

ROWS = 4
"""Rows that are looked at first."""
PLACE = 0.3
"""How far down the rows that exist they stand: at their ends a crank lies along its ground, where much agrees by chance."""


@dataclass(frozen=True, slots=True)
class Window:
    """`rows` of the table from `first` on. origins: line -> the position of the table's first row."""

    first: int
    rows: int
    origins: dict[tuple[str, int], int]

    @property
    def part(self) -> slice:
        """These rows of a column."""
        return slice(self.first, self.first + self.rows)

    def cut(self, strip: Strip, formula: Node) -> tuple[int, int, Node] | None:
        """(start, length, formula) of what is left of a strip, None where nothing is."""
        origin = self.origins.get((strip.sheet, strip.line))
        if origin is None:
            return strip.start, strip.length, formula
        start = max(strip.start, origin + self.first)
        end = min(strip.end, origin + self.first + self.rows)
        return (start, end - start, shifted(formula, start - strip.start)) if start < end else None


def window_of(
    graph: Graph,
    number: int,
    affected: Iterable[int],
    goals: Sequence[Series],
    table: Sequence[Series],
    exists: NDArray[np.bool_],
) -> Window | None:
    """A window for a change of one strip; None where some cell depends on another row's, or a goal is no column.

    affected  the strips that depend on the changed one and lead to a goal, itself among them
    table     the series;  exists  in which rows the mechanism can be assembled
    """
    origins = {(series.sheet, series.line): series.origin for series in table}
    several = len(origins) < len(table) or len(exists) < 3 * ROWS
    if several or any(goal.rows == 1 or (goal.sheet, goal.line) not in origins for goal in goals):
        return None
    if not all(_by_rows(graph, each, set(affected), origins) for each in affected):
        return None
    strip = graph.work.strips[number]
    origin = origins.get((strip.sheet, strip.line))
    inside = exists.copy()
    if origin is not None:
        inside[: max(strip.start - origin, 0)] = False
        inside[max(strip.end - origin, 0) :] = False
    starts = np.flatnonzero(np.lib.stride_tricks.sliding_window_view(inside, ROWS).all(axis=1))
    return Window(int(starts[int(PLACE * len(starts))]), ROWS, origins) if len(starts) else None


def _by_rows(graph: Graph, number: int, affected: set[int], origins: dict[tuple[str, int], int]) -> bool:
    """Whether what a strip reads of affected ones stands in its own row, or in no row."""
    work = graph.work
    strip = work.strips[number]
    origin = origins.get((strip.sheet, strip.line))
    for start, end in graph.corners(number):
        sheet = graph.titles.get((start.sheet or strip.sheet).casefold(), "")
        lines = range(start.col, min(end.col, start.col + 500) + 1)
        if affected.isdisjoint(each for line in lines for each in work.lines.get((sheet, line), ())):
            continue
        if start is not end:
            return False
        other = origins.get((sheet, start.col))
        anchored = start.row_abs or strip.length == 1
        own_row = other is not None and origin is not None and start.row - other == strip.start - origin
        if not (anchored if other is None else own_row and not start.row_abs):
            return False
    return True

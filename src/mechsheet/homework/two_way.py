"""Two-way tables: one formula filled down beside the driver's values and to the right below those of a dimension.

Each column has a dimension of its own in the cell above it. One of them, the one whose dimension is an input of the sheet,
is understood as any other column; the others are held against the mechanism with theirs.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from mechsheet.homework.expected_values import truth_of
from mechsheet.homework.formula_strips import Place
from mechsheet.homework.inputs import Input
from mechsheet.homework.series import Graph, Run, Series, aligned
from mechsheet.model import Dimension

if TYPE_CHECKING:
    from mechsheet.homework.understanding import Understanding

Settings = dict[Place, Series]
"""The columns of a two-way table by the cells above them that they read."""


def settings_of(graph: Graph, several: Sequence[Series]) -> Settings:
    """The columns of a table that read a number typed above themselves, where at least two read one of the same row."""
    rows: dict[tuple[str, int], Settings] = {}
    for series in several:
        for place in _above(graph, series):
            rows.setdefault(place[:2], {})[place] = series
    return max(rows.values(), key=len, default={}) if any(len(found) > 1 for found in rows.values()) else {}


def _above(graph: Graph, series: Series) -> Iterator[Place]:
    main, work = series.main, graph.work
    for start, end in graph.corners(work.strips.index(main)) if main is not None else ():
        place = series.sheet, start.row, start.col
        above = start is end and start.row_abs and start.col == series.line and start.row < series.origin
        here = above and (start.sheet or series.sheet) == series.sheet
        if here and work.strip_at(place) is None and math.isfinite(work.number(place)):
            yield place


def with_setting(
    inputs: Sequence[Input], settings: Settings, dims: Sequence[Dimension], power: float
) -> Iterator[tuple[Input, ...]]:
    """The inputs, with one of the cells above the columns for a dimension that has none."""
    if not settings or any(one.place in settings for one in inputs):
        return
    known = {one.symbol for one in inputs}
    for dim in dims:
        if dim.symbol not in known and not (dim.path or dim.derived):
            yield (*inputs, Input(dim.symbol, next(iter(settings)), power if dim.unit.kind == "length" else 1.0, False))


def others_of(found: Understanding) -> Iterator[tuple[Series, Understanding]]:
    """The other columns of a two-way table, each understood with its own dimension."""
    own = next((one for one in found.inputs if one.place in found.settings), None)
    if own is None:
        return
    main = found.settings[own.place]
    for place, series in found.settings.items():
        if series.key == main.key:
            continue
        inputs = tuple(replace(one, place=place) if one is own else one for one in found.inputs)
        values = {one.symbol: one.factor * found.work.number(one.place) for one in inputs}
        truth = truth_of(found.mechanism, values, found.truth.driver, found.truth.poses)
        if truth is not None:
            columns = [series if one.key == main.key else one for one in found.series]
            yield series, replace(found, inputs=inputs, truth=truth, series=columns, settings={})


def columns_beside(graph: Graph, driver: Run, inputs: Sequence[Input]) -> tuple[list[Series], Settings]:
    """The columns of a table, of a two-way one the column that is understood; and the columns of the latter."""
    several = aligned(graph, driver)
    settings = settings_of(graph, several)
    return without_others(several, inputs, settings), settings


def without_others(several: Sequence[Series], inputs: Sequence[Input], settings: Settings) -> list[Series]:
    """The columns of a table, of a two-way one the column that is understood."""
    own = next((settings[one.place] for one in inputs if one.place in settings), None)
    left_out = {series.key for series in settings.values() if own is not None and series.key != own.key}
    return [series for series in several if series.key not in left_out]


def where(found: Understanding, series: Series) -> str:
    """The cells of a column by name; of a two-way table's those of all its columns, where these stand beside each other."""
    lines = sorted(one.line for one in found.settings.values())
    if any(one.key == series.key for one in found.settings.values()) and lines[-1] - lines[0] == len(lines) - 1:
        first = series.origin + series.first
        return found.work.where(series.sheet, first, lines[0], series.last - series.first + 1, len(lines))
    return series.where(found.work)

"""A page on paper: where its charts stand, and where the next sheet of paper begins, so that no chart is cut."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

NARROW = 10.0
"""Width of a column beside the table, in characters."""

ACROSS, DOWN = 1007, 650
"""Pixels across A4, landscape, and down it, at full size."""

LEAST_SCALE = 0.43
"""Printed smaller, table and charts stand on more sheets of paper side by side."""

SURE = 0.94
"""Of the paper so much is used where the scale is given: programs round the widths of columns, each its own way."""

MORE = 1.02
"""So much wider is a sheet of paper taken until the charts that are moved to the next one have room."""

GAP = 12
"""Pixels between charts."""


def pixels(width: float) -> int:
    """Of a column, from its width in characters."""
    return int(7 * width + 5)


@dataclass(frozen=True, slots=True)
class Paper:
    """Where charts stand [pixels from the left], how far the last one was moved, and how all is printed.

    begins  columns that begin a sheet of paper;  scale  percent, 0 where one sheet of paper is as wide as all
    """

    charts: tuple[int, ...]
    moved: int = 0
    begins: tuple[int, ...] = ()
    scale: int = 0


def on_paper(widths: Sequence[float], height: float, left: int, charts: Sequence[int]) -> Paper:
    """Charts of these widths side by side from `left` on, above the table of columns of `widths` [characters].

    Where it takes several sheets of paper, a chart that would be cut begins on the next one, and all is as large as it can
    be without taking more sheets down: `height` is that of all rows. Lengths in pixels.
    """
    table = sum(map(pixels, widths))
    total = max(table, left + sum(chart + GAP for chart in charts))
    sheets = math.ceil(LEAST_SCALE * total / ACROSS)
    if sheets == 1:
        return Paper(_placed(left, charts, ()))
    wide = total / sheets
    while True:
        edges, places = _cut(widths, wide, left, charts)
        end = max(table, places[-1] + charts[-1] if charts else 0)
        if len(edges) < sheets and end - edges[-1][1] <= wide:
            break
        wide *= MORE
    bounds = [0, *(edge for _, edge in edges), end + pixels(NARROW)]  # to the end of the last column
    widest = max(after - before for before, after in pairwise(bounds))
    down = math.ceil(LEAST_SCALE * height / DOWN)
    scale = SURE * min(ACROSS / widest, max(down * DOWN / height, LEAST_SCALE))
    return Paper(
        places, places[-1] - _placed(left, charts, ())[-1] if charts else 0, tuple(col for col, _ in edges),
        int(100 * scale),
    )  # fmt: skip


def _cut(
    widths: Sequence[float], wide: float, left: int, charts: Sequence[int]
) -> tuple[list[tuple[int, int]], tuple[int, ...]]:
    """The columns that begin the second sheet of paper and further ones, with their left edges; the places of the charts."""
    edges: list[tuple[int, int]] = []
    end = max(sum(map(pixels, widths)), _placed(left, charts, ())[-1] + charts[-1] if charts else 0)
    begun = reached = col = 0
    while reached < end:
        column = pixels(widths[col] if col < len(widths) else NARROW)
        if reached + column - begun > wide:
            edges.append((col, reached))
            begun = reached
            places = _placed(left, charts, [edge for _, edge in edges])
            end = max(end, places[-1] + charts[-1] if charts else 0)
        reached += column
        col += 1
    return edges, _placed(left, charts, [edge for _, edge in edges])


def _placed(left: int, charts: Sequence[int], edges: Sequence[int]) -> tuple[int, ...]:
    """Where the charts begin, one beside the other, none of them across an edge."""

    def behind(place: int, chart: int) -> int:
        return max((edge + GAP for edge in edges if place < edge < place + chart), default=place)

    places: list[int] = []
    for chart in charts:
        places.append(behind(places[-1] + charts[len(places) - 1] + GAP if places else left, chart))
    return tuple(places)

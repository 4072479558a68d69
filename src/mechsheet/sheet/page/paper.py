"""A page on paper: where its charts stand, and where the next sheet of paper begins, so that no chart is cut."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import accumulate

from mechsheet.sheet.printing import ACROSS, DOWN, READABLE, SURE, column_pixels

NARROW = 9.3
"""Width of a column beside the table, in characters: with a gap, six are as wide as a chart of curves."""

SEVERAL = 0.7
"""As large it is printed where it takes several sheets of paper; less large where the top then stands on one."""

FEWEST_ROWS = 5
"""With fewer rows of it on the first sheet of paper, the table begins on the next one."""

GAP = 12
"""Pixels between charts."""

CHART_WIDTH, CHART_HEIGHT, LEAST_HEIGHT = 408, 304, 240
"""Pixels of a chart of curves; where several stand below one another they may be less high. The drawing is a square."""


def pixels(width: float) -> int:
    """Of a column, from its width in characters."""
    return int(7 * width + 5)


@dataclass(frozen=True, slots=True)
class Box:
    """Where a chart stands [pixels from the left, and below the first of them], and how large it is."""

    x: int
    y: int
    width: int
    height: int

    @property
    def right(self) -> int:
        """Where it ends."""
        return self.x + self.width


@dataclass(frozen=True, slots=True)
class Paper:
    """Where charts stand, and how all is printed.

    begins, rows  columns and rows that begin a sheet of paper;  scale  percent, 0 where all stands on one sheet of paper
    """

    charts: tuple[Box, ...]
    begins: tuple[int, ...] = ()
    rows: tuple[int, ...] = ()
    scale: int = 0


def on_paper(widths: Sequence[float], down: Down, top: int, left: int, squares: int, curves: int) -> Paper:
    """The drawing and other squares beside each other from `left` on, then charts of curves.

    widths  of the table's columns [characters]
    top     height of the rows above the charts [pixels]

    Curves stand above the table as far as it reaches, and below one another to the right of it. Where all takes several
    sheets of paper, a chart that would be cut begins on the next one, and the first column stands on each.
    """
    table = sum(map(pixels, widths))
    boxes = _beside(table, left, squares, curves, down.height - top)
    *_, widest = _cut(widths, math.inf, boxes)
    if min(ACROSS / widest, DOWN / down.height) >= READABLE:
        return Paper(boxes)
    boxes = _beside(table, left, squares, curves, down.first - top)
    begins, boxes, widest = _cut(widths, SURE * ACROSS / down.scale, boxes)
    scale = min(down.scale, SURE * ACROSS / widest)
    return Paper(boxes, begins, down.rows, int(100 * scale))


@dataclass(frozen=True, slots=True)
class Down:
    """Where rows are cut when all takes several sheets of paper: how high all rows are, and those of the first sheet of
    paper [pixels]; `rows` begin the other ones; at most so large it is printed."""

    height: int
    first: int
    rows: tuple[int, ...]
    scale: float = SEVERAL


def cut_down(heights: Mapping[int, float], heading: int, table: int, rows: int, row: int) -> Down:
    """The table on sheets of paper with about as many rows each.

    heights  of the rows above the table [pixels];  row: of those of the table
    heading  the row where what goes with the table begins;  table: its first row of `rows`
    """
    above = math.ceil(sum(heights.values()))
    height, page = above + rows * row, math.floor(SURE * DOWN / SEVERAL)
    if height <= page:
        return Down(height, height, ())
    begins = math.ceil(sum(high for at, high in heights.items() if at < heading))
    scale = SEVERAL
    if page < begins <= SURE * DOWN / READABLE:
        scale, page = SURE * DOWN / begins, begins
    fitting = max(0, (page - above) // row)
    each = max(1, (page - (above - begins)) // row)
    if fitting < FEWEST_ROWS or math.ceil(rows / each) <= math.ceil((rows - fitting) / each):
        first, inside = _parts(heights, heading, page)
        return Down(height, first, (*inside, heading, *_evenly(table, rows, each)), scale)
    return Down(height, above + fitting * row, (table + fitting, *_evenly(table + fitting, rows - fitting, each)))


def _parts(heights: Mapping[int, float], heading: int, page: int) -> tuple[int, tuple[int, ...]]:
    """Of the rows above the heading: how high those of the first sheet of paper are, and which rows begin a further one."""
    edges = list(accumulate(heights.get(row, 0.0) for row in range(heading)))
    parts = math.ceil(edges[-1] / page)
    rows = tuple(
        next(row for row, edge in enumerate(edges) if edge > edges[-1] * part / parts) for part in range(1, parts)
    )
    return math.ceil(edges[rows[0] - 1] if rows else edges[-1]), rows


def _evenly(first: int, rows: int, most: int) -> tuple[int, ...]:
    """The rows that begin a further sheet of paper, where each has at most so many."""
    each = math.ceil(rows / math.ceil(rows / most))
    return tuple(range(first + each, first + rows, each))


def _beside(table: int, left: int, squares: int, curves: int, room: int) -> tuple[Box, ...]:
    """Squares in a row, curves behind them as far as the table reaches, the others below one another beside it."""
    boxes = [Box(left + at * (CHART_HEIGHT + GAP), 0, CHART_HEIGHT, CHART_HEIGHT) for at in range(squares)]
    end = boxes[-1].right + GAP if boxes else left
    above = min(curves, max(0, (table - end + GAP) // (CHART_WIDTH + GAP)))
    boxes += [Box(end + at * (CHART_WIDTH + GAP), 0, CHART_WIDTH, CHART_HEIGHT) for at in range(above)]
    if curves == above:
        return tuple(boxes)
    most = max(1, (room + GAP) // (LEAST_HEIGHT + GAP))
    stacks = math.ceil((curves - above) / most)
    each = math.ceil((curves - above) / stacks)
    height = min(CHART_HEIGHT, (room + GAP) // each - GAP)
    behind = max((box.right for box in boxes), default=left - GAP) + GAP
    x = behind if each == 1 else max(table + GAP, behind)
    for number in range(curves - above):
        stack, place = divmod(number, each)
        boxes.append(Box(x + stack * (CHART_WIDTH + GAP), place * (height + GAP), CHART_WIDTH, height))
    return tuple(boxes)


def _cut(widths: Sequence[float], wide: float, boxes: Sequence[Box]) -> tuple[tuple[int, ...], tuple[Box, ...], float]:
    """The columns that begin the second sheet of paper and further ones; the charts, none cut; how wide the widest sheet is.

    The first column stands on each.
    """
    begins: list[int] = []
    table = sum(map(pixels, widths))
    placed = tuple(boxes)
    reached = col = 0
    used = widest = 0.0
    while reached < max([table, *(box.right for box in placed)]):
        width = widths[col] if col < len(widths) else NARROW
        if used + column_pixels(width) > wide:
            begins.append(col)
            used = column_pixels(widths[0])
            placed = _moved(placed, reached)
        used += column_pixels(width)
        widest = max(widest, used)
        reached += pixels(width)
        col += 1
    return tuple(begins), placed, widest


def _moved(boxes: Sequence[Box], edge: int) -> tuple[Box, ...]:
    """The charts, with those that an edge would cut, and what stands right of these, moved behind it."""
    cut = [box.x for box in boxes if box.x < edge + GAP and box.right > edge]
    if not cut:
        return tuple(boxes)
    first = min(cut)
    by = edge + GAP - first
    return tuple(Box(box.x + by, box.y, box.width, box.height) if box.x >= first else box for box in boxes)

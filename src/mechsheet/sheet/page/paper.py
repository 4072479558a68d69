"""A page on paper: where its charts stand, and where the next sheet of paper begins, so that no chart is cut."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise

NARROW = 9.3
"""Width of a column beside the table, in characters: with a gap, six are as wide as a chart of curves."""

ACROSS, DOWN = 1007, 660
"""Pixels across A4, landscape, and down it to the footer, at full size."""

ONE_SHEET = 0.66
"""Where all is printed at least so large, it stands on one sheet of paper: letters of 10 points are 6.6 high."""

SEVERAL = 0.7
"""As large it is printed where it takes several."""

SURE = 0.97
"""Of the paper so much is used where the scale is given: programs round the widths of columns, each its own way."""

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
    sheets of paper, a chart that would be cut begins on the next one.
    """
    table = sum(map(pixels, widths))
    boxes = _beside(table, left, squares, curves, down.height - top)
    right = max([table, *(box.right for box in boxes)]) + GAP
    if min(ACROSS / right, DOWN / down.height) >= ONE_SHEET:
        return Paper(boxes)
    boxes = _beside(table, left, squares, curves, down.first - top)
    edges, boxes = _cut(widths, SURE * ACROSS / SEVERAL, boxes)
    right = max([table, *(box.right for box in boxes)])
    bounds = [0, *(edge for _, edge in edges), right + pixels(NARROW)]  # to the end of the last column
    widest = max(after - before for before, after in pairwise(bounds))
    scale = min(SEVERAL, SURE * ACROSS / widest)
    return Paper(boxes, tuple(col for col, _ in edges), down.rows, int(100 * scale))


@dataclass(frozen=True, slots=True)
class Down:
    """Where rows are cut when all takes several sheets of paper: how high all rows are, and those of the first sheet of
    paper [pixels]; `rows` begin the other ones."""

    height: int
    first: int
    rows: tuple[int, ...]


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
    fitting = max(0, (page - above) // row)
    each = max(1, (page - (above - begins)) // row)
    if fitting < FEWEST_ROWS or math.ceil(rows / each) <= math.ceil((rows - fitting) / each):
        return Down(height, min(begins, page), (heading, *_evenly(table, rows, each)))
    return Down(height, above + fitting * row, (table + fitting, *_evenly(table + fitting, rows - fitting, each)))


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


def _cut(widths: Sequence[float], wide: float, boxes: Sequence[Box]) -> tuple[list[tuple[int, int]], tuple[Box, ...]]:
    """The columns that begin the second sheet of paper and further ones, with their left edges; the charts, none cut."""
    edges: list[tuple[int, int]] = []
    table = sum(map(pixels, widths))
    placed = tuple(boxes)
    begun = reached = col = 0
    while reached < max([table, *(box.right for box in placed)]):
        column = pixels(widths[col] if col < len(widths) else NARROW)
        if reached + column - begun > wide:
            edges.append((col, reached))
            begun = reached
            placed = _moved(placed, reached)
        reached += column
        col += 1
    return edges, placed


def _moved(boxes: Sequence[Box], edge: int) -> tuple[Box, ...]:
    """The charts, with those that an edge would cut, and what stands right of these, moved behind it."""
    cut = [box.x for box in boxes if box.x < edge + GAP and box.right > edge]
    if not cut:
        return tuple(boxes)
    first = min(cut)
    by = edge + GAP - first
    return tuple(Box(box.x + by, box.y, box.width, box.height) if box.x >= first else box for box in boxes)

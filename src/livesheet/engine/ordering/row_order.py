"""When cells can be computed in columns that read each other row by row: a time for each column, one order of columns.

A *line* is one column of a block. Each line gets a start, so that its cell in row r is computed at time r + start, after all
that it reads: of cells of the set only what is computed earlier, or at the same time by a line that stands before it. So
columns of different sheets, first rows and heights go together, and a row may read any rows above it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from graphlib import CycleError, TopologicalSorter
from itertools import pairwise
from typing import NamedTuple

from ...formula.book import Block
from ...formula.nodes import Apply, CellRef, FunctionRef, Local, Node, RangeRef, shifted, walk
from ..graph import area_read, reads_anywhere, references
from ..layout import Layout

_MOST_LINES = 2_000
_MOST_ROUNDS = 64
"""Lines of a set; rounds until all starts must be settled: a circle would raise them without end."""


@dataclass(slots=True)
class Line:
    """One column of a block, so many `right` of its first: its formula as seen from its first cell, and its start."""

    producer: int
    sheet: int
    block: Block
    offset: int
    right: int
    start: int = 0

    @property
    def first(self) -> int:
        """The time of its first cell."""
        return self.block.row + self.start

    @property
    def last(self) -> int:
        """The time after its last cell."""
        return self.first + self.block.rows


class Stretch(NamedTuple):
    """Times [first, last) in which the same lines have cells, in their order."""

    first: int
    last: int
    lines: tuple[Line, ...]


class _Edge(NamedTuple):
    """`reader` (by number) reads cells of `read`, down to `further` rows below its own."""

    reader: int
    read: int
    further: int


def lines_in_order(layout: Layout, formulas: Sequence[Node], group: Sequence[int]) -> list[Line] | None:
    """The lines of blocks that read each other, with their starts, in order; None when there is no such order."""
    lines: list[Line] = []
    for number in group:
        block, formula = layout.blocks[number], formulas[number]
        if block.kind != "fill" or reads_anywhere(formula) or len(lines) + block.cols > _MOST_LINES:
            return None
        if any(isinstance(part, FunctionRef | Local | Apply) for part in walk(formula)):
            return None
        for right in range(block.cols):
            seen = shifted(formula, 0, right) if right else formula
            part = Block(block.row, block.col + right, block.rows, 1, seen)
            offset = layout.block_offsets[number] + right * block.rows
            lines.append(Line(number, layout.block_sheets[number], part, offset, right))
    edges = list(_edges(layout, lines))
    # All first rows at one time, if that will do; else each as early as can be.
    for line in lines:
        line.start = -line.block.row
    if all(lines[reader].start >= lines[read].start + further for reader, read, further in edges):
        found = _ordered(lines, edges)
        if found is not None:
            return found
    for line in lines:
        line.start = 0
    return _ordered(lines, edges) if _settled(lines, edges) else None


def stretches(lines: Sequence[Line]) -> list[Stretch]:
    """The times in which the same lines have cells, one after the other."""
    times = sorted({time for line in lines for time in (line.first, line.last)})
    found = []
    for first, last in pairwise(times):
        active = tuple(line for line in lines if line.first <= first and last <= line.last)
        if active:
            found.append(Stretch(first, last, active))
    return found


def _edges(layout: Layout, lines: Sequence[Line]) -> Iterator[_Edge]:
    columns: dict[tuple[int, int], list[int]] = {}
    for number, line in enumerate(lines):
        columns.setdefault((line.sheet, line.block.col), []).append(number)
    for reader, line in enumerate(lines):
        for ref in dict.fromkeys(references(line.block.formula)):
            area = area_read(ref, line.block, layout.sheets)
            if area is None:
                continue
            for col in range(area.col, area.col + area.cols):
                for read in columns.get((area.sheet, col), ()):
                    block = lines[read].block
                    if block.row < area.row + area.rows and area.row < block.row + block.rows:
                        yield _Edge(reader, read, _further(ref, line.block, block))


def _further(ref: CellRef | RangeRef, reader: Block, read: Block) -> int:
    """How far below its own row a reader's row reads, at most. A fixed row must be done before the reader's first one."""
    corners = (ref.start, ref.end) if isinstance(ref, RangeRef) else (ref,)
    last = read.row + read.rows - 1
    return max(
        min(corner.row, last) - reader.row + 1 if corner.row_abs else corner.row - reader.row
        for corner in corners
        if isinstance(corner, CellRef)
    )


def _settled(lines: list[Line], edges: list[_Edge]) -> bool:
    """Give each line the least start that lets it read what it reads (Bellman and Ford); whether there is one."""
    for _ in range(_MOST_ROUNDS):
        moved = False
        for reader, read, further in edges:
            needed = lines[read].start + further
            if lines[reader].start < needed:
                lines[reader].start = needed
                moved = True
        if not moved:
            return True
    return False


def _ordered(lines: list[Line], edges: list[_Edge]) -> list[Line] | None:
    """The lines in an order in which each stands after those that it reads at its own time; None for a circle."""
    after: dict[int, list[int]] = {number: [] for number in range(len(lines))}
    for reader, read, further in edges:
        if lines[reader].start == lines[read].start + further:
            after[reader].append(read)
    try:
        return [lines[number] for number in TopologicalSorter(after).static_order()]
    except CycleError:
        return None

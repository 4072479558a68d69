"""Books in which the order of computing, or where cells lie, depends on values: OFFSET, INDIRECT, dynamic arrays.

A step that needs a cell not computed yet stops (`NotReadyError`); what it needs is computed first, then it starts again. A
dynamic array whose size is not the one it was laid out with is laid out anew, until all sizes are right.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from ...formula.book import Block, BookSheet, CellStore
from ...formula.nodes import MAX_COLUMNS, MAX_ROWS
from ..interpreter.evaluator import Evaluator
from ..layout import Area, Layout
from ..results import Marks
from ..values.cells import BLANK, NotReadyError
from .schedule import Step

Sizes = tuple[tuple[int, int, int, bool], ...]
"""Of every dynamic array: (block, rows, columns, whether there is something in its way)."""


class TangledError(Exception):
    """Steps that need each other, as it turned out: (reader, what it reads), blocks to be computed together."""

    def __init__(self, reads: list[tuple[int, int]]) -> None:
        super().__init__()
        self.reads = reads


def drive(steps: Sequence[Step], reads: Sequence[Collection[int]], ev: Evaluator, marks: Marks) -> None:
    """Run all steps, each after what it needs: `reads` of each block. Raises TangledError when steps need each other."""
    layout = ev.layout
    step_of = {number: index for index, step in enumerate(steps) for number in step.producers}
    needs = [
        sorted({step_of[read] for number in step.producers for read in reads[number] if read in step_of} - {index})
        for index, step in enumerate(steps)
    ]
    finished = [False] * len(steps)
    done: set[int] = set()

    def check(area: Area, but: Collection[int]) -> None:
        for producer in layout.producers(area):
            if producer in step_of and producer not in done and producer not in but:
                raise NotReadyError(producer)

    ev.around.check = check
    for start in range(len(steps)):
        path, late = [start], dict[int, int]()
        while path:
            at = path[-1]
            if finished[at]:
                path.pop()
                continue
            missing = next((step for step in needs[at] if not finished[step]), None)
            if missing is None:
                try:
                    steps[at].run(ev, marks)
                except NotReadyError as problem:
                    late[at] = problem.producer
                    missing = step_of[problem.producer]
                else:
                    finished[at] = True
                    done.update(steps[at].producers)
                    continue
            if missing in path:
                raise TangledError(_reads_of(path[path.index(missing) :], steps, late))
            path.append(missing)


def _reads_of(circle: Sequence[int], steps: Sequence[Step], late: Mapping[int, int]) -> list[tuple[int, int]]:
    found = []
    for at in circle:
        if at in late:
            found += [(number, late[at]) for number in steps[at].producers]
    return found


# dynamic arrays


def sizes_of(layout: Layout, blocked: frozenset[int]) -> Sizes:
    """The sizes that dynamic arrays are laid out with."""
    return tuple(
        (number, block.rows, block.cols, number in blocked)
        for number, block in enumerate(layout.blocks)
        if block.kind == "spill"
    )


def fitting(ev: Evaluator) -> Sizes:
    """The sizes that dynamic arrays want, 1 x 1 where something is in the way; what stands first in the book has its way."""
    layout = ev.layout
    spills = {number for number, block in enumerate(layout.blocks) if block.kind == "spill"}
    taken: list[Area] = []
    found = []
    for number in sorted(spills):
        block, sheet = layout.blocks[number], layout.block_sheets[number]
        rows, cols = ev.around.sizes.get(number, (1, 1))
        area = Area(sheet, block.row, block.col, rows, cols)
        inside = block.row + rows <= MAX_ROWS and block.col + cols <= MAX_COLUMNS
        free = inside and not any(_overlap(area, other) for other in taken) and _is_free(area, number, spills, ev)
        if not free:
            rows = cols = 1
        taken.append(Area(sheet, block.row, block.col, rows, cols))
        found.append((number, rows, cols, not free))
    return tuple(found)


def _overlap(a: Area, b: Area) -> bool:
    down = a.row < b.row + b.rows and b.row < a.row + a.rows
    return a.sheet == b.sheet and down and a.col < b.col + b.cols and b.col < a.col + a.cols


def _is_free(area: Area, number: int, spills: set[int], ev: Evaluator) -> bool:
    """Whether nothing but this array (and blank cells) is there; other dynamic arrays are there with their first cell."""
    layout = ev.layout
    for producer in layout.producers(area):
        if producer == number:
            continue
        if producer in spills:
            if _overlap(area, layout.block_area(producer)._replace(rows=1, cols=1)):
                return False
        elif producer < len(layout.blocks) or not _is_blank(area, producer - len(layout.blocks), ev):
            return False
    return True


def _is_blank(area: Area, number: int, ev: Evaluator) -> bool:
    run = ev.layout.constants[number]
    first, last = max(run.row, area.row), min(run.row + len(run.numbers), area.row + area.rows)
    codes = ev.codes[run.offset + first - run.row : run.offset + last - run.row]
    return bool((codes == BLANK).all())


def with_sizes(sheets: Sequence[BookSheet], sizes: Sizes) -> list[BookSheet]:
    """The sheets with dynamic arrays of other sizes; constants that they cover are blank and are left out."""
    wanted = {number: (rows, cols) for number, rows, cols, _ in sizes}
    found = []
    number = 0
    for sheet in sheets:
        blocks = []
        for block in sheet.blocks:
            rows, cols = wanted.get(number, (block.rows, block.cols))
            blocks.append(Block(block.row, block.col, rows, cols, block.formula, block.kind))
            number += 1
        spills = [block for block in blocks if block.kind == "spill"]
        found.append(replace(sheet, constants=_uncovered(sheet.constants, spills), blocks=blocks))
    return found


def _uncovered(constants: CellStore, spills: Sequence[Block]) -> CellStore:
    def is_covered(row: int, col: int) -> bool:
        return any(b.row <= row < b.row + b.rows and b.col <= col < b.col + b.cols for b in spills)

    cells = [(row, col) for col, runs in constants.columns.items() for run in runs for row in range(run.row, run.end)]
    if not spills or not any(is_covered(row, col) for row, col in cells):
        return constants
    kept = CellStore()
    for row, col, value in constants.items():
        if not is_covered(row, col):
            kept.put(row, col, value)
    return kept

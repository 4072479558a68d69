"""Blocks that read one another's cells, computed cell by cell, each after the cells that it reads."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..diagnostics import Fault, WorkbookError
from ..formula.nodes import CellRef, Node, RangeRef
from ..formula.references import cell_address
from .careful import Evaluator
from .frames import Frame
from .graph import references
from .layout import Layout
from .marks import Marks

Cell = tuple[int, int, int]
"""(block, rows down, columns right of its first cell)"""

_SHOWN = 12


class Together:
    """A set of blocks that read each other, and how to compute them."""

    def __init__(self, layout: Layout, formulas: Sequence[Node], members: Sequence[int]) -> None:
        self.layout = layout
        self.formulas = formulas
        self.producers = members
        self.sheets = {title: index for index, title in enumerate(layout.titles)}
        self.reads = {number: self._inner(number) for number in members}

    def _inner(self, number: int) -> list[tuple[CellRef, CellRef]]:
        """The references of a block that can mean cells of the set, as corners."""
        inner = []
        for ref in references(self.formulas[number]):
            start, end = (ref.start, ref.end) if isinstance(ref, RangeRef) else (ref, ref)
            if isinstance(start, CellRef) and isinstance(end, CellRef) and start.sheet is not None:
                sheet = self.sheets[start.sheet]
                if any(self.layout.block_sheets[member] == sheet for member in self.producers):
                    inner.append((start, end))
        return inner

    def precedents(self, cell: Cell) -> Iterator[Cell]:
        """The cells of the set that a cell reads."""
        number, down, right = cell
        for start, end in self.reads[number]:
            sheet = self.sheets[start.sheet or ""]
            rows = sorted(ref.row if ref.row_abs else ref.row + down for ref in (start, end))
            cols = sorted(ref.col if ref.col_abs else ref.col + right for ref in (start, end))
            for member in self.producers:
                if self.layout.block_sheets[member] != sheet:
                    continue
                block = self.layout.blocks[member]
                top, bottom = max(rows[0], block.row), min(rows[1], block.row + block.rows - 1)
                left, last = max(cols[0], block.col), min(cols[1], block.col + block.cols - 1)
                for row in range(top, bottom + 1):
                    for col in range(left, last + 1):
                        yield member, row - block.row, col - block.col

    def run(self, ev: Evaluator, marks: Marks) -> None:
        """Compute all cells. Raises WorkbookError naming the cells of a circle."""
        done: set[Cell] = set()
        longest = max(self.layout.blocks[member].rows for member in self.producers)
        for down in range(longest):
            for member in self.producers:
                block = self.layout.blocks[member]
                if down < block.rows:
                    for right in range(block.cols):
                        self._compute((member, down, right), done, ev)
        for member in self.producers:
            block, start = self.layout.blocks[member], self.layout.block_offsets[member]
            marks.note(member, ev.codes[start : start + block.rows * block.cols])

    def _compute(self, root: Cell, done: set[Cell], ev: Evaluator) -> None:
        if root in done:
            return
        path = [root]
        waiting = {root}
        work = [self.precedents(root)]
        while path:
            below = next((cell for cell in work[-1] if cell not in done), None)
            if below is None:
                cell = path.pop()
                work.pop()
                waiting.discard(cell)
                done.add(cell)
                self._evaluate(cell, ev)
            elif below in waiting:
                raise self._circle([*path[path.index(below) :], below])
            else:
                path.append(below)
                waiting.add(below)
                work.append(self.precedents(below))

    def _evaluate(self, cell: Cell, ev: Evaluator) -> None:
        number, down, right = cell
        block = self.layout.blocks[number]
        frame = Frame(self.layout.block_sheets[number], block.row, block.col, block.rows, block.cols)
        found = ev.result(self.formulas[number], frame.cell(down, right))
        place = self.layout.block_offsets[number] + right * block.rows + down
        ev.numbers[place] = found.numbers
        ev.codes[place] = 0 if found.codes is None else found.codes

    def _circle(self, path: list[Cell]) -> WorkbookError:
        names = []
        for number, down, right in path:
            block = self.layout.blocks[number]
            title = self.layout.titles[self.layout.block_sheets[number]]
            names.append(cell_address(title, block.row + down, block.col + right))
        shown = names if len(names) <= _SHOWN else [*names[: _SHOWN - 1], "...", names[-1]]
        return WorkbookError(Fault(f"circular reference: {' -> '.join(shown)}", key=names[0]))

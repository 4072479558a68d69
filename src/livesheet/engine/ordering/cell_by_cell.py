"""Blocks that read one another's cells, computed cell by cell, each after the cells that it reads."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence

import numpy as np

from ...formula.nodes import CellRef, Node, RangeRef
from ...formula.references import cell_address
from ...said import say
from ..fast.cell_code import CellCodes
from ..fast.cell_functions import Memory
from ..graph import Functions, reads_anywhere, references
from ..interpreter.evaluator import Evaluator
from ..layout import Area, Layout
from ..results import Marks
from ..values.cells import REF, NotReadyError
from .array_steps import fill_array

Cell = tuple[int, int, int]
"""(block, rows down, columns right of its first cell)"""

_INTERPRETED = 4
"""Times that the cells are interpreted before they get code."""
_SHOWN = 12
_MOST_CIRCLES = 20
"""Cells that are shown of a circle, and circles that are remarked: a column may have thousands."""


class _PendingError(NotReadyError):
    """A cell of the set is needed that has not been computed yet."""

    def __init__(self, cell: Cell) -> None:
        super().__init__(-1)
        self.cell = cell


class Together:
    """A set of blocks that read each other, and how to compute them."""

    def __init__(
        self,
        layout: Layout,
        formulas: Sequence[Node],
        members: Sequence[int],
        functions: Functions | None = None,
        blocked: Collection[int] = (),
    ) -> None:
        self.layout = layout
        self.formulas = formulas
        self.functions = functions or {}
        self.blocked = blocked
        self.producers = members
        self.sheets = layout.sheets
        self._on_sheet: dict[int, list[int]] = {}
        self._in_column: dict[tuple[int, int], list[int]] = {}
        self._look_up_places()
        self.reads = {number: self._inner(number) for number in members}
        self._circles = 0
        self._closely: set[Cell] = set()
        self._codes = CellCodes(layout, _INTERPRETED)
        self._reads_anywhere = any(reads_anywhere(formulas[each], self.functions) for each in members)
        self._order: list[Cell] | None = None

    def _look_up_places(self) -> None:
        """The blocks of the set by sheet, and by (sheet, column): a cell's reads are looked up thousands of times."""
        for member in self.producers:
            block, sheet = self.layout.blocks[member], self.layout.block_sheets[member]
            self._on_sheet.setdefault(sheet, []).append(member)
            for col in range(block.col, block.col + block.cols):
                self._in_column.setdefault((sheet, col), []).append(member)

    def _inner(self, number: int) -> list[tuple[CellRef, CellRef]]:
        """The references of a block that can mean cells of the set, as corners."""
        inner = []
        for ref in references(self.formulas[number], self.functions):
            start, end = (ref.start, ref.end) if isinstance(ref, RangeRef) else (ref, ref)
            if not (isinstance(start, CellRef) and isinstance(end, CellRef)) or start.sheet is None:
                continue
            if self.sheets[start.sheet] in self._on_sheet:
                inner.append((start, end))
        return inner

    def precedents(self, cell: Cell) -> Iterator[Cell]:
        """The cells of the set that a cell reads."""
        number, down, right = cell
        for start, end in self.reads[number]:
            sheet = self.sheets[start.sheet or ""]
            rows = sorted(ref.row if ref.row_abs else ref.row + down for ref in (start, end))
            cols = sorted(ref.col if ref.col_abs else ref.col + right for ref in (start, end))
            yield from self._cells_in(Area(sheet, rows[0], cols[0], rows[1] - rows[0] + 1, cols[1] - cols[0] + 1))

    def _cells_in(self, area: Area, but: Collection[int] = ()) -> Iterator[Cell]:
        """The cells of the set that lie in an area, block by block, without those of some blocks."""
        for member in self._near(area):
            if member not in but:
                yield from self._cells(member, area)

    def _near(self, area: Area) -> Sequence[int]:
        """The blocks of the set in an area's columns; of a wide area all of its sheet."""
        if area.cols == 1:
            return self._in_column.get((area.sheet, area.col), ())
        if area.cols > len(self.producers):
            return self._on_sheet.get(area.sheet, ())
        columns = range(area.col, area.col + area.cols)
        return sorted({member for col in columns for member in self._in_column.get((area.sheet, col), ())})

    def _cells(self, member: int, area: Area) -> Iterator[Cell]:
        """The cells of a block that lie in an area; an array is one."""
        block = self.layout.blocks[member]
        top, bottom = max(area.row, block.row), min(area.row + area.rows, block.row + block.rows)
        left, last = max(area.col, block.col), min(area.col + area.cols, block.col + block.cols)
        if block.kind != "fill":
            if top < bottom and left < last:
                yield member, 0, 0
            return
        for row in range(top, bottom):
            for col in range(left, last):
                yield member, row - block.row, col - block.col

    def run(self, ev: Evaluator, marks: Marks) -> None:
        """Compute all cells. Those of a circle are #REF! and remarked.

        Where no circle turns up the order of the cells is the same next time.
        """
        self._circles = 0
        self._closely = set()
        done: dict[Cell, None] = dict.fromkeys(self._order or ())
        memory = Memory(ev) if self._codes.due() else None
        outside = ev.around.check

        def check(area: Area, but: Collection[int]) -> None:
            """Cells of the set count one by one, all others as `outside` says."""
            for cell in self._cells_in(area, but):
                if cell not in done:
                    raise _PendingError(cell)
            outside(area, {*but, *self.producers})

        ev.around.check = check
        try:
            if self._order is None:
                self._run_all(done, ev, memory)
            for cell in self._order or ():
                self._evaluate(cell, ev, memory)
        finally:
            ev.around.check = outside
            ev.around.closely = False
        if not self._closely and not self._reads_anywhere:
            self._order = list(done)
        for member in self.producers:
            block, start = self.layout.blocks[member], self.layout.block_offsets[member]
            marks.note(member, ev.codes[start : start + block.rows * block.cols])

    def _run_all(self, done: dict[Cell, None], ev: Evaluator, memory: Memory | None) -> None:
        longest = max(self.layout.blocks[member].rows for member in self.producers)
        for down in range(longest):
            for member in self.producers:
                block = self.layout.blocks[member]
                if block.kind != "fill":
                    self._compute((member, 0, 0), done, ev, memory)
                elif down < block.rows:
                    for right in range(block.cols):
                        self._compute((member, down, right), done, ev, memory)

    def _compute(self, root: Cell, done: dict[Cell, None], ev: Evaluator, memory: Memory | None) -> None:
        if root in done:
            return
        path = [root]
        waiting = {root}
        work = [self.precedents(root)]
        while path:
            below = next((cell for cell in work[-1] if cell not in done), None)
            if below is None:
                cell = path[-1]
                try:
                    ev.around.closely = cell in self._closely
                    # code reads cells without a word, and here it matters what is really read
                    self._evaluate(cell, ev, None if ev.around.closely else memory)
                except _PendingError as pending:
                    below = pending.cell
                else:
                    path.pop()
                    work.pop()
                    waiting.discard(cell)
                    done[cell] = None
                    continue
            if below in waiting:
                place = path.index(below)
                circle = path[place:]
                waiting.difference_update(circle)
                del path[place:], work[place:]
                if self._closely.issuperset(circle):
                    self._note_circle(circle, done, ev)
                    continue
                # A branch of IF that is not taken closes no circle: look at what they really read.
                self._closely.update(circle)
            path.append(below)
            waiting.add(below)
            work.append(iter(()) if below in self._closely else self.precedents(below))

    def _evaluate(self, cell: Cell, ev: Evaluator, memory: Memory | None) -> None:
        number, down, right = cell
        if self.layout.blocks[number].kind != "fill":
            fill_array(self.layout, number, self.formulas[number], number in self.blocked, ev)
        elif memory is not None:
            self._codes.compute(memory, number, self.formulas[number], down, right)
        else:
            self._codes.interpret(ev, number, self.formulas[number], down, right)

    def _note_circle(self, circle: list[Cell], done: dict[Cell, None], ev: Evaluator) -> None:
        """The cells of a circle are #REF!, and remarked: no value of theirs would mean anything.

        Where the workbook has them computed again and again, they keep what the file holds.
        """
        kept = ev.around.book.settings.iterates
        for cell in circle:
            number, down, right = cell
            block, first = self.layout.blocks[number], self.layout.block_offsets[number]
            start = first + right * block.rows + down
            stop = start + 1 if block.kind == "fill" else first + block.rows * block.cols
            if not kept or not self._keep_stored(cell, start, ev):
                ev.numbers[start:stop], ev.codes[start:stop] = np.nan, REF
            done[cell] = None
        self._circles += 1
        if self._circles > _MOST_CIRCLES:
            return
        names = [self._name(cell) for cell in (*circle, circle[0])]
        shown = names if len(names) <= _SHOWN else [*names[: _SHOWN - 1], "...", names[-1]]
        first_cell = self.layout.blocks[circle[0][0]]
        sheet = self.layout.block_sheets[circle[0][0]]
        last = self._circles == _MOST_CIRCLES
        message = say(
            "circular reference: {circle} (and more of them)" if last else "circular reference: {circle}",
            circle=" -> ".join(shown),
        )
        if kept:
            message = say("{message}: it is not computed again and again here, stored values are kept", message=message)
        ev.around.remark(message, sheet, first_cell.row + circle[0][1], first_cell.col + circle[0][2])

    def _keep_stored(self, cell: Cell, start: int, ev: Evaluator) -> bool:
        """Put the stored value into a cell of a circle; whether there is one."""
        number, down, right = cell
        block, sheet = self.layout.blocks[number], self.layout.block_sheets[number]
        place = sheet, block.row + down, block.col + right
        value = ev.around.stored(*place)
        if value is None or block.kind != "fill":
            return False
        ev.numbers[start], ev.codes[start] = ev.texts.encode(value)
        ev.around.kept.add(place)
        return True

    def _name(self, cell: Cell) -> str:
        number, down, right = cell
        block = self.layout.blocks[number]
        return cell_address(self.layout.titles[self.layout.block_sheets[number]], block.row + down, block.col + right)

"""Where the cells of a synthesis stand, before any of them is written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

from mechsheet.model import Dimension, Mechanism, Synthesis
from mechsheet.sheet.addresses import Spot
from mechsheet.synthesis.kinds import kind_of

TITLE_ROW, LINE_ROW, HINT_ROW = range(3)

FIRST_ROW = 4
"""The row of the first block's heading."""

SYMBOL, VALUE, UNIT, ROUNDED, USED, MEANING, REMARK = range(7)
"""Columns. Equations stand across ROUNDED to MEANING; the remarks beside them, under the charts."""

CHARTS = REMARK
"""The column of the charts, which stand beside the task, one below the other: so the sheet is as wide as a page."""

CHART_ROWS, BOTH_CHARTS = 19, 32
"""Rows that the figure covers, and it with the curve below it."""


@dataclass
class Rows:
    """Rows by block and entry.

    heads  block -> the row of its heading;  of: (block, entry) -> its row
    """

    heads: dict[str, int] = field(default_factory=dict)
    of: dict[tuple[str, str], int] = field(default_factory=dict)
    next_row: int = FIRST_ROW

    def block(self, key: str, entries: tuple[str, ...], head_rows: int = 1) -> None:
        """Reserve rows for a block: its heading, its entries, one empty row."""
        self.heads[key] = self.next_row
        for index, entry in enumerate(entries):
            self.of[key, entry] = self.next_row + head_rows + index
        self.next_row += head_rows + len(entries) + 1

    def not_before(self, row: int) -> None:
        """The next block begins at this row or below it."""
        self.next_row = max(self.next_row, row)


INPUTS = "task_inputs"
"""The first verdict: the number of the first input that cannot be, 0 where all can."""

UNSOLVED = "unsolved"
"""The second: 0 where the task has a solution, 1 where an input is none, 2 where there is no solution."""

GRASHOF = "grashof"
"""What kind of four-bar it is and which link turns: where the mechanism has one, as the first sheet says it."""

WINDOW = ("x", "y", "half")
"""The middle of the figure and half its side."""

Place = Callable[[int, int, bool, str], Spot]
"""Gives a name to a cell: (row, column, in degrees, wanted name)."""


def verdicts_of(task: Synthesis, four_bar: bool) -> tuple[str, ...]:
    """Names of what is said about the mechanism that comes out, in order."""
    return (INPUTS, UNSOLVED, *(key for key in kind_of(task).verdicts if four_bar or key != GRASHOF))


def plan_rows(
    mechanism: Mechanism, task: Synthesis, four_bar: bool, place: Place
) -> tuple[Rows, dict[str, Spot], Spot, Spot]:
    """The rows of the sheet; every input and step of the task, and what is said of it, gets its cell: the cells of these by
    their symbols, that of the line under the title, and that of `UNSOLVED`.

    four_bar  whether the first sheet says of a loop what kind of four-bar it is
    """
    verdicts = verdicts_of(task, four_bar)
    rows = Rows()
    by_symbol: dict[str, Dimension] = {dim.symbol: dim for dim in mechanism.dimensions}
    rows.block("task", task.inputs)
    rows.block("result", tuple(task.results))
    rows.block("does", verdicts)
    kind = kind_of(task)
    curve = kind.curve(task)
    rows.not_before(FIRST_ROW + (CHART_ROWS if curve is None else BOTH_CHARTS))
    rows.block("solution", task.steps)
    rows.block("asked", _numbers(len(kind.asked(task))))
    rows.block("figure", (*WINDOW, *_numbers(sum(len(line.vertices) for line in kind.figure(task)))))
    if curve is not None:
        rows.block("curve", _numbers(curve.rows))
    spots = {}
    for block, symbols in (("task", task.inputs), ("solution", task.steps)):
        for symbol in symbols:
            dim = by_symbol[symbol]
            spots[symbol] = place(rows.of[block, symbol], VALUE, dim.unit.in_degrees, dim.cell or symbol)
    line = place(LINE_ROW, SYMBOL, False, "synthesis")
    said = {key: place(rows.of["does", key], VALUE, False, key) for key in verdicts}
    return rows, spots, line, said[UNSOLVED]


def _numbers(count: int) -> tuple[str, ...]:
    return tuple(str(number) for number in range(count))

"""Where the cells of a synthesis stand: called while the workbook is planned, so that formulas everywhere find them."""

from __future__ import annotations

from collections.abc import Callable

from mechsheet.model import Dimension, Mechanism, Synthesis
from mechsheet.sheet.synthesis.rows import CHART_ROWS, FIRST_ROW, LINE_ROW, SYMBOL, VALUE, Rows

UNSOLVED = "unsolved"
"""The first verdict: 0 where the task has a solution, 1 where an input is none, 2 where there is no solution."""


def verdicts_of(task: Synthesis) -> tuple[str, ...]:
    """Names of what is said about the mechanism that comes out, in order."""
    return (UNSOLVED,)


Place = Callable[[str, int, int, bool, str], None]
"""Gives a symbol its cell: (symbol, row, column, in degrees, wanted name)."""


def plan_rows(mechanism: Mechanism, task: Synthesis, place: Place) -> Rows:
    """The rows of the sheet; every input and step of the task, and what is said of it, gets its cell."""
    rows = Rows()
    by_symbol: dict[str, Dimension] = {dim.symbol: dim for dim in mechanism.dimensions}
    rows.block("task", task.inputs)
    rows.block("result", tuple(task.results))
    rows.block("does", verdicts_of(task))
    rows.not_before(FIRST_ROW + CHART_ROWS)
    rows.block("solution", task.steps)
    for block, symbols in (("task", task.inputs), ("solution", task.steps)):
        for symbol in symbols:
            dim = by_symbol[symbol]
            place(symbol, rows.of[block, symbol], VALUE, dim.unit.in_degrees, dim.cell or symbol)
    place("#synthesis", LINE_ROW, SYMBOL, False, "synthesis")
    for key in verdicts_of(task):
        place(f"#{key}", rows.of["does", key], VALUE, False, key)
    return rows

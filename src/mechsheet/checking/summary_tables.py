"""The two-way tables of summaries against a search with the two inputs of each cell (`kinematics.search`)."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from mechsheet.checking.report import Tally
from mechsheet.checking.searched_verdicts import SearchedVerdicts
from mechsheet.formula.nodes import Scalar
from mechsheet.formula.references import cell_address
from mechsheet.kinematics.search import TURN, Search
from mechsheet.model import Summary
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.table.requested import tables_of
from mechsheet.sheet.table.summary_table import SummaryTable
from mechsheet.sheet.table.two_way import FIRST, HEAD_ROW

EXACT, ABOUT = 1e-4, 5e-2
"""So much of its range a value may be off; and where the sheet marks it as about right."""

ROUNDED = 1e-8
"""As a part of the size, or as an angle [rad]: rounding at a dead centre."""


def judge_tables(values: Any, plan: Plan, tally: Tally, search: Callable[[dict[str, float]], Search | None]) -> None:
    """Note each cell of each such table.

    search  the motion with other values of some inputs (internal units); None where there is none to search
    """
    for table in tables_of(plan):
        if isinstance(table, SummaryTable):
            _judge(values, plan, table, tally, search)


def _judge(
    values: Any, plan: Plan, table: SummaryTable, tally: Tally, search: Callable[[dict[str, float]], Search | None]
) -> None:
    for down in range(len(table.request.row_values)):
        for across in range(table.count):
            row, col = FIRST + down, 1 + across
            given = {
                table.row.symbol: values.get(table.title, row, 0),
                table.column.symbol: values.get(table.title, HEAD_ROW, col),
            }
            dims = {table.row.symbol: table.row, table.column.symbol: table.column}
            if not all(isinstance(number, float) for number in given.values()):
                continue
            found = search({symbol: dims[symbol].unit.to_internal(number) for symbol, number in given.items()})
            if found is None:
                continue
            sure = values.get(table.title, table.helpers.sure.row, table.at + down * table.count + across) == 1.0
            shown = values.get(table.title, row, col)
            words = ", ".join(f"{symbol} = {number:.6g}" for symbol, number in given.items())
            where = f"{cell_address(table.title, row, col)} ({table.request.value} with {words})"
            expected = expected_of(plan, table.summary, found)
            if expected is None:
                tally.note(0.0 if not isinstance(shown, float) else math.inf, where, shown, "no number")
            elif expected.sure or not isinstance(shown, float):
                tally.note(expected.apart(shown, sure) * tally.tolerance, where, shown, expected.value)


@dataclass(frozen=True, slots=True)
class Expected:
    """What a summary is.

    value, of_rows  as the motion has it, and the rows alone
    range           of the quantity;  rounded: so much is rounding
    turn            of an angle that is known up to whole turns, else 0
    whole           whether all positions exist;  sure: whether the motion is known well enough to ask
    """

    value: float
    of_rows: float
    range: float
    rounded: float
    turn: float
    whole: bool
    sure: bool

    def apart(self, shown: Scalar, settled: bool) -> float:
        """How far a cell's value is off, as a part of what is allowed.

        Where some positions do not exist it may be anything between that of the rows and that of the motion.
        """
        if not isinstance(shown, float):
            return math.inf
        low, high = sorted((self.value, self.value if self.whole else self.of_rows))
        if self.turn:
            shown += self.turn * round((low - shown) / self.turn)
        off = max(low - shown, shown - high, 0.0)
        return off / ((EXACT if settled or not self.whole else ABOUT) * self.range + self.rounded)


def expected_of(plan: Plan, summary: Summary, search: Search) -> Expected | None:
    """What a summary is over the rows that exist and what lies between them; None where no row exists."""
    if not search.count:
        return None
    judged = SearchedVerdicts(plan, search)
    angle = search.is_angle(summary.of)
    scale = judged.scale(summary.of)
    inner, outer = search.extremes(summary.of, rows_only=True), search.extremes(summary.of)
    if inner is None or outer is None:
        return None
    column = search.at[summary.of][:: search.fine][search.row_there]
    rows = {"min": inner[0], "max": inner[2], "range": inner[2] - inner[0]}
    motion = {"min": outer[0], "max": outer[2], "range": outer[2] - outer[0]}
    plain = {"first": float(column[0]), "last": float(column[-1]), "mean": float(np.mean(column))}
    value, of_rows = ({**found, **plain}[summary.take] * scale for found in (motion, rows))
    whole = search.count == search.rows
    unit = 1.0 if angle else search.size
    return Expected(
        value, of_rows, (outer[2] - outer[0]) * scale, ROUNDED * unit * scale,
        TURN * scale if angle and summary.take != "range" else 0.0,
        whole, judged.sure and (whole or not angle or len(search.row_stretches) == 1),
    )  # fmt: skip

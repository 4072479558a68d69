"""The two-way tables of summaries against a search with the two inputs of each cell (`kinematics.search`)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from livesheet.formula.references import cell_address
from mechsheet.checking.report import Tally
from mechsheet.checking.searched.summaries import expected_of
from mechsheet.kinematics.search import Search
from mechsheet.sheet.asked.requested import tables_of
from mechsheet.sheet.asked.summary_table import SummaryTable
from mechsheet.sheet.asked.two_way import FIRST, HEAD_ROW
from mechsheet.sheet.findings.searched import SearchedMotion
from mechsheet.sheet.plan import Plan


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
            expected = expected_of(SearchedMotion(plan, found), table.summary)
            if expected is None:
                tally.note(0.0 if not isinstance(shown, float) else math.inf, where, shown, "no number")
            elif expected.sure or not isinstance(shown, float):
                tally.note(expected.apart(shown, sure) * tally.tolerance, where, shown, expected.value)

"""The sheets of the two-way tables that a description asks for."""

from __future__ import annotations

from typing import TYPE_CHECKING

from livesheet.said import say
from livesheet.workbook import Sheet
from mechsheet.kinematics.equations import need_closed_form
from mechsheet.model import TableRequest
from mechsheet.sheet.plan import Plan

if TYPE_CHECKING:
    from mechsheet.sheet.asked.two_way import Table


def table_sheets(plan: Plan) -> tuple[Sheet, ...]:
    """One sheet for each table that the description asks for."""
    return tuple(table.sheet() for table in tables_of(plan))


def tables_of(plan: Plan) -> list[Table]:
    """The tables, each with its sheet's title. MechanismError where a cell would need the row above.

    A page leaves those of summaries out, and says so: it has no cells that look between the rows.
    """
    if not plan.mechanism.tables:
        return []
    from mechsheet.sheet.asked.summary_table import SummaryTable
    from mechsheet.sheet.asked.two_way import Table

    need_closed_form(
        plan.equations.equations, say("a two-way table cannot hold this"), "tables", say("leave the table out")
    )
    taken = {title.casefold() for title in plan.at.titles.values()}
    found: list[Table] = []
    for request in plan.mechanism.tables:
        if request.of_summary and plan.mechanism.layout == "page":
            continue
        title = _sheet_title(plan, request, taken)
        taken.add(title.casefold())
        kind = SummaryTable if request.of_summary else Table
        found.append(kind(plan, request, title))
    return found


def _sheet_title(plan: Plan, request: TableRequest, taken: set[str]) -> str:
    """`Table s15`, with a number where that is taken; at most 31 characters, as spreadsheets want."""
    base = f"{plan.text('sheet.table')} {request.value}"[:27]
    number = 1
    title = base
    while title.casefold() in taken:
        number += 1
        title = f"{base} {number}"
    return title

"""Columns of what a summary's mean is of, where that is not the quantity itself: its square, for a root mean square.

A column of its own, because no spreadsheet has a mean that squares and leaves out rows without a position; and so that the
mean's cell reads like every other mean.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TypeVar

from livesheet.formula.nodes import Symbol
from mechsheet.kinematics.equations import FORCES, RATES, Role
from mechsheet.model import Mechanism, Summary
from mechsheet.sheet.columns.lowering import Assignment, Assignments
from mechsheet.sheet.quoted import SHOWN
from mechsheet.units import Unit
from mechsheet.words.equations import phrase

Lowered = TypeVar("Lowered", bound=Assignments)


def with_averaged(mechanism: Mechanism, equations: Lowered) -> Lowered:
    """The equations, with these columns behind all others, each on the sheet of its quantity."""
    columns: dict[str, Role] = dict.fromkeys((mechanism.driver.symbol, *mechanism.given_by_row), "driver")
    columns |= {equation.symbol: equation.role for equation in equations.columns}
    found = {
        summary.take.column(summary.of): _averaged(mechanism, equations, summary, columns[summary.of])
        for summary in mechanism.summaries
        if summary.of in columns and summary.take.column(summary.of) not in columns
    }
    return replace(equations, columns=(*equations.columns, *found.values())) if found else equations


def _averaged(mechanism: Mechanism, equations: Assignments, summary: Summary, role: Role) -> Assignment:
    take, column = summary.take, summary.take.column(summary.of)
    shown = mechanism.shown(mechanism.given_unit(summary.of) or equations.of(summary.of).unit).text
    unit = Unit("number", f"({shown}){take.mark}" if set(" /·") & set(shown) else shown and shown + take.mark)
    role = "coefficient" if role in RATES else "dynamic" if role in FORCES else "intermediate"
    says, label = take.row(Symbol(summary.of)), phrase("averaged", symbol=column)
    return Assignment(column, take.row(Symbol(SHOWN + summary.of)), says, role, unit, label)

"""How the driver goes from row to row, as formulas: by one step, or in time by a motion law."""

from __future__ import annotations

from livesheet.formula.nodes import CellRef, Node, Symbol, with_symbols
from mechsheet.model import TIME, Law
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import SHOWN, formula


def driver_at(plan: Plan, place: Node) -> Node:
    """The driver's value, as people read it, at a place counted in rows from 1; symbols are still to be bound."""
    law = plan.mechanism.driver.law
    if law is None:
        return driver_after(plan, formula("place-1", place=place))
    return by_time(law, time_after(law, formula("place-1", place=place)))


def driver_after(plan: Plan, rows: Node) -> Node:
    """That of a driver that goes on by one step, after so many rows."""
    start, step = (there(spot).cell for spot in (plan.places.start, plan.places.step))
    return formula("start+rows*step", start=start, step=step, rows=rows)


def rows_before(plan: Plan) -> Node:
    """How many rows of the table are before a row.

    Counted from the first row, not from the heading, so that rows inserted over the first do not count; and at a cell
    beside the table: a formula that asks for the row of its own cell is a circle to some programs, though not to
    spreadsheets.
    """
    return formula("ROW()-ROW(beside)", beside=CellRef(plan.at.first, len(plan.columns), True, True))


def time_after(law: Law, rows: Node) -> Node:
    """The time [s] after so many rows."""
    return formula("rows*duration/all", rows=rows, duration=Symbol(law.duration), all=law.rows - 1)


def by_time(law: Law, time: Node) -> Node:
    """The driver's value, as people read it, at a time."""
    shown = {name: Symbol(SHOWN + name) for name in (law.start, law.stop)} | {TIME: time}
    return with_symbols(law.value, shown)

"""Rows of the table of positions that exist, as formulas of other sheets ask for them."""

from __future__ import annotations

from mechsheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef
from mechsheet.sheet.plan import EXISTS, NUMBER, Plan


def fixed_column(plan: Plan, col: int) -> RangeRef:
    """A column of the table, anchored."""
    return RangeRef(
        CellRef(plan.at.first, col, True, True, plan.table), CellRef(plan.at.last, col, True, True, plan.table)
    )


def exists_column(plan: Plan) -> RangeRef:
    """1 where the row has a position, else 0."""
    return fixed_column(plan, EXISTS)


def first_row(plan: Plan) -> Node:
    """1 for the first row of the table, if that is the first that exists."""
    return Call("MATCH", (Number(1.0), exists_column(plan), Number(0.0)))


def last_row(plan: Plan) -> Node:
    """The same for the last one: 1 + the largest row number among the rows that exist.

    LARGE, not MAX: gnumeric evaluates only the former's argument as an array here.
    """
    product = Binary("*", exists_column(plan), Binary("+", fixed_column(plan, NUMBER), Number(1.0)))
    return Call("SUMPRODUCT", (Call("LARGE", (product, Number(1.0))),))

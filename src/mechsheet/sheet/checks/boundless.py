"""Quantities that grow without bound: at a limit position, or at a place between two rows where they change sign.

Probes come as near to such a place as one likes and find a number as large as one likes: it is no extreme. So the sheet
says it in a word. At a limit the probes lead far beyond all that the rows have; at a pole between two rows the reciprocal
of the quantity goes through 0 in a nearly straight line.
"""

from __future__ import annotations

from mechsheet.formula.nodes import Node
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula

GROWN = 30.0
"""The probes of a quantity without bound lead beyond the best row by more than so many ranges of the rows."""

STRAIGHT = 0.3
"""How much a reciprocal may bend over three rows around a pole, as a part of its change."""

LEAST_ROWS = 6
"""Fewer rows say too little of the range."""


def may_grow(plan: Plan, symbol: str) -> bool:
    """Whether a quantity can be without bound: not the angles of links and between them, nor places of points."""
    if plan.rows_only:
        return False
    bounded = {link.angle_symbol for link in plan.mechanism.links} | {
        each.transmission for each in plan.found.transmission
    }
    return symbol not in bounded and plan.equations.of(symbol).role != "point"


def beyond_rows(value: Node, of_rows: Node, others: Node, rows: tuple[Node, Node]) -> Node:
    """Whether an extreme is far beyond the rows.

    of_rows, others  the best and the worst of the rows;  rows: the first and the last row of the stretch
    """
    return formula(
        "AND(last-first>=least,ABS(value-of_rows)>grown*ABS(of_rows-others))", first=rows[0], last=rows[1],
        least=LEAST_ROWS - 1, value=value, of_rows=of_rows, others=others, grown=GROWN,
    )  # fmt: skip


def at_pole(before: Node, here: Node, after: Node) -> Node:
    """Whether a quantity has a pole beside the middle one of three rows."""
    return formula(
        "IFERROR(AND(MIN(before*here,after*here)<0,ABS(1/before-2/here+1/after)<straight*ABS(1/before-1/after)),FALSE)",
        before=before, here=here, after=after, straight=STRAIGHT,
    )  # fmt: skip

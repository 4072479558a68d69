"""Sheets that a person may delete: all but the first and that of the positions.

What needs one that is gone is empty, and its words, where they are a formula, say which sheet was deleted. References to it
are errors, which a program never comes to: a cell of the first sheet says of each other sheet whether it is there.
"""

from __future__ import annotations

from collections.abc import Iterable

from livesheet.formula.nodes import CellRef, Node
from mechsheet.sheet.plan import MEANING, Plan
from mechsheet.sheet.quoted import formula

FIRST_OF_ALL = ("synthesis", "iterations")
"""Without these there are no positions."""

READS = {"extremes": ("checks",), "forces": ("rates",), "tolerance": ("rates", "checks", "extremes")}
"""What further sheets a sheet needs."""


def missing_words(plan: Plan) -> CellRef:
    """The cell that says which sheets were deleted."""
    return CellRef(plan.places.lines["sheets"].row, MEANING, True, True)


def with_what_they_read(keys: Iterable[str]) -> set[str]:
    """These sheets and those that they need."""
    return {other for key in keys for other in (key, *READS.get(key, ()))}


def are_there(plan: Plan, keys: Iterable[str]) -> Node | None:
    """Whether all these sheets are there, and what they need; None where the workbook has none of them."""
    needed = with_what_they_read(keys)
    found = [spot.cell for key, spot in plan.places.sheets.items() if key in needed]
    node: Node | None = None
    for cell in found:
        node = cell if node is None else formula("node*cell", node=node, cell=cell)
    return node


def sheets_of(plan: Plan, symbol: str) -> set[str]:
    """The keys of the sheets, beside that of the positions, that a quantity is computed on; an output may read others."""
    keys = {plan.at.titles[key]: key for key in plan.places.sheets}
    outputs = {equation.symbol: equation for equation in plan.equations.columns if equation.role == "output"}
    found, waiting = set(), {symbol}
    for name in iter(lambda: waiting.pop() if waiting else None, None):
        if name in outputs:
            waiting.update(outputs[name].reads)
        elif name in plan.at.spots:
            found.add(keys.get(plan.at.spots[name].sheet, ""))
    return found - {""}

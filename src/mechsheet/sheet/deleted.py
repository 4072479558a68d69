"""Sheets that a person may delete: all but the first and that of the positions.

What needs one that is gone is empty, and its words, where they are a formula, say which sheet was deleted. References to it
are errors, which a program never comes to: a cell of the first sheet says of each other sheet whether it is there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace

from livesheet.formula.nodes import CellRef, NameRef, Node, RangeRef, children
from livesheet.workbook import Fill, Name
from mechsheet.sheet.plan import HIDDEN, MEANING, Plan
from mechsheet.sheet.quoted import formula

FIRST_OF_ALL = ("synthesis", "iterations")
"""Without these there are no positions."""

READS = {"extremes": ("checks",), "forces": ("rates",), "tolerance": ("rates", "checks", "extremes")}
"""What further sheets a sheet needs."""

TELLS_OF_ROWS = "checks"
"""The sheet that counts from row to row: where rows of it were deleted, it counts no further. So the cell that says
whether it is there says of the rows of all sheets, too, whether some were deleted."""


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


def readers_of(plan: Plan, key: str) -> list[str]:
    """The titles of the sheets, of those that a person sees, that have no numbers without this one."""
    return [
        plan.at.titles[other] for other in plan.places.sheets if key in READS.get(other, ()) and other not in HIDDEN
    ]


def cells_read(tree: Node, names: Mapping[str, Name]) -> Iterator[tuple[str | None, int, int]]:
    """The cells that a formula names, of ranges their corners, each with its sheet: None for the formula's own."""
    match tree:
        case RangeRef(start, end):
            for corner in (start, end):
                yield start.sheet, corner.row, corner.col
        case CellRef():
            yield tree.sheet, tree.row, tree.col
        case NameRef(name) if name in names:
            named = names[name]
            yield named.sheet, named.row, named.col
        case _:
            for part in children(tree):
                yield from cells_read(part, names)


def gaps_where_deleted(plan: Plan, fills: Iterable[Fill], sheet: str) -> list[Fill]:
    """The formulas of a sheet that charts draw: #N/A, which is a gap, in cells that read a sheet that was deleted.

    Any other error is drawn as 0 in Excel.
    """
    names = {name.name: name for name in plan.names}
    keys = {plan.at.titles[key]: key for key in plan.places.sheets}
    kept = []
    for fill in fills:
        read = {keys[title] for title, *_ in cells_read(fill.formula, names) if title in keys}
        present = are_there(plan, read - {*FIRST_OF_ALL})
        if present is not None:
            node = formula("IF(present,own,NA())", present=present, own=fill.formula)
            fill = replace(fill, formula=plan.at.bind(node, sheet))
        kept.append(fill)
    return kept

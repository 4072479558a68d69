"""Sheets that a person may delete: all but the first and that of the positions.

What needs one that is gone is empty, and its words, where they are a formula, say which sheet was deleted. References to it
are errors, which a program never comes to: a cell of the first sheet says of each other sheet whether it is there.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from livesheet.formula.nodes import CellRef, NameRef, Node, RangeRef, Text, children
from livesheet.workbook import Fill
from mechsheet.sheet.first.blocks import Writer
from mechsheet.sheet.plan import LEGEND_ROW, MARGIN, MEANING, VALUE, VERDICT_ROW, Plan
from mechsheet.sheet.quoted import formula

FIRST_OF_ALL = ("synthesis", "iterations")
"""Without these there are no positions."""

READS = {"extremes": ("checks",), "forces": ("rates",), "tolerance": ("rates", "checks", "extremes")}
"""What further sheets a sheet needs."""


def missing_words(plan: Plan) -> CellRef:
    """The cell that says which sheets were deleted."""
    return CellRef(plan.places.lines["sheets"].row, MEANING, True, True)


def are_there(plan: Plan, keys: Iterable[str]) -> Node | None:
    """Whether all these sheets are there, and what they need; None where the workbook has none of them."""
    needed = {other for key in keys for other in (key, *READS.get(key, ()))}
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


def while_sheets_are_there(writer: Writer) -> list[Fill]:
    """The sheet's formulas: those that need other sheets are empty where one of these was deleted, words say so."""
    needs, kept = _Needs(writer), []
    own = {*(spot.row for spot in writer.plan.places.sheets.values()), VERDICT_ROW, LEGEND_ROW}
    for fill in writer.fills:
        needed = needs.of(fill.row, fill.col)
        if fill.col == MEANING:
            needed = needed | needs.of(fill.row, VALUE)
        if (fill.row, fill.col) in writer.says_itself:
            needed = needed & {*FIRST_OF_ALL}
        present = are_there(writer.plan, needed)
        if present is None or fill.row in own or fill.col == MARGIN:
            kept.append(fill)
            continue
        otherwise = missing_words(writer.plan) if fill.col == MEANING else Text("")
        node = formula("IF(present,own,otherwise)", present=present, own=fill.formula, otherwise=otherwise)
        kept.append(replace(fill, formula=writer.plan.at.bind(node, writer.title)))
    return kept


class _Needs:
    """Which other sheets the cells of the first sheet need."""

    def __init__(self, writer: Writer) -> None:
        plan = writer.plan
        self.keys = {plan.at.titles[key]: key for key in plan.places.sheets}
        self.first_of_all = {key for key in FIRST_OF_ALL if key in plan.places.sheets}
        self.table, self.title, self.further = plan.table, writer.title, writer.needs
        self.names = {name.name: name for name in plan.names}
        self.fills = {(fill.row, fill.col): fill for fill in writer.fills}
        self.found: dict[tuple[int, int], set[str]] = {}

    def of(self, row: int, col: int) -> set[str]:
        """The keys of what a cell needs, itself or by cells of its sheet that it reads."""
        place = row, col
        if place not in self.found:
            found = self.found[place] = {*self.further.get(row, ())} if place in self.fills else set()
            for sheet, *cell in self._read(self.fills[place].formula) if place in self.fills else ():
                if sheet == self.title:
                    found |= self.of(*cell)
                elif sheet == self.table:
                    found |= self.first_of_all
                elif sheet in self.keys:
                    found |= {self.keys[sheet]} | self.first_of_all
        return self.found[place]

    def _read(self, tree: Node) -> Iterator[tuple[str, int, int]]:
        """The cells that a formula names, of ranges their corners, each with its sheet."""
        match tree:
            case RangeRef(start, end):
                for corner in (start, end):
                    yield start.sheet or self.title, corner.row, corner.col
            case CellRef():
                yield tree.sheet or self.title, tree.row, tree.col
            case NameRef(name) if name in self.names:
                named = self.names[name]
                yield named.sheet, named.row, named.col
            case _:
                for part in children(tree):
                    yield from self._read(part)

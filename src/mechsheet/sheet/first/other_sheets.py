"""The last blocks of the first sheet: words that the tables look up, and which of the other sheets are there.

A person may delete any sheet but the first and that of the positions. What needs one that is gone is empty, and its words,
where they are a formula, say which sheet was deleted: references to it are errors, which a program never comes to.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace

from livesheet.formula.nodes import CellRef, NameRef, Node, RangeRef, Text, children
from livesheet.workbook import Fill
from mechsheet.sheet import styles
from mechsheet.sheet.first.blocks import Writer
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import LEGEND_ROW, MARGIN, MEANING, VALUE, VERDICT_ROW, Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.table.rates import dead_words
from mechsheet.sheet.table.status import words_looked_up

FIRST_OF_ALL = ("synthesis", "iterations")
"""Without these there are no positions."""

READS = {"extremes": ("checks",), "forces": ("rates",), "tolerance": ("rates", "checks", "extremes")}
"""What further sheets a sheet needs."""


def write_other_sheets(writer: Writer) -> None:
    """Fill the blocks in."""
    plan = writer.plan
    for key, said in (("reasons", words_looked_up(plan)), ("dead", dead_words(plan))):
        if said:
            writer.heading(key)
            for row, words in enumerate(said, plan.blocks[key].row + 1):
                writer.put(row, MEANING, words, styles.LABEL)
    rows = plan.blocks["sheets"].rows
    writer.heading("sheets")
    count = styles.decimals(styles.RESULT, 0)
    parts = []
    for key, spot in plan.places.sheets.items():
        title = plan.at.titles[key]
        writer.line(rows[key], title, "", plan.text("sheets.there"))
        writer.formula(rows[key], VALUE, formula("ISREF(cell)*1", cell=CellRef(0, 0, True, True, title)), count)
        gone = plan.text("sheets.deleted", sheet=title)
        parts.append(formula('IF(there,"",gone)', there=spot.cell, gone=f"; {gone}"))
    spots = [*plan.places.sheets.values()]
    marks = RangeRef(*(CellRef(spot.row, spot.col, True, True) for spot in (spots[0], spots[-1])))
    writer.line(rows["missing"], plan.text("sheets.missing"), "", None)
    writer.formula(rows["missing"], VALUE, formula("COUNTIF(marks,0)", marks=marks), count)
    writer.formula(rows["missing"], MEANING, formula("MID(said,3,999)", said=joined(*parts)), styles.LABEL_SAID)


def missing_words(plan: Plan) -> CellRef:
    """The cell that says which sheets were deleted."""
    return CellRef(there(plan.places.missing).row, MEANING, True, True)


def are_there(plan: Plan, keys: Iterable[str]) -> Node | None:
    """Whether all these sheets are there, and what they need; None where none of them can be deleted."""
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
    own = {*writer.plan.blocks["sheets"].rows.values(), VERDICT_ROW, LEGEND_ROW}
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

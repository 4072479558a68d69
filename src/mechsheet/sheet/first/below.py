"""The last blocks of the first sheet, words that the tables look up and whether the other sheets are there; and that its
cells are empty which need one that was deleted."""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula.nodes import CellRef, Text
from livesheet.workbook import Fill
from mechsheet.sheet import styles
from mechsheet.sheet.deleted import FIRST_OF_ALL, are_there, cells_read, missing_words
from mechsheet.sheet.first.blocks import Writer
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import LEGEND_ROW, MARGIN, MEANING, VALUE, VERDICT_ROW
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.table.rates import dead_words
from mechsheet.sheet.table.status import words_looked_up


def write_below(writer: Writer) -> None:
    """Fill the blocks in."""
    plan = writer.plan
    for key, said in (("reasons", words_looked_up(plan)), ("dead", dead_words(plan))):
        if said:
            writer.heading(key)
            for row, words in enumerate(said, plan.blocks[key].row + 1):
                writer.meaning(row, words)
    writer.heading("sheets")
    writer.line(there(plan.places.left).row, plan.text("sheets.left"), "", None)
    for key, spot in plan.places.sheets.items():
        title = plan.at.titles[key]
        writer.line(spot.row, title, "", plan.text("sheets.there"))
        found = formula("ISREF(cell)*1", cell=CellRef(0, 0, True, True, title))
        writer.formula(spot.row, VALUE, found, styles.decimals(styles.RESULT, 0))


def while_sheets_are_there(writer: Writer) -> list[Fill]:
    """The sheet's formulas: those that need other sheets are empty where one of these was deleted, words say so."""
    needs, kept = _Needs(writer), []
    places = writer.plan.places
    own = {*(spot.row for spot in places.sheets.values()), there(places.left).row, VERDICT_ROW, LEGEND_ROW}
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
        # what says whether a sheet is there needs none
        self.found: dict[tuple[int, int], set[str]] = {
            (spot.row, spot.col): set() for spot in plan.places.sheets.values()
        }

    def of(self, row: int, col: int) -> set[str]:
        """The keys of what a cell needs, itself or by cells of its sheet that it reads."""
        place = row, col
        if place not in self.found:
            found = self.found[place] = {*self.further.get(row, ())} if place in self.fills else set()
            for sheet, *cell in cells_read(self.fills[place].formula, self.names) if place in self.fills else ():
                if sheet in (None, self.title):
                    found |= self.of(*cell)
                elif sheet == self.table:
                    found |= self.first_of_all
                elif sheet in self.keys:
                    found |= {self.keys[sheet]} | self.first_of_all
        return self.found[place]

"""The last blocks of the first sheet: words that the tables look up, and whether the other sheets are there."""

from __future__ import annotations

from livesheet.formula.nodes import CellRef
from mechsheet.sheet import styles
from mechsheet.sheet.first.blocks import Writer
from mechsheet.sheet.plan import MEANING, VALUE
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
                writer.put(row, MEANING, words, styles.LABEL)
    writer.heading("sheets")
    for key, spot in plan.places.sheets.items():
        title = plan.at.titles[key]
        writer.line(spot.row, title, "", plan.text("sheets.there"))
        there = formula("ISREF(cell)*1", cell=CellRef(0, 0, True, True, title))
        writer.formula(spot.row, VALUE, there, styles.decimals(styles.RESULT, 0))

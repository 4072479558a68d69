"""The formula of each cell that *Notes* names, as text beside its equation."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from livesheet.formula.printer import print_formula
from livesheet.workbook import Cell, Workbook
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.notes.notes import FORMULA

STYLE = replace(styles.NOTE_CELL, name="", wrap=False)


def with_formulas(workbook: Workbook, title: str, places: Mapping[int, Spot]) -> Workbook:
    """The workbook with them, in a column that is not printed.

    title   of the notes;  places: where the quantity of each of their rows stands
    """
    wanted = {(spot.sheet, spot.row, spot.col): row for row, spot in places.items()}
    found = [
        Cell(wanted[sheet.title, fill.row, fill.col], FORMULA, f"={print_formula(fill.formula)}", STYLE)
        for sheet in workbook.sheets
        for fill in sheet.fills
        if (sheet.title, fill.row, fill.col) in wanted
    ]
    sheets = (replace(each, cells=(*each.cells, *found)) if each.title == title else each for each in workbook.sheets)
    return replace(workbook, sheets=tuple(sheets))

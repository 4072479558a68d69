"""What the blocks of the first sheet share: symbol, value, unit, tolerance, meaning side by side."""

from __future__ import annotations

from livesheet.workbook import Content, Style
from mechsheet.sheet import styles
from mechsheet.sheet.cells import Cells
from mechsheet.sheet.plan import MEANING, SYMBOL, TOLERANCE, UNIT, Plan
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.sheet.wrapping import height_of, label_lines
from mechsheet.units import Unit

MEANING_WIDTH = 44
"""Characters of the column that says what a line is; a longer label is broken into lines, it would run under the drawing."""

COLUMN = 7
"""Least pixels of a character of a column's width: Excel's."""


class Writer(Cells):
    """Collects the cells of the sheet; `heights` of rows with a label of several lines.

    needs        by row the keys of other sheets that its cells need, though no formula there reads them
    says_itself  cells that say themselves what is left without another sheet
    """

    def __init__(self, plan: Plan, title: str) -> None:
        super().__init__(plan, title)
        self.needs: dict[int, set[str]] = {}
        self.says_itself: set[tuple[int, int]] = set()

    def line(self, row: int, symbol: Content, unit: str | None, meaning: str | None) -> None:
        """The fixed parts of an entry: everything but its value (and its unit or meaning, when that is a formula: None)."""
        self.put(row, SYMBOL, symbol, styles.SYMBOL)
        if unit is not None:
            self.put(row, UNIT, unit, styles.UNIT)
        if meaning is not None:
            self.meaning(row, meaning)

    def meaning(self, row: int, meaning: str) -> None:
        """A label in as many lines as it takes: what went on over the next column would be printed on a page of its own."""
        lines = label_lines(meaning, COLUMN * MEANING_WIDTH)
        self.put(row, MEANING, meaning, styles.LABEL if lines == 1 else styles.LABEL_LINES)
        if lines > 1:
            self.heights[row] = height_of(lines)

    def heading(self, key: str, over_tolerance: str | None = None) -> None:
        """The heading of a block, across its columns; a block may use the tolerance's column for something else."""
        row = self.plan.blocks[key].row
        self.put(row, SYMBOL, self.plan.text(f"block.{key}"), styles.SECTION)
        for col in range(SYMBOL + 1, MEANING + 1):
            self.put(row, col, over_tolerance if col == TOLERANCE else None, styles.SECTION)


def value_style(plan: Plan, unit: Unit) -> Style:
    """The style of a result in this unit: one decimal more than the tolerances justify for lengths."""
    return styles.decimals(
        styles.RESULT, decimals_of_kind(plan, unit.kind, unit.symbol) + (1 if unit.kind == "length" else 0)
    )

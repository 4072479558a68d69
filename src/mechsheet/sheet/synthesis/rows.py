"""Which row of the sheet of synthesis holds what, before any of its cells is written."""

from __future__ import annotations

from dataclasses import dataclass, field

TITLE_ROW, LINE_ROW, HINT_ROW = range(3)

FIRST_ROW = 4
"""The row of the first block's heading."""

SYMBOL, VALUE, UNIT, ROUNDED, USED, MEANING, REMARK = range(7)
"""Columns. Equations stand across ROUNDED to MEANING; the remarks beside them, under the charts."""

CHARTS = REMARK
"""The column of the charts, which stand beside the task, one below the other: so the sheet is as wide as a page."""

CHART_ROWS, BOTH_CHARTS = 19, 32
"""Rows that the figure covers, and it with the curve below it."""


@dataclass
class Rows:
    """Rows by block and entry.

    heads  block -> the row of its heading;  of: (block, entry) -> its row
    """

    heads: dict[str, int] = field(default_factory=dict)
    of: dict[tuple[str, str], int] = field(default_factory=dict)
    next_row: int = FIRST_ROW

    def block(self, key: str, entries: tuple[str, ...], head_rows: int = 1) -> None:
        """Reserve rows for a block: its heading, its entries, one empty row."""
        self.heads[key] = self.next_row
        for index, entry in enumerate(entries):
            self.of[key, entry] = self.next_row + head_rows + index
        self.next_row += head_rows + len(entries) + 1

    def not_before(self, row: int) -> None:
        """The next block begins at this row or below it."""
        self.next_row = max(self.next_row, row)

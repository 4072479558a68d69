"""The drawing of a page: what it needs stands to the right of the table, folded away.

It stands below the rows that a person may fill, and looks the table's rows up: rows that are inserted into the table, or
filled down as whole rows, tear nothing apart there, and nobody needs to fill columns that are folded away.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from livesheet.formula.nodes import CellRef, Node, transform
from livesheet.workbook import Chart, Column, Content, Style
from mechsheet.model import ChartRequest
from mechsheet.sheet import styles
from mechsheet.sheet.as_typed import degrees_together
from mechsheet.sheet.drawing.drawing import caption, chart_of, letters_in, square_chart
from mechsheet.sheet.drawing.frames import FIRST, NAME, NUMBER_STYLE, Page
from mechsheet.sheet.drawing.listed import Listed
from mechsheet.sheet.page.paper import CHART_HEIGHT
from mechsheet.sheet.page.plan import PagePlan
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.shown import rich

WORDS = replace(styles.INNER, name="", align="left", shrink=True)
"""Shrunk: a text that is too long would be drawn over the columns beside those that are folded away, and one that is wrapped
makes the table's rows higher."""


class _Beside(Page):
    """Cells to the right of the table, in its own manner."""

    plan: PagePlan

    def put(self, col: int, content: Content, style: Style = styles.LABEL) -> None:
        """A constant in the present row; an empty text is no cell."""
        if content is not None:
            super().put(col, content, style if isinstance(content, float) else WORDS)

    def formula(self, col: int, node: Node, style: Style = NUMBER_STYLE, rows: int = 1, cols: int = 1) -> CellRef:
        """A formula in the present row, or filled down and right from there; the address of the first."""
        return super().formula(col, transform(node, degrees_together), WORDS if col == NAME else style, rows, cols)

    @property
    def last_row(self) -> int:
        """The last row of the table that is looked at."""
        return self.plan.last_looked_at

    @property
    def sweep_from(self) -> int:
        return self.last_row + 3

    @property
    def numbered(self) -> bool:
        return True

    def row_number(self, heading: CellRef) -> Node:
        """So many rows of the table as it was built with, from the first to the last that it has now; none that is empty."""
        plan = self.plan
        number = formula("ROUND((ROW()-ROW(heading)-1)*(rows-1)/steps,0)", heading=heading, rows=plan.places.rows.cell,
                         steps=max(1, plan.rows - 1))  # fmt: skip
        drivers = plan.filled(plan.at.spots[plan.mechanism.driver.symbol])
        found = formula("IF(ISNUMBER(INDEX(drivers,number+1)),number,NA())", drivers=drivers, number=number)
        return plan.at.bind(found, self.title)


class PageDrawing:
    """The helpers' cells from column `start` on, and the charts that read them.

    shown  the cells with quantities of charts in the row that is drawn, as people read them
    """

    def __init__(self, plan: PagePlan, start: int, charted: Sequence[str]) -> None:
        self._page = page = _Beside(plan, plan.main, start, plan.last_looked_at + 1)
        self.cells, self.fills = page.cells, page.fills
        self.shown: dict[str, CellRef] = {}
        page.section(plan.text("page.drawing"))
        for symbol in charted:
            page.put(NAME, rich(symbol))
            self.shown[symbol] = page.formula(FIRST, page.indexed(plan.at.spots[symbol]))
            page.row += 1
        listed = Listed(page, letters_in(CHART_HEIGHT), lambda: caption(page))
        self.chart = chart_of(plan, listed.series, CHART_HEIGHT)

    @property
    def columns(self) -> tuple[Column, ...]:
        """The helpers' columns, folded away."""
        last = self._page.col - 1
        return (
            Column(self._page.left, last, 11.0, level=1, hidden=True), Column(last + 1, last + 1, 3.0, collapsed=True)
        )  # fmt: skip

    def square(self, request: ChartRequest) -> Chart:
        """A hodograph or a cam's profile, and what is at the row that is drawn."""
        return square_chart(self._page, request, CHART_HEIGHT)

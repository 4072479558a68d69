"""The two-way tables: the driver down, a dimension across, one formula with mixed anchors filled both ways.

The first column reads the driver's values from the table of positions (`$A8`), the head row holds the values of the
dimension as inputs (`B$7`). What a cell says, and the helpers beside the table, is in `cell_formula`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

from livesheet.formula.nodes import Call, CellRef
from livesheet.formula.printer import quote_sheet
from livesheet.workbook import (
    Anchor,
    Area,
    Axis,
    Cell,
    Chart,
    Column,
    Conditional,
    Fill,
    Merge,
    PrintSetup,
    Series,
    SeriesRef,
    Sheet,
    Validation,
)
from mechsheet.model import Dimension, Quantity, TableRequest
from mechsheet.sheet import styles
from mechsheet.sheet.asked.cell_formula import Blocks, CellFormula, helper_blocks
from mechsheet.sheet.drawing.charts import driver_axis
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.shown import input_validation, rich, shown_unit
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.units import behind_number
from mechsheet.words.symbols import plain

TITLE_ROW, ABOUT_ROW, HINT_ROW, _, CORNER_ROW, NAME_ROW, HEAD_ROW, FIRST = range(8)
"""Rows of the sheet: the head is row 7, the first values stand in row 8."""

WIDTH, HEIGHT = 620, 400
CHART_COLUMNS, CHART_ROWS = 11, 24
"""What the chart covers; helper blocks stand to the right of it."""


@dataclass(frozen=True, slots=True)
class Body:
    """What a table has below its heads and beside its chart."""

    cells: tuple[Cell, ...]
    fills: tuple[Fill, ...]
    columns: tuple[Column, ...]
    conditionals: tuple[Conditional, ...]
    validations: tuple[Validation, ...] = ()


class Table:
    """One table while it is being laid out."""

    def __init__(self, plan: Plan, request: TableRequest, title: str) -> None:
        self.plan = plan
        self.request = request
        self.title = title
        self.count = len(request.columns)
        self.last = FIRST + plan.rows - 1
        self.helpers_at = 1 + self.count + 1 + CHART_COLUMNS + 1
        self.column: Dimension = next(dim for dim in plan.mechanism.dimensions if dim.symbol == request.column)

    def sheet(self) -> Sheet:
        """The sheet."""
        plan = self.plan
        cells, fills = self._head()
        body = self.body()
        return Sheet(
            self.title,
            (*cells, *body.cells),
            (*fills, *body.fills),
            columns=(*self._columns(), *body.columns),
            row_heights=((TITLE_ROW, 26.0), (HINT_ROW, 30.0)),
            merges=tuple(Merge(Area(row, 0, row, self._text_end())) for row in (ABOUT_ROW, HINT_ROW)),
            charts=(self._chart(),),
            validations=(
                input_validation(plan, Area(HEAD_ROW, 1, HEAD_ROW, self.count), self.request.column), *body.validations
            ),
            conditionals=body.conditionals,
            freeze=(FIRST, 1),
            selected=(HEAD_ROW, 1),
            gridlines=False,
            tab_color="7B3FA0",
            print_setup=PrintSetup(
                repeat_rows=(CORNER_ROW, HEAD_ROW),
                footer=plan.footer,
                area=Area(0, 0, max(self.last, CORNER_ROW + CHART_ROWS), 1 + self.count + CHART_COLUMNS),
            ),
        )  # fmt: skip

    def body(self) -> Body:
        """The driver's values, the table, and the helpers beside it."""
        plan, found = self.plan, self.found
        style = styles.decimals(styles.COLUMN, decimals_of_kind(plan, found.unit(self.request.value).kind))
        helper_cells, helper_fills = helper_blocks(found, CORNER_ROW)
        last = found.blocks.col(len(found.helpers)) - 2
        return Body(
            tuple(helper_cells),
            (
                self.driver_fill(0),
                Fill(FIRST, 1, found.formula, style, rows=plan.rows, cols=self.count),
                *helper_fills,
            ),
            (Column(self.helpers_at, last, 11, level=1, hidden=True), Column(last + 1, last + 1, 3, collapsed=True))
            if found.helpers
            else (),
            (self.missing(),),
        )

    def driver_fill(self, col: int) -> Fill:
        """The driver's values, from the table of positions."""
        driver = self.plan.at.cell(self.plan.mechanism.driver.symbol, self.title, self.plan.at.first)
        return Fill(FIRST, col, driver, styles.decimals(styles.HEAD, self._driver_decimals()), rows=self.plan.rows)

    def missing(self) -> Conditional:
        """Grey where there is no position."""
        area = Area(FIRST, 1, self.last, self.count)
        return Conditional(area, formula("ISNA(cell)", cell=CellRef(FIRST, 1)), styles.MISSING)

    # --- formulas ---------------------------------------------------------------------------------------------

    @cached_property
    def found(self) -> CellFormula:
        """The formula of a cell, and the helpers that it needs."""
        heads = {self.request.column: CellRef(HEAD_ROW, 1, row_abs=True)}
        return CellFormula(
            self.plan, self.title, self.request.value, heads, Blocks(FIRST, HEAD_ROW, 0, self.helpers_at, self.count)
        )

    def _driver_decimals(self) -> int:
        """Decimals of the first column: those that the driver's values need, two at most."""
        shown = [self.plan.mechanism.driver.unit.to_shown(value) for value in self.plan.driver]
        return next((digits for digits in (0, 1) if all(abs(x - round(x, digits)) < 1e-9 for x in shown)), 2)

    # --- what is written around them --------------------------------------------------------------------------

    def _head(self) -> tuple[list[Cell], list[Fill]]:
        plan, request = self.plan, self.request
        words = request.title.of(plan.language) if request.title else self._about()
        cells = [
            Cell(TITLE_ROW, 0, words, styles.TITLE),
            Cell(ABOUT_ROW, 0, self._about(), styles.SUBTITLE),
            Cell(HINT_ROW, 0, self.hint_words(), styles.NOTE),
            Cell(CORNER_ROW, 0, self.value_words(), styles.SECTION),
            Cell(CORNER_ROW, 1, rich(request.column, bracketed(self.column.unit.text) + " →"), styles.SECTION),
            *(Cell(CORNER_ROW, col, None, styles.SECTION) for col in range(2, 1 + self.count)),
            Cell(NAME_ROW, 0, None, styles.HEAD),
            Cell(HEAD_ROW, 0, self.rows_words() + " ↓", styles.HEAD),
        ]
        label = joined(f"{plain(request.column)} = ", CellRef(HEAD_ROW, 1), behind_number(self.column.unit.text))
        fills = [Fill(NAME_ROW, 1, label, styles.HEAD, cols=self.count)]
        for (_, quantities, inputs), dim in zip(self.heads(), self.varied(), strict=True):
            for quantity, at in zip(quantities, inputs, strict=True):
                self._input(cells, fills, at, dim, quantity)
        return cells, fills

    def varied(self) -> list[Dimension]:
        """The dimensions of the heads."""
        return [self.column]

    def _input(
        self, cells: list[Cell], fills: list[Fill], at: tuple[int, int], dim: Dimension, quantity: Quantity
    ) -> None:
        """A value of a dimension in the head of a row or column: a number, or a formula over the first sheet."""
        if isinstance(quantity, float):
            cells.append(Cell(*at, dim.unit.written(quantity), styles.INPUT))
            return
        node = self.plan.at.bind(quantity, self.title, None)
        fills.append(Fill(*at, Call("DEGREES", (node,)) if dim.unit.in_degrees else node, styles.INPUT))

    def heads(self) -> list[tuple[str, tuple[Quantity, ...], list[tuple[int, int]]]]:
        """The inputs of the sheet: key of the description, what it gives, and the cells (row, column)."""
        return [("columns", self.request.columns, [(HEAD_ROW, 1 + index) for index in range(self.count)])]

    def hint_words(self) -> str:
        """What may be changed, and where the helpers are."""
        return self.plan.text("table.hint") + (" " + self.plan.text("table.folded") if self.found.helpers else "")

    def value_words(self) -> str:
        """What the cells show, and its unit."""
        return plain(self.request.value) + bracketed(shown_unit(self.plan, self.request.value))

    def rows_words(self) -> str:
        """What goes down, and its unit."""
        driver = self.plan.mechanism.driver.symbol
        return plain(driver) + bracketed(shown_unit(self.plan, driver))

    def _about(self) -> str:
        """`s₁₅ [mm] over θ₁₂ [°] and s₁ [mm] (setting)`."""
        return self.plan.text(
            "table.about", value=self.value_words(), rows=self.labelled_rows(), columns=self.labelled(self.column)
        )

    def labelled_rows(self) -> str:
        """What goes down, with its label where it has one."""
        return self.rows_words()

    def labelled(self, dim: Dimension) -> str:
        """A dimension with its unit and its label."""
        words = plain(dim.symbol) + bracketed(dim.unit.text)
        return words + (f" ({dim.label.of(self.plan.language)})" if dim.label else "")

    def _text_end(self) -> int:
        """The last column of the lines of text: beside a narrow table they run on under the chart's columns."""
        return max(self.count, 9)

    def _columns(self) -> tuple[Column, ...]:
        widths = (Column(0, 0, 13), Column(1, self.count, 11), Column(self.count + 1, self.count + 1, 3))
        return (*widths, Column(self.count + 2, self.helpers_at - 1, 8.5))

    def _chart(self) -> Chart:
        plan = self.plan
        x = SeriesRef(self.title, Area(FIRST, 0, self.last, 0))
        series = tuple(
            Series(
                CellRef(NAME_ROW, col, True, True, self.title),
                x,
                SeriesRef(self.title, Area(FIRST, col, self.last, col)),
                line=styles.SERIES[(col - 1) % len(styles.SERIES)],
                dash=styles.dash_of_curve(col - 1),
            )
            for col in range(1, 1 + self.count)
        )
        title = self.request.title.of(plan.language) if self.request.title else self._about()
        return Chart(
            title,
            Anchor(CORNER_ROW, self.count + 2, WIDTH, HEIGHT),
            series,
            self.x_axis(),
            Axis(self.value_words()),
            legend="right",
            name=f"table {quote_sheet(self.title)}",
            alt_text=title,
        )

    def x_axis(self) -> Axis:
        """The chart's axis of what goes down."""
        return driver_axis(self.plan, self.plan.mechanism.driver.symbol)


def bracketed(unit: str) -> str:
    """A unit behind a symbol; nothing where there is none."""
    return f" [{unit}]" if unit else ""

"""Rows between the rows: the formulas of the table of positions at other values of the driver.

A block of probes is an anchor row, which stands for a row of the table, and some probe rows below it. A probe's driver value
is a formula over what is known before it; its other cells hold what the table's columns hold. An angle without jumps is
taken within half a turn of what the anchor has. Values of the driver are counted in rows: 1 is the first row of the table,
2.5 lies halfway between the second and the third.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass, replace

from livesheet.formula.nodes import CellRef, Node, Previous, RangeRef, Symbol, transform
from livesheet.workbook import Cell, Content, Fill, Style
from mechsheet.model import TIME
from mechsheet.sheet import styles
from mechsheet.sheet.driving import by_time, driver_at, time_after
from mechsheet.sheet.plan import DRIVER, Plan
from mechsheet.sheet.quoted import ALL, formula
from mechsheet.sheet.table.positions import cell_formula, style_of

ALL_ROWS = Symbol("#all_rows")
"""How many rows the table has, on the sheet of probes: there it is read most."""

AT, VALUE, SIDE = range(3)
"""Columns of a block beside the table's: where the row lies (counted in rows), the quantity there, then working cells."""


@dataclass(frozen=True, slots=True)
class Block:
    """Where a block stands: its anchor's row on the sheet, and the number of probes below."""

    row: int
    probes: int


class Probes:
    """The cells of a sheet of probes. Its first columns are those of the table of positions."""

    def __init__(self, plan: Plan, title: str) -> None:
        self.plan = plan
        self.title = title
        self.columns = [*plan.columns]
        for column in (*plan.rates, *plan.forces, *plan.bands):  # behind those of the positions
            self.columns.append(replace(column, col=len(self.columns)))
        spots = {
            column.symbol: replace(plan.at.spots[column.symbol], sheet=plan.table, col=column.col)
            for column in self.columns[len(plan.columns) :]
        }
        self.at = replace(plan.at, spots=plan.at.spots | spots)
        self.side = len(self.columns) + 1
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self._reads = {equation.symbol: equation.reads for equation in plan.equations.columns}

    # --- places -----------------------------------------------------------------------------------------------

    def cell(self, row: int, work: int) -> CellRef:
        """A cell beside the table's columns."""
        return CellRef(row, self.side + work, True, True)

    def cells_down(self, row: int, work: int, count: int) -> RangeRef:
        """Cells below each other."""
        return RangeRef(self.cell(row, work), self.cell(row + count - 1, work))

    def cells_across(self, row: int, work: int, count: int) -> RangeRef:
        """Cells beside each other."""
        return RangeRef(self.cell(row, work), self.cell(row, work + count - 1))

    def put(self, row: int, col: int, content: Content, style: Style) -> None:
        """A constant."""
        self.cells.append(Cell(row, col, content, style))

    def work(
        self, row: int, work: int, text: str, style: Style = styles.INNER, /, **holes: Node | float | str
    ) -> CellRef:
        """A formula beside the table's columns; its cell."""
        node = self.plan.at.bind(formula(text, **holes), self.title)
        self.fills.append(Fill(row, self.side + work, node, style))
        return self.cell(row, work)

    def alike(self, blocks: Sequence[Block]) -> list[Fill]:
        """All formulas, those of blocks as if each block were a copy of one: they read cells of their own block as those
        so many rows above or below."""
        starts = sorted(block.row for block in blocks)

        def block_of(row: int) -> int:
            return bisect_right(starts, row)

        def within(fill: Fill) -> Fill:
            own = block_of(fill.row)
            if not own or fill.rows > 1:
                return fill

            def change(part: Node) -> Node:
                if isinstance(part, CellRef) and part.row_abs and part.sheet is None and block_of(part.row) == own:
                    return replace(part, row_abs=False)
                return part

            return replace(fill, formula=transform(fill.formula, change))

        return [within(fill) for fill in self.fills]

    # --- rows -------------------------------------------------------------------------------------------------

    def needed(self, symbols: Iterable[str]) -> frozenset[str]:
        """The columns that quantities are computed from, and they themselves."""
        found: set[str] = set()
        stack = list(symbols)
        while stack:
            name = stack.pop()
            if name in self._reads and name not in found:
                found.add(name)
                stack += self._reads[name]
        return frozenset(found)

    def lay(self, block: Block, wanted: Collection[str]) -> None:
        """The anchor and the probes of a block, with the columns that quantities need. `AT` is filled by whoever knows
        it."""
        plan, first = self.plan, block.row + 1
        anchor = self.cell(block.row, AT)
        at = CellRef(first, self.side + AT, col_abs=True)
        law, style = plan.mechanism.driver.law, styles.decimals(styles.COLUMN, 4)
        driver = driver_at(plan, at) if law is None else by_time(law, Symbol(TIME))
        if law is not None:
            time = plan.at.bind(time_after(law, formula("at-1", at=at)), self.title)
            self.fills.append(Fill(first, self.at.spots[TIME].col, time, style, rows=block.probes))
        # columns of the same letters, on this sheet
        self.fills.append(Fill(first, DRIVER, plan.at.bind(driver, plan.table, first), style, rows=block.probes))
        columns = self.needed(wanted)
        for column in self.columns:
            if column.symbol not in columns or column.equation is None:
                continue
            style = styles.numbered(styles.INNER, style_of(plan, column).number_format)
            expression = transform(column.equation.expression, lambda part: self._above(part, block.row))
            # columns of the same letters, on this sheet
            value = cell_formula(plan, self.at, column, expression, plan.table, first)
            self.fills.append(Fill(first, column.col, value, style, rows=block.probes))
            if column.equation.first is not None:  # the next rows are taken near it
                whole = Symbol(ALL + column.symbol)
                known = plan.at.bind(formula("INDEX(whole,anchor)", whole=whole, anchor=anchor), self.title)
                self.fills.append(Fill(block.row, column.col, known, style))

    def _above(self, part: Node, anchor: int) -> Node:
        """The anchor's cell in place of the row above."""
        if isinstance(part, Previous):
            return CellRef(anchor, self.at.spots[part.name].col, True)
        return part

"""The sheet of tolerances: in the rows of the positions derivatives by dimensions, worst case, root sum of squares.

Below the table, in the columns of its quantity, a line for the position shown, one for the row with the largest band and
one for each summary: the derivatives there, what they come to, and the share of each dimension, (S t)^2 of the sum of
squares. An extreme changes with a dimension as the quantity does where the extreme is: that its place moves adds nothing
to first order.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal

from livesheet.formula import algebra as al
from livesheet.formula.nodes import CellRef, Node, RangeRef, Symbol
from livesheet.workbook import Cell, Fill, Sheet, Style
from mechsheet.model import WAYS, Summary, Way
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.columns.bands import QUANTITIES, ROOT, WORST, part_of
from mechsheet.sheet.over_rows import END_ROWS, MOST, mean_of_rows, over_rows
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import RATES_DRIVER, RATES_STATUS, Plan
from mechsheet.sheet.quoted import ALL, formula
from mechsheet.sheet.shown import rich
from mechsheet.sheet.table.positions import style_of
from mechsheet.sheet.table.rates import sheet_beside
from mechsheet.words.symbols import plain

GAP = 2
"""Empty rows below the table; the dimensions' names stand in the second."""


@dataclass(frozen=True, slots=True)
class Line:
    """A line below the table; the shares stand in the row below it.

    kind  of a summary, of the row of the position shown, or of the row with the largest band
    """

    quantity: str
    row: int
    kind: Literal["summary", "shown", "largest"]
    summary: Summary | None = None

    @property
    def key(self) -> str:
        """What the line is of, in the block of the first sheet."""
        return self.summary.symbol if self.summary else self.quantity

    def spot(self, plan: Plan, part: str) -> Spot:
        """Where its worst case or root sum of squares stands."""
        return Spot(plan.at.titles["tolerance"], self.row, plan.at.spots[part_of(self.quantity, part)].col)


def lines_of(plan: Plan) -> list[Line]:
    """Those of all quantities, in the same rows; then those of the summaries."""
    bands = plan.mechanism.bands
    if bands is None:
        return []
    row = plan.at.last + GAP + 1
    found = [shown_line(plan, quantity) for quantity in bands.quantities]
    row += 2
    found += [Line(quantity, row, "largest") for quantity in bands.quantities]
    for summary in plan.mechanism.summaries:
        if summary.symbol in bands.summaries:
            row += 2
            found.append(Line(summary.of, row, "summary", summary))
    return found


def shown_line(plan: Plan, quantity: str) -> Line:
    """The line of a quantity at the position shown."""
    return Line(quantity, plan.at.last + GAP + 1, "shown")


class Tolerance:
    """The sheet, planned before any formula that reads it is written."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.lines = lines_of(plan)
        self.title = plan.at.titles.get("tolerance", "")

    def _col(self, symbol: str) -> int:
        return self.plan.at.spots[symbol].col

    def shares(self, line: Line) -> tuple[RangeRef, RangeRef]:
        """The shares of a line, and the names of their dimensions, as another sheet reads them."""
        cols = [self._col(name) for name in self.plan.banded[line.quantity].derivatives]
        rows = (line.row + 1, self.plan.at.last + GAP)
        shares, names = (
            RangeRef(CellRef(row, cols[0], True, True, self.title), CellRef(row, cols[-1], True, True, self.title))
            for row in rows
        )
        return shares, names

    def sheet(self) -> Sheet:
        """The finished sheet."""
        plan = self.plan

        def titled(number: int) -> str:
            if number < QUANTITIES:
                return plan.text("bands.groups")
            quantity = plan.sensitivities.of[number - QUANTITIES].quantity
            return plan.text("bands.of", symbol=plain(quantity))

        made = sheet_beside(plan, "tolerance", plan.bands, self._status(), "0E7490", titled)
        cells: list[Cell] = []
        fills: list[Fill] = []
        for band in plan.banded.values():
            for name, symbol in zip(band.dimensions, band.derivatives, strict=True):
                cells.append(Cell(plan.at.last + GAP, self._col(symbol), plain(name), styles.HEAD))
        for line in self.lines:
            if line.summary is not None or line.quantity == self.lines[0].quantity:  # others stand in the same rows
                cells += self._words(line)
            fills += self._line(line)
        return replace(made, cells=made.cells + tuple(cells), fills=made.fills + tuple(fills))

    def _status(self) -> Node:
        """What the positions say; where they exist whether some group is at a dead centre."""
        own = [column.symbol for column in self.plan.bands if column.group < QUANTITIES]
        said = (self.plan.places.rates or self.plan.places.status).in_row(self.plan.at.first)
        if not own:
            return said
        all_there = formula("ISNUMBER(all)", all=al.total(Symbol(name) for name in own))
        return formula(
            "IF(said=ok,IF(there,ok,dead),said)", said=self.plan.places.status.in_row(self.plan.at.first),
            ok=self.plan.text("status.ok"), there=all_there, dead=self.plan.text("bands.dead"),
        )  # fmt: skip

    def _words(self, line: Line) -> list[Cell]:
        plan, summary = self.plan, line.summary
        said = plan.text(f"bands.{line.kind}") if summary is None else rich(summary.symbol)
        return [
            Cell(line.row, RATES_DRIVER, said, styles.LABEL),
            Cell(line.row, RATES_STATUS, plan.text("bands.derivative"), styles.STATUS),
            Cell(line.row + 1, RATES_STATUS, plan.text("bands.share"), styles.STATUS),
        ]

    def _line(self, line: Line) -> list[Fill]:
        """The derivatives, what they come to by the same formulas as in the table, and the shares."""
        plan, band = self.plan, self.plan.banded[line.quantity]
        found = []
        for symbol in band.derivatives:
            value = plan.at.bind(self._derivative(line, symbol), self.title)
            found.append(Fill(line.row, self._col(symbol), value, self._style(symbol)))
        root = part_of(line.quantity, ROOT)
        for symbol in (part_of(line.quantity, WORST), root):
            value = plan.at.bind(plan.equations.of(symbol).expression, self.title, line.row)
            found.append(Fill(line.row, self._col(symbol), value, self._style(symbol)))
        for symbol, part in zip(band.derivatives, band.parts, strict=True):
            share = formula("(part/root)^2", part=part, root=Symbol(root))
            value = plan.at.bind(share, self.title, line.row)
            found.append(Fill(line.row + 1, self._col(symbol), value, styles.numbered(styles.RESULT, "0 %")))
        return found

    def _style(self, symbol: str) -> Style:
        column = next(column for column in self.plan.bands if column.symbol == symbol)
        return styles.numbered(styles.RESULT, style_of(self.plan, column).number_format)

    def _derivative(self, line: Line, symbol: str) -> Node:
        """Of a summary, in the position shown, or in the row with the largest band."""
        column, summary = Symbol(ALL + symbol), line.summary
        if line.kind == "shown":
            return formula("INDEX(column,position+1)", column=column, position=there(self.plan.places.position).cell)
        if summary is None:
            worst = Symbol(ALL + part_of(line.quantity, WORST))
            return formula("INDEX(column,MATCH(most,worst,0))", column=column, worst=worst, most=over_rows(MOST, worst))
        return summary.take.over(lambda part: self._of_part(part, line.quantity, symbol))

    def _of_part(self, part: str, quantity: str, symbol: str) -> Node:
        """The derivative where a part of the quantity's motion is; the mean of derivatives is that of the mean."""
        if part in WAYS:
            return self._of_extreme(quantity, WAYS[part], symbol)
        if part == "mean":
            return mean_of_rows(self.plan, symbol, self.title)
        return formula("INDEX(column,row)", column=Symbol(ALL + symbol), row=END_ROWS[part](self.plan))

    def _of_extreme(self, quantity: str, way: Way, symbol: str) -> Node:
        """Where the quantity is smallest or largest: by a probe, or in the row where nothing is known between rows."""
        searched = self.plan.searched
        if (way, symbol) in searched.derivatives:
            return searched.derivatives[way, symbol].cell
        drivers = Symbol(ALL + self.plan.mechanism.driver.symbol)
        return formula("INDEX(column,MATCH(at,drivers,0))", column=Symbol(ALL + symbol), drivers=drivers,
                       at=searched.extremes[way, quantity].occurs.cell)  # fmt: skip

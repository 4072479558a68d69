"""What a finding reads where it is written: cells of other findings, and the motion's numbers as the layout has them."""

from __future__ import annotations

from livesheet.formula.nodes import CellRef, Node, RangeRef, Symbol, Text
from mechsheet.model import Way
from mechsheet.sheet.checks.checks import Checks
from mechsheet.sheet.checks.extremes import Extremes, about
from mechsheet.sheet.deleted import are_there
from mechsheet.sheet.plan import MEANING, TOLERANCE, VALUE, Plan
from mechsheet.sheet.quoted import ALL, formula, joined
from mechsheet.sheet.table.positions import places
from mechsheet.units import behind_number

NUMBERS = ">-1E+300"
"""What every number is: a column that has none in some row is asked for its numbers only."""


class Reading:
    """The first sheet, with a search and checks beside the rows.

    rows  of the lines, by key
    """

    def __init__(self, plan: Plan, checks: Checks, extremes: Extremes) -> None:
        self.plan, self.found = plan, plan.searched
        self.checks, self.extremes = checks, extremes
        self.rows = plan.blocks["verdicts"].rows
        self.driver = plan.mechanism.driver
        self.unit = behind_number(self.driver.unit.text)

    def while_there(self, sheet: str, words: Node, otherwise: Node) -> Node:
        """Words where a sheet that can be deleted is there, with what it needs; else others."""
        present = are_there(self.plan, [sheet])
        return (
            words
            if present is None
            else formula("IF(present,words,otherwise)", present=present, words=words, otherwise=otherwise)
        )

    # --- words ------------------------------------------------------------------------------------------------

    def text(self, key: str, **parts: object) -> str:
        """A word of the workbook."""
        return self.plan.text(f"verdict.{key}", **parts)

    def where_it_closes(self, words: Node | str) -> Node:
        """Words about rows: nothing where no row closes."""
        return formula('IF(closed=0,"",words)', closed=self.value("rows_closed"), words=words)

    def driver_text(self, value: Node) -> Node:
        """A value of the driver in words: 48.3°."""
        return joined(formula("ROUND(value,2)", value=value), self.unit)

    def about(self, symbol: str) -> Node:
        """What is added where the probes of an extreme have not settled, or the rows are too far apart."""
        return formula(
            "IF(leaps>0,about,more)",
            leaps=self.plan.places.leaps.cell,
            about=self.text("about"),
            more=about(self.plan, symbol),
        )

    # --- extremes ---------------------------------------------------------------------------------------------

    def extreme(self, way: Way, symbol: str) -> tuple[Node, Node]:
        """The smallest or the largest value, in internal units, and where it occurs: between rows where it is searched."""
        found = self.found.extremes.get((way, symbol))
        if found is not None:
            value: Node = found.value.cell
            place: Node = found.occurs.cell
        else:
            column = Symbol(ALL + symbol)
            value = formula(f'{way.upper()}IFS(all,all,"{NUMBERS}")', all=column)
            place = self.driver_in_row("MATCH(value,all,0)", value=value, all=column)
        return (formula("RADIANS(value)", value=value) if self.plan.at.spots[symbol].degrees else value), place

    def doubt(self, symbol: str, *ways: Way) -> Node:
        """What is added where an extreme is to be doubted."""
        return about(self.plan, symbol, ways) if symbol in self.plan.found.extremes else Text("")

    # --- cells of findings ------------------------------------------------------------------------------------

    def value(self, key: str) -> CellRef:
        """The cell of a line's value."""
        return CellRef(self.rows[key], VALUE, True, True)

    def words(self, key: str) -> CellRef:
        """The cell of a line's words."""
        return CellRef(self.rows[key], MEANING, True, True)

    def place(self, key: str) -> CellRef:
        """The cell that says where it occurs."""
        return CellRef(self.rows[key], TOLERANCE, True, True)

    # --- the table --------------------------------------------------------------------------------------------

    @property
    def of_rows(self) -> Node:
        """The cell with the number of rows of the table."""
        return self.plan.places.rows.cell

    @property
    def drivers(self) -> RangeRef:
        """The driver's values."""
        return self.plan.at.column(self.driver.symbol, self.plan.main)

    def driver_in_row(self, row: str, **holes: Node) -> Node:
        """The driver's value in the row that a formula finds."""
        return formula(f'IFERROR(INDEX(drivers,{row}),"")', drivers=Symbol(ALL + self.driver.symbol), **holes)

    def driver_places(self) -> int:
        """Decimals of a value of the driver."""
        return places(self.plan, "angle" if self.driver.unit.kind == "angle" else "length")

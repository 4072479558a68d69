"""What findings and summaries read on a page: the rows of the table, and nothing between them."""

from __future__ import annotations

from collections.abc import Sequence

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, RangeRef, Symbol, Text, symbols
from mechsheet.model import Way
from mechsheet.sheet.checks.checks import Checks
from mechsheet.sheet.classification import FourBar
from mechsheet.sheet.findings.reading import ALIKE, Folded, Reading
from mechsheet.sheet.grashof import Sides, turns_up_to
from mechsheet.sheet.inputs import rest_fits
from mechsheet.sheet.over_rows import LEAST, MOST, NUMBERS, over_rows, row_of_size
from mechsheet.sheet.page.plan import PagePlan, sides_of
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.table.positions import decimals_of_kind

MEANING = 3
"""The column of what a line says, the first of three."""


class PageReading(Reading):
    """A page."""

    meaning = MEANING

    def __init__(self, plan: PagePlan) -> None:
        super().__init__(plan)
        self.page = plan
        keyed = {finding.key: finding.key_beside(plan) for finding in plan.findings}
        self._beside = {key: self.value(beside) for key, beside in keyed.items() if beside}

    @property
    def marks(self) -> int:
        return self.page.marks

    @property
    def checks(self) -> Checks:
        raise ValueError("a page has no sheet of checks")

    def beside(self, finding: str, found: Node) -> Node:
        return self._beside.get(finding, found)

    # --- the table --------------------------------------------------------------------------------------------

    def column(self, symbol: str) -> RangeRef:
        """The cells of a column, and those below that a person may fill."""
        return self.page.filled(self.plan.at.spots[symbol])

    def over_rows(self, symbol: str, function: str) -> Node:
        """Over a column, as people read it, in rows in which every group closes."""
        return over_rows(function, self.column(symbol), *self.closing(symbol))

    def closing(self, symbol: str) -> list[RangeRef]:
        """The column that says nothing where all groups close, for a column that has numbers where some do not."""
        page = self.page.page
        by_symbol = {each.symbol: each for each in page.columns}
        read, waiting = {symbol}, [symbol]
        while waiting:
            name = waiting.pop()
            reads = by_symbol[name].reads if name in by_symbol else ()
            reads = symbols(page.plain[name]) if name in page.plain else reads
            waiting += [each for each in reads if each not in read]
            read.update(reads)
        others = any(name and name not in read for name in page.closes.values())
        return [self.page.filled(self.plan.places.status)] if others else []

    @property
    def drivers(self) -> RangeRef:
        return self.column(self.driver.symbol)

    def count_rows(self) -> tuple[Node, Node]:
        filled, said = self.drivers, self.page.filled(self.plan.places.status)
        closed = formula('COUNTIFS(filled,numbers,said,"")', filled=filled, numbers=NUMBERS, said=said)
        return closed, Call("COUNT", (filled,))

    def rows_torn(self) -> Node | None:
        # a row whose group closes has the angle that leads to it, unless it goes on from a row that was deleted
        for column in self.page.columns:
            equation = column.equation
            closes = (
                self.page.page.closes.get(equation.group) if equation is not None and equation.first is not None else ""
            )
            if closes:
                angles, closing = self.column(column.symbol), self.column(closes)
                return formula("COUNT(closing)-COUNTIFS(closing,numbers,angles,numbers)", closing=closing, angles=angles,
                               numbers=NUMBERS)  # fmt: skip
        return None

    def stretches(self) -> Node | None:
        return None

    def inputs_fit(self) -> tuple[Node, Node | None]:
        position, rows = self.plan.places.position, self.plan.places.rows.cell
        known = Call("AND", tuple(tests)) if (tests := rest_fits(self.plan, self.plan.main)) else None
        if position is None:
            return formula("TRUE"), known
        there = formula("AND(ISNUMBER(shown),INT(N(shown))=shown,shown>=0,shown<rows)", shown=position.cell, rows=rows)
        return there, known

    def sides(self, loop: FourBar, names: Sequence[str]) -> Sides:
        lengths = tuple(self._length(key, tree) for key, tree in sides_of(self.page, loop))
        turns, shortest = turns_up_to(lengths), Call("MIN", lengths)
        return Sides(lengths, lengths, names, decimals_of_kind(self.plan, "length"), turns, shortest)

    def _length(self, key: str, length: Node) -> Node:
        """A length without the bars that its sign does not need; one that is no dimension has a cell."""
        match length:
            case Call("ABS", (Symbol(name),)) if name in self.plan.equations.positive:
                return length.args[0]
        lengths = self.plan.places.lengths
        return lengths[key].cell if key in lengths else length

    # --- quantities -------------------------------------------------------------------------------------------

    @property
    def of_rows_only(self) -> Node | bool:
        return True

    def column_extreme(self, way: Way, symbol: str) -> Node:
        return self.over_rows(symbol, LEAST if way == "min" else MOST)

    def extreme_of_column(self, way: Way, symbol: str) -> tuple[Node, Node]:
        value = self.column_extreme(way, symbol)
        place = formula('IFERROR(INDEX(drivers,MATCH(value,column,0)),"")', drivers=self.drivers, value=value,
                        column=self.column(symbol))  # fmt: skip
        return value, place

    def doubt(self, symbol: str, *ways: Way, unsure: Node) -> Node:
        if symbol in self.plan.found.cam:
            return Text(self.text("rows.only"))
        return super().doubt(symbol, *ways, unsure=unsure)

    def driver_in_row(self, row: Node) -> Node:
        return formula('IFERROR(INDEX(drivers,row),"")', drivers=self.drivers, row=row)

    def occurs_at_least(self, symbol: str, folded: Folded, least: Node) -> Node:
        # what follows rises as the smallest value does and falls as the largest rises, both by as much: solved for them
        low, high = (al.tidied(at_zero) for at_zero in folded(al.ZERO, al.ZERO))
        # compared, not subtracted: a text in a row without an angle would be an error that gnumeric's MATCH hands on
        one, other = (
            formula("SUMPRODUCT(MATCH(1,(column>=angle-alike)*(column<=angle+alike),0))", column=self.column(symbol),
                    angle=angle, alike=ALIKE)
            for angle in (al.sub(least, low), al.sub(high, least))
        )  # fmt: skip
        return formula("INDEX(drivers,IFERROR(one,other))", drivers=self.drivers, one=one, other=other)

    def largest_size(self, finding: str, symbol: str) -> tuple[Node, Node | None]:
        size, place = super().largest_size(finding, symbol)
        if place is not None:
            place = self.driver_in_row(row_of_size(self.column(symbol), self.value(finding)))
        return size, place

    def where_known(self, value: Node) -> Node:
        return formula("IF(n=0,NA(),IFERROR(value,NA()))", n=self.plan.places.closed.cell, value=value)

    def about(self, symbol: str) -> Node:
        return Text(self.text("rows.only"))

    def worst_group(self, values: RangeRef) -> Node:
        return formula("MATCH(MIN(values),values,0)", values=values)

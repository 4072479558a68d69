"""What a finding reads where it is written: cells of other findings, and the motion's numbers as the layout has them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Sequence
from dataclasses import replace

from livesheet.formula.nodes import CellRef, Node, RangeRef, Symbol, Text
from mechsheet.model import Way
from mechsheet.sheet.checks.checks import Checks
from mechsheet.sheet.checks.extremes import BOUND, SHORTEST, WHICH, Extremes, about
from mechsheet.sheet.classification import FourBar
from mechsheet.sheet.deleted import are_there, missing_words
from mechsheet.sheet.grashof import Sides
from mechsheet.sheet.over_rows import LEAST, MOST, over_rows
from mechsheet.sheet.places import Searched, there
from mechsheet.sheet.plan import MARGIN, MEANING, SPARE, TOLERANCE, VALUE, Plan
from mechsheet.sheet.quoted import ALL, SHOWN, formula, joined
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.units import behind_number

Folded = Callable[[Node, Node], tuple[Node, Node]]
"""What follows from the smallest and from the largest value of a quantity."""

ALIKE = 1e-6
"""Two angles that differ by no more are one but for rounding, which no two programs and layouts do alike."""


class Reading(ABC):
    """What every layout has. A page has neither a search nor checks: who is said `by_rows` asks for none.

    rows     of the lines, by key;  meaning: the column of their words
    of_rows_only  whether nobody looks between the rows
    """

    meaning: int

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.rows = plan.blocks["verdicts"].rows
        self.driver = plan.mechanism.driver
        self.unit = behind_number(self.driver.unit.text)

    @property
    def found(self) -> Searched:
        """What the search beside the rows finds."""
        return self.plan.searched

    @property
    @abstractmethod
    def marks(self) -> int:
        """The column that marks the inputs that cannot be."""

    @property
    @abstractmethod
    def checks(self) -> Checks:
        """What is measured in every row."""

    def while_there(self, sheet: str, words: Node, otherwise: Node | None = None) -> Node:
        """Words where a sheet that can be deleted is there, with what it needs; else others, or which sheets are missing."""
        present = are_there(self.plan, [sheet])
        if present is None:
            return words
        left = missing_words(self.plan) if otherwise is None else otherwise
        return formula("IF(present,words,otherwise)", present=present, words=words, otherwise=left)

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

    # --- extremes ---------------------------------------------------------------------------------------------

    def extreme(self, way: Way, symbol: str) -> tuple[Node, Node]:
        """The smallest or the largest value, in internal units, and where it occurs: between rows where it is searched."""
        spot = self.plan.at.spots[symbol]
        if not spot.column:  # it is one number
            return Symbol(symbol), Text("")
        value, place = self.extreme_of_column(way, symbol)
        return (formula("RADIANS(value)", value=value) if spot.degrees else value), place

    def extreme_of_column(self, way: Way, symbol: str) -> tuple[Node, Node]:
        """The same of a column, in the units that it shows."""
        found = self.found.extremes.get((way, symbol))
        if found is not None:
            return found.value.cell, found.occurs.cell
        column = Symbol(ALL + symbol)
        value = over_rows(LEAST if way == "min" else MOST, column)
        return value, self.driver_in_row(formula("MATCH(value,all,0)", value=value, all=column))

    def doubt(self, symbol: str, *ways: Way, unsure: Node) -> Node:
        """What is added where an extreme is to be doubted: `unsure` where it is about right although the search has no
        doubt."""
        if symbol in self.plan.found.extremes:
            return about(self.plan, symbol, ways, unsure)
        return formula('IF(unsure,about,"")', unsure=unsure, about=self.text("about"))

    # --- cells of findings ------------------------------------------------------------------------------------

    def value(self, key: str) -> CellRef:
        """The cell of a line's value."""
        return CellRef(self.rows[key], VALUE, True, True)

    def words(self, key: str) -> CellRef:
        """The cell of a line's words."""
        return CellRef(self.rows[key], self.meaning, True, True)

    @abstractmethod
    def beside(self, finding: str, found: Node) -> Node:
        """What stands beside a finding's number: its cell, or what is found, where no cell is beside it."""

    # --- the table --------------------------------------------------------------------------------------------

    @property
    def of_rows(self) -> Node:
        """The cell with the number of rows of the table."""
        return self.plan.places.rows.cell

    @property
    @abstractmethod
    def drivers(self) -> RangeRef:
        """The driver's values."""

    def driver_in_row(self, row: Node) -> Node:
        """The driver's value in the row of that number."""
        return formula('IFERROR(INDEX(drivers,row),"")', drivers=Symbol(ALL + self.driver.symbol), row=row)

    def driver_decimals(self) -> int:
        """Decimals of a value of the driver."""
        return decimals_of_kind(self.plan, "angle" if self.driver.unit.kind == "angle" else "length")

    @abstractmethod
    def count_rows(self) -> tuple[Node, Node]:
        """How many rows close, and how many there are, counted in the table."""

    def rows_below(self) -> Node | None:
        """How many rows below the table somebody has filled of which nothing is said; None where these count, too."""
        return None

    def rows_torn(self) -> Node | None:
        """Above 0 where rows inside the table were deleted, over which angles go on; None where another sheet tells it."""
        return None

    @abstractmethod
    def stretches(self) -> Node | None:
        """In words the stretches in which it closes; None where nobody looks for them."""

    @abstractmethod
    def inputs_fit(self) -> tuple[Node, Node | None]:
        """Whether the position that is drawn is one, and whether what follows from the inputs are numbers; None where
        nobody asks."""

    @abstractmethod
    def sides(self, loop: FourBar, names: Sequence[str]) -> Sides:
        """The lengths of a loop."""

    # --- quantities -------------------------------------------------------------------------------------------

    @property
    @abstractmethod
    def of_rows_only(self) -> Node | bool:
        """Whether nobody has looked between the rows."""

    @abstractmethod
    def column_extreme(self, way: Way, symbol: str) -> Node:
        """The smallest or the largest value of a quantity, as its column has it."""

    @abstractmethod
    def occurs_at_least(self, symbol: str, folded: Folded, least: Node) -> Node:
        """The driver's value where what follows from a quantity is `least`: the smaller of two, of which the first, of the
        quantity's smallest value, is taken where the other, of its largest, is as small."""

    def largest_size(self, finding: str, symbol: str) -> tuple[Node, Node | None]:
        """The largest size of a quantity of either sign, as people read it, which the finding's cell shows; and where it
        occurs, None of one number."""
        if not self.plan.at.spots[symbol].column:
            return formula("ABS(x)", x=Symbol(SHOWN + symbol)), None
        (high, at_high), (low, at_low) = (self.extreme_of_column(way, symbol) for way in ("max", "min"))
        place = formula("IF(ABS(high)>=ABS(low),place,other)", high=high, low=low, place=at_high, other=at_low)
        return formula("MAX(ABS(high),ABS(low))", high=high, low=low), place

    @abstractmethod
    def where_known(self, value: Node) -> Node:
        """A value that follows from extremes; #N/A where there are none."""

    @abstractmethod
    def about(self, symbol: str) -> Node:
        """What is added to words of extremes that are not sure."""

    @abstractmethod
    def worst_group(self, values: RangeRef) -> Node:
        """Which of several angles of transmission is the least."""


class SheetReading(Reading):
    """The first sheet, with a search and checks beside the rows."""

    meaning = MEANING

    def __init__(self, plan: Plan, checks: Checks, extremes: Extremes) -> None:
        super().__init__(plan)
        self._checks, self._extremes = checks, extremes

    @property
    def marks(self) -> int:
        return MARGIN

    @property
    def checks(self) -> Checks:
        return self._checks

    def beside(self, finding: str, found: Node) -> Node:
        return CellRef(self.rows[finding], TOLERANCE, True, True)

    @property
    def drivers(self) -> RangeRef:
        return self.plan.at.column(self.driver.symbol, self.plan.main)

    def count_rows(self) -> tuple[Node, Node]:
        said = self.plan.places.status.whole()
        return formula("COUNTIF(said,ok)", said=said, ok=self.plan.text("status.ok")), formula("ROWS(said)", said=said)

    def rows_below(self) -> Node | None:
        drivers = self.drivers
        first, last = (replace(drivers.end, row=self.plan.at.last + more) for more in (1, SPARE))
        return formula("COUNT(below)", below=RangeRef(replace(first, sheet=drivers.start.sheet), last))

    def stretches(self) -> Node | None:
        stretches = [stretch.words.cell for stretch in self.found.stretches]
        more = formula('IF(stretches>most," …","")', stretches=self.found.count.cell, most=len(stretches))
        return joined(self.text("rows.some"), " ", *stretches, self.unit, more)

    def inputs_fit(self) -> tuple[Node, Node | None]:
        return self.found.there.cell, self.found.fine.cell

    def sides(self, loop: FourBar, names: Sequence[str]) -> Sides:
        lengths = self._extremes.lengths_of(loop)
        cells = [replace(lengths.start, col=lengths.start.col + at) for at in range(4)]
        turns, shortest, which = (self._extremes.of_loop(loop, work) for work in (BOUND, SHORTEST, WHICH))
        return Sides(cells, (lengths,), names, decimals_of_kind(self.plan, "length"), turns, shortest, which)

    @property
    def of_rows_only(self) -> Node | bool:
        return self.plan.between_unseen if self.plan.rows_only else self.found.rows_only.cell

    def column_extreme(self, way: Way, symbol: str) -> Node:
        return self.found.extremes[way, symbol].value.cell

    def occurs_at_least(self, symbol: str, folded: Folded, least: Node) -> Node:
        at_low, at_high = (self.found.extremes[way, symbol].occurs.cell for way in ("min", "max"))
        smallest, _ = folded(*(self.column_extreme(way, symbol) for way in ("min", "max")))
        return formula("IF(smallest<=least+alike,low,high)", smallest=smallest, least=least, alike=ALIKE, low=at_low,
                       high=at_high)  # fmt: skip

    def where_known(self, value: Node) -> Node:
        return formula("IFERROR(value,NA())", value=value)

    def about(self, symbol: str) -> Node:
        more, rows_only = about(self.plan, symbol), self.of_rows_only
        if isinstance(rows_only, bool):
            return more  # nobody looks between the rows, and that is said
        return formula("IF(AND(leaps>0,NOT(rows_only)),about,more)", leaps=self.plan.places.leaps.cell,
                       rows_only=rows_only, about=self.text("about"), more=more)  # fmt: skip

    def worst_group(self, values: RangeRef) -> Node:
        return there(self.found.worst_group).cell

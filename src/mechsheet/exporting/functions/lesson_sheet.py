"""The sheet on which a mechanism is a chain of simpler ones: one column a group, a call that reads the column before."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from livesheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef, Symbol, transform
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
    Style,
)
from mechsheet.exporting.functions.all_functions import in_degrees
from mechsheet.exporting.functions.function_sheet import MOST_ROWS, SMALL, difference
from mechsheet.exporting.functions.lesson import Link
from mechsheet.exporting.functions.routines import Source
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.charts import driver_axis
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.shown import shown_unit
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.units import Unit
from mechsheet.words.catalogue import Phrase, words
from mechsheet.words.symbols import plain

TITLE = Phrase("lesson.title")

TITLE_ROW, ABOUT_ROW, NAME_ROW, UNIT_ROW, DIFFERENCE_ROW, FIRST = 0, 1, 3, 4, 5, 6
WIDTH, HEIGHT = 620, 380


def lesson_sheet(plan: Plan, source: Source, chain: Sequence[Link], names: Mapping[str, str], title: str) -> Sheet:
    """The sheet; `names` of the functions by what the calls of the chain name."""
    return _Lesson(plan, source, chain, names, title).sheet()


class _Lesson:
    """The sheet while it is being written.

    shown  column of what people read of a quantity;  read: column that the calls read, in radians
    """

    def __init__(self, plan: Plan, source: Source, chain: Sequence[Link], names: Mapping[str, str], title: str) -> None:
        self.plan, self.source, self.chain, self.names, self.title = plan, source, chain, names, title
        self.driver = plan.mechanism.driver.symbol
        self.step = math.ceil(plan.rows / MOST_ROWS)
        self.count = math.ceil(plan.rows / self.step)
        degrees = in_degrees(source, self.driver)
        self.read = {symbol: col for col, symbol in enumerate((self.driver, *(link.symbol for link in chain)), degrees)}
        turned = [link.symbol for link in chain if in_degrees(source, link.symbol)]
        behind = degrees + 1 + len(chain)
        self.shown = self.read | {self.driver: 0} | {symbol: behind + at for at, symbol in enumerate(turned)}
        self.width = behind + len(turned)
        self.helpers = self.width + 11
        """Where the row numbers and the differences stand: behind the chart."""

    def sheet(self) -> Sheet:
        """All of it."""
        plan, last = self.plan, FIRST + self.count - 1
        end = max(self.width, 9)
        return Sheet(
            self.title,
            tuple(self._heads()),
            tuple(self._fills()),
            charts=(self._chart(),),
            columns=(
                Column(0, self.width - 1, 12),
                Column(self.helpers, self.helpers + len(self.chain), 10, level=1, hidden=True),
                Column(self.helpers + len(self.chain) + 1, self.helpers + len(self.chain) + 1, 4, collapsed=True),
            ),
            row_heights=((TITLE_ROW, 26.0), (ABOUT_ROW, 30.0)),
            merges=(Merge(Area(ABOUT_ROW, 0, ABOUT_ROW, end)),),
            conditionals=(
                Conditional(
                    Area(FIRST, 0, last, self.width - 1),
                    Call("NOT", (Call("ISNUMBER", (CellRef(FIRST, 0),)),)),
                    styles.MISSING,
                ),
            ),
            freeze=(FIRST, 0),
            gridlines=False,
            tab_color="C8501E",
            print_setup=PrintSetup(footer=plan.footer, area=Area(0, 0, max(last, FIRST + 20), self.helpers - 1)),
        )

    def _heads(self) -> list[Cell]:
        plan, language = self.plan, self.plan.language
        cells = [
            Cell(TITLE_ROW, 0, f"{TITLE.of(language)}: {plan.mechanism.title.of(language)}", styles.TITLE),
            Cell(ABOUT_ROW, 0, words(language, "lesson.about"), styles.NOTE_TEXT),
            Cell(DIFFERENCE_ROW, 0, words(language, "lesson.difference", positions=plan.table), styles.NOTE_CELL),
        ]
        for symbol in self.read:
            for col in dict.fromkeys((self.read[symbol], self.shown[symbol])):
                other = col != self.shown[symbol]
                unit = (
                    self.plan.mechanism.shown(self._unit(symbol)).internal.text if other else shown_unit(plan, symbol)
                )
                cells.append(Cell(NAME_ROW, col, rich(symbol), styles.HEAD))
                cells.append(Cell(UNIT_ROW, col, unit, styles.HEAD))
        return cells

    def _unit(self, symbol: str) -> Unit:
        driver = self.plan.mechanism.driver
        return driver.unit if symbol == driver.symbol else self.source.equations.of(symbol).unit

    def _fills(self) -> list[Fill]:
        plan = self.plan
        number = CellRef(FIRST, self.helpers, col_abs=True)
        heading = CellRef(
            DIFFERENCE_ROW, 0, True, True
        )  # above the table: counting from its first row would be a circle
        every = "" if self.step == 1 else f"{self.step}*"
        before = formula(f"{every}(ROW()-ROW(heading)-1)", heading=heading)
        fills = [
            self._fill(self.helpers, Binary("+", before, Number(1.0)), styles.decimals(styles.INNER, 0)),
            self._fill(0, self._driver(before, number), styles.decimals(styles.HEAD, 2)),
        ]
        if self.read[self.driver]:
            fills.append(self._fill(1, Call("RADIANS", (CellRef(FIRST, 0),)), styles.decimals(styles.INNER, 6)))
        for at, link in enumerate(self.chain, 1):
            read, shown = self.read[link.symbol], self.shown[link.symbol]
            kind = self._unit(link.symbol).kind
            column = styles.decimals(styles.COLUMN, decimals_of_kind(plan, kind))
            inner = styles.decimals(styles.INNER, 6)
            fills.append(self._fill(read, self._bound(link.call), column if read == shown else inner))
            if read != shown:
                fills.append(self._fill(shown, Call("DEGREES", (CellRef(FIRST, read),)), column))
            gap = difference(plan, self.source, link.symbol, CellRef(FIRST, shown), number)
            fills.append(self._fill(self.helpers + at, gap, styles.INNER))
            area = RangeRef(CellRef(FIRST, self.helpers + at), CellRef(FIRST + self.count - 1, self.helpers + at))
            fills.append(Fill(DIFFERENCE_ROW, shown, Call("MAX", (area,)), SMALL))
        return fills

    def _driver(self, before: Node, number: Node) -> Node:
        """The driver in a row: counted from its start as in the table of positions, or read there where it is listed."""
        plan = self.plan
        if not plan.mechanism.driver.stepped:
            return Call("INDEX", (plan.at.column(self.driver, ""), number))
        start, step = (there(spot).cell for spot in (plan.places.start, plan.places.step))
        return Binary("+", start, Binary("*", before, step))

    def _fill(self, col: int, formula: Node, style: Style) -> Fill:
        return Fill(FIRST, col, formula, style, rows=self.count)

    def _bound(self, call: Node) -> Node:
        """A call over cells: the columns of this sheet, the dimensions and modes of the first."""

        def change(part: Node) -> Node:
            match part:
                case Symbol(name) if name in self.read:
                    return CellRef(FIRST, self.read[name], col_abs=True)
                case Symbol(name):
                    return self.plan.at.reference(name, self.title, None)
                case Call(name, args) if name in self.names:
                    return Call(self.names[name], args)
            return part

        return transform(call, change)

    def _chart(self) -> Chart:
        """What people read over the driver: the angles, or the displacements where there are none."""
        plan = self.plan
        angles = [link.symbol for link in self.chain if self._unit(link.symbol).kind == "angle"]
        drawn = angles or [link.symbol for link in self.chain]
        last = FIRST + self.count - 1
        x = SeriesRef(self.title, Area(FIRST, 0, last, 0))
        series = tuple(
            Series(
                plain(symbol),
                x,
                SeriesRef(self.title, Area(FIRST, self.shown[symbol], last, self.shown[symbol])),
                line=styles.SERIES[at % len(styles.SERIES)],
                dash=styles.dash_of_curve(at),
            )
            for at, symbol in enumerate(drawn)
        )
        title = ", ".join(map(plain, drawn)) + f" [{shown_unit(plan, drawn[0])}]"
        return Chart(
            title,
            Anchor(NAME_ROW, self.width + 1, WIDTH, HEIGHT),
            series,
            driver_axis(plan, self.driver),
            Axis(""),
            name="chain",
            alt_text=title,
            smooth=True,
        )

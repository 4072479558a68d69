"""The sheets of a workbook with functions: what each function is, with its values beside the table of positions; and the
chain of simpler mechanisms, one column a group, a call that reads the column before.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from livesheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef, Symbol, Text, transform
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
from mechsheet.exporting.functions.all_functions import TABLE_KEY, Function, in_degrees, variable_key
from mechsheet.exporting.functions.lesson import Link
from mechsheet.exporting.functions.routines import Source
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.charts import driver_axis
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.shown import rich, shown_unit
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.units import Unit
from mechsheet.words.catalogue import Phrase, words
from mechsheet.words.symbols import plain

LIST_TITLE = Phrase("function.list.title")

MOST_ROWS = 37
"""Rows of a table: of a longer sweep every second, third … row."""

SMALL = replace(styles.NOTE_CELL, name="", number_format="0.0E+00", align="right")

TITLE_ROW, ABOUT_ROW, NAME_ROW, UNIT_ROW, DIFFERENCE_ROW, FIRST = 0, 1, 3, 4, 5, 6
"""Rows of both sheets; the table begins in the last."""

SPAN = 5
"""Columns that a function's name takes in the list; its meaning takes the following ones."""


def _rows_shown(plan: Plan) -> tuple[int, int]:
    """Every so many-th row of the sweep, and how many of them."""
    step = math.ceil(plan.rows / MOST_ROWS)
    return step, math.ceil(plan.rows / step)


def functions_sheet(
    plan: Plan,
    source: Source,
    functions: Sequence[Function],
    names: Mapping[str, str],
    calls: Mapping[str, Callable[[Node], Node]],
    title: str,
) -> Sheet:
    """The list of functions, each called over the sweep; `calls` make the formula of a call, from the cell of the driver."""
    language = plan.language
    cells = [Cell(TITLE_ROW, 0, LIST_TITLE.of(language), styles.TITLE)]
    cells.append(Cell(ABOUT_ROW, 0, words(language, "function.list.about", positions=plan.table), styles.NOTE_TEXT))
    end = 2 * SPAN + 2
    merges = [Merge(Area(ABOUT_ROW, 0, ABOUT_ROW, end)), Merge(Area(DIFFERENCE_ROW, 0, DIFFERENCE_ROW, 1))]
    shown = [function for function in functions if function.key != TABLE_KEY and not function.basic]
    step, count = _rows_shown(plan)
    behind = max(end, 1 + len(shown)) + 2
    cells += _heads(plan, shown, behind)
    fills = _table(plan, source, shown, calls, (step, count), behind)
    area = Area(FIRST, 2, FIRST + count - 1, 1 + len(shown))
    row = FIRST + count + 1
    for col, head in ((0, "function"), (SPAN, "meaning")):
        cells.append(Cell(row, col, words(language, f"function.list.{head}"), styles.SECTION))
    cells += [Cell(row, col, None, styles.SECTION) for col in range(end + 1) if col not in (0, SPAN)]
    for function in functions:
        row += 1
        signature = f"{names[function.key]}({'; '.join(function.parameters)})"
        cells.append(Cell(row, 0, signature, styles.NOTE_CELL))
        cells.append(Cell(row, SPAN, function.routine.about.of(language), styles.NOTE_CELL))
        merges += [Merge(Area(row, 0, row, SPAN - 1)), Merge(Area(row, SPAN, row, end))]
    return Sheet(
        title,
        tuple(cells),
        tuple(fills),
        columns=(
            Column(0, 0, 8),
            Column(1, 1, 10),
            Column(2, behind - 1, 13),
            Column(behind, behind + len(shown) - 1, 13, level=1),
        ),
        row_heights=((TITLE_ROW, 26.0), (ABOUT_ROW, 30.0)),
        merges=tuple(merges),
        conditionals=(Conditional(area, Call("ISNA", (CellRef(FIRST, 2),)), styles.MISSING),),
        freeze=(FIRST, 2),
        gridlines=False,
        tab_color="C8501E",
        print_setup=PrintSetup(footer=plan.footer, area=Area(0, 0, row, behind - 1)),
    )


def _heads(plan: Plan, shown: Sequence[Function], behind: int) -> list[Cell]:
    driver = plan.mechanism.driver.symbol
    cells = [
        Cell(NAME_ROW, 0, words(plan.language, "function.list.row"), styles.HEAD),
        Cell(NAME_ROW, 1, rich(driver), styles.HEAD),
        Cell(UNIT_ROW, 0, None, styles.HEAD),
        Cell(UNIT_ROW, 1, shown_unit(plan, driver), styles.HEAD),
        Cell(DIFFERENCE_ROW, 0, words(plan.language, "function.list.difference"), styles.NOTE_CELL),
        Cell(DIFFERENCE_ROW, 1, None, styles.NOTE_CELL),
    ]
    for col, function in enumerate(shown, 2):
        symbol = _symbol(function)
        for first in (col, behind + col - 2):
            cells.append(Cell(NAME_ROW, first, rich(symbol), styles.HEAD))
            cells.append(Cell(UNIT_ROW, first, shown_unit(plan, symbol), styles.HEAD))
    cells.append(
        Cell(
            NAME_ROW - 1,
            behind,
            words(plan.language, "function.list.differences", positions=plan.table),
            styles.NOTE_TEXT,
        )
    )
    return cells


def _symbol(function: Function) -> str:
    return function.key.removeprefix(variable_key(""))


def _table(
    plan: Plan,
    source: Source,
    shown: Sequence[Function],
    calls: Mapping[str, Callable[[Node], Node]],
    rows_shown: tuple[int, int],
    behind: int,
) -> list[Fill]:
    """The driver read from the table of positions, the functions called, and behind them the differences.

    rows_shown  every so many-th row of the sweep, and how many of them
    """
    step, count = rows_shown
    number = CellRef(FIRST, 0, col_abs=True)
    driver = CellRef(FIRST, 1, col_abs=True)
    read = Call("INDEX", (plan.at.column(plan.mechanism.driver.symbol, ""), number))
    rows = Binary("+", Binary("*", Binary("-", Call("ROW"), Number(FIRST + 1.0)), Number(float(step))), Number(1.0))
    fills = [
        Fill(FIRST, 0, rows, styles.decimals(styles.HEAD, 0), rows=count),
        Fill(FIRST, 1, read, styles.decimals(styles.HEAD, 2), rows=count),
    ]
    for col, function in enumerate(shown, 2):
        symbol = _symbol(function)
        angle = in_degrees(source, symbol)
        value = calls[function.key](driver)
        value = Call("DEGREES", (value,)) if angle else value
        style = styles.decimals(styles.COLUMN, decimals_of_kind(plan, function.routine.unit.kind))
        fills.append(Fill(FIRST, col, value, style, rows=count))
        checked = _difference(plan, source, symbol, CellRef(FIRST, col), number)
        at = behind + col - 2
        fills.append(Fill(FIRST, at, checked, styles.INNER, rows=count))
        fills.append(_largest(col, at, count))
    return fills


def _largest(col: int, differences: int, count: int) -> Fill:
    """Over a column the largest of its differences, which stand in another one."""
    area = RangeRef(CellRef(FIRST, differences), CellRef(FIRST + count - 1, differences))
    return Fill(DIFFERENCE_ROW, col, Call("MAX", (area,)), SMALL)


def _difference(plan: Plan, source: Source, symbol: str, found: Node, number: Node) -> Node:
    """How far a value, as people read it, is from that of the table of positions in the row of that number, turns aside."""
    wanted = Call("INDEX", (plan.at.column(symbol, ""), number))
    gap: Node = Binary("-", found, wanted)
    if source.equations.of(symbol).unit.kind == "angle":
        turn = Number(360.0) if in_degrees(source, symbol) else Binary("*", Number(2.0), Call("PI"))
        gap = Binary("-", gap, Binary("*", turn, Call("ROUND", (Binary("/", gap, turn), Number(0.0)))))
    both = Call("ISNUMBER", (Binary("+", found, wanted),))
    alike = Binary("=", Call("ISNUMBER", (found,)), Call("ISNUMBER", (wanted,)))
    # a function has no value where any group comes apart; the table goes on with what does not depend on it
    apart = Binary("<>", Call("INDEX", (plan.places.status.whole(), number)), Text(plan.text("status.ok")))
    fine = Call("OR", (apart, alike))
    return Call("IF", (both, Call("ABS", (gap,)), Call("IF", (fine, Number(0.0), Call("NA")))))


LESSON_TITLE = Phrase("lesson.title")

WIDTH, HEIGHT = 620, 380


def lesson_sheet(plan: Plan, source: Source, chain: Sequence[Link], names: Mapping[str, str], title: str) -> Sheet:
    """The chain, one column a group; `names` of the functions by what the calls of the chain name."""
    return _Lesson(plan, source, chain, names, title).sheet()


class _Lesson:
    """The sheet of the chain while it is being written.

    shown  column of what people read of a quantity;  read: column that the calls read, in radians
    """

    def __init__(self, plan: Plan, source: Source, chain: Sequence[Link], names: Mapping[str, str], title: str) -> None:
        self.plan, self.source, self.chain, self.names, self.title = plan, source, chain, names, title
        self.driver = plan.mechanism.driver.symbol
        self.step, self.count = _rows_shown(plan)
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
            Cell(TITLE_ROW, 0, f"{LESSON_TITLE.of(language)}: {plan.mechanism.title.of(language)}", styles.TITLE),
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
            gap = _difference(plan, self.source, link.symbol, CellRef(FIRST, shown), number)
            fills.append(self._fill(self.helpers + at, gap, styles.INNER))
            fills.append(_largest(shown, self.helpers + at, self.count))
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

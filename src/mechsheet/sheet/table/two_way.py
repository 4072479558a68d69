"""The two-way tables: the driver down, a dimension across, one formula with mixed anchors filled both ways.

The first column reads the driver's values from the table of positions (`$A8`), the head row holds the values of the
dimension as inputs (`B$7`). Every cell is on its own, but for angles, whose turns the table of positions counts from row
to row: they stand in blocks of their own beside the table, each within half a turn of the cell above it, so that no column
jumps; and all columns start within half a turn of the angle in the table of positions.
"""

from __future__ import annotations

from collections.abc import Mapping

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Call, CellRef, Node, Symbol
from mechsheet.formula.printer import quote_sheet
from mechsheet.kinematics.angle_branch import WINDOWED, AngleBranch, branches_of, reading_taken, taken_near
from mechsheet.kinematics.newton.refusing import need_closed_form
from mechsheet.model import Dimension, TableRequest
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.charts import driver_axis
from mechsheet.sheet.first.blocks import input_validation, shown_unit
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.table.expansion import Expansion, definitions, expand, needed, varying
from mechsheet.sheet.table.positions import places
from mechsheet.sheet.workbook import (
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
from mechsheet.units import ANGLE, Unit

TITLE_ROW, ABOUT_ROW, HINT_ROW, _, CORNER_ROW, NAME_ROW, HEAD_ROW, FIRST = range(8)
"""Rows of the sheet: the head is row 7, the first values stand in row 8."""

WIDTH, HEIGHT = 620, 400
CHART_COLUMNS, CHART_ROWS = 11, 24
"""What the chart covers; helper blocks stand to the right of it."""

ABOVE, START, FIRST_DRIVER = "{symbol} above", "{symbol} start", "first driver"
"""Symbols of an angle's block of its own: the cell above, the one above the first row; and of the driver's first value."""

CELL = "a cell of the table"
"""The symbol of what a cell shows."""


def table_sheets(plan: Plan) -> tuple[Sheet, ...]:
    """One sheet for each table that the description asks for."""
    taken = {title.casefold() for title in plan.at.titles.values()}
    if plan.mechanism.tables:
        need_closed_form(plan.equations.equations, "a two-way table cannot hold this", "tables", "leave the table out")
    sheets = []
    for request in plan.mechanism.tables:
        title = _sheet_title(plan, request, taken)
        taken.add(title.casefold())
        sheets.append(_Table(plan, request, title).sheet())
    return tuple(sheets)


def _sheet_title(plan: Plan, request: TableRequest, taken: set[str]) -> str:
    """`Table s15`, with a number where that is taken; at most 31 characters, as spreadsheets want."""
    base = f"{plan.text('sheet.table')} {request.value}"[:27]
    number = 1
    title = base
    while title.casefold() in taken:
        number += 1
        title = f"{base} {number}"
    return title


class _Table:
    """One table while it is being laid out."""

    def __init__(self, plan: Plan, request: TableRequest, title: str) -> None:
        self.plan = plan
        self.request = request
        self.title = title
        self.count = len(request.columns)
        self.last = FIRST + plan.rows - 1
        self.windows: dict[str, AngleBranch] = {}
        self.angles: list[str] = []
        self.helpers_at = 1 + self.count + 1 + CHART_COLUMNS + 1
        self.column: Dimension = next(dim for dim in plan.mechanism.dimensions if dim.symbol == request.column)

    def sheet(self) -> Sheet:
        """The sheet."""
        plan = self.plan
        expansion = self.expansion()
        style = styles.decimals(styles.COLUMN, places(plan, self._unit(self.request.value).kind))
        value = self._fill(1, expansion.formula, style)
        cells, fills = self._head()
        driver = plan.at.cell(plan.mechanism.driver.symbol, self.title, plan.at.first)
        fills.append(Fill(FIRST, 0, driver, styles.decimals(styles.HEAD, self._driver_places()), rows=plan.rows))
        fills.append(value)
        for index, (symbol, helper) in enumerate(expansion.helpers):
            cells += self._helper_heading(index, symbol)
            inner = styles.decimals(styles.INNER, places(plan, self._unit(symbol).kind))
            if index < len(self.angles):
                cells.append(Cell(NAME_ROW, self._helper_col(index), plan.text("table.near"), styles.NOTE))
                start = self._start(self.angles[index])
                fills.append(Fill(HEAD_ROW, self._helper_col(index), start, inner, cols=self.count))
            fills.append(self._fill(self._helper_col(index), helper, inner))
        area = Area(FIRST, 1, self.last, self.count)
        missing = formula("ISNA(cell)", cell=CellRef(FIRST, 1))
        return Sheet(
            self.title,
            tuple(cells),
            tuple(fills),
            columns=self._columns(len(expansion.helpers)),
            row_heights=((TITLE_ROW, 26.0), (HINT_ROW, 30.0)),
            merges=tuple(Merge(Area(row, 0, row, self._text_end())) for row in (ABOUT_ROW, HINT_ROW)),
            charts=(self._chart(),),
            validations=(input_validation(plan, Area(HEAD_ROW, 1, HEAD_ROW, self.count), self.request.column),),
            conditionals=(Conditional(area, missing, styles.MISSING),),
            freeze=(FIRST, 1),
            selected=(HEAD_ROW, 1),
            gridlines=False,
            tab_color="7B3FA0",
            print_setup=PrintSetup(
                repeat_rows=(CORNER_ROW, HEAD_ROW),
                footer=plan.footer,
                area=Area(0, 0, max(self.last, CORNER_ROW + CHART_ROWS), 1 + self.count + CHART_COLUMNS),
            ),
        )

    # --- formulas ---------------------------------------------------------------------------------------------

    def expansion(self) -> Expansion:
        """The formula of a cell, and the helpers that it needs."""
        plan, equations = self.plan, self.plan.equations
        driver = plan.mechanism.driver.symbol
        rules = definitions(plan.mechanism, equations)
        free = varying(rules, (driver, self.request.column))
        columns = {equation.symbol for equation in equations.columns}
        rules = {
            symbol: rule
            for symbol, rule in rules.items()
            if (symbol in free or symbol in columns) and symbol not in (driver, self.request.column)
        }
        self.windows = branches_of(plan.mechanism, equations.equations, plan.nominal)
        rules = self._continued(rules)
        rules[CELL] = self._cell(rules)
        used = needed(CELL, rules)
        apart = {symbol: WINDOWED.format(symbol=symbol) for symbol in self.windows}
        self.angles = [symbol for symbol, taken in apart.items() if taken in used]
        return expand(CELL, rules, self._bound, self._helper, [apart[symbol] for symbol in self.angles])

    def _continued(self, rules: Mapping[str, Node]) -> dict[str, Node]:
        """The rules with those of the angles as their columns have them, which outputs read."""
        outputs = {output.symbol for output in self.plan.mechanism.outputs}
        found: dict[str, Node] = {}
        for symbol, rule in rules.items():
            found[symbol] = reading_taken(rule, self.windows) if symbol in outputs else rule
            if symbol in self.windows:
                found[WINDOWED.format(symbol=symbol)] = taken_near(Symbol(symbol), self._near(symbol))
        return found

    def _near(self, symbol: str) -> Node:
        """What an angle is taken within half a turn of: the cell above, or a line from where the columns start."""
        above, start = Symbol(ABOVE.format(symbol=symbol)), Symbol(START.format(symbol=symbol))
        driven = al.sub(Symbol(self.plan.mechanism.driver.symbol), Symbol(FIRST_DRIVER))
        line = al.add(start, al.mul(al.number(self.windows[symbol].slope), driven))
        return formula("IF(ISNUMBER(above),above,line)", above=above, line=line)

    def _start(self, symbol: str) -> Node:
        """The angle [rad] near which all columns start: that of the table of positions in the first row that exists, carried
        back to the first row; with no such row what it is with the dimensions as described."""
        plan, window = self.plan, self.windows[symbol]
        driver = plan.mechanism.driver.symbol
        row = plan.at.cell("#first_1", self.title, None)
        angle = self._there(symbol, row)
        if window.slope:
            there = self._there(driver, row)
            way = al.sub(there, self._bound(FIRST_DRIVER))
            angle = al.sub(angle, al.mul(al.number(window.slope), way))
        described = round(window.centre + window.slope * plan.driver[0], 6)
        return formula("IFERROR(angle,described)", angle=angle, described=described)

    def _there(self, symbol: str, row: Node) -> Node:
        """An angle [rad] in a row of the table of positions."""
        value = Call("INDEX", (self.plan.at.column(symbol, self.title), row))
        return Call("RADIANS", (value,)) if self.plan.at.spots[symbol].degrees else value

    def _cell(self, rules: Mapping[str, Node]) -> Node:
        """The value as people read it."""
        symbol = WINDOWED.format(symbol=self.request.value)
        value: Node = Symbol(symbol if symbol in rules else self.request.value)
        return Call("DEGREES", (value,)) if self.plan.at.spots[self.request.value].degrees else value

    def _bound(self, symbol: str) -> Node:
        """The cell of a leaf as the top-left cell of a block reads it."""
        plan = self.plan
        driver = plan.mechanism.driver
        for index, angle in enumerate(self.angles):
            if symbol in (ABOVE.format(symbol=angle), START.format(symbol=angle)):
                return CellRef(HEAD_ROW, self._helper_col(index), row_abs=symbol == START.format(symbol=angle))
        if symbol in (driver.symbol, FIRST_DRIVER):
            cell: Node = CellRef(FIRST, 0, symbol == FIRST_DRIVER, True)
            return Call("RADIANS", (cell,)) if driver.unit.in_degrees else cell
        if symbol == self.request.column:
            cell = CellRef(HEAD_ROW, 1, row_abs=True)
            return Call("RADIANS", (cell,)) if self.column.unit.in_degrees else cell
        return plan.at.reference(symbol, self.title, None)

    def _helper(self, index: int) -> Node:
        """A cell of the n-th block of helpers as seen from the top-left cell of the table."""
        return CellRef(FIRST, self._helper_col(index))

    def _helper_col(self, index: int) -> int:
        return self.helpers_at + index * (self.count + 1)

    def _unit(self, symbol: str) -> Unit:
        if symbol == self.plan.mechanism.driver.symbol:
            return self.plan.mechanism.driver.unit
        found = [equation.unit for equation in self.plan.equations.all if equation.symbol == symbol]
        return found[0] if found else ANGLE

    def _driver_places(self) -> int:
        """Decimals of the first column: those that the driver's values need, two at most."""
        shown = [self.plan.mechanism.driver.unit.to_shown(value) for value in self.plan.driver]
        return next((digits for digits in (0, 1) if all(abs(x - round(x, digits)) < 1e-9 for x in shown)), 2)

    def _fill(self, col: int, formula: Node, style: Style) -> Fill:
        """A block filled both ways. The formula is the same wherever the block stands: only `$A8`, `B$7` and helpers are
        relative, and they lie as the table's top-left cell sees them, so the head is read `col - 1` further left."""
        return Fill(FIRST, col, formula, style, rows=self.plan.rows, cols=self.count)

    # --- what is written around them --------------------------------------------------------------------------

    def _head(self) -> tuple[list[Cell], list[Fill]]:
        plan, request = self.plan, self.request
        words = request.title.of(plan.language) if request.title else self._about()
        cells = [
            Cell(TITLE_ROW, 0, words, styles.TITLE),
            Cell(ABOUT_ROW, 0, self._about(), styles.SUBTITLE),
            Cell(HINT_ROW, 0, plan.text("table.hint"), styles.NOTE),
            Cell(CORNER_ROW, 0, _with_unit(plan, request.value), styles.SECTION),
            Cell(CORNER_ROW, 1, rich(request.column, _bracketed(self.column.unit.text) + " →"), styles.SECTION),
            *(Cell(CORNER_ROW, col, None, styles.SECTION) for col in range(2, 1 + self.count)),
            Cell(NAME_ROW, 0, None, styles.HEAD),
            Cell(HEAD_ROW, 0, _with_unit(plan, plan.mechanism.driver.symbol, " ↓"), styles.HEAD),
        ]
        unit = self.column.unit.text
        after = unit if unit in ("", "°") else f" {unit}"
        label = joined(f"{plain(request.column)} = ", CellRef(HEAD_ROW, 1), after)
        fills = [Fill(NAME_ROW, 1, label, styles.HEAD, cols=self.count)]
        degrees = self.column.unit.in_degrees
        for index, quantity in enumerate(request.columns):
            if isinstance(quantity, float):
                cells.append(Cell(HEAD_ROW, 1 + index, self.column.unit.written(quantity), styles.INPUT))
            else:
                node = plan.at.bind(quantity, self.title, None)
                fills.append(Fill(HEAD_ROW, 1 + index, Call("DEGREES", (node,)) if degrees else node, styles.INPUT))
        return cells, fills

    def _about(self) -> str:
        """`s₁₅ [mm] over θ₁₂ [°] and s₁ [mm] (setting)`."""
        plan, request = self.plan, self.request
        driver = plan.mechanism.driver.symbol
        column = plain(request.column) + _bracketed(self.column.unit.text)
        if self.column.label:
            column += f" ({self.column.label.of(plan.language)})"
        return plan.text(
            "table.about",
            value=plain(request.value) + _bracketed(shown_unit(plan, request.value)),
            rows=plain(driver) + _bracketed(shown_unit(plan, driver)),
            columns=column,
        )

    def _helper_heading(self, index: int, symbol: str) -> list[Cell]:
        col = self._helper_col(index)
        cells = [Cell(CORNER_ROW, col + further, None, styles.SECTION) for further in range(1, self.count)]
        bare = symbol.removesuffix(WINDOWED.format(symbol=""))
        unit = self.plan.mechanism.shown(self._unit(bare).internal).text
        return [Cell(CORNER_ROW, col, rich(bare, _bracketed(unit)), styles.SECTION), *cells]

    def _text_end(self) -> int:
        """The last column of the lines of text: beside a narrow table they run on under the chart's columns."""
        return max(self.count, 9)

    def _columns(self, helpers: int) -> tuple[Column, ...]:
        widths = [Column(0, 0, 13), Column(1, self.count, 11), Column(self.count + 1, self.count + 1, 3)]
        widths.append(Column(self.count + 2, self.helpers_at - 1, 8.5))
        if helpers:
            widths.append(Column(self.helpers_at, self._helper_col(helpers) - 2, 11, level=1))
        return tuple(widths)

    def _chart(self) -> Chart:
        plan, value = self.plan, self.request.value
        x = SeriesRef(self.title, Area(FIRST, 0, self.last, 0))
        series = tuple(
            Series(
                CellRef(NAME_ROW, col, True, True, self.title),
                x,
                SeriesRef(self.title, Area(FIRST, col, self.last, col)),
                line=styles.SERIES[(col - 1) % len(styles.SERIES)],
                dash=("solid", "dash", "dot")[(col - 1) // len(styles.SERIES) % 3],
            )
            for col in range(1, 1 + self.count)
        )
        title = self.request.title.of(plan.language) if self.request.title else self._about()
        return Chart(
            title,
            Anchor(CORNER_ROW, self.count + 2, WIDTH, HEIGHT),
            series,
            driver_axis(plan, plan.mechanism.driver.symbol),
            Axis(plain(value) + _bracketed(shown_unit(plan, value))),
            legend="right",
            name=f"table {quote_sheet(self.title)}",
            alt_text=title,
        )


def _bracketed(unit: str) -> str:
    return f" [{unit}]" if unit else ""


def _with_unit(plan: Plan, symbol: str, after: str = "") -> str:
    return plain(symbol) + _bracketed(shown_unit(plan, symbol)) + after

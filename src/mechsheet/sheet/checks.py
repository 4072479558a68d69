"""The sheet of checks: the residuals of every row, their worst values with verdicts over them, and one cell for all."""

from __future__ import annotations

from collections.abc import Sequence

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Boolean, Call, CellRef, Node, Number, RangeRef, Text, shifted
from mechsheet.formula.spellings import longest_spelling
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.aside import aside
from mechsheet.sheet.consistency import RECOMPUTED, Whole, whole_table
from mechsheet.sheet.expansion import LIMIT
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.recomputed import place_recomputed
from mechsheet.sheet.residuals import ROUNDING_ANGLE, Check, Frame, residuals
from mechsheet.sheet.symbols import plain
from mechsheet.sheet.workbook import (
    Area,
    Cell,
    Column,
    Conditional,
    Content,
    Fill,
    Merge,
    PrintSetup,
    Sheet,
    Style,
)

ROUNDING = 1e3
"""Lengths are equal up to so many times what counts as zero (1e-12 of the largest length): 1e-9 of it."""

TITLE_ROW, ABOUT_ROW, CLEAR_ROW, WORST_ROW, ROUNDING_ROW = range(5)
LAST_ROW = ROUNDING_ROW + 1
GROUP_ROW, HEAD_ROW, GIVEN_ROW, _, MOST_ROW, AT_ROW, VERDICT_ROW, FIRST = range(LAST_ROW + 2, LAST_ROW + 10)
"""Rows: what holds for the whole table, up to the last; then the heads of the columns, and the table itself."""

NUMBER, DRIVER_COL, DATA = range(3)
VALUE = 2
"""Column of the values that hold for the whole table."""

COUNTED = ("leap", "shared")
"""Checks that mark rows: their rows are counted."""

NOWHERE = "–"
"""Where there is nothing to point to. Not an empty text: LibreOffice shows 0 for one in an .ods until it recalculates."""

SIDE = (6, 11)
"""First columns of the further blocks of them: label, value and verdict are two, one and one columns wide."""

SIDE_END = SIDE[-1] + 3


COLUMNS_OF_A_PAGE = 20
"""More columns are printed on several pages side by side."""


def checks_sheet(plan: Plan) -> Sheet:
    """The sheet. Writes down where `#clear`, `#worst` and `#leaps` stand, for the first sheet to read."""
    place_recomputed(plan)
    return _Sheet(plan).sheet()


class _Sheet:
    """The sheet while it is being laid out."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.title = plan.at.titles["checks"]
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self.verdicts = 0
        self.parts = 0
        self.conditionals: list[Conditional] = []
        self.merges: list[Merge] = []
        self.proven = plan.proven.setdefault(self.title, {(CLEAR_ROW, VALUE)})
        rounding = CellRef(ROUNDING_ROW, VALUE, True, True)
        self.checks = residuals(plan, Frame(self.title, DATA, FIRST, GIVEN_ROW, rounding))
        self.last_row = FIRST + plan.rows - 1
        self.last_col = DATA + len(self.checks) - 1

    def sheet(self) -> Sheet:
        """The finished sheet."""
        plan = self.plan
        self._table()
        for col, check in enumerate(self.checks, DATA):
            self._column(col, check)
        self._group_headings()
        aside_at = max(self.last_col, SIDE_END) + 2
        beside = aside(plan, self.title, GROUP_ROW, HEAD_ROW, FIRST, aside_at)
        self.parts = parts_at = beside.end + 2
        self._whole_table()
        self._top()
        self.cells += beside.cells
        self.fills += beside.fills
        self._grey_where_missing()
        for word, style in (("ok", styles.GOOD), ("look", styles.BAD)):
            self._coloured(Area(VERDICT_ROW, DATA, VERDICT_ROW, self.last_col), word, style)
            for col in SIDE:
                self._coloured(Area(CLEAR_ROW, col + 3, LAST_ROW, col + 3), word, style)
        return Sheet(
            self.title,
            tuple(self.cells),
            tuple(self.fills),
            columns=(
                Column(NUMBER, NUMBER, 9),
                Column(DRIVER_COL, DRIVER_COL, 13),
                Column(DATA, aside_at - 2, 11.5),
                Column(aside_at - 1, aside_at - 1, 3),
                *beside.columns,
                *([Column(parts_at, self.parts - 1, 12, level=1, hidden=True)] if self.parts > parts_at else []),
            ),
            row_heights=((TITLE_ROW, 26.0), (ABOUT_ROW, 42.0), (HEAD_ROW, 30.0)),
            merges=tuple(self.merges),
            conditionals=tuple(self.conditionals),
            freeze=(FIRST, DATA),
            selected=(CLEAR_ROW, VALUE),
            gridlines=False,
            tab_color="B8860B",
            print_setup=PrintSetup(
                fit_width=1 + self.last_col // COLUMNS_OF_A_PAGE,
                repeat_rows=(GROUP_ROW, VERDICT_ROW),
                area=Area(0, 0, self.last_row, max(self.last_col, SIDE_END)),
                footer=plan.footer,
            ),
        )

    # --- small things -----------------------------------------------------------------------------------------

    def put(self, row: int, col: int, content: Content, style: Style) -> None:
        """A constant."""
        self.cells.append(Cell(row, col, content, style))

    def formula(self, row: int, col: int, node: Node, style: Style) -> None:
        """A formula in one cell."""
        self.fills.append(Fill(row, col, node, style))

    def text(self, key: str, **parts: object) -> str:
        """A word of the workbook."""
        return self.plan.text(f"checks.{key}", **parts)

    def own_column(self, col: int) -> RangeRef:
        """A column of this sheet's table."""
        return RangeRef(CellRef(FIRST, col, True, False), CellRef(self.last_row, col, True, False))

    def verdict(self, row: int, col: int, good: Node) -> None:
        """The cell that says whether a check is passed."""
        words = Call("IF", (good, Text(self.text("ok")), Text(self.text("look"))))
        self.formula(row, col, words, styles.VERDICT_MIDDLE)
        self.verdicts += 1

    def _coloured(self, area: Area, key: str, style: Style) -> None:
        cell = CellRef(area.first_row, area.first_col)
        self.conditionals.append(Conditional(area, Binary("=", cell, Text(self.text(key))), style))

    # --- the table --------------------------------------------------------------------------------------------

    def _table(self) -> None:
        """Row numbers, the driver, and the names of the head's rows."""
        plan = self.plan
        driver = plan.mechanism.driver
        number = CellRef(plan.at.first, 0, sheet=plan.table)
        self.fills.append(Fill(FIRST, NUMBER, number, styles.decimals(styles.INNER, 0), rows=plan.rows))
        shown = plan.at.reading_shown(driver.symbol, self.title, plan.at.first)
        self.fills.append(Fill(FIRST, DRIVER_COL, shown, styles.decimals(styles.COLUMN, 2), rows=plan.rows))
        unit = driver.unit.text
        names = {
            GROUP_ROW: "",
            HEAD_ROW: f"{plain(driver.symbol)} [{unit}]" if unit else plain(driver.symbol),
            GIVEN_ROW: self.text("given"),
            GIVEN_ROW + 1: self.text("given.second"),
            MOST_ROW: self.text("most"),
            AT_ROW: self.text("at", driver=plain(driver.symbol)),
            VERDICT_ROW: self.text("verdict"),
        }
        for row, name in names.items():
            style = styles.SECTION if row == GROUP_ROW else styles.HEAD if row == HEAD_ROW else styles.LABEL
            self.put(row, NUMBER, name if row != HEAD_ROW else plan.text("head.number"), style)
            self.put(row, DRIVER_COL, name if row == HEAD_ROW else None, style)
            if row not in (GROUP_ROW, HEAD_ROW):
                self.merges.append(Merge(Area(row, NUMBER, row, DRIVER_COL)))

    def _grey_where_missing(self) -> None:
        """Rows that do not exist, told by the text that every check but those between rows has there."""
        col = next((col for col, check in enumerate(self.checks, DATA) if not check.after), None)
        if col is not None:
            missing = Call("ISTEXT", (CellRef(FIRST, col, col_abs=True),))
            area = Area(FIRST, NUMBER, self.last_row, self.last_col)
            self.conditionals.append(Conditional(area, missing, styles.MISSING))

    def _column(self, col: int, check: Check) -> None:
        """The column and its head."""
        plan = self.plan
        self.put(HEAD_ROW, col, f"{check.head}{self._unit(check)}", styles.HEAD)
        for index in range(2):
            row = GIVEN_ROW + index
            if index < len(check.given):
                self.formula(row, col, check.given[index], styles.decimals(styles.RESULT, 4))
            else:
                self.put(row, col, None, styles.RESULT)
        skip = 1 if check.after else 0
        style = styles.decimals(styles.COLUMN, 0) if check.unit in COUNTED else styles.ERROR
        if check.unit in ("move", "turn"):
            style = styles.decimals(styles.COLUMN, 4)
        if check.unit in ("length", "angle"):
            self.proven.add((FIRST + skip, col))
        if plan.rows > skip:
            self.fills.append(Fill(FIRST + skip, col, shifted(check.formula, skip), style, rows=plan.rows - skip))
        self._summary(col, check, style)

    def _unit(self, check: Check) -> str:
        """` [mm]`, as it stands behind the head."""
        if check.unit in COUNTED:
            return ""
        if check.unit == "turn":
            return f" [{self.plan.mechanism.angle_unit.text}]"
        return " [rad]" if check.unit == "angle" else f" [{self.plan.mechanism.length_unit}]"

    def _summary(self, col: int, check: Check, style: Style) -> None:
        """The largest value (or the number of leaps), the verdict, and where the error is if there is one."""
        column = self.own_column(col)
        most = Call("SUM" if check.unit in COUNTED else "MAX", (column,))
        self.formula(MOST_ROW, col, most, self._boxed(style))
        if check.unit in ("move", "turn", "shared"):
            self.put(AT_ROW, col, None, styles.VERDICT_MIDDLE)
            self.put(VERDICT_ROW, col, None, styles.VERDICT_MIDDLE)
            return
        cell = CellRef(MOST_ROW, col, True, False)
        good = self._within(cell, check.unit)
        self.verdict(VERDICT_ROW, col, good)
        sought: Node = al.ONE if check.unit == "leap" else cell
        drivers = RangeRef(CellRef(FIRST, DRIVER_COL, True, True), CellRef(self.last_row, DRIVER_COL, True, True))
        where = Call("INDEX", (drivers, Call("MATCH", (sought, column, al.ZERO))))
        place = Call("IF", (good, Text(""), Call("IFERROR", (where, Text("")))))
        self.formula(AT_ROW, col, place, self._boxed(styles.decimals(styles.COLUMN, 2)))

    def _boxed(self, style: Style) -> Style:
        return styles.numbered(styles.RESULT, style.number_format)

    def _within(self, cell: Node, unit: str) -> Node:
        """TRUE for an error that is rounding; an error value in the column must not pass."""
        limit: Node = al.ZERO
        if unit == "length":
            limit = CellRef(ROUNDING_ROW, VALUE, True, True)
        elif unit == "angle":
            limit = Number(ROUNDING_ANGLE)
        return Call("IF", (Call("ISNUMBER", (cell,)), Binary("<=", cell, limit), Boolean(False)))

    def _group_headings(self) -> None:
        """A heading over the columns of each link and joint."""
        start = 0
        for end in range(1, len(self.checks) + 1):
            if end < len(self.checks) and self.checks[end].group == self.checks[start].group:
                continue
            self.put(GROUP_ROW, DATA + start, self.checks[start].group, styles.SECTION)
            for other in range(start + 1, end):
                self.put(GROUP_ROW, DATA + other, None, styles.SECTION)
            if end - start > 1:
                self.merges.append(Merge(Area(GROUP_ROW, DATA + start, GROUP_ROW, DATA + end - 1)))
            start = end

    # --- what holds for the whole table -----------------------------------------------------------------------

    def _whole_table(self) -> None:
        """The checks that have one value each, four below each other."""
        for index, check in enumerate(whole_table(self.plan, self.title, CellRef(ROUNDING_ROW, VALUE, True, True))):
            side, down = divmod(index, LAST_ROW - CLEAR_ROW + 1)
            row, col = CLEAR_ROW + down, SIDE[side]
            self.put(row, col, self.text(check.key), styles.LABEL)
            self.put(row, col + 1, None, styles.LABEL)
            self.merges.append(Merge(Area(row, col, row, col + 1)))
            style = styles.decimals(styles.COLUMN, 0) if check.key in ("rows", RECOMPUTED) else styles.ERROR
            if check.key == RECOMPUTED:
                self.proven |= {(row, col + 2), (row, col + 3)}
            self.formula(row, col + 2, check.value(self._joined(check)), self._boxed(style))
            cell = CellRef(row, col + 2)
            good: Node = Binary("<=", Call("ABS", (cell,)), check.limit)
            if check.needs is not None:
                good = Call("AND", (good, check.needs))
            self.verdict(row, col + 3, Call("IF", (Call("ISNUMBER", (cell,)), good, Boolean(False))))

    def _joined(self, check: Whole) -> Node:
        """The largest part, or the sum of the parts. Parts too long for one formula stand in cells of their own."""
        if not check.parts:
            return al.ZERO
        joined = al.total(check.parts) if check.total else al.largest(check.parts)
        if longest_spelling(joined) <= LIMIT:
            return joined
        col = self.parts
        self.put(HEAD_ROW, col, self.text(check.key), styles.HEAD)
        chunks = _chunks(check.parts)
        for index, chunk in enumerate(chunks):
            node = al.total(chunk) if check.total else al.largest(chunk)
            self.formula(FIRST + index, col, node, styles.INNER)
        self.parts += 1
        cells = RangeRef(CellRef(FIRST, col, True, True), CellRef(FIRST + len(chunks) - 1, col, True, True))
        return Call("SUM" if check.total else "MAX", (cells,))

    def _top(self) -> None:
        """The title, the verdict over all, the worst distance, and what counts as rounding."""
        plan = self.plan
        self.put(TITLE_ROW, 0, self.text("title"), styles.TITLE)
        self.put(ABOUT_ROW, 0, self.text("about"), styles.NOTE)
        self.merges.append(Merge(Area(ABOUT_ROW, 0, ABOUT_ROW, SIDE_END)))
        blocks = ((CLEAR_ROW, col + 3, LAST_ROW, col + 3) for col in SIDE)
        places = ((VERDICT_ROW, DATA, VERDICT_ROW, self.last_col), *blocks)
        good = al.total(
            Call("COUNTIF", (RangeRef(CellRef(top, left), CellRef(bottom, right)), Text(self.text("ok"))))
            for top, left, bottom, right in places
        )
        clear = Binary("=", good, Number(float(self.verdicts)))
        words = Call("IF", (clear, Text(self.text("clear")), Text(self.text("not_clear"))))
        worst = [CellRef(MOST_ROW, col) for col, check in enumerate(self.checks, DATA) if check.unit == "length"]
        rounding = al.mul(al.number(ROUNDING), plan.at.reference(plan.equations.tolerance, self.title, None))
        entries = (
            (CLEAR_ROW, "all", words, styles.VERDICT_MIDDLE, "#clear"),
            (WORST_ROW, "worst", _largest(worst), self._boxed(styles.ERROR), "#worst"),
            (ROUNDING_ROW, "rounding", rounding, self._boxed(styles.ERROR), ""),
        )
        for row, key, node, style, spot in entries:
            self.put(row, 0, self.text(key), styles.LABEL)
            self.put(row, 1, None, styles.LABEL)
            self.merges.append(Merge(Area(row, 0, row, 1)))
            self.formula(row, VALUE, node, style)
            if spot:
                plan.at.spots[spot] = plan.at.shown[spot] = Spot(self.title, row, VALUE)
        for col in (VALUE + 1, VALUE + 2):
            self.put(CLEAR_ROW, col, None, styles.VERDICT_MIDDLE)
        self.merges.append(Merge(Area(CLEAR_ROW, VALUE, CLEAR_ROW, VALUE + 2)))
        for row in (WORST_ROW, ROUNDING_ROW):
            self.put(row, VALUE + 1, plan.mechanism.length_unit, styles.UNIT)
        leaps = [col for col, check in enumerate(self.checks, DATA) if check.unit == "leap"]
        if leaps:
            plan.at.spots["#leaps"] = plan.at.shown["#leaps"] = Spot(self.title, MOST_ROW, leaps[0])
        shared = [col for col, check in enumerate(self.checks, DATA) if check.unit == "shared"]
        if shared:  # more than one column only in mechanisms of very many groups: the first sheet reads the first
            plan.at.spots["#shared"] = plan.at.shown["#shared"] = Spot(self.title, MOST_ROW, shared[0])
            plan.at.shown["#shared rows"] = Spot(self.title, FIRST, shared[0])
        area = Area(CLEAR_ROW, VALUE, CLEAR_ROW, VALUE + 2)
        for key, style in (("clear", styles.GOOD), ("not_clear", styles.BAD)):
            here = CellRef(CLEAR_ROW, VALUE, True, True)
            self.conditionals.append(Conditional(area, Binary("=", here, Text(self.text(key))), style))


def _chunks(parts: Sequence[Node]) -> list[list[Node]]:
    """The parts in turn, as many together as one formula may hold."""
    chunks: list[list[Node]] = [[]]
    room = LIMIT // 2
    for part in parts:
        length = longest_spelling(part) + 2
        if length > room and chunks[-1]:
            chunks.append([])
            room = LIMIT // 2
        chunks[-1].append(part)
        room -= length
    return chunks


def _largest(nodes: list[CellRef]) -> Node:
    return al.largest(nodes) if nodes else al.ZERO

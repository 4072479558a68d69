"""The table of positions: the driver's column, a block of columns for each group, points and outputs; filled down."""

from __future__ import annotations

import math
from dataclasses import replace

from mechsheet.formula.nodes import Binary, Call, CellRef, Node, Number, Text, shifted, transform, walk
from mechsheet.kinematics.equations import Group
from mechsheet.kinematics.naming import body_words
from mechsheet.model import Words
from mechsheet.sheet import styles
from mechsheet.sheet.lowering import Assignment
from mechsheet.sheet.mathematics import shortened, written
from mechsheet.sheet.plan import DRIVER, EXISTS, HEADING_ROWS, NUMBER, STATUS, Plan, TableColumn, needs_guard
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.workbook import (
    Area,
    Cell,
    Column,
    Comment,
    Conditional,
    Content,
    Fill,
    Merge,
    PrintSetup,
    Sheet,
    Style,
)
from mechsheet.units import ANGLE, Unit

GROUP_ROW, SYMBOL_ROW, FORMULA_ROW = range(HEADING_ROWS)
COLUMNS_OF_A_PAGE = 17
"""Columns that are still readable on one page of A4, landscape."""
SERVING = ("blank", "rounded")
"""The kinds of column that only serve summaries: folded away."""
TOGETHER = 100
"""Rows from which on LibreOffice computes columns together."""
COMMENT_LIMIT = 60
"""Formulas longer than this are shown shortened in the heading; the Notes sheet has them all."""


def positions_sheet(plan: Plan) -> Sheet:
    """The sheet with the table."""
    cells: list[Cell] = []
    fills: list[Fill] = []
    comments: list[Comment] = []
    for column in plan.columns:
        label, unit, formula = _heading(plan, column)
        word = column.kind in ("number", "status", "exists")
        heading = label if word else rich(label, f" [{unit}]" if unit else "")
        cells.append(Cell(SYMBOL_ROW, column.col, heading, styles.HEAD))
        if column.kind == "number":
            # The rules for colours read it here: other programs refuse a rule that reads another sheet.
            shown = plan.at.reading_shown("#position", plan.table, None)
            fills.append(Fill(FORMULA_ROW, column.col, shown, styles.numbered(styles.FORMULA_TEXT, '"→ "0')))
        else:
            cells.append(Cell(FORMULA_ROW, column.col, formula, styles.FORMULA_TEXT))
        words = _meaning(plan, column)
        if words:
            comments.append(Comment(SYMBOL_ROW, column.col, words))
        column_cells, column_fills = _column(plan, column)
        cells += column_cells
        fills += column_fills
    plan.proven[plan.table] = _proven(plan, fills)
    merges = _group_headings(plan, cells)
    first, last, count = plan.at.first, plan.at.last, len(plan.columns)
    return Sheet(
        plan.table,
        tuple(cells),
        tuple(fills),
        columns=_widths(plan),
        row_heights=((SYMBOL_ROW, 30.0), (FORMULA_ROW, 48.0)),
        merges=tuple(merges),
        conditionals=_conditionals(plan, Area(first, 0, last, count - 1)),
        comments=tuple(comments),
        freeze=(HEADING_ROWS, EXISTS),
        selected=(first, DRIVER),
        print_setup=PrintSetup(
            fit_width=1 + sum(column.kind not in SERVING for column in plan.columns) // COLUMNS_OF_A_PAGE,
            repeat_rows=(0, HEADING_ROWS - 1),
            repeat_cols=(NUMBER, DRIVER),
            footer=plan.footer,
        ),
        tab_color="2E8B57",
    )


def _proven(plan: Plan, fills: list[Fill]) -> set[tuple[int, int]]:
    """Where the columns begin that the sheet of checks holds against the geometry.

    Outputs, words and what serves summaries are none of these, nor the start of a column that counts turns.
    """
    unproven = {column.col for column in plan.columns if column.kind in ("status", *SERVING)}
    unproven |= {plan.at.shown[output.symbol].col for output in plan.mechanism.outputs}
    return {(fill.row, fill.col) for fill in fills if fill.rows > 1 and fill.col not in unproven}


def _heading(plan: Plan, column: TableColumn) -> tuple[str, str, Content]:
    """(symbol, unit, formula for people) over a column."""
    driver = plan.mechanism.driver
    match column.kind:
        case "number":
            return plan.text("head.number"), "", ""
        case "status":
            return plan.text("head.status"), "", ""
        case "exists":
            return plan.text("head.exists"), "", ""
        case "driver":
            stepping = f"{plan.text('name.start')} + n·{plan.text('name.step')}"
            return column.symbol, driver.unit.text, "" if driver.values else stepping
        case "blank" | "rounded":
            return column.symbol, blank_unit(plan, column.symbol), plan.text(f"column.{column.kind}")
        case "shown":
            unit = _unit_of(plan, column.symbol)
            key = "column.shown" if plan.at.shown[column.symbol].degrees else "column.guarded"
            return column.symbol, plan.mechanism.shown(unit).text, plan.text(key)
    if column.equation is None:  # the driver in radians
        return column.symbol, "rad", plan.text("column.radians")
    unit = column.equation.unit
    shown = plan.mechanism.shown(unit if column.equation.role == "output" else unit.internal)
    return column.symbol, shown.text, shortened(written(column.equation.expression, plan.language), COMMENT_LIMIT)


def _unit_of(plan: Plan, symbol: str) -> Unit:
    found = [equation.unit for equation in plan.equations.columns if equation.symbol == symbol]
    return found[0] if found else ANGLE


def blank_unit(plan: Plan, symbol: str) -> str:
    """The unit of a column that repeats another: radians for an angle that people do not read."""
    unit = _unit_of(plan, symbol)
    return plan.mechanism.shown(unit if plan.at.shown[symbol].degrees else unit.internal).text


def digits_kept(plan: Plan, symbol: str) -> int:
    """Decimals that leave a column about twelve digits: of a length, twelve digits of the largest length."""
    unit = blank_unit(plan, symbol)
    if _unit_of(plan, symbol).kind == "length":
        return max(0, 12 - math.ceil(math.log10(plan.size)))
    return {"°": 9, "rad": 11}.get(unit, 10)


def _meaning(plan: Plan, column: TableColumn) -> str:
    if column.kind == "number":
        return plan.text("column.here")
    if column.equation is None:
        return ""
    label: Words = column.equation.label
    return label.of(plan.language)


def _column(plan: Plan, column: TableColumn) -> tuple[list[Cell], list[Fill]]:
    match column.kind:
        case "number":
            # counted from the heading: rows may be inserted above the table
            heading = Call("ROW", (CellRef(FORMULA_ROW, NUMBER, True, True),))
            formula = Binary("-", Binary("-", Call("ROW"), heading), Number(1.0))
            return [], [_fill(plan, NUMBER, formula, _decimals(styles.INNER, 0))]
        case "driver":
            return _driver_column(plan)
        case "status":
            return [], [_fill(plan, STATUS, _status(plan), styles.STATUS)]
        case "exists":
            return [], [_fill(plan, EXISTS, _exists(plan), _decimals(styles.INNER, 0))]
        case "shown":
            return [], _guarded_fills(plan, column.col, _shown(plan, column), _shown_style(plan, column))
        case "blank" | "rounded":
            value = plan.at.reading_shown(column.symbol, plan.table, plan.at.first)
            if column.symbol == plan.mechanism.driver.symbol:  # a number in every row
                value = _guarded(plan, value)
            digits = Number(float(digits_kept(plan, column.symbol)))
            kept = Call("ROUND", (value, digits)) if column.kind == "rounded" else value
            node = Call("IF", (Call("ISNUMBER", (value,)), kept, Text("")))
            return [], [_fill(plan, column.col, node, styles.INNER)]
    if column.equation is None:
        cell = CellRef(plan.at.first, DRIVER)
        return [], [_fill(plan, column.col, Call("RADIANS", (cell,)), _decimals(styles.INNER, 4))]
    return [], _equation_column(plan, column, column.equation)


def _shown(plan: Plan, column: TableColumn) -> Node:
    """What people read: the angle in degrees, and no number in a row that does not exist."""
    value = plan.at.reference(column.symbol, plan.table, plan.at.first)
    if plan.at.shown[column.symbol].degrees:
        value = Call("DEGREES", (value,))
    return _guarded(plan, value) if needs_guard(plan, column.symbol) else value


def _guarded(plan: Plan, value: Node) -> Node:
    exists = CellRef(plan.at.first, EXISTS, col_abs=True)
    return Call("IF", (Binary("=", exists, Number(1.0)), value, Call("NA")))


def _guarded_fills(plan: Plan, col: int, formula: Node, style: Style) -> list[Fill]:
    """A column that asks whether the row exists; in long tables its first row does so without `$`.

    LibreOffice computes neighbouring columns of equal formulas together from a hundred rows on. Whether a row exists
    depends on the columns left and right of this one: it must not be taken together with them (Err:522 in the first row).
    """
    exists = CellRef(plan.at.first, EXISTS, col_abs=True)
    asks = any(part == exists for part in walk(formula))
    if plan.rows < TOGETHER or not asks:
        return [_fill(plan, col, formula, style)]
    apart = transform(formula, lambda part: replace(exists, col_abs=False) if part == exists else part)
    return [Fill(plan.at.first, col, apart, style), _fill(plan, col, shifted(formula, 1), style, skip=1)]


def _shown_style(plan: Plan, column: TableColumn) -> Style:
    kind = column.equation.unit.kind if column.equation else "angle"
    return _decimals(styles.COLUMN, places(plan, kind))


def _fill(plan: Plan, col: int, formula: Node, style: Style, skip: int = 0) -> Fill:
    return Fill(plan.at.first + skip, col, formula, style, rows=plan.rows - skip)


def _equation_column(plan: Plan, column: TableColumn, equation: Assignment) -> list[Fill]:
    first = plan.at.first
    inner = column.inner
    kind = equation.unit.kind
    digits = 4 if kind == "angle" and inner else places(plan, kind)
    style = _decimals(styles.INNER if inner else styles.COLUMN, digits)
    expression = equation.expression
    if equation.role == "output" and plan.at.spots[column.symbol].degrees:
        expression = Call("DEGREES", (expression,))
    if equation.role == "output" and needs_guard(plan, column.symbol):
        expression = _guarded(plan, expression)
    if equation.first is None:
        return _guarded_fills(plan, column.col, plan.at.bind(expression, plan.table, first), style)
    start = Fill(first, column.col, plan.at.bind(equation.first, plan.table, first), style)
    if plan.rows == 1:
        return [start]
    return [start, _fill(plan, column.col, plan.at.bind(expression, plan.table, first + 1), style, skip=1)]


def _driver_column(plan: Plan) -> tuple[list[Cell], list[Fill]]:
    """start + n step, filled down: no drift, as a running sum would have; or the listed values as inputs."""
    driver = plan.mechanism.driver
    digits = 6 if driver.values else places(plan, "angle" if driver.unit.in_degrees else "length")
    if not driver.values:
        start = plan.at.reading_shown("#start", plan.table, None)
        step = plan.at.reading_shown("#step", plan.table, None)
        formula = Binary("+", start, Binary("*", CellRef(plan.at.first, NUMBER, col_abs=True), step))
        return [], [_fill(plan, DRIVER, formula, _decimals(styles.COLUMN, digits))]
    cells: list[Cell] = []
    fills: list[Fill] = []
    for index, value in enumerate(driver.values):
        row = plan.at.first + index
        if isinstance(value, float):
            cells.append(Cell(row, DRIVER, driver.unit.written(value), styles.INPUT))
        else:
            node = plan.at.bind(value, plan.table, row)
            node = Call("DEGREES", (node,)) if driver.unit.in_degrees else node
            fills.append(Fill(row, DRIVER, node, styles.COLUMN))
    return cells, fills


def places(plan: Plan, kind: str) -> int:
    """Decimals that the tolerances justify: with +-0.1 mm one; without tolerances a step finer than 1e-3 of the size."""
    tolerances = [dim.tolerance for dim in plan.mechanism.dimensions if dim.tolerance and dim.unit.kind == "length"]
    if kind == "angle":
        return 2 if plan.mechanism.angle_unit.in_degrees else 4
    if kind == "number":
        return 4
    finest = min(tolerances) if tolerances else plan.size / 1e4
    return min(10, max(0, math.ceil(-math.log10(finest) - 1e-9)))


def _decimals(style: Style, count: int) -> Style:
    return styles.decimals(style, count)


def _closing(plan: Plan, group: Group) -> Node:
    return Call("ISNUMBER", (plan.at.reference(group.closes, plan.table, plan.at.first),))


def _exists(plan: Plan) -> Node:
    """1 in a row that every group closes, else 0."""
    tests = tuple(_closing(plan, group) for group in plan.equations.groups)
    if not tests:
        return Number(1.0)
    test = tests[0] if len(tests) == 1 else Call("AND", tests)
    return Call("IF", (test, Number(1.0), Number(0.0)))


def _status(plan: Plan) -> Node:
    """The first group that does not close, in words; "ok" when all do."""
    node: Node = Text(plan.text("status.ok"))
    for group in reversed(plan.equations.groups):
        node = Call("IF", (_closing(plan, group), node, _status_word(plan, group)))
    return node


def _status_word(plan: Plan, group: Group) -> Node:
    links = ", ".join(body_words(plan.mechanism, name).of(plan.language) for name in group.links)
    open_ = Text(plan.text("status.open", links=links))
    if group.degenerate is None:
        return open_
    undetermined = Text(plan.text("status.undetermined", links=links))
    return Call("IF", (plan.at.bind(group.degenerate, plan.table, plan.at.first), undetermined, open_))


def _group_headings(plan: Plan, cells: list[Cell]) -> list[Merge]:
    """A heading over the columns of each group."""
    merges = []
    start = 0
    for col in range(1, len(plan.columns) + 1):
        if col < len(plan.columns) and plan.columns[col].group == plan.columns[start].group:
            continue
        cells.append(Cell(GROUP_ROW, start, group_title(plan, plan.columns[start].group), styles.SECTION))
        cells += [Cell(GROUP_ROW, other, None, styles.SECTION) for other in range(start + 1, col)]
        if col - start > 1:
            merges.append(Merge(Area(GROUP_ROW, start, GROUP_ROW, col - 1)))
        start = col
    return merges


def group_title(plan: Plan, number: int) -> str:
    """What stands over the columns of a group (0: the driver's side, -1: outputs)."""
    if number == 0:
        return plan.text("group.driver")
    if number < 0:
        return plan.text("group.outputs")
    group = plan.equations.groups[number - 1]
    return f"{plan.text('group')} {number} ({group.kind}): {group.label.of(plan.language)}"


def _widths(plan: Plan) -> tuple[Column, ...]:
    """Widths; intermediate columns can be folded away, those that only serve summaries are folded away."""
    fixed = {NUMBER: 5.0, DRIVER: 9.0, STATUS: 16.0}
    widths = []
    for column in plan.columns:
        serving = column.kind in SERVING
        width = fixed.get(column.col, 11.0)
        widths.append(Column(column.col, column.col, width, level=1 if column.inner else 0, hidden=serving))
    if plan.columns[-1].kind in SERVING:
        widths.append(Column(len(plan.columns), len(plan.columns), 3.0, collapsed=True))
    return tuple(widths)


def _conditionals(plan: Plan, area: Area) -> tuple[Conditional, ...]:
    """The row of the position shown stands out; rows without a position are grey."""
    row = plan.at.first
    exists = CellRef(row, EXISTS, col_abs=True)
    here = Binary("=", CellRef(row, NUMBER, col_abs=True), CellRef(FORMULA_ROW, NUMBER, True, True))
    return (
        Conditional(area, here, styles.CURRENT),
        Conditional(area, Binary("=", exists, Number(0.0)), styles.MISSING),
    )

"""The table of positions: the driver's column, a block of columns for each group, points and outputs; filled down."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Mapping, Sequence
from itertools import groupby

from livesheet import portable
from livesheet.formula.nodes import (
    CellRef,
    Node,
    Symbol,
    transform,
)
from livesheet.workbook import (
    Area,
    Cell,
    Column,
    Comment,
    Conditional,
    Content,
    Fill,
    Merge,
    Rich,
    Sheet,
    Style,
    plain_text,
)
from mechsheet.kinematics.equations import CAM
from mechsheet.model import TIME
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Addresses
from mechsheet.sheet.as_typed import degrees_together, in_degrees
from mechsheet.sheet.columns.bands import HEADINGS, ROOT, WORST
from mechsheet.sheet.deleted import FIRST_OF_ALL, are_there, sheets_of
from mechsheet.sheet.driving import by_time, driver_after, rows_before, time_after
from mechsheet.sheet.mathematics import written
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import DRIVER, HEADING_ROWS, NUMBER, STATUS, Plan, TableColumn
from mechsheet.sheet.printing import ROW, table_setup
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.shown import rich
from mechsheet.sheet.table.status import status, while_inputs_can_be
from mechsheet.units import DEG, Unit
from mechsheet.units import NUMBER as NUMBER_UNIT

GROUP_ROW, SYMBOL_ROW, FORMULA_ROW = range(HEADING_ROWS)
CHARACTERS_OF_A_LINE = 14
"""So many of the small characters of a formula stand in a line of a column of width 11."""

LINE, SYMBOL_HEIGHT = 14.5, 30.0
"""Pixels of a line of formulas, and of the row of symbols."""

STEP = 1e-4
"""Of what is usual of a quantity: numbers step by no more, and by no less than a tenth of it."""
MOST_DECIMALS = 7
"""Decimals of what is no length: more do not fit a column."""

FEWEST_LINES, MOST_LINES = 3, 8
"""Lines of the row of formulas; a longer one makes its column wider."""


def positions_sheet(plan: Plan) -> Sheet:
    """The sheet with the table."""
    cells: list[Cell] = []
    fills: list[Fill] = []
    comments: list[Comment] = []
    said = {column.col: mathematics(plan, column) for column in plan.columns}
    for column in plan.columns:
        cells.append(Cell(SYMBOL_ROW, column.col, heading(plan, column), styles.HEAD))
        if column.kind == "number":
            # The rules for colours read it here: other programs refuse a rule that reads another sheet.
            shown = there(plan.places.position).cell
            fills.append(Fill(FORMULA_ROW, column.col, shown, styles.numbered(styles.FORMULA_TEXT, '"→ "0')))
            comments.append(Comment(SYMBOL_ROW, column.col, plan.text("column.here")))
        else:
            cells.append(Cell(FORMULA_ROW, column.col, said[column.col], styles.FORMULA_TEXT))
        if column.equation is not None:
            comments.append(Comment(SYMBOL_ROW, column.col, column.equation.label.of(plan.language)))
        if column.symbol in plan.mechanism.listed:
            listed_cells, listed_fills = listed_values(plan, column, plan.table)
            cells += listed_cells
            fills += listed_fills
        else:
            fills += column_fills(plan, column, plan.table, plan.at.first, plan.rows)
    headings, merges = group_headings(plan.columns, GROUP_ROW, lambda number: group_title(plan, number))
    cells += headings
    first, last, count = plan.at.first, plan.at.last, len(plan.columns)
    fixed = {NUMBER: 5.0, DRIVER: 9.0 if plan.mechanism.driver.law is None else 20.0, STATUS: 16.0}
    widths = {column.col: fixed.get(column.col, width_for(said[column.col])) for column in plan.columns}
    return Sheet(
        plan.table,
        tuple(cells),
        tuple(fills),
        columns=tuple(Column(col, col, width, level=int(plan.columns[col].inner)) for col, width in widths.items()),
        row_heights=((SYMBOL_ROW, SYMBOL_HEIGHT), (FORMULA_ROW, formula_height(said, widths))),
        merges=tuple(merges),
        conditionals=_conditionals(Area(first, 0, last, count - 1), plan.text("status.ok")),
        comments=tuple(comments),
        freeze=(HEADING_ROWS, STATUS + 1),
        selected=(first, DRIVER),
        print_setup=table_setup(
            list(widths.values()), head_height(said, widths), first, plan.rows, (NUMBER, DRIVER), plan.footer
        ),
        tab_color="2E8B57",
    )


# --- formulas --------------------------------------------------------------------------------------------------------


def column_fills(plan: Plan, column: TableColumn, sheet: str, first: int, rows: int) -> list[Fill]:
    """The formulas of a column in so many rows of a sheet."""
    style = style_of(plan, column)
    match column.kind:
        case "number":
            return [Fill(first, NUMBER, rows_before(plan), style, rows=rows)]
        case "driver" | "time":
            given = given_in_row(plan, column, CellRef(first, NUMBER, col_abs=True))
            return [Fill(first, column.col, plan.at.bind(given, sheet, first), style, rows=rows)]
        case "status":
            return [Fill(first, STATUS, plan.at.bind(status(plan), sheet, first), style, rows=rows)]
    if column.equation is None:
        raise ValueError(f"a column without an equation: {column.symbol}")
    value = cell_formula(plan, plan.at, column, column.equation.expression, sheet, first)
    if column.equation.role == "output" and sheet == plan.table:
        value = _while_sheets_are_there(plan, column.symbol, value)
    return [Fill(first, column.col, value, style, rows=rows)]


def _while_sheets_are_there(plan: Plan, symbol: str, value: Node) -> Node:
    """A value of the table; #N/A where a sheet that it is computed from was deleted."""
    present = are_there(plan, sheets_of(plan, symbol) - {*FIRST_OF_ALL})
    if present is None:
        return value
    return plan.at.bind(formula("IF(present,value,NA())", present=present, value=value), plan.table)


def given_in_row(plan: Plan, column: TableColumn, number: Node) -> Node:
    """The driver's value, or the time of its law, in the row of that number; symbols are still to be bound."""
    law = plan.mechanism.driver.law
    if law is None:
        return driver_after(plan, number)
    return time_after(law, number) if column.kind == "time" else by_time(law, Symbol(TIME))


def cell_formula(plan: Plan, at: Addresses, column: TableColumn, expression: Node, sheet: str, row: int) -> Node:
    """What a cell of the column holds in a row that stands for one position; `at` says where quantities stand there."""
    value = transform(at.bind(expression, sheet, row), degrees_together)
    if column.symbol in plan.unguarded:
        value = at.bind(while_inputs_can_be(plan, value), sheet)
    return in_degrees(value) if at.spots[column.symbol].degrees else value


def listed_values(plan: Plan, column: TableColumn, sheet: str) -> tuple[list[Cell], list[Fill]]:
    """The listed values of the driver, or what is listed beside them, as inputs."""
    unit = plan.mechanism.given_unit(column.symbol) or NUMBER_UNIT
    cells: list[Cell] = []
    fills: list[Fill] = []
    for row, value in enumerate(plan.mechanism.listed[column.symbol], plan.at.first):
        if isinstance(value, float):
            cells.append(Cell(row, column.col, unit.written(value), styles.INPUT))
            continue
        node = transform(plan.at.bind(value, sheet, row), degrees_together)
        fills.append(Fill(row, column.col, in_degrees(node) if unit.in_degrees else node, style_of(plan, column)))
    return cells, fills


# --- what stands over the columns ------------------------------------------------------------------------------------


def heading(plan: Plan, column: TableColumn) -> Content:
    """Symbol and unit, or a word."""
    if column.kind in ("number", "status"):
        return plan.text(f"head.{column.kind}")
    unit = column_unit(plan, column)
    word = HEADINGS.get(column.symbol.partition(":")[2])
    if word is not None:
        return plan.text(word) + (f" [{unit}]" if unit else "")
    return rich(column.symbol, f" [{unit}]" if unit else "")


def column_unit(plan: Plan, column: TableColumn) -> str:
    """The unit in which a column stands in the table."""
    if column.equation is None:
        return plan.mechanism.shown(plan.mechanism.given_unit(column.symbol) or NUMBER_UNIT).text
    unit = column.equation.unit
    inside = column.inner and not plan.at.spots[column.symbol].degrees
    return plan.mechanism.shown(unit.internal if inside else unit).text


def mathematics(plan: Plan, column: TableColumn) -> Rich | str:
    """The formula as people write it."""
    driver = plan.mechanism.driver
    if driver.law is not None and column.kind in ("driver", "time"):
        time = time_after(driver.law, Symbol("n"))
        return written(time if column.kind == "time" else driver.law.value, plan.language)
    if column.kind == "driver" and driver.stepped:
        return f"{plan.text('name.start')} + n·{plan.text('name.step')}"
    if column.symbol in plan.mechanism.listed_symbols:
        return plan.text("drivers.listed")
    return "" if column.equation is None else written(column.equation.says, plan.language)


def width_for(said: Rich | str) -> float:
    """Of a column wide enough for the formula over it in the lines that there are."""
    return max(11.0, 11.0 * len(plain_text(said)) / (CHARACTERS_OF_A_LINE * (MOST_LINES - 1)))


def formula_height(said: Mapping[int, Rich | str], widths: Mapping[int, float]) -> float:
    """Of the row of formulas over columns of these widths."""
    lines = (
        1 + math.ceil(len(plain_text(text)) / (CHARACTERS_OF_A_LINE * widths[col] / 11.0)) for col, text in said.items()
    )
    return LINE * max(FEWEST_LINES, min(MOST_LINES, max(lines)))


def head_height(said: Mapping[int, Rich | str], widths: Mapping[int, float]) -> float:
    """Of the whole heading over the columns of a table [pixels]."""
    return ROW + SYMBOL_HEIGHT + formula_height(said, widths)


def style_of(plan: Plan, column: TableColumn) -> Style:
    """How the cells of a column look."""
    if column.kind == "number":
        return styles.decimals(styles.INNER, 0)
    if column.kind == "status":
        return styles.STATUS
    if column.kind in ("time", "listed"):
        return styles.decimals(
            styles.COLUMN, decimals_of_unit(plan, plan.mechanism.given_unit(column.symbol) or NUMBER_UNIT)
        )
    if column.equation is None:
        unit = plan.mechanism.driver.unit
        return styles.decimals(styles.COLUMN, decimals_of_kind(plan, unit.kind, unit.symbol))
    unit = column.equation.unit
    if column.symbol in plan.residuals:
        return styles.numbered(styles.INNER, styles.ERROR.number_format)
    if column.symbol in plan.determinants:
        return styles.numbered(styles.INNER, styles.DETERMINANT)
    if column.equation.role == "band":
        return _band_style(plan, column.symbol)
    if column.symbol in plan.band_decimals:
        return styles.decimals(styles.COLUMN, plan.band_decimals[column.symbol])
    if column.inner:
        in_radians = unit.kind == "angle" and not plan.at.spots[column.symbol].degrees
        return styles.decimals(styles.INNER, 4 if in_radians else decimals_of_unit(plan, unit))
    return styles.decimals(styles.COLUMN, decimals_of_unit(plan, unit))


def _band_style(plan: Plan, symbol: str) -> Style:
    """A band has one digit more than what it is the band of; a derivative four decimals."""
    quantity, _, part = symbol.partition(":")
    if part not in HEADINGS:
        return styles.decimals(styles.COLUMN, 4)
    more = 1 if part in (WORST, ROOT) else 0
    return styles.decimals(styles.COLUMN, plan.band_decimals.get(quantity, 4) + more)


def decimals_of_unit(plan: Plan, unit: Unit) -> int:
    """Decimals of a quantity: a step finer than 1e-3 of what is usual of it, so that no number is too wide for its column.

    Angular velocities have as many as plain numbers, whatever the unit of angles. What is usual of a length to a power
    (mm², 1/mm) is the size to that power; of a velocity or acceleration the size times the driver's pace to the power `per`.
    """
    power = _power_of_length(unit, plan.mechanism.length_unit)
    if power != 1:
        return min(MOST_DECIMALS, decimals_of(plan.size**power * STEP))
    if unit.kind == "length" and unit.per:
        return min(MOST_DECIMALS, decimals_of(plan.size * plan.pace**unit.per * STEP))
    dynamics = plan.mechanism.dynamics
    if unit.kind == "moment" and dynamics and unit.symbol == f"{dynamics.force_unit} {plan.mechanism.length_unit}":
        return decimals_of(STEP / (dynamics.metre or 1.0))  # N mm has three decimals fewer than N m
    return decimals_of_kind(plan, "number" if unit.per and unit.kind == "angle" else unit.kind, unit.symbol)


_LENGTHS = re.compile(r"(1/)?(.*?)(²|\^\d+)?")


def _power_of_length(unit: Unit, length: str) -> int:
    """2 of mm², -1 of 1/mm; 1 of everything else."""
    found = _LENGTHS.fullmatch(unit.symbol)
    if unit.kind != "number" or not length or found is None or found[2] != length:
        return 1
    power = {None: 1, "²": 2}.get(found[3]) or int(found[3][1:])
    return -power if found[1] else power


def decimals_of_kind(plan: Plan, kind: str, symbol: str = "") -> int:
    """Decimals that the tolerances justify: with +-0.1 mm one; without tolerances a step finer than 1e-3 of the size.

    symbol  of the unit, where it may be another one than the mechanism's
    """
    tolerances = [dim.tolerance for dim in plan.mechanism.dimensions if dim.tolerance and dim.unit.kind == "length"]
    if kind == "angle":
        return 2 if (symbol or plan.mechanism.angle_unit.symbol) == DEG.symbol else 4
    if kind in ("number", "moment", "power"):
        return 4
    if kind == "force":
        return 3
    return decimals_of(min(tolerances) if tolerances else plan.size * STEP)


def decimals_of(step: float) -> int:
    """How many decimals show such a step: 1 for 0.1, 2 for 0.05; 0 to 10."""
    return min(10, max(0, math.ceil(-float(portable.log10(step)) - 1e-9)))


def group_headings(
    columns: Sequence[TableColumn], row: int, title: Callable[[int], str]
) -> tuple[list[Cell], list[Merge]]:
    """A heading over the columns of each group, whose title is asked for by its number."""
    cells: list[Cell] = []
    merges: list[Merge] = []
    start = 0
    for number, group in groupby(columns, key=lambda column: column.group):
        end = start + len(list(group)) - 1
        cells.append(Cell(row, start, title(number), styles.SECTION))
        cells += [Cell(row, col, None, styles.SECTION) for col in range(start + 1, end + 1)]
        if end > start:
            merges.append(Merge(Area(row, start, row, end)))
        start = end + 1
    return cells, merges


def group_title(plan: Plan, number: int) -> str:
    """What stands over the columns of a group (0: the driver's side, -1: outputs)."""
    if number == 0:
        return plan.text("group.driver")
    if number == CAM:
        return plan.text("block.cam")
    if number < 0:
        return plan.text("group.outputs")
    group = plan.equations.groups[number - 1]
    return f"{plan.text('group')} {number} ({group.kind}): {group.label.of(plan.language)}"


def _conditionals(area: Area, ok: str) -> tuple[Conditional, ...]:
    """The row of the position shown stands out; rows without a position are grey."""
    row = area.first_row
    number, shown, status_cell = (
        CellRef(row, NUMBER, col_abs=True),
        CellRef(FORMULA_ROW, NUMBER, True, True),
        CellRef(row, STATUS, col_abs=True),
    )
    return (
        Conditional(area, formula("number=shown", number=number, shown=shown), styles.CURRENT),
        Conditional(area, formula("said<>ok", said=status_cell, ok=ok), styles.MISSING),
    )

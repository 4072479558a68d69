"""The sheets of velocities and of forces: in the rows of the positions, a block of columns for each group.

Grey are the influence coefficients and what they are found from, mass centres, their accelerations, and the sums of what
acts on each link; black is what people read. Forces begin with the driver's effort, found twice; groups stand in the
order in which their forces are found: the last one first, the driver last.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from livesheet.formula.nodes import CellRef, Node, Symbol
from livesheet.workbook import Area, Cell, Column, Comment, Conditional, Fill, Merge, Rich, Sheet
from mechsheet.sheet import styles
from mechsheet.sheet.deleted import READS, are_there, missing_words
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import DRIVER, HEADING_ROWS, RATES_DRIVER, RATES_STATUS, Plan, TableColumn
from mechsheet.sheet.printing import table_setup
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.shown import rich
from mechsheet.sheet.table.positions import (
    FORMULA_ROW,
    GROUP_ROW,
    SYMBOL_HEIGHT,
    SYMBOL_ROW,
    column_fills,
    formula_height,
    group_headings,
    group_title,
    head_height,
    heading,
    mathematics,
    style_of,
    width_for,
)
from mechsheet.sheet.table.status import first_open, links_of


def rates_sheet(plan: Plan) -> Sheet:
    """The sheet."""
    return sheet_beside(plan, "rates", plan.rates, _status(plan), "7C3AED")


def sheet_beside(
    plan: Plan,
    key: str,
    columns: Sequence[TableColumn],
    status: Node,
    tab_color: str,
    titled: Callable[[int], str] | None = None,
) -> Sheet:
    """A sheet with further columns in the rows of the positions: the driver's value and a word about the row before them.

    titled  what stands over the columns of a group, by its number; its name by default
    """
    title, first, rows = plan.at.titles[key], plan.at.first, plan.rows
    said: dict[int, Rich | str] = {column.col: mathematics(plan, column) for column in columns}
    cells, fills = _first_columns(plan, key, plan.at.bind(status, title, first))
    comments: list[Comment] = []
    for column in columns:
        cells.append(Cell(SYMBOL_ROW, column.col, heading(plan, column), styles.HEAD))
        cells.append(Cell(FORMULA_ROW, column.col, said[column.col], styles.FORMULA_TEXT))
        if column.equation is not None:
            comments.append(Comment(SYMBOL_ROW, column.col, column.equation.label.of(plan.language)))
        fills += column_fills(plan, column, title, first, rows)
    headings, merges = _headings(plan, key, columns, titled or (lambda number: group_title(plan, number)))
    beside = max(18.0, 1.1 * len(plan.text(f"{key}.title")) - 11.0)  # the sheet's title stands over both
    widths = {RATES_DRIVER: 11.0, RATES_STATUS: beside} | {col: width_for(text) for col, text in said.items()}
    inner = {column.col for column in columns if column.inner}
    last = columns[-1].col
    return Sheet(
        title,
        (*cells, *headings),
        tuple(fills),
        columns=tuple(Column(col, col, width, level=int(col in inner)) for col, width in widths.items()),
        row_heights=((SYMBOL_ROW, SYMBOL_HEIGHT), (FORMULA_ROW, formula_height(said, widths))),
        merges=tuple(merges),
        conditionals=(_missing(plan, Area(first, 0, plan.at.last, last)),),
        comments=tuple(comments),
        freeze=(HEADING_ROWS, RATES_STATUS + 1),
        selected=(first, RATES_STATUS + 1),
        print_setup=table_setup(
            list(widths.values()), head_height(said, widths), first, rows, (RATES_DRIVER, RATES_STATUS), plan.footer
        ),
        tab_color=tab_color,
    )


def _first_columns(plan: Plan, key: str, said: Node) -> tuple[list[Cell], list[Fill]]:
    """The driver's value, and what the sheet says of the row."""
    first, rows = plan.at.first, plan.rows
    driver = plan.columns[DRIVER]
    unit = plan.mechanism.driver.unit.text
    value = CellRef(first, DRIVER, sheet=plan.table)
    cells = [
        Cell(SYMBOL_ROW, RATES_DRIVER, rich(driver.symbol, f" [{unit}]" if unit else ""), styles.HEAD),
        Cell(
            SYMBOL_ROW, RATES_STATUS, plan.text("iterations.head" if key == "iterations" else "rates.head"), styles.HEAD
        ),
        Cell(FORMULA_ROW, RATES_DRIVER, None, styles.FORMULA_TEXT),
        Cell(FORMULA_ROW, RATES_STATUS, None, styles.FORMULA_TEXT),
    ]
    return cells, [
        Fill(first, RATES_DRIVER, value, style_of(plan, driver), rows=rows),
        Fill(first, RATES_STATUS, said, styles.STATUS, rows=rows),
    ]


def _headings(
    plan: Plan, key: str, columns: Sequence[TableColumn], titled: Callable[[int], str]
) -> tuple[list[Cell], list[Merge]]:
    """The sheet's title over its first columns, then each group's."""
    cells, merges = group_headings(columns, GROUP_ROW, titled)
    moved = [Cell(cell.row, cell.col + RATES_STATUS + 1, cell.content, cell.style) for cell in cells]
    areas = [
        Merge(
            Area(GROUP_ROW, merge.area.first_col + RATES_STATUS + 1, GROUP_ROW, merge.area.last_col + RATES_STATUS + 1)
        )
        for merge in merges
    ]
    title = [
        Cell(GROUP_ROW, RATES_DRIVER, plan.text(f"{key}.title"), styles.SECTION),
        Cell(GROUP_ROW, RATES_STATUS, None, styles.SECTION),
    ]
    return [*title, *moved], [Merge(Area(GROUP_ROW, RATES_DRIVER, GROUP_ROW, RATES_STATUS)), *areas]


def determinants(plan: Plan) -> dict[int, str]:
    """By number of a group that has dead centres: the column that has no number there."""
    return {
        equation.group: equation.symbol
        for equation in plan.equations.equations.columns
        if equation.role == "coefficient" and equation.exists and equation.group > 0
    }


def dead_words(plan: Plan) -> list[str]:
    """What the sheet says of a group at a dead centre, in order of solution, and of a row that is none; nothing where no
    group has any."""
    found = []
    for number in determinants(plan):
        group = plan.equations.groups[number - 1]
        found.append(plan.text("rates.dead", links=links_of(plan, group)))
    return [*found, plan.text("status.ok")] if found else []


def _status(plan: Plan) -> Node:
    """What the positions say; where they exist, "ok" or the first group at a dead centre."""
    moving = [formula("ISNUMBER(value)", value=Symbol(name)) for name in determinants(plan).values()]
    said = plan.places.status.in_row(plan.at.first)
    if not moving:
        return said
    return formula("IF(said=ok,INDEX(words,first_dead),said)", said=said, ok=plan.text("status.ok"),
                   words=there(plan.places.dead), first_dead=first_open(moving))  # fmt: skip


def _missing(plan: Plan, area: Area) -> Conditional:
    """Rows without rates are grey."""
    said = CellRef(area.first_row, RATES_STATUS, col_abs=True)
    return Conditional(area, formula("said<>ok", said=said, ok=plan.text("status.ok")), styles.MISSING)


def forces_sheet(plan: Plan) -> Sheet:
    """The sheet; what it says of a row is what the rates say, or the positions where there is no group; or that the rates
    were deleted."""
    said: Node = (plan.places.rates or plan.places.status).in_row(plan.at.first)
    present = are_there(plan, READS["forces"])
    if present is not None:
        missing = replace(missing_words(plan), sheet=plan.main)
        said = formula("IF(present,said,missing)", present=present, said=said, missing=missing)
    return sheet_beside(plan, "forces", plan.forces, said, "B91C1C")

"""The sheet that lists a workbook's functions, and calls each of them over the sweep beside the table of positions."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

from livesheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef, Text
from livesheet.workbook import Area, Cell, Column, Conditional, Fill, Merge, PrintSetup, Sheet
from mechsheet.exporting.functions.all_functions import TABLE_KEY, Function, in_degrees, variable_key
from mechsheet.exporting.functions.routines import Source
from mechsheet.sheet import styles
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.shown import shown_unit
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.words.catalogue import Phrase, words

LIST_TITLE = Phrase("function.list.title")

MOST_ROWS = 37
"""Rows of the table: of a longer sweep every second, third … row."""

SMALL = replace(styles.NOTE_CELL, name="", number_format="0.0E+00", align="right")

SPAN = 5
"""Columns that a function's name takes in the list; its meaning takes the following ones."""


def functions_sheet(
    plan: Plan,
    source: Source,
    functions: Sequence[Function],
    names: Mapping[str, str],
    calls: Mapping[str, Callable[[Node], Node]],
    title: str,
) -> Sheet:
    """The sheet; `calls` make the formula that calls a function, from the cell of the driver."""
    language = plan.language
    cells = [Cell(0, 0, LIST_TITLE.of(language), styles.TITLE)]
    cells.append(Cell(1, 0, words(language, "function.list.about", positions=plan.table), styles.NOTE_TEXT))
    end = 2 * SPAN + 2
    merges = [Merge(Area(1, 0, 1, end)), Merge(Area(DIFFERENCE_ROW, 0, DIFFERENCE_ROW, 1))]
    shown = [function for function in functions if function.key != TABLE_KEY and not function.basic]
    step = math.ceil(plan.rows / MOST_ROWS)
    count = math.ceil(plan.rows / step)
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
        row_heights=((0, 26.0), (1, 30.0)),
        merges=tuple(merges),
        conditionals=(Conditional(area, Call("ISNA", (CellRef(FIRST, 2),)), styles.MISSING),),
        freeze=(FIRST, 2),
        gridlines=False,
        tab_color="C8501E",
        print_setup=PrintSetup(footer=plan.footer, area=Area(0, 0, row, behind - 1)),
    )


NAME_ROW, UNIT_ROW, DIFFERENCE_ROW = 3, 4, 5
FIRST = 6
"""Rows of the sheet."""


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
        checked = difference(plan, source, symbol, CellRef(FIRST, col), number)
        at = behind + col - 2
        fills.append(Fill(FIRST, at, checked, styles.INNER, rows=count))
        area = RangeRef(CellRef(FIRST, at), CellRef(FIRST + count - 1, at))
        fills.append(Fill(DIFFERENCE_ROW, col, Call("MAX", (area,)), SMALL))
    return fills


def difference(plan: Plan, source: Source, symbol: str, found: Node, number: Node) -> Node:
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

"""A table that a person has made longer, by rows inserted into it or filled below it.

A program that inserts rows lets the ranges grow that reach over them; so the range in which the first sheet counts says by
how many. Then the workbook is compared with the description's, grown in the same way: with the rows inserted, and every
filled range that they tear filled down over them. The motion is compared with that of the description with as many rows.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from livesheet.formula import algebra as al
from livesheet.formula.book import Block, Book, BookSheet
from livesheet.formula.nodes import CellRef, Node, RangeRef, walk
from livesheet.said import say
from mechsheet.checking.edited.edits import Edits, edits_of
from mechsheet.checking.edited.expected import Expected
from mechsheet.checking.edited.formula_diff import formula_of
from mechsheet.checking.edited.inserted_rows import (
    Move,
    Moves,
    Shift,
    inside,
    moved_back,
    moved_block,
    moves_between,
    undone,
)
from mechsheet.compiled import Compiled
from mechsheet.model import Mechanism, Quantity
from mechsheet.sheet.plan import Plan

WITH_ROWS = ("iterations", "rates", "forces", "tolerance", "checks")
"""Keys of the sheets that have a row for each position, beside the table."""


@dataclass(frozen=True, slots=True)
class Growth:
    """By how much a table is longer.

    inserted  rows inside it;  below: rows of a page that go on below its last one
    empty     the numbers of those that were left empty, counted from 0 in the longer table
    sheets    those of the description's workbook that have the inserted rows
    """

    inserted: int
    below: int
    empty: tuple[int, ...]
    sheets: tuple[str, ...]


@dataclass(frozen=True, slots=True)
class Compared:
    """What somebody changed in a workbook, and the plan of the workbook with as many rows as its table has.

    built  of a table that was made longer, the numbers of the rows that it was built with: two-way tables follow these
    """

    edits: Edits
    plan: Plan
    built: tuple[int, ...] = ()


def compared(book: Book, expected: Expected) -> Compared:
    """Compare a book with the one that its description would build, grown as the book's table has."""
    growth = growth_of(book, expected)
    if growth is None:
        return Compared(edits_of(book, expected), expected.plan)
    tried = {at: edits_of(book, grown(expected, growth, at)) for at in _places(book, expected, growth)}
    at, found = min(tried.items(), key=lambda each: len(each[1].edits))
    if growth.empty:  # they are no rows of the table
        found = replace(found, edits=edits_of(book, expected).edits)
    remarks = (*_said(growth, expected), *found.remarks)
    plan, rows = longer_plan(expected.plan, growth.inserted + growth.below), range(expected.plan.rows)
    built = tuple(row if row < at else row + growth.inserted for row in rows)
    return Compared(replace(found, remarks=remarks), plan, built)


def _said(growth: Growth, expected: Expected) -> tuple[str, ...]:
    rows, said = expected.plan.rows, []
    if growth.inserted:
        said.append(say("the table of {rows} rows has {count} more inside it", rows=rows, count=growth.inserted))
    if growth.below:
        said.append(say("the table of {rows} rows has {count} more below it", rows=rows, count=growth.below))
    return tuple(said)


# --- finding it ------------------------------------------------------------------------------------------------------


def growth_of(book: Book, expected: Expected) -> Growth | None:
    """How the book's table has grown; None where it has not, or where a sheet lacks the rows that others have.

    Of a driver that goes on by one step: listed values are typed, and a motion law has a last row.
    """
    plan = expected.plan
    was, now = _counted(expected.book, plan), _counted(book, plan)
    if not plan.mechanism.driver.stepped or was is None or now is None:
        return None
    table = book.sheet(now.start.sheet or "")
    inserted, first = _rows(now) - _rows(was), now.start.row
    filled = set() if table is None else _rows_with_formulas(table, first)
    if inserted < 0 or first not in filled:
        return None
    end = first + plan.rows + inserted
    empty = tuple(row - first for row in range(first, end) if row not in filled)
    below = 0
    while plan.mechanism.layout == "page" and end + below in filled:
        below += 1
    if inserted + below == 0 or len(empty) > inserted:
        return None
    titles = {plan.table, *(plan.at.titles.get(key, "") for key in WITH_ROWS)}
    moved = [move for move in moves_between(expected.book, book).moves if move.title in titles]
    if inserted and any(_rows_on(book, expected, move) < plan.rows + inserted for move in moved):
        return None
    return Growth(inserted, below, empty, tuple(move.title for move in moved) if inserted else ())


def _rows_on(book: Book, expected: Expected, move: Move) -> int:
    """How many rows a sheet has for positions, empty ones among them."""
    was, sheet = expected.book.sheet(move.title), book.sheet(move.now)
    if was is None or sheet is None:
        return 0
    first = 1 + (
        move.rows.now(_first_row(was, expected.plan) - 1) or 0
    )  # below the headings, which are known by their words
    return max(_rows_with_formulas(sheet, first), default=0) + 1 - first


def _counted(book: Book, plan: Plan) -> RangeRef | None:
    """The range of the table in which the first sheet counts the rows, its sheet with it."""
    called = plan.places.lines["rows_closed"].name
    cell = next((each.formula for each in book.names if each.name == called), None)
    sheet = book.sheet(cell.sheet or "") if isinstance(cell, CellRef) else None
    if sheet is None or not isinstance(cell, CellRef):
        return None
    block = sheet.formula_at(cell.row, cell.col)
    found = () if block is None else (part for part in walk(block.formula) if isinstance(part, RangeRef))
    for part in found:
        return replace(part, start=replace(part.start, sheet=part.start.sheet or sheet.title))
    return None


def _rows(area: RangeRef) -> int:
    return area.end.row - area.start.row + 1


def _rows_with_formulas(table: BookSheet, first: int) -> set[int]:
    """The rows in which the table's first column has formulas; none where it has none in the table's first row."""
    col = min((block.col for block in table.blocks if block.row <= first < block.row + block.rows), default=-1)
    blocks = (block for block in table.blocks if block.col <= col < block.col + block.cols)
    return {row for block in blocks for row in range(block.row, block.row + block.rows)}


# --- the workbook and the motion with as many rows -----------------------------------------------------------------


def _places(book: Book, expected: Expected, growth: Growth) -> tuple[int, ...]:
    """Before which rows they may have been inserted.

    Filled ones look the same everywhere, but for ranges that leave out the first or the last row, and for sheets that read
    the table row by row and have no rows of their own for the new ones: these read rows farther down from there on.
    """
    if growth.empty:
        return growth.empty[:1]
    for sheet in expected.book.sheets:
        if sheet.title not in growth.sheets and (at := _read_farther_down(book, sheet, expected.plan)):
            return (at,)
    last = expected.plan.rows - 1
    return tuple(dict.fromkeys((max(1, last // 2), 1, last)))


def _read_farther_down(book: Book, sheet: BookSheet, plan: Plan) -> int:
    """From which row of the table on its rows are read farther down than before; 0 where nothing says it."""
    other = book.sheet(sheet.title)
    for block in sheet.blocks if other is not None else ():
        read = _row_read(block.formula, plan.table) if block.rows == plan.rows else None
        if read is None or other is None:
            continue
        for row in range(block.rows):
            found = other.formula_at(block.row + row, block.col)
            now = None if found is None else _row_read(formula_of(found, block.row + row, block.col), plan.table)
            if now is not None and now != read + row:
                return row
    return 0


def _row_read(formula: Node, title: str) -> int | None:
    """The row that a formula reads on a sheet, of the first cell that is not anchored."""
    cells = (part for part in walk(formula) if isinstance(part, CellRef) and not part.row_abs)
    return next((cell.row for cell in cells if (cell.sheet or "").casefold() == title.casefold()), None)


def grown(expected: Expected, growth: Growth, at: int) -> Expected:
    """What the description builds, with the rows inserted before row `at` of its table, and filled."""
    plan = expected.plan
    moves = Moves([
        Move(sheet.title, sheet.title, Shift(_first_row(sheet, plan) + at, -growth.inserted))  # undoing a deletion inserts
        for sheet in expected.book.sheets if sheet.title in growth.sheets
    ])  # fmt: skip
    book = undone(expected.book, moves)
    sheets = [
        _filled(now, was, moves, plan.at.last if was.title == plan.table else -1, growth)
        for now, was in zip(book.sheets, expected.book.sheets, strict=True)
    ]
    return replace(expected, book=replace(book, sheets=sheets))


def _first_row(sheet: BookSheet, plan: Plan) -> int:
    """The row of the first position on a sheet that has a row for each."""
    return min(block.row for block in sheet.blocks if block.rows == plan.rows)


def _filled(now: BookSheet, was: BookSheet, moves: Moves, last: int, growth: Growth) -> BookSheet:
    """A sheet after the insertion, its torn blocks filled over the new rows; those that end in row `last` further down."""
    move, blocks = moves.of(was.title), []
    for block in was.blocks:
        more = growth.inserted if inside(block, move.rows, "row") else 0
        if block.rows > 1 and block.row + block.rows - 1 == last:
            more += growth.below
        if more:
            formula = moved_back(block.formula, was.title, moves)
            blocks.append(Block(block.row, block.col, block.rows + more, block.cols, formula))
        else:
            blocks += moved_block(block, was.title, move, moves)
    return BookSheet(now.title, now.constants, blocks, now.cached)


def longer_plan(plan: Plan, more: int) -> Plan:
    """The plan of the same mechanism with so many rows more."""
    modes = {group.mode: group.mode_value for group in plan.equations.groups if group.mode and group.follows is None}
    return Compiled(_longer(plan.mechanism, more), modes).plan


def _longer(mechanism: Mechanism, more: int) -> Mechanism:
    driver = mechanism.driver
    stop: Quantity
    if isinstance(driver.stop, float) and isinstance(driver.step, float):
        stop = driver.stop + more * driver.step
    else:
        stop = al.add(al.as_node(driver.stop), al.mul(al.number(float(more)), al.as_node(driver.step)))
    return replace(mechanism, driver=replace(driver, stop=stop))

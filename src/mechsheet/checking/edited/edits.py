"""What somebody changed in a workbook that mechsheet built: every formula against the one the description would build.

A table may have been made longer, by rows inserted into it or filled below it, or shorter, by rows deleted. A program that
inserts rows lets the ranges grow that reach over them; so the range in which the first sheet counts says by how many. Then
the workbook is compared with the description's, grown in the same way: with the rows inserted, and every filled range that
they tear filled down over them; or with the rows deleted. The motion is compared with that of as many rows.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace

from livesheet.formula import algebra as al
from livesheet.formula.book import Block, Book, BookSheet
from livesheet.formula.functions import FUNCTIONS
from livesheet.formula.names import folded
from livesheet.formula.nodes import (
    Call,
    CellRef,
    ErrorValue,
    Local,
    NameRef,
    Node,
    Number,
    RangeRef,
    Scalar,
    Unary,
    shifted,
    transform,
    walk,
)
from livesheet.said import say
from mechsheet.checking.books_compared import Formulas, alike, formula_of, neutral, printed, stretches
from mechsheet.checking.comparison import text_of
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
from mechsheet.checking.inputs import Expected, InputCells
from mechsheet.checking.report import Edit
from mechsheet.compiled import Compiled
from mechsheet.model import Mechanism, Quantity
from mechsheet.sheet.deleted import FIRST_OF_ALL
from mechsheet.sheet.plan import Plan

SAME = 1e-13
"""Numbers this near (relatively) are one: programs write 15 to 17 digits."""

MANY = 0.5
"""From this part of its formulas on, a workbook was not edited but built by another version of the program."""


@dataclass(frozen=True, slots=True)
class Edits:
    """What was found in a book.

    edits    faults, told at the places that the cells have now
    remarks  what a person should know: inputs that were changed, cells that were added, rows that were inserted
    moves    where cells, rows and sheets went;  book  the same book with all of them back in their places
    """

    edits: tuple[Edit, ...]
    remarks: tuple[str, ...]
    moves: Moves
    book: Book


def edits_of(book: Book, expected: Expected) -> Edits:
    """Compare a book with the one that its description would build."""
    moves = moves_between(expected.book, book)
    book = undone(book, moves)
    gone = _missing(book, expected)
    edits = [*moves.edits(expected.book), *_sheets(gone, expected), *_names(book, expected, gone)]
    remarks = list(moves.remarks())
    inputs = expected.inputs()
    formulas = differing = 0
    for sheet in expected.book.sheets:
        other = book.sheet(sheet.title)
        if other is None or sheet.title == expected.description_sheet:
            continue
        found = list(_merged(_changes(sheet, other, gone)))
        edits += [_edit(change, sheet, other, moves) for change in found]
        edits += _numbers(sheet, other, inputs, moves)
        remarks += _constants(sheet, other, inputs, expected, moves)
        remarks += _added(sheet, other, inputs, moves)
        formulas += sum(block.rows * block.cols for block in sheet.blocks)
        differing += sum(change.rows * change.cols for change in found)
    remarks += [
        say('the sheet "{title}" is missing', title=sheet.title)
        for sheet in expected.book.sheets
        if sheet.title in gone and sheet.title not in _kept(expected)
    ]
    known = {sheet.title.casefold() for sheet in expected.book.sheets}
    remarks += [
        say('the sheet "{title}" is your own', title=sheet.title)
        for sheet in book.sheets
        if sheet.title.casefold() not in known
    ]
    if formulas and differing > MANY * formulas:
        remarks.append(
            say(
                "{differing} of {formulas} formulas differ: was it built by another version of mechsheet?",
                differing=differing,
                formulas=formulas,
            )
        )
    return Edits(tuple(edits), tuple(remarks), moves, book)


# --- sheets and names ----------------------------------------------------------------------------------------------


def _missing(book: Book, expected: Expected) -> frozenset[str]:
    """Sheets that somebody has deleted, but for the description, of which others tell."""
    titles = {sheet.title for sheet in expected.book.sheets if book.sheet(sheet.title) is None}
    return frozenset(titles - {expected.description_sheet})


def _kept(expected: Expected) -> set[str]:
    """Sheets without which there are no positions: a person who deletes one has damaged the workbook."""
    plan = expected.plan
    return {plan.main, plan.table, *(plan.at.titles[key] for key in FIRST_OF_ALL if key in plan.at.titles)}


def _sheets(gone: frozenset[str], expected: Expected) -> Iterator[Edit]:
    for sheet in expected.book.sheets:
        if sheet.title in gone & _kept(expected):
            yield Edit("sheet", sheet.title, "a sheet of formulas", "missing")


def _without(node: Node, gone: frozenset[str]) -> Node:
    """A formula as it is after such sheets were deleted."""

    def change(part: Node) -> Node:
        match part:
            case CellRef(sheet=str(title)) if title in gone:
                return ErrorValue("#REF!")
            case RangeRef(ErrorValue(), _):
                return ErrorValue("#REF!")
        return part

    return transform(node, change) if gone else node


def _names(book: Book, expected: Expected, gone: frozenset[str]) -> Iterator[Edit]:
    theirs = {folded(name.name): name for name in book.names if name.sheet is None}
    for name in expected.book.names:
        other = theirs.get(folded(name.name))
        if other is None and _without(name.formula, gone) == ErrorValue("#REF!"):
            continue  # some programs delete the name with the sheet
        if other is None:
            yield Edit("name", name.name, printed(name.formula), "missing")
        elif not alike(comparable(_without(name.formula, gone), ""), comparable(other.formula, "")):
            yield Edit("name", name.name, printed(name.formula), printed(other.formula))


# --- formulas ------------------------------------------------------------------------------------------------------


def comparable(node: Node, title: str) -> Node:
    """A formula in the form in which two are compared: spelling aside."""

    def change(part: Node) -> Node:
        match part:
            case Unary("-", Number(value)):
                return Number(-value)
            case NameRef(name, sheet):
                return NameRef(folded(name), sheet)
            case Local(name, optional):
                return Local(folded(name), optional)
            case Call(name, args) if name not in FUNCTIONS:
                return Call(folded(name), args)
        return part

    return transform(neutral(node, title), change)


@dataclass(frozen=True, slots=True)
class _Change:
    """Cells whose formula is another one now, or none (`now` None, then `value` is what stands there)."""

    row: int
    col: int
    rows: int
    cols: int
    was: Node
    now: Node | None
    value: Scalar = None


def _changes(sheet: BookSheet, other: BookSheet, gone: frozenset[str]) -> Iterator[_Change]:
    """Column by column; `gone` are sheets that were deleted, which changes what reads them."""
    ours, theirs = Formulas(sheet), Formulas(other)
    for col, start, stop in stretches(ours, theirs):
        one, two = ours.block(start, col), theirs.block(start, col)
        if one is None:
            continue
        if two is not None and (one.row, one.col) == (two.row, two.col) and one.formula == two.formula:
            continue  # nearly always: the rest is the slow way
        was, now = _without(formula_of(one, start, col), gone), None if two is None else formula_of(two, start, col)
        if now is None:
            for row in range(start, stop):
                moved = shifted(was, row - start)
                yield _Change(row, col, 1, 1, moved, None, other.constants.get(row, col))
        elif not alike(comparable(was, sheet.title), comparable(now, sheet.title)):
            yield _Change(start, col, stop - start, 1, was, now)


def _merged(changes: Iterable[_Change]) -> Iterator[_Change]:
    """Neighbours with the same change as one: first below each other, then side by side."""
    columns = list(_joined(changes, down=True))
    columns.sort(key=lambda change: (change.row, change.rows, change.col))
    yield from sorted(_joined(columns, down=False), key=lambda change: (change.row, change.col))


def _joined(changes: Iterable[_Change], down: bool) -> Iterator[_Change]:
    last: _Change | None = None
    for change in changes:
        if last is not None and _goes_on(last, change, down):
            last = replace(last, rows=last.rows + change.rows) if down else replace(last, cols=last.cols + change.cols)
            continue
        if last is not None:
            yield last
        last = change
    if last is not None:
        yield last


def _goes_on(last: _Change, change: _Change, down: bool) -> bool:
    if down:
        step, touches = (last.rows, 0), (change.row, change.col) == (last.row + last.rows, last.col)
    else:
        step = (0, last.cols)
        touches = (change.row, change.col, change.rows) == (last.row, last.col + last.cols, last.rows)
    if not touches or (change.now is None) is not (last.now is None):
        return False
    if change.now is None or last.now is None:
        return (change.value is None) is (last.value is None)
    return shifted(last.now, *step) == change.now


def _edit(change: _Change, sheet: BookSheet, other: BookSheet, moves: Moves) -> Edit:
    where = moves.area(sheet.title, change.row, change.col, change.rows, change.cols)
    was = printed(change.was)
    if change.now is None:
        if change.value is None:
            return Edit("emptied", where, was, "")
        values = [
            other.constants.get(row, col)
            for col in range(change.col, change.col + change.cols)
            for row in range(change.row, change.row + change.rows)
        ]
        shown = ", ".join(text_of(value) for value in values[:3]) + (", …" if len(values) > 3 else "")
        return Edit("overwritten", where, was, shown)
    run = sheet.formula_at(change.row, change.col)
    if run is not None and (run.rows > change.rows or run.cols > change.cols):
        around = say(" (filled over {area})", area=moves.area(sheet.title, run.row, run.col, run.rows, run.cols))
        return Edit("out of its run", where, was, printed(change.now), around)
    return Edit("changed", where, was, printed(change.now))


# --- constants -----------------------------------------------------------------------------------------------------


def _numbers(sheet: BookSheet, other: BookSheet, inputs: InputCells, moves: Moves) -> Iterator[Edit]:
    """Numbers that are no inputs, and inputs in whose place something else stands."""
    theirs = Formulas(other)
    for row, col, value in sheet.constants.items():
        is_input = (sheet.title, row, col) in inputs
        formula = theirs.at(row, col)
        if formula is not None and (is_input or not isinstance(value, str)):
            yield Edit("formula", moves.area(sheet.title, row, col), text_of(value), printed(formula))
        elif not is_input and isinstance(value, float | int) and formula is None:
            now = other.constants.get(row, col)
            if not same(value, now):
                yield Edit("value", moves.area(sheet.title, row, col), text_of(value), text_of(now))


def same(one: Scalar, other: Scalar) -> bool:
    """Whether two constants are equal but for what programs lose: the last digits, spaces beside spaces."""
    if isinstance(one, float | int) and isinstance(other, float | int):
        return math.isclose(one, other, rel_tol=SAME, abs_tol=1e-300)
    if isinstance(one, str) or isinstance(other, str):
        return str(one or "").split() == str(other or "").split()
    return one == other


def _constants(
    sheet: BookSheet, other: BookSheet, inputs: InputCells, expected: Expected, moves: Moves
) -> Iterator[str]:
    """Inputs that were changed, and texts. Not the position and the arrows shown, which say nothing, nor modes: others tell
    of them.
    """
    plan = expected.plan
    modes = (plan.at.spots[group.mode] for group in plan.equations.groups if group.mode)
    silent = (plan.places.position, *plan.places.arrows.values(), *modes)
    places = {(spot.sheet, spot.row, spot.col) for spot in silent if spot is not None}
    texts: list[tuple[int, int]] = []
    theirs = Formulas(other)
    for row, col, value in sheet.constants.items():
        now = other.constants.get(row, col)
        place = (sheet.title, row, col)
        if same(value, now) or theirs.at(row, col) is not None or place in places:
            continue
        if place in inputs:
            symbol = inputs[place] or moves.area(*place)
            yield say("{symbol} is {now}, was {was}", symbol=symbol, now=_number(now), was=_number(value))
        elif isinstance(value, str):
            texts.append((row, col))
    for place, symbol in inputs.items():  # tolerances that were not given
        if place[0] == sheet.title and sheet.constants.get(*place[1:]) is None:
            now = other.constants.get(*place[1:])
            if now is not None and theirs.at(*place[1:]) is None:
                yield say("{symbol} is {now}, was not given", symbol=symbol, now=_number(now))
    if texts:
        yield say(
            "{sheet}: texts changed in {cells}", sheet=moves.now(sheet.title), cells=_listed(sheet.title, texts, moves)
        )


def _added(sheet: BookSheet, other: BookSheet, inputs: InputCells, moves: Moves) -> Iterator[str]:
    """Cells of the user's own on free places."""
    ours, theirs = Formulas(sheet), Formulas(other)

    def is_free(row: int, col: int) -> bool:
        taken = ours.block(row, col) is not None or sheet.constants.get(row, col) is not None
        return not taken and (sheet.title, row, col) not in inputs

    cells = {(row, col) for row, col, value in other.constants.items() if value not in (None, "") and is_free(row, col)}
    for col, start, stop in stretches(ours, theirs):
        if theirs.block(start, col) is not None and ours.block(start, col) is None:
            cells |= {(row, col) for row in range(start, stop) if is_free(row, col)}
    if cells:
        yield say(
            "{sheet}: cells of your own in {cells}",
            sheet=moves.now(sheet.title),
            cells=_listed(sheet.title, sorted(cells), moves),
        )


def _listed(title: str, cells: list[tuple[int, int]], moves: Moves) -> str:
    shown = ", ".join(moves.area(title, *cell).rpartition("!")[2] for cell in cells[:8])
    return say("{places} and {count} more", places=shown, count=len(cells) - 8) if len(cells) > 8 else shown


def _number(value: Scalar) -> str:
    if isinstance(value, float) and value == int(value) and abs(value) < 1e15:
        return str(int(value))
    return text_of(value) or say("empty")


# --- a table that was made longer or shorter ---------------------------------------------------------------------------


WITH_ROWS = ("iterations", "rates", "forces", "tolerance", "checks")
"""Keys of the sheets that have a row for each position, beside the table."""


@dataclass(frozen=True, slots=True)
class Growth:
    """By how much a table is longer.

    inserted  rows inside it, below 0 of one that is shorter;  below: rows of a page that go on below its last one
    empty     the numbers of those that were left empty, counted from 0 in the longer table
    sheets    those of the description's workbook that have the inserted rows, or have lost them
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
    remarks = (*_said(growth, expected, at), *found.remarks)
    plan, rows = longer_plan(expected.plan, growth.inserted + growth.below), range(expected.plan.rows)
    built = tuple(row if row < at else max(0, row + growth.inserted) for row in rows)
    return Compared(replace(found, remarks=remarks), plan, built)


def _said(growth: Growth, expected: Expected, at: int) -> tuple[str, ...]:
    rows, said = expected.plan.rows, []
    if growth.inserted > 0:
        said.append(say("the table of {rows} rows has {count} more inside it", rows=rows, count=growth.inserted))
    if growth.inserted < 0:
        said.append(say("the table of {rows} rows has {count} fewer", rows=rows, count=-growth.inserted))
        if at < rows + growth.inserted:
            said.append(say("its row {row} reads one that was deleted: fill it down anew", row=at))
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
    if first not in filled or inserted <= -plan.rows:
        return None
    if inserted < 0:
        sheets = _shortened(book, expected, -inserted)
        return Growth(inserted, 0, (), sheets) if plan.table in sheets else None
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


def _shortened(book: Book, expected: Expected, count: int) -> tuple[str, ...]:
    """The sheets with a row for each position from which so many rows were deleted."""
    plan = expected.plan
    titles, found = {plan.table, *(plan.at.titles.get(key, "") for key in WITH_ROWS)}, []
    for sheet in expected.book.sheets:
        other = book.sheet(sheet.title)
        if sheet.title in titles and other is not None:
            first = _first_row(sheet, plan)
            rows, wanted = _rows_with_formulas(other, first), plan.rows - count
            if {*range(first, first + wanted)} <= rows and not rows & {*range(first + wanted, first + plan.rows)}:
                found.append(sheet.title)
    return tuple(found)


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
    if growth.inserted < 0:
        return _torn(book, expected.plan, expected.plan.rows + growth.inserted)
    if growth.empty:
        return growth.empty[:1]
    for sheet in expected.book.sheets:
        if sheet.title not in growth.sheets and (at := _read_farther_down(book, sheet, expected.plan)):
            return (at,)
    last = expected.plan.rows - 1
    return tuple(dict.fromkeys((max(1, last // 2), 1, last)))


def _torn(book: Book, plan: Plan, last: int) -> tuple[int, ...]:
    """Before which row rows were deleted: one that reads what is gone, if any; else they were the last ones."""
    table, first = book.sheet(plan.table), plan.at.first
    for block in table.blocks if table is not None else ():
        row, lost = block.row - first, any(part == ErrorValue("#REF!") for part in walk(block.formula))
        if lost and 0 <= row < last:
            return (row, last)
    return (last,)


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
        more = max(0, growth.inserted) if inside(block, move.rows, "row") else 0
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

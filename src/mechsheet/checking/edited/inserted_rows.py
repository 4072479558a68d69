"""Rows, columns and sheets that somebody inserted, deleted or renamed: found, and undone for the comparison.

A spreadsheet program moves cells and rewrites references when that happens, and the workbook stays right. So a book is first
brought back into the places of the one it is compared with. One block of rows and one of columns is found on each sheet.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from livesheet.formula.book import Block, Book, BookSheet, CellStore
from livesheet.formula.nodes import CellRef, ErrorValue, Node, RangeRef, Scalar, shifted, transform
from livesheet.formula.references import area_name, column_letters
from livesheet.said import say
from mechsheet.checking.report import Edit

MOST = 50
"""So many rows or columns at most are looked for; with more the sheet is another one."""


@dataclass(frozen=True, slots=True)
class Shift:
    """`count` rows (or columns) stand before what was number `at`; or, below 0, that many from `at` on are gone."""

    at: int
    count: int

    def now(self, place: int) -> int | None:
        """Where what was at `place` is now, None if it is gone."""
        if place < self.at:
            return place
        gone = self.count < 0 and place < self.at - self.count
        return None if gone else place + self.count

    def before(self, place: int) -> int | None:
        """Where what is at `place` now was before, None if it is new."""
        if place < self.at:
            return place
        new = self.count > 0 and place < self.at + self.count
        return None if new else place - self.count


NOTHING = Shift(0, 0)


@dataclass(frozen=True, slots=True)
class Move:
    """What happened to one sheet: `title` was, `now` is."""

    title: str
    now: str
    rows: Shift = NOTHING
    cols: Shift = NOTHING

    @property
    def in_place(self) -> bool:
        """True when every cell is where it was."""
        return self.rows.count == 0 and self.cols.count == 0

    def before(self, row: int, col: int) -> tuple[int, int] | None:
        """Where a cell was, None if it is new."""
        old = self.rows.before(row), self.cols.before(col)
        return None if old[0] is None or old[1] is None else (old[0], old[1])


class Moves:
    """What happened to the sheets of a book, by the titles that they had."""

    def __init__(self, moves: Sequence[Move]) -> None:
        self.moves = tuple(moves)
        self.by_title = {move.title: move for move in moves}
        self._by_now = {move.now.casefold(): move for move in moves}

    def __bool__(self) -> bool:
        return any(not move.in_place or move.title != move.now for move in self.moves)

    def of(self, title: str) -> Move:
        """What happened to the sheet that is called `title` now."""
        return self._by_now.get(title.casefold(), Move(title, title))

    def now(self, title: str) -> str:
        """What a sheet is called now."""
        move = self.by_title.get(title)
        return title if move is None else move.now

    def area(self, title: str, row: int, col: int, rows: int = 1, cols: int = 1) -> str:
        """The name, as the file has it now, of cells that stood there: Positions!C9, or Positions!C9:C30."""
        move = self.by_title.get(title, Move(title, title))
        first = move.rows.now(row), move.cols.now(col)
        last = move.rows.now(row + rows - 1), move.cols.now(col + cols - 1)
        if None in first or None in last:
            return f"{move.now}!{area_name(row, col, rows, cols)} (gone)"
        top, left, bottom, right = (int(place or 0) for place in (*first, *last))
        return f"{move.now}!{area_name(top, left, bottom - top + 1, right - left + 1)}"

    def remarks(self) -> Iterator[str]:
        """What a person should know of it."""
        for move in self.moves:
            if move.title != move.now:
                yield say('the sheet "{title}" is called "{now}" now', title=move.title, now=move.now)
            for shift, axis in ((move.rows, "row"), (move.cols, "column")):
                if shift.count > 0:
                    yield say("{sheet}: {places} inserted", sheet=move.now, places=_places(shift, axis))

    def edits(self, expected: Book) -> Iterator[Edit]:
        """What is a fault: rows or columns that are gone, or that tear a filled range apart."""
        for move in self.moves:
            sheet = expected.sheet(move.title)
            for shift, axis in ((move.rows, "row"), (move.cols, "column")):
                where = say("{sheet} {places}", sheet=move.now, places=_places(shift, axis))
                if shift.count < 0:
                    yield Edit(
                        "deleted",
                        say("{sheet} {places}", sheet=move.title, places=_places(shift, axis)),
                        "",
                        say("missing"),
                    )
                elif (
                    shift.count > 0 and sheet is not None and any(inside(block, shift, axis) for block in sheet.blocks)
                ):
                    yield Edit("inserted", where, "", "", say(" inside a filled range"))


def _places(shift: Shift, axis: str) -> str:
    first, last = shift.at, shift.at + abs(shift.count) - 1
    names = [column_letters(place) if axis == "column" else str(place + 1) for place in (first, last)]
    if first == last:
        return say("column {first}" if axis == "column" else "row {first}", first=names[0])
    return say(
        "columns {first} to {last}" if axis == "column" else "rows {first} to {last}", first=names[0], last=names[1]
    )


def inside(block: Block, shift: Shift, axis: str) -> bool:
    """Whether a shift begins inside a block, and so tears it."""
    first, count = (block.row, block.rows) if axis == "row" else (block.col, block.cols)
    return first < shift.at < first + count


# --- finding them --------------------------------------------------------------------------------------------------

Signature = tuple[tuple[str, ...], bool]
"""What a row or column is known by: its texts in order, and whether it has numbers or formulas."""

EMPTY: Signature = ((), False)
VALUES: Signature = ((), True)


def moves_between(expected: Book, book: Book) -> Moves:
    """What happened to the sheets of `expected` on the way to `book`."""
    return Moves([_move(sheet, other) for sheet, other in _pairs(expected, book)])


def _pairs(expected: Book, book: Book) -> Iterator[tuple[BookSheet, BookSheet]]:
    """Each sheet and what it is now: the one of its title, or one of another title with most of its texts."""
    titles = {sheet.title.casefold() for sheet in expected.sheets}
    strangers = [sheet for sheet in book.sheets if sheet.title.casefold() not in titles]
    for sheet in expected.sheets:
        other = book.sheet(sheet.title)
        if other is None:
            texts = _texts(sheet)
            alike = [(len(texts & _texts(stranger)), stranger) for stranger in strangers]
            count, other = max(alike, key=lambda pair: pair[0], default=(0, None))
            if other is None or 2 * count < len(texts):
                continue
            strangers.remove(other)
        yield sheet, other


def _texts(sheet: BookSheet) -> set[str]:
    return {value for _, _, value in sheet.constants.items() if isinstance(value, str)}


def _move(sheet: BookSheet, other: BookSheet) -> Move:
    rows, cols = (_shift(*(_signatures(each, axis) for each in (sheet, other))) for axis in (0, 1))
    return Move(sheet.title, other.title, rows, cols)


def _signatures(sheet: BookSheet, axis: int) -> list[Signature]:
    texts: dict[int, list[tuple[int, str]]] = {}
    spans = [(block.row, block.rows) if axis == 0 else (block.col, block.cols) for block in sheet.blocks]
    for row, col, value in sheet.constants.items():
        place, across = (row, col) if axis == 0 else (col, row)
        if isinstance(value, str):
            texts.setdefault(place, []).append((across, " ".join(value.split())))
        elif value is not None:
            spans.append((place, 1))
    end = max([*(place + 1 for place in texts), *(first + count for first, count in spans)], default=0)
    valued = np.zeros(end, dtype=bool)  # a table may have a million rows
    for first, count in spans:
        valued[first : first + count] = True
    found = [VALUES if has else EMPTY for has in valued.tolist()]
    for place, words in texts.items():
        found[place] = (tuple(text for _, text in sorted(words)), bool(valued[place]))
    return found


def _shift(was: Sequence[Signature], now: Sequence[Signature]) -> Shift:
    """The one shift with which fewest rows differ; none unless it is better than none. What comes behind is new."""
    best = _differing(was, now), NOTHING
    longer = len(now) - len(was)
    counts = range(1, min(longer, MOST) + 1) if longer > 0 else range(-1, max(longer, -MOST) - 1, -1)
    for count in counts:
        before, behind = list(was), list(now)
        if count > 0:
            cost, at = _cheapest(before, behind, count)
        else:
            cost, at = _cheapest(behind, before, -count)
        if cost < best[0]:
            best = cost, Shift(at, count)
    return best[1]


def _differing(was: Sequence[Signature], now: Sequence[Signature]) -> int:
    padded = [*now, *[EMPTY] * (len(was) - len(now))]
    return sum(one != other for one, other in zip(was, padded, strict=False))


def _cheapest(short: Sequence[Signature], long: Sequence[Signature], count: int) -> tuple[int, int]:
    """(how many differ, place) for the best place at which `count` of `long` are not in `short`."""
    size = min(len(short), len(long) - count)
    left = [0]
    for place in range(size):
        left.append(left[-1] + (short[place] != long[place]))
    right = [0]
    for place in reversed(range(size)):
        right.append(right[-1] + (short[place] != long[place + count]))
    right.reverse()
    unmatched = len(short) - size
    costs = [before + behind for before, behind in zip(left, right, strict=True)]
    lowest = min(costs)
    return lowest + unmatched, costs.index(lowest)


# --- undoing them --------------------------------------------------------------------------------------------------


def undone(book: Book, moves: Moves) -> Book:
    """The book with every cell and reference where it was; cells of inserted rows and columns are left out."""
    if not moves:
        return book
    names = [replace(name, formula=moved_back(name.formula, "", moves)) for name in book.names]
    return replace(book, sheets=[_undone_sheet(sheet, moves) for sheet in book.sheets], names=names)


def _undone_sheet(sheet: BookSheet, moves: Moves) -> BookSheet:
    move = moves.of(sheet.title)
    new = BookSheet(move.title, _undone_cells(sheet.constants, move), [], _undone_cells(sheet.cached, move))
    for block in sheet.blocks:
        new.blocks += moved_block(block, sheet.title, move, moves)
    return new


def moved_block(block: Block, title: str, move: Move, moves: Moves) -> Sequence[Block]:
    """A block of a sheet, which moved so, where it was: one, or cell by cell where the shifts leave it no block."""
    whole = _undone_block(block, title, move, moves)
    return [whole] if whole is not None else [*_undone_pieces(block, title, move, moves)]


def _undone_block(block: Block, title: str, move: Move, moves: Moves) -> Block | None:
    """The block as one, if the shifts leave it one.

    Its first and last cell decide: a shift has one place at which it begins, so what lies between two cells (or two
    references) that it moves alike is moved alike.
    """
    down, right = block.rows - 1, block.cols - 1
    first, last = move.before(block.row, block.col), move.before(block.row + down, block.col + right)
    if first is None or last is None or (last[0] - first[0], last[1] - first[1]) != (down, right):
        return None
    formula = moved_back(block.formula, title, moves)
    if moved_back(shifted(block.formula, down, right), title, moves) != shifted(formula, down, right):
        return None
    return Block(*first, block.rows, block.cols, formula)


def _undone_pieces(block: Block, title: str, move: Move, moves: Moves) -> Iterator[Block]:
    """Cell by cell."""
    for row in range(block.row, block.row + block.rows):
        for col in range(block.col, block.col + block.cols):
            place = move.before(row, col)
            if place is not None:
                formula = shifted(block.formula, row - block.row, col - block.col)
                yield Block(*place, 1, 1, moved_back(formula, title, moves))


def _undone_cells(cells: CellStore, move: Move) -> CellStore:
    if move.in_place:
        return cells
    new = CellStore()
    for row, col, value in cells.items():
        place = move.before(row, col)
        if place is not None:
            new.put(*place, value)
    return new


def moved_back(formula: Node, title: str, moves: Moves) -> Node:
    """A formula (as its own cell has it now) with its references where they were; one to a new cell is #REF!, and a range
    that begins or ends in new rows has those between them that are old."""

    def change(part: Node) -> Node:
        if isinstance(part, CellRef):
            return _ref(part, moves.of(part.sheet or title), part.sheet is None)
        return part

    def ranged(part: Node) -> Node:
        """The end of a range has no sheet of its own: it is that of the start."""
        if not (isinstance(part, RangeRef) and isinstance(part.start, CellRef) and isinstance(part.end, CellRef)):
            return part
        start, end = part.start, replace(part.end, sheet=part.start.sheet or part.end.sheet)
        rows = moves.of(start.sheet or title).rows
        if rows.before(start.row) is None:
            start = replace(start, row=rows.at + rows.count)
        if rows.before(end.row) is None:
            end = replace(end, row=rows.at - 1)
        return RangeRef(start, end) if start.row <= end.row else ErrorValue("#REF!")

    return transform(transform(formula, ranged), change)


def _ref(ref: CellRef, move: Move, own: bool) -> Node:
    place = move.before(ref.row, ref.col)
    if place is None:
        return ErrorValue("#REF!")
    return replace(ref, row=place[0], col=place[1], sheet=None if own else move.title)


class MovedValues:
    """Values of a book, asked for by the places that its cells had before."""

    def __init__(self, values: Any, moves: Moves) -> None:
        self._values, self._moves = values, moves

    def get(self, sheet: str, row: int, col: int) -> Scalar:
        """The value of a cell, None where it is gone."""
        move = self._moves.by_title.get(sheet, Move(sheet, sheet))
        place = move.rows.now(row), move.cols.now(col)
        if place[0] is None or place[1] is None:
            return None
        found: Scalar = self._values.get(move.now, place[0], place[1])
        return found

    def column(self, sheet: str, col: int, first_row: int, last_row: int) -> list[Scalar]:
        """The values of rows first_row..last_row of a column."""
        return [self.get(sheet, row, col) for row in range(first_row, last_row + 1)]

"""A workbook made by hand, turned so that its tables go down: strips of equal formulas, their values, the words around them.

A *line* is a column where tables go down and a row where they go to the right; *pos* counts along it. All formulas here
are written in these coordinates (`CellRef.row` is pos, `CellRef.col` is line), so that everything behind knows one
direction only; `where` and `shown` speak of the cells as the file has them.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from copy import copy
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from livesheet.diagnostics import Fault
from livesheet.engine import Plan, Values, compile_book
from livesheet.engine.layout import Area
from livesheet.engine.values.cells import BLANK, NUMBER, Cells
from livesheet.formula.book import Block, Book, BookSheet, CellStore
from livesheet.formula.nodes import (
    Call,
    CellRef,
    NameRef,
    Node,
    RangeRef,
    Scalar,
    shifted,
    transform,
    walk,
)
from livesheet.formula.printer import print_formula
from livesheet.formula.references import area_name
from mechsheet.library.routines import with_routines

Array: TypeAlias = NDArray[np.float64]
Place: TypeAlias = tuple[str, int, int]
"""(sheet's title, pos, line)."""

MOST_BLOCKS = 50_000
"""Runs of equal formulas of a workbook that are looked at."""

MOST_APART = 3
"""Cells one after the other, all with the same value, that are no column yet."""

_COMMA = re.compile(r"\s*[+-]?\d+,\d+\s*")


@dataclass(frozen=True, slots=True)
class Stretch:
    """Cells of one line, one after the other."""

    sheet: str
    line: int
    start: int
    length: int

    @property
    def end(self) -> int:
        """The position after the last one."""
        return self.start + self.length

    def places(self) -> list[Place]:
        """The cells one by one."""
        return [(self.sheet, pos, self.line) for pos in range(self.start, self.end)]

    def column(self, work: Work, values: Values | None = None) -> Array:
        """Its numbers, NaN where it has none."""
        return work.column(self.sheet, self.start, self.line, self.length, values)

    def where(self, work: Work, lines: int = 1) -> str:
        """Its cells by name; those of several lines beside each other."""
        return work.where(self.sheet, self.start, self.line, self.length, lines)

    def meets(self, other: Stretch) -> bool:
        """Whether the two have cells in common."""
        same_line = (self.sheet, self.line) == (other.sheet, other.line)
        return same_line and self.start < other.end and other.start < self.end

    def begins(self, other: Stretch) -> bool:
        """Whether the other one begins in it."""
        return (self.sheet, self.line) == (other.sheet, other.line) and self.start <= other.start < self.end


@dataclass(frozen=True, slots=True)
class Strip(Stretch):
    """A stretch with equal formulas; `formula` as seen from the first of its cells."""

    formula: Node

    def at(self, pos: int) -> Node:
        """The formula as seen from another position."""
        return shifted(self.formula, pos - self.start)


def turned(node: Node) -> Node:
    """A formula with rows and columns exchanged."""

    def change(part: Node) -> Node:
        if isinstance(part, CellRef):
            return CellRef(part.col, part.row, part.col_abs, part.row_abs, part.sheet)
        return part

    return transform(node, change)


@dataclass
class Work:
    """One workbook.

    across     its tables go to the right
    undecided  formulas were filled in both directions, or in none: they may as well go the other way
    large      it has more runs of formulas than are looked at
    """

    book: Book
    across: bool
    strips: list[Strip]
    large: bool = False
    remarks: list[str] = field(default_factory=list)
    undecided: bool = False

    @cached_property
    def plan(self) -> Plan:
        """The workbook made ready for evaluation."""
        return compile_book(self.book)

    @cached_property
    def values(self) -> Values:
        """Its values as they are."""
        return self.plan.evaluate()

    @cached_property
    def lines(self) -> Mapping[tuple[str, int], list[int]]:
        """The numbers of the strips of each line."""
        found: dict[tuple[str, int], list[int]] = {}
        for number, strip in enumerate(self.strips):
            found.setdefault((strip.sheet, strip.line), []).append(number)
        return found

    def strips_in(self, cells: Stretch) -> list[int]:
        """The numbers of the strips with cells among these."""
        return [n for n in self.lines.get((cells.sheet, cells.line), ()) if self.strips[n].meets(cells)]

    @cached_property
    def ends(self) -> Mapping[str, int]:
        """The position after the last cell of each sheet that is not empty."""
        found = {sheet.title: 0 for sheet in self.book.sheets}
        for sheet in self.book.sheets:
            for row, col, _ in sheet.constants.items():
                found[sheet.title] = max(found[sheet.title], (col if self.across else row) + 1)
        for strip in self.strips:
            found[strip.sheet] = max(found[strip.sheet], strip.end)
        return found

    def strip_at(self, place: Place) -> int | None:
        """The number of the strip that fills a cell."""
        sheet, pos, line = place
        found = self.strips_in(Stretch(sheet, line, pos, 1))
        return found[0] if found else None

    def value(self, place: Place, values: Values | None = None) -> Scalar:
        """What a cell shows."""
        sheet, pos, line = place
        row, col = (line, pos) if self.across else (pos, line)
        return (self.values if values is None else values).get(sheet, row, col)

    def number(self, place: Place, values: Values | None = None) -> float:
        """The number in a cell, NaN for anything else."""
        found = self.value(place, values)
        return found if isinstance(found, float) else math.nan

    @cached_property
    def _sheet_numbers(self) -> Mapping[str, int]:
        return {title: number for number, title in enumerate(self.plan.layout.titles)}

    def _cells(self, sheet: str, start: int, line: int, count: int, values: Values | None) -> Cells:
        """The cells of a part of a line, one after the other."""
        values = self.values if values is None else values
        number = self._sheet_numbers[sheet]
        return values.read(Area(number, line, start, 1, count) if self.across else Area(number, start, line, count, 1))

    def column(self, sheet: str, start: int, line: int, count: int, values: Values | None = None) -> Array:
        """The numbers of a part of a line, NaN for anything else."""
        cells = self._cells(sheet, start, line, count, values)
        numbers = np.array(np.broadcast_to(np.ravel(cells.numbers), count), float)
        if cells.codes is not None:
            numbers[np.broadcast_to(np.ravel(cells.codes), count) != NUMBER] = np.nan
        return numbers

    def filled(self, sheet: str, start: int, line: int, count: int) -> NDArray[np.bool_]:
        """Which cells of a part of a line are not empty."""
        codes = self._cells(sheet, start, line, count, None).codes
        if codes is None:
            return np.ones(count, bool)
        found: NDArray[np.bool_] = np.broadcast_to(np.ravel(codes), count) != BLANK
        return found

    def engine_place(self, place: Place) -> Place:
        """The cell as the engine counts it: (sheet, row, column)."""
        sheet, pos, line = place
        return (sheet, line, pos) if self.across else place

    def where(self, sheet: str, pos: int, line: int, length: int = 1, lines: int = 1) -> str:
        """Cells as messages name them: Sayfa1!B13:B31."""
        area = area_name(line, pos, lines, length) if self.across else area_name(pos, line, length, lines)
        return f"{sheet}!{area}"

    def shown(self, formula: Node, sheet: str = "") -> str:
        """A formula as the sheet has it, without the sheet's own name."""
        node = self.as_written(formula)
        node = turned(node) if self.across else node
        return print_formula(_without_sheet(node, sheet) if sheet else node)

    @cached_property
    def names(self) -> dict[str, Node]:
        """What the names of the workbook stand for, those that are one cell or a part of a line; by folded name."""
        found = {}
        for defined in self.book.names:
            if isinstance(defined.formula, CellRef | RangeRef):
                found[defined.name.casefold()] = turned(defined.formula) if self.across else defined.formula
        return found

    def as_written(self, formula: Node) -> Node:
        """A bound formula with the workbook's names again, where its formulas use names."""
        if not self._uses_names:
            return formula

        def change(part: Node) -> Node:
            return self._name_of.get(part, part) if isinstance(part, CellRef) else part

        return transform(formula, change)

    @cached_property
    def _uses_names(self) -> bool:
        return any(isinstance(part, NameRef) for strip in self.strips for part in walk(strip.formula))

    @cached_property
    def _name_of(self) -> dict[Node, Node]:
        """Anchored cell with its sheet -> its name."""
        found: dict[Node, Node] = {}
        for defined in self.book.names:
            node = self.names.get(defined.name.casefold())
            if isinstance(node, CellRef) and node.sheet is not None:
                found[CellRef(node.row, node.col, True, True, node.sheet)] = NameRef(defined.name)
        return found

    def bound(self, formula: Node, strip: Strip) -> Node:
        """A formula of a strip with cells in place of names, and every reference with its sheet.

        A name of a part of a line means the cell beside the formula, as programs understand it outside of functions that
        take ranges; there it is left as a range.
        """
        return _bound(formula, strip, self.names)


def _without_sheet(node: Node, sheet: str) -> Node:
    return transform(
        node, lambda part: replace(part, sheet=None) if isinstance(part, CellRef) and part.sheet == sheet else part
    )


_OF_RANGES = frozenset(("SUM", "MAX", "MIN", "AVERAGE", "SUMSQ", "COUNT", "PRODUCT", "SUMPRODUCT", "LARGE", "SMALL"))


def _bound(formula: Node, strip: Strip, names: Mapping[str, Node]) -> Node:
    ranged = any(isinstance(part, Call) and part.name in _OF_RANGES for part in walk(formula))

    def change(part: Node) -> Node:
        if isinstance(part, NameRef):
            meant = names.get(part.name.casefold())
            if isinstance(meant, CellRef):
                return replace(meant, sheet=meant.sheet or strip.sheet)
            if isinstance(meant, RangeRef) and not ranged:
                start, end = meant.start, meant.end
                if isinstance(start, CellRef) and isinstance(end, CellRef) and start.col == end.col:
                    return CellRef(strip.start, start.col, False, True, start.sheet or strip.sheet)
            return part if meant is None else meant
        if isinstance(part, CellRef) and part.sheet is None:
            return replace(part, sheet=strip.sheet)
        return part

    found = transform(formula, change)
    return transform(found, _range_of_one_sheet)


def _range_of_one_sheet(part: Node) -> Node:
    """`Sheet1!A1:A9` names its sheet once: both corners are on it."""
    if isinstance(part, RangeRef) and isinstance(part.start, CellRef) and isinstance(part.end, CellRef):
        return RangeRef(part.start, replace(part.end, sheet=part.start.sheet))
    return part


def with_formula(work: Work, strip: Strip, formula: Node) -> Work:
    """The workbook with another formula in the cells of a strip (or of typed cells that it names). Strips that it follows on
    and that have the same formula are one with it from then on."""
    if work.across:
        row, col, rows, cols, node = strip.line, strip.start, 1, strip.length, turned(formula)
    else:
        row, col, rows, cols, node = strip.start, strip.line, strip.length, 1, formula
    book = copy(work.book)
    book.sheets = [
        _with_block(sheet, Block(row, col, rows, cols, node)) if sheet.title == strip.sheet else sheet
        for sheet in work.book.sheets
    ]
    new = replace(strip, formula=formula)
    strips = [one for one in work.strips if one != strip]
    place = work.strips.index(strip) if strip in work.strips else len(strips)
    for one in [work.strips[number] for number in work.lines.get((strip.sheet, strip.line), ())]:
        first, last = sorted((one, new), key=lambda each: each.start)
        same = first.end == last.start and work.bound(first.at(last.start), last) == work.bound(last.formula, last)
        if one != strip and same:
            place -= strips.index(one) < place
            strips.remove(one)
            new = replace(first, length=first.length + last.length)
    strips.insert(place, new)
    return Work(book, work.across, strips, work.large, work.remarks)


def _with_block(sheet: BookSheet, block: Block) -> BookSheet:
    """A sheet with a block in place of all that stands in its cells."""
    blocks = [part for one in sheet.blocks for part in _minus(one, block)]
    constants = CellStore()
    for row, col, value in sheet.constants.items():
        if not (block.row <= row < block.row + block.rows and block.col <= col < block.col + block.cols):
            constants.put(row, col, value)
    return replace(sheet, blocks=[*blocks, block], constants=constants)


def _minus(block: Block, other: Block) -> Iterator[Block]:
    """The parts of a block outside another one's cells."""
    top, left = max(block.row, other.row), max(block.col, other.col)
    bottom = min(block.row + block.rows, other.row + other.rows)
    right = min(block.col + block.cols, other.col + other.cols)
    if top >= bottom or left >= right:
        yield block
        return
    end_row, end_col = block.row + block.rows, block.col + block.cols
    for row, col, last_row, last_col in (
        (block.row, block.col, top, end_col),
        (top, block.col, bottom, left),
        (top, right, bottom, end_col),
        (bottom, block.col, end_row, end_col),
    ):
        if row < last_row and col < last_col:
            formula = shifted(block.formula, row - block.row, col - block.col)
            yield Block(row, col, last_row - row, last_col - col, formula)


def upright(book: Book, to_the_right: bool | None = None, modules: Sequence[Path] = ()) -> Work:
    """A workbook as strips, in the direction in which most of its formulas were filled, if none is said; routines of the
    text are known, and functions of modules in Basic."""
    book = with_routines(book, modules)
    remarks = [str(fault) for fault in _told(book.remarks)] + _numbers_with_commas(book)
    keys: dict[Node, int] = {}
    blocks: list[tuple[str, Block, int]] = []  # sheet, block, number of its formula as seen from A1
    large = False
    for sheet in book.sheets:
        for block in sheet.blocks:
            if block.kind != "fill" and block.rows * block.cols > 1:
                continue  # one array over several cells: no cell of it has a formula of its own
            if len(blocks) == MOST_BLOCKS:
                large = True
                break
            key = keys.setdefault(shifted(block.formula, -block.row, -block.col, wrap=True), len(keys))
            blocks.append((sheet.title, block, key))
    down, right = _directions(blocks)
    across = right > down if to_the_right is None else to_the_right
    formulas = {key: node for node, key in keys.items()}
    order = {sheet.title: number for number, sheet in enumerate(book.sheets)}
    pieces = sorted(_pieces(blocks, across), key=lambda piece: (order[piece[0]], piece[1], piece[2]))
    return Work(
        book, across, list(_strips(pieces, formulas, across)), large, remarks, 2 * min(down, right) >= max(down, right)
    )


def _directions(blocks: Sequence[tuple[str, Block, int]]) -> tuple[int, int]:
    """How many cells have the formula of the cell above, and how many of the cell to their left."""
    by_corner = {(title, block.row, block.col): (block, key) for title, block, key in blocks}
    down = right = 0
    for title, block, key in blocks:
        down += (block.rows - 1) * block.cols
        right += block.rows * (block.cols - 1)
        below = by_corner.get((title, block.row + block.rows, block.col))
        beside = by_corner.get((title, block.row, block.col + block.cols))
        down += block.cols if below is not None and below[1] == key and below[0].cols == block.cols else 0
        right += block.rows if beside is not None and beside[1] == key and beside[0].rows == block.rows else 0
    return down, right


def _pieces(blocks: Iterable[tuple[str, Block, int]], across: bool) -> Iterator[tuple[str, int, int, int, int]]:
    """(sheet, line, first position, length, number of the formula) of each line of each block."""
    for title, block, key in blocks:
        if across:
            yield from ((title, block.row + n, block.col, block.cols, key) for n in range(block.rows))
        else:
            yield from ((title, block.col + n, block.row, block.rows, key) for n in range(block.cols))


def _strips(
    pieces: Iterable[tuple[str, int, int, int, int]], formulas: Mapping[int, Node], across: bool
) -> Iterator[Strip]:
    """Pieces that follow each other on a line with one formula, joined."""
    first: tuple[str, int, int, int] | None = None
    length = 0
    for sheet, line, start, count, key in pieces:
        if first is not None and first == (sheet, line, start - length, key):
            length += count
            continue
        if first is not None:
            yield from _apart(_strip(first, length, formulas, across))
        first, length = (sheet, line, start, key), count
    if first is not None:
        yield from _apart(_strip(first, length, formulas, across))


def _apart(strip: Strip) -> Iterator[Strip]:
    """A strip; as single cells where a few happen to have one formula: two constants one below the other, by names."""
    alike = all(part.row_abs for part in walk(strip.formula) if isinstance(part, CellRef))
    if 1 < strip.length <= MOST_APART and alike:
        yield from (replace(strip, start=pos, length=1) for pos in range(strip.start, strip.end))
    else:
        yield strip


def _strip(first: tuple[str, int, int, int], length: int, formulas: Mapping[int, Node], across: bool) -> Strip:
    sheet, line, pos, key = first
    row, col = (line, pos) if across else (pos, line)
    formula = shifted(formulas[key], row, col, wrap=True)
    return Strip(sheet, line, pos, length, turned(formula) if across else formula)


def _told(remarks: Iterable[Fault]) -> list[Fault]:
    """A few of the reader's remarks: a page of them helps nobody."""
    return list(remarks)[:5]


def _numbers_with_commas(book: Book) -> list[str]:
    """Numbers typed as texts with a decimal comma become numbers in the book; says so, but not of a page of text."""
    count = 0
    for sheet in book.sheets:
        typed = [
            (row, col, value)
            for row, col, value in sheet.constants.items()
            if isinstance(value, str) and _COMMA.fullmatch(value)
        ]
        if typed and not _is_text_only(book, sheet):
            count += len(typed)
        for row, col, value in typed:
            sheet.constants.put(row, col, float(value.replace(",", ".")))
    return [f"comma {count}"] if count else []


def _is_text_only(book: Book, sheet: BookSheet) -> bool:
    """Whether a sheet has neither numbers nor formulas, and no formula elsewhere reads it."""
    if sheet.blocks or any(isinstance(value, float | int) for _, _, value in sheet.constants.items()):
        return False
    title = sheet.title.casefold()
    formulas = [block.formula for other in book.sheets for block in other.blocks]
    formulas += [defined.formula for defined in book.names]
    cells = (part for formula in formulas for part in walk(formula) if isinstance(part, CellRef))
    return not any(cell.sheet is not None and cell.sheet.casefold() == title for cell in cells)


def references(formula: Node) -> Iterator[tuple[CellRef, CellRef]]:
    """The corners of every area that a bound formula reads; a single cell is both of its corners."""
    inside: set[int] = set()
    for part in walk(formula):
        if isinstance(part, RangeRef):
            if isinstance(part.start, CellRef) and isinstance(part.end, CellRef):
                yield part.start, part.end
                inside |= {id(part.start), id(part.end)}
        elif isinstance(part, CellRef) and id(part) not in inside:
            yield part, part

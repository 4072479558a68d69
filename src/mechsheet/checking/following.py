"""Which of the cells that differ from their stored values came first: the others follow from what they read.

Each formula that differs is computed once more beside the book's own sheets, on which all formulas have given way to their
stored values. A file holds these with 15 digits (LibreOffice) or 17: where a formula makes much of a last digit, as a search
does that has come to rest at a limit, it is computed again with those digits moved, and any value between is an answer.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from copy import copy
from dataclasses import dataclass, replace
from typing import Any

from livesheet.engine import steady_plan
from livesheet.formula.book import Block, Book, BookSheet, CellStore
from livesheet.formula.nodes import CellRef, NameRef, Node, Scalar, shifted, transform
from mechsheet.checking.cells_apart import EqualRows, Rounding

DIGITS = 15
"""So many digits of a number LibreOffice writes into a file."""

EXACT = 10
"""A number of so many digits was typed, or counted: no digit of it was lost."""

SAMPLES = 4
"""So many times the last digits are moved, each time others up and others down."""

BEYOND = 4.0
"""And a value may lie so many times farther off than they have led: they are few, and moved each by its most."""

BESIDE = "\u0001"
"""Added to a sheet's title: no program allows it there, so no other sheet is called so."""


@dataclass(frozen=True, slots=True)
class Suspect:
    """A cell that differs, the block it belongs to, and its stored value."""

    sheet: str
    row: int
    col: int
    block: Block
    theirs: Scalar

    @property
    def formula(self) -> Node:
        """The formula as it stands in the cell."""
        if self.block.kind != "fill":
            return self.block.formula
        return shifted(self.block.formula, self.row - self.block.row, self.col - self.block.col)


def explained(
    book: Book, values: Any, suspects: Sequence[Suspect], apart: Callable[[Scalar, Scalar], tuple[str, float]]
) -> list[bool]:
    """For each of the suspects, in the order of sheets, columns and rows, whether it follows from what it reads.

    apart  the measure of two values: ("", size) when they count as equal
    """
    if not suspects:
        return []
    sheets = [_as_stored(sheet, values) for sheet in book.sheets]
    found = _computed(book, sheets, suspects)
    equal, rounding = EqualRows(found, scale=0.0), Rounding(book, found)
    ours = [found.get(each.sheet + BESIDE, each.row, each.col) for each in suspects]
    follows = [
        not apart(mine, each.theirs)[0]
        or rounding.accounts_for(each.formula, each.sheet, mine, each.theirs)
        or equal.has(each.formula, each.sheet, each.theirs)
        for mine, each in zip(ours, suspects, strict=True)
    ]
    open_ones = [
        at for at, known in enumerate(follows) if not known and type(ours[at]) is type(suspects[at].theirs) is float
    ]
    for at, reach in zip(open_ones, _reaches(book, sheets, [suspects[at] for at in open_ones]), strict=True):
        follows[at] = abs(_number(ours[at]) - _number(suspects[at].theirs)) <= BEYOND * reach
    return follows


def _number(value: Scalar) -> float:
    return value if isinstance(value, float) else math.nan


def _computed(book: Book, sheets: Sequence[BookSheet], suspects: Iterable[Suspect]) -> Any:
    """The suspects' formulas, beside the sheets that they read, computed."""
    beside = copy(book)
    beside.sheets = [*sheets, *_formulas(suspects)]
    return steady_plan(beside).evaluate()


# --- what the last digits decide -------------------------------------------------------------------------------------


def _reaches(book: Book, sheets: Sequence[BookSheet], suspects: Sequence[Suspect]) -> list[float]:
    """How far apart what each of the suspects gives is, while the last digits of what it reads are moved."""
    if not suspects:
        return []
    found: list[list[float]] = [[] for _ in suspects]
    for sample in range(SAMPLES):
        values = _computed(book, [_moved(sheet, sample) for sheet in sheets], suspects)
        for each, numbers in zip(suspects, found, strict=True):
            numbers.append(_number(values.get(each.sheet + BESIDE, each.row, each.col)))
    known = ([number for number in numbers if math.isfinite(number)] for numbers in found)
    return [max(numbers) - min(numbers) if numbers else 0.0 for numbers in known]


def _moved(sheet: BookSheet, sample: int) -> BookSheet:
    """The sheet with each number that fills its digits moved by half of the last, up or down as the sample has it; what one
    moves up the next moves down."""
    moved = CellStore()
    for row, col, value in sheet.constants.items():
        up = ((7 * row + 5 * col + row * col >> sample // 2) + sample) % 2
        moved.put(row, col, value if type(value) is not float else value + _half_digit(value) * (1 if up else -1))
    return replace(sheet, constants=moved)


def _half_digit(value: float) -> float:
    """Half of the last digit of a number as it was written; 0 of one that is exact."""
    if value == 0.0 or not math.isfinite(value) or float(f"{value:.{EXACT}g}") == value:
        return 0.0
    return 0.5 * 10.0 ** (math.floor(math.log10(abs(value))) - DIGITS + 1)


# --- the formulas beside their sheets --------------------------------------------------------------------------------


def _as_stored(sheet: BookSheet, values: Any) -> BookSheet:
    """The sheet with the stored values in place of its formulas; a formula without one has its value computed."""
    cells: dict[int, dict[int, Scalar]] = {}
    for block in sheet.blocks:
        for col in range(block.col, block.col + block.cols):
            computed = values.column(sheet.title, col, block.row, block.row + block.rows - 1)
            cells.setdefault(col, {}).update(enumerate(computed, block.row))
    for store in (sheet.constants, sheet.cached):
        for row, col, value in store.items():
            cells.setdefault(col, {})[row] = value
    stored = CellStore()
    for col, column in sorted(cells.items()):
        for row, value in sorted(column.items()):
            if value is not None:
                stored.put(row, col, value)
    return replace(sheet, constants=stored, blocks=[], cached=CellStore())


def _formulas(suspects: Iterable[Suspect]) -> Iterable[BookSheet]:
    """A sheet beside each that has suspects, with their formulas, which read the sheet itself."""
    beside: dict[str, BookSheet] = {}
    whole: set[int] = set()
    last: Suspect | None = None
    for suspect in suspects:
        sheet = beside.get(suspect.sheet)
        if sheet is None:
            sheet = beside[suspect.sheet] = BookSheet(suspect.sheet + BESIDE)
        block = suspect.block
        if block.kind != "fill":
            if id(block) not in whole:
                whole.add(id(block))
                sheet.blocks.append(replace(block, formula=_reading(block.formula, suspect.sheet)))
            continue
        if last is not None and last.block is block and (last.col, last.row + 1) == (suspect.col, suspect.row):
            sheet.blocks[-1] = replace(sheet.blocks[-1], rows=sheet.blocks[-1].rows + 1)
        else:
            sheet.blocks.append(Block(suspect.row, suspect.col, 1, 1, _reading(suspect.formula, suspect.sheet)))
        last = suspect
    return beside.values()


def _reading(formula: Node, title: str) -> Node:
    """A formula whose references without a sheet mean the sheet `title`."""

    def change(part: Node) -> Node:
        if isinstance(part, CellRef | NameRef) and part.sheet is None:
            return replace(part, sheet=title)
        return part

    return transform(formula, change)

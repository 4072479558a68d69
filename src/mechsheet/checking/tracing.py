"""Which of the cells that differ are at fault, and which only follow from others.

A cell follows when its stored value is what its formula gives for the stored values of the cells it reads. So each formula
that differs is computed once more beside the book's own sheets, on which all formulas have given way to their stored values.
When all cells of a file follow, its stored values are a solution of its formulas: what differs then is rounding that grew.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from copy import copy
from dataclasses import dataclass, replace
from typing import Any

from livesheet.engine import steady_plan
from livesheet.formula.book import Block, Book, BookSheet, CellStore
from livesheet.formula.nodes import CellRef, NameRef, Node, Scalar, shifted, transform

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


def explained(
    book: Book, values: Any, suspects: Sequence[Suspect], apart: Callable[[Scalar, Scalar], tuple[str, float]]
) -> list[bool]:
    """For each of the suspects, in the order of sheets, columns and rows, whether it follows from what it reads.

    apart  the measure of two values: ("", size) when they count as equal
    """
    if not suspects:
        return []
    beside = copy(book)
    beside.sheets = [_as_stored(sheet, values) for sheet in book.sheets] + list(_formulas(suspects))
    found = steady_plan(beside).evaluate()
    return [
        not apart(found.get(suspect.sheet + BESIDE, suspect.row, suspect.col), suspect.theirs)[0]
        for suspect in suspects
    ]


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
            formula = shifted(block.formula, suspect.row - block.row, suspect.col - block.col)
            sheet.blocks.append(Block(suspect.row, suspect.col, 1, 1, _reading(formula, suspect.sheet)))
        last = suspect
    return beside.values()


def _reading(formula: Node, title: str) -> Node:
    """A formula whose references without a sheet mean the sheet `title`."""

    def change(part: Node) -> Node:
        if isinstance(part, CellRef | NameRef) and part.sheet is None:
            return replace(part, sheet=title)
        return part

    return transform(formula, change)

"""Formulas of two books side by side: column by column, as trees without what only spelling decides."""

from __future__ import annotations

import math
from bisect import bisect_right
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from itertools import pairwise

from livesheet.formula.book import Block, BookSheet
from livesheet.formula.nodes import (
    ArrayLiteral,
    Binary,
    Call,
    CellRef,
    NameRef,
    Node,
    Number,
    RangeRef,
    Unary,
    children,
    shifted,
    transform,
)

DIGITS = 1e-12
"""Numbers in formulas that differ by less, relatively, are one number in two spellings."""


def neutral(node: Node, title: str) -> Node:
    """The formula without what only spelling decides: capital letters of names, a sheet's own name before a reference."""

    def change(part: Node) -> Node:
        match part:
            case CellRef(sheet=str(sheet)):
                return replace(part, sheet=None if sheet.casefold() == title.casefold() else sheet.casefold())
            case RangeRef(CellRef() as start, CellRef() as end) if replace(end, sheet=start.sheet) == start:
                return start  # gnumeric writes a range of one cell as the cell
            case RangeRef(start, end) if end.sheet is None and start.sheet is not None:
                return RangeRef(start, replace(end, sheet=start.sheet))
            case NameRef(name, sheet):
                return NameRef(name.casefold(), sheet and sheet.casefold())
            case Call(name, args):
                return Call(name.upper(), args)
        return part

    return transform(node, change)


def alike(one: Node | None, other: Node | None) -> bool:
    """Whether two trees are equal, their numbers but for the digits that programs write (LibreOffice 13 in a formula)."""
    pairs = [(one, other)]
    while pairs:
        left, right = pairs.pop()
        if left == right:
            continue
        if left is None or right is None or type(left) is not type(right):
            return False
        if isinstance(left, Number) and isinstance(right, Number):
            if not math.isclose(left.value, right.value, rel_tol=DIGITS):
                return False
            continue
        below = children(left), children(right)
        if not below[0] or len(below[0]) != len(below[1]) or not _same_head(left, right):
            return False
        pairs += zip(*below, strict=True)
    return True


def _same_head(left: Node, right: Node) -> bool:
    """Operator, function or shape, whatever stands below."""
    match left, right:
        case (Unary(op), Unary(other)) | (Binary(op), Binary(other)) | (Call(op), Call(other)):
            return op == other
        case (ArrayLiteral(rows), ArrayLiteral(others)):
            return [len(row) for row in rows] == [len(row) for row in others]
    return type(left) is type(right)


class Formulas:
    """The formulas of a sheet, found by column and row."""

    def __init__(self, sheet: BookSheet | None) -> None:
        self.columns = {} if sheet is None else _by_column(sheet.blocks)

    def block(self, row: int, col: int) -> Block | None:
        """The block that a cell belongs to."""
        column: Sequence[Block] = self.columns.get(col, ())
        index = bisect_right(column, row, key=lambda block: block.row) - 1
        if index < 0 or row >= column[index].row + column[index].rows:
            return None
        return column[index]

    def at(self, row: int, col: int) -> Node | None:
        """The formula of a cell, as seen from there; None where there is none."""
        block = self.block(row, col)
        return None if block is None else formula_of(block, row, col)


def formula_of(block: Block, row: int, col: int) -> Node:
    """A block's formula as one of its cells has it."""
    return shifted(block.formula, row - block.row, col - block.col)


def stretches(ours: Formulas, theirs: Formulas) -> Iterator[tuple[int, int, int]]:
    """(column, first row, row after the last) of cells in which neither side begins another formula."""
    for col in sorted(ours.columns.keys() | theirs.columns.keys()):
        sides = ours.columns.get(col, ()), theirs.columns.get(col, ())
        edges = sorted({edge for side in sides for block in side for edge in (block.row, block.row + block.rows)})
        for start, stop in pairwise(edges):
            yield col, start, stop


def _by_column(blocks: Iterable[Block]) -> dict[int, list[Block]]:
    found: dict[int, list[Block]] = {}
    for block in blocks:
        for col in range(block.col, block.col + block.cols):
            found.setdefault(col, []).append(block)
    return {col: sorted(column, key=lambda block: block.row) for col, column in found.items()}

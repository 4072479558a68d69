"""The texts of a formula filled down: what differs from row to row are row numbers, so the rest is printed once."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from functools import lru_cache
from itertools import repeat
from typing import TypeAlias

from livesheet.formula.nodes import (
    MAX_ROWS,
    Binary,
    Call,
    CellRef,
    NameRef,
    Node,
    RangeRef,
    Unary,
    children,
    shifted,
)
from livesheet.formula.printer import print_formula
from livesheet.workbook import Fill

_MARK = "\0"
"""Stands around the names that are put in the place of references; no formula holds it."""
_FIRST_ROW, _LAST_ROW = 777_776, 888_887
"""Stand-ins for the rows of a reference, found again as 777777 and 888888 in its text."""

Escape = Callable[[str], str]
Piece: TypeAlias = str | Sequence[str]
"""What stands in every row, or one text for each."""
_Part: TypeAlias = str | int
"""Text that is the same in all rows, or the first of the numbers that stand there."""


def rowwise(pieces: Iterable[Piece], rows: int) -> Iterator[str]:
    """The pieces of each row, joined."""
    columns = [repeat(piece, rows) if isinstance(piece, str) else piece for piece in pieces]
    return map("".join, zip(*columns, strict=True)) if columns else repeat("", rows)


@lru_cache(maxsize=64)
def row_numbers(first: int, end: int) -> tuple[str, ...]:
    """first .. end-1 as texts: a band's columns read the same rows again and again."""
    return tuple(map(str, range(first, end)))


class ColumnTexts:
    """The texts of filled columns, escaped, asked for band by band: what is printed of each column is printed once.

    The same as `escape(print_formula(shifted(formula, n), dialect))` of each row n, a hundred times faster.
    """

    def __init__(self, dialect: str, escape: Escape) -> None:
        self.dialect = dialect
        self.escape = escape
        self._known: dict[tuple[int, int], tuple[Node, list[_Part] | None]] = {}

    def pieces(self, fill: Fill, col: int, first: int, last: int) -> list[Piece]:
        """The formulas of one column of a fill in the sheet's rows first..last-1."""
        place = (fill.row, col)
        if place not in self._known:
            formula = shifted(fill.formula, 0, col - fill.col)
            self._known[place] = formula, _parts(formula, range(fill.rows), self.dialect, self.escape)
        rows = range(first - fill.row, last - fill.row)
        return _pieces(*self._known[place], rows, self.dialect, self.escape)

    def rows(self, fill: Fill, col: int, first: int, last: int) -> list[str]:
        """The same, as one text for each row."""
        return list(rowwise(self.pieces(fill, col, first, last), last - first))


def _pieces(formula: Node, parts: list[_Part] | None, rows: range, dialect: str, escape: Escape) -> list[Piece]:
    if parts is None:
        return [[escape(print_formula(shifted(formula, n), dialect)) for n in rows]]
    return [
        part if isinstance(part, str) else row_numbers(rows.start + part, rows.stop + part) for part in parts if part
    ]


def _parts(formula: Node, rows: range, dialect: str, escape: Escape) -> list[_Part] | None:
    """The text of `formula` with a number wherever a row stands; None where a reference leaves the sheet in some row and
    becomes #REF!, or where the text holds the mark itself."""
    moving = list(_moving(formula))
    references = list(dict.fromkeys(moving))
    ends = [row + n for reference in references for row in _rows(reference) for n in (rows.start, rows.stop - 1)]
    if any(not 0 <= row < MAX_ROWS for row in ends):
        return None
    marks: dict[Node, Node] = {ref: NameRef(f"{_MARK}{i}{_MARK}") for i, ref in enumerate(references)}
    pieces = print_formula(_replaced(formula, marks), dialect).split(_MARK)
    if len(pieces) != 1 + 2 * len(moving):
        return None
    parts: list[_Part] = []
    for i, piece in enumerate(pieces):
        # Every second piece is the number of a reference.
        parts += _reference_parts(references[int(piece)], dialect, escape) if i % 2 else [escape(piece)]
    return parts


def _moving(node: Node) -> Iterator[CellRef | RangeRef]:
    """The references that change from row to row; a range counts as one."""
    match node:
        case CellRef() | RangeRef():
            if any(True for _ in _rows(node)):
                yield node
        case _:
            for child in children(node):
                yield from _moving(child)


def _rows(reference: CellRef | RangeRef) -> Iterator[int]:
    """The rows of a reference that move."""
    corners = (reference,) if isinstance(reference, CellRef) else (reference.start, reference.end)
    return (corner.row for corner in corners if not corner.row_abs)


def _replaced(node: Node, marks: dict[Node, Node]) -> Node:
    match node:
        case CellRef() | RangeRef():
            return marks.get(node, node)
        case Unary(op, operand):
            return Unary(op, _replaced(operand, marks))
        case Binary(op, left, right):
            return Binary(op, _replaced(left, marks), _replaced(right, marks))
        case Call(name, args):
            return Call(name, tuple(_replaced(arg, marks) for arg in args))
        case _:
            return node


def _reference_parts(reference: CellRef | RangeRef, dialect: str, escape: Escape) -> list[_Part]:
    """The reference's text, with a number for each row that moves."""
    if isinstance(reference, CellRef):
        text = _printed(replace(reference, row=_LAST_ROW), dialect)
        return _split(text, {_LAST_ROW: reference.row}, escape)
    stand_ins: dict[int, int] = {}
    start, end = reference.start, reference.end
    if not end.row_abs:
        stand_ins[_LAST_ROW] = end.row
        end = replace(end, row=_LAST_ROW)
    if not start.row_abs:
        stand_ins[_FIRST_ROW] = start.row
        start = replace(start, row=_FIRST_ROW)
    return _split(_printed(RangeRef(start, end), dialect), stand_ins, escape)


@lru_cache(maxsize=4096)
def _printed(reference: CellRef | RangeRef, dialect: str) -> str:
    """The text of a reference; the columns of a table are read by many others."""
    return print_formula(reference, dialect)


def _split(text: str, stand_ins: dict[int, int], escape: Escape) -> list[_Part]:
    """The text with its stand-in rows, from the last to the first, replaced by the real ones."""
    tail: list[_Part] = []
    for stand_in, row in stand_ins.items():
        # From the right: the name of a sheet, which stands before, may hold any digits.
        text, _, rest = text.rpartition(str(stand_in + 1))
        tail = [row + 1, escape(rest), *tail]
    return [escape(text), *tail]

"""The texts of a formula filled down: what differs from row to row are row numbers, so the rest is printed once."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import replace
from functools import lru_cache
from itertools import islice

from mechsheet.formula.nodes import (
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
from mechsheet.formula.printer import print_formula
from mechsheet.sheet.workbook import Fill

_MARK = "\0"
"""Stands around the names that are put in the place of references; no formula holds it."""
_FIRST_ROW, _LAST_ROW = 777_776, 888_887
"""Stand-ins for the rows of a reference, found again as 777777 and 888888 in its text."""

Escape = Callable[[str], str]


def texts_down(formula: Node, rows: range, dialect: str, escape: Escape) -> Iterator[str]:
    """The text of `formula` moved down by each number of `rows`, escaped.

    The same as `escape(print_formula(shifted(formula, n), dialect))` for each n, a hundred times faster.
    """
    moving = list(_moving(formula))
    references = list(dict.fromkeys(moving))
    numbers = list(dict.fromkeys(row + 1 for reference in references for row in _rows(reference)))
    fields = {number: f"{{{i}}}" for i, number in enumerate(numbers)}
    ends = [number - 1 + n for number in numbers for n in (rows.start, rows.stop - 1)]
    stays = all(0 <= row < MAX_ROWS for row in ends)
    template = _template(formula, references, fields, dialect, escape, len(moving)) if stays else None
    if template is None:
        # Somewhere a reference leaves the sheet and becomes #REF!.
        return (escape(print_formula(shifted(formula, n), dialect)) for n in rows)
    if not numbers:
        return (template.format() for _ in rows)
    return map(template.format, *(range(rows.start + number, rows.stop + number) for number in numbers))


class ColumnTexts:
    """The texts of filled columns, asked for band by band from the top: each column's template is made once."""

    def __init__(self, dialect: str, escape: Escape) -> None:
        self.dialect = dialect
        self.escape = escape
        self._begun: dict[tuple[int, int], tuple[int, Iterator[str]]] = {}

    def rows(self, fill: Fill, col: int, first: int, last: int) -> list[str]:
        """The formulas of one column of a fill in the sheet's rows first..last-1."""
        start, texts = self._begun.pop((fill.row, col), (-1, iter(())))
        if start != first:
            formula = shifted(fill.formula, 0, col - fill.col)
            texts = texts_down(formula, range(first - fill.row, fill.rows), self.dialect, self.escape)
        found = list(islice(texts, last - first))
        if last < fill.row + fill.rows:
            self._begun[fill.row, col] = last, texts
        return found


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


def _template(
    formula: Node,
    references: list[CellRef | RangeRef],
    fields: dict[int, str],
    dialect: str,
    escape: Escape,
    marked: int,
) -> str | None:
    """The text with a field for each row number; None where it holds the mark itself, beside the `marked` references."""
    marks: dict[Node, Node] = {ref: NameRef(f"{_MARK}{i}{_MARK}") for i, ref in enumerate(references)}
    pieces = print_formula(_replaced(formula, marks), dialect).split(_MARK)
    if len(pieces) != 1 + 2 * marked:
        return None
    # Every second piece is the number of a reference.
    return "".join(
        _reference_template(references[int(piece)], fields, dialect, escape) if i % 2 else _literal(piece, escape)
        for i, piece in enumerate(pieces)
    )


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


def _reference_template(reference: CellRef | RangeRef, fields: dict[int, str], dialect: str, escape: Escape) -> str:
    """The reference's text with a field for each row that moves."""
    if isinstance(reference, CellRef):
        text = _printed(replace(reference, row=_LAST_ROW), dialect)
        return _with_field(text, {_LAST_ROW: reference.row}, fields, escape)
    stand_ins: dict[int, int] = {}
    start, end = reference.start, reference.end
    if not end.row_abs:
        stand_ins[_LAST_ROW] = end.row
        end = replace(end, row=_LAST_ROW)
    if not start.row_abs:
        stand_ins[_FIRST_ROW] = start.row
        start = replace(start, row=_FIRST_ROW)
    return _with_field(_printed(RangeRef(start, end), dialect), stand_ins, fields, escape)


@lru_cache(maxsize=4096)
def _printed(reference: CellRef | RangeRef, dialect: str) -> str:
    """The text of a reference; the columns of a table are read by many others."""
    return print_formula(reference, dialect)


def _with_field(text: str, stand_ins: dict[int, int], fields: dict[int, str], escape: Escape) -> str:
    """The text with its stand-in rows, from the last to the first, replaced by the fields of the real ones."""
    tail = ""
    for stand_in, row in stand_ins.items():
        # From the right: the name of a sheet, which stands before, may hold any digits.
        text, _, rest = text.rpartition(str(stand_in + 1))
        tail = fields[row + 1] + _literal(rest, escape) + tail
    return _literal(text, escape) + tail


def _literal(text: str, escape: Escape) -> str:
    """The text as a template holds it."""
    return escape(text).replace("{", "{{").replace("}", "}}")

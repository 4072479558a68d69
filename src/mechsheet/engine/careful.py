"""The plain way to evaluate a formula: any kind of value, every error in its place, whole blocks at a time.

This is the definition of what a formula means here; the fast path is held to it by tests. A *frame* is the part of a block
that is being computed; every operand has the frame's shape or one that broadcasts to it (`values.py`).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from ..diagnostics import Fault, WorkbookError
from ..formula.nodes import (
    MAX_COLUMNS,
    MAX_ROWS,
    ArrayLiteral,
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    Missing,
    Node,
    Number,
    RangeRef,
    Text,
    Unary,
)
from ..formula.references import cell_address
from .coerce import compared, each, numbers_of, to_text
from .frames import Frame, Span, UnsupportedError, VaryingSizeError
from .kernels import KERNELS
from .kernels_math import OPERATORS, snapped
from .layout import Area, Layout
from .values import BLANK, NULL, REF, VALUE, Cells, Codes, Numbers, Texts, codes_of, error, finished, first_error

_NOTHING = Cells(np.float64(0), np.uint8(BLANK))
_COMPARISONS = frozenset(("=", "<>", "<", "<=", ">", ">="))


class Evaluator:
    """Evaluates formulas over the flat array of one evaluation."""

    def __init__(self, layout: Layout, numbers: Numbers, codes: Codes, texts: Texts) -> None:
        self.layout = layout
        self.numbers = numbers
        self.codes = codes
        self.texts = texts
        self.sheets = {title: index for index, title in enumerate(layout.titles)}

    def result(self, formula: Node, frame: Frame) -> Cells:
        """What the cells of a frame show: as `value`, with the last + or - snapped and a blank as 0."""
        try:
            with np.errstate(all="ignore"):
                found = self.value(formula, frame)
                if isinstance(formula, Binary) and formula.op in "+-":
                    found = self._snapped(formula, found, frame)
        except (UnsupportedError, RecursionError) as problem:
            place = cell_address(self.layout.titles[frame.sheet], frame.row, frame.col)
            message = str(problem) if isinstance(problem, UnsupportedError) else "a formula nested too deeply"
            raise WorkbookError(Fault(message, key=place)) from problem
        if np.ndim(found.numbers) > 2:
            found = Cells(found.numbers[0, 0], None if found.codes is None else codes_of_all(found)[0, 0])
        if found.codes is not None:
            blank = found.codes == BLANK
            if np.any(blank):
                found = Cells(found.numbers, np.where(blank, np.uint8(0), found.codes))
        return found

    def _snapped(self, formula: Binary, found: Cells, frame: Frame) -> Cells:
        left, _ = numbers_of(self.value(formula.left, frame), self.texts)
        return Cells(snapped(found.numbers, left), found.codes)

    def value(self, node: Node, frame: Frame, spread: bool = False) -> Cells:
        """The value of a tree over a frame. `spread`: a range is an array there; else the cell of it beside the formula."""
        match node:
            case Number(number):
                return Cells(np.float64(number))
            case CellRef():
                return self.cell(node, frame)
            case Binary():
                return self.chain(node, frame, spread)
            case Unary(op, operand):
                return self.signed(op, self.value(operand, frame, spread))
            case Call():
                return self.call(node, frame, spread)
            case RangeRef():
                return self.range(node, frame) if spread else self.beside(node, frame)
            case Text(text):
                return self.texts.constant(text)
            case Boolean(flag):
                return self.texts.constant(flag)
            case ErrorValue():
                return self.texts.constant(node)
            case Missing():
                return self.texts.constant(None)
            case ArrayLiteral():
                return self.literal(node, frame) if spread else self.value(node.rows[0][0], frame)
            case _:
                raise TypeError(f"{node} is not resolved")

    def chain(self, node: Binary, frame: Frame, spread: bool) -> Cells:
        """A run of operators down the left side, in one loop: a sum may have thousands of terms."""
        if node.op == " ":
            return self.shared(node, frame)
        run: list[Binary] = []
        left: Node = node
        while isinstance(left, Binary):
            run.append(left)
            left = left.left
        total = self.value(left, frame, spread)
        for part in reversed(run):
            total = self.operate(part.op, total, self.value(part.right, frame, spread))
        return total

    def operate(self, op: str, left: Cells, right: Cells) -> Cells:
        """An operator between two values."""
        if op in _COMPARISONS:
            return compared(op, left, right, self.texts)
        if op == "&":
            return each(lambda a, b: to_text(a) + to_text(b), (left, right), self.texts)
        if op not in OPERATORS:
            raise UnsupportedError(f"the reference operator {op!r} is not supported here")
        return self.mapped(OPERATORS[op], (left, right))

    def signed(self, op: str, operand: Cells) -> Cells:
        """A sign or `%`."""
        if op == "+":
            return operand
        return self.mapped(np.negative if op == "-" else lambda number: number / 100, (operand,))

    def mapped(self, function: Callable[..., Any], args: tuple[Cells, ...]) -> Cells:
        """A function of numbers over values: errors of arguments first, from the left, then the function's own."""
        pairs = [numbers_of(arg, self.texts) for arg in args]
        codes = first_error(*(pair[1] for pair in pairs))
        found = function(*(pair[0] for pair in pairs))
        if isinstance(found, tuple):
            found, own = found
            codes = first_error(codes, own)
        return finished(found, codes)

    def call(self, node: Call, frame: Frame, spread: bool) -> Cells:
        """A function's value; cell by cell where a range changes its size over the frame."""
        try:
            return KERNELS[node.name](self, node.args, frame, spread)
        except VaryingSizeError:
            if frame.rows == frame.cols == 1:
                raise
        numbers, codes = np.empty((frame.cols, frame.rows)), np.zeros((frame.cols, frame.rows), np.uint8)
        for right in range(frame.cols):
            for down in range(frame.rows):
                found = self.call(node, frame.cell(down, right), spread)
                numbers[right, down] = found.numbers
                codes[right, down] = 0 if found.codes is None else found.codes
        return Cells(numbers.reshape(frame.shape), codes.reshape(frame.shape) if codes.any() else None)

    # references

    def span(self, node: Node, frame: Frame) -> Span | None:
        """What a reference means over the frame, None where it leaves the sheet or names none."""
        start, end = (node.start, node.end) if isinstance(node, RangeRef) else (node, node)
        if not isinstance(start, CellRef) or not isinstance(end, CellRef) or start.sheet is None:
            return None
        several = frame.rows > 1, frame.cols > 1
        if (several[0] and start.row_abs != end.row_abs) or (several[1] and start.col_abs != end.col_abs):
            raise VaryingSizeError
        rows = sorted(ref.row if ref.row_abs else ref.row + frame.down for ref in (start, end))
        cols = sorted(ref.col if ref.col_abs else ref.col + frame.right for ref in (start, end))
        down, right = several[0] and not start.row_abs, several[1] and not start.col_abs
        last = rows[1] + (frame.rows - 1 if down else 0), cols[1] + (frame.cols - 1 if right else 0)
        if last[0] >= MAX_ROWS or last[1] >= MAX_COLUMNS:
            if frame.rows == frame.cols == 1:
                return None
            raise VaryingSizeError
        height, width = rows[1] - rows[0] + 1, cols[1] - cols[0] + 1
        return Span(self.sheets[start.sheet], rows[0], cols[0], height, width, down, right)

    def shared(self, node: Binary, frame: Frame) -> Cells:
        """The cells that two ranges have in common (the operator ` `): #NULL! when there are none."""
        if frame.rows > 1 or frame.cols > 1:
            raise VaryingSizeError
        first, second = self.span(node.left, frame), self.span(node.right, frame)
        if first is None or second is None or first.sheet != second.sheet:
            return error(REF if first is None or second is None else VALUE)
        row, col = max(first.row, second.row), max(first.col, second.col)
        height = min(first.row + first.height, second.row + second.height) - row
        width = min(first.col + first.width, second.col + second.width) - col
        if height < 1 or width < 1:
            return error(NULL)
        return self.spread_out(Span(first.sheet, row, col, height, width, False, False), frame)

    def cell(self, node: CellRef, frame: Frame) -> Cells:
        """A single cell's value over the frame."""
        if frame.rows == 1 and frame.cols == 1 and node.sheet is not None:
            row = node.row if node.row_abs else node.row + frame.down
            col = node.col if node.col_abs else node.col + frame.right
            return self.at(self.sheets[node.sheet], row, col)
        span = self.span(node, frame)
        if span is None:
            return error(REF)
        rows = frame.rows if span.moves_down else 1
        cols = frame.cols if span.moves_right else 1
        if rows == cols == 1:
            return self.at(span.sheet, span.row, span.col)
        found = self.layout.read(Area(span.sheet, span.row, span.col, rows, cols), self.numbers, self.codes)
        if cols == 1:
            return Cells(found.numbers[0], None if found.codes is None else found.codes[0])
        return found

    def at(self, sheet: int, row: int, col: int) -> Cells:
        """The value of one cell, which may lie outside the sheet."""
        place = self.layout.place(sheet, row, col)
        if place < 0:
            return error(REF) if row >= MAX_ROWS or col >= MAX_COLUMNS else _NOTHING
        code = self.codes[place]
        return Cells(self.numbers[place], code if code else None)

    def range(self, node: RangeRef, frame: Frame) -> Cells:
        """A range as an array value, (height, width, cols or 1, rows or 1). Whole columns end with the sheet's data."""
        span = self.span(node, frame)
        return error(REF) if span is None else self.spread_out(span, frame)

    def spread_out(self, span: Span, frame: Frame) -> Cells:
        """The cells of a span as an array value."""
        rows = frame.rows if span.moves_down else 1
        cols = frame.cols if span.moves_right else 1
        area = Area(span.sheet, span.row, span.col, span.height + rows - 1, span.width + cols - 1)
        if not (span.moves_down or span.moves_right):
            area = self.layout.clipped(area)
        found = self.layout.read(area, self.numbers, self.codes)
        shown = _fixed if rows == cols == 1 else _windows
        codes = None if found.codes is None else shown(found.codes, cols, rows)
        return Cells(shown(found.numbers, cols, rows), codes)

    def beside(self, node: RangeRef, frame: Frame) -> Cells:
        """Implicit intersection: of a column the cell in the formula's row, of a row the cell in its column."""
        start, end = node.start, node.end
        if start == end:
            return self.cell(start, frame)
        span = self.span(node, frame.cell(0, 0))
        if span is None:
            return error(REF)
        if span.width == 1 and span.row <= frame.row and frame.row + frame.rows <= span.row + span.height:
            return self.cell(CellRef(frame.row - frame.down, start.col, False, start.col_abs, start.sheet), frame)
        if span.height == 1 and span.col <= frame.col and frame.col + frame.cols <= span.col + span.width:
            return self.cell(CellRef(start.row, frame.col - frame.right, start.row_abs, False, start.sheet), frame)
        if frame.rows == frame.cols == 1:
            return error(VALUE)
        raise VaryingSizeError

    def literal(self, node: ArrayLiteral, frame: Frame) -> Cells:
        """`{1,2;3,4}` as an array value."""
        parts = [[self.value(item, frame) for item in row] for row in node.rows]
        numbers = np.array([[float(cell.numbers) for cell in row] for row in parts])
        codes = np.array([[0 if cell.codes is None else int(cell.codes) for cell in row] for row in parts], np.uint8)
        shape = (*numbers.shape, 1, 1)
        return Cells(numbers.reshape(shape), codes.reshape(shape) if codes.any() else None)


def codes_of_all(cells: Cells) -> Any:
    """The codes in the shape of the numbers."""
    return np.broadcast_to(codes_of(cells), np.shape(cells.numbers))


def _fixed(block: Any, cols: int, rows: int) -> Any:
    """As `_windows`, for a range that is the same in the whole frame."""
    del cols, rows
    return block.T[:, :, None, None]


def _windows(block: Any, cols: int, rows: int) -> Any:
    """(width + cols - 1, height + rows - 1) cells as the windows of a range: (height, width, cols, rows), no copy."""
    views = np.lib.stride_tricks.sliding_window_view(block, (cols, rows))
    return views.swapaxes(0, 1)

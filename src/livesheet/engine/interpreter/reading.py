"""How cells are read over a frame: single cells, ranges as array values, and the one cell of a range beside the formula."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...formula.nodes import MAX_COLUMNS, MAX_ROWS, CellRef, RangeRef
from ..layout import Area, Layout
from ..values.cells import (
    BLANK,
    REF,
    VALUE,
    Cells,
    Codes,
    Frame,
    Numbers,
    Span,
    Texts,
    VaryingSizeError,
    codes_of,
    error,
)
from .environment import Environment

_NOTHING = Cells(np.float64(0), np.uint8(BLANK))
_MOST_WHOLE = 1 << 16
"""Cells of a range that is read as it stands; a larger one ends with the sheet's data."""


class Reading:
    """The flat array of one evaluation, read by references. `around`: what the evaluation knows beyond it."""

    def __init__(
        self, layout: Layout, numbers: Numbers, codes: Codes, texts: Texts, around: Environment | None = None
    ) -> None:
        self.layout = layout
        self.numbers = numbers
        self.codes = codes
        self.texts = texts
        self.sheets = layout.sheets
        self.around = around or Environment()

    def corners(self, node: CellRef | RangeRef, frame: Frame) -> Span | None:
        """The rectangle of a reference as it stands, None where it leaves the sheet."""
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

    def of_span(self, span: Span, frame: Frame, spread: bool) -> Cells:
        """The cells of a rectangle that was only now found: as an array, or the one beside the formula."""
        chosen = span if spread else self._beside_in(span, frame)
        if chosen is None:
            return error(VALUE)
        self.around.need(Area(chosen.sheet, chosen.row, chosen.col, chosen.height, chosen.width))
        return self.spread_out(chosen, frame) if spread else self.at(chosen.sheet, chosen.row, chosen.col)

    @staticmethod
    def _beside_in(span: Span, frame: Frame) -> Span | None:
        """The cell of a rectangle that stands in the formula's row or column."""
        moves = span.moves_down or span.moves_right
        if span.height == span.width == 1 and not moves:
            return span
        if moves or frame.rows > 1 or frame.cols > 1:
            raise VaryingSizeError
        row = span.row if span.height == 1 else frame.row
        col = span.col if span.width == 1 else frame.col
        inside = span.row <= row < span.row + span.height and span.col <= col < span.col + span.width
        if not inside or (span.height > 1 and span.width > 1):
            return None
        return Span(span.sheet, row, col, 1, 1, False, False)

    def joined(self, spans: list[Span], frame: Frame) -> Cells:
        """The cells of several rectangles below one another, as one column."""
        parts = [self.of_span(span, frame, True) for span in spans]
        if any(cells.shape[2:] != (1, 1) for cells in parts):
            raise VaryingSizeError
        numbers = np.concatenate([np.reshape(cells.numbers, (-1, 1, 1, 1)) for cells in parts])
        codes = np.concatenate([np.reshape(codes_of_all(cells), (-1, 1, 1, 1)) for cells in parts])
        return Cells(numbers, codes if codes.any() else None)

    def cell(self, node: CellRef, frame: Frame) -> Cells:
        """A single cell's value over the frame."""
        if frame.rows == 1 and frame.cols == 1 and node.sheet is not None:
            row = node.row if node.row_abs else node.row + frame.down
            col = node.col if node.col_abs else node.col + frame.right
            return self.at(self.sheets[node.sheet], row, col)
        span = self.corners(node, frame)
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
        if self.around.closely:
            self.around.need(Area(sheet, row, col, 1, 1))
        place = self.layout.place(sheet, row, col)
        if place < 0:
            return error(REF) if row >= MAX_ROWS or col >= MAX_COLUMNS else _NOTHING
        code = self.codes[place]
        return Cells(self.numbers[place], code if code else None)

    def range(self, node: RangeRef, frame: Frame) -> Cells:
        """A range as an array value, (height, width, cols or 1, rows or 1). Whole columns end with the sheet's data."""
        span = self.corners(node, frame)
        return error(REF) if span is None else self.spread_out(span, frame)

    def spread_out(self, span: Span, frame: Frame) -> Cells:
        """The cells of a span as an array value."""
        rows = frame.rows if span.moves_down else 1
        cols = frame.cols if span.moves_right else 1
        area = Area(span.sheet, span.row, span.col, span.height + rows - 1, span.width + cols - 1)
        if not (span.moves_down or span.moves_right) and area.rows * area.cols > _MOST_WHOLE:
            area = self.layout.clipped(area)
        if self.around.closely:
            self.around.need(area)
        found = self.layout.read(area, self.numbers, self.codes)
        shown = _fixed if rows == cols == 1 else _windows
        codes = None if found.codes is None else shown(found.codes, cols, rows)
        return Cells(shown(found.numbers, cols, rows), codes)

    def beside(self, node: RangeRef, frame: Frame) -> Cells:
        """Implicit intersection: of a column the cell in the formula's row, of a row the cell in its column."""
        start, end = node.start, node.end
        if start == end:
            return self.cell(start, frame)
        span = self.corners(node, frame.cell(0, 0))
        if span is None:
            return error(REF)
        if span.width == 1 and span.row <= frame.row and frame.row + frame.rows <= span.row + span.height:
            return self.cell(CellRef(frame.row - frame.down, start.col, False, start.col_abs, start.sheet), frame)
        if span.height == 1 and span.col <= frame.col and frame.col + frame.cols <= span.col + span.width:
            return self.cell(CellRef(start.row, frame.col - frame.right, start.row_abs, False, start.sheet), frame)
        if frame.rows == frame.cols == 1:
            return error(VALUE)
        raise VaryingSizeError


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

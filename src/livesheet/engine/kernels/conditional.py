"""Counting and summing under conditions. The ranges are the same for the whole frame in most sheets: then every set of
criteria is tried once."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ...formula.nodes import MAX_COLUMNS, MAX_ROWS, CellRef, Node, RangeRef
from ..interpreter.calling import Args, table_of
from ..interpreter.closures import Evaluation
from ..texts.searching import Test, criterion
from ..values.cells import BLANK, DIV0, ERROR, NUM, NUMBER, VALUE, ArrayArgumentError, Cells, Frame, codes_of, error
from ..values.coerce import once_each, shaped
from .fold import greatest, least, total

_BLANK_CELL = Cells(np.zeros((1, 1)), np.full((1, 1), BLANK, np.uint8))


class Range(NamedTuple):
    """The cells of a range that hold anything, and how large it is with the blank ones beyond them.

    lost  the code of the error that stands in place of the range, as #REF! of a deleted sheet does; else 0
    """

    table: Cells
    height: int
    width: int
    lost: int = 0

    @property
    def size(self) -> tuple[int, int]:
        """Rows and columns."""
        return self.height, self.width


def _range(ev: Evaluation, node: Node, frame: Frame) -> Range:
    table = table_of(ev, node, frame)
    span = ev.span(node, frame)
    if span is not None:
        return Range(table, span.height, span.width)
    code = int(np.max(codes_of(table), initial=0)) if np.size(table.numbers) == 1 else 0
    height, width = table.numbers.shape
    return Range(table, height, width, code if code >= ERROR else 0)


class Selection:
    """The ranges of several criteria: which cells fit them all, and whether the blank ones beyond do."""

    def __init__(self, ranges: list[Range]) -> None:
        self.ranges = ranges
        self.shape = tuple(max(part.table.numbers.shape[axis] for part in ranges) for axis in (0, 1))
        self._known: dict[tuple[int, float, int], Any] = {}

    def fault(self, *further: Range) -> int:
        """The code of the error that stands in place of a range, of these or a further one; that of #VALUE! where not all
        have the same size; else 0."""
        lost = next((part.lost for part in (*further, *self.ranges) if part.lost), 0)
        return lost or (VALUE if len({part.size for part in self.ranges}) > 1 else 0)

    def mask(self, place: int, key: tuple[float, int], ev: Evaluation) -> Any:
        """(mask, beyond) of one criterion."""
        found = self._known.get((place, *key))
        if found is None:
            test = criterion(ev.texts.decode(*key), ev.texts)
            found = self._known[place, *key] = self._tried(test, self.ranges[place].table)
        return found

    def _tried(self, test: Test, table: Cells) -> tuple[Any, bool]:
        mask, beyond = test(table), bool(test(_BLANK_CELL)[0, 0])
        if mask.shape != self.shape:
            whole = np.full(self.shape, beyond)
            whole[: mask.shape[0], : mask.shape[1]] = mask
            mask = whole
        return mask, beyond

    def all(self, keys: tuple[tuple[float, int], ...], ev: Evaluation) -> tuple[Any, bool]:
        """(mask, beyond) of all criteria."""
        parts = [self.mask(place, key, ev) for place, key in enumerate(keys)]
        mask = parts[0][0]
        for part, _ in parts[1:]:
            mask = mask & part
        return mask, all(beyond for _, beyond in parts)


def _stretched(values: Node, like: Node, ev: Evaluation, frame: Frame) -> Node:
    """SUMIF's third argument, as large as the first: from its first cell on."""
    if not isinstance(values, CellRef | RangeRef):
        return values
    start = values.start if isinstance(values, RangeRef) else values
    span = ev.span(like, frame)
    if span is None:
        return values
    row, col = start.row + span.height - 1, start.col + span.width - 1
    if row >= MAX_ROWS or col >= MAX_COLUMNS:
        return values
    return RangeRef(start, CellRef(row, col, start.row_abs, start.col_abs, start.sheet))


def _keyed(
    ev: Evaluation, criteria: Args, frame: Frame, spread: bool, one: Callable[[Any], tuple[float, int]]
) -> Cells:
    """The result for every cell of the frame, from `one(keys of its criteria)`."""
    cells = [ev.value(arg, frame, spread) for arg in criteria]
    if any(np.size(cell.numbers) > 1 and len(cell.shape) > 2 for cell in cells):
        raise ArrayArgumentError
    cells = [
        cell if len(cell.shape) <= 2 else Cells(np.ravel(cell.numbers)[0], np.ravel(codes_of(cell))[0])
        for cell in cells
    ]
    return shaped(*once_each(one, cells))


def _conditional(result: Callable[[Any, Any], tuple[float, int]], values_first: bool) -> Any:
    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        if values_first:
            values, pairs = args[0], args[1:]
        else:
            values, pairs = _stretched(args[2], args[0], ev, frame) if len(args) > 2 else args[0], args[:2]
        if len(pairs) % 2:
            return error(VALUE)
        selection = Selection([_range(ev, node, frame) for node in pairs[::2]])
        summed = _range(ev, values, frame)
        fault = selection.fault(summed)
        if not fault and values_first and summed.size != selection.ranges[0].size:
            fault = VALUE
        if fault:
            return error(fault)
        height = min(selection.shape[0], summed.table.numbers.shape[0])
        width = min(selection.shape[1], summed.table.numbers.shape[1])
        numbers, codes = summed.table.numbers[:height, :width], summed.table.codes[:height, :width]

        def one(keys: tuple[tuple[float, int], ...]) -> tuple[float, int]:
            mask = selection.all(keys, ev)[0][:height, :width]
            bad = np.flatnonzero((codes >= ERROR) & mask)
            if len(bad):
                return np.nan, int(codes.flat[bad[0]])
            return result(numbers.ravel(), (mask & (codes == NUMBER)).ravel())

        return _keyed(ev, pairs[1::2], frame, spread, one)

    return kernel


def counting(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """COUNTIF, COUNTIFS: blank cells beyond the sheet's data count where they fit."""
    if len(args) % 2:
        return error(VALUE)
    selection = Selection([_range(ev, node, frame) for node in args[::2]])
    fault = selection.fault()
    if fault:
        return error(fault)
    outside = selection.ranges[0].height * selection.ranges[0].width - selection.shape[0] * selection.shape[1]

    def one(keys: tuple[tuple[float, int], ...]) -> tuple[float, int]:
        mask, beyond = selection.all(keys, ev)
        return float(np.count_nonzero(mask)) + (outside if beyond else 0), 0

    return _keyed(ev, args[1::2], frame, spread, one)


def _finite(value: float) -> tuple[float, int]:
    return (float(value), 0) if np.isfinite(value) else (np.nan, NUM)


def _mean(numbers: Any, counts: Any) -> tuple[float, int]:
    many = np.count_nonzero(counts)
    return _finite(total(numbers, counts) / many) if many else (np.nan, DIV0)


KERNELS: dict[str, Any] = {
    "COUNTIF": counting, "COUNTIFS": counting,
    "SUMIF": _conditional(lambda n, c: _finite(total(n, c)), False),
    "SUMIFS": _conditional(lambda n, c: _finite(total(n, c)), True),
    "AVERAGEIF": _conditional(_mean, False), "AVERAGEIFS": _conditional(_mean, True),
    "MINIFS": _conditional(lambda n, c: _finite(least(n, c)), True),
    "MAXIFS": _conditional(lambda n, c: _finite(greatest(n, c)), True),
}  # fmt: skip

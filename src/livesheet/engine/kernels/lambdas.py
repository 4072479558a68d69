"""LET, LAMBDA, and the functions that call a function for the cells, rows or columns of arrays."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...formula.nodes import CellRef, Local, Missing, Node, RangeRef
from ..interpreter.calling import Args, one_number
from ..interpreter.closures import Closure, Evaluation, bound_value
from ..interpreter.regions import gives_region, regions
from ..layout import Area
from ..values.cells import (
    CALC,
    MOST_LISTED,
    NA,
    VALUE,
    Bound,
    Cells,
    Frame,
    Span,
    VaryingSizeError,
    boolean,
    codes_of,
    error,
    too_large,
)
from ..values.coerce import caught


def let(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """LET(name, value, …, result)."""
    if len(args) % 2 == 0 or not all(isinstance(name, Local) for name in args[:-1:2]):
        return error(VALUE)
    node, there = ev.scopes.let(args, frame)
    return ev.value(node, there, spread)


def lambda_(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """LAMBDA that nobody calls: a cell cannot show a function."""
    del ev, args, frame, spread
    return error(CALC)


def isomitted(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """ISOMITTED: whether an argument of the function was left out."""
    del spread
    return boolean(np.bool_(ev.scopes.is_omitted(args[0], frame)))


def _by_itself(frame: Frame) -> None:
    if frame.rows > 1 or frame.cols > 1:
        raise VaryingSizeError


class Table:
    """An array whose parts are handed to a function: as references when it is one, else as cells."""

    def __init__(self, ev: Evaluation, node: Node, frame: Frame) -> None:
        self.ev = ev
        found = regions(ev, node, frame) if gives_region(node) else None
        self.span: Span | None = found[0] if isinstance(found, list) and len(found) == 1 else None
        if self.span is not None:
            area = ev.layout.clipped(Area(*self.span[:5]))
            ev.around.need(area)
            self.height, self.width = area.rows, area.cols
            return
        cells = ev.value(node, frame, spread=True)
        shape = (1, 1, 1, 1) if len(cells.shape) <= 2 else cells.shape
        self.numbers = np.broadcast_to(cells.numbers, shape)
        self.codes = np.broadcast_to(codes_of(cells), shape)
        self.height, self.width = shape[0], shape[1]

    def part(self, down: int, right: int, height: int, width: int) -> Bound:
        """Some of its cells."""
        if self.span is not None:
            title = self.ev.layout.titles[self.span.sheet]
            row, col = self.span.row + down, self.span.col + right
            first = CellRef(row, col, True, True, title)
            last = CellRef(row + height - 1, col + width - 1, True, True, title)
            return Bound(first if first == last else RangeRef(first, last))
        place = slice(down, down + height), slice(right, right + width)
        numbers, codes = self.numbers[place], self.codes[place]
        if height == width == 1:
            numbers, codes = numbers[0, 0, 0, 0], codes[0, 0, 0, 0]
        return Bound(cells=Cells(numbers, codes if np.any(codes) else None))

    def cell(self, down: int, right: int) -> Bound:
        """One of its cells; #N/A outside it, as arrays of different sizes are joined."""
        down, right = down if self.height > 1 else 0, right if self.width > 1 else 0
        if down >= self.height or right >= self.width:
            return Bound(cells=error(NA))
        return self.part(down, right, 1, 1)


def _value(ev: Evaluation, closure: Closure, args: Sequence[Bound], frame: Frame, spread: bool) -> Cells:
    """The single value that a function gives, #CALC! when it gives an array."""
    found = ev.scopes.called(ev, closure, args, frame, spread)
    if np.size(found.numbers) > 1:
        return error(CALC)
    code = int(np.ravel(codes_of(found))[0])
    return Cells(np.ravel(found.numbers)[0], np.uint8(code) if code else None)


class Collected:
    """Single values put together as an array."""

    def __init__(self, height: int, width: int) -> None:
        self.numbers = np.zeros((height, width, 1, 1))
        self.codes = np.zeros((height, width, 1, 1), np.uint8)

    def put(self, down: int, right: int, cells: Cells) -> None:
        """Set one cell."""
        self.numbers[down, right] = cells.numbers
        self.codes[down, right] = 0 if cells.codes is None else cells.codes

    def cells(self) -> Cells:
        """All of them."""
        return Cells(self.numbers, self.codes if self.codes.any() else None)


def map_(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """MAP(array, …, function of a cell of each)."""
    _by_itself(frame)
    closure = ev.scopes.function(ev, args[-1], frame, len(args) - 1)
    if closure is None:
        return error(VALUE)
    tables = [Table(ev, arg, frame) for arg in args[:-1]]
    height, width = max(table.height for table in tables), max(table.width for table in tables)
    found = Collected(height, width)
    for down in range(height):
        for right in range(width):
            cells = [table.cell(down, right) for table in tables]
            found.put(down, right, _value(ev, closure, cells, frame, spread))
    return found.cells()


def _by(rows: bool) -> Any:
    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        _by_itself(frame)
        closure = ev.scopes.function(ev, args[1], frame, 1)
        if closure is None:
            return error(VALUE)
        table = Table(ev, args[0], frame)
        found = Collected(table.height if rows else 1, 1 if rows else table.width)
        for place in range(table.height if rows else table.width):
            part = table.part(place, 0, 1, table.width) if rows else table.part(0, place, table.height, 1)
            found.put(*((place, 0) if rows else (0, place)), _value(ev, closure, [part], frame, spread))
        return found.cells()

    return kernel


def _along(keep: bool) -> Any:
    """REDUCE, and SCAN which keeps what comes up on the way."""

    def kernel(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
        _by_itself(frame)
        closure = ev.scopes.function(ev, args[2], frame, 2)
        if closure is None:
            return error(VALUE)
        table = Table(ev, args[1], frame)
        found = Collected(table.height, table.width)
        total = None if isinstance(args[0], Missing) else ev.value(args[0], frame, spread)
        for down in range(table.height):
            for right in range(table.width):
                if total is None:  # without a start, the first cell is it
                    total = bound_value(ev, table.cell(down, right), frame, spread)
                else:
                    given = [Bound(cells=total), table.cell(down, right)]
                    if keep:
                        total = _value(ev, closure, given, frame, spread)
                    else:
                        total = ev.scopes.called(ev, closure, given, frame, spread)
                if keep:
                    found.put(down, right, total)
        return found.cells() if keep or total is None else total

    return kernel


def makearray(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """MAKEARRAY(rows, columns, function of row and column)."""
    _by_itself(frame)
    sizes = [int(one_number(ev, arg, frame, spread)) for arg in args[:2]]
    closure = ev.scopes.function(ev, args[2], frame, 2)
    if closure is None or min(sizes) < 1:
        return error(VALUE)
    if sizes[0] * sizes[1] > MOST_LISTED:
        raise too_large(*sizes)
    found = Collected(*sizes)
    for down in range(sizes[0]):
        for right in range(sizes[1]):
            given = [Bound(cells=Cells(np.float64(place + 1))) for place in (down, right)]
            found.put(down, right, _value(ev, closure, given, frame, spread))
    return found.cells()


KERNELS: dict[str, Any] = {
    "LET": let, "LAMBDA": lambda_, "ISOMITTED": isomitted, "MAP": map_, "BYROW": _by(True), "BYCOL": _by(False),
    "REDUCE": _along(False), "SCAN": _along(True), "MAKEARRAY": caught(makearray),
}  # fmt: skip

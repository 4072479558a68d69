"""SUBTOTAL and AGGREGATE: totals that leave out other totals, and rows that are not shown."""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np

from ...formula.nodes import Call, Node, walk
from ..interpreter.calling import Args, one_number, table_of
from ..interpreter.closures import Evaluation
from ..layout import Area
from ..values.cells import (
    BLANK,
    ERROR,
    NUMBER,
    VALUE,
    Cells,
    Frame,
    error,
    finished,
)
from ..values.coerce import caught, numbers_of
from .fold import folded, greatest, least, mean, median, product, ranked, total, united
from .statistics import MODES, SPREADS, percentile, quartile

COUNT, COUNTA = 2, 3
_FOLDS: dict[int, Callable[[Any, Any], Any]] = {
    1: mean, 4: greatest, 5: least, 6: product, 7: SPREADS["STDEV.S"], 8: SPREADS["STDEV.P"], 9: total,
    10: SPREADS["VAR.S"], 11: SPREADS["VAR.P"], 12: median,
}  # fmt: skip
_TOTALS = ("SUBTOTAL", "AGGREGATE")


@lru_cache(maxsize=4096)
def _is_total(formula: Node) -> bool:
    return any(isinstance(part, Call) and part.name in _TOTALS for part in walk(formula))


def _without_totals(ev: Evaluation, node: Node, table: Cells, frame: Frame) -> Cells:
    """A range without the cells that are themselves totals."""
    span = ev.span(node, frame)
    if span is None:
        return table
    height, width = table.numbers.shape
    blocks = ev.layout.blocks
    codes = table.codes
    for number in ev.layout.producers(Area(span.sheet, span.row, span.col, height, width)):
        if number < len(blocks) and _is_total(blocks[number].formula):
            area = ev.layout.block_area(number)
            down, right = area.row - span.row, area.col - span.col
            codes = codes.copy()
            codes[max(0, down) : max(0, down + area.rows), max(0, right) : max(0, right + area.cols)] = BLANK
    return Cells(table.numbers, codes)


def _without_rows(ev: Evaluation, node: Node, table: Cells, frame: Frame, filtered_only: bool) -> Cells:
    """A range without the cells of rows that are hidden, or hidden by a filter."""
    span = ev.span(node, frame)
    sheets = ev.around.book.sheets
    if span is None or span.sheet >= len(sheets):
        return table
    sheet = sheets[span.sheet]
    hidden = sheet.filtered if filtered_only else sheet.hidden
    if not hidden:
        return table
    codes = table.codes.copy()
    for first, end in hidden:
        codes[max(0, first - span.row) : max(0, end - span.row)] = BLANK
    return Cells(table.numbers, codes)


def _together(ev: Evaluation, args: list[Node], frame: Frame, nested: bool, rows: str) -> tuple[Any, Any]:
    """(numbers, codes) of all arguments in one line, without other totals unless `nested`.

    rows  which rows count: "all", "unfiltered" ones, or those "shown"
    """
    tables = [table_of(ev, arg, frame) for arg in args]
    if not nested:
        tables = [_without_totals(ev, arg, table, frame) for arg, table in zip(args, tables, strict=True)]
    if rows != "all":
        pairs = zip(args, tables, strict=True)
        tables = [_without_rows(ev, arg, table, frame, rows == "unfiltered") for arg, table in pairs]
    numbers = np.concatenate([table.numbers.ravel() for table in tables])
    return numbers, np.concatenate([table.codes.ravel() for table in tables])


def _total(function: int, numbers: Any, codes: Any, ignore_errors: bool) -> Cells:
    bad = codes >= ERROR
    if function == COUNT:
        return Cells(np.float64(np.count_nonzero(codes == NUMBER)))
    if function == COUNTA:
        return Cells(np.float64(np.count_nonzero((codes != BLANK) & ~(bad & ignore_errors))))
    if np.any(bad) and not ignore_errors:
        return error(int(codes[np.argmax(bad)]))
    counts = codes == NUMBER
    values = np.where(counts, numbers, 0.0)
    if function == 13:
        return finished(np.float64(MODES(values[counts])))
    return folded(_FOLDS[function], values, counts, None)


def subtotal(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """SUBTOTAL(function, ranges...): other totals inside the ranges do not count.

    1 to 11 leave out the rows that a filter hides, 101 to 111 all hidden rows.
    """
    del spread
    function = int(one_number(ev, args[0], frame, spread=False))
    rows = "shown" if function > 100 else "unfiltered"
    function = function - 100 if function > 100 else function
    if not 1 <= function <= 11:
        return error(VALUE)
    numbers, codes = _together(ev, united(args[1:]), frame, nested=False, rows=rows)
    return _total(function, numbers, codes, ignore_errors=False)


def aggregate(ev: Evaluation, args: Args, frame: Frame, spread: bool) -> Cells:
    """AGGREGATE(function, option, values...): options 2, 3, 6, 7 leave errors out, 0 to 3 totals, odd ones hidden rows."""
    function, option = (int(one_number(ev, arg, frame, spread=False)) for arg in args[:2])
    if not (1 <= function <= 19 and 0 <= option <= 7):
        return error(VALUE)
    ignore_errors = option in (2, 3, 6, 7)
    rows = "shown" if option % 2 else "all"
    if function <= 13:
        numbers, codes = _together(ev, united(args[2:]), frame, nested=option >= 4, rows=rows)
        return _total(function, numbers, codes, ignore_errors)
    if len(args) != 4:
        return error(VALUE)
    numbers, codes = _together(ev, [args[2]], frame, nested=option >= 4, rows=rows)
    bad = codes >= ERROR
    if np.any(bad) and not ignore_errors:
        return error(int(codes[np.argmax(bad)]))
    if function <= 15:
        place, faults = numbers_of(ev.value(args[3], frame, spread), ev.texts)
        found, own = ranked(np.where(bad, 0.0, numbers), codes == NUMBER, place, function == 14)
        return finished(found, own if faults is None else np.where(faults != 0, faults, own))
    share = one_number(ev, args[3], frame, spread)
    rank = percentile if function in (16, 18) else quartile
    return finished(np.float64(rank(numbers[codes == NUMBER], share, function >= 18)))


KERNELS: dict[str, Any] = {"SUBTOTAL": caught(subtotal), "AGGREGATE": caught(aggregate)}

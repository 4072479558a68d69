"""A row of an .xlsx as a pattern of the rows below it: the same columns, kinds of values, and formulas filled down."""

from __future__ import annotations

import re
from functools import partial
from typing import NamedTuple

from livesheet.formula.nodes import MAX_COLUMNS, Scalar
from livesheet.formula.references import column_index

from ..reading.formulas import Run
from ..reading.repeated_rows import (
    LEAST,
    LONGEST,
    NUMBER,
    TEXT,
    Groups,
    Pattern,
    RepeatedRows,
    RowExpression,
    give_numbers,
    give_values,
)
from .scan import SheetScan

_ROW = re.compile(rb'<row r="([1-9][0-9]{0,6})"[^<>]*(?<!/)>')
_HIDDEN = re.compile(rb' hidden="(?:1|true)"')
_CELL = re.compile(
    rb'<c r="([A-Z]{1,3})([1-9][0-9]{0,6})"(?: s="([0-9]+)")?(?: t="([a-zA-Z]+)")?'
    rb'(?:/>|>(?:<f((?: [a-z]+="[^"<&]*")*)(?: ?/>|>([^<]*)</f>))?'
    rb"(?:<v>([^<]+)</v>|<v></v>|<v ?/>|<is><t>([^<]*)</t></is>)?</c>)"
)
_ATTRIBUTE = re.compile(rb' ([a-z]+)="([^"]*)"')

_STYLE = rb"[0-9]++"
_VALUES = {b"n": NUMBER, b"s": rb"[0-9]{1,9}+", b"b": rb"[01]", b"e": rb"#[A-Z0-9/!?_]++"}
_TEXTS = {b"str": 7, b"inlineStr": 8}
"""Kinds of texts, and which group of a cell holds them."""


class Cell(NamedTuple):
    """A cell of the row that has a value: its place among the groups, and what it is."""

    group: int
    col: int
    kind: str
    formula: bool


class RowPattern(Pattern):
    """The rows below a row of a sheet."""

    def __init__(self, scan: SheetScan, expression: RowExpression, cells: list[Cell], runs: dict[int, Run]) -> None:
        super().__init__(expression, runs)
        self._scan = scan
        self._cells = cells

    def next_row(self) -> int | None:
        """The row after the last one, where that is the lowest and all runs go on in it."""
        scan, row = self._scan, self._scan.row + 1
        return row if scan.row >= scan.lowest and scan.runs.all_go_on(self.runs, row) else None

    def take(self, rows: list[Groups]) -> bytes:
        """Put the values of consecutive rows into the sheet; the runs go on."""
        scan, first = self._scan, self._scan.row + 1
        columns = list(zip(*rows, strict=True))
        for group, col, kind, formula in self._cells:
            if kind == "n":
                give_numbers(scan.sheet, first, col, formula, columns[group])
            else:
                value = partial(self._value, kind, col)
                give_values(scan.sheet, first, col, formula, columns[group], value)
        for run in self.runs.values():
            run.end += len(rows)
        scan.row = scan.lowest = first + len(rows) - 1
        scan.told += 1
        # A row without a number is the one after the row that the parser knows.
        return b'<row r="%d"/>' % (scan.row + 1)

    def _value(self, kind: str, col: int, text: bytes, row: int) -> Scalar:
        return self._scan.value(kind, self._scan.package.decoded(text, self._scan.part), row, col)


def rows_of(scan: SheetScan) -> RepeatedRows:
    """What spares the parser of a scan the rows that are like one above."""
    return RepeatedRows(b"</row>", lambda row: row_pattern(scan, row), lambda: scan.rows_begun)


def row_pattern(scan: SheetScan, data: bytes) -> RowPattern | None:
    """The pattern of a row that has just been parsed, None where it cannot be one (yet)."""
    head = _ROW.match(data)
    if (
        head is None
        or _HIDDEN.search(head[0])
        or len(data) > LONGEST
        or int(head[1]) != scan.row + 1
        or scan.row < scan.lowest
    ):
        return None
    expression = RowExpression(data, scan.row)
    expression.number(*head.span(1), 0)
    cells: list[Cell] = []
    runs: dict[int, Run] = {}
    columns: set[int] = set()
    at = head.end()
    while (match := _CELL.match(data, at)) is not None:
        at = match.end()
        col = column_index(match[1].decode())
        kind = match[4] or b"n"
        if match[2] != head[1] or col >= MAX_COLUMNS or col in columns or (kind not in _VALUES and kind not in _TEXTS):
            return None
        columns.add(col)
        expression.number(*match.span(2), 0)
        if match[3] is not None:
            expression.variable(*match.span(3), _STYLE)
        is_formula = match[5] is not None
        if is_formula:
            run = scan.runs.filled_to(col, scan.row, LEAST)
            if run is None or not _formula(expression, match, run):
                return None
            runs[col] = run
        which, values = (_TEXTS[kind], TEXT) if kind in _TEXTS else (7, _VALUES[kind])
        if match[which] is not None:
            if re.fullmatch(values, match[which]) is None:
                return None
            cells.append(Cell(expression.group(*match.span(which), values), col, kind.decode(), is_formula))
        elif kind in _TEXTS or match[8] is not None:
            return None
    if data[at:] != b"</row>" or not columns:
        return None
    return RowPattern(scan, expression, cells, runs)


def _formula(expression: RowExpression, match: re.Match[bytes], run: Run) -> bool:
    """Write the text of a formula; False when it is not what filling down would write in the next row."""
    attributes = dict(_ATTRIBUTE.findall(match[5]))
    if attributes.keys() - {b"t", b"si", b"ca", b"aca", b"bx"}:
        return False
    if run.shared is not None:
        return attributes.get(b"t") == b"shared" and not match[6]
    if b"t" in attributes or not match[6] or run.template is None:
        return False
    return expression.formula(*match.span(6), 0, run.template)

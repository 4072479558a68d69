"""A row of an .ods as a pattern of the rows below it: the same columns, kinds of values, and formulas filled down."""

from __future__ import annotations

import re
from functools import partial
from typing import NamedTuple

from livesheet.formula.nodes import MAX_COLUMNS, Scalar

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
from .scan import ContentScan, Table

ROW = b"table:table-row"
"""The element of rows; files with other prefixes are left to the parser."""
_ROW = re.compile(rb'<table:table-row(?: (?!table:number-rows-repeated|table:visibility)[a-z:-]+="[^"<&]*")*>')
_CELL = re.compile(
    rb'<table:table-cell((?: [a-z:-]+="[^"<\x00-\x1f]*")*)(?:/>|>(?:<text:p>([^<]*)</text:p>)?</table:table-cell>)'
)
_COUNT = re.compile(rb"([0-9]{1,7})\"")
_ATTRIBUTE = re.compile(rb' ([a-z:-]+)="([^"]*)"')
_STYLE, _REPEATED = b"table:style-name", b"table:number-columns-repeated"
_TYPE, _FORMULA = b"office:value-type", b"table:formula"
_LITERAL = {_TYPE, b"calcext:value-type", b"office:string-value", _REPEATED}
_NUMBERS = {b"float", b"percentage", b"currency"}
_VALUES = {b"boolean": b"office:boolean-value", b"date": b"office:date-value", b"time": b"office:time-value"}
"""The attribute that holds the value, by the kind of value."""
_STYLE_NAME = rb'[^"<&\x00-\x1f\xef]*+'
_WORDS = rb"(?:[^<& \x00-\x1f\xef]++(?: [^<& \x00-\x1f\xef]++)*+)?+"
"""A text whose spaces all count."""


class Cell(NamedTuple):
    """A cell of the row that has a value: its place among the groups, and what it is.

    about      its attributes that are the same in all rows;  attribute  the one that differs, None for the text shown
    is_number  whether the value is a plain number;  formula  whether it is that of a formula
    """

    group: int
    col: int
    about: dict[str, str]
    attribute: str | None
    is_number: bool
    formula: bool


class RowPattern(Pattern):
    """The rows below a row of a table."""

    def __init__(self, scan: ContentScan, expression: RowExpression, cells: list[Cell], runs: dict[int, Run]) -> None:
        super().__init__(expression, runs)
        self._scan = scan
        self._table = scan.current
        self._cells = cells

    def next_row(self) -> int | None:
        """The row after the last one, where all runs go on in it."""
        table, row = self._table, self._scan.next_row
        if table is None or self._scan.current is not table:
            return None
        return row if table.runs.all_go_on(self.runs, row) else None

    def take(self, rows: list[Groups]) -> bytes:
        """Put the values of consecutive rows into the table; the runs go on."""
        table, first = self._table, self._scan.next_row
        if table is None:
            raise AssertionError("rows outside a table")
        columns = list(zip(*rows, strict=True))
        for cell in self._cells:
            if cell.is_number:
                give_numbers(table.sheet, first, cell.col, cell.formula, columns[cell.group])
            else:
                value = partial(self._value, table, cell)
                give_values(table.sheet, first, cell.col, cell.formula, columns[cell.group], value)
        for run in self.runs.values():
            run.end += len(rows)
        self._scan.next_row += len(rows)
        return b'<table:table-row table:number-rows-repeated="%d"/>' % len(rows)

    def _value(self, table: Table, cell: Cell, text: bytes, row: int) -> Scalar:
        shown = self._scan.package.decoded(text, "content.xml")
        if cell.attribute is None:
            return self._scan.value(table, row, cell.col, cell.about, shown or None)
        return self._scan.value(table, row, cell.col, {**cell.about, cell.attribute: shown}, None)


def rows_of(scan: ContentScan) -> RepeatedRows:
    """What spares the parser of a scan the rows that are like one above."""
    return RepeatedRows(b"</%s>" % ROW, lambda row: row_pattern(scan, row), lambda: scan.rows_ended)


def row_pattern(scan: ContentScan, data: bytes) -> RowPattern | None:
    """The pattern of a row that has just been parsed, None where it cannot be one (yet)."""
    head = _ROW.match(data)
    if head is None or scan.current is None or len(data) > LONGEST or scan.words.row.encode() != ROW:
        return None
    row = _Row(scan.current, data, scan.next_row - 1)
    at, col = head.end(), 0
    while (match := _CELL.match(data, at)) is not None:
        at = match.end()
        attributes = {found[1]: found.span(2) for found in _ATTRIBUTE.finditer(data, *match.span(1))}
        repeated = _COUNT.match(data, attributes[_REPEATED][0]) if _REPEATED in attributes else None
        if (repeated is None) != (_REPEATED not in attributes) or not row.cell(match, attributes, col):
            return None
        col += 1 if repeated is None else int(repeated[1])
    if data[at:] != b"</%s>" % ROW or not row.cells:
        return None
    return RowPattern(scan, row.expression, row.cells, row.runs)


class _Row:
    """A row on its way to a pattern."""

    def __init__(self, table: Table, data: bytes, row: int) -> None:
        self.expression = RowExpression(data, row)
        self.cells: list[Cell] = []
        self.runs: dict[int, Run] = {}
        self._table, self._data, self._row = table, data, row

    def cell(self, match: re.Match[bytes], attributes: dict[bytes, tuple[int, int]], col: int) -> bool:
        """Write a cell, whose attributes stand there; False where it makes no pattern."""
        kind = self._data[slice(*attributes[_TYPE])] if _TYPE in attributes else b""
        changing = b"office:value" if kind in _NUMBERS else _VALUES.get(kind)
        group = -1
        about: dict[str, str] = {}
        for name, (start, stop) in attributes.items():
            text = self._data[start:stop]
            if name == _STYLE:
                self.expression.variable(start, stop, _STYLE_NAME)
            elif name == _FORMULA:
                if not self._formula(start, stop, col):
                    return False
            elif name == changing:
                values = NUMBER if kind in _NUMBERS else _STYLE_NAME
                if re.fullmatch(values, text) is None:
                    return False
                group = self.expression.group(start, stop, values)
            elif name in _LITERAL and b"&" not in text:
                about[name.decode()] = text.decode()
            else:
                return False
        if kind == b"string":
            if match[2] is None or re.fullmatch(_WORDS, match[2]) is None:
                return False
            group = self.expression.group(*match.span(2), _WORDS)
        elif not kind:
            return _FORMULA not in attributes and not match[2]  # an empty cell
        elif match[2] is not None:
            if match[2].startswith(b"#"):
                return False  # an error as Excel writes it
            self.expression.variable(*match.span(2), rb"(?!#)" + TEXT)
        if group < 0 or _REPEATED in attributes or col >= MAX_COLUMNS:
            return False
        attribute = None if changing is None else changing.decode()
        self.cells.append(Cell(group, col, about, attribute, kind in _NUMBERS, _FORMULA in attributes))
        return True

    def _formula(self, start: int, stop: int, col: int) -> bool:
        """Write the text of a formula; False when it is not what filling down would write in the next row."""
        run = self._table.runs.filled_to(col, self._row, LEAST)
        text = self._data[start:stop]
        if run is None or run.template is None or not text.startswith((b"=", b"of:=")):
            return False
        self.runs[col] = run
        return self.expression.formula(start, stop, text.index(b"=") + 1, run.template)

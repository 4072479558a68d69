"""A row of an .xlsx as a pattern of the rows below it: the same columns, kinds of values, and formulas filled down."""

from __future__ import annotations

import re
from array import array
from typing import TYPE_CHECKING, NamedTuple

from mechsheet.formula.nodes import MAX_COLUMNS, MAX_ROWS, Scalar
from mechsheet.formula.references import column_index

from .fill_runs import Run
from .repeated_rows import Groups

if TYPE_CHECKING:
    from .sheet_scan import SheetScan

_LONGEST = 1 << 14
"""Longer rows make no pattern: compiling it would take as long as parsing very many of them."""
_LEAST = 8
"""Rows that a formula must have been filled down."""
_ROW = re.compile(rb'<row r="([1-9][0-9]{0,6})"[^<>]*(?<!/)>')
_CELL = re.compile(
    rb'<c r="([A-Z]{1,3})([1-9][0-9]{0,6})"(?: s="([0-9]+)")?(?: t="([a-z]+)")?'
    rb'(?:/>|>(?:<f((?: [a-z]+="[^"<&]*")*)(?: ?/>|>([^<]*)</f>))?(?:<v>([^<]*)</v>)?</c>)'
)
_ATTRIBUTE = re.compile(rb' ([a-z]+)="([^"]*)"')
_CHARACTER = re.compile("&[^;]*;|.", re.DOTALL)

ROW_NUMBER = rb"[1-9][0-9]{0,6}+"
_STYLE = rb"[0-9]++"
NUMBER = rb"-?+[0-9]{1,17}+(?:\.[0-9]{1,30}+)?+(?:[eE](?:-[0-9]{1,3}+|\+?+[0-9]{1,2}+))?+"
"""A number whose value is finite whatever it is; the parser takes the others."""
TEXT = rb"[^<&\x00-\x1f\xef]*+"
"""A text without markup and without characters that XML does not allow or changes (some of them begin with EF)."""
_VALUES = {b"n": NUMBER, b"s": rb"[0-9]{1,9}+", b"b": rb"[01]", b"e": rb"#[A-Z0-9/!?_]++", b"str": TEXT}


class Cell(NamedTuple):
    """A cell of the row that has a value: its place among the groups, and what it is."""

    group: int
    col: int
    kind: str
    formula: bool


class RowPattern:
    """The rows below a row of a sheet."""

    def __init__(
        self, scan: SheetScan, source: bytes, cells: list[Cell], runs: dict[int, Run], rows: dict[int, int]
    ) -> None:
        self.expression = re.compile(source)
        self._scan = scan
        self._cells = cells
        self._runs = runs
        # How far a row number is from the row's own -> its group; the row's own comes first.
        self._rows = list(rows.items())

    def ready(self) -> bool:
        """Whether the row after the last one would be the next of all runs."""
        row = self._scan.row + 1
        return self._scan.row >= self._scan.lowest and all(
            self._scan.runs.goes_on(col, run, row) for col, run in self._runs.items()
        )

    def accepts(self, groups: Groups, down: int) -> bool:
        """Whether all row numbers are as far from the row's own as they were."""
        row = self._scan.row + 2 + down
        for offset, group in self._rows:
            if groups[group] != b"%d" % (row + offset):
                return False
        return row <= MAX_ROWS

    def take(self, rows: list[Groups]) -> bytes:
        """Put the values of consecutive rows into the sheet; the runs go on."""
        scan, first = self._scan, self._scan.row + 1
        columns = list(zip(*rows, strict=True))
        for group, col, kind, formula in self._cells:
            texts = columns[group]
            if kind != "n":
                self._put(first, col, kind, formula, texts)
            elif formula:
                scan.sheet.cached.later(first, col, b" ".join(texts))
            else:
                scan.sheet.constants.extend(first, col, array("d", map(float, texts)))
        for run in self._runs.values():
            run.end += len(rows)
        scan.row = scan.lowest = first + len(rows) - 1
        scan.told = True
        # A row without a number is the one after the row that the parser knows.
        return b'<row r="%d"/>' % (scan.row + 1)

    def _put(self, first: int, col: int, kind: str, formula: bool, texts: tuple[bytes, ...]) -> None:
        scan = self._scan
        store = scan.sheet.cached if formula else scan.sheet.constants
        known: dict[bytes, Scalar] = {}
        for row, text in enumerate(texts, first):
            value = known.get(text)
            if value is None:
                value = scan.value(kind, self._decoded(text), row, col)
                if value is None:
                    continue
                known[text] = value
            store.put(row, col, value)

    def _decoded(self, text: bytes) -> str:
        try:
            return text.decode()
        except UnicodeDecodeError as problem:
            message = f"the part is no proper XML (text that is not UTF-8 after row {self._scan.row + 1})"
            raise self._scan.package.fault(message, self._scan.part) from problem


def row_pattern(scan: SheetScan, data: bytes) -> RowPattern | None:
    """The pattern of a row that has just been parsed, None where it cannot be one (yet)."""
    head = _ROW.match(data)
    if head is None or len(data) > _LONGEST or int(head[1]) != scan.row + 1 or scan.row < scan.lowest:
        return None
    writer = _Writer(data, scan.row)
    writer.number(*head.span(1), 0)
    cells: list[Cell] = []
    runs: dict[int, Run] = {}
    columns: set[int] = set()
    at = head.end()
    while (match := _CELL.match(data, at)) is not None:
        at = match.end()
        col = column_index(match[1].decode())
        kind = match[4] or b"n"
        if match[2] != head[1] or col >= MAX_COLUMNS or col in columns or kind not in _VALUES:
            return None
        columns.add(col)
        writer.number(*match.span(2), 0)
        if match[3] is not None:
            writer.variable(*match.span(3), _STYLE)
        is_formula = match[5] is not None
        if is_formula:
            run = scan.runs.filled_to(col, scan.row, _LEAST)
            if run is None or not _formula(writer, match, run):
                return None
            runs[col] = run
        if match[7] is not None:
            if re.fullmatch(_VALUES[kind], match[7]) is None:
                return None
            cells.append(Cell(writer.group(*match.span(7), _VALUES[kind]), col, kind.decode(), is_formula))
    if data[at:] != b"</row>" or not columns:
        return None
    return RowPattern(scan, writer.finished(), cells, runs, writer.rows)


def _formula(writer: _Writer, match: re.Match[bytes], run: Run) -> bool:
    """Write the text of a formula; False when it is not what filling down would write in the next row."""
    attributes = dict(_ATTRIBUTE.findall(match[5]))
    if attributes.keys() - {b"t", b"si", b"ca", b"aca", b"bx"}:
        return False
    if run.shared is not None:
        return attributes.get(b"t") == b"shared" and not match[6]
    if b"t" in attributes or not match[6] or run.template is None:
        return False
    text = match[6].decode()
    pieces = _CHARACTER.findall(text)  # an entity is one character
    places = [match.start(6)]
    for piece in pieces:
        places.append(places[-1] + len(piece.encode()))
    for start, stop, offset in run.template.places(writer.row):
        if stop > len(pieces):
            return False
        writer.number(places[start], places[stop], offset)
    return True


class _Writer:
    """Writes the expression for a row: its bytes as they are, but for numbers of rows, styles and values."""

    def __init__(self, data: bytes, row: int) -> None:
        self.row = row
        self.rows: dict[int, int] = {}
        self._data = data
        self._parts: list[bytes] = []
        self._done = 0
        self._groups = 0

    def variable(self, start: int, stop: int, expression: bytes) -> None:
        """Something that `expression` matches instead of the bytes from `start` to `stop`."""
        self._parts += (re.escape(self._data[self._done : start]), expression)
        self._done = stop

    def group(self, start: int, stop: int, expression: bytes) -> int:
        """The same as a group; its number, from 0."""
        self.variable(start, stop, b"(%s)" % expression)
        self._groups += 1
        return self._groups - 1

    def number(self, start: int, stop: int, offset: int) -> None:
        """The number of the row that is `offset` below the row's own; a group where it comes first."""
        if self._data[start:stop] != b"%d" % (self.row + 1 + offset):
            raise AssertionError("a row number that stands elsewhere")
        if offset in self.rows:
            self.variable(start, stop, rb"(?:\%d)" % (self.rows[offset] + 1))
        else:
            self.rows[offset] = self.group(start, stop, ROW_NUMBER)

    def finished(self) -> bytes:
        """The expression for the whole row."""
        return b"".join((*self._parts, re.escape(self._data[self._done :])))

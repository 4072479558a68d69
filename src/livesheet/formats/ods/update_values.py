"""Writes an .ods back with other values: those of its formula cells and of input cells that were set, nothing else.

Cells and rows that stand for several (`table:number-columns-repeated`) are taken apart where the values come to differ.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from datetime import date
from itertools import groupby
from pathlib import Path
from typing import NamedTuple
from xml.parsers import expat

from livesheet.formula.book import Book
from livesheet.formula.nodes import MAX_ROWS, ErrorValue, Scalar
from livesheet.said import say

from ..new_values import (
    TAG,
    CellValues,
    Edit,
    NewValues,
    Place,
    RawXml,
    Span,
    attributes_named,
    check_output,
    edited,
    end_tag,
    new_values,
    opened,
    with_attributes,
    write_package,
)
from ..reading.package import Package, open_package
from ..xml_text import NULL_DATE, NULL_DATE_1904, number
from .scan import CONTENT, is_cache
from .text import NAMESPACES, paragraphs, result_attributes
from .values import date_text, time_text
from .words import Words, words_of

_VALUE = attributes_named(
    "office:value-type", "office:value", "office:string-value", "office:boolean-value", "office:date-value",
    "office:time-value", "calcext:value-type",
)  # fmt: skip
COLUMNS_REPEATED, ROWS_REPEATED = "table:number-columns-repeated", "table:number-rows-repeated"
_REPEATED = {name: attributes_named(name) for name in (COLUMNS_REPEATED, ROWS_REPEATED)}
_KIND = re.compile(rb"\soffice:value-type\s*=\s*[\"']([a-z]+)")
_MARKUP = re.compile(rb"<[^>]*>")
_SHOWN = re.compile(r"(-?)[0-9]+(?:([.,])([0-9]+))?(%?)")
DECLARATION = f' xmlns:calcext="{NAMESPACES["calcext"]}"'


@dataclass(frozen=True, slots=True)
class CellXml:
    """A cell's element as bytes.

    paragraphs  where its own text stands, start and stop
    before      where a text would stand if it has none
    declared    whether the prefix `calcext` means something there
    """

    data: bytes
    paragraphs: tuple[tuple[int, int], ...]
    before: int
    declared: bool


def with_value(cell: CellXml, value: Scalar, null_date: date) -> bytes:
    """The element with another value; a number keeps the kind of number it was (percentage, date ...)."""
    match = TAG.match(cell.data)
    head = cell.data[: match.end() if match else 0]
    found = _KIND.search(head)
    kind = found[1].decode() if found else ""
    attributes = _attributes(value, kind, null_date)
    if "calcext:" in attributes and not cell.declared:
        attributes += DECLARATION
    new_head = with_attributes(head, _VALUE, attributes)
    old = cell.data[slice(*cell.paragraphs[0])] if cell.paragraphs else None
    text = _text(value, kind, old).encode()
    if len(head) == len(cell.data):
        return opened(new_head) + text + end_tag(head) if text else new_head
    edits = [Edit(0, len(head), new_head)]
    if not cell.paragraphs:
        edits.append(Edit(cell.before, cell.before, text))
    edits += [Edit(start, stop, b"" if n else text) for n, (start, stop) in enumerate(cell.paragraphs)]
    return edited(cell.data, edits)


def _attributes(value: Scalar, kind: str, null_date: date) -> str:
    """The type and value, as attributes."""
    if value is None:
        return ""
    if not isinstance(value, float) or kind not in ("percentage", "currency", "date", "time"):
        return result_attributes(value)
    if kind == "time":
        return f' office:value-type="time" office:time-value="{time_text(value)}"'
    if kind == "date":
        day = date_text(value, null_date)
        return result_attributes(value) if day is None else f' office:value-type="date" office:date-value="{day}"'
    return f' office:value-type="{kind}" office:value="{number(value)}"'


def _text(value: Scalar, kind: str, old: bytes | None) -> str:
    """The paragraphs. Programs show numbers by the cell's format whatever stands here, so a simple text will do."""
    if value is None:
        return ""
    if isinstance(value, str | ErrorValue):
        return paragraphs(str(value))
    if old is None:
        return ""
    if isinstance(value, bool):
        return paragraphs(str(value).upper())
    match = _SHOWN.fullmatch(_MARKUP.sub(b"", old).decode(errors="replace"))
    if match is None or kind in ("date", "time"):
        return paragraphs(f"{value:.15g}")
    _, sign, decimals, percent = match.groups()
    text = f"{value * 100 if percent else value:.{len(decimals or '')}f}"
    return paragraphs(text.replace(".", sign or ".") + percent)


def repeated(element: bytes, name: str, count: int) -> bytes:
    """A cell or row that stands for `count` of its kind; `name` is the attribute that says so."""
    match = TAG.match(element)
    head = element[: match.end() if match else 0]
    return with_attributes(head, _REPEATED[name], f' {name}="{count}"' if count > 1 else "") + element[len(head) :]


class _New(NamedTuple):
    """The value that a cell gets; the name of its type keeps TRUE and 1 apart."""

    value: Scalar
    kind: str


def update_ods(source: Path, output: Path, book: Book, values: CellValues, changes: Mapping[Place, Scalar]) -> None:
    """Copy the workbook `source`, which was read as `book`, to `output` with the values given.

    Every part but content.xml is copied as it is packed; in that one, cells whose value stays keep their bytes. Raises
    WorkbookError and OutputError.
    """
    check_output(source, output)
    new = new_values(book, values, changes)
    null_date = NULL_DATE_1904 if book.date1904 else NULL_DATE
    with open_package(source) as package:
        write_package(package, output, {CONTENT: _ContentUpdate(package, new, null_date).pieces})


@dataclass(slots=True)
class _Cell:
    """A cell's element: where it stands, for how many columns, and what stands in it."""

    start: int
    col: int
    cols: int
    formula: bool
    last: int = -1
    parts: list[tuple[str, Span]] = field(default_factory=list)


@dataclass(slots=True)
class _Row:
    """A row's element, and how many rows and columns it stands for; `start` is -1 between rows."""

    start: int = -1
    last: int = -1
    row: int = 0
    rows: int = 0
    cols: int = 0
    cells: list[_Cell] = field(default_factory=list)


class _ContentUpdate:
    """content.xml while it passes through."""

    def __init__(self, package: Package, sheets: Mapping[str, NewValues], null_date: date) -> None:
        self.package, self.sheets, self.null_date = package, sheets, null_date
        self.raw = RawXml()
        self.declared = False

    def pieces(self) -> Iterator[bytes]:
        """The part with its new values."""
        parser = expat.ParserCreate()
        row = _Row()

        def root(tag: str, attributes: dict[str, str]) -> None:
            del tag
            words = words_of(attributes)
            if words != words_of({}):
                message = say("the part uses other namespace prefixes than usual: it can be read, but not written")
                raise self.package.fault(message, CONTENT)
            self.declared = NAMESPACES["calcext"] in attributes.values()
            _handlers(self, parser, words, row)

        parser.StartElementHandler = root
        for _ in self.package.parsed(CONTENT, parser, before=self.raw.feed):
            yield self.raw.passed(row.start if row.start >= 0 else parser.CurrentByteIndex)
        yield self.raw.passed()

    def row(self, row: _Row, new: NewValues) -> None:
        """A row's element has ended."""
        changed = {place[0] for place in new.changes if row.row <= place[0] < row.row + row.rows}
        formulas = any(cell.formula for cell in row.cells)
        if not formulas and not changed:
            return
        if row.rows == 1:
            for edit in self._edits(row, row.row, new):
                self.raw.replace(edit)
        else:
            here = range(row.row, row.row + row.rows) if formulas else sorted(changed)
            self._take_apart(row, [(self._edits(row, at, new), at) for at in here])

    def _take_apart(self, row: _Row, edits: list[tuple[list[Edit], int]]) -> None:
        """A row that stands for several: one element for every run of rows that stay alike."""
        runs: list[tuple[list[Edit], int]] = []
        at = row.row
        for changes, here in edits:
            runs += [([], here - at), (changes, 1)]
            at = here + 1
        runs.append(([], row.row + row.rows - at))
        if not any(changes for changes, _ in runs):
            return
        stop = self.raw.end(Span(row.start, row.last))
        old = self.raw.cut(row.start, stop)
        new = b""
        for changes, group in groupby((run for run in runs if run[1]), key=lambda run: run[0]):
            new += repeated(edited(old, changes, row.start), ROWS_REPEATED, sum(count for _, count in group))
        self.raw.replace(Edit(row.start, stop, new))

    def _edits(self, row: _Row, here: int, new: NewValues) -> list[Edit]:
        """What changes in a row."""
        found = []
        changed = sorted(col for at, col in new.changes if at == here) if new.changes else []
        for cell in row.cells:
            columns = range(cell.col, cell.col + cell.cols)
            if cell.formula or any(col in columns for col in changed):
                wanted = [_wanted(new, cell, here, col) for col in columns]
                if any(wanted):
                    found.append(self._cell(cell, wanted))
        missing = [col for col in changed if col >= row.cols]
        if missing:
            behind = self._new_cells(missing, here, row.cols, new)
            found.append(self.raw.added(Span(row.start, row.last), behind))
        return found

    def _cell(self, cell: _Cell, wanted: list[_New | None]) -> Edit:
        """The cell's element, or one for each run of columns that get the same."""
        stop = self.raw.end(Span(cell.start, cell.last))
        spans = [(name, part.start - cell.start, self.raw.end(part) - cell.start) for name, part in cell.parts]
        texts = tuple((start, end) for name, start, end in spans if name == "text:p")
        head = self.raw.end_of_tag(cell.start) - cell.start
        # Notes come before a cell's text.
        before = max([head, *(end for name, _, end in spans if name in ("office:annotation", "table:detective"))])
        xml = CellXml(self.raw.cut(cell.start, stop), texts, before, self.declared)
        pieces = b""
        for new, group in groupby(wanted):
            one = xml.data if new is None else with_value(xml, new.value, self.null_date)
            count = len(list(group))
            pieces += one if count == len(wanted) else repeated(one, COLUMNS_REPEATED, count)
        return Edit(cell.start, stop, pieces)

    def _new_cells(self, columns: Iterable[int], row: int, first: int, new: NewValues) -> bytes:
        """Cells that the file has no element for, behind column first - 1."""
        found = b""
        empty = b"<table:table-cell/>"
        for col in columns:
            if col > first:
                found += repeated(empty, COLUMNS_REPEATED, col - first)
            cell = CellXml(empty, (), 0, self.declared)
            found += with_value(cell, new.changes[row, col], self.null_date)
            first = col + 1
        return found

    def rows_behind(self, end: int, place: int, new: NewValues) -> None:
        """Rows that the file has no element for, from row `end` on; they are put at `place`."""
        found = b""
        for row in sorted({at for at, _ in new.changes if at >= end}):
            if row > end:
                gap = b"<table:table-row><table:table-cell/></table:table-row>"
                found += repeated(gap, ROWS_REPEATED, row - end)
            columns = sorted(col for at, col in new.changes if at == row)
            found += b"<table:table-row>" + self._new_cells(columns, row, 0, new) + b"</table:table-row>"
            end = row + 1
        if found:
            self.raw.replace(Edit(place, place, found))


def _wanted(new: NewValues, cell: _Cell, row: int, col: int) -> _New | None:
    """The value that a cell gets, None if it stays as it is."""
    if (row, col) in new.changes:
        value = new.changes[row, col]
    elif cell.formula:
        value = new.result(row, col)
    else:
        return None
    return None if new.is_stored(row, col, value, cell.formula) else _New(value, type(value).__name__)


def _handlers(update: _ContentUpdate, parser: expat.XMLParserType, words: Words, row: _Row) -> None:
    starts: list[int] = []  # of the elements that are open inside the cell
    cell: _Cell | None = None
    new: NewValues | None = None
    skipping = 0
    done = False  # whether the rows of the table have been passed

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal cell, new, skipping, done
        if skipping:
            skipping += 1
        elif cell is not None:
            starts.append(parser.CurrentByteIndex)
        elif tag in words.cells and row.start >= 0:
            cols = _count(attributes.get(COLUMNS_REPEATED))
            cell = _Cell(parser.CurrentByteIndex, row.cols, cols, words.formula in attributes)
        elif tag == words.row and new is not None:
            row.start, row.rows, row.cols = parser.CurrentByteIndex, _count(attributes.get(ROWS_REPEATED)), 0
            row.cells.clear()
        elif tag == words.table:
            title = attributes.get(words.table_name, "")
            if new is not None or is_cache(title):
                skipping = 1
            else:
                new = update.sheets.get(title)
                row.row, done = 0, False
        elif tag in words.passed_over:
            skipping = 1
        elif new is not None and row.row and not done and tag not in words.around_rows:
            update.rows_behind(row.row, parser.CurrentByteIndex, new)
            done = True

    def end(tag: str) -> None:
        nonlocal cell, new, skipping
        if skipping:
            skipping -= 1
        elif starts:
            begun = starts.pop()
            if not starts and cell is not None:
                cell.parts.append((tag, Span(begun, parser.CurrentByteIndex)))
        elif cell is not None:
            cell.last = parser.CurrentByteIndex
            row.cols += cell.cols
            row.cells.append(cell)
            cell = None
        elif tag == words.row and new is not None:
            row.last = parser.CurrentByteIndex
            update.row(row, new)
            row.row += row.rows
            row.start = -1
        elif tag == words.table and new is not None:
            if not done:
                update.rows_behind(row.row, parser.CurrentByteIndex, new)
            new = None

    parser.StartElementHandler = start
    parser.EndElementHandler = end


def _count(text: str | None) -> int:
    """How many times something is repeated; the reader has refused what is no number."""
    return 1 if text is None else min(int(text), 2 * MAX_ROWS)

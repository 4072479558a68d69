"""Writes an .xlsx back with other values: the `<v>` of its formula cells and of input cells that were set, nothing else."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from xml.parsers import expat

from livesheet.formula.book import Book
from livesheet.formula.nodes import ErrorValue, Scalar
from livesheet.formula.references import area_name, cell_name, column_index
from livesheet.said import say

from ..new_values import (
    CellValues,
    Edit,
    NewValues,
    Place,
    RawXml,
    Rewrite,
    Span,
    attributes_named,
    check_output,
    end_tag,
    new_values,
    opened,
    with_attributes,
    write_package,
)
from ..reading.package import Package, local_name, open_package
from ..xml_text import number, ooxml_escaped
from .read import sheet_parts

_TYPE = attributes_named("t")
_AREA = attributes_named("ref")


def update_xlsx(source: Path, output: Path, book: Book, values: CellValues, changes: Mapping[Place, Scalar]) -> None:
    """Copy the workbook `source`, which was read as `book`, to `output` with the values given.

    Every part but the sheets is copied as it is packed; in a sheet, cells whose value stays keep their bytes. Raises
    WorkbookError and OutputError.
    """
    check_output(source, output)
    new = new_values(book, values, changes)
    with open_package(source) as package:
        parts: dict[str, Rewrite] = {
            part: _SheetUpdate(package, part, new[title]).pieces
            for title, part in sheet_parts(package)
            if title in new and not new[title].is_still
        }
        write_package(package, output, parts)


class _SheetUpdate:
    """One sheet's part while it passes through."""

    def __init__(self, package: Package, part: str, new: NewValues) -> None:
        self.package, self.part, self.new = package, part, new
        self.raw = RawXml()
        self.prefix = ""
        self.waiting = deque(sorted(new.changes))
        self.last = (-1, -1)

    def pieces(self) -> Iterator[bytes]:
        """The part with its new values."""
        parser = expat.ParserCreate()
        parser.XmlDeclHandler = self._declaration
        cell = _handlers(self, parser)
        for _ in self.package.parsed(self.part, parser, before=self.raw.feed):
            yield self.raw.passed(cell.start if cell.start >= 0 else parser.CurrentByteIndex)
        yield self.raw.passed()

    def _declaration(self, version: str, encoding: str | None, standalone: int) -> None:
        del version, standalone
        if encoding is not None and encoding.lower() not in ("utf-8", "us-ascii"):
            raise self.package.fault(
                say("the part is written in {encoding}, not in UTF-8", encoding=encoding), self.part
            )

    def passes(self, place: tuple[int, int]) -> None:
        """A cell or row begins. New cells are put between others by their places, which must be in order for that."""
        if self.new.changes and place <= self.last:
            message = say("rows or cells out of order: the sheet can be read, but no other cells can be set in it")
            raise self.package.fault(message, self.part)
        self.last = place

    def before(self, place: tuple[int, int]) -> list[tuple[int, int]]:
        """Cells that were set, come before `place`, and have no element of their own in the file."""
        taken = []
        while self.waiting and self.waiting[0] < place:
            taken.append(self.waiting.popleft())
        return taken

    def is_set(self, row: int, col: int) -> bool:
        """Whether the cell is the next of those that were set."""
        if not self.waiting or self.waiting[0] != (row, col):
            return False
        self.waiting.popleft()
        return True

    def cell(self, row: int, col: int, cell: _Cell, last: int) -> None:
        """The cell's element has ended."""
        was_set, formula = self.is_set(row, col), cell.has("f")
        if not (was_set or formula):
            return
        value = self.new.result(row, col) if formula and not was_set else self.new.changes[row, col]
        size = self.new.areas.get((row, col)) if formula else None
        if size is not None or not self.new.is_stored(row, col, value, formula):
            area = "" if size is None else f' ref="{area_name(row, col, *size)}"'
            self._replace(Span(cell.start, last), cell.parts, value, area)

    def _replace(self, span: Span, parts: Iterable[tuple[str, Span]], value: Scalar, area: str) -> None:
        """Give a cell another value; `area` is the attribute that its array formula gets, "" to leave it."""
        raw = self.raw
        stop, head_stop = raw.end(span), raw.end_of_tag(span.start)
        element = self._element(value)
        head = with_attributes(raw.cut(span.start, head_stop), _TYPE, _type(value))
        if raw.is_empty(span):
            raw.replace(Edit(span.start, stop, opened(head) + element + end_tag(head) if element else head))
            return
        edits = [Edit(span.start, head_stop, head)]
        behind = head_stop
        old: list[Span] = []
        for name, part in parts:
            if name == "f":
                behind = raw.end(part)
                if area:
                    stop = raw.end_of_tag(part.start)
                    edits.append(Edit(part.start, stop, with_attributes(raw.cut(part.start, stop), _AREA, area)))
            elif name in ("v", "is"):
                old.append(part)
        if not old:
            edits.append(Edit(behind, behind, element))
        edits += [Edit(part.start, raw.end(part), b"" if index else element) for index, part in enumerate(old)]
        for edit in sorted(edits):
            raw.replace(edit)

    def cells(self, places: Iterable[tuple[int, int]]) -> bytes:
        """New cells."""
        found = b""
        for row, col in places:
            value = self.new.changes[row, col]
            head = f'<{self.prefix}c r="{cell_name(row, col)}"{_type(value)}>'.encode()
            found += head + self._element(value) + end_tag(head)
        return found

    def rows(self, places: list[tuple[int, int]]) -> bytes:
        """New rows with new cells."""
        found = b""
        for row in dict.fromkeys(row for row, _ in places):
            head = f'<{self.prefix}row r="{row + 1}">'.encode()
            found += head + self.cells(place for place in places if place[0] == row) + end_tag(head)
        return found

    def _element(self, value: Scalar) -> bytes:
        """The `<v>` of a cell, nothing for an empty one."""
        if value is None:
            return b""
        if isinstance(value, bool):
            text = str(int(value))
        elif isinstance(value, float | int):
            text = number(value)
        else:
            text = ooxml_escaped(str(value))
        return f"<{self.prefix}v>{text}</{self.prefix}v>".encode()


def _type(value: Scalar) -> str:
    """The type of a cell as an attribute."""
    if isinstance(value, bool):
        return ' t="b"'
    if isinstance(value, ErrorValue):
        return ' t="e"'
    return ' t="str"' if isinstance(value, str) else ""


class _Cell:
    """The cell that the parser stands in; `start` is -1 between cells."""

    __slots__ = ("parts", "start")

    def __init__(self) -> None:
        self.start = -1
        self.parts: list[tuple[str, Span]] = []

    def has(self, name: str) -> bool:
        """Whether it has such an element in it."""
        return any(part == name for part, _ in self.parts)


def _handlers(update: _SheetUpdate, parser: expat.XMLParserType) -> _Cell:
    cell = _Cell()
    starts: list[int] = []  # of the elements that are open inside the cell
    around: dict[str, int] = {}  # where the row and the table of rows began
    columns: dict[str, int] = {}
    row = col = -1

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal row, col
        if cell.start >= 0:
            starts.append(parser.CurrentByteIndex)
            return
        name = local_name(tag)
        if name == "c":
            cell.start = parser.CurrentByteIndex
            cell.parts.clear()
            letters = attributes.get("r", "").rstrip("0123456789")
            if letters:
                col = columns.get(letters, -1)
                if col < 0:
                    col = columns[letters] = column_index(letters)
            else:
                col += 1
            update.passes((row, col))
            if update.waiting and (places := update.before((row, col))):
                update.raw.replace(Edit(cell.start, cell.start, update.cells(places)))
        elif name == "row":
            row = int(attributes["r"]) - 1 if "r" in attributes else row + 1
            col = -1
            update.passes((row, -1))
            around[name] = parser.CurrentByteIndex
            if update.waiting and (places := update.before((row, 0))):
                update.raw.replace(Edit(around[name], around[name], update.rows(places)))
        elif name == "sheetData":
            update.prefix = tag[: -len(name)]
            around[name] = parser.CurrentByteIndex

    def end(tag: str) -> None:
        if starts:
            begun = starts.pop()
            if not starts:
                cell.parts.append((local_name(tag), Span(begun, parser.CurrentByteIndex)))
        elif cell.start >= 0:
            update.cell(row, col, cell, parser.CurrentByteIndex)
            cell.start = -1
        elif update.waiting and (name := local_name(tag)) in ("row", "sheetData"):
            in_row = name == "row"
            places = update.before((row + 1 if in_row else 1 << 30, 0))
            new = update.cells(places) if in_row else update.rows(places)
            if new:
                update.raw.replace(update.raw.added(Span(around[name], parser.CurrentByteIndex), new))

    parser.StartElementHandler = start
    parser.EndElementHandler = end
    return cell

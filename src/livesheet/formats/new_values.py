"""A workbook's file with other values and nothing else changed: what both formats have in common.

All bytes of the XML stay but for a few places: what was parsed, position by position, and what replaces it.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import NamedTuple, Protocol

from livesheet.diagnostics import Fault, OutputError, readable_name
from livesheet.formula.book import Book, BookSheet
from livesheet.formula.nodes import ErrorValue, Scalar
from livesheet.said import say

from .archive import new_archive
from .reading.package import Package, part_key

TAG = re.compile(rb"<[^<>\"']*(?:(?:\"[^\"]*\"|'[^']*')[^<>\"']*)*>")
"""A start tag, or an end tag."""
_NAME = re.compile(rb"</?([^\s/>]+)")


class Span(NamedTuple):
    """An element as the parser reports it: where its start tag begins, and where its end tag does.

    What is reported as the end of an element without an end tag (`<c/>`) means nothing: see `RawXml.end`.
    """

    start: int
    last: int


class Edit(NamedTuple):
    """Bytes start..stop-1 are replaced by `new`."""

    start: int
    stop: int
    new: bytes


class RawXml:
    """The bytes of a part from some position on, as they come, and the edits that wait for them to pass on."""

    def __init__(self) -> None:
        self._bytes = bytearray()
        self._base = 0
        self._edits: list[Edit] = []

    def feed(self, piece: bytes) -> None:
        """Further bytes."""
        self._bytes += piece

    def cut(self, start: int, stop: int) -> bytes:
        """Bytes start..stop-1 of the part."""
        return bytes(self._bytes[start - self._base : stop - self._base])

    def end_of_tag(self, start: int) -> int:
        """Where the tag that begins at `start` has ended."""
        match = TAG.match(self._bytes, start - self._base)
        if match is None:
            raise ValueError(f"no tag at {start}")
        return match.end() + self._base

    def is_empty(self, span: Span) -> bool:
        """Whether an element has no end tag."""
        stop = self.end_of_tag(span.start)
        return self.cut(stop - 2, stop) == b"/>"

    def end(self, span: Span) -> int:
        """Where an element has ended."""
        return self.end_of_tag(span.start if self.is_empty(span) else span.last)

    def replace(self, edit: Edit) -> None:
        """Note an edit; edits come in the order of their places and do not touch."""
        self._edits.append(edit)

    def added(self, span: Span, new: bytes) -> Edit:
        """The edit that gives an element further content at its end."""
        if not self.is_empty(span):
            return Edit(span.last, span.last, new)
        stop = self.end_of_tag(span.start)
        tag = self.cut(span.start, stop)
        return Edit(span.start, stop, opened(tag) + new + end_tag(tag))

    def passed(self, position: int | None = None) -> bytes:
        """All bytes before `position` (None: all there are) with their edits; they are forgotten here."""
        if position is None:
            position = self._base + len(self._bytes)
        taken = edited(bytes(self._bytes[: position - self._base]), self._edits, self._base)
        self._edits.clear()
        del self._bytes[: position - self._base]
        self._base = position
        return taken


def edited(data: bytes, edits: Iterable[Edit], base: int = 0) -> bytes:
    """`data`, which begins at position `base`, with the edits."""
    pieces: list[bytes] = []
    done = 0
    for start, stop, new in edits:
        pieces += (data[done : start - base], new)
        done = stop - base
    pieces.append(data[done:])
    return b"".join(pieces)


def opened(tag: bytes) -> bytes:
    """The start tag of an element that has content."""
    return tag[:-2].rstrip() + b">" if tag.endswith(b"/>") else tag


def end_tag(tag: bytes) -> bytes:
    """The end tag that belongs to a start tag."""
    match = _NAME.match(tag)
    return b"</" + (match[1] if match else b"") + b">"


def attributes_named(*names: str) -> re.Pattern[bytes]:
    """The pattern of attributes of these names, each with the space before it."""
    wanted = b"|".join(re.escape(name.encode()) for name in names)
    return re.compile(rb"\s+(?:" + wanted + rb")\s*=\s*(?:\"[^\"]*\"|'[^']*')")


def with_attributes(tag: bytes, old: re.Pattern[bytes], text: str) -> bytes:
    """A start tag with attributes, given as ` a="1" b="2"`, in the place of those of the pattern `old`."""
    tag = old.sub(b"", tag)
    end = len(tag) - (2 if tag.endswith(b"/>") else 1)
    return tag[:end].rstrip() + text.encode() + tag[end:]


Place = tuple[str, int, int]
"""Sheet, row, column."""
Rewrite = Callable[[], Iterator[bytes]]


class CellValues(Protocol):
    """Values by sheet title, row and column, as the engine gives them."""

    def get(self, sheet: str, row: int, col: int) -> Scalar:
        """The value of a cell."""
        ...

    def spill(self, sheet: str, row: int, col: int) -> tuple[int, int] | None:
        """Rows and columns of the dynamic array whose formula stands in a cell, None when there is none."""
        ...


class NewValues:
    """What the cells of one sheet shall hold.

    changes  by (row, col): the input cells that were set, and the cells of arrays without their formula
    areas    by (row, col): rows and columns of dynamic arrays that have another size now
    """

    def __init__(self, sheet: BookSheet, values: CellValues, changes: Mapping[Place, Scalar]) -> None:
        self._sheet = sheet
        self._values = values
        title = sheet.title.casefold()
        self.areas: dict[tuple[int, int], tuple[int, int]] = {}
        self._in_arrays = self._arrays()
        self.changes = {(row, col): value for (name, row, col), value in changes.items() if name.casefold() == title}
        self.changes.update({place: value for place, value in self._in_arrays.items() if place not in self.changes})

    def _arrays(self) -> dict[tuple[int, int], Scalar]:
        """The values of cells that hold a part of an array; what a dynamic array has left behind is empty."""
        cells: dict[tuple[int, int], Scalar] = {}
        for block in self._sheet.blocks:
            if block.kind == "fill":
                continue
            size = old = block.rows, block.cols
            if block.kind == "spill":
                size = self._values.spill(self._sheet.title, block.row, block.col) or size
            if size != old:
                self.areas[block.row, block.col] = size
                cells.update(dict.fromkeys(_cells(block.row, block.col, *old), None))
            for row, col in _cells(block.row, block.col, *size):
                cells[row, col] = self.result(row, col)
        formulas = {(block.row, block.col) for block in self._sheet.blocks if block.kind != "fill"}
        stored = self._sheet.cached
        return {
            place: value
            for place, value in cells.items()
            if place not in formulas and (value is not None or stored.get(*place) is not None)
        }

    @property
    def is_still(self) -> bool:
        """Whether the sheet has neither formulas nor changes."""
        return not (self._sheet.blocks or self.changes)

    def result(self, row: int, col: int) -> Scalar:
        """The value of a formula's cell. Files hold finite numbers only."""
        value = self._values.get(self._sheet.title, row, col)
        return value if not isinstance(value, float) or math.isfinite(value) else ErrorValue("#NUM!")

    def is_stored(self, row: int, col: int, value: Scalar, formula: bool) -> bool:
        """Whether the file holds that value already: then the cell's bytes stay."""
        computed = formula or (row, col) in self._in_arrays
        old = (self._sheet.cached if computed else self._sheet.constants).get(row, col)
        return type(old) is type(value) and old == value


def _cells(row: int, col: int, rows: int, cols: int) -> Iterator[tuple[int, int]]:
    return ((row + down, col + right) for down in range(rows) for right in range(cols))


def new_values(book: Book, values: CellValues, changes: Mapping[Place, Scalar]) -> dict[str, NewValues]:
    """The new values of each sheet, by title."""
    return {sheet.title: NewValues(sheet, values, changes) for sheet in book.sheets}


def check_output(source: Path, output: Path) -> None:
    """Raise OutputError when the file to write has another format than the one that was read."""
    if source.suffix.lower() != output.suffix.lower():
        message = say("a recalculated {suffix} is written as {suffix}", suffix=source.suffix)
        raise OutputError(Fault(message, readable_name(output), hint=say("only values are changed, not the format")))


def write_package(package: Package, output: Path, parts: Mapping[str, Rewrite]) -> None:
    """Copy all entries of the zip file as they are but those in `parts`, which are rewritten."""
    wanted = {part_key(part): rewrite for part, rewrite in parts.items()}
    with new_archive(output) as archive:
        archive.comment(package.comment)
        for entry in package.entries():
            rewrite = wanted.get(part_key(entry.filename))
            if rewrite is None:
                archive.copied(entry, package.raw(entry))
            else:
                archive.rewritten(entry, rewrite())
        package.close()  # it may be the file that is replaced now: Windows replaces none that is open

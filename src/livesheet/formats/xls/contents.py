"""What an .xls says of the whole workbook: its sheets, texts, names, and the other workbooks and add-ins it speaks of."""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from typing import Literal

from livesheet.diagnostics import Fault, WorkbookError
from livesheet.said import say

from .records import DamagedError, Kind, Reader, Record, records, shared_texts

BIFF8 = 0x0600
_LIBREOFFICE = "LibreOffice"
"""It gives itself away by the name of the person who saved the file."""
FILTER = "\x0d"
"""The name, of one letter, of the area of a sheet's filter."""


@dataclass(frozen=True, slots=True)
class SheetEntry:
    """A sheet: where its records begin; `cells` is False for charts and macros."""

    title: str
    at: int
    cells: bool


@dataclass(frozen=True, slots=True)
class NameEntry:
    """A defined name: its sheet (an index, None for the book's), its formula's tokens and what belongs to them."""

    name: str
    sheet: int | None
    tokens: bytes
    extra: bytes
    builtin: bool
    function: bool


@dataclass
class OtherBook:
    """A workbook that references speak of: this one itself, an add-in, or another file with its sheets."""

    kind: Literal["own", "add-in", "other"]
    file: str = ""
    sheets: list[str] = field(default_factory=list)
    names: list[str] = field(default_factory=list)


@dataclass
class Contents:
    """What stands before the sheets. `spans`: by number, (book, first sheet, last sheet) of what references name."""

    sheets: list[SheetEntry] = field(default_factory=list)
    texts: list[str] = field(default_factory=list)
    names: list[NameEntry] = field(default_factory=list)
    books: list[OtherBook] = field(default_factory=list)
    spans: list[tuple[int, int, int]] = field(default_factory=list)
    date1904: bool = False
    as_shown: bool = False
    program: str = ""


def contents_of(stream: bytes, file: str) -> Contents:
    """Read what stands before the sheets. Raises WorkbookError, and DamagedError."""
    found = Contents()
    for record in records(stream, 0):
        match record.kind:
            case Kind.BOF:
                if record.at == 0 and struct.unpack_from("<H", record.data)[0] != BIFF8:
                    message = say("a workbook of Excel 95 or older, which is not read")
                    raise WorkbookError(Fault(message, file=file, hint=say("save it as .xlsx")))
            case Kind.PASSWORD:
                message = say("the workbook is protected by a password")
                raise WorkbookError(Fault(message, file=file, hint=say("save it without a password")))
            case Kind.SHEET:
                found.sheets.append(_sheet(record))
            case Kind.SHARED_TEXTS:
                found.texts = shared_texts(record)
            case Kind.NAME:
                found.names.append(_name(record))
            case Kind.SAVED_BY:
                found.program = _LIBREOFFICE if record.data[3:8].rstrip(b"\0 ") == b"Calc" else ""
            case Kind.DATES:
                found.date1904 = record.data[:1] == b"\x01"
            case Kind.PRECISION:
                found.as_shown = record.data[:1] == b"\x00"
            case Kind.BOOK:
                found.books.append(_book(record))
            case Kind.EXTERN_SHEET:
                found.spans += _spans(record)
            case Kind.EXTERN_NAME:
                _extern_name(record, found)
    return found


def _sheet(record: Record) -> SheetEntry:
    reader = Reader(record.pieces)
    at, _, kind, length = reader.unpack("<IBBB")
    return SheetEntry(reader.text(length), at, kind == 0)


def _name(record: Record) -> NameEntry:
    reader = Reader(record.pieces)
    about, _, length, size, _, sheet, _ = reader.unpack("<HBBHHHI")
    name = reader.text(length)
    tokens = reader.take(size)
    return NameEntry(name, sheet - 1 if sheet else None, tokens, reader.rest(), bool(about & 0x20), bool(about & 0x0E))


def _book(record: Record) -> OtherBook:
    reader = Reader(record.pieces)
    count, length = reader.unpack("<HH")
    if length == 0x0401:
        return OtherBook("own")
    if length == 0x3A01:
        return OtherBook("add-in")
    file = _file_name(reader.text(length))
    sheets: list[str] = []
    while len(sheets) < count and not reader.done:
        sheets.append(reader.text(reader.unpack("<H")[0]))
    return OtherBook("other", file, sheets)


def _file_name(coded: str) -> str:
    """The last part of a path as the file codes it: signs below a blank stand for drives and folders."""
    last = coded
    for sign in coded:
        if ord(sign) < 32:
            last = last.rpartition(sign)[2]
    return last.replace("\\", "/").rpartition("/")[2]


def _spans(record: Record) -> list[tuple[int, int, int]]:
    data = record.data
    count = struct.unpack_from("<H", data)[0]
    if len(data) < 2 + 6 * count:
        raise DamagedError(say("a record ends in the middle"))
    return [struct.unpack_from("<HHH", data, 2 + 6 * number) for number in range(count)]


def _extern_name(record: Record, found: Contents) -> None:
    reader = Reader(record.pieces)
    length = reader.unpack("<HIB")[2]
    if found.books:
        found.books[-1].names.append(reader.text(length) if length else "")


def is_biff8(stream: bytes) -> bool:
    """Whether a stream begins as one of Excel 97 to 2003 does, or of another Excel with the same head."""
    return len(stream) >= 6 and struct.unpack_from("<H", stream)[0] == Kind.BOF

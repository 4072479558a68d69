"""Reads .xls files (Excel 97 to 2003) into a book: constants, formulas in blocks, names, the values stored in the file."""

from __future__ import annotations

import struct
from pathlib import Path

from livesheet.diagnostics import Fault, WorkbookError, readable_name
from livesheet.formula.book import Book, BookSheet, DefinedName, Settings
from livesheet.formula.nodes import Foreign, Node
from livesheet.said import reason, say

from ..reading.package import MAX_SHEETS, protected, refuse_what_it_is, settings_remarks, unreadable
from .compound import SIGNATURE, Compound
from .contents import FILTER, Contents, contents_of, is_biff8
from .formulas import ROWS, Formulas, UnreadableError
from .records import DamagedError, Kind, Reader
from .scan import SheetScan

MAX_BYTES = 1 << 29
"""Of a file: a sheet full of numbers takes a quarter of it."""
_OLD = (b"\x09\x00", b"\x09\x02", b"\x09\x04")
"""What a workbook begins with that is older than Excel 5."""
_MACROS = "_VBA_PROJECT_CUR"


def read_xls(path: Path) -> Book:
    """The workbook in a file.

    Raises WorkbookError: no such workbook, a damaged one, a password, an older Excel (one fault), or cells that cannot be
    understood (one fault for each).
    """
    name = readable_name(path)
    stream, macros = _stream(_bytes(path, name), name)
    try:
        return _read(stream, name, macros)
    except (DamagedError, struct.error) as problem:
        why = reason(problem) if isinstance(problem, DamagedError) else say("a record ends in the middle")
        raise WorkbookError(Fault(say("the file is damaged or cut off ({why})", why=why), file=name)) from problem


def _bytes(path: Path, name: str) -> bytes:
    try:
        if path.is_dir():
            raise WorkbookError(Fault(say("this is a folder, not a workbook"), file=name))
        if path.stat().st_size > MAX_BYTES:
            raise WorkbookError(Fault(say("larger than {most} MB: this is no .xls", most=MAX_BYTES >> 20), file=name))
        return path.read_bytes()
    except OSError as problem:
        raise unreadable(name, problem) from problem


def _stream(data: bytes, name: str) -> tuple[bytes, str]:
    """The stream with the workbook, and whether there are macros beside it."""
    if data.startswith(SIGNATURE):
        compound = Compound(data, name)
        if "EncryptedPackage" in compound:
            raise protected(name)
        stream = compound.stream("Workbook")
        if stream is None:
            if "Book" in compound:
                raise _older(name)
            raise WorkbookError(Fault(say("not a workbook: no stream in it is called Workbook"), file=name))
        return stream, "VBA" if _MACROS in compound else ""
    if data.startswith(_OLD):
        raise _older(name)
    if data.startswith(b"PK"):
        raise WorkbookError(
            Fault(say("a zip file with the suffix of an .xls"), file=name, hint=say("rename it to .xlsx or .ods"))
        )
    if not is_biff8(data):
        refuse_what_it_is(data[: 1 << 16], name, say("it does not begin as an .xls does"))
    return data, ""


def _older(name: str) -> WorkbookError:
    return WorkbookError(
        Fault(say("a workbook of Excel 95 or older, which is not read"), file=name, hint=say("save it as .xlsx"))
    )


def _read(stream: bytes, name: str, macros: str) -> Book:
    if not is_biff8(stream):
        raise DamagedError(say("it does not begin as a workbook does"))
    contents = contents_of(stream, name)
    book = Book([], date1904=contents.date1904, source=name, macros=macros, program=contents.program)
    book.settings = Settings(as_shown=contents.as_shown)
    book.remarks += settings_remarks(book.settings, name)
    formulas = Formulas(contents)
    faults: list[Fault] = []
    for number, (sheet, at, end) in _sheets(contents, stream, name).items():
        book.sheets.append(sheet)
        scan = SheetScan(name, sheet, contents.texts, formulas)
        faults += scan.run(stream, at, end)
        book.remarks += scan.faults.remarks
        if scan.filtering:
            _give_filter(contents, number, sheet)
    if faults:
        raise WorkbookError(faults)
    if not book.sheets:
        raise WorkbookError(Fault(say("the workbook has no sheet with cells"), file=name))
    book.names = _names(contents, formulas)
    return book


def _sheets(contents: Contents, stream: bytes, name: str) -> dict[int, tuple[BookSheet, int, int]]:
    """By number (sheet, where its records begin, where they have to be over); charts and macros are passed over."""
    if len(contents.sheets) > MAX_SHEETS:
        raise WorkbookError(
            Fault(
                say("{count} sheets, at most {most} are read", count=len(contents.sheets), most=MAX_SHEETS), file=name
            )
        )
    titles: set[str] = set()
    starts = sorted(entry.at for entry in contents.sheets)
    if len(set(starts)) < len(starts):
        raise DamagedError(say("two sheets in the same place"))
    following = dict(zip(starts, [*starts[1:], len(stream)], strict=False))
    found = {}
    for number, entry in enumerate(contents.sheets):
        if entry.title.casefold() in titles:
            raise WorkbookError(Fault(say('two sheets are called "{title}"', title=entry.title), file=name))
        titles.add(entry.title.casefold())
        if not 0 < entry.at <= len(stream) - 4 or struct.unpack_from("<H", stream, entry.at)[0] != Kind.BOF:
            raise DamagedError(say('the sheet "{title}" is not where the workbook says', title=entry.title))
        if entry.cells:
            found[number] = BookSheet(entry.title), entry.at, following[entry.at]
    return found


def _names(contents: Contents, formulas: Formulas) -> list[DefinedName]:
    """The names that formulas can use. Cells that use one that cannot be read keep their stored values."""
    found: list[DefinedName] = []
    for entry in contents.names:
        if entry.builtin or entry.function or not entry.tokens or entry.name.startswith("_xlnm."):
            continue
        if entry.sheet is not None and entry.sheet >= len(contents.sheets):
            continue
        formula: Node
        try:
            formula = formulas.tree_of_name(entry.tokens, entry.extra)
        except (UnreadableError, DamagedError):
            formula = Foreign(entry.name, say("a name that cannot be read"))
        found.append(
            DefinedName(entry.name, formula, None if entry.sheet is None else contents.sheets[entry.sheet].title)
        )
    return found


def _give_filter(contents: Contents, number: int, sheet: BookSheet) -> None:
    """The hidden rows of a sheet's filter: SUBTOTAL leaves them out always, other hidden rows only if it is asked to."""
    for entry in contents.names:
        if entry.builtin and entry.name == FILTER and entry.sheet == number and len(entry.tokens) >= 7:
            reader = Reader([entry.tokens[3:7]])
            top, bottom = reader.unpack("<HH")
            rows = [(max(top + 1, first), min(bottom + 1, end)) for first, end in sheet.hidden if first < ROWS]
            sheet.filtered = sorted((first, end) for first, end in rows if first < end)

"""Reads .xlsx files of any origin into a book: constants, formulas in blocks, names, and the values stored in the file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from livesheet.diagnostics import Fault, FormulaError, WorkbookError
from livesheet.formula.book import Book, BookSheet, DefinedName, Settings, Table
from livesheet.formula.nodes import Foreign, Node
from livesheet.formula.parser import parse_formula
from livesheet.formula.references import parse_area
from livesheet.said import say

from ..reading.package import (
    MAX_SHEETS,
    Package,
    attribute,
    local_name,
    open_package,
    part_key,
    relationships,
    saved_by,
    settings_remarks,
    unescaped,
)
from .row_pattern import rows_of
from .scan import SheetScan

_OTHERS = (
    ("Index/Document.iwa", say("a spreadsheet of Apple Numbers (.numbers), which is not read")),
    ("Index.zip", say("a spreadsheet of Apple Numbers (.numbers), which is not read")),
    ("word/document.xml", say("a text document (.docx), not a workbook")),
    ("ppt/presentation.xml", say("a presentation (.pptx), not a workbook")),
)
"""Parts of zip files that are no workbooks, and what they are."""
_SHOWN = 60
"""Characters that are shown of a name's formula."""
_WITHOUT_CELLS = ("chartsheet", "dialogsheet", "xlMacrosheet", "xlIntlMacrosheet")
"""Kinds of sheets that are passed over; Excel also lists modules of macros, which link to nothing."""


def read_xlsx(path: Path) -> Book:
    """The workbook in a file.

    Raises WorkbookError: no workbook, a damaged one, a password, parts that are missing or would unpack beyond measure
    (one fault), or cells that cannot be understood (one fault for each).
    """
    with open_package(path) as package:
        return _read(package)


def sheet_parts(package: Package) -> list[tuple[str, str]]:
    """(title, part) of the sheets with cells, in their order."""
    part = _workbook_part(package)
    return _sheet_parts(package, part, _contents(package, part), relationships(package, part))


def _read(package: Package) -> Book:
    part = _workbook_part(package)
    contents = _contents(package, part)
    links = relationships(package, part)
    strings = next((_strings(package, target) for kind, target in links.values() if kind == "sharedStrings"), [])
    macros = "VBA" if any(kind == "vbaProject" for kind, _ in links.values()) else ""
    program = saved_by(package, "docProps/app.xml")
    book = Book([], date1904=contents.date1904, source=package.name, macros=macros, program=program)
    dynamic = _dynamic_marks(package, links)
    faults: list[Fault] = []
    for title, target in _sheet_parts(package, part, contents, links):
        sheet = BookSheet(title)
        book.sheets.append(sheet)
        scan = SheetScan(package, target, sheet, strings, contents.date1904, dynamic)
        book.tables += _tables_of(package, target, title, scan.filters)
        faults += scan.run(rows_of(scan))
        book.remarks += scan.faults.remarks
    if faults:
        raise WorkbookError(faults)
    if not book.sheets:
        raise package.fault(say("the workbook has no sheet with cells"), part)
    book.names = _names(contents)
    book.settings = contents.settings
    book.remarks += settings_remarks(book.settings, book.source)
    return book


def _contents(package: Package, part: str) -> _Workbook:
    contents = _Workbook()
    package.read(part, contents.start, contents.end, contents.pieces)
    return contents


def _sheet_parts(
    package: Package, part: str, contents: _Workbook, links: Mapping[str, tuple[str, str]]
) -> list[tuple[str, str]]:
    if len(contents.sheets) > MAX_SHEETS:
        raise package.fault(
            say("{count} sheets, at most {most} are read", count=len(contents.sheets), most=MAX_SHEETS), part
        )
    found = []
    owners: dict[str, str] = {}
    titles: set[str] = set()
    for title, link in contents.sheets:
        if title.casefold() in titles:
            raise package.fault(say('two sheets are called "{title}"', title=title), part)
        titles.add(title.casefold())
        kind, target = links.get(link, ("", ""))
        if not link or kind in _WITHOUT_CELLS:
            continue
        if target not in package:
            raise package.fault(say('the sheet "{title}" has no part in the file', title=title), target or part)
        owner = owners.setdefault(part_key(target), title)
        if owner != title:
            raise package.fault(
                say('the sheets "{owner}" and "{title}" have the same part', owner=owner, title=title), target
            )
        found.append((title, target))
    return found


def _workbook_part(package: Package) -> str:
    found = next((target for kind, target in relationships(package, "").values() if kind == "officeDocument"), "")
    if found and found in package and not found.endswith(".bin"):
        return found
    if found.endswith(".bin") or "xl/workbook.bin" in package:
        raise WorkbookError(Fault(say("an .xlsb, which is not read"), file=package.name, hint=say("save it as .xlsx")))
    if "xl/workbook.xml" in package:
        return "xl/workbook.xml"
    if "content.xml" in package:
        raise WorkbookError(Fault(say("an OpenDocument file (.ods) with another file's suffix"), file=package.name))
    for part, message in _OTHERS:
        if part in package:
            raise WorkbookError(Fault(message, file=package.name, hint=say("save it as .xlsx")))
    raise WorkbookError(Fault(say("not a workbook: the zip file holds no part xl/workbook.xml"), file=package.name))


class _Workbook:
    """What the part `workbook.xml` says: sheets with their links, names, the calendar."""

    def __init__(self) -> None:
        self.sheets: list[tuple[str, str]] = []
        self.names: list[tuple[str, int | None, str]] = []
        self.date1904 = False
        self.settings = Settings()
        self._name: tuple[str, int | None] | None = None
        self.pieces: list[str] = []

    def start(self, tag: str, attributes: dict[str, Any]) -> None:
        """An element begins."""
        self.pieces.clear()
        match local_name(tag):
            case "sheet":
                self.sheets.append((attributes.get("name", ""), attribute(attributes, "id") or ""))
            case "workbookPr":
                self.date1904 = attributes.get("date1904") in ("1", "true")
            case "calcPr":
                self.settings = Settings(
                    as_shown=attributes.get("fullPrecision") in ("0", "false"),
                    iterates=attributes.get("iterate") in ("1", "true"),
                )
            case "definedName":
                local = attributes.get("localSheetId", "")
                self._name = attributes.get("name", ""), int(local) if local.isdecimal() else None

    def end(self, tag: str) -> None:
        """An element has ended."""
        if local_name(tag) == "definedName" and self._name is not None:
            self.names.append((*self._name, "".join(self.pieces)))
            self._name = None


def _names(contents: _Workbook) -> list[DefinedName]:
    """The names that formulas can use. Cells that use one that cannot be parsed keep their stored values."""
    found: list[DefinedName] = []
    for name, index, text in contents.names:
        if name.startswith("_xlnm.") or (index is not None and index >= len(contents.sheets)):
            continue
        formula: Node
        try:
            formula = parse_formula(text)
        except FormulaError:
            formula = Foreign(f"{name} = {text[:_SHOWN]}", say("a name that cannot be read"))
        found.append(DefinedName(name, formula, None if index is None else contents.sheets[index][0]))
    return found


def _strings(package: Package, part: str) -> list[str]:
    """The table of shared texts. Phonetic guides (rPh) do not belong to them."""
    found: list[str] = []
    pieces: list[str] = []
    text: list[str] = []
    phonetic = 0

    def start(tag: str, attributes: dict[str, Any]) -> None:
        nonlocal phonetic
        del attributes
        name = local_name(tag)
        if name == "si":
            text.clear()
        elif name == "t":
            pieces.clear()
        elif name == "rPh":
            phonetic += 1

    def end(tag: str) -> None:
        nonlocal phonetic
        name = local_name(tag)
        if name == "t" and not phonetic:
            text.extend(pieces)
        elif name == "rPh":
            phonetic -= 1
        elif name == "si":
            found.append(unescaped("".join(text)))

    if part in package:
        package.read(part, start, end, pieces)
    return found


_DYNAMIC = "XLDAPR"
"""The type of metadata that marks dynamic arrays (Microsoft, [MS-XLSX] 2.4.87)."""


def _dynamic_marks(package: Package, links: Mapping[str, tuple[str, str]]) -> frozenset[str]:
    """The values of `cm` that mean a dynamic array."""
    part = next((target for kind, target in links.values() if kind == "sheetMetadata"), "")
    if part not in package:
        return frozenset()
    types: list[str] = []
    dynamic: list[bool] = []
    cells: list[tuple[str, str]] = []
    inside: list[str] = []
    owner = ""

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal owner
        name = local_name(tag)
        inside.append(name)
        if name == "metadataType":
            types.append(attributes.get("name", ""))
        elif name == "futureMetadata":
            owner = attributes.get("name", "")
        elif name == "bk" and owner == _DYNAMIC and "futureMetadata" in inside:
            dynamic.append(False)
        elif name == "dynamicArrayProperties" and dynamic:
            dynamic[-1] = (attribute(attributes, "fDynamic") or "1") in ("1", "true")
        elif name == "bk" and "cellMetadata" in inside:
            cells.append(("", ""))
        elif name == "rc" and "cellMetadata" in inside and cells:
            cells[-1] = attributes.get("t", ""), attributes.get("v", "")

    def end(tag: str) -> None:
        inside.pop()
        del tag

    package.read(part, start, end)

    def is_dynamic(kind: str, place: str) -> bool:
        if not (kind.isdecimal() and place.isdecimal() and 1 <= int(kind) <= len(types)):
            return False
        return types[int(kind) - 1] == _DYNAMIC and int(place) < len(dynamic) and dynamic[int(place)]

    return frozenset(str(number) for number, found in enumerate(cells, 1) if is_dynamic(*found))


def _tables_of(package: Package, part: str, title: str, filters: list[str]) -> list[Table]:
    """The tables of the sheet `title`, whose part is `part`. One without a proper area is left out: it is then unknown.

    filters  is given the areas in which a filter hides rows
    """
    targets = sorted(target for kind, target in relationships(package, part).values() if kind == "table")
    found = [_table(package, target, title, filters) for target in targets if target in package]
    return [table for table in found if table is not None]


def _table(package: Package, part: str, title: str, filters: list[str]) -> Table | None:
    about: dict[str, str] = {}
    columns: list[str] = []

    def start(tag: str, attributes: dict[str, str]) -> None:
        name = local_name(tag)
        if name == "table":
            about.update(attributes)
        elif name == "tableColumn":
            columns.append(unescaped(attributes.get("name", "")))
        elif name == "filterColumn":
            filters.append(about.get("ref", ""))

    package.read(part, start)
    area = parse_area(about.get("ref", ""))
    if area is None or area[3] - area[1] + 1 != len(columns):
        return None
    name = about.get("displayName") or about.get("name", "")
    rows = area[2] - area[0] + 1
    headers, totals = (about.get(key, default) for key, default in (("headerRowCount", "1"), ("totalsRowCount", "0")))
    if not (headers.isdecimal() and totals.isdecimal() and len(headers + totals) < 9 and rows > 0):
        return None
    return Table(name, title, *area[:2], rows, tuple(columns), int(headers), int(totals))

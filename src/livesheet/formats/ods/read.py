"""Reads .ods files of any origin into a book: constants, formulas in blocks, names, and the values stored in the file."""

from __future__ import annotations

from pathlib import Path

from livesheet.diagnostics import Fault, FormulaError, WorkbookError
from livesheet.formula.book import Book, DefinedName
from livesheet.formula.nodes import CellRef, anchored, shifted, transform
from livesheet.formula.parser import parse_formula
from livesheet.said import say

from ..reading.package import Package, local_name, open_package, part_key, protected, saved_by, settings_remarks
from ..xml_text import NULL_DATE, NULL_DATE_1904
from .row_pattern import rows_of
from .scan import CONTENT, ContentScan, NameText
from .text import SHEET_TYPE

NULL_YEAR = "1930"
"""The year that 30 means where a document does not say otherwise."""

_MANIFEST = "META-INF/manifest.xml"


def read_ods(path: Path) -> Book:
    """The workbook in a file.

    Raises WorkbookError: no workbook, a damaged one, a password, parts that are missing or would unpack beyond measure
    (one fault), or cells that cannot be understood (one fault for each).
    """
    with open_package(path) as package:
        return _read(package)


def _read(package: Package) -> Book:
    _check_parts(package)
    scan = ContentScan(package)
    scan.run(rows_of(scan))
    if scan.kind != "spreadsheet":
        raise package.fault(say("an OpenDocument {kind}, not a spreadsheet", kind=scan.kind or "file"), CONTENT)
    if scan.null_date not in (NULL_DATE, NULL_DATE_1904):
        scan.faults.append(
            Fault(
                say("days are counted from {null_date}, which is not supported", null_date=scan.null_date), package.name
            )
        )
    if scan.faults:
        raise WorkbookError(scan.faults)
    if not scan.sheets:
        raise package.fault(say("the workbook has no sheet"), CONTENT)
    names = [defined for text in _all_names(scan) if (defined := _name(text)) is not None]
    date1904 = scan.null_date == NULL_DATE_1904
    macros = "Basic" if any(part_key(entry.filename).startswith("basic/") for entry in package.entries()) else ""
    program = saved_by(package, "meta.xml")
    remarks = [*scan.remarks, *settings_remarks(scan.settings, package.name)]
    if scan.null_year not in ("", NULL_YEAR) and any(sheet.blocks for sheet in scan.sheets):
        message = say("years of two digits count from {year} here; they are taken as from {usual}",
                      year=scan.null_year, usual=NULL_YEAR)  # fmt: skip
        remarks.append(Fault(message, package.name))
    return Book(
        scan.sheets, names, date1904, package.name, remarks, macros=macros, program=program, settings=scan.settings
    )


def _check_parts(package: Package) -> None:
    """Refuse what is no .ods, in words that say what it is."""
    if "encrypted-package" in package or (_MANIFEST in package and _is_encrypted(package)):
        raise protected(package.name, say("save it without a password"))
    if CONTENT in package:
        kind = b"".join(package.pieces("mimetype"))[:200].decode("latin-1").strip() if "mimetype" in package else ""
        if kind and not kind.startswith(SHEET_TYPE):
            raise WorkbookError(Fault(say("not a spreadsheet but {kind}", kind=kind), file=package.name))
        return
    if "xl/workbook.xml" in package:
        raise WorkbookError(Fault(say("an .xlsx with another file's suffix"), file=package.name))
    raise WorkbookError(
        Fault(say("not a workbook: the zip file holds no part {content}", content=CONTENT), file=package.name)
    )


def _is_encrypted(package: Package) -> bool:
    found = False

    def start(tag: str, attributes: dict[str, str]) -> None:
        nonlocal found
        del attributes
        found = found or local_name(tag) == "encryption-data"

    package.read(_MANIFEST, start)
    return found


def _all_names(scan: ContentScan) -> list[NameText]:
    taken = {text.name.casefold() for text in scan.names if text.sheet is None}
    return scan.names + [text for text in scan.lists if text.name.casefold() not in taken]


def _name(text: NameText) -> DefinedName | None:
    """A name that formulas can use. One that cannot be parsed is left out: using it is then an unknown name."""
    if text.name.startswith("_xlnm."):  # the print ranges of an .xlsx that LibreOffice has saved
        return None
    try:
        formula = parse_formula(f"[{text.formula}]" if text.is_range else text.formula, "openformula")
        base = parse_formula(f"[{text.base}]", "openformula") if text.base else CellRef(0, 0)
    except FormulaError:
        return None
    if not isinstance(base, CellRef):
        return None
    if text.fixed:
        formula = transform(formula, anchored)
    # Relative references are as seen from the base cell; a book has them as seen from A1.
    return DefinedName(text.name, shifted(formula, -base.row, -base.col, wrap=True), text.sheet)

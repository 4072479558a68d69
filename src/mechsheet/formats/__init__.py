"""Workbooks as files: one writer and one reader per format, found by the file's suffix."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from pathlib import Path
from typing import cast

from mechsheet.diagnostics import Fault, OutputError, readable_name
from mechsheet.formula.book import Book
from mechsheet.sheet.workbook import Workbook

READERS = {
    ".xlsx": "xlsx_read:read_xlsx",
    ".xlsm": "xlsx_read:read_xlsx",
    ".ods": "ods_read:read_ods",
    ".ots": "ods_read:read_ods",
}
"""Suffix -> module and function, imported when first used."""

WRITERS = {".xlsx": "xlsx_write:write_xlsx", ".ods": "ods_write:write_ods"}
"""Suffix -> module and function; imported when first used, because a writer brings its library along."""


def read(path: Path) -> Book:
    """The workbook in a file, read by the reader of its suffix (an unknown suffix as .xlsx). Raises WorkbookError."""
    module, name = READERS.get(path.suffix.lower(), READERS[".xlsx"]).split(":")
    reader = cast("Callable[[Path], Book]", getattr(import_module(f"{__name__}.{module}"), name))
    return reader(path)


def write(workbook: Workbook, path: Path) -> None:
    """Write `workbook` in the format that the suffix of `path` names. Raises OutputError."""
    place = WRITERS.get(path.suffix.lower())
    if place is None:
        raise OutputError(
            Fault(f'no format is called "{path.suffix}"', readable_name(path), hint=f"formats: {', '.join(WRITERS)}")
        )
    module, name = place.split(":")
    writer = cast("Callable[[Workbook, Path], None]", getattr(import_module(f"{__name__}.{module}"), name))
    writer(workbook, path)

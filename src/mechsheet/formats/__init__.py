"""Workbooks as files: one writer and one reader per format, found by the file's suffix."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from mechsheet.diagnostics import Fault, OutputError, readable_name

if TYPE_CHECKING:
    from mechsheet.formula.book import Book
    from mechsheet.formula.nodes import Scalar
    from mechsheet.sheet.workbook import Workbook

READERS = {
    ".xlsx": "xlsx.read:read_xlsx",
    ".xlsm": "xlsx.read:read_xlsx",
    ".ods": "ods.read:read_ods",
    ".ots": "ods.read:read_ods",
}
"""Suffix -> module and function, imported when first used."""

WRITERS = {".xlsx": "xlsx.write:write_xlsx", ".ods": "ods.write:write_ods"}
"""Suffix -> module and function; imported when first used, because a writer brings its library along."""

UPDATERS = {
    ".xlsx": "xlsx.update_values:update_xlsx",
    ".xlsm": "xlsx.update_values:update_xlsx",
    ".ods": "ods.update_values:update_ods",
    ".ots": "ods.update_values:update_ods",
}
"""Suffix -> module and function that writes a workbook's file back with other values."""


def read(path: Path) -> Book:
    """The workbook in a file, read by the reader of its suffix (an unknown suffix as .xlsx). Raises WorkbookError."""
    reader = cast("Callable[[Path], Book]", _function(READERS.get(path.suffix.lower(), READERS[".xlsx"])))
    return reader(path)


def write(workbook: Workbook, path: Path, form: str = "") -> None:
    """Write `workbook` in the format `form` ("xlsx", "ods"), else the one that `path` ends with. Raises OutputError."""
    place = WRITERS.get(f".{form}" if form else path.suffix.lower())
    if place is None:
        raise OutputError(
            Fault(f'no format is called "{path.suffix}"', readable_name(path), hint=f"formats: {', '.join(WRITERS)}")
        )
    writer = cast("Callable[[Workbook, Path], None]", _function(place))
    writer(workbook, path)


def update_values(source: Path, output: Path, book: Book, values: Any, changes: Mapping[Any, Scalar]) -> None:
    """Copy the workbook file `source` to `output` with the values given and nothing else changed.

    book     what was read from `source`
    values   the engine's: `values.get(sheet, row, col)`
    changes  input cells that were set, (sheet, row, col) -> value

    Raises WorkbookError, and OutputError when `output` cannot be written or is to have another format.
    """
    suffix = source.suffix.lower()
    function = _function(UPDATERS.get(suffix, UPDATERS[".xlsx"]))
    cast("Callable[[Path, Path, Book, Any, Mapping[Any, Scalar]], None]", function)(
        source, output, book, values, changes
    )


def _function(place: str) -> object:
    module, name = place.split(":")
    return getattr(import_module(f"{__name__}.{module}"), name)

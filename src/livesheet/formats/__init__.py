"""Workbooks as files: one writer and one reader per format, found by the file's suffix."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

from livesheet.diagnostics import Fault, OutputError, readable_name
from livesheet.said import say

if TYPE_CHECKING:
    from livesheet.formula.book import Book
    from livesheet.formula.nodes import Scalar
    from livesheet.workbook import Workbook

FORMATS = {".xlsx": "xlsx", ".xlsm": "xlsx", ".ods": "ods", ".ots": "ods", ".xls": "xls"}
"""Suffix -> the folder that reads the format and, but for .xls, updates its values."""
WRITTEN = (".xlsx", ".ods")


def read(path: Path) -> Book:
    """The workbook in a file, read by the reader of its suffix (an unknown suffix as .xlsx). Raises WorkbookError."""
    return cast("Book", _function(_format_of(path), "read")(path))


def write(workbook: Workbook, path: Path, form: str = "") -> None:
    """Write `workbook` in the format `form` ("xlsx", "ods"), else the one that `path` ends with. Raises OutputError."""
    suffix = f".{form}" if form else path.suffix.lower()
    if suffix not in WRITTEN:
        raise OutputError(
            Fault(
                say('no format is called "{suffix}"', suffix=path.suffix),
                readable_name(path),
                hint=say("formats: {formats}", formats=", ".join(WRITTEN)),
            )
        )
    _function(FORMATS[suffix], "write")(workbook, path)


def update_values(source: Path, output: Path, book: Book, values: Any, changes: Mapping[Any, Scalar]) -> None:
    """Copy the workbook file `source` to `output` with the values given and nothing else changed.

    book     what was read from `source`
    values   the engine's: `values.get(sheet, row, col)`
    changes  input cells that were set, (sheet, row, col) -> value

    Raises WorkbookError, and OutputError when `output` cannot be written or is to have another format.
    """
    if _format_of(source) == "xls":
        message = say("an .xls is read, not written")
        hint = say("save it as .xlsx first, then recalculate that")
        raise OutputError(Fault(message, readable_name(output), hint=hint))
    _function(_format_of(source), "update_values")(source, output, book, values, changes)


def _format_of(path: Path) -> str:
    return FORMATS.get(path.suffix.lower(), "xlsx")


def _function(form: str, module: str) -> Callable[..., object]:
    """`write_xlsx` of xlsx/write.py, and so on; imported when first used, because a writer brings its library along."""
    verb = module.partition("_")[0]
    function: Callable[..., object] = getattr(import_module(f"{__name__}.{form}.{module}"), f"{verb}_{form}")
    return function

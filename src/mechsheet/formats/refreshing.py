"""A workbook's file with other values and nothing else changed: what both formats have in common."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import Protocol

from mechsheet.diagnostics import Fault, OutputError, readable_name
from mechsheet.formula.book import Book, BookSheet
from mechsheet.formula.nodes import Scalar

from .archive import new_archive
from .package import Package, part_key

Place = tuple[str, int, int]
"""Sheet, row, column."""
Rewrite = Callable[[], Iterator[bytes]]


class CellValues(Protocol):
    """Values by sheet title, row and column, as the engine gives them."""

    def get(self, sheet: str, row: int, col: int) -> Scalar:
        """The value of a cell."""
        ...


class NewValues:
    """What the cells of one sheet shall hold.

    changes  the input cells that were set, by (row, col)
    """

    def __init__(self, sheet: BookSheet, values: CellValues, changes: Mapping[Place, Scalar]) -> None:
        self._sheet = sheet
        self._values = values
        title = sheet.title.casefold()
        self.changes = {(row, col): value for (name, row, col), value in changes.items() if name.casefold() == title}

    def result(self, row: int, col: int) -> Scalar:
        """The value of a formula's cell."""
        return self._values.get(self._sheet.title, row, col)

    def is_stored(self, row: int, col: int, value: Scalar, formula: bool) -> bool:
        """Whether the file holds that value already: then the cell's bytes stay."""
        old = (self._sheet.cached if formula else self._sheet.constants).get(row, col)
        return type(old) is type(value) and old == value


def new_values(book: Book, values: CellValues, changes: Mapping[Place, Scalar]) -> dict[str, NewValues]:
    """The new values of each sheet, by title."""
    return {sheet.title: NewValues(sheet, values, changes) for sheet in book.sheets}


def check_output(source: Path, output: Path) -> None:
    """Raise OutputError when the file to write has another format than the one that was read."""
    if source.suffix.lower() != output.suffix.lower():
        message = f"a recalculated {source.suffix} is written as {source.suffix}"
        raise OutputError(Fault(message, readable_name(output), hint="only values are changed, not the format"))


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

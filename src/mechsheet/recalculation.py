"""Recalculate a workbook file: set inputs, evaluate, read values, compare with those stored."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from mechsheet.areas import Area, area_of
from mechsheet.diagnostics import Fault, WorkbookError, near_miss, readable_name
from mechsheet.formula.book import Book
from mechsheet.formula.nodes import CellRef, ErrorValue, Scalar
from mechsheet.formula.references import cell_name, parse_reference

if TYPE_CHECKING:
    from mechsheet.checking.stored import Stored

Place = tuple[str, int, int]


@dataclass(frozen=True, slots=True)
class Result:
    """A recalculated workbook.

    remarks  what a person should know before trusting it, with the cells: formulas that could not be read, unknown
             functions, references to other workbooks, volatile functions, circles
    """

    book: Book
    values: Any
    path: Path
    changes: Mapping[Place, Scalar]
    remarks: tuple[Fault, ...] = ()

    def get(self, sheet: str, row: int, col: int) -> Scalar:
        """The value of a cell (rows and columns from 0)."""
        value: Scalar = self.values.get(sheet, row, col)
        return value

    def as_dict(self) -> dict[str, dict[str, object]]:
        """{"sheet": {"A1": value}}: every cell, errors as "#N/A" text."""
        found: dict[str, dict[str, object]] = {}
        for sheet in self.book.sheets:
            cells = sorted(self.values.items(sheet.title))
            found[sheet.title] = {cell_name(row, col): plain(value) for row, col, value in cells}
        return found

    def area(self, text: str) -> Area:
        """The cells that `Sheet!A1:C9` or another text means: see `areas.area_of`. Raises WorkbookError."""
        found = area_of(self.book, text)
        if isinstance(found, Fault):
            raise WorkbookError(replace(found, file=readable_name(self.path)))
        return found

    def table(self, area: Area) -> list[list[Scalar]]:
        """The values of an area, row by row."""
        columns = [
            self.values.column(area.sheet, area.col + right, area.row, area.row + area.rows - 1)
            for right in range(area.cols)
        ]
        return [list(row) for row in zip(*columns, strict=True)]

    def compare_with_stored(self) -> Stored:
        """The values computed against those stored in the file."""
        from mechsheet.checking.stored import compare_with_stored

        return compare_with_stored(self.book, self.values, which_error=self.path.suffix.lower() not in (".ods", ".ots"))

    def named(self) -> dict[str, object]:
        """The value of every defined name that is one cell."""
        return {
            name.name: plain(self.get(name.formula.sheet, name.formula.row, name.formula.col))
            for name in self.book.names
            if isinstance(name.formula, CellRef) and name.formula.sheet is not None
        }

    def write(self, output: Path) -> None:
        """Write the workbook with all its values refreshed and nothing else changed."""
        from mechsheet.formats import refresh

        refresh(self.path, output, self.book, self.values, self.changes)


def plain(value: Scalar) -> object:
    """A value as JSON data: errors as their text."""
    return str(value) if isinstance(value, ErrorValue) else value


def recalc(path: str | Path, settings: Mapping[str, str | float] | None = None) -> Result:
    """Read a workbook, set inputs (`{"a_1": 65}` by defined name, or `{"Sheet!B2": 65}`), and compute every formula.

    Values given as texts are taken as typed into a cell: `65`, `TRUE`, `'65` (a text), anything else a text.
    What cannot be computed as it is meant is in `remarks`. Raises WorkbookError: not a workbook, an unknown name, a cell
    that is computed itself.
    """
    from mechsheet.engine import compile_book
    from mechsheet.formats import read

    path = Path(path)
    book = read(path)
    changes: dict[Place, Scalar] = {}
    faults: list[Fault] = []
    for name, value in (settings or {}).items():
        place = _place(book, name)
        if isinstance(place, Fault):
            faults.append(place)
            continue
        sheet = book.sheet(place[0])
        if sheet is not None and sheet.formula_at(place[1], place[2]) is not None:
            faults.append(Fault(f"{name} is computed by a formula: set what it is computed from", key="--set"))
        changes[place] = _value(value)
    if faults:
        raise WorkbookError([replace(fault, file=readable_name(path)) for fault in faults])
    plan = compile_book(book)
    values = plan.evaluate(changes)
    return Result(book, values, path, changes, (*book.remarks, *values.remarks))


def _value(value: str | float) -> Scalar:
    """A typed value: a number or truth value if it reads as one."""
    if isinstance(value, bool):
        return value
    if isinstance(value, float | int):
        return float(value)
    if value.startswith("'"):
        return value[1:]
    if value.upper() in ("TRUE", "FALSE"):
        return value.upper() == "TRUE"
    try:
        number = float(value)
    except ValueError:
        return value
    return number if math.isfinite(number) and "_" not in value else value


def _place(book: Book, name: str) -> Place | Fault:
    """The cell that a name means: a defined name, `a1` for the safe name `a_1`, or Sheet!B2."""
    if "!" in name:
        reference = parse_reference(name)
        if reference is None or reference.sheet is None or book.sheet(reference.sheet) is None:
            titles = [sheet.title for sheet in book.sheets]
            return Fault(f'"{name}" is no cell of this workbook', key="--set", hint=f"sheets: {', '.join(titles)}")
        return reference.sheet, reference.row, reference.col
    candidates = [found for found in book.names if found.name.casefold() == name.casefold()]
    if not candidates and (like := book.name_like(name)) is not None:
        candidates = [like]
    cells = [found.formula for found in candidates if isinstance(found.formula, CellRef) and found.formula.sheet]
    if not cells or cells[0].sheet is None:
        known = [found.name for found in book.names]
        return Fault(
            f'no cell is named "{name}"',
            key="--set",
            hint=near_miss(name, known) or f"names: {', '.join(known[:20]) or 'none'}",
        )
    return cells[0].sheet, cells[0].row, cells[0].col

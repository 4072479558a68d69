"""Recalculate a workbook file: set inputs, evaluate, read values."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mechsheet.diagnostics import Fault, WorkbookError, near_miss, readable_name
from mechsheet.formula.book import Book
from mechsheet.formula.nodes import CellRef, ErrorValue, Scalar
from mechsheet.formula.references import cell_name, parse_reference

Place = tuple[str, int, int]


@dataclass(frozen=True, slots=True)
class Result:
    """A recalculated workbook."""

    book: Book
    values: Any
    path: Path
    changes: Mapping[Place, Scalar]

    def get(self, sheet: str, row: int, col: int) -> Scalar:
        """The value of a cell (rows and columns from 0)."""
        value: Scalar = self.values.get(sheet, row, col)
        return value

    def as_dict(self) -> dict[str, dict[str, object]]:
        """{"sheet": {"A1": value}}: every cell, errors as "#N/A" text."""
        found: dict[str, dict[str, object]] = {}
        for sheet in self.book.sheets:
            cells: dict[str, object] = {}
            places = {(row, col) for row, col, _ in sheet.constants.items()}
            for block in sheet.blocks:
                places |= {
                    (row, col)
                    for row in range(block.row, block.row + block.rows)
                    for col in range(block.col, block.col + block.cols)
                }
            for row, col in sorted(places):
                cells[cell_name(row, col)] = _plain(self.get(sheet.title, row, col))
            found[sheet.title] = cells
        return found

    def named(self) -> dict[str, object]:
        """The value of every defined name that is one cell."""
        return {
            name.name: _plain(self.get(name.formula.sheet, name.formula.row, name.formula.col))
            for name in self.book.names
            if isinstance(name.formula, CellRef) and name.formula.sheet is not None
        }

    def write(self, output: Path) -> None:
        """Write the workbook with all its values refreshed and nothing else changed."""
        from mechsheet.formats import refresh

        refresh(self.path, output, self.book, self.values, self.changes)


def _plain(value: Scalar) -> object:
    return str(value) if isinstance(value, ErrorValue) else value


def recalc(path: str | Path, settings: Mapping[str, str | float] | None = None) -> Result:
    """Read a workbook, set inputs (`{"a_1": 65}` by defined name, or `{"Sheet!B2": 65}`), and compute every formula.

    Raises WorkbookError: not a workbook, an unknown name, a function that is not known (with its cell), a circle.
    """
    from mechsheet.engine import evaluate
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
        raise WorkbookError(
            [Fault(fault.message, readable_name(path), None, fault.key, "", fault.hint) for fault in faults]
        )
    return Result(book, evaluate(book, changes), path, changes)


def _value(value: str | float) -> Scalar:
    """A typed value: a number if it reads as one."""
    if isinstance(value, float | int):
        return float(value)
    try:
        number = float(value)
    except ValueError:
        return value
    return number if math.isfinite(number) else value


def _place(book: Book, name: str) -> Place | Fault:
    """The cell that a name means: a defined name, `a1` for the safe name `a_1`, or Sheet!B2."""
    if "!" in name:
        reference = parse_reference(name)
        if reference is None or reference.sheet is None or book.sheet(reference.sheet) is None:
            titles = [sheet.title for sheet in book.sheets]
            return Fault(f'"{name}" is no cell of this workbook', key="--set", hint=f"sheets: {', '.join(titles)}")
        return reference.sheet, reference.row, reference.col
    candidates = [found for found in book.names if found.name.casefold() == name.casefold()]
    if not candidates:
        candidates = [
            found for found in book.names if found.name.replace("_", "").casefold() == name.replace("_", "").casefold()
        ]
    cells = [found.formula for found in candidates if isinstance(found.formula, CellRef) and found.formula.sheet]
    if not cells or cells[0].sheet is None:
        known = [found.name for found in book.names]
        return Fault(
            f'no cell is named "{name}"',
            key="--set",
            hint=near_miss(name, known) or f"names: {', '.join(known[:20]) or 'none'}",
        )
    return cells[0].sheet, cells[0].row, cells[0].col

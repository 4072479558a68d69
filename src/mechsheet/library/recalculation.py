"""Recalculate a workbook file: set inputs, evaluate, read values, compare with those stored."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

from livesheet.diagnostics import Fault, WorkbookError, near_miss, readable_name
from livesheet.formula.book import Book
from livesheet.formula.nodes import CellRef, ErrorValue, Scalar
from livesheet.formula.references import cell_name, parse_reference
from livesheet.said import say
from mechsheet.arguments.values import Area, area_of, cell_value, typed

if TYPE_CHECKING:
    from mechsheet.checking import Rules, Stored

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
            found[sheet.title] = {cell_name(row, col): json_value(value) for row, col, value in cells}
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

    def compare_with_stored(self, rules: Rules | None = None) -> Stored:
        """The values stored in the file against what its formulas give, whatever was set."""
        from mechsheet.checking.stored import judge_stored

        return judge_stored(self.book, rules)[0]

    def named(self) -> dict[str, object]:
        """The value of every defined name that is one cell."""
        return {
            name.name: json_value(self.get(name.formula.sheet, name.formula.row, name.formula.col))
            for name in self.book.names
            if isinstance(name.formula, CellRef) and name.formula.sheet is not None
        }

    def write(self, output: Path) -> None:
        """Write the workbook with all its values refreshed and nothing else changed.

        They are computed once more, by functions that have the same bits on every machine; where a volatile function
        would give another value then, the values are those that were looked at.
        """
        from livesheet.engine import PORTABLE, evaluate
        from livesheet.formats import update_values

        settled = not any(fault.about == "volatile" for fault in self.remarks)
        values = evaluate(self.book, self.changes, PORTABLE) if settled else self.values
        update_values(self.path, output, self.book, values, self.changes)


def json_value(value: Scalar) -> object:
    """A cell's value as JSON: errors as "#N/A" text."""
    return str(value) if isinstance(value, ErrorValue) else value


def recalc(path: str | Path, settings: Mapping[str, Any] | None = None, functions: Sequence[str | Path] = ()) -> Result:
    """Read a workbook, set inputs (`{"a_1": 65}` by defined name, or `{"Sheet!B2": 65}`), and compute every formula.

    Numbers may be of any type, numpy's too. Values given as texts are taken as typed into a cell: `65`, `TRUE`, `'65` (a
    text), anything else a text; but a cell that holds a number in the file takes a number only, or what has a `'` before it.
    `functions`: modules in Basic (.bas) whose functions the workbook calls.
    What cannot be computed as it is meant is in `remarks`. Raises WorkbookError: not a workbook, an unknown name, a cell
    that is computed itself, a value that the cell cannot take.
    """
    from livesheet.engine import evaluate
    from livesheet.formats import read
    from mechsheet.library.routines import with_routines

    path = Path(path)
    book = with_routines(read(path), [Path(file) for file in functions])
    changes: dict[Place, Scalar] = {}
    faults: list[Fault] = []
    for name, value in (settings or {}).items():
        place = _place(book, name)
        if isinstance(place, Fault):
            faults.append(place)
            continue
        found = _value(book, name, place, value)
        if isinstance(found, Fault):
            faults.append(found)
        else:
            changes[place] = found
    if faults:
        raise WorkbookError([replace(fault, file=readable_name(path)) for fault in faults])
    values = evaluate(book, changes)
    remarks = (*book.remarks, *values.remarks)
    if changes and (values.kept or book.settings.as_shown or any(fault.about == "function" for fault in remarks)):
        remarks = (*remarks, Fault(NOT_FOLLOWING, file=book.source))
    return Result(book, values, path, changes, remarks)


NOT_FOLLOWING = (
    "stored values that are kept do not follow what was set: where their functions read it, they and what depends on them "
    "are those of the values before"
)
"""What is said when inputs are set in a workbook with functions that only another program knows."""


def _value(book: Book, name: str, place: Place, value: Any) -> Scalar | Fault:
    """What a cell is to hold, or why it cannot."""
    sheet = book.sheet(place[0])
    if sheet is None:
        return Fault(say("no sheet of this workbook"), key=name)
    if sheet.formula_at(place[1], place[2]) is not None:
        return Fault(say("computed by a formula: set what it is computed from"), key=name)
    held = sheet.constants.get(place[1], place[2])
    return typed(name, value, held) if isinstance(value, str) else cell_value(name, value, held)


def _place(book: Book, name: str) -> Place | Fault:
    """The cell that a name means: a defined name, `a1` for the safe name `a_1`, or Sheet!B2."""
    if not isinstance(name, str):
        return Fault(say("{name!r} is no name of a cell", name=name), hint=say('a text: "a1", "Sheet!B2"'))
    if "!" in name:
        reference = parse_reference(name)
        if reference is None or reference.sheet is None or book.sheet(reference.sheet) is None:
            titles = [sheet.title for sheet in book.sheets]
            return Fault(
                say('"{name}" is no cell of this workbook', name=name),
                hint=say("sheets: {titles}", titles=", ".join(titles)),
            )
        return reference.sheet, reference.row, reference.col
    candidates = [found for found in book.names if found.name.casefold() == name.casefold()]
    if not candidates and (like := book.name_like(name)) is not None:
        candidates = [like]
    cells = [found.formula for found in candidates if isinstance(found.formula, CellRef) and found.formula.sheet]
    if not cells or cells[0].sheet is None:
        known = [found.name for found in book.names]
        return Fault(
            say('no cell is named "{name}"', name=name),
            hint=near_miss(name, known) or say("names: {names}", names=", ".join(known[:20]) or "none"),
        )
    return cells[0].sheet, cells[0].row, cells[0].col

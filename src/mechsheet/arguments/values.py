"""Values as people give them: numbers of any numeric type and nothing that only looks like one, what is put into a cell, and
ranges of a workbook (`Sheet!A1:C9`, whole columns, whole sheets, names)."""

from __future__ import annotations

import math
import re
from dataclasses import dataclass
from numbers import Integral, Real
from typing import Any

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.formula.book import Book, BookSheet
from livesheet.formula.nodes import MAX_COLUMNS, MAX_ROWS, CellRef, ErrorValue, RangeRef, Scalar
from livesheet.formula.references import column_index, parse_reference
from livesheet.said import say
from mechsheet.diagnostics import MechsheetError


def number_given(value: Any, key: str) -> float:
    """The number that an argument is: int, float, Fraction, Decimal, or a scalar of numpy; `key` names the argument.

    Raises MechsheetError for truth values, texts, everything else, and what is not finite.
    """
    if getattr(value, "shape", None) == () and hasattr(value, "item"):
        value = value.item()  # a numpy scalar, or an array of one number without axes
    if isinstance(value, bool) or not _is_number(value):
        raise MechsheetError(
            Fault(say("expected a number, found {value!r:.60}", value=value), key=key, hint=_hint(value))
        )
    try:
        found = float(value)
    except (OverflowError, ValueError):  # too many digits; a Decimal that signals
        found = math.nan
    if not math.isfinite(found):
        raise MechsheetError(Fault(say("expected a finite number, found {value!s:.60}", value=value), key=key))
    return found


def whole_number_given(value: Any, key: str) -> int:
    """The same for a count: a float is refused unless it is whole."""
    found = number_given(value, key)
    if not found.is_integer():
        raise MechsheetError(Fault(say("expected a whole number, found {found:g}", found=found), key=key))
    return int(found)


def number_text(value: Any, key: str) -> str:
    """The number as a description writes it: whole numbers without a point. Raises as `number_given`."""
    found = number_given(value, key)
    return str(int(value)) if isinstance(value, Integral) else repr(found)


def _hint(value: object) -> str:
    if not isinstance(value, str):
        return ""
    try:
        return say("write {number:g}, without quotes", number=float(value.replace(",", ".")))
    except ValueError:
        return ""


# --- what is put into a cell ------------------------------------------------------------------------------------------

_COMMA = re.compile(r"[+-]?[0-9]+,[0-9]+(?:[eE][+-]?[0-9]+)?")
_SHOWN = 40


def cell_value(where: str, value: Any, held: Scalar, force: bool = False) -> Scalar | Fault:
    """A value as a cell holds it, or why it is refused.

    held   what the cell holds in the file: where that is a number, only numbers are taken
    force  take anything that a cell can hold (texts, truth values, nothing), whatever the cell holds
    """
    if isinstance(value, ErrorValue):
        return value
    is_truth = isinstance(value, bool | np.bool_)
    if not is_truth and _is_number(value):
        number = float(value)
        if math.isfinite(number):
            return number
        return Fault(say("{number} is no number that a cell can hold", number=number), key=where)
    if not (value is None or is_truth or isinstance(value, str)):
        kind = type(value).__name__
        return Fault(
            say("a {kind} is no value of one cell: {value}", kind=kind, value=_shown(value)),
            key=where,
            hint=say("one number, for example 66.5"),
        )
    scalar: Scalar = bool(value) if is_truth else value
    if force:
        return scalar
    if isinstance(scalar, str) and _COMMA.fullmatch(scalar.strip()) and not isinstance(held, str):
        hint = say("write {number}", number=scalar.strip().replace(",", "."))
        return Fault(say("expected a number, found {value}", value=_shown(scalar)), key=where, hint=hint)
    if isinstance(held, float):
        return Fault(
            say("expected a number, found {value}", value=_shown(scalar)), key=where, hint=_hint_of_cell(scalar, held)
        )
    return scalar


def _is_number(value: Any) -> bool:
    if isinstance(value, Real | str | None):
        return isinstance(value, Real)
    from decimal import Decimal  # the last of all types to be asked for, and slow to load

    return isinstance(value, Decimal)


def typed(where: str, text: str, held: Scalar) -> Scalar | Fault:
    """As `cell_value` for what is typed: `65`, `TRUE`, `'65` (a text whatever the cell holds), anything else a text."""
    if text.startswith("'"):
        return text[1:]
    if text.upper() in ("TRUE", "FALSE"):
        return cell_value(where, text.upper() == "TRUE", held)
    try:
        number = float(text)
    except ValueError:
        number = math.nan
    return cell_value(where, number if math.isfinite(number) and "_" not in text else text, held)


def _hint_of_cell(value: Scalar, held: float) -> str:
    if isinstance(value, bool):
        return f"write {int(value)}"
    return f"the cell holds a number: write one, for example {held:.12g}"


def _shown(value: object) -> str:
    text = f'"{value}"' if isinstance(value, str) else repr(value)
    return text if len(text) <= _SHOWN else text[:_SHOWN] + "…"


# --- ranges of a workbook ---------------------------------------------------------------------------------------------


@dataclass(frozen=True, slots=True)
class Area:
    """`rows` x `cols` cells of a sheet from (row, col) on."""

    sheet: str
    row: int
    col: int
    rows: int
    cols: int


def area_of(book: Book, text: str) -> Area | Fault:
    """The cells that `Sheet!A1:C9`, `Sheet!B2`, `Sheet!A:C`, `Sheet!2:5`, `Sheet` or a defined name (a1 for a_1) mean.

    Whole columns, rows and sheets end with the last cell in use. A Fault for what means no cells.
    """
    titles = say("sheets: {titles}", titles=", ".join(sheet.title for sheet in book.sheets))
    before, mark, cells = text.rpartition("!")
    if not mark:
        sheet = book.sheet(text.strip("'").replace("''", "'"))
        defined = book.name(text) or (book.name_like(text) if sheet is None else None)
        if defined is None:
            return (
                _used(sheet)
                if sheet is not None
                else Fault(say('"{text}" is no range, name or sheet', text=text), "", None, "", "", titles)
            )
        formula = defined.formula
        start, end = (formula.start, formula.end) if isinstance(formula, RangeRef) else (formula, formula)
        if not (isinstance(start, CellRef) and isinstance(end, CellRef) and start.sheet):
            return Fault(say('the name "{text}" stands for no cells of one sheet', text=text))
        sheet = book.sheet(start.sheet)
        return (
            Fault(say('the name "{text}" leads to no sheet', text=text), hint=titles)
            if sheet is None
            else _between(sheet, start, end)
        )
    quoted = len(before) > 1 and before.startswith("'") and before.endswith("'")
    sheet = book.sheet(before[1:-1].replace("''", "'") if quoted else before)
    if sheet is None:
        return Fault(say('no sheet is called "{name}"', name=before), hint=titles)
    first, colon, last = cells.replace("$", "").partition(":")
    one, other = _corner(first, False), _corner(last if colon else first, True)
    if one is None or other is None or (not colon and parse_reference(first) is None):
        return Fault(say('"{cells}" is no range of cells', cells=cells), hint=say("for example Sheet1!A1:C9"))
    return _between(sheet, one, other)


def _corner(text: str, last: bool) -> CellRef | None:
    """A corner of a range: a cell, or the first or last cell of a column or row."""
    if text.isascii() and text.isalpha() and column_index(text) < MAX_COLUMNS:
        return CellRef(MAX_ROWS - 1 if last else 0, column_index(text))
    if text.isascii() and text.isdecimal() and 0 < len(text) < 8 and 0 < int(text) <= MAX_ROWS:
        return CellRef(int(text) - 1, MAX_COLUMNS - 1 if last else 0)
    return parse_reference(text)


def _between(sheet: BookSheet, start: CellRef, end: CellRef) -> Area:
    top, bottom = sorted((start.row, end.row))
    left, right = sorted((start.col, end.col))
    used = _used(sheet)
    if bottom == MAX_ROWS - 1:
        bottom = max(top, used.rows - 1)
    if right == MAX_COLUMNS - 1:
        right = max(left, used.cols - 1)
    return Area(sheet.title, top, left, bottom - top + 1, right - left + 1)


def _used(sheet: BookSheet) -> Area:
    """From A1 to the last row and column that hold something."""
    columns = sheet.constants.columns
    rows = [runs[-1].end for runs in columns.values() if runs] + [block.row + block.rows for block in sheet.blocks]
    cols = [col + 1 for col in columns] + [block.col + block.cols for block in sheet.blocks]
    return Area(sheet.title, 0, 0, max(rows, default=1), max(cols, default=1))

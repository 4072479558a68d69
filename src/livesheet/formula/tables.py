"""Structured references: `Table1[[#Headers],[a]:[b]]`, `[@width]`; their text, and the cells that they mean.

ECMA-376-1 18.17.2.3; Microsoft, "Using structured references with Excel tables". In a column's name `[ ] # '` stand after an
apostrophe.
"""

from __future__ import annotations

import re
from collections.abc import Sequence

from .book import Table
from .nodes import CellRef, ErrorValue, Node, RangeRef, TableRef

_INSIDE = r"(?:[^\[\]']|'.)*"
BRACKETS = rf"\[(?:[^\[\]']|'.|\[{_INSIDE}\])*\]"
"""A regular expression for the bracketed part."""

_PARTS = {"#all": "all", "#headers": "headers", "#data": "data", "#totals": "totals", "#this row": "this row"}
_SPELLINGS = {part: f"#{part.title()}" for part in _PARTS.values()}
_ITEM = re.compile(rf"\s*(?:\[(?P<inner>{_INSIDE})\]|(?P<mark>[,:])|(?P<bare>[^\[\],:#'@]+))\s*")
"""XlsxWriter spells `[@a]` as `[[#This Row],a]`, which Excel reads."""


def parse_table(text: str) -> TableRef | None:
    """The reference that `Table1[...]` or `[...]` says, None when it says none."""
    name, _, rest = text.partition("[")
    body = rest[:-1]
    table = name or None
    if body.startswith("@"):
        found = _columns(body[1:])
        return None if found is None else TableRef(table, frozenset(("this row",)), *found)
    if not body.strip().startswith("["):
        return _single(table, body)
    parts: set[str] = set()
    names: list[str] = []
    place, expected = 0, True
    while place < len(body):
        match = _ITEM.match(body, place)
        if match is None or (match["mark"] is None) != expected:
            return None
        place, expected = match.end(), not expected
        if match["mark"] is not None:
            if (match["mark"] == ":") != (len(names) == 1 and match["mark"] == ":"):
                return None
            continue
        inner = match["inner"] if match["inner"] is not None else match["bare"]
        word = inner.strip().casefold()
        if word in _PARTS:
            parts.add(_PARTS[word])
        else:
            names.append(_unescaped(inner))
    if expected or len(names) > 2:
        return None
    return TableRef(table, frozenset(parts), names[0] if names else None, names[-1] if names else None)


def _single(table: str | None, body: str) -> TableRef | None:
    if not body:
        return TableRef(table)
    if body.startswith("#"):
        part = _PARTS.get(body.strip().casefold())
        return None if part is None else TableRef(table, frozenset((part,)))
    name = _unescaped(body)
    return TableRef(table, frozenset(), name, name)


def _columns(text: str) -> tuple[str | None, str | None] | None:
    """What follows `@`: nothing, a name, `[a]` or `[a]:[b]`."""
    if not text:
        return None, None
    if not text.startswith("["):
        return _unescaped(text), _unescaped(text)
    match = re.fullmatch(rf"\[({_INSIDE})\](?:\s*:\s*\[({_INSIDE})\])?", text)
    if match is None:
        return None
    return _unescaped(match[1]), _unescaped(match[1] if match[2] is None else match[2])


def _unescaped(text: str) -> str:
    return re.sub(r"'(.)", r"\1", text)


def _escaped(name: str) -> str:
    return re.sub(r"([\[\]#'@])", r"'\1", name)


def table_text(ref: TableRef) -> str:
    """The reference as an .xlsx spells it."""
    items = [f"[{spelling}]" for part, spelling in _SPELLINGS.items() if part in ref.parts]
    if ref.first is not None and ref.last is not None:
        names = [f"[{_escaped(name)}]" for name in dict.fromkeys((ref.first, ref.last))]
        items.append(":".join(names))
    body = ",".join(items)
    one = len(items) == 1 and ":" not in body
    return f"{ref.table or ''}{body if one else f'[{body}]'}"


def cells_of_table(ref: TableRef, tables: Sequence[Table], sheet: str, row: int, col: int) -> Node:
    """The range that a reference means in a formula in (row, col) of `sheet`: #REF! where there is no such part.

    `#This Row` is relative, so that fill-down moves it; outside the table's rows of data it is #VALUE!.
    """
    table = _table(ref, tables, sheet, row, col)
    if table is None:
        return ErrorValue("#REF!")
    columns = [name.casefold() for name in table.columns]
    try:
        first, last = (
            (0, len(columns) - 1)
            if ref.first is None or ref.last is None
            else sorted((columns.index(ref.first.casefold()), columns.index(ref.last.casefold())))
        )
    except ValueError:
        return ErrorValue("#REF!")
    rows = _rows(ref, table, row)
    if isinstance(rows, ErrorValue):
        return rows
    top, bottom = rows
    anchored = "this row" not in ref.parts
    start = CellRef(top, table.col + first, anchored, True, table.sheet)
    end = CellRef(bottom, table.col + last, anchored, True, table.sheet)
    return start if start == end else RangeRef(start, end)


def _table(ref: TableRef, tables: Sequence[Table], sheet: str, row: int, col: int) -> Table | None:
    if ref.table is not None:
        return next((table for table in tables if table.name.casefold() == ref.table.casefold()), None)
    for table in tables:
        inside = table.row <= row < table.row + table.rows and table.col <= col < table.col + len(table.columns)
        if inside and table.sheet.casefold() == sheet.casefold():
            return table
    return None


def _rows(ref: TableRef, table: Table, row: int) -> tuple[int, int] | ErrorValue:
    """The first and the last row."""
    top, bottom = table.row + table.headers, table.row + table.rows - table.totals - 1
    if "this row" in ref.parts:
        return (row, row) if top <= row <= bottom else ErrorValue("#VALUE!")
    if "all" in ref.parts:
        return table.row, table.row + table.rows - 1
    found = []
    if "headers" in ref.parts:
        found.append((table.row, top - 1))
    if "data" in ref.parts or not ref.parts:
        found.append((top, bottom))
    if "totals" in ref.parts:
        found.append((bottom + 1, table.row + table.rows - 1))
    if any(first > last for first, last in found):
        return ErrorValue("#REF!")
    return found[0][0], found[-1][1]

"""Where Excel must not draw its green triangles: what it would warn of is meant so in a workbook of ours.

Excel marks, by its default rules, what it takes for a slip. A warning stays on wherever it could still find a person's slip:
a formula in the middle of a filled column that somebody changes is marked as one that differs from its neighbours.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from itertools import groupby, pairwise

from livesheet.formula.nodes import RangeRef, walk
from livesheet.formula.references import area_name
from livesheet.workbook import Fill, Sheet

Place = tuple[int, int]
Run = tuple[int, int, int]
"""Column, first row, last row."""

FEW = 4
"""Rows of a fill of working cells: a person's slip there would be none of a filled column's."""

_NUMBER = re.compile(r"\s*[-+]?(?:[0-9]+[.,]?[0-9]*|[.,][0-9]+)(?:[eE][-+]?[0-9]+)?%?\s*")


def ignored_errors(sheet: Sheet) -> list[tuple[str, tuple[str, ...]]]:
    """(ranges with blanks between them, the attributes of <ignoredError> that are on there); no cell is in two of them.

    evalError           #N/A is what a row without a position shows
    formula             formulas that stand alone, and the ends of filled columns, differ from their neighbours
    formulaRange        a largest value is sought in the table's rows, not in the limits that stand above them
    unlockedFormula     inputs that the description gives as expressions
    numberStoredAsText  a link called 2, a line of the description
    """
    texts = _runs(_numeric_texts(sheet))
    if not texts and all(fill.rows <= FEW and fill.style.locked for fill in sheet.fills):
        return _whole(sheet.fills)
    alone = [fill for fill in sheet.fills if fill.rows * fill.cols == 1]
    kinds = {
        "evalError": _columns(sheet.fills),
        "formula": _runs(place for fill in sheet.fills for place in _edges(fill)),
        "formulaRange": _runs((fill.row, fill.col) for fill in alone if _reads_range(fill)),
        "unlockedFormula": _columns(fill for fill in sheet.fills if not fill.style.locked),
        "numberStoredAsText": texts,
    }
    return [(_ranges(runs), together) for together, runs in sorted(_apart(kinds).items())]


def _whole(fills: tuple[Fill, ...]) -> list[tuple[str, tuple[str, ...]]]:
    """One range for a sheet of working cells, where no filled column has a middle."""
    if not fills:
        return []
    top, left = min(fill.row for fill in fills), min(fill.col for fill in fills)
    end, right = max(fill.row + fill.rows for fill in fills), max(fill.col + fill.cols for fill in fills)
    return [(area_name(top, left, end - top, right - left), ("evalError", "formula", "formulaRange"))]


def _apart(kinds: dict[str, list[Run]]) -> dict[tuple[str, ...], list[Run]]:
    """Kinds that hold together -> where just these do."""
    columns: dict[int, list[tuple[int, int, str]]] = {}
    for kind, runs in kinds.items():
        for col, first, last in runs:
            columns.setdefault(col, []).append((first, last + 1, kind))
    found: dict[tuple[str, ...], list[Run]] = {}
    for col, spans in columns.items():
        cuts = sorted({row for first, end, _ in spans for row in (first, end)})
        on: set[str] = set()
        for row, end in pairwise(cuts):
            on -= {kind for _, stop, kind in spans if stop == row}
            on |= {kind for start, _, kind in spans if start == row}
            if on:
                found.setdefault(tuple(sorted(on)), []).append((col, row, end - 1))
    return found


def _edges(fill: Fill) -> Iterator[Place]:
    """The first and the last cell of each column: there the neighbours are others."""
    for col in range(fill.col, fill.col + fill.cols):
        yield fill.row, col
        yield fill.row + fill.rows - 1, col


def _reads_range(fill: Fill) -> bool:
    return any(isinstance(node, RangeRef) for node in walk(fill.formula))


def _numeric_texts(sheet: Sheet) -> Iterator[Place]:
    for cell in sheet.cells:
        text = cell.value
        if isinstance(text, str) and _NUMBER.fullmatch(text):
            yield cell.row, cell.col


def _columns(fills: Iterable[Fill]) -> list[Run]:
    """Formulas as runs down the columns; runs that touch are one."""
    runs = sorted((col, f.row, f.row + f.rows - 1) for f in fills for col in range(f.col, f.col + f.cols))
    joined: list[Run] = []
    for col, first, last in runs:
        if joined and joined[-1][0] == col and joined[-1][2] + 1 == first:
            joined[-1] = col, joined[-1][1], last
        else:
            joined.append((col, first, last))
    return joined


def _runs(places: Iterable[Place]) -> list[Run]:
    """Cells as runs down the columns."""
    by_col = sorted({(col, row) for row, col in places})
    runs: list[Run] = []
    for _, group in groupby(enumerate(by_col), key=lambda item: (item[1][0], item[1][1] - item[0])):
        cells = [cell for _, cell in group]
        runs.append((cells[0][0], cells[0][1], cells[-1][1]))
    return runs


def _ranges(runs: Iterable[Run]) -> str:
    """Runs as ranges; equal ones side by side are one."""
    areas: list[list[int]] = []
    for first, last, col in sorted((first, last, col) for col, first, last in runs):
        if areas and areas[-1][:2] == [first, last] and areas[-1][3] + 1 == col:
            areas[-1][3] = col
        else:
            areas.append([first, last, col, col])
    return " ".join(area_name(first, left, last - first + 1, right - left + 1) for first, last, left, right in areas)

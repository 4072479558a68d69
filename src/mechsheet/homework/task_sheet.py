"""The sheet that a student is given: own dimensions, the driver's column, headings of what is asked; no answer anywhere."""

from __future__ import annotations

import numpy as np

from mechsheet import reference
from mechsheet.homework.marking_rules import asked_of
from mechsheet.model import Mechanism
from mechsheet.sheet.workbook import Cell, Column, Properties, Sheet, Style, Workbook
from mechsheet.words.homework import said

TITLE = Style(bold=True, size=14.0)
HEAD = Style(bold=True, fill="DDE6F0", border="thin", align="center", wrap=True)
INPUT = Style(fill="FFF7D6", border="thin", locked=False)
DRIVEN = Style(border="thin", fill="F3F3F3", number_format="0.####")
EMPTY = Style(border="thin", locked=False)
FIRST = 4
"""Row of the first dimension, from 0."""


def task_sheet(mechanism: Mechanism, identifier: str, name: str) -> Workbook:
    """The workbook of one student; `mechanism` has this student's dimensions."""
    language = mechanism.language
    cells = [
        Cell(0, 0, mechanism.title.of(language), TITLE),
        Cell(1, 0, said(language, "task.student")),
        Cell(1, 1, identifier),
        Cell(1, 2, name),
        Cell(2, 0, said(language, "task.hint")),
    ]
    row = FIRST
    for dim in mechanism.dimensions:
        if dim.derived or dim.place or (dim.shown is None and not isinstance(dim.value, float)):
            continue
        unit = mechanism.shown(dim.unit).symbol
        label = f"{dim.symbol} [{unit}]" if unit else dim.symbol
        cells += [Cell(row, 0, label), Cell(row, 1, _own(dim.value, dim.unit.to_shown), INPUT)]
        if dim.label is not None:
            cells.append(Cell(row, 2, dim.label.of(language)))
        row += 1
    asked = asked_of(mechanism).marks
    summaries = {summary.symbol for summary in mechanism.summaries}
    row += 1
    for symbol in [symbol for symbol in asked if symbol in summaries]:
        cells += [Cell(row, 0, symbol), Cell(row, 1, None, EMPTY)]
        row += 1
    row += 1
    columns = [symbol for symbol in asked if symbol not in summaries]
    values = reference.driver_values(mechanism, reference.dimension_values(mechanism))
    shown = mechanism.shown(mechanism.driver.unit).symbol
    cells.append(Cell(row, 0, f"{mechanism.driver.symbol} [{shown}]", HEAD))
    cells += [Cell(row, col, symbol, HEAD) for col, symbol in enumerate(columns, 1)]
    for number, value in enumerate(np.asarray(mechanism.driver.unit.to_shown(values), float).tolist(), 1):
        cells.append(Cell(row + number, 0, round(value, 10), DRIVEN))
        cells += [Cell(row + number, col, None, EMPTY) for col in range(1, len(columns) + 1)]
    sheet = Sheet(
        said(language, "task.sheet"), tuple(cells), columns=(Column(0, 0, 22.0), Column(1, max(1, len(columns)), 14.0))
    )
    title = mechanism.title.of(language)
    return Workbook((sheet,), properties=Properties(title=title, language=language))


def _own(value: object, shown: object) -> float:
    return round(float(shown(value)), 10)  # type: ignore[operator]

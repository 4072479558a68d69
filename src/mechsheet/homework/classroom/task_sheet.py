"""The sheet that a student is given: own dimensions, the driver's column, headings of what is asked; no answer anywhere."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from mechsheet import reference
from mechsheet.compiled import Compiled
from mechsheet.homework.marking_rules import asked_of
from mechsheet.model import Words
from mechsheet.sheet.workbook import Cell, Column, PrintSetup, Properties, Sheet, Style, Workbook
from mechsheet.words.equations import phrase
from mechsheet.words.homework import said

TITLE = Style(bold=True, size=14.0)
HEAD = Style(bold=True, fill="DDE6F0", border="thin", align="center", wrap=True)
INPUT = Style(fill="FFF7D6", border="thin", locked=False)
DRIVEN = Style(border="thin", fill="F3F3F3", number_format="0.####")
EMPTY = Style(border="thin", locked=False)
FIRST = 4
"""Row of the first dimension, from 0."""
NEARLY = 1e-9
"""A point that is nearer to a line, in parts of its distance, lies on it."""


def task_sheet(compiled: Compiled, identifier: str, name: str) -> Workbook:
    """The workbook of one student, whose dimensions the mechanism has."""
    mechanism = compiled.mechanism
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
    summaries = {summary.symbol: summary for summary in mechanism.summaries}
    row += 1
    for symbol in [symbol for symbol in asked if symbol in summaries]:
        cells += [Cell(row, 0, symbol), Cell(row, 1, None, EMPTY)]
        meaning = summaries[symbol].label
        if meaning is not None:
            cells.append(Cell(row, 2, meaning.of(language)))
        row += 1
    row += 1
    for line in _meanings(compiled, [symbol for symbol in asked if symbol not in summaries]):
        cells.append(Cell(row, 0, line))
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
        said(language, "task.sheet"),
        tuple(cells),
        columns=(Column(0, 0, 22.0), Column(1, max(1, len(columns)), 14.0)),
        print_setup=PrintSetup(landscape=False, fit_height=1),
    )
    title = mechanism.title.of(language)
    return Workbook((sheet,), properties=Properties(title=title, language=language))


def _meanings(compiled: Compiled, columns: list[str]) -> Iterator[str]:
    """Which assembly is meant, and what each column is to hold. Of links that are solved all at once an assembly is told
    by numbers: they would be an answer."""
    language = compiled.mechanism.language
    for group in compiled.equations.groups:
        if group.mode and group.system is None:
            yield f"{said(language, 'task.assembly')}: {group.mode_words.of(language)}"
    yield from (side.of(language) for side in _sides(compiled))
    meant = {each.symbol: each.label.of(language) for each in compiled.equations.columns}
    yield from (f"{symbol}: {meant[symbol]}" for symbol in columns if meant.get(symbol))
    yield said(language, "task.angles")


def _sides(compiled: Compiled) -> Iterator[Words]:
    """On which side of its first two points each further point of a link lies: lengths leave it open."""
    closed = np.flatnonzero(compiled.closed)
    if not closed.size:
        return
    for link in compiled.mechanism.links:
        if len(link.points) < 3:
            continue
        start, end, *others = link.points
        for point in others:
            x, y = (
                [float(compiled.values[f"{name}.{axis}"][closed[0]]) for name in (start, end, point)] for axis in "xy"
            )
            along, aside = (x[1] - x[0], y[1] - y[0]), (x[2] - x[0], y[2] - y[0])
            side = along[0] * aside[1] - along[1] * aside[0]
            if abs(side) > NEARLY * math.hypot(*along) * math.hypot(*aside):
                yield phrase("left_of" if side > 0 else "right_of", point=point, start=start, end=end)


def _own(value: object, shown: object) -> float:
    return round(float(shown(value)), 10)  # type: ignore[operator]

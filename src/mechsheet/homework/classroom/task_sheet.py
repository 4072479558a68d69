"""The sheet that a student is given: a figure, own dimensions, the task in words, the driver's column, headings of what is
asked; no answer anywhere."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from livesheet.workbook import PLAIN, Cell, Column, Content, PrintSetup, Properties, Sheet, Style, Workbook
from mechsheet import reference
from mechsheet.compiled import Compiled
from mechsheet.homework.classroom.figure import SIZE as FIGURE
from mechsheet.homework.classroom.figure import Figure
from mechsheet.homework.classroom.statement import Statement
from mechsheet.homework.marking_rules import asked_of
from mechsheet.words.homework import said

TITLE = Style(bold=True, size=14.0)
SECTION = Style(bold=True)
HEAD = Style(bold=True, fill="DDE6F0", border="thin", align="center", wrap=True)
INPUT = Style(fill="FFF7D6", border="thin", locked=False)
DRIVEN = Style(border="thin", fill="F3F3F3", number_format="0.####")
EMPTY = Style(border="thin", locked=False)
FIRST = 4
"""Row of the figure, from 0."""
ROW = 20
"""Height of a row [pixels]."""


def task_sheet(compiled: Compiled, identifier: str, name: str, figure: Figure) -> Workbook:
    """The workbook of one student, whose dimensions the mechanism has."""
    mechanism = compiled.mechanism
    language = mechanism.language
    asked = list(asked_of(mechanism).marks)
    told = Statement(compiled, asked)
    page = _Page()
    page.put(0, mechanism.title.of(language), TITLE)
    page.row = 1
    page.line((said(language, "task.student"), identifier, name))
    page.line((said(language, "task.hint"),))
    chart, data = figure.on(FIRST)
    page.row = FIRST + FIGURE // ROW + 1
    if mechanism.exercise is not None and mechanism.exercise.vary:
        page.line((said(language, "task.scale"),))
    page.section(said(language, "task.given"))
    for dim, number, label in told.given():
        unit = mechanism.shown(dim.unit).symbol
        page.put(1, number, INPUT)
        page.line((f"{dim.symbol} [{unit}]" if unit else dim.symbol, None, label or None))
    page.lines(said(language, "task.derived"), told.derived())
    page.lines(said(language, "task.links"), told.links())
    page.lines(said(language, "task.joints"), told.joints())
    page.lines(said(language, "task.loads"), told.loads())
    page.lines(said(language, "task.driver"), [*told.driver(), *told.assemblies()])
    page.lines(said(language, "task.asked"), told.meanings())
    page.row += 1
    summaries = {one.symbol for one in mechanism.motion_numbers}
    for symbol in [symbol for symbol in asked if symbol in summaries]:
        page.put(1, None, EMPTY)
        page.line((symbol,))
    page.row += 1
    columns = [symbol for symbol in asked if symbol not in summaries]
    page.table(compiled, columns)
    sheet = Sheet(
        said(language, "task.sheet"),
        tuple(page.cells),
        columns=(Column(0, 0, 22.0), Column(1, max(1, len(columns)), 14.0)),
        row_heights=tuple((row, float(ROW)) for row in range(FIRST, FIRST + FIGURE // ROW + 1)),
        charts=(chart,),
        print_setup=PrintSetup(landscape=False),
    )
    title = mechanism.title.of(language)
    return Workbook((sheet, data), properties=Properties(title=title, language=language, author="mechsheet"))


class _Page:
    """A sheet written line by line."""

    def __init__(self) -> None:
        self.cells: list[Cell] = []
        self.row = 0

    def put(self, col: int, content: Content, style: Style = PLAIN) -> None:
        """A cell of this line."""
        self.cells.append(Cell(self.row, col, content, style))

    def line(self, contents: Sequence[Content]) -> None:
        """A line of cells."""
        for col, content in enumerate(contents):
            if content is not None:
                self.put(col, content)
        self.row += 1

    def section(self, title: str) -> None:
        """A heading after an empty line."""
        self.row += 1
        self.put(0, title, SECTION)
        self.row += 1

    def lines(self, title: str, several: Iterable[Content]) -> None:
        """A heading with its lines; nothing where there are none."""
        found = list(several)
        if found:
            self.section(title)
        for one in found:
            self.line((one,))

    def table(self, compiled: Compiled, columns: Sequence[str]) -> None:
        """The driver's values, what is listed beside them, and the columns to fill in."""
        mechanism = compiled.mechanism
        driver = mechanism.driver
        values = reference.driver_values(mechanism, reference.dimension_values(mechanism))
        given = {driver.symbol: np.asarray(driver.unit.to_shown(values), float)}
        for symbol in mechanism.given_by_row:
            unit = mechanism.given_unit(symbol)
            given[symbol] = np.asarray(unit.to_shown(compiled.given[symbol]) if unit else compiled.given[symbol], float)
        for col, symbol in enumerate(given):
            unit = mechanism.given_unit(symbol)
            shown = mechanism.shown(unit).symbol if unit else ""
            self.put(col, f"{symbol} [{shown}]" if shown else symbol, HEAD)
        for col, symbol in enumerate(columns, len(given)):
            self.put(col, symbol, HEAD)
        for row in range(len(values)):
            self.row += 1
            for col, numbers in enumerate(given.values()):
                self.put(col, round(float(numbers[row]), 10), DRIVEN)
            for col in range(len(given), len(given) + len(columns)):
                self.put(col, None, EMPTY)

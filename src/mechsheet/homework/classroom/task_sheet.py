"""The sheet that a student is given: a figure, own dimensions, the task in words, the driver's column, headings of what is
asked; no answer anywhere."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from livesheet.workbook import (
    PLAIN,
    Cell,
    Column,
    Content,
    PrintSetup,
    Properties,
    Rich,
    Sheet,
    Style,
    Workbook,
    plain_text,
)
from mechsheet.compiled import Compiled
from mechsheet.homework.classroom.figure import Figure
from mechsheet.homework.classroom.statement import Names, Statement
from mechsheet.homework.expected_values import asked_of
from mechsheet.units import Unit
from mechsheet.words.catalogue import said

TITLE = Style(bold=True, size=14.0)
SECTION = Style(bold=True)
HEAD = Style(bold=True, fill="DDE6F0", border="thin", align="center", wrap=True)
INPUT = Style(fill="FFF7D6", border="thin", locked=False)
DRIVEN = Style(border="thin", fill="F3F3F3", number_format="0.####")
SAID = Style(indent=1)
EMPTY = Style(border="thin", locked=False)
NARROWEST, ROOM = 14.0, 3.0
"""Width of a column, and what it has beside its name [letters]."""
FIRST = 4
"""Row of the figure, from 0."""
ROW = 20
"""Height of a row [pixels]."""


def task_sheet(compiled: Compiled, identifier: str, name: str, figure: Figure) -> Workbook:
    """The workbook of one student, whose dimensions the mechanism has."""
    mechanism = compiled.mechanism
    language = mechanism.language
    title = mechanism.title.of(language)
    asked = list(asked_of(mechanism).marks)
    page = _Page(Names(compiled), Statement(compiled, asked))
    page.put(0, title, TITLE)
    page.row = 1
    page.line((said(language, "task.student"), identifier, name))
    page.line((said(language, "task.hint"),))
    chart, data = figure.on(FIRST)
    page.row = FIRST + math.ceil(chart.anchor.height / ROW)
    rows_of_figure = range(FIRST, page.row)
    varies = mechanism.exercise is not None and bool(mechanism.exercise.vary)
    page.line((figure.below(varies),))
    page.dimensions()
    page.words()
    page.row += 1
    summaries = {one.symbol for one in mechanism.motion_numbers}
    for symbol in [symbol for symbol in asked if symbol in summaries]:
        page.beside(page.asked_head(symbol), None, EMPTY)
    page.row += 1
    columns = [symbol for symbol in asked if symbol not in summaries]
    page.table(compiled, columns)
    sheet = Sheet(
        said(language, "task.sheet"),
        tuple(page.cells),
        columns=(Column(0, 0, 22.0), Column(1, max(1, len(columns)), page.width_of(columns))),
        row_heights=tuple((row, float(ROW)) for row in rows_of_figure),
        charts=(chart,),
        print_setup=PrintSetup(landscape=False),
    )
    return Workbook((sheet, data), properties=Properties(title=title, language=language, author="mechsheet"))


class _Page:
    """A sheet written line by line, with what is told of the task."""

    def __init__(self, names: Names, told: Statement) -> None:
        self.names, self.told = names, told
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

    def dimensions(self) -> None:
        """The given ones with their numbers; of those that follow from them how, beside a cell for the number."""
        self.section(self.told.text("given"))
        for dim, number, label in self.told.given():
            self.beside(self.given_head(dim.symbol, dim.unit), number, INPUT, self.names.rich(label) if label else None)
        derived = list(self.told.derived())
        if derived:
            self.section(self.told.text("derived"))
        for dim, formula in derived:
            self.beside(self.given_head(dim.symbol, dim.unit), None, EMPTY, self.names.rich(formula))

    def beside(self, head: Rich | str, content: Content, style: Style, words: Rich | None = None) -> None:
        """A cell beside its name, and what is said of it."""
        self.put(1, content, style)
        if words is not None:
            self.put(2, words, SAID)
        self.line((head,))

    def words(self) -> None:
        """The task in words."""
        told = self.told
        for key, several in (
            ("links", told.links()),
            ("joints", told.joints()),
            ("loads", told.loads()),
            ("driver", (*told.driver(), *told.assemblies())),
            ("asked", (*told.meanings(), *told.marks())),
        ):
            found = list(several)
            if found:
                self.section(told.text(key))
            for one in found:
                self.line((self.names.rich(one),))

    def given_head(self, symbol: str, unit: Unit | None) -> Rich | str:
        """The name of a dimension, or of a column that is given, with its unit."""
        return self.names.head(self.told.head(symbol, unit) if unit else symbol, symbol)

    def asked_head(self, symbol: str) -> Rich | str:
        """The name of what is asked, with its unit."""
        return self.names.head(self.told.asked_head(symbol), symbol)

    def width_of(self, columns: Sequence[str]) -> float:
        """How wide columns are that are to be filled in: a name with its unit stands on one line."""
        return max([NARROWEST, *(len(plain_text(self.asked_head(symbol))) + ROOM for symbol in columns)])

    def table(self, compiled: Compiled, columns: Sequence[str]) -> None:
        """The driver's values, what is listed beside them, and the columns to fill in."""
        mechanism = compiled.mechanism
        driver = mechanism.driver
        given = {driver.symbol: self.told.rows()}
        for symbol in mechanism.given_by_row:
            unit = mechanism.given_unit(symbol)
            given[symbol] = np.asarray(unit.to_shown(compiled.given[symbol]) if unit else compiled.given[symbol], float)
        for col, symbol in enumerate(given):
            self.put(col, self.given_head(symbol, mechanism.given_unit(symbol)), HEAD)
        for col, symbol in enumerate(columns, len(given)):
            self.put(col, self.asked_head(symbol), HEAD)
        for row in range(len(given[driver.symbol])):
            self.row += 1
            for col, numbers in enumerate(given.values()):
                self.put(col, round(float(numbers[row]), 10), DRIVEN)
            for col in range(len(given), len(given) + len(columns)):
                self.put(col, None, EMPTY)

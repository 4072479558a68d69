"""A report on paper: the mechanism at true scale in its worst position, dimensions, what can be said, curves, forces.

One to three pages of A4, drawn by matplotlib; the words and numbers are those of the workbook's first sheet.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from livesheet.formula.nodes import ErrorValue
from livesheet.workbook import Chart, Rich
from mechsheet.compiled import Compiled, compiled_of
from mechsheet.model import Mechanism
from mechsheet.plotting.paper import LINE, QUIET, SMALL, Paper, Row, bound
from mechsheet.plotting.pictures import settings
from mechsheet.plotting.sampling import Sample, sample
from mechsheet.plotting.scenes import Curves, Stage
from mechsheet.shapes.loads import VECTORS
from mechsheet.shapes.positions import Positions, in_digits
from mechsheet.sheet.plan import MEANING, SYMBOL, TOLERANCE, UNIT, VALUE, VERDICT_ROW
from mechsheet.sheet.shown import shown_unit
from mechsheet.units import behind_number
from mechsheet.words.catalogue import words
from mechsheet.words.symbols import plain

if TYPE_CHECKING:
    from matplotlib.figure import Figure

MOST = 3
"""Pages at most: curves that have no room are left out."""

FORCES_HIGH = 95.0
"""How high the drawing with the forces may be, in mm: less than the first one, so that curves find room on its page."""

LOWERED = str.maketrans("0123456789,", "₀₁₂₃₄₅₆₇₈₉,")

RIGHT = 90.0
"""The best angle of transmission, in degrees."""

UNSAID = ("inputs", "sheets")
"""What is said of cells, not of the mechanism."""

GIVEN = ("dimensions", "motion", "gears", "drivers", "masses", "loads")
"""Blocks of the first sheet that describe the mechanism."""


def report(mechanism: Mechanism, at: float | None, language: str | None) -> bytes:
    """The PDF. `at`: the position drawn, instead of the worst one. Raises as `plot` does."""
    mechanism = replace(mechanism, layout="sheets", language=language or mechanism.language)
    first = _FirstSheet(compiled_of(mechanism))
    stage = Stage(sample(mechanism, first.worst if at is None else at, None))
    with settings():
        return bound(_pages(first, stage), mechanism.title.of(mechanism.language))


# --- what is said ----------------------------------------------------------------------------------------------------


class _FirstSheet:
    """What the first sheet of a workbook says, as texts."""

    def __init__(self, compiled: Compiled) -> None:
        self.compiled, self.plan = compiled, compiled.plan
        sheet = compiled.workbook.sheet(self.plan.main)
        self.cells: dict[tuple[int, int], Any] = {(cell.row, cell.col): cell.content for cell in sheet.cells}
        for fill in sheet.fills:
            for row in range(fill.row, fill.row + fill.rows):
                for col in range(fill.col, fill.col + fill.cols):
                    self.cells[row, col] = fill.value(row, col)

    def text(self, row: int, col: int) -> str:
        """What a cell shows; nothing for an error."""
        content = self.cells.get((row, col))
        if isinstance(content, Rich):
            return "".join(text.translate(LOWERED) if style == "sub" else text for text, style in content.parts)
        if isinstance(content, float | int) and not isinstance(content, bool):
            return in_digits(content, 5)
        return "" if content is None or isinstance(content, ErrorValue) else str(content)

    def rows(self, key: str) -> list[Row]:
        """The rows of a block that say something."""
        found = []
        driver = behind_number(self.plan.mechanism.driver.unit.text)
        for symbol, row in self.plan.blocks[key].rows.items() if key in self.plan.blocks else ():
            name = self.text(row, SYMBOL)
            # a count has that of all rows in the place of its unit
            of_rows = "/ " if isinstance(self.cells.get((row, UNIT)), float) else ""
            value, unit = self.text(row, VALUE), self.text(row, UNIT)
            value = f"{value} {of_rows}{unit}".replace(" °", "°").rstrip() if value else ""
            placed = key == "summary" or (key == "verdicts" and symbol in self.plan.places.occurs)
            place = self.text(row, TOLERANCE) if placed else ""
            if (value or self.text(row, MEANING)) and symbol not in UNSAID:
                found.append((name, f"{value} @ {place}{driver}" if place else value, self.text(row, MEANING)))
        return found

    @property
    def verdict(self) -> str:
        """The line under the title."""
        return self.text(VERDICT_ROW, SYMBOL)

    @property
    def worst(self) -> float | None:
        """Where the driver needs most, else where the angle of transmission is worst: the driver's value in its unit."""
        rows = self.plan.blocks["verdicts"].rows
        effort = self.cells.get((rows["largest_effort"], TOLERANCE)) if "largest_effort" in rows else None
        if isinstance(effort, float):
            return effort
        angles = [row for key, row in rows.items() if key.startswith("transmission")]
        found = []
        for row in angles:
            angle, place = (self.cells.get((row, column)) for column in (VALUE, TOLERANCE))
            if isinstance(angle, float) and isinstance(place, float):
                found.append((abs(RIGHT - angle), place))
        return max(found)[1] if found else None


def _springs(found: Sample, positions: Positions) -> list[Row]:
    """Of each spring and damper its largest and its least length, and where the driver stands then."""
    closed, rows = np.flatnonzero(found.closed[: found.sweep]), []
    for name in positions.list.names:
        if name.value is None or name.text not in _springs_of(found.mechanism):
            continue
        lengths = positions.column(name.value)[closed]
        least, most = (f"{in_digits(lengths[at], 4)} {name.unit} @ {_place(found, closed[at])}"
                       for at in (int(np.argmin(lengths)), int(np.argmax(lengths))))  # fmt: skip
        rows.append((name.text, most, words(found.plan.language, "picture.longest", least=least)))
    return rows


def _springs_of(mechanism: Mechanism) -> set[str]:
    return {plain(spring.name) for spring in mechanism.dynamics.springs} if mechanism.dynamics is not None else set()


def _place(found: Sample, row: int) -> str:
    """Where the driver stands in a row."""
    driver = found.plan.mechanism.driver
    shown = in_digits(float(driver.unit.to_shown(float(found.driver[row]))), 4)
    return f"{shown}{behind_number(driver.unit.text)}"


def _largest(found: Sample) -> list[Row]:
    """Of the driver's effort and each joint force the largest, and where the driver stands then; the largest force first."""
    plan, closed = found.plan, np.flatnonzero(found.closed[: found.sweep])
    rows: list[tuple[float, Row]] = []
    for symbol in (*plan.efforts[:1], *plan.held_columns):
        column = np.abs(np.broadcast_to(found.values[symbol], found.driver.shape)[closed])
        if not np.isfinite(column).any():
            continue
        row = closed[int(np.nanargmax(column))]
        amount = f"{in_digits(float(found.values[symbol][row]), 4)} {shown_unit(plan, symbol)}"
        label = plan.equations.of(symbol).label.of(plan.language)
        size = math.inf if symbol in plan.efforts else float(np.nanmax(column))
        rows.append((size, (plain(symbol), f"{amount} @ {_place(found, row)}", label)))
    return [row for _, row in sorted(rows, key=lambda each: -each[0])]


# --- pages -----------------------------------------------------------------------------------------------------------


def _pages(first: _FirstSheet, stage: Stage) -> list[Figure]:
    found = stage.sample
    mechanism, plan = found.mechanism, first.plan
    pages = [Paper()]
    _head(pages[0], first)
    pages[0].drawing(stage.drawing(found.shown), mechanism.length_unit)
    charts = list(zip(stage.charts, stage.at(found.shown, stage.charts), strict=True))
    given: list[Row | str] = []
    for key in GIVEN:
        if rows := first.rows(key):
            given += [plan.text(f"block.{key}"), *rows]
    pages[0].columns(given, 2)
    for key in ("verdicts", "summary"):
        if rows := first.rows(key):
            page = _with_room(pages, (len(rows) + 3) * LINE, charts)
            page.heading(plan.text(f"block.{key}"))
            page.columns(rows, 1)
    if found.plan.held_columns:
        rows = _largest(found)
        page = _with_room(pages, FORCES_HIGH + (len(rows) + 5) * LINE, charts)
        page.heading(words(plan.language, "picture.forces"))
        page.drawing(Positions(found, VECTORS[2:]).at(found.shown), mechanism.length_unit, FORCES_HIGH)
        page.columns(rows, 1)
    if rows := _springs(found, stage.positions):
        page = _with_room(pages, (len(rows) + 3) * LINE, charts)
        page.heading(words(plan.language, "picture.springs"))
        page.columns(rows, 1)
    pages[-1].curves(charts)
    while charts and len(pages) < MOST:
        pages.append(Paper())
        pages[-1].curves(charts)
    return [page.figure for page in pages]


def _with_room(pages: list[Paper], height: float, charts: list[tuple[Chart, Curves]]) -> Paper:
    """The last page, or a new one, after the charts that the last one still has room for."""
    if pages[-1].room < height and len(pages) < MOST:
        pages[-1].curves(charts)
        pages.append(Paper())
    return pages[-1]


def _head(page: Paper, first: _FirstSheet) -> None:
    """Title, source, and the line under the title of the workbook."""
    mechanism, language = first.plan.mechanism, first.plan.language
    page.paragraph(mechanism.title.of(language), 16, "#1F4E79", bold=True)
    if source := mechanism.source.of(language):
        page.paragraph(f"{words(language, 'picture.source')}: {source}", SMALL, QUIET)
    page.down += 0.4 * LINE
    page.paragraph(first.verdict)
    page.down += 0.5 * LINE

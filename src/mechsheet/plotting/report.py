"""A report on paper: the mechanism at true scale in its worst position, dimensions, what can be said, curves, forces.

One to three pages of A4, drawn by matplotlib; the words and numbers are those of the workbook's first sheet.
"""

from __future__ import annotations

import io
import math
import textwrap
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from livesheet.formula.nodes import ErrorValue
from livesheet.workbook import Chart, Rich
from mechsheet.compiled import Compiled, compiled_of
from mechsheet.model import Mechanism
from mechsheet.plotting.pictures import draw, settings
from mechsheet.plotting.sampling import Sample, sample
from mechsheet.plotting.scenes import Curves, Points, Stage
from mechsheet.shapes.loads import VECTORS
from mechsheet.shapes.names import POINTS, half_box
from mechsheet.shapes.positions import Item, Label, Positions, Scene, Stroke, Window, in_digits
from mechsheet.sheet.plan import MEANING, SYMBOL, TOLERANCE, UNIT, VALUE, VERDICT_ROW
from mechsheet.sheet.shown import shown_unit
from mechsheet.units import behind_number
from mechsheet.words.catalogue import words
from mechsheet.words.symbols import plain

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WIDE, HIGH, MARGIN = 210.0, 297.0, 18.0
"""A4 and its margins, in mm."""

INCH, LINE = 25.4, 4.5
"""mm of an inch, and from a line of text to the next."""

LARGEST = (WIDE - 2 * MARGIN, 122.0)
"""How wide and how high a drawing may be, in mm."""

AROUND = 0.04
"""What stays free around a drawing [half windows]."""

MOST = 3
"""Pages at most: curves that have no room are left out."""

_TIMES = [part * 10**power for power in range(7) for part in (1, 1.5, 2, 2.5, 3, 4, 5, 7.5)]
STEPS = (*(1 / times for times in reversed(_TIMES[1:])), *_TIMES)
"""Scales 1 : n that drawings have; those of enlargements are n : 1."""

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "dm": 100.0, "m": 1000.0, "in": INCH, "inch": INCH, "ft": 12 * INCH}
"""Of a length unit; one with another name has no scale on paper."""

LOWERED = str.maketrans("0123456789,", "₀₁₂₃₄₅₆₇₈₉,")

UNSAID = ("inputs",)
"""What is said of cells, not of the mechanism."""

GIVEN = ("dimensions", "motion", "gears", "drivers", "masses", "loads")
"""Blocks of the first sheet that describe the mechanism."""

LOWEST, HIGHEST = 48.0, 68.0
"""How high a chart is at least and at most, in mm."""

DASHES = {"solid": "-", "dash": "--", "dot": ":"}

LETTERS, SMALL = 8.5, 7.5
LETTER, GAP = 1.5, 4.0
"""How wide a small letter is, and what is free between columns of a table, in mm."""

INK, QUIET, RULE = "#1F2933", "#57606A", "#C5CBD3"
ACROSS = 116
"""Letters of a line as wide as the paper."""

Row = tuple[str, str, str]
"""What it is called, its value with its unit, what it means."""


def report(mechanism: Mechanism, at: float | None, language: str | None) -> bytes:
    """The PDF. `at`: the position drawn, instead of the worst one. Raises as `plot` does."""
    mechanism = replace(mechanism, layout="sheets", language=language or mechanism.language)
    first = _FirstSheet(compiled_of(mechanism))
    stage = Stage(sample(mechanism, first.worst if at is None else at, None))
    with settings():
        return _bound(_pages(first, stage), mechanism)


def _bound(pages: Sequence[Figure], mechanism: Mechanism) -> bytes:
    from matplotlib.backends.backend_pdf import PdfPages

    file = io.BytesIO()
    title = mechanism.title.of(mechanism.language)
    about: dict[str, Any] = {"Title": title, "CreationDate": None, "Creator": None, "Producer": None}
    with PdfPages(file, metadata=about) as pdf:
        for number, page in enumerate(pages, 1):
            below = f"{title}    {number} / {len(pages)}"
            page.text(0.5, MARGIN / 2 / HIGH, below, fontsize=SMALL, color=QUIET, ha="center")
            pdf.savefig(page)
    return file.getvalue()


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
            of_rows = (
                "/ " if isinstance(self.cells.get((row, UNIT)), float) else ""
            )  # a count of the rows, in their place
            value = f"{self.text(row, VALUE)} {of_rows}{self.text(row, UNIT)}".replace(" °", "°").strip()
            place = self.text(row, TOLERANCE) if key in ("summary", "verdicts") else ""
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
        for key in ("largest_effort", *(name for name in rows if name.startswith("transmission"))):
            place = self.cells.get((rows[key], TOLERANCE)) if key in rows else None
            if isinstance(place, float):
                return place
        return None


def _largest(found: Sample) -> list[Row]:
    """Of each joint force and the driver's effort the largest, and where the driver stands then."""
    plan, closed = found.plan, np.flatnonzero(found.closed[: found.sweep])
    rows = []
    for symbol in (*plan.efforts[:1], *plan.held_columns):
        column = np.abs(np.broadcast_to(found.values[symbol], found.driver.shape)[closed])
        if not np.isfinite(column).any():
            continue
        row = closed[int(np.nanargmax(column))]
        driver = plan.mechanism.driver
        place = (
            f"{in_digits(float(driver.unit.to_shown(float(found.driver[row]))), 4)}{behind_number(driver.unit.text)}"
        )
        amount = f"{in_digits(float(found.values[symbol][row]), 4)} {shown_unit(plan, symbol)}"
        label = plan.equations.of(symbol).label.of(plan.language)
        rows.append((plain(symbol), f"{amount} @ {place}", label))
    return rows


# --- pages -----------------------------------------------------------------------------------------------------------


class _Paper:
    """A page that is filled from above; places are in mm from its upper left corner."""

    def __init__(self) -> None:
        from matplotlib.figure import Figure

        self.figure = Figure(figsize=(WIDE / INCH, HIGH / INCH))
        self.down = MARGIN

    @property
    def room(self) -> float:
        """What is left above the lower margin."""
        return HIGH - MARGIN - self.down

    def write(self, text: str, x: float, y: float, size: float = LETTERS, color: str = INK, bold: bool = False) -> None:
        """A text that begins at a place."""
        weight = "bold" if bold else "normal"
        self.figure.text(x / WIDE, 1 - y / HIGH, text, fontsize=size, color=color, fontweight=weight, va="baseline")

    def paragraph(self, text: str, size: float = LETTERS, color: str = INK, bold: bool = False) -> None:
        """Lines as wide as the paper."""
        for line in textwrap.wrap(text, int(ACROSS * LETTERS / size)):
            self.down += LINE * size / LETTERS
            self.write(line, MARGIN, self.down, size, color, bold)

    def heading(self, text: str) -> None:
        """A heading, a little below what stands over it."""
        self.down += 0.6 * LINE
        self.paragraph(text, LETTERS + 1, "#1F4E79", bold=True)
        self.down += 0.3 * LINE

    def columns(self, rows: Sequence[Row | str], count: int) -> None:
        """Rows in columns side by side, as many as there is room for; a text alone is a heading."""
        width = (WIDE - 2 * MARGIN) / count
        names, values = (
            max((len(row[part]) for row in rows if not isinstance(row, str)), default=0) for part in (0, 1)
        )
        tabs = 0.0, names * LETTER + GAP, (names + values) * LETTER + 2 * GAP
        letters = int((width - tabs[2]) / LETTER)
        lines = [line for row in rows for line in ([row] if isinstance(row, str) else _broken(row, letters))]
        most = max(1, int(self.room / LINE))
        high = min(max(1, math.ceil(len(lines) / count)), most)
        while high < min(len(lines), most) and isinstance(lines[high - 1], str):  # a heading stands over its rows
            high += 1
        if high * count < len(lines):
            lines[high * count - 1 :] = [("…", "", "")]
        for number, line in enumerate(lines):
            x, y = MARGIN + number // high * width, self.down + (number % high + 1) * LINE
            if isinstance(line, str):
                self.write(line, x, y, SMALL, QUIET, bold=True)
                continue
            for part, tab in zip(line, tabs, strict=True):
                self.write(part, x + tab, y, SMALL, INK if tab else QUIET)
        self.down += high * LINE

    def drawing(self, scene: Scene, unit: str) -> None:
        """A position at the largest scale that has room, and how large that is; without scale bars where it has a name."""
        besides = ("caption",) if _bars(scene) > 1 or unit not in MILLIMETRES else ("caption", "scale")
        shown = [item for item in scene.items if item.kind not in besides]
        low, high = _extent(shown, scene.window)
        shrunk, scale = _on_paper(high - low, unit)
        width, height = ((high - low) * shrunk).tolist()
        axes = self.figure.add_axes(
            ((WIDE - width) / 2 / WIDE, 1 - (self.down + height) / HIGH, width / WIDE, height / HIGH)
        )
        draw(axes, replace(scene, items=tuple(shown)), scene.window.half * shrunk / INCH * 72 / POINTS)
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        self.down += height + LINE
        text = ", ".join(filter(None, (scene.caption, scale)))
        self.figure.text(0.5, 1 - self.down / HIGH, text, fontsize=LETTERS, color=INK, ha="center", va="baseline")
        self.down += 0.7 * LINE

    def curve(self, chart: Chart, curves: Curves, x: float, width: float, height: float) -> None:
        """A chart of the workbook at the position that is drawn."""
        inner = 14.0 if chart.x_axis.visible else 0.0
        place = (
            (x + inner) / WIDE,
            1 - (self.down + height - 9) / HIGH,
            (width - inner - 4) / WIDE,
            (height - 16) / HIGH,
        )
        axes: Any = self.figure.add_axes(place)
        axes.set_title(chart.title, fontsize=SMALL, color=INK, loc="left")
        for piece in curves:
            series, (across, up) = piece.series, piece.points.T
            if series.line:
                axes.plot(
                    across, up, color=f"#{series.line}", linewidth=1.1, linestyle=DASHES[series.dash], label=piece.words
                )
            if series.marker:
                axes.plot(across, up, "o", color=f"#{series.marker_fill or series.marker_line}", markersize=3)
            if series.show_name and piece.words and np.isfinite(piece.points[0]).all():
                side = (0, 0) if series.label_side == "center" else (3, 0)
                axes.annotate(
                    piece.words,
                    piece.points[0],
                    side,
                    textcoords="offset points",
                    fontsize=SMALL - 1,
                    va="center",
                    ha="center" if side == (0, 0) else "left",
                )
        if not chart.x_axis.visible:
            axes.set_axis_off()
            axes.set_aspect("equal")
            return
        axes.grid(color="#DDE1E6", linewidth=0.5)
        axes.tick_params(labelsize=SMALL - 1, colors=QUIET, length=0)
        axes.set_xlabel(chart.x_axis.title, fontsize=SMALL - 1, color=QUIET)
        axes.set_ylabel(chart.y_axis.title, fontsize=SMALL - 1, color=QUIET)
        axes.margins(x=0)
        axes.set_xlim(chart.x_axis.low, chart.x_axis.high)  # what the workbook leaves open is chosen by the curves
        axes.set_ylim(chart.y_axis.low, chart.y_axis.high)
        if len(axes.lines) > 2:
            axes.legend(fontsize=SMALL - 1.5, frameon=False, handlelength=1.2, labelspacing=0.2)
        for spine in axes.spines.values():
            spine.set_color(RULE)

    def curves(self, left: list[tuple[Chart, Curves]]) -> None:
        """Charts two by two, while there is room; they are taken from the list."""
        self.down += LINE
        lines = min(math.ceil(len(left) / 2), int(self.room / LOWEST))
        width, height = (WIDE - 2 * MARGIN) / 2, min(HIGHEST, self.room / max(1, lines))
        for _ in range(lines):
            for column in range(2):
                if left:
                    chart, curves = left.pop(0)
                    self.curve(chart, curves, MARGIN + column * width, width, height)
            self.down += height


def _pages(first: _FirstSheet, stage: Stage) -> list[Figure]:
    found = stage.sample
    mechanism, plan = found.mechanism, first.plan
    pages = [_Paper()]
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
        page = _with_room(pages, LARGEST[1] + (len(rows) + 4) * LINE, charts)
        page.heading(words(plan.language, "picture.forces"))
        page.drawing(Positions(found, VECTORS[2:]).at(found.shown), mechanism.length_unit)
        page.columns(rows, 1)
    pages[-1].curves(charts)
    while charts and len(pages) < MOST:
        pages.append(_Paper())
        pages[-1].curves(charts)
    return [page.figure for page in pages]


def _with_room(pages: list[_Paper], height: float, charts: list[tuple[Chart, Curves]]) -> _Paper:
    """The last page, or a new one, after the charts that the last one still has room for."""
    if pages[-1].room < height and len(pages) < MOST:
        pages[-1].curves(charts)
        pages.append(_Paper())
    return pages[-1]


def _head(page: _Paper, first: _FirstSheet) -> None:
    """Title, source, and the line under the title of the workbook."""
    mechanism, language = first.plan.mechanism, first.plan.language
    page.paragraph(mechanism.title.of(language), 16, "#1F4E79", bold=True)
    if source := mechanism.source.of(language):
        page.paragraph(f"{words(language, 'picture.source')}: {source}", SMALL, QUIET)
    page.down += 0.4 * LINE
    page.paragraph(first.verdict)
    page.down += 0.5 * LINE


def _broken(row: Row, letters: int) -> list[Row]:
    """A row, its meaning in as many lines as it takes."""
    lines = textwrap.wrap(row[2], letters) or [""]
    return [(row[0], row[1], lines[0]), *(("", "", line) for line in lines[1:])]


def _bars(scene: Scene) -> int:
    """How many scale bars there are: of lengths, and of arrows."""
    return sum(item.kind == "scale" and isinstance(item, Stroke) for item in scene.items)


def _extent(items: Sequence[Item], window: Window) -> tuple[Points, Points]:
    """The lower left and the upper right corner of what is drawn in the window."""
    found = []
    for item in items:
        if isinstance(item, Stroke):
            found.append(item.points)
        else:
            half = half_box(item.text, item.size) * window.half if isinstance(item, Label) else np.zeros(2)
            found += [np.array([[item.x, item.y]]) - half, np.array([[item.x, item.y]]) + half]
    places, middle = np.concatenate(found), np.array([window.x, window.y])
    low, high = np.nanmin(places, axis=0), np.nanmax(places, axis=0)
    around = AROUND * window.half
    return np.maximum(low, middle - window.half) - around, np.minimum(high, middle + window.half) + around


def _on_paper(sides: Points, unit: str) -> tuple[float, str]:
    """mm on paper of a length unit, and the scale, where the unit is known."""
    fits = min((room / side for room, side in zip(LARGEST, sides.tolist(), strict=True)))
    if unit not in MILLIMETRES:
        return fits, ""
    true = MILLIMETRES[unit]
    step = next((step for step in STEPS if true / step <= fits), STEPS[-1])
    return true / step, f"1 : {step:g}" if step >= 1 else f"{1 / step:g} : 1"

"""Paper: pages of A4 that are filled from above with texts, columns, drawings at true scale and curves; and the PDF of them.

Places are in mm from a page's upper left corner. Matplotlib draws.
"""

from __future__ import annotations

import io
import math
import re
import textwrap
from collections.abc import Sequence
from dataclasses import replace
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np

from livesheet.workbook import Chart
from mechsheet.plotting.pictures import draw
from mechsheet.plotting.scenes import Curves, Points, extent, without_caption
from mechsheet.shapes.names import POINTS
from mechsheet.shapes.positions import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

WIDE, HIGH, MARGIN = 210.0, 297.0, 18.0
"""A4 and its margins, in mm."""

INCH, LINE = 25.4, 4.5
"""mm of an inch, and from a line of text to the next."""

LARGEST = (WIDE - 2 * MARGIN, 122.0)
"""How wide and how high a drawing may be, in mm."""

_TIMES = [part * 10**power for power in range(7) for part in (1, 1.5, 2, 2.5, 3, 4, 5, 7.5)]
STEPS = (*(1 / times for times in reversed(_TIMES[1:])), *_TIMES)
"""Scales 1 : n that drawings have; those of enlargements are n : 1."""

MILLIMETRES = {"mm": 1.0, "cm": 10.0, "dm": 100.0, "m": 1000.0, "in": INCH, "inch": INCH, "ft": 12 * INCH}
"""Of a length unit; one with another name has no scale on paper."""

LOWEST, HIGHEST = 48.0, 68.0
"""How high a chart is at least and at most, in mm."""

DASHES = {"solid": "-", "dash": "--", "dot": ":"}

LETTERS, SMALL = 8.5, 7.5
LETTER, GAP = 1.5, 4.0
"""How wide a small letter is, about, and what is free between columns of a table, in mm."""

RAISED, SMALLER = {"sub": -0.8, "super": 1.1}, 0.72
"""How far subscripts and superscripts are from the line, in mm, and their size, as a part of that of letters."""

INDENT = 5.0
"""How far to the right a line goes on, in mm."""

INK, QUIET, RULE = "#1F2933", "#57606A", "#C5CBD3"
ACROSS = 116
"""Letters of a line as wide as the paper."""

Row = tuple[str, str, str]
"""What it is called, its value with its unit, what it means."""


def bound(pages: Sequence[Figure], title: str) -> bytes:
    """The PDF of some pages, numbered; the same pages give the same bytes."""
    from matplotlib.backends.backend_pdf import PdfPages

    file = io.BytesIO()
    about: dict[str, Any] = {"Title": title, "CreationDate": None, "Creator": None, "Producer": None}
    with PdfPages(file, metadata=about) as pdf:
        for number, page in enumerate(pages, 1):
            below = f"{title}    {number} / {len(pages)}"
            page.text(0.5, MARGIN / 2 / HIGH, below, fontsize=SMALL, color=QUIET, ha="center")
            pdf.savefig(page)
    return file.getvalue()


class Paper:
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

    def flow(self, parts: Sequence[tuple[str, str]]) -> None:
        """A line of mathematics and words, as wide as the paper: (text, "", "italic", "sub" or "super") each; what does not
        fit goes on below, a little to the right.
        """
        self.down += LINE
        x = MARGIN
        for word in _words(parts):
            width = sum(_width(text, style) for text, style in word)
            if x > MARGIN and x + width - _width(" ", "") > WIDE - MARGIN:
                self.down += LINE
                x = MARGIN + INDENT
            for text, style in word:
                self._piece(text, style, x)
                x += _width(text, style)

    def _piece(self, text: str, style: str, x: float) -> None:
        slant = "italic" if style == "italic" else "normal"
        place = x / WIDE, 1 - (self.down - RAISED.get(style, 0.0)) / HIGH
        self.figure.text(*place, text, fontsize=_size(style), color=INK, fontstyle=slant, va="baseline")

    def heading(self, text: str) -> None:
        """A heading, a little below what stands over it."""
        self.down += 0.6 * LINE
        self.paragraph(text, LETTERS + 1, "#1F4E79", bold=True)
        self.down += 0.3 * LINE

    def columns(self, rows: Sequence[Row | str], count: int) -> None:
        """Rows in columns side by side, as many as there is room for; a text alone is a heading."""
        width = (WIDE - 2 * MARGIN) / count
        texts = [row for row in rows if not isinstance(row, str)]
        names, values = (
            max((_width(row[part], "") for row in texts), default=0.0) * SMALL / LETTERS for part in (0, 1)
        )
        tabs = 0.0, names + GAP, names + values + 2 * GAP
        letters = int((width - tabs[2]) / LETTER)
        lines = [line for row in rows for line in ([row] if isinstance(row, str) else _broken(row, letters))]
        most = max(1, int(self.room / LINE))
        high = min(max(1, math.ceil(len(lines) / count)), most)
        # a heading stands over its rows, and what a row goes on with below it
        while high < min(len(lines), most) and (isinstance(lines[high - 1], str) or _goes_on(lines[high])):
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

    def drawing(self, scene: Scene, unit: str, highest: float = LARGEST[1], below: str | None = None) -> None:
        """A position at the largest scale that has room, and how large that is; without scale bars where it has a name.

        highest  it may be, in mm;  below  what stands below it instead
        """
        shown = without_caption(scene, unit not in MILLIMETRES)
        low, high = extent(shown, scene.window)
        shrunk, scale = _on_paper(high - low, unit, highest)
        width, height = ((high - low) * shrunk).tolist()
        axes = self.figure.add_axes(
            ((WIDE - width) / 2 / WIDE, 1 - (self.down + height) / HIGH, width / WIDE, height / HIGH)
        )
        draw(axes, replace(scene, items=tuple(shown)), scene.window.half * shrunk / INCH * 72 / POINTS)
        axes.set_xlim(low[0], high[0])
        axes.set_ylim(low[1], high[1])
        self.down += height + LINE
        text = ", ".join(filter(None, (scene.caption, scale))) if below is None else below
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
        axes.yaxis.get_offset_text().set(fontsize=SMALL - 1, color=QUIET)  # the power of ten over an axis
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


def _words(parts: Sequence[tuple[str, str]]) -> list[list[tuple[str, str]]]:
    """The pieces of each word, with the space behind it; words end where letters of the line have a space."""
    words: list[list[tuple[str, str]]] = [[]]
    for text, style in parts:
        if style in RAISED:
            words[-1].append((text, style))
            continue
        for piece in re.findall(r"[^ ]* ?", text):
            if piece:
                words[-1].append((piece, style))
            if piece.endswith(" "):
                words.append([])
    return [word for word in words if word]


def _size(style: str) -> float:
    return LETTERS * (SMALLER if style in RAISED else 1.0)


@cache
def _width(text: str, style: str) -> float:
    """In mm, of the font's own measures."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import TextToPath

    font = FontProperties(family="DejaVu Sans", size=_size(style), style="italic" if style == "italic" else "normal")
    width, _, _ = TextToPath().get_text_width_height_descent(text, font, ismath=False)
    return float(width) * INCH / 72


def _broken(row: Row, letters: int) -> list[Row]:
    """A row, its meaning in as many lines as it takes."""
    lines = textwrap.wrap(row[2], letters) or [""]
    return [(row[0], row[1], lines[0]), *(("", "", line) for line in lines[1:])]


def _goes_on(line: Row | str) -> bool:
    """Whether it is a further line of the row above."""
    return not isinstance(line, str) and not (line[0] or line[1])


def _on_paper(sides: Points, unit: str, highest: float) -> tuple[float, str]:
    """mm on paper of a length unit, and the scale, where the unit is known."""
    fits = min((room / side for room, side in zip((LARGEST[0], highest), sides.tolist(), strict=True)))
    if unit not in MILLIMETRES:
        return fits, ""
    true = MILLIMETRES[unit]
    step = next((step for step in STEPS if true / step <= fits), STEPS[-1])
    return true / step, f"1 : {step:g}" if step >= 1 else f"{1 / step:g} : 1"

"""The charts of the sheet of synthesis: the positions that the task asks for, at true scale, and the curve."""

from __future__ import annotations

import math
from typing import Literal

from livesheet.formula import algebra as al
from livesheet.formula.nodes import CellRef, Node, RangeRef
from livesheet.workbook import Anchor, Area, Axis, Chart, Series, SeriesRef
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import HIDDEN_AXIS
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.synthesis.page import Page
from mechsheet.sheet.synthesis.tables import THETA, curve_columns, has_points
from mechsheet.sheet.task_rows import CHARTS, FIRST_ROW, MEANING, ROUNDED, SYMBOL, UNIT, USED, VALUE, WINDOW
from mechsheet.synthesis.kind import Line
from mechsheet.words.symbols import plain

SIZE, LEGEND, HEIGHT, GAP = 286, 72, 240, 12
"""Pixels: the side of the figure, what its title and legend take, the height of the curve below it, the space around."""

INNER = (0.02, 34 / (SIZE + LEGEND), 0.96, 0.96 * SIZE / (SIZE + LEGEND))
"""Square, so that a circle is round."""

MARGIN = 1.2
"""The figure's window is larger than what it shows, by the names of its points."""


SIDES: dict[str, Literal["right", "left", "above", "below"]] = {"0": "below", "1": "right", "2": "above", "3": "left"}
"""Where a point's name stands, by its number: places of one point that lie close together would cover each other's names."""


BESIDE = "\N{EN SPACE}"
"""Between a point's mark and its name to the right or left of it."""


def write_figure(page: Page) -> None:
    """The points of the figure, their window, and where they lie in it."""
    lines = page.kind.figure(page.given)
    page.heading("figure", value="x", rounded="y", used="X", meaning="Y")
    count = sum(len(line.vertices) for line in lines)
    first = page.rows.of["figure", "0"]
    columns = {
        axis: RangeRef(CellRef(first, col, True, True), CellRef(first + count - 1, col, True, True))
        for axis, col in (("x", VALUE), ("y", ROUNDED))
    }
    window = {key: CellRef(page.rows.of["figure", key], VALUE, True, True) for key in WINDOW}
    style = page.number_style("length", styles.RESULT)
    for axis in "xy":
        middle = formula("(MAX(column)+MIN(column))/2", column=columns[axis])
        _window(page, axis, middle)
    spans = [formula("MAX(column)-MIN(column)", column=columns[axis]) for axis in "xy"]
    _window(page, "half", al.mul(al.number(MARGIN / 2), al.largest(spans)))
    row = first
    for line in lines:
        for name, x, y in line.vertices:
            page.put(row, SYMBOL, name, styles.SYMBOL)
            page.formula(row, VALUE, page.shown(page.tree(x), "length"), style)
            page.put(row, UNIT, page.unit_text("length"), styles.UNIT)
            page.formula(row, ROUNDED, page.shown(page.tree(y), "length"), style)
            for axis, col, shown in (("x", VALUE, USED), ("y", ROUNDED, MEANING)):
                place = formula("(cell-middle)/half", cell=CellRef(row, col), middle=window[axis], half=window["half"])
                page.formula(row, shown, place, styles.decimals(styles.INNER, 4))
            row += 1
    page.charts.append(_figure(page, lines, first))


def _window(page: Page, key: str, node: Node) -> None:
    row = page.rows.of["figure", key]
    page.put(row, SYMBOL, page.text(f"figure.window.{key}"), styles.SYMBOL)
    page.formula(row, VALUE, formula("IFERROR(node,NA())", node=node), page.number_style("length", styles.RESULT))
    page.put(row, UNIT, page.unit_text("length"), styles.UNIT)


def _figure(page: Page, lines: list[Line], first: int) -> Chart:
    series, row = [], first
    for line in lines:
        last = row + len(line.vertices) - 1
        color = styles.SERIES[line.color % len(styles.SERIES)]
        x, y = (SeriesRef(page.title, Area(row, col, last, col)) for col in (USED, MEANING))
        name = page.text(line.key, number=line.number)
        legend = line.pins or not line.number  # what belongs to a position is told by the names of its points
        width, marker = (2.0, "circle") if line.pins else (1.25, "")
        series.append(
            Series(
                name, x, y, line=color, width=width, dash=line.dash, marker=marker, marker_line=color,
                marker_fill="FFFFFF", in_legend=legend,
            )
        )  # fmt: skip
        row = last + 1
    title = page.text(f"figure.{page.given.kind}")
    return Chart(
        title,
        Anchor(FIRST_ROW, CHARTS, SIZE, SIZE + LEGEND, dx=GAP),
        (*series, *_named_points(page, lines, first)),
        HIDDEN_AXIS,
        HIDDEN_AXIS,
        legend="bottom",
        inner=INNER,
        name="synthesis figure",
        alt_text=title,
    )


def _named_points(page: Page, lines: list[Line], first: int) -> list[Series]:
    """A label at each point that has a name; one that several lines share is named once."""
    named: dict[str, int] = {}
    for row, (name, _, _) in enumerate((vertex for line in lines for vertex in line.vertices), first):
        if name:
            named.setdefault(name, row)
    series = []
    for name, row in named.items():
        x, y = (SeriesRef(page.title, Area(row, col, row, col)) for col in (USED, MEANING))
        side = SIDES.get(name[1:], "above")
        shown = {"right": f"{BESIDE}{plain(name)}", "left": f"{plain(name)}{BESIDE}"}.get(side, plain(name))
        series.append(Series(shown, x, y, show_name=True, label_side=side, in_legend=False))
    return series


def write_curve_chart(page: Page) -> None:
    """The curve over its range; of a function generator with the points that are wanted."""
    curve = page.kind.curve(page.given)
    if curve is None:
        return
    places = curve_columns(page.given)
    first = page.rows.of["curve", "0"]
    last = first + curve.rows - 1

    def column(key: str) -> SeriesRef:
        return SeriesRef(page.title, Area(first, places[key], last, places[key]))

    series = [Series(page.text(f"curve.{curve.y}"), column(curve.x), column(curve.y), line=styles.SERIES[0], width=2.0)]
    if curve.wanted:
        wanted = Series(
            page.text("curve.wanted"), column(curve.x), column(curve.wanted), line=styles.SERIES[1], dash="dash"
        )
        series.append(wanted)
    x_axis = Axis(page.text(f"curve.axis.{curve.x}"))
    if has_points(page.given):
        series.append(_points(page))
    elif curve.x == "lam":
        series.append(_here(page))
        tens = math.ceil(page.nominal[page.given.results["lam"]] / 10)  # so that the solution is on the chart
        x_axis = Axis(page.text("curve.axis.lam"), low=0.0 if tens > 1 else 1.0, high=10.0 * tens, step=float(tens))
    title = page.text(f"curve.title.{page.given.kind}")
    anchor = Anchor(FIRST_ROW, CHARTS, SIZE, HEIGHT, dx=GAP, dy=SIZE + LEGEND + GAP)
    page.charts.append(
        Chart(
            title, anchor, tuple(series), x_axis, Axis(page.text(f"curve.axis.{curve.y}")), legend="bottom",
            name="synthesis curve", alt_text=title,
        )
    )  # fmt: skip


def _points(page: Page) -> Series:
    """The precision points: angles of the input beside those of the output, in the rows of what is asked."""
    count = len(page.kind.asked(page.given))
    first = page.rows.of["asked", "0"]
    x = SeriesRef(page.title, Area(first, THETA, first + count - 1, THETA))
    y = SeriesRef(page.title, Area(first, VALUE, first + count - 1, VALUE))
    color = styles.SERIES[1]
    return Series(
        page.text("figure.points"), x, y, marker="circle", marker_size=8, marker_line=color, marker_fill=color
    )


def _here(page: Page) -> Series:
    """The λ of the solution, with its least transmission angle."""
    lam, mu = (page.rows.of["result", name] for name in ("lam", "mu_min"))
    x, y = (SeriesRef(page.title, Area(row, VALUE, row, VALUE)) for row in (lam, mu))
    color = styles.SERIES[1]
    return Series(page.text("curve.here"), x, y, marker="circle", marker_size=9, marker_line=color, marker_fill=color)

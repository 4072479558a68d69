"""The chart of a cam's profile in the cam's own axes, at true scale, with pitch curve, base circle and the place touched."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Node, Symbol
from livesheet.workbook import Anchor, Chart, Series, SeriesRef
from mechsheet.model import ChartRequest
from mechsheet.shapes.cams import PALE
from mechsheet.shapes.colors import INK
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import CHART_X, CHART_Y, HIDDEN_AXIS, NAME, Frame, Page, write_frame
from mechsheet.sheet.over_rows import LEAST, MOST
from mechsheet.sheet.quoted import formula

MARGIN = 1.15
"""How much larger than the outermost curve the window is."""


def profile_chart(page: Page, request: ChartRequest, size: int, inner: tuple[float, float, float, float]) -> Chart:
    """The chart; its curves are as fine as the table's rows."""
    plan, cam = page.plan, page.plan.mechanism.cam
    if cam is None:
        raise ValueError("a profile without a cam")
    title = request.title.of(plan.language) if request.title else plan.text("chart.profile")
    base, outer = al.as_node(cam.base_radius), "cam" if cam.radius is None else "pitch"
    ends = [
        (page.over_motion(outer, LEAST, [Symbol(f"{outer}.{axis}"), al.neg(base)]),
         page.over_motion(outer, MOST, [Symbol(f"{outer}.{axis}"), base]))
        for axis in "xy"
    ]  # fmt: skip
    frame = write_frame(page, plan.text("drawing.profile.frame"), ends[0], ends[1], MARGIN)
    outline = Series(plan.text("drawing.cam.profile"), *_curve(page, frame, "cam"), line=styles.SERIES[0], width=2.25)
    curves = [replace(outline, in_legend=False)]
    if cam.radius is not None:
        pitch = Series(plan.text("drawing.cam.pitch"), *_curve(page, frame, "pitch"), line=PALE, width=1.0, dash="dash")
        curves.append(pitch)
    circle = Series(plan.text("drawing.cam.base"), *_circle(page, frame, page.in_row(base)), line=PALE, width=1.0)
    center = replace(_mark(page, frame, cam.center, (al.ZERO, al.ZERO), INK), marker_size=5, show_name=True)
    touched = (page.at_position("cam.x"), page.at_position("cam.y"))
    marks = [center, _mark(page, frame, plan.text("drawing.cam.touched"), touched, styles.SERIES[0])]
    return Chart(
        title, Anchor(0, 0, size, size), (*curves, circle, *marks, *frame.series), HIDDEN_AXIS, HIDDEN_AXIS,
        legend="bottom", inner=inner, alt_text=title, smooth=bool(np.nanmin(plan.nominal["rho"]) > 0),
    )  # fmt: skip


def _curve(page: Page, frame: Frame, name: str) -> tuple[SeriesRef, SeriesRef]:
    x = page.column(f"X {name}", frame.chart_x(page.read(f"{name}.x")))
    y = page.column(f"Y {name}", frame.chart_y(page.read(f"{name}.y")))
    return SeriesRef(page.title, x), SeriesRef(page.title, y)


def _circle(page: Page, frame: Frame, radius: Node) -> tuple[SeriesRef, SeriesRef]:
    """Once round, whatever the rows show of the turn."""
    first, steps = page.first + 1, max(1, page.samples - 1)
    found = []
    for head, function, chart in (("X", "COS", frame.chart_x), ("Y", "SIN", frame.chart_y)):
        place = formula(f"radius*{function}(2*PI()*(ROW()-first)/steps)", radius=radius, first=first, steps=steps)
        found.append(SeriesRef(page.title, page.column(f"{head} r", chart(place))))
    return found[0], found[1]


def _mark(page: Page, frame: Frame, name: str, at: tuple[Node, Node], color: str) -> Series:
    page.put(NAME, name)
    page.formula(CHART_X, frame.chart_x(at[0]))
    page.formula(CHART_Y, frame.chart_y(at[1]))
    x, y = page.reference(page.row, CHART_X), page.reference(page.row, CHART_Y)
    page.row += 1
    return Series(name, x, y, marker="circle", marker_size=8, marker_line=INK, marker_fill=color, in_legend=False)

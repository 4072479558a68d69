"""Charts of hodographs: the curve of the end of a point's velocity vector, its beginning held still; true scale."""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula import algebra as al
from livesheet.workbook import Anchor, Chart, Series, SeriesRef
from mechsheet.model import ChartRequest
from mechsheet.shapes.colors import INK
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import CHART_X, CHART_Y, HIDDEN_AXIS, NAME, Frame, Page, write_frame
from mechsheet.sheet.over_rows import LEAST, MOST, over_rows
from mechsheet.sheet.symbols import rich
from mechsheet.words.symbols import plain

MARGIN = 1.2
"""How much larger than everything that is drawn the window is."""


def hodograph_chart(page: Page, request: ChartRequest, size: int, inner: tuple[float, float, float, float]) -> Chart:
    """The chart: a curve for each point, the pole, and the vectors at the position shown."""
    plan = page.plan
    names = ", ".join(plain(point) for point in request.hodographs)
    title = request.title.of(plan.language) if request.title else plan.text("chart.hodograph", points=names)
    extremes = []
    for axis in ("x", "y"):
        columns = [plan.at.column(f"{point}.v{axis}", page.title) for point in request.hodographs]
        low, high = ([over_rows(way, column) for column in columns] for way in (LEAST, MOST))
        extremes.append((al.smallest([al.ZERO, *low]), al.largest([al.ZERO, *high])))
    unit = f"{plan.mechanism.length_unit}/s"
    heading = plan.text("drawing.hodograph.frame", points=names)
    frame = write_frame(page, heading, extremes[0], extremes[1], MARGIN, unit=unit)
    series = []
    for index, point in enumerate(request.hodographs):
        color = styles.SERIES[index % len(styles.SERIES)]
        x = page.column(f"X v {plain(point)}", frame.chart_x(page.read(f"{point}.vx")))
        y = page.column(f"Y v {plain(point)}", frame.chart_y(page.read(f"{point}.vy")))
        name = f"v {plain(point)}"
        series.append(Series(name, SeriesRef(page.title, x), SeriesRef(page.title, y), line=color, width=1.75))
    for index, point in enumerate(request.hodographs):
        series += _vector(page, frame, point, styles.SERIES[index % len(styles.SERIES)])
    return Chart(
        title, Anchor(0, 0, size, size), (*series, *frame.series), HIDDEN_AXIS, HIDDEN_AXIS,
        legend="", inner=inner, alt_text=title,
    )  # fmt: skip


def _vector(page: Page, frame: Frame, point: str, color: str) -> list[Series]:
    """The velocity at the position shown: a line from the pole to its end, which has the point's name."""
    pole = page.row
    for text, x, y in (
        (page.plan.text("drawing.pole"), al.ZERO, al.ZERO),
        (rich(f"{point}.v"), page.at_position(f"{point}.vx"), page.at_position(f"{point}.vy")),
    ):
        page.put(NAME, text)
        page.formula(CHART_X, frame.chart_x(x))
        page.formula(CHART_Y, frame.chart_y(y))
        page.row += 1
    both = page.reference(pole, CHART_X, pole + 1), page.reference(pole, CHART_Y, pole + 1)
    end = page.reference(pole + 1, CHART_X), page.reference(pole + 1, CHART_Y)
    name = plain(f"{point}.v")
    line = Series(name, *both, line=INK, width=1.25, in_legend=False)
    return [line, replace(line, x=end[0], y=end[1], line="", marker="circle", marker_size=8, marker_line=INK,
                          marker_fill=color, show_name=True)]  # fmt: skip

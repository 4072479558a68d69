"""The drawing of the mechanism at the position shown and the paths of its points: a sheet of numbers, two kinds of chart.

Left on the sheet stand the frame, the points at the position shown and the corners of every shape; on the right, row by
row like the table of positions, what the frame and the paths need of the whole sweep. A position that does not exist is
#N/A in every cell, and nothing of it is drawn.

Charts of hodographs are drawn of the same rows: the curve of the end of a velocity vector, its beginning held still.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Symbol
from livesheet.workbook import Anchor, Chart, Column, PrintSetup, Series, SeriesRef, Sheet
from mechsheet.model import ChartRequest
from mechsheet.shapes.colors import INK
from mechsheet.shapes.forms import CAPTION, CAPTION_AT, LETTERS
from mechsheet.shapes.names import POINTS
from mechsheet.sheet import styles
from mechsheet.sheet.deleted import gaps_where_deleted
from mechsheet.sheet.drawing.frames import (
    AT,
    CHART_X,
    CHART_Y,
    FIRST,
    HIDDEN_AXIS,
    NAME,
    SWEEP,
    Frame,
    Page,
    beside,
    stride_of,
    write_frame,
)
from mechsheet.sheet.drawing.listed import MOST_SERIES, Listed, PointCells
from mechsheet.sheet.drawing.profile import profile_chart
from mechsheet.sheet.over_rows import LEAST, MOST, over_rows
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.shown import rich
from mechsheet.units import behind_number
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


SIZE = 390
"""Pixels of a drawing and of a chart of paths: square. With title and line above it is seen as a whole on 1366 x 768."""

PATH_MARGIN = 1.15
"""How much larger than all of a path its window is."""

DRAWING_INNER = (0.01, 0.01, 0.98, 0.98)

PATH_INNER = (0.08, 0.12, 0.85, 0.85)


POINTS_OF_A_PIXEL = 0.75


@dataclass(frozen=True, slots=True)
class Drawing:
    """The sheet, the chart of the mechanism, those of paths, hodographs and a profile, and where quantities stand.

    points  the cells of every point at the position shown
    shown   cells with the value at the position shown, as people read it, of symbols that have none on the first sheet
    """

    sheet: Sheet
    chart: Chart
    paths: Mapping[ChartRequest, Chart]
    points: Mapping[str, PointCells]
    shown: Mapping[str, SeriesRef]


def drawing_of(plan: Plan, requests: Sequence[ChartRequest]) -> Drawing:
    """The sheet "Drawing" with its charts."""
    page, text = Page(plan, plan.at.titles["drawing"], stride=stride_of(plan)), plan.text
    page.put(NAME, text("drawing.title"), styles.TITLE)
    page.row += 1
    page.put(NAME, text("drawing.note"), styles.SUBTITLE)
    page.row += 1
    listed = Listed(page, letters_in(SIZE), lambda: caption(page))
    shown = _shown(page, requests, listed.points)
    paths = {request: _path_chart(page, request, listed.points) for request in requests if request.paths}
    paths |= {
        request: square_chart(page, request, SIZE) for request in requests if request.hodographs or request.profile
    }
    return Drawing(_sheet(page), chart_of(plan, listed.series, SIZE), paths, listed.points, shown)


def square_chart(page: Page, request: ChartRequest, size: int) -> Chart:
    """What has a frame of its own: a hodograph, or the profile of a cam."""
    return (profile_chart if request.profile else hodograph_chart)(page, request, size, PATH_INNER)


def letters_in(size: int) -> float:
    """How high names are in a drawing of so many pixels [points of a drawing whose half window has POINTS]."""
    return LETTERS * POINTS / (size * DRAWING_INNER[2] / 2 * POINTS_OF_A_PIXEL)


def chart_of(plan: Plan, series: Sequence[Series], size: int) -> Chart:
    """The drawing; of more series than a chart takes the last names are left out."""
    names = [each for each in series if each.show_name and isinstance(each.name, str)]
    left_out = names[len(names) - max(0, len(series) - MOST_SERIES) :] if len(series) > MOST_SERIES else []
    title = plan.mechanism.title.of(plan.language)
    return Chart(
        "", Anchor(0, 0, size, size), tuple(each for each in series if each not in left_out), HIDDEN_AXIS, HIDDEN_AXIS,
        legend="", inner=DRAWING_INNER, name="drawing", alt_text=plan.text("drawing.alt", title=title),
    )  # fmt: skip


def _sheet(page: Page) -> Sheet:
    columns = [Column(NAME, NAME, 26.0), Column(FIRST, AT, 12.0), Column(AT + 1, AT + 1, 3.0)]
    if page.col > SWEEP:
        columns.append(Column(SWEEP, page.col - 1, 11.0))
    fills = gaps_where_deleted(page.plan, page.fills, page.title)
    return Sheet(
        page.title, tuple(page.cells), tuple(fills), columns=tuple(columns), row_heights=((0, 26.0),),
        gridlines=False, tab_color="7B3FA0", print_setup=PrintSetup(footer=page.plan.footer),
    )  # fmt: skip


# --- what is shown -----------------------------------------------------------------------------------------------


def _shown(page: Page, requests: Sequence[ChartRequest], cells: Mapping[str, PointCells]) -> dict[str, SeriesRef]:
    """Where the markers of the charts find what the first sheet does not show."""
    plan = page.plan
    there = {plan.mechanism.driver.symbol, *plan.blocks["variables"].rows}
    wanted = dict.fromkeys(name for request in requests for name in (request.x, *request.y) if name)
    found: dict[str, SeriesRef] = {}
    missing = []
    for name in wanted:
        point, dot, axis = name.partition(".")
        if dot and point in cells and axis in ("x", "y"):
            cell = cells[point].x if axis == "x" else cells[point].y
            found[name] = page.reference(cell.row, cell.col)
        elif name not in there and plan.at.spots[name].column:
            missing.append(name)
    if missing:
        page.section(plan.text("drawing.markers"))
    for name in missing:
        page.put(NAME, rich(name), styles.SYMBOL)
        page.formula(FIRST, page.indexed(plan.at.spots[name]))
        found[name] = page.reference(page.row, FIRST)
        page.row += 1
    return found


def caption(page: Page) -> Series:
    """The driver's value in the upper left corner; a position that does not exist says so."""
    plan, text = page.plan, page.plan.text
    driver = plan.mechanism.driver
    value, said = page.indexed(plan.at.spots[driver.symbol]), page.indexed(plan.places.status)
    after = behind_number(driver.unit.text)
    note = formula(
        'IFERROR(IF(said=ok,""," – "&said),nothing)',
        said=said, ok=plan.ok, nothing=f" – {text('drawing.nothing')}",
    )  # fmt: skip
    words = joined(f"{plain(driver.symbol)} = ", formula("ROUND(value,3)", value=value), after, note)
    page.section(text("drawing.caption"), ["", "", "X", "Y"])
    cell = page.formula(NAME, words, styles.INNER)
    for col, place in zip((CHART_X, CHART_Y), CAPTION_AT, strict=True):
        page.put(col, place, styles.INNER)
    x, y = page.reference(page.row, CHART_X), page.reference(page.row, CHART_Y)
    page.row += 1
    return Series(page.named(cell), x, y, show_name=True, label_side="right", label_size=CAPTION, in_legend=False)


def _path_chart(page: Page, request: ChartRequest, cells: Mapping[str, PointCells]) -> Chart:
    """The paths of points at true scale, each with a marker at the position shown."""
    plan = page.plan
    names = ", ".join(plain(point) for point in request.paths)
    title = request.title.of(plan.language) if request.title else plan.text("chart.path", points=names)
    places = [[Symbol(f"{point}.{axis}") for point in request.paths] for axis in ("x", "y")]
    ends = [
        (page.over_motion(names, LEAST, of_axis), page.over_motion(names, MOST, of_axis)) for of_axis in places
    ]  # fmt: skip
    frame = write_frame(page, plan.text("drawing.path.frame", points=names), ends[0], ends[1], PATH_MARGIN)
    series = []
    for index, point in enumerate(request.paths):
        x, y = (
            SeriesRef(page.title, page.column(f"{head} {plain(point)}", chart(page.read(f"{point}.{axis}"))))
            for head, axis, chart in (("X", "x", frame.chart_x), ("Y", "y", frame.chart_y))
        )
        series.append(Series(plain(point), x, y, line=styles.SERIES[index % len(styles.SERIES)], width=1.75))
    for index, point in enumerate(request.paths):
        page.put(NAME, rich(point), styles.SYMBOL)
        page.formula(CHART_X, frame.chart_x(beside(cells[point].x)), cols=2)
        color = styles.SERIES[index % len(styles.SERIES)]
        x, y = page.reference(page.row, CHART_X), page.reference(page.row, CHART_Y)
        series.append(replace(marker(plain(point), x, y, color), show_name=True))
        page.row += 1
    return Chart(
        title, Anchor(0, 0, SIZE, SIZE), (*series, *frame.series), HIDDEN_AXIS, HIDDEN_AXIS,
        legend="", inner=PATH_INNER, alt_text=title, smooth=True,
    )  # fmt: skip


def marker(name: str, x: SeriesRef, y: SeriesRef, color: str) -> Series:
    """The dot at the position shown."""
    return Series(name, x, y, marker="circle", marker_size=8, marker_line=INK, marker_fill=color, in_legend=False)

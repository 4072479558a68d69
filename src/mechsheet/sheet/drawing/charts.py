"""The charts of the first sheet: the drawing, curves against the driver, and paths of points; which, and where they stand.

The vertical axis of a curve is left to the program, since a range fixed here would be wrong as soon as a dimension changes;
but programs let it begin at 0, where a curve that is far from 0 cannot be read: there one end is fixed, with much room.
The driver's axis is fixed, since its rows are: steps of 15, 30 or 45 degrees where the driver turns.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace
from itertools import chain
from typing import Literal

import numpy as np

from livesheet import portable
from livesheet.workbook import Anchor, Area, Axis, Chart, Column, Dash, Series, SeriesRef, Sheet
from mechsheet.kinematics.equations import CAM, JOINT_FORCES
from mechsheet.kinematics.numeric import Array
from mechsheet.model import ENERGY, TIME, ChartRequest, Ends, Mechanism, rate_symbols
from mechsheet.shapes.described import remarkable_points
from mechsheet.sheet import styles
from mechsheet.sheet.cells import ROW_HEIGHT
from mechsheet.sheet.columns.bands import HIGH, LOW, part_of
from mechsheet.sheet.drawing.drawing import SIZE, Drawing, marker
from mechsheet.sheet.plan import CHARTS, VALUE, Plan
from mechsheet.sheet.printing import CHARTS_DOWN, first_setup, headings_of
from mechsheet.sheet.shown import shown_unit
from mechsheet.words.symbols import plain

GAP = 12
HEIGHT = 230
"""Pixels of a chart of curves, in which numbers on the axes have room."""

COLUMN_WIDTH, COLUMN_CHARACTERS = 80, 10.7
"""Pixels and characters of a column beside the blocks, by which charts are placed: set, not left to a program."""

EDGE = 2
"""Pixels between the page's first column and a chart: on the edge itself its frame was printed on the page before, too."""

PAGE_COLUMNS = math.ceil((EDGE + 2 * SIZE + GAP) / COLUMN_WIDTH)
"""So many columns take two charts side by side: an upright page."""

FIRST_ROW = 3
"""The row of the drawing, under the scroll bar."""

STEPS = (1, 2, 5, 10, 15, 30, 45, 60, 90, 180, 360, 720, 3600)
"""Sensible distances of grid lines on an axis of degrees."""

MOST_STEPS = 12
"""So many of them at most: their numbers stand side by side."""

MOST_CURVES = 6
SAME_SCALE = 20.0
"""Curves share a chart when the largest is at most so many times as large as the smallest."""

PROBED = 61
"""Rows that are looked at before the charts are chosen."""

FAR_FROM_ZERO = 1 / 3
"""Curves that vary by less than this part of their size are far from 0."""

ROOM = 0.5
"""So large a part of what they vary by is left between them and the end of the axis: dimensions may change."""

LEAP = 0.5
"""A change from one row to the next of more than this part of a curve's whole height is a leap."""

STILL = 1e-9
"""A change of less than this part of the size counts as none."""

LONG, SHORT = 1e6, "0.0E+0;-0.0E+0;0"
"""Beside an axis numbers from so many on stand so: written out they leave the curve no room."""


def chart_requests(plan: Plan) -> tuple[ChartRequest, ...]:
    """The charts that the description asks for, or those that suit any mechanism."""
    requests = plan.mechanism.charts or _default_requests(plan)
    shown = {symbol for request in requests for symbol in request.y}
    banded = [symbol for symbol in plan.banded if symbol not in shown]
    return (*requests, *(ChartRequest(x=across(plan), y=(symbol,)) for symbol in banded))


def _default_requests(plan: Plan) -> tuple[ChartRequest, ...]:
    """Angles, displacements, outputs by unit and size, and the paths of the points that are no joints."""
    mechanism = plan.mechanism
    driver = mechanism.driver.symbol
    columns = _probe(plan)
    angles: list[str] = []
    displacements: list[str] = []
    if mechanism.driver.law is not None:  # its own curve over the time is worth a look
        (displacements if mechanism.driver.joint else angles).append(driver)
    turned, moved = _turned_by_cam(mechanism), _of_follower(plan)
    told = {symbol for request in moved for symbol in request.y}
    for equation in plan.equations.columns:
        own = equation.symbol in (driver, turned, *told)
        if equation.role == "variable" and not own and not _stands_still(columns[equation.symbol]):
            (angles if equation.unit.kind == "angle" else displacements).append(equation.symbol)
    still = {symbol for symbol, column in columns.items() if _stands_still(column)} | plan.only_rounding.keys()
    outputs = [output.symbol for output in mechanism.outputs if output.symbol not in still]
    rates = [name for name in _rates(plan) if name not in still | told]
    sizes = {symbol: float(np.max(np.abs(column), initial=0.0)) for symbol, column in columns.items()}
    requests = [*moved, *([ChartRequest(profile=True)] if mechanism.cam else [])]
    for symbols in (angles, displacements, outputs, rates):
        requests += [ChartRequest(x=across(plan), y=group) for group in _shared(plan, symbols, sizes)]
    requests += _of_forces(plan, still)
    paths = remarkable_points(mechanism)
    if paths:
        requests.append(ChartRequest(paths=paths))
    return tuple(requests)


def _turned_by_cam(mechanism: Mechanism) -> str:
    """The angle of a cam, which is the driver's once more; "" where there is none."""
    if mechanism.follower is None:
        return ""
    driven = (mechanism.driver.link, mechanism.driver.relative_to)
    return next(link.angle_symbol for link in mechanism.links[1:] if link.name in driven)


def _of_follower(plan: Plan) -> list[ChartRequest]:
    """What a cam moves, as books have it: displacement, velocity, acceleration and jerk, one under another; without a speed,
    derivatives by the cam's angle."""
    follower = plan.mechanism.follower
    if follower is None:
        return []
    names = plan.equations.equations.rates_of(follower)
    return [ChartRequest(x=across(plan), y=(name,)) for name in (follower.symbol, *names)]


def across(plan: Plan) -> str:
    """What curves are drawn against: the driver, or the time of its law."""
    return plan.mechanism.driver.symbol if plan.mechanism.driver.law is None else TIME


def _rates(plan: Plan) -> list[str]:
    """Velocities and accelerations of links, of slides on the ground, and of points; of a cam's columns the pressure
    angle: the others are curves of another plane, and derivatives by its angle look like those by time."""
    mechanism = plan.mechanism
    ground = mechanism.ground.name
    moving = {joint.symbol for joint in mechanism.joints if ground not in (joint.on, joint.link)}
    hidden = {name for symbol in moving for name in rate_symbols(symbol, False)}
    hidden |= {eq.symbol for eq in plan.equations.columns if eq.group == CAM and eq.symbol != "alpha"}
    if mechanism.follower is not None:
        hidden |= {*mechanism.follower.by_angle}
        guided = next((joint.link for joint in mechanism.joints if joint.name == mechanism.follower.joint), "")
        points = next((link.points for link in mechanism.links if link.name == guided), ())
        hidden |= {f"{point}.{part}" for point in points for part in ("v", "a")}  # as fast as the slide
    return [eq.symbol for eq in plan.equations.columns if eq.role == "rate" and eq.symbol not in hidden]


def _of_forces(plan: Plan, still: Collection[str]) -> list[ChartRequest]:
    """The driver's effort, found both ways; the joint forces. One that stays the same has no chart of its own, but an effort
    that is balanced has: a line at 0."""
    if not plan.efforts:
        return []
    forces = [name for name in plan.equations.equations.forces(*JOINT_FORCES) if name not in plan.only_rounding]
    groups = [forces[start : start + MOST_CURVES] for start in range(0, len(forces), MOST_CURVES)]
    stored = ((ENERGY,),) if plan.mechanism.flywheel else ()
    return [
        ChartRequest(x=across(plan), y=names)
        for names in (plan.efforts, *stored, *map(tuple, groups))
        if not {*names} <= {*still} or {*names} <= {*plan.only_rounding}
    ]


def _probe(plan: Plan) -> dict[str, Array]:
    """Each column's numbers in a few rows: enough to tell which curves fit on one axis."""
    every = max(1, math.ceil(len(plan.driver) / PROBED))
    return {symbol: (few := column[::every])[np.isfinite(few)] for symbol, column in plan.nominal.items()}


def _stands_still(column: Array) -> bool:
    """True for a quantity that is the same in every row: its chart would show nothing but rounding."""
    return len(column) > 1 and float(np.ptp(column)) <= STILL * float(np.max(np.abs(column)))


def _shared(plan: Plan, symbols: Sequence[str], sizes: Mapping[str, float]) -> list[tuple[str, ...]]:
    """The symbols by charts: of one unit, of sizes that can be read on one axis, not too many."""
    groups: list[list[str]] = []
    for symbol in symbols:
        for group in groups:
            found = [sizes[member] for member in (*group, symbol)]
            same_unit = shown_unit(plan, group[0]) == shown_unit(plan, symbol)
            if same_unit and len(group) < MOST_CURVES and max(found) <= SAME_SCALE * min(found):
                group.append(symbol)
                break
        else:
            groups.append([symbol])
    return [tuple(group) for group in groups]


# --- curves ------------------------------------------------------------------------------------------------------


def _column(plan: Plan, symbol: str) -> SeriesRef:
    spot = plan.at.spots[symbol]
    return SeriesRef(spot.sheet, Area(plan.at.first, spot.col, plan.at.last, spot.col))


def _at_position(plan: Plan, drawing: Drawing, symbol: str) -> SeriesRef | None:
    """The cell with a quantity at the position shown."""
    if symbol in drawing.shown:
        return drawing.shown[symbol]
    for key in ("position", "variables"):
        row = plan.blocks[key].rows.get(symbol)
        if row is not None:
            return SeriesRef(plan.main, Area(row, VALUE, row, VALUE))
    return None


def curve_chart(
    plan: Plan,
    request: ChartRequest,
    at: Callable[[str], SeriesRef | None],
    size: tuple[int, int],
    axis: Axis,
    legend: Literal["right", "bottom"],
) -> Chart:
    """Curves over a quantity, with a mark on each where the position stands.

    at    the cell with a quantity at the position shown;  size: width and height [pixels];  axis: that of the quantity
    legend  where it stands, where there is more than one curve
    """
    curves, markers = [], []
    x = at(request.x)
    for index, symbol in enumerate(request.y):
        color = styles.SERIES[index % len(styles.SERIES)]
        dash = _dash_of(plan, request, index)
        curves.append(Series(plain(symbol), _column(plan, request.x), _column(plan, symbol), line=color, dash=dash))
        curves += _ends_of_band(plan, request.x, symbol, color)
        y = at(symbol)
        if x and y:
            markers.append(marker(plain(symbol), x, y, color))
    title = _chart_title(plan, request)
    return Chart(
        title, Anchor(0, 0, *size), (*curves, *markers), axis, value_axis(plan, request),
        legend=legend if sum(curve.in_legend for curve in curves) > 1 else "", alt_text=title,
        smooth=_are_smooth(plan, request.y),
    )  # fmt: skip


def _dash_of(plan: Plan, request: ChartRequest, index: int) -> Dash:
    """How a curve is drawn: each otherwise than the one before, for whoever prints in black and white.

    The driver's effort by virtual work lies on that from the reactions, and bands are dashed: there dashes mean just that.
    """
    if any(symbol in plan.efforts for symbol in request.y):
        return "dash" if request.y[index] in plan.efforts[1:] else "solid"
    return "solid" if any(symbol in plan.banded for symbol in request.y) else styles.dash_of_curve(index)


def _ends_of_band(plan: Plan, across: str, symbol: str, color: str) -> list[Series]:
    """Dashed, the worst case on both sides of a quantity that has a band."""
    if symbol not in plan.banded:
        return []
    return [
        Series(
            plan.text(f"chart.band.{key}", symbol=plain(symbol)), _column(plan, across),
            _column(plan, part_of(symbol, part)), line=color, width=1.0, dash="dash", in_legend=False,
        )
        for key, part in (("low", LOW), ("high", HIGH))
    ]  # fmt: skip


def value_axis(plan: Plan, request: ChartRequest) -> Axis:
    """The axis of curves: their symbols, and in brackets the units that they have; its ends where they are asked for, or
    where curves are far from 0."""
    units = list(dict.fromkeys(shown_unit(plan, symbol) for symbol in request.y))
    names = ", ".join(plain(symbol) for symbol in request.y)
    given = any(end is not None for end in request.y_ends)
    low, high = request.y_ends if given else _round_zero(plan, request.y) or _nearer_than_zero(plan, request.y)
    axis = Axis(f"{names} [{', '.join(units)}]" if units != [""] else names, low, high)
    largest = max(float(np.max(np.abs(_as_described(plan, symbol)), initial=0.0)) for symbol in request.y)
    return replace(axis, number_format=SHORT) if largest >= LONG else axis


def _round_zero(plan: Plan, symbols: Sequence[str]) -> Ends | None:
    """The ends of an axis on which rounding is a line at 0: as large as the terms that cancel. None for other curves."""
    sizes = [plan.only_rounding.get(symbol, 0.0) for symbol in symbols]
    if not all(size > 0 for size in sizes):
        return None
    end = 10.0 ** math.floor(float(portable.log10(max(sizes))))
    return -end, end


def _nearer_than_zero(plan: Plan, symbols: Sequence[str]) -> Ends:
    """The end on the side of 0, of an axis of curves that are far from it, as they are shown."""
    values = np.concatenate([_as_described(plan, symbol) for symbol in symbols])
    if not len(values) or values.min() < 0 < values.max():
        return None, None
    nearest, farthest = sorted(np.abs([values.min(), values.max()]).tolist())
    varies = farthest - nearest
    if not STILL * farthest < varies < FAR_FROM_ZERO * farthest:
        return None, None
    step = 10.0 ** math.floor(float(portable.log10(varies)))
    end = math.floor((nearest - ROOM * varies) / step + STILL) * step
    return (None, -end) if values.min() < 0 else (end, None)


def _as_described(plan: Plan, symbol: str) -> Array:
    """A curve's numbers with the dimensions as described, as they are shown; none of a column that sums up others."""
    column = plan.nominal.get(symbol, np.empty(0))
    there = column[np.isfinite(column)]
    return np.degrees(there) if plan.at.spots[symbol].degrees else there


def _are_smooth(plan: Plan, symbols: Sequence[str]) -> bool:
    """Whether curves may be bent between their points: all but those that leap, or grow without bound, between two rows, and
    accelerations and jerks of what a cam moves, which leap where two segments meet."""
    if any(request.y == tuple(symbols) for request in _of_follower(plan)[2:]):
        return False
    columns = [_as_described(plan, symbol) for symbol in symbols]
    return not any(
        np.max(np.abs(np.diff(column)), initial=0.0) > LEAP * np.ptp(column) for column in columns if len(column)
    )


def _chart_title(plan: Plan, request: ChartRequest) -> str:
    """What stands over curves: as the description has it, else what they show."""
    if request.title:
        return request.title.of(plan.language)
    driver = plain(request.x)
    if plan.efforts and request.y == plan.efforts:
        return plan.text("chart.effort", symbol=plain(plan.efforts[0]), driver=driver)
    given = plan.mechanism.given_unit
    equations = [plan.equations.of(symbol) for symbol in request.y if given(symbol) is None]
    if len(request.y) == len(equations) == 1 and equations[0].role == "output":
        symbol, label = plain(request.y[0]), equations[0].label.of(plan.language)
        return (
            f"{symbol}: {label}" if label != request.y[0] else plan.text("chart.outputs", symbol=symbol, driver=driver)
        )
    if len(request.y) > 1 and {equation.role for equation in equations} == {"variable"}:
        key = "chart.angles" if equations[0].unit.kind == "angle" else "chart.displacements"
        return plan.text(key, driver=driver)
    return plan.text("chart.outputs", symbol=", ".join(plain(symbol) for symbol in request.y), driver=driver)


def driver_axis(plan: Plan, symbol: str, ends: Ends = (None, None), steps: int = MOST_STEPS) -> Axis:
    """An axis from the first to the last driver value, as described, in no more than so many steps of a sensible part of a
    turn; or with the ends given. Left to itself Excel goes on beyond the last value, a turn to 405°."""
    unit = shown_unit(plan, symbol)
    title = f"{plain(symbol)} [{unit}]" if unit else plain(symbol)
    driver = plan.mechanism.driver
    if symbol != driver.symbol or not driver.unit.in_degrees or any(end is not None for end in ends):
        return Axis(title, *ends)
    low, high = math.degrees(min(plan.driver)), math.degrees(max(plan.driver))
    if high <= low:
        return Axis(title)
    step = next((step for step in STEPS if (high - low) / step <= steps), STEPS[-1])
    return Axis(title, math.floor(low / step + 1e-9) * step, math.ceil(high / step - 1e-9) * step, step)


# --- places ------------------------------------------------------------------------------------------------------


def charts_of(plan: Plan, requests: Sequence[ChartRequest], drawing: Drawing, down: int) -> tuple[Chart, ...]:
    """The drawing under the scroll bar, the other charts beside and below it in two columns, `down` so many pixels; what has
    no room there stands to the right of it, on a page of its own.
    """
    curves = {
        request: curve_chart(
            plan, request, lambda symbol: _at_position(plan, drawing, symbol), (SIZE, HEIGHT),
            driver_axis(plan, request.x, request.x_ends), "right",
        )
        for request in requests
        if request.y
    }  # fmt: skip
    right = {curves[request] for request in _of_follower(plan) if request in curves}
    left = [drawing.paths[request] for request in requests if request.profile]
    paths = [drawing.paths[request] for request in requests if not (request.y or request.profile)]
    heights = [SIZE + GAP, 0]
    placed = [_placed(drawing.chart, 0, 0)]
    page = 0
    for chart in (*left, *curves.values(), *paths):
        side = 0 if chart in left or (chart not in right and heights[0] <= heights[1]) else 1
        if heights[side] + chart.anchor.height > down:
            page, heights = page + 1, [0, 0]
            side = int(chart in right)
        placed.append(_placed(chart, page * PAGE_COLUMNS * COLUMN_WIDTH + side * (SIZE + GAP), heights[side]))
        heights[side] += chart.anchor.height + GAP
    return tuple(placed)


def _placed(chart: Chart, x: int, y: int) -> Chart:
    cols, dx = divmod(EDGE + x, COLUMN_WIDTH)
    rows, dy = divmod(y, ROW_HEIGHT)
    anchor = replace(chart.anchor, row=FIRST_ROW + rows, col=CHARTS + cols, dx=dx, dy=dy)
    return replace(chart, anchor=anchor)


def with_charts(sheet: Sheet, charts: Callable[[int], tuple[Chart, ...]]) -> Sheet:
    """The sheet with the charts that stand down to so many pixels: as many beside its blocks as a page takes, or fewer, down
    to the heading of a block, where otherwise a block would be cut in print."""
    headings = [(row - FIRST_ROW) * ROW_HEIGHT for row in reversed(headings_of(sheet))]
    fewer = [down for down in headings if SIZE <= down < CHARTS_DOWN]
    found = (_with_room(replace(sheet, charts=charts(down))) for down in (CHARTS_DOWN, *fewer))
    as_many = next(found)
    return next((laid for laid, whole in chain([as_many], found) if whole), as_many[0])


def _with_room(sheet: Sheet) -> tuple[Sheet, bool]:
    """The sheet with the sizes of rows and columns by which its charts were placed, where it does not set them itself; and
    whether its blocks are whole in print."""
    last = max(chart.anchor.row + math.ceil(chart.anchor.height / ROW_HEIGHT) + 1 for chart in sheet.charts)
    given = {row for row, _ in sheet.row_heights}
    heights = tuple((row, float(ROW_HEIGHT)) for row in range(last + 1) if row not in given)
    pages = 1 + max((chart.anchor.col - CHARTS) // PAGE_COLUMNS for chart in sheet.charts)
    starts = [CHARTS + page * PAGE_COLUMNS for page in range(pages)]
    columns = tuple(Column(start, start + PAGE_COLUMNS - 1, COLUMN_CHARACTERS) for start in starts)
    sheet = replace(sheet, row_heights=sheet.row_heights + heights, columns=(*sheet.columns, *columns))
    setup, whole = first_setup(sheet, starts, starts[-1] + PAGE_COLUMNS - 1)
    return replace(sheet, print_setup=setup), whole

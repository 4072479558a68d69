"""The charts: angles, displacements and outputs against the driver, and the paths of points."""

from __future__ import annotations

import math

from mechsheet.model import ChartRequest
from mechsheet.sheet import styles
from mechsheet.sheet.mechanism import CHARTS, shown_unit
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.symbols import plain
from mechsheet.sheet.workbook import Anchor, Area, Axis, Chart, Series, SeriesRef

WIDTH, HEIGHT = 520, 320
ROW_HEIGHT = 20
"""Pixels of a row, by which charts are set below each other."""

STEPS = (1, 2, 5, 10, 15, 30, 45, 60, 90, 180, 360, 720, 3600)
"""Sensible distances of grid lines on an axis of degrees."""


def charts_of(plan: Plan) -> tuple[Chart, ...]:
    """The charts that the description asks for, or those that suit any mechanism."""
    requests = plan.mechanism.charts or _default_requests(plan)
    charts = []
    for index, request in enumerate(requests):
        row = 4 + index * math.ceil((HEIGHT + 16) / ROW_HEIGHT)
        anchor = Anchor(row, CHARTS, WIDTH, HEIGHT)
        charts.append(_path_chart(plan, request, anchor) if request.paths else _curve_chart(plan, request, anchor))
    return tuple(charts)


def _default_requests(plan: Plan) -> tuple[ChartRequest, ...]:
    """Angles, displacements, each output, and the path of each point that is no joint."""
    mechanism = plan.mechanism
    driver = mechanism.driver.symbol
    by_unit: dict[str, list[str]] = {"angle": [], "length": []}
    for equation in plan.equations.columns:
        if equation.kind == "variable" and equation.symbol != driver and not _constant(plan, equation.symbol):
            by_unit[equation.unit].append(equation.symbol)
    requests = [ChartRequest(x=driver, y=tuple(symbols)) for symbols in by_unit.values() if symbols]
    requests += [ChartRequest(x=driver, y=(output.symbol,)) for output in mechanism.outputs]
    paths = tracing_points(plan)
    if paths:
        requests.append(ChartRequest(paths=paths))
    return tuple(requests)


def _constant(plan: Plan, symbol: str) -> bool:
    """True for a variable that never changes: the angle of a piston on a fixed guide."""
    return not plan.equations.of(symbol).reads


def tracing_points(plan: Plan) -> tuple[str, ...]:
    """Points of a single moving link (coupler points); without any, the moving joints."""
    mechanism = plan.mechanism
    at: dict[str, int] = {}
    for link in mechanism.links:
        for point in link.points:
            at[point] = at.get(point, 0) + 1
    sliding = {joint.point for joint in mechanism.joints}
    fixed = set(mechanism.ground.points)
    free = tuple(point for point, count in at.items() if count == 1 and point not in fixed | sliding)
    return free or tuple(point for point in at if point not in fixed)


def _column(plan: Plan, symbol: str) -> SeriesRef:
    spot = plan.at.shown[symbol]
    return SeriesRef(spot.sheet, Area(plan.at.first, spot.col, plan.at.last, spot.col))


def _curve_chart(plan: Plan, request: ChartRequest, anchor: Anchor) -> Chart:
    series = tuple(
        Series(plain(symbol), _column(plan, request.x), _column(plan, symbol), line=styles.SERIES[index % 8])
        for index, symbol in enumerate(request.y)
    )
    units = list(dict.fromkeys(shown_unit(plan, symbol) for symbol in request.y))
    symbols = ", ".join(plain(symbol) for symbol in request.y)
    title = request.title.of(plan.language) if request.title else _title(plan, request)
    return Chart(
        title,
        anchor,
        series,
        _driver_axis(plan, request.x),
        Axis(f"{symbols} [{', '.join(units)}]" if units != [""] else symbols),
        legend="bottom" if len(series) > 1 else "",
        alt_text=title,
    )


def _title(plan: Plan, request: ChartRequest) -> str:
    driver = plain(request.x)
    kinds = {plan.equations.of(symbol).kind for symbol in request.y}
    units = {plan.equations.of(symbol).unit for symbol in request.y}
    if kinds == {"variable"} and len(units) == 1:
        key = "chart.angles" if units == {"angle"} else "chart.displacements"
        return plan.text(key, driver=driver)
    return plan.text("chart.outputs", symbol=", ".join(plain(symbol) for symbol in request.y), driver=driver)


def _driver_axis(plan: Plan, symbol: str) -> Axis:
    """An axis from the first to the last driver value, in steps of a sensible part of a turn."""
    unit = shown_unit(plan, symbol)
    title = f"{plain(symbol)} [{unit}]" if unit else plain(symbol)
    driver = plan.mechanism.driver
    if symbol != driver.symbol:
        return Axis(title)
    factor = 180 / math.pi if driver.unit == "deg" else 1.0
    low, high = min(plan.driver) * factor, max(plan.driver) * factor
    if driver.unit != "deg" or high <= low:
        return Axis(title)
    step = next((step for step in STEPS if (high - low) / step <= 12), STEPS[-1])
    return Axis(title, math.floor(low / step + 1e-9) * step, math.ceil(high / step - 1e-9) * step, step)


def _path_chart(plan: Plan, request: ChartRequest, anchor: Anchor) -> Chart:
    series = tuple(
        Series(point, _column(plan, f"{point}.x"), _column(plan, f"{point}.y"), line=styles.SERIES[index % 8])
        for index, point in enumerate(request.paths)
    )
    points = ", ".join(request.paths)
    title = request.title.of(plan.language) if request.title else plan.text("chart.path", points=points)
    unit = plan.mechanism.length_unit
    return Chart(title, anchor, series, Axis(f"x [{unit}]"), Axis(f"y [{unit}]"), alt_text=title)

"""The drawing of the mechanism at the position shown and the paths of its points: a sheet of numbers, two kinds of chart.

Left on the sheet stand the frame, the points at the position shown and the corners of every shape; on the right, row by
row like the table of positions, what the frame and the paths need of the whole sweep. A position that does not exist is
#N/A in every cell, and nothing of it is drawn.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from mechsheet import portable
from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import CellRef, Node, Symbol, symbols, transform
from mechsheet.formula.scalar import evaluate
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.model import ChartRequest, Joint
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.drawing.arrows import arrows_of, room_of_bars
from mechsheet.sheet.drawing.cam import CamDrawing
from mechsheet.sheet.drawing.frames import (
    CHART_X,
    CHART_Y,
    FIRST,
    HIDDEN_AXIS,
    INK,
    NAME,
    NINTH,
    SWEEP,
    Frame,
    Page,
    write_frame,
)
from mechsheet.sheet.drawing.hodographs import hodograph_chart
from mechsheet.sheet.drawing.name_places import place_names
from mechsheet.sheet.drawing.outlines import block_has_line, corners, direction_of, through_of
from mechsheet.sheet.drawing.points import PointCells, label, marks, moving_points, names_of, pins_of, write_points
from mechsheet.sheet.drawing.shapes import (
    Guide,
    block,
    guide_base,
    link_color,
    outline,
    rail,
    slot,
    support,
    write_guide,
)
from mechsheet.sheet.drawing.wheels import Wheels, racks
from mechsheet.sheet.plan import VALUE, Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.workbook import Anchor, Chart, Column, PrintSetup, Series, SeriesRef, Sheet
from mechsheet.units import behind_number

SIZE = 480
"""Pixels of a drawing and of a chart of paths: square."""

MARGIN, PATH_MARGIN = 1.3, 1.15
"""How much larger than all positions together the windows are; supports, guides and names need room around a drawing."""

PATH_COLORS = ("8FAFCB", "E0A98F", "93C7A6", "BFA0CF", "D9BE7E", "80BFC6", "D58FAC", "AD9A92")
"""Paths behind the drawing: the colours of curves, paler."""

DRAWING_INNER = (0.01, 0.01, 0.98, 0.98)
PATH_INNER = (0.08, 0.12, 0.85, 0.85)


MOST_SERIES = 255
"""Series that a chart of a spreadsheet takes: of mechanisms of very many points the last are drawn without their names."""


@dataclass(frozen=True, slots=True)
class Drawing:
    """The sheet, the chart of the mechanism, those of paths and of hodographs, and where quantities stand.

    points  the cells of every point at the position shown
    shown   cells with the value at the position shown, as people read it, of symbols that have none on the first sheet
    """

    sheet: Sheet
    chart: Chart
    paths: Mapping[ChartRequest, Chart]
    points: Mapping[str, PointCells]
    shown: Mapping[str, SeriesRef]


def drawing_of(plan: Plan, traced: Sequence[str], requests: Sequence[ChartRequest]) -> Drawing:
    """The sheet "Drawing" with its charts. `traced`: points whose paths are drawn behind the mechanism."""
    page, text = Page(plan), plan.text
    page.put(NAME, text("drawing.title"), styles.TITLE)
    page.row += 1
    page.put(NAME, text("drawing.note"), styles.SUBTITLE)
    page.row += 1
    wheels, cam = Wheels(page, dimension_values(plan.mechanism)), CamDrawing(page)
    frame = _frame(page, text("drawing.frame"), _all_points(plan), MARGIN, (wheels, cam), room_of_bars(plan))
    for key, cell in (("x", frame.x), ("y", frame.y), ("half", frame.half)):
        plan.window[key] = Spot(page.title, cell.row, cell.col)
    cells = write_points(page, frame)
    guides = _guides(page, frame, cells)
    shown = _shown(page, requests, cells)
    place_names(page, cells, guides)
    first, last = marks(page, cells)
    toothed = _toothed(page, frame, cells, guides, wheels)
    behind = [*first, *_traces(page, frame, traced, PATH_COLORS, 1.0), *toothed, *_shapes(page, cells, guides)]
    behind += cam.series(frame, cells)
    before = [*frame.series, _caption(page), *last, *arrows_of(page, frame, cells)]
    names = names_of(page, cells)[: max(0, MOST_SERIES - len(behind) - len(before))]
    series = [*behind, *names, *before]
    title = plan.mechanism.title.of(plan.language)
    chart = Chart(
        "", Anchor(0, 0, SIZE, SIZE), tuple(series), HIDDEN_AXIS, HIDDEN_AXIS, legend="", inner=DRAWING_INNER,
        name="drawing", alt_text=text("drawing.alt", title=title),
    )  # fmt: skip
    paths = {request: _path_chart(page, request, cells) for request in requests if request.paths}
    for request in requests:
        if request.hodographs:
            paths[request] = hodograph_chart(page, request, SIZE, PATH_INNER)
    return Drawing(_sheet(page), chart, paths, cells, shown)


def _sheet(page: Page) -> Sheet:
    columns = [Column(NAME, NAME, 26.0), Column(FIRST, NINTH, 12.0), Column(NINTH + 1, NINTH + 1, 3.0)]
    if page.col > SWEEP:
        columns.append(Column(SWEEP, page.col - 1, 11.0))
    return Sheet(
        page.title, tuple(page.cells), tuple(page.fills), columns=tuple(columns), row_heights=((0, 26.0),),
        gridlines=False, tab_color="7B3FA0", print_setup=PrintSetup(footer=page.plan.footer),
    )  # fmt: skip


# --- what is shown -----------------------------------------------------------------------------------------------


def _all_points(plan: Plan) -> tuple[str, ...]:
    """Every point that moves, and the fixed pins."""
    fixed = tuple(point for point in plan.mechanism.ground.points if point in pins_of(plan.mechanism))
    return moving_points(plan.mechanism) + fixed


def _frame(
    page: Page,
    title: str,
    names: Sequence[str],
    margin: float,
    discs: Sequence[Wheels | CamDrawing] = (),
    below: float = 0.0,
) -> Frame:
    """A window around the points at all positions of the sweep, and the discs about them; `below` see `write_frame`."""
    moving = [name for name in names if name in moving_points(page.plan.mechanism)]
    fixed = [name for name in names if name not in moving]
    page.section(page.plan.text("drawing.reach"), [page.plan.text("drawing.from"), page.plan.text("drawing.to")])
    extremes = []
    for axis in ("x", "y"):
        constants = tuple(page.at_position(f"{name}.{axis}") for name in fixed)
        low, high = page.extremes(axis, [f"{name}.{axis}" for name in moving])
        lows, highs = ([low], [high]) if moving else ([], [])  # a disk alone turns
        for name in names if discs else ():
            for radius in (radius for each in discs for radius in each.around(name)):
                ends = (page.at_position(f"{name}.{axis}"),) * 2 if name in fixed else (low, high)
                lows.append(al.sub(ends[0], radius))
                highs.append(al.add(ends[1], radius))
        extremes.append((al.smallest((*lows, *constants)), al.largest((*highs, *constants))))
    return write_frame(page, title, extremes[0], extremes[1], margin, below=below)


def _guides(page: Page, frame: Frame, cells: Mapping[str, PointCells]) -> list[Guide]:
    """The lines of the sliding joints, after the angles and displacements that they need."""
    mechanism = page.plan.mechanism
    if not mechanism.sliding:
        return []
    wanted = {joint.symbol: joint.symbol for joint in mechanism.sliding}
    lines = [(joint, through_of(mechanism, joint), direction_of(mechanism, joint)) for joint in mechanism.sliding]
    for _, (x, y), direction in lines:
        wanted |= {name: name for node in (x, y, direction) for name in symbols(node)}
    known = {f"{point}.{axis}": getattr(place, axis) for point, place in cells.items() for axis in ("x", "y")}
    page.section(page.plan.text("drawing.quantities"), [page.plan.text("drawing.inner.unit")])
    for name in wanted:
        if name not in known:
            page.put(NAME, rich(name), styles.SYMBOL)
            known[name] = page.formula(FIRST, page.at_position(name))
            page.row += 1

    def bound(node: Node) -> Node:
        return transform(node, lambda part: known[part.name] if isinstance(part, Symbol) else part)

    text = page.plan.text
    page.section(text("drawing.reach"), [text("drawing.from"), text("drawing.to")])
    reaches = [page.extremes(plain(joint.symbol), [joint.symbol]) for joint, _, _ in lines]
    heads = [text("drawing.direction"), "cos", "X", "Y", "sin", text("drawing.from"), text("drawing.to")]
    page.section(text("drawing.guides"), heads)
    return [
        write_guide(page, frame, joint, (bound(x), bound(y)), bound(direction), known[joint.symbol], reach)
        for (joint, (x, y), direction), reach in zip(lines, reaches, strict=True)
    ]


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


def _traces(page: Page, frame: Frame, names: Sequence[str], colors: Sequence[str], width: float) -> list[Series]:
    """The paths of points in a frame: two sweep columns each."""
    found = []
    for index, name in enumerate(names):
        x = page.column(f"X {plain(name)}", frame.chart_x(page.read(f"{name}.x")))
        y = page.column(f"Y {plain(name)}", frame.chart_y(page.read(f"{name}.y")))
        refs = SeriesRef(page.title, x), SeriesRef(page.title, y)
        found.append(Series(plain(name), *refs, line=colors[index % len(colors)], width=width))
    return found


# --- the shapes --------------------------------------------------------------------------------------------------


def _shapes(page: Page, cells: Mapping[str, PointCells], guides: Sequence[Guide]) -> list[Series]:
    """From back to front: rails and supports, slots, links, blocks."""
    plan, text = page.plan, page.plan.text
    mechanism = plan.mechanism
    dimensions = dimension_values(mechanism)
    driven = mechanism.driver.link or _joint(plan, mechanism.driver.joint).link
    links = {link.name: link for link in mechanism.links}
    ground = mechanism.ground
    page.section(text("drawing.shapes"), ["", "", "X", "Y"])
    found = []
    for guide in guides:
        if guide.joint.on == ground.name:
            below = portable.cos(evaluate(direction_of(mechanism, guide.joint), dimensions)) >= -1e-9
            found.append(rail(page, text("drawing.rail", symbol=plain(guide.joint.symbol)), guide, below))
    for name in ground.points:
        if name in pins_of(mechanism):
            found.append(support(page, text("drawing.support", point=plain(name)), cells[name]))
    for guide in guides:
        if guide.joint.on != ground.name:
            owner = guide.joint.link if block_has_line(mechanism, guide.joint) else guide.joint.on
            name = text("drawing.slot", symbol=plain(guide.joint.symbol))
            color = link_color(links[owner], driven)
            found.append(slot(page, name, guide, guide_base(page, guide, cells), color))
    for link in mechanism.whole_links[1:]:
        if len(link.points) > 1:
            name = link.label.of(plan.language) if link.label else link.name
            found.append(outline(page, name, cells, corners(link, dimensions), link_color(link, driven)))
    for guide in guides:
        joint = guide.joint
        name = text("drawing.block", symbol=plain(joint.symbol))
        if block_has_line(mechanism, joint):
            found.append(block(page, name, guide.x, guide.y, guide, link_color(links[joint.on], driven)))
            continue
        at = cells[joint.point]
        if joint.kind == "prismatic":
            found.append(block(page, name, at.chart_x, at.chart_y, guide, link_color(links[joint.link], driven)))
        else:  # a massless block, smaller, so that it is seen inside another one at the same point
            found.append(block(page, name, at.chart_x, at.chart_y, guide, INK, 0.7))
    return found


def _toothed(
    page: Page, frame: Frame, cells: Mapping[str, PointCells], guides: Sequence[Guide], wheels: Wheels
) -> list[Series]:
    """Wheels, belts and racks."""
    mechanism = page.plan.mechanism
    if not mechanism.relations:
        return []
    driven = mechanism.driver.link or _joint(page.plan, mechanism.driver.joint).link
    colors = {link.name: link_color(link, driven) for link in mechanism.links}
    return [*wheels.series(frame, cells, colors), *racks(page, frame, guides, cells, colors)]


def _joint(plan: Plan, name: str) -> Joint:
    return next(joint for joint in plan.mechanism.joints if joint.name == name)


def _caption(page: Page) -> Series:
    """The driver's value in the upper left corner; a position that does not exist says so."""
    plan, text = page.plan, page.plan.text
    driver = plan.mechanism.driver
    row = plan.blocks["position"].rows[driver.symbol]
    value = CellRef(row, VALUE, True, True, plan.main)
    after = behind_number(driver.unit.text)
    said = page.indexed(plan.at.spots["#status"])
    note = formula(
        'IFERROR(IF(said=ok,""," – "&said),nothing)',
        said=said, ok=text("status.ok"), nothing=f" – {text('drawing.nothing')}",
    )  # fmt: skip
    words = joined(f"{plain(driver.symbol)} = ", formula("ROUND(value,3)", value=value), after, note)
    page.section(text("drawing.caption"), ["", "", "X", "Y"])
    cell = page.formula(NAME, words, styles.INNER)
    page.put(CHART_X, -0.97, styles.INNER)
    page.put(CHART_Y, 0.93, styles.INNER)
    series = label(page, page.named(cell), page.row, CHART_X, CHART_Y)
    page.row += 1
    return Series(series.name, series.x, series.y, show_name=True, label_side="right", label_size=11.0, in_legend=False)


def _path_chart(page: Page, request: ChartRequest, cells: Mapping[str, PointCells]) -> Chart:
    """The paths of points at true scale, each with a marker at the position shown."""
    plan = page.plan
    names = ", ".join(plain(point) for point in request.paths)
    title = request.title.of(plan.language) if request.title else plan.text("chart.path", points=names)
    frame = _frame(page, plan.text("drawing.path.frame", points=names), request.paths, PATH_MARGIN)
    series = _traces(page, frame, request.paths, styles.SERIES, 1.75)
    for index, point in enumerate(request.paths):
        page.put(NAME, rich(point), styles.SYMBOL)
        page.formula(CHART_X, frame.chart_x(cells[point].x))
        page.formula(CHART_Y, frame.chart_y(cells[point].y))
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

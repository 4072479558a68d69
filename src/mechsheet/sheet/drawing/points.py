"""The points of the drawing at the position shown: coordinates, places in the chart, and where their names stand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from livesheet.formula.nodes import CellRef
from livesheet.workbook import Series
from mechsheet.model import Mechanism
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import (
    CHART_X,
    CHART_Y,
    EIGHTH,
    FIRST,
    INK,
    NAME,
    NINTH,
    SECOND,
    Frame,
    Page,
)
from mechsheet.sheet.symbols import plain, rich


@dataclass(frozen=True, slots=True)
class PointCells:
    """A point at the position shown: its coordinates, and its place in the drawing."""

    x: CellRef
    y: CellRef
    chart_x: CellRef
    chart_y: CellRef


def moving_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Points of moving links that are not fixed, in the order of the description."""
    names = dict.fromkeys(point for link in mechanism.links[1:] for point in link.points)
    return tuple(point for point in names if point not in mechanism.ground.points)


def pins_of(mechanism: Mechanism) -> tuple[str, ...]:
    """Points with a revolute joint: shared by links, or gliding in the slot of a link."""
    count: dict[str, int] = {}
    for link in mechanism.links:
        for point in link.points:
            count[point] = count.get(point, 0) + 1
    slots = {joint.point for joint in mechanism.joints if joint.kind == "pin-slot"}
    return tuple(point for point, links in count.items() if links > 1 or point in slots)


def labelled_points(mechanism: Mechanism) -> tuple[str, ...]:
    """Points whose names are shown: pins and everything that moves, in the order of the table of points."""
    pins = pins_of(mechanism)
    return pins + tuple(name for name in moving_points(mechanism) if name not in pins)


def write_points(page: Page, frame: Frame) -> dict[str, PointCells]:
    """The table of points, pins first, so that they are one run of rows."""
    text, mechanism = page.plan.text, page.plan.mechanism
    heads = ["x", "y", "X", "Y", "", text("drawing.name.side"), text("drawing.name.x"), text("drawing.name.y")]
    page.section(text("drawing.points"), heads)
    pins = pins_of(mechanism)
    others = [name for name in (*moving_points(mechanism), *mechanism.ground.points) if name not in pins]
    rows = {name: page.row + n for n, name in enumerate((*pins, *others))}
    cells = {}
    for name in rows:
        page.put(NAME, rich(name), styles.SYMBOL)
        x = page.formula(FIRST, page.at_position(f"{name}.x"))
        y = page.formula(SECOND, page.at_position(f"{name}.y"))
        chart_x = page.formula(CHART_X, frame.chart_x(x))
        chart_y = page.formula(CHART_Y, frame.chart_y(y))
        cells[name] = PointCells(x, y, chart_x, chart_y)
        page.row += 1
    return cells


def marks(page: Page, cells: Mapping[str, PointCells]) -> tuple[tuple[Series, ...], tuple[Series, ...]]:
    """Rings at the revolute joints, dots at the other points that move: to be drawn first, and again last.

    Excel draws the last series on top, LibreOffice the first, and without borders round markers: a ring is a light disc
    on a dark one, and both stand at both ends of the chart's series.
    """
    mechanism = page.plan.mechanism
    pins = pins_of(mechanism)
    free = tuple(name for name in moving_points(mechanism) if name not in pins)
    back, front = [], []
    for names, size, inside in ((pins, 6, "FFFFFF"), (free, 3, INK)):
        if names:
            first, last = cells[names[0]].x.row, cells[names[-1]].x.row
            x, y = page.reference(first, CHART_X, last), page.reference(first, CHART_Y, last)
            disc = Series(
                page.plan.text("drawing.points"), x, y, marker="circle", marker_size=size + 3, in_legend=False
            )
            back.append(replace(disc, marker_line=INK, marker_fill=INK))
            front.append(replace(disc, marker_size=size, marker_line=inside, marker_fill=inside))
    return (*front, *back), (*back, *front)


def names_of(page: Page, cells: Mapping[str, PointCells]) -> tuple[Series, ...]:
    """The points' names."""
    found = labelled_points(page.plan.mechanism)
    return tuple(label(page, plain(name), cells[name].x.row, EIGHTH, NINTH) for name in found)


def label(page: Page, name: str | CellRef, row: int, x: int, y: int) -> Series:
    """A text in the chart: the name of a series of one point without line or marker."""
    return Series(
        name, page.reference(row, x), page.reference(row, y), show_name=True, label_side="center", in_legend=False
    )

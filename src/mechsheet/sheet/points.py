"""The points of the drawing at the position shown: coordinates, places in the chart, and where their names stand."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from mechsheet.formula.nodes import Binary, Call, CellRef, Number
from mechsheet.kinematics import algebra as al
from mechsheet.model import Mechanism
from mechsheet.sheet import styles
from mechsheet.sheet.frames import (
    CHART_X,
    CHART_Y,
    EIGHTH,
    FIRST,
    INK,
    NAME,
    NINTH,
    SECOND,
    SEVENTH,
    SIXTH,
    Frame,
    Page,
)
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.workbook import Series

LABEL, BLOCK_LABEL, SUPPORT_LABEL = 0.085, 0.12, 0.11
"""How far from its point a name stands: from a joint, from a sliding block, from a support."""


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


def write_points(page: Page, frame: Frame) -> dict[str, PointCells]:
    """The table of points, pins first, so that they are one run of rows."""
    text, mechanism = page.plan.text, page.plan.mechanism
    heads = ["x", "y", "X", "Y", "", "", text("drawing.name.x"), text("drawing.name.y")]
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
        if name in pins or name not in mechanism.ground.points:
            _label_place(page, name, rows)
        page.row += 1
    return cells


def _neighbours(mechanism: Mechanism, name: str) -> tuple[str, ...]:
    """Points that share a moving link with this one."""
    links = [link for link in mechanism.links[1:] if name in link.points]
    return tuple(dict.fromkeys(point for link in links for point in link.points if point != name))


def _label_place(page: Page, name: str, rows: Mapping[str, int]) -> None:
    """Away from the middle of the points it is linked to; beside the support of a fixed pin."""
    mechanism = page.plan.mechanism
    fixed = name in mechanism.ground.points
    x, y = CellRef(page.row, CHART_X), CellRef(page.row, CHART_Y)
    neighbours = _neighbours(mechanism, name)
    if not neighbours:
        page.formula(EIGHTH, al.add(x, Number(SUPPORT_LABEL)) if fixed else x)
        page.formula(NINTH, y if fixed else al.add(y, Number(BLOCK_LABEL)))
        return
    middle = [Call("AVERAGE", tuple(CellRef(rows[other], col) for other in neighbours)) for col in (CHART_X, CHART_Y)]
    page.formula(SIXTH, al.sub(x, middle[0]))
    page.formula(SEVENTH, al.sub(y, middle[1]))
    dx, dy = CellRef(page.row, SIXTH), CellRef(page.row, SEVENTH)
    if fixed:
        side = Call("IF", (Binary("<", dx, al.ZERO), al.number(-SUPPORT_LABEL), al.number(SUPPORT_LABEL)))
        page.formula(EIGHTH, al.add(x, side))
        page.formula(NINTH, al.sub(y, Number(SUPPORT_LABEL / 4)))
        return
    distance = Call("MAX", (Number(1e-9), Call("SQRT", (al.add(al.square(dx), al.square(dy)),))))
    in_block = any(name == joint.point for joint in mechanism.joints)
    reach = Number(BLOCK_LABEL if in_block else LABEL)
    page.formula(EIGHTH, al.add(x, al.div(al.mul(reach, dx), distance)))
    page.formula(NINTH, al.add(y, al.div(al.mul(reach, dy), distance)))


def marks(page: Page, cells: Mapping[str, PointCells]) -> tuple[Series, ...]:
    """Rings at the revolute joints, dots at the other points that move, and the names."""
    mechanism = page.plan.mechanism
    pins = pins_of(mechanism)
    free = tuple(name for name in moving_points(mechanism) if name not in pins)
    found = []
    for names, size, fill in ((pins, 8, "FFFFFF"), (free, 5, INK)):
        if names:
            first, last = cells[names[0]].x.row, cells[names[-1]].x.row
            found.append(
                Series(
                    page.plan.text("drawing.points"),
                    page.reference(first, CHART_X, last),
                    page.reference(first, CHART_Y, last),
                    marker="circle",
                    marker_size=size,
                    marker_line=INK,
                    marker_fill=fill,
                    in_legend=False,
                )
            )
    for name in (*pins, *free):
        row = cells[name].x.row
        found.append(label(page, plain(name), row, EIGHTH, NINTH))
    return tuple(found)


def label(page: Page, name: str | CellRef, row: int, x: int, y: int) -> Series:
    """A text in the chart: the name of a series of one point without line or marker."""
    return Series(
        name, page.reference(row, x), page.reference(row, y), show_name=True, label_side="center", in_legend=False
    )

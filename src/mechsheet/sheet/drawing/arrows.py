"""Arrows in the drawing at the position shown: velocities and accelerations of points, forces at joints.

Each kind has one scale, by which its largest arrow over the whole sweep is `LONGEST` half windows long, and a scale bar of
its own. A cell on the first sheet hides a kind: what belongs to it is then #N/A, which no chart draws.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import CellRef, Node, RangeRef, Symbol, transform
from mechsheet.model import Mechanism, pair_symbol
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import BOTTOM, CHART_X, CHART_Y, FIRST, NAME, NUMBER_STYLE, SECOND, Page
from mechsheet.sheet.drawing.outlines import direction_of
from mechsheet.sheet.drawing.points import PointCells
from mechsheet.sheet.over_rows import LEAST, MOST, over_rows
from mechsheet.sheet.plan import ArrowKind
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.workbook import Series

LONGEST = 0.45
"""How long the longest arrow of a kind is, in half windows."""

BARB_BACK, BARB_ASIDE = 0.2, 0.07
"""Where an arrow's barbs end: so far back from the tip and so far aside, in parts of its length."""

COLORS: dict[ArrowKind, str] = {"velocity": "0070C0", "acceleration": "C00000", "forces": "7030A0"}

BAR_START, BAR_RISE = 0.3, 0.09
"""Where the scale bars begin in the window, and how far one stands above the other."""


@dataclass(frozen=True, slots=True)
class Arrow:
    """One arrow: what it is called, the point where it begins, and its parts along x and y at the position shown."""

    symbol: str
    point: str
    parts: tuple[Node, Node]


def arrows_of(page: Page, cells: Mapping[str, PointCells]) -> tuple[Series, ...]:
    """All arrows and their scale bars; nothing in a workbook without velocities and forces."""
    found: list[Series] = []
    first = page.row
    for number, kind in enumerate(page.plan.arrows):
        found += _kind(page, cells, kind, number)
    page.plan.arrow_rows = range(first, page.row)
    return tuple(found)


def _kind(page: Page, cells: Mapping[str, PointCells], kind: ArrowKind, number: int) -> list[Series]:
    plan = page.plan
    arrows, sizes = _forces(page) if kind == "forces" else _of_points(page, kind)
    page.section(plan.text(f"arrows.{kind}"), ["x", "y", "X", "Y"])
    unit = {"velocity": f"{plan.mechanism.length_unit}/s", "acceleration": f"{plan.mechanism.length_unit}/s²"}
    force_unit = plan.mechanism.dynamics.force_unit if plan.mechanism.dynamics else ""
    largest = []
    for arrow, size in zip(arrows, sizes, strict=True):
        page.put(NAME, rich(arrow.symbol), styles.SYMBOL)
        largest.append(page.formula(FIRST, size))
        page.row += 1
    scale, bar = _scale(page, kind, RangeRef(largest[0], largest[-1]), unit.get(kind, force_unit), number)
    found = [series for arrow in arrows for series in _arrow(page, arrow, cells[arrow.point], scale, COLORS[kind])]
    return [*found, *bar]


# --- what is shown ---------------------------------------------------------------------------------------------------


def _of_points(page: Page, kind: ArrowKind) -> tuple[list[Arrow], list[Node]]:
    """The velocities or accelerations of the points that have any, by their derivatives; and the largest of each."""
    names = page.plan.mechanism.driver_rates
    omega, alpha = (page.at_position(name) for name in names)
    arrows = []
    for point in page.plan.moving_points:
        parts = []
        for axis in ("x", "y"):
            once = page.at_position(f"{point}.{axis}.d")
            part = formula("once*omega", once=once, omega=omega)
            if kind == "acceleration":
                twice = page.at_position(f"{point}.{axis}.dd")
                part = formula("twice*omega^2+once*alpha", twice=twice, once=once, omega=omega, alpha=alpha)
            parts.append(part)
        arrows.append(Arrow(f"{point}.{kind[0]}", point, (parts[0], parts[1])))
    return arrows, [over_rows(MOST, page.plan.at.column(arrow.symbol, page.title)) for arrow in arrows]


def _forces(page: Page) -> tuple[list[Arrow], list[Node]]:
    """At a pin the force of its first link on each other one, at a slide the normal force on its link; the largest of
    each."""
    plan, mechanism = page.plan, page.plan.mechanism
    pins, slides = _pins(mechanism), {f"{_pair(mechanism, each.on, each.link)}.n": each for each in mechanism.joints}
    arrows, sizes = [], []
    for name in plan.held_columns:
        column = plan.at.column(name, page.title)
        most = over_rows(MOST, column)
        if name in pins:
            parts = page.at_position(f"{name}.x"), page.at_position(f"{name}.y")
            arrows.append(Arrow(name, pins[name], parts))
            sizes.append(most)
            continue
        sizes.append(formula("MAX(most,-least)", most=most, least=over_rows(LEAST, column)))
        normal, direction = page.at_position(name), transform(
            direction_of(mechanism, slides[name]),
            lambda part: page.at_position(part.name) if isinstance(part, Symbol) else part,
        )  # fmt: skip
        parts = (
            formula("-SIN(direction)*normal", direction=direction, normal=normal),
            formula("COS(direction)*normal", direction=direction, normal=normal),
        )
        arrows.append(Arrow(name, slides[name].point, parts))
    return arrows, sizes


def _pins(mechanism: Mechanism) -> dict[str, str]:
    """The point at which each joint force acts, by its symbol."""
    at: dict[str, list[str]] = {}
    for link in mechanism.links:
        for point in link.points:
            at.setdefault(point, []).append(link.name)
    return {_pair(mechanism, owner, other): point for point, (owner, *others) in at.items() for other in others}


def _pair(mechanism: Mechanism, one: str, other: str) -> str:
    numbers = {link.name: link.number for link in mechanism.links}
    return pair_symbol("F", numbers[one], numbers[other])


# --- how it is drawn -------------------------------------------------------------------------------------------------


def _scale(page: Page, kind: ArrowKind, sizes: RangeRef, unit: str, number: int) -> tuple[CellRef, list[Series]]:
    """Half windows by unit, #N/A while the kind is hidden; and the scale bar, 1, 2 or 5 times a power of ten long.

    sizes  the cells with the largest of each arrow
    """
    text = page.plan.text
    shown = page.plan.at.cell(f"#show_{kind}", page.title, None)
    page.put(NAME, text("arrows.scale"))
    scale = page.formula(FIRST, formula(
        "IF(AND(shown=1,MAX(sizes)>0),longest/MAX(sizes),NA())", shown=shown, sizes=sizes, longest=LONGEST
    ))  # fmt: skip
    page.row += 1
    page.put(NAME, text("drawing.bar"))
    power = page.formula(SECOND, formula("10^INT(LOG10(longest/scale))", longest=LONGEST, scale=scale))
    room = formula("longest/scale", longest=LONGEST, scale=scale)
    length = page.formula(FIRST, formula(
        "power*IF(room>=5*power,5,IF(room>=2*power,2,1))", power=power, room=room
    ))  # fmt: skip
    height = BOTTOM + BAR_RISE * number
    start = page.row
    page.put(CHART_X, BAR_START, NUMBER_STYLE)
    page.put(CHART_Y, height, NUMBER_STYLE)
    page.row += 1
    words = joined(formula("ROUND(length,12)", length=length), f" {unit}" if unit else "")
    label = page.formula(FIRST, formula('IFERROR(words,"")', words=words), styles.INNER)
    page.formula(CHART_X, formula("start+length*scale", start=BAR_START, length=length, scale=scale))
    page.put(CHART_Y, height, NUMBER_STYLE)
    page.row += 1
    bar = Series(
        text("drawing.bar"), page.reference(start, CHART_X, page.row - 1), page.reference(start, CHART_Y, page.row - 1),
        line=COLORS[kind], width=2.0, in_legend=False,
    )  # fmt: skip
    end = page.reference(page.row - 1, CHART_X), page.reference(page.row - 1, CHART_Y)
    named = Series(page.named(label), *end, show_name=True, label_side="right", in_legend=False)
    return scale, [bar, named]


def _arrow(page: Page, arrow: Arrow, at: PointCells, scale: CellRef, color: str) -> list[Series]:
    """From its point to its tip, and on round a head: five corners, the second and the last of them the tip."""
    first = page.row
    page.put(NAME, rich(arrow.symbol), styles.SYMBOL)
    page.formula(CHART_X, at.chart_x)
    page.formula(CHART_Y, at.chart_y)
    page.row += 1
    parts = page.formula(FIRST, arrow.parts[0]), page.formula(SECOND, arrow.parts[1])
    tip = tuple(
        page.formula(col, formula("base+scale*part", base=base, scale=scale, part=part))
        for col, base, part in ((CHART_X, at.chart_x, parts[0]), (CHART_Y, at.chart_y, parts[1]))
    )
    page.row += 1
    for aside in (BARB_ASIDE, -BARB_ASIDE):
        for col, base, axis, other, sign in (
            (CHART_X, at.chart_x, parts[0], parts[1], -1.0), (CHART_Y, at.chart_y, parts[1], parts[0], 1.0)
        ):  # fmt: skip
            page.formula(col, formula(
                "base+scale*(on*along+aside*across)", base=base, scale=scale, on=1 - BARB_BACK, along=axis,
                aside=al.number(sign * aside), across=other,
            ))  # fmt: skip
        page.row += 1
    page.formula(CHART_X, tip[0])
    page.formula(CHART_Y, tip[1])
    last = page.row
    page.row += 1
    name = plain(arrow.symbol)
    line = Series(
        name, page.reference(first, CHART_X, last), page.reference(first, CHART_Y, last), line=color, width=1.75,
        in_legend=False,
    )  # fmt: skip
    x, y = page.reference(last, CHART_X), page.reference(last, CHART_Y)
    return [line, replace(line, x=x, y=y, line="", show_name=True, label_side="right")]

"""Arrows in the drawing at the position shown: velocities and accelerations of points, forces at joints.

Each kind has one scale over the whole sweep, and a scale bar of its own: its largest arrow is `LONGEST` half windows long,
or shorter, where an arrow would leave the window in some row. How much of the room up to the window's edge an arrow
v at (X, Y) would take, were the scale 1, is a column of the sweep:

    largest of  |vx| / (EDGE - sign(vx) X)  and  |vy| / (EDGE - sign(vy) Y)

A cell on the first sheet hides a kind: what belongs to it is then #N/A, which no chart draws.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import CellRef, Node, RangeRef, Symbol, transform
from mechsheet.model import Mechanism, pair_symbol
from mechsheet.sheet import styles
from mechsheet.sheet.checks.gaps import chunks_of
from mechsheet.sheet.drawing.frames import (
    BOTTOM,
    CHART_X,
    CHART_Y,
    FIRST,
    NAME,
    NUMBER_STYLE,
    SECOND,
    Frame,
    Page,
    longest_bar,
)
from mechsheet.sheet.drawing.outlines import direction_of
from mechsheet.sheet.drawing.points import PointCells
from mechsheet.sheet.over_rows import LEAST, MOST, over_rows
from mechsheet.sheet.plan import ArrowKind, Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.workbook import Area, Rich, Series

LONGEST = 0.45
"""How long the longest arrow of a kind is, in half windows."""

EDGE = 0.93
"""Where arrows end at the latest, from the middle of the window [half windows]; their names need room, too."""

NAMED = 0.06
"""Shorter arrows [half windows] have no names: those of several at one pin would cover each other."""

BARB_BACK, BARB_ASIDE = 0.2, 0.07
"""Where an arrow's barbs end: so far back from the tip and so far aside, in parts of its length."""

COLORS: dict[ArrowKind, str] = {"velocity": "0070C0", "acceleration": "C00000", "forces": "7030A0"}

BAR_START, BAR_RISE = -0.36, 0.09
"""Where the scale bars begin in the window, beside that of lengths, and how far one stands above the other."""

BAR_ROOM = 0.24
"""What the lowest scale bar with its label, and above the bars a support or the end of a rail need [half windows]."""


def room_of_bars(plan: Plan) -> float:
    """What the drawing leaves free at its lower edge, so that no scale bar lies on a link [half windows]."""
    return BAR_ROOM + BAR_RISE * (len(plan.arrows) - 1) if plan.arrows else 0.0


Parts = tuple[Node, Node]
"""Of a vector, along x and y."""


@dataclass(frozen=True, slots=True)
class Arrow:
    """One arrow: what it is called, the point where it begins, how large it becomes over the rows, and its parts along x
    and y from values that are read in some row."""

    symbol: str
    point: str
    largest: Node
    parts: Callable[[Callable[[str], Node]], Parts]


def arrows_of(page: Page, frame: Frame, cells: Mapping[str, PointCells]) -> tuple[Series, ...]:
    """All arrows and their scale bars; nothing in a workbook without velocities and forces."""
    found: list[Series] = []
    for number, kind in enumerate(page.plan.arrows):
        found += _kind(page, frame, cells, kind, number)
    return tuple(found)


def _kind(page: Page, frame: Frame, cells: Mapping[str, PointCells], kind: ArrowKind, number: int) -> list[Series]:
    plan = page.plan
    arrows = _forces(page) if kind == "forces" else _of_points(page, kind)
    page.section(plan.text(f"arrows.{kind}"), [plan.text("arrows.largest"), "", "X", "Y"])
    unit = {"velocity": f"{plan.mechanism.length_unit}/s", "acceleration": f"{plan.mechanism.length_unit}/s²"}
    force_unit = plan.mechanism.dynamics.force_unit if plan.mechanism.dynamics else ""
    sizes = _cells_below(page, [(rich(arrow.symbol), arrow.largest) for arrow in arrows])
    taken = chunks_of([part for arrow in arrows for part in _room_taken(page, frame, arrow)])
    columns = [page.column(plan.text("arrows.room"), al.nested("MAX", parts)) for parts in taken]
    rooms = _cells_below(page, [(plan.text("arrows.room"), _most(_column(area))) for area in columns])
    scale, bar = _scale(page, kind, (sizes, rooms), unit.get(kind, force_unit), number)
    page.section(plan.text(f"arrows.{kind}.shown"), ["x", "y", "X", "Y"])
    found = [series for arrow in arrows for series in _arrow(page, arrow, cells[arrow.point], scale, COLORS[kind])]
    return [*found, *bar]


def _cells_below(page: Page, lines: Sequence[tuple[Rich | str, Node]]) -> RangeRef:
    """Cells below each other, each with its name; the area that they take."""
    first = page.row
    for name, node in lines:
        page.put(NAME, name, styles.LABEL if isinstance(name, str) else styles.SYMBOL)
        page.formula(FIRST, node)
        page.row += 1
    return RangeRef(CellRef(first, FIRST, True, True), CellRef(page.row - 1, FIRST, True, True))


def _room_taken(page: Page, frame: Frame, arrow: Arrow) -> list[Node]:
    """Along x and along y, in a row of the sweep; see above."""
    places = frame.chart_x(page.read(f"{arrow.point}.x")), frame.chart_y(page.read(f"{arrow.point}.y"))
    return [
        formula("ABS(part)/(edge-SIGN(part)*place)", part=part, place=place, edge=EDGE)
        for part, place in zip(arrow.parts(page.read), places, strict=True)
    ]


def _column(area: Area) -> RangeRef:
    ends = ((row, area.first_col) for row in (area.first_row, area.last_row))
    first, last = (CellRef(row, col, True, True) for row, col in ends)
    return RangeRef(first, last)


def _most(column: Node) -> Node:
    """The largest of a column, 0 where no row has a number."""
    return formula("IFERROR(most,0)", most=over_rows(MOST, column))


# --- what is shown ---------------------------------------------------------------------------------------------------


def _of_points(page: Page, kind: ArrowKind) -> list[Arrow]:
    """The velocities or accelerations of the points that have any, by their derivatives."""
    omega, alpha = page.plan.mechanism.driver_rates

    def moved(point: str, read: Callable[[str], Node]) -> Parts:
        x, y = (along(f"{point}.{axis}", read) for axis in ("x", "y"))
        return x, y

    def along(place: str, read: Callable[[str], Node]) -> Node:
        once = read(f"{place}.d")
        if kind == "velocity":
            return formula("once*omega", once=once, omega=read(omega))
        return formula("twice*omega^2+once*alpha", twice=read(f"{place}.dd"), once=once, omega=read(omega),
                       alpha=read(alpha))  # fmt: skip

    symbols = {f"{point}.{kind[0]}": point for point in page.plan.moving_points}
    return [
        Arrow(symbol, point, _most(page.plan.at.column(symbol, page.title)), partial(moved, point))
        for symbol, point in symbols.items()
    ]


def _forces(page: Page) -> list[Arrow]:
    """At a pin the force of its first link on each other one, at a slide the normal force on its link."""
    plan, mechanism = page.plan, page.plan.mechanism
    pins = points_of_forces(mechanism)
    slides = {f"{pair_of(mechanism, each.on, each.link)}.n": each for each in mechanism.joints}
    arrows = []
    for name in plan.held_columns:
        column = plan.at.column(name, page.title)
        if name in pins:
            arrows.append(Arrow(name, pins[name], _most(column), partial(_at_pin, name)))
        elif name in slides:  # at teeth: their place is no point of the drawing
            largest = formula(
                "IFERROR(MAX(most,-least),0)", most=over_rows(MOST, column), least=over_rows(LEAST, column)
            )
            across = partial(_across, name, direction_of(mechanism, slides[name]))
            arrows.append(Arrow(name, slides[name].point, largest, across))
    return arrows


def _at_pin(force: str, read: Callable[[str], Node]) -> Parts:
    return read(f"{force}.x"), read(f"{force}.y")


def _across(force: str, line: Node, read: Callable[[str], Node]) -> Parts:
    """Of a force along the left normal of a line."""
    direction = transform(line, lambda part: read(part.name) if isinstance(part, Symbol) else part)
    normal = read(force)
    return (
        formula("-SIN(direction)*normal", direction=direction, normal=normal),
        formula("COS(direction)*normal", direction=direction, normal=normal),
    )


def points_of_forces(mechanism: Mechanism) -> dict[str, str]:
    """The point at which each joint force acts, by its symbol."""
    at: dict[str, list[str]] = {}
    for link in mechanism.links:
        for point in link.points:
            at.setdefault(point, []).append(link.name)
    return {pair_of(mechanism, owner, other): point for point, (owner, *others) in at.items() for other in others}


def pair_of(mechanism: Mechanism, one: str, other: str) -> str:
    """The symbol of the force of one link on another."""
    numbers = {link.name: link.number for link in mechanism.links}
    return pair_symbol("F", numbers[one], numbers[other])


# --- how it is drawn -------------------------------------------------------------------------------------------------


def _scale(
    page: Page, kind: ArrowKind, of_arrows: tuple[RangeRef, RangeRef], unit: str, number: int
) -> tuple[CellRef, list[Series]]:
    """Half windows by unit, #N/A while the kind is hidden; and the scale bar, 1, 2 or 5 times a power of ten long.

    of_arrows  the cells with the largest of each arrow, and with the room that they take
    """
    text = page.plan.text
    shown = page.plan.places.arrows[kind].cell
    page.put(NAME, text("arrows.scale"))
    scale = page.formula(FIRST, formula(
        "IF(AND(shown=1,MAX(sizes)>0),MIN(longest/MAX(sizes),1/MAX(rooms)),NA())", shown=shown, sizes=of_arrows[0],
        rooms=of_arrows[1], longest=LONGEST,
    ))  # fmt: skip
    page.row += 1
    page.put(NAME, text("drawing.bar"))
    length = page.formula(FIRST, longest_bar(formula("longest/scale", longest=LONGEST, scale=scale)))
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
    """From its point to its tip, and on round a head: five corners, the second and the last of them the tip; and where its
    name stands."""
    first = page.row
    page.put(NAME, rich(arrow.symbol), styles.SYMBOL)
    page.formula(CHART_X, at.chart_x)
    page.formula(CHART_Y, at.chart_y)
    page.row += 1
    parts = tuple(
        page.formula(col, part) for col, part in zip((FIRST, SECOND), arrow.parts(page.at_position), strict=True)
    )
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
    size = formula("SQRT(x^2+y^2)", x=parts[0], y=parts[1])
    for col, place in ((CHART_X, tip[0]), (CHART_Y, tip[1])):
        page.formula(col, formula("IF(scale*size<named,NA(),place)", scale=scale, size=size, named=NAMED, place=place))
    x, y = page.reference(page.row, CHART_X), page.reference(page.row, CHART_Y)
    page.row += 1
    name = plain(arrow.symbol)
    line = Series(
        name, page.reference(first, CHART_X, last), page.reference(first, CHART_Y, last), line=color, width=1.75,
        in_legend=False,
    )  # fmt: skip
    return [line, replace(line, x=x, y=y, line="", show_name=True, label_side="right")]

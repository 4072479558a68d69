"""The shapes of the drawing, in cells: links, supports, guides and blocks at the position shown.

Every shape is a run of rows whose two chart columns are one series of straight lines. A shape that consists of several
strokes goes back on its own line, so that no gap is needed: what a gap looks like differs from program to program.
Sizes of symbols are in the chart's units (the window is 2 wide), so they stay the same when dimensions change.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, Number
from livesheet.workbook import Fill, Series
from mechsheet.model import Joint, Link
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import CHART_X, CHART_Y, FIRST, INK, NAME, NUMBER_STYLE, SECOND, SIXTH, Frame, Page
from mechsheet.sheet.drawing.outlines import block_has_line, line_end
from mechsheet.sheet.drawing.points import PointCells
from mechsheet.sheet.symbols import rich

BLOCK_LENGTH, BLOCK_HEIGHT = 0.075, 0.045
"""Half the sides of a sliding block."""

PAD = 0.13
"""How far a guide reaches beyond the stroke."""

SUPPORT_DEPTH = 0.075
DRIVEN_COLOR = styles.SERIES[1]
LINK_COLORS = tuple(color for color in styles.SERIES if color != DRIVEN_COLOR)

Local = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Guide:
    """A sliding joint's line at the position shown: a point of it, its direction, and where it starts and ends.

    start, end  signed distances from the point `through`, in the chart's units
    """

    joint: Joint
    x: CellRef
    y: CellRef
    cosine: CellRef
    sine: CellRef
    start: CellRef
    end: CellRef


def link_color(link: Link, driven: str) -> str:
    """The colour of a link: one for the driven link, the others in turn; grey for the ground."""
    if link.name == driven:
        return DRIVEN_COLOR
    return INK if link.number == 1 else LINK_COLORS[(link.number - 2) % len(LINK_COLORS)]


def comb(length: float, strokes: int, depth: float, lean: float, start: float = 0.0) -> tuple[Local, ...]:
    """A base line along +a with strokes to the side of -b: ground. One line that goes back on itself."""
    path: list[Local] = []
    for n in range(strokes):
        at = start + length * n / (strokes - 1)
        path += [(at, 0.0), (at - lean, -depth), (at, 0.0)]
    return tuple(path)


def _support() -> tuple[Local, ...]:
    """A triangle under the pin on a hatched line."""
    half = 0.05
    hatch = tuple((a, b - SUPPORT_DEPTH) for a, b in comb(0.13, 5, 0.025, 0.025, -0.065))
    return ((0.0, 0.0), (-half, -SUPPORT_DEPTH), (half, -SUPPORT_DEPTH), (0.0, 0.0), (-half, -SUPPORT_DEPTH), *hatch)


SUPPORT = _support()
BLOCK: tuple[Local, ...] = tuple(
    (a * BLOCK_LENGTH, b * BLOCK_HEIGHT) for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1))
)


def outline(page: Page, name: str, points: Mapping[str, PointCells], order: Sequence[str], color: str) -> Series:
    """A link: a bar between two points, a closed polygon round more."""
    start = page.row
    closed = [*order, order[0]] if len(order) > 2 else list(order)
    for point in closed:
        page.put(NAME, name if page.row == start else "")
        page.put(FIRST, rich(point), styles.INNER)
        page.formula(CHART_X, points[point].chart_x)
        page.formula(CHART_Y, points[point].chart_y)
        page.row += 1
    return series_of(page, name, start, color, 3.0)


def support(page: Page, name: str, pin: PointCells) -> Series:
    """The hatched support of a fixed pin."""
    start = page.row
    local_path(page, name, SUPPORT)
    a, b = CellRef(start, FIRST, col_abs=True), CellRef(start, SECOND, col_abs=True)
    filled(page, start, al.add(pin.chart_x, a), al.add(pin.chart_y, b))
    return series_of(page, name, start, INK, 1.0)


def block(page: Page, name: str, x: CellRef, y: CellRef, guide: Guide, color: str, size: float = 1.0) -> Series:
    """A rectangle that turns with its guide."""
    start = page.row
    local_path(page, name, tuple((a * size, b * size) for a, b in BLOCK))
    filled(page, start, *_turned(start, x, y, guide, CellRef(start, FIRST, col_abs=True)))
    return series_of(page, name, start, color, 2.0)


def rail(page: Page, name: str, guide: Guide, below: bool) -> Series:
    """A guide fixed to the ground: a hatched line under the block, as long as the stroke and a little more."""
    start = page.row
    side = -1.0 if below else 1.0
    local_path(page, name, tuple((a, side * (BLOCK_HEIGHT - b)) for a, b in comb(1.0, 11, 0.03, 0.0)))
    reach = al.sub(guide.end, guide.start)
    along = al.add(guide.start, al.mul(CellRef(start, FIRST, col_abs=True), reach))
    filled(page, start, *_turned(start, guide.x, guide.y, guide, along))
    return series_of(page, name, start, INK, 1.0)


def slot(page: Page, name: str, guide: Guide, base: PointCells, color: str) -> Series:
    """A guide on a moving link: from a point of the link to the line, and along the line over the stroke."""
    start = page.row
    ends: list[tuple[Node, Node]] = [(base.chart_x, base.chart_y), (guide.x, guide.y)]
    for reach in (guide.start, guide.end):
        ends.append((al.add(guide.x, al.mul(reach, guide.cosine)), al.add(guide.y, al.mul(reach, guide.sine))))
    for x, y in ends:
        page.put(NAME, name if page.row == start else "")
        page.formula(CHART_X, x)
        page.formula(CHART_Y, y)
        page.row += 1
    return series_of(page, name, start, color, 2.0)


def write_guide(
    page: Page, frame: Frame, joint: Joint, through: tuple[Node, Node], direction: Node, s: CellRef,
    reach: tuple[Node, Node],
) -> Guide:  # fmt: skip
    """The row of a sliding joint; its nodes are bound to this sheet already. `reach`: its least and largest displacement."""
    mechanism = page.plan.mechanism
    page.put(NAME, rich(joint.symbol), styles.SYMBOL)
    angle = page.formula(FIRST, direction)
    cosine = page.formula(SECOND, Call("COS", (angle,)))
    sine = page.formula(SIXTH, Call("SIN", (angle,)))
    x = page.formula(CHART_X, frame.chart_x(through[0]))
    y = page.formula(CHART_Y, frame.chart_y(through[1]))
    least, most = reach
    if block_has_line(mechanism, joint):
        least, most = al.sub(s, most), al.sub(s, least)
    start = page.formula(SIXTH + 1, al.sub(al.div(least, frame.half), Number(PAD)))
    end = page.formula(SIXTH + 2, al.add(al.div(most, frame.half), Number(PAD)))
    page.row += 1
    return Guide(joint, x, y, cosine, sine, start, end)


def guide_base(page: Page, guide: Guide, points: Mapping[str, PointCells]) -> PointCells:
    """The point from which the line of a moving link is drawn."""
    if block_has_line(page.plan.mechanism, guide.joint):
        return points[guide.joint.point]
    end = line_end(guide.joint, page.plan.mechanism)
    return points.get(end, PointCells(guide.x, guide.y, guide.x, guide.y))


def _turned(row: int, x: CellRef, y: CellRef, guide: Guide, along: Node) -> tuple[Node, Node]:
    """The local place (along, b) turned into the guide's direction and moved to (x, y)."""
    b = CellRef(row, SECOND, col_abs=True)
    return (
        al.sub(al.add(x, al.mul(along, guide.cosine)), al.mul(b, guide.sine)),
        al.add(al.add(y, al.mul(along, guide.sine)), al.mul(b, guide.cosine)),
    )


def local_path(page: Page, name: str, path: Sequence[Local]) -> None:
    """The shape in its own frame, one corner a row."""
    for n, (a, b) in enumerate(path):
        page.put(NAME, name if n == 0 else "")
        page.put(FIRST, round(a, 6) + 0.0, NUMBER_STYLE)
        page.put(SECOND, round(b, 6) + 0.0, NUMBER_STYLE)
        page.row += 1


def filled(page: Page, start: int, x: Node, y: Node) -> None:
    """The places of the rows from `start` on in the chart."""
    rows = page.row - start
    page.fills.append(Fill(start, CHART_X, x, NUMBER_STYLE, rows=rows))
    page.fills.append(Fill(start, CHART_Y, y, NUMBER_STYLE, rows=rows))


def series_of(page: Page, name: str, start: int, color: str, width: float) -> Series:
    """The rows from `start` on as one line."""
    x, y = (page.reference(start, col, page.row - 1) for col in (CHART_X, CHART_Y))
    return Series(name, x, y, line=color, width=width, in_legend=False)

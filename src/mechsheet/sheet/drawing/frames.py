"""The sheet behind the drawing: its rows and columns as they are written, and frames in which a circle stays round.

A chart whose axes run from -1 to 1, hidden, in a square plot area shows true scale when its data are normalised:

    X = (x - xc) / h,    Y = (y - yc) / h

(xc, yc) is the middle of everything shown over the whole sweep and h half the side of a square around it, both live, so
that nothing leaves the window or jumps while the mechanism moves. A scale bar of 1, 2 or 5 times a power of ten says what
the size is.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, RangeRef, Symbol, shifted, symbols, transform, walk
from livesheet.formula.vectors import Vector
from livesheet.workbook import Area, Axis, Cell, Content, Fill, Series, SeriesRef, Style
from mechsheet.shapes.colors import INK
from mechsheet.shapes.forms import (
    BAR_RISE,
    BAR_START,
    BOTTOM,
    EDGE,
    HALF,
    LEFT,
    MARGIN,
    SHAFT,
    Kind,
    Scale,
    Shape,
    Shapes,
    room_of_bars,
    shown,
)
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.checks.rows import chunks_of
from mechsheet.sheet.over_rows import LEAST, MOST, over_rows
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined

NAME, FIRST, SECOND, CHART_X, CHART_Y, SIXTH, SEVENTH, EIGHTH, NINTH, NUMBER, PART, AT = range(12)
"""Columns: what it is, its own numbers, and its place in the chart; six more where there is more to say."""

SWEEP = AT + 2
"""First of the columns that follow the table of positions."""

SAMPLES = 721
"""About so many positions are drawn of a path: half a degree of a full turn, finer than a screen shows."""

COARSEST = math.radians(1)
"""A path leaves no more than this out between two positions, however many turns the sweep has."""

NUMBER_STYLE = styles.decimals(styles.INNER, 4)
BAR_ROOM = 0.2
"""What the scale bar with its label needs below a curve [half sides]."""

HIDDEN_AXIS = Axis(low=-1.0, high=1.0, step=0.5, visible=False, gridlines=False)


class Page:
    """Collects cells; `row` is the next free row of the left part, `col` the next free sweep column.

    left     the column in which the left part begins
    known    what symbols of the list of shapes stand for that are no quantities of the mechanism
    """

    def __init__(self, plan: Plan, title: str, left: int = 0, row: int = 0, stride: int = 1) -> None:
        self.plan = plan
        self.title = title
        self.left = left
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self.row = row
        self.col = left + SWEEP
        self.stride = stride
        self.first = self.sweep_from
        self.samples = math.ceil((plan.rows - 1) / self.stride) + 1
        self._swept: dict[Node, Area] = {}
        self.known: dict[str, Node] = {}
        if self.numbered:
            self._numbers()

    # --- the left part ---------------------------------------------------------------------------------------

    def put(self, col: int, content: Content, style: Style = styles.LABEL) -> None:
        """A constant in the present row; an empty text is no cell."""
        if content != "":
            self.cells.append(Cell(self.row, self.left + col, content, style))

    def formula(self, col: int, node: Node, style: Style = NUMBER_STYLE, rows: int = 1, cols: int = 1) -> CellRef:
        """A formula in the present row, or filled down and right from there; the address of the first."""
        self.fills.append(Fill(self.row, self.left + col, node, style, rows=rows, cols=cols))
        return self.cell(col)

    def both(self, col: int, x: Node, y: Node) -> None:
        """The formulas of x and y side by side: one, filled right, where that of y reads beside what that of x reads."""
        shared = {*walk(x)} & {*walk(y)}

        def free(part: Node) -> Node:
            return beside(part) if isinstance(part, CellRef) and part not in shared else part

        filled = transform(x, free)
        if shifted(filled, 0, 1) == transform(y, free):
            self.formula(col, filled, cols=2)
        else:
            self.formula(col, x)
            self.formula(col + 1, y)

    def cell(self, col: int, row: int | None = None, anchored: bool = True) -> CellRef:
        """The address of a cell of the left part, in the present row or another."""
        return CellRef(self.row if row is None else row, self.left + col, anchored, True)

    def column_of(self, col: int, first: int, last: int, anchored: bool = True) -> RangeRef:
        """Cells of the left part below each other; not anchored: filled right, of the column beside."""
        return RangeRef(*(replace(self.cell(col, row), col_abs=anchored) for row in (first, last)))

    def section(self, title: str, heads: Sequence[str] = ()) -> None:
        """A heading across the columns, after an empty row."""
        self.row += 1
        self.put(NAME, title, styles.SECTION)
        for col in range(FIRST, AT + 1):
            head = heads[col - FIRST] if col - FIRST < len(heads) else ""
            self.put(col, head or None, styles.SECTION)
        self.row += 1

    def reference(self, first_row: int, col: int, last_row: int | None = None) -> SeriesRef:
        """Cells of a column as a chart reads them."""
        col += self.left
        return SeriesRef(self.title, Area(first_row, col, first_row if last_row is None else last_row, col))

    def named(self, cell: CellRef) -> CellRef:
        """A cell of this sheet as a chart on another one names it."""
        return CellRef(cell.row, cell.col, True, True, self.title)

    # --- the motion ------------------------------------------------------------------------------------------

    @property
    def sweep_from(self) -> int:
        """The first row of the sweep columns, and of lists beside them."""
        return self.plan.at.first

    @property
    def numbered(self) -> bool:
        """Whether the sweep columns look their rows of the table up by numbers, rather than stand in these rows."""
        return self.stride > 1

    def row_number(self, heading: CellRef) -> Node:
        """The number of the table's row, counted from 0, that a row of a sweep column stands for; the last one always."""
        last = self.plan.rows - 1
        return formula("MIN(stride*(ROW()-ROW(heading)-1),last)", stride=self.stride, heading=heading, last=last)

    def read(self, symbol: str) -> Node:
        """The quantity (internal units) in the row of the table that a row of a sweep column stands for.

        Taken from where people read it: there it is #N/A in rows that do not exist.
        """
        if symbol in self.known:
            return self.known[symbol]
        spot = self.plan.at.spots.get(symbol)
        if spot is None:
            return self.in_row(self.plan.plain[symbol])
        if not spot.column:
            return self.plan.at.reference(symbol, self.title, None)
        cell: Node = CellRef(self.first, spot.col, sheet=self._sheet(spot))
        if self.numbered:
            number = CellRef(self.first, self.left + SWEEP, col_abs=True)
            cell = formula("INDEX(column,number+1)", column=self.table_column(spot), number=number)
        return Call("RADIANS", (cell,)) if spot.degrees else cell

    def in_row(self, node: Node) -> Node:
        """A tree over symbols in the row that a row of a sweep column stands for."""
        return transform(node, lambda part: self.read(part.name) if isinstance(part, Symbol) else al.tidied(part))

    def indexed(self, spot: Spot) -> Node:
        """What stands in a column of the table in the row of the position shown; an error where there is none."""
        position = self.plan.at.bind(there(self.plan.places.position).cell, self.title)
        row = formula("position+1", position=position)
        if self.plan.places.number is not None:
            numbers = self.plan.places.number.whole(self.title)
            row = formula("MATCH(position,numbers,0)", position=position, numbers=numbers)
        return formula("INDEX(column,row_shown)", column=self.table_column(spot), row_shown=row)

    def at_position(self, symbol: str) -> Node:
        """The quantity (internal units) in the row of the position shown; #N/A where it does not exist."""
        spot = self.plan.at.spots[symbol]
        if not spot.column:
            return self.plan.at.reference(symbol, self.title, None)
        return Call("RADIANS", (self.indexed(spot),)) if spot.degrees else self.indexed(spot)

    def table_column(self, spot: Spot) -> RangeRef:
        """A whole column of the table."""
        sheet = self._sheet(spot)
        return RangeRef(
            CellRef(self.plan.at.first, spot.col, True, True, sheet),
            CellRef(self.last_row, spot.col, True, True, sheet),
        )

    def _sheet(self, spot: Spot) -> str | None:
        return None if spot.sheet == self.title else spot.sheet

    @property
    def last_row(self) -> int:
        """The last row of the table that is looked at."""
        return self.plan.at.last

    def column(self, head: str, node: Node) -> Area:
        """A new sweep column."""
        self.cells.append(Cell(self.first - 1, self.col, head, styles.HEAD))
        self.fills.append(Fill(self.first, self.col, node, NUMBER_STYLE, rows=self.samples))
        self.col += 1
        return Area(self.first, self.col - 1, self.first + self.samples - 1, self.col - 1)

    def apart(self) -> None:
        """Leave a column free: LibreOffice takes long columns side by side as one, and reports a circle where some of them
        read what follows from others."""
        self.col += 1

    def over_motion(self, name: str, function: str, nodes: Sequence[Node]) -> Node:
        """The least or the largest (`LEAST`, `MOST`) of trees over symbols in all rows in which they exist.

        What has a column in the table is taken from there; the rest that moves gets sweep columns.
        """
        other = MOST if function == LEAST else LEAST
        found: list[Node] = []
        areas: list[Area] = []
        for node in nodes:
            match node:
                case Symbol(symbol) if self._in_table(symbol):
                    found.append(self._over(function, symbol))
                case Call("ABS", (Symbol(symbol),)) if function == MOST and self._in_table(symbol):
                    found += [self._over(function, symbol), al.neg(self._over(other, symbol))]
                case _ if self.moves(node):
                    area = self._sweep(name, node)
                    if areas and areas[-1].last_col == area.first_col - 1:  # one range of columns side by side
                        area = replace(area, first_col=areas.pop().first_col)
                    areas.append(area)
                case _:
                    found.append(self.in_row(node))
        for area in areas:
            corners = ((area.first_row, area.first_col), (area.last_row, area.last_col))
            found.append(over_rows(function, RangeRef(*(CellRef(row, col, True, True) for row, col in corners))))
        return self.together(name, function.removesuffix("IFS"), found)

    def _sweep(self, name: str, node: Node) -> Area:
        if node not in self._swept:
            self._swept[node] = self.column(name, self.in_row(node))
        return self._swept[node]

    def _in_table(self, symbol: str) -> bool:
        spot = self.plan.at.spots.get(symbol)
        return spot is not None and spot.column

    def moves(self, node: Node) -> bool:
        """Whether a tree over symbols, or over cells already, reads a column of the table."""
        plain = self.plan.plain
        if any(isinstance(part, CellRef) and not part.row_abs for part in walk(node)):
            return True
        return any(self._in_table(name) or (name in plain and self.moves(plain[name])) for name in symbols(node))

    def _over(self, function: str, symbol: str) -> Node:
        spot = self.plan.at.spots[symbol]
        found = over_rows(function, self.table_column(spot))
        return Call("RADIANS", (found,)) if spot.degrees else found

    def together(self, name: str, take: str, parts: Sequence[Node]) -> Node:
        """The least or largest of parts (MIN, MAX); of many in cells of their own."""
        chunks = chunks_of(list(dict.fromkeys(parts)))
        if len(chunks) == 1:
            return chunks[0][0] if len(chunks[0]) == 1 else al.nested(take, chunks[0])
        first = self.row
        for chunk in chunks:
            self.put(NAME, name)
            self.formula(FIRST, al.nested(take, chunk))
            self.row += 1
        return Call(take, (self.column_of(FIRST, first, self.row - 1),))

    def _numbers(self) -> None:
        """The table's row numbers that the sweep columns look at."""
        heading = CellRef(self.first - 1, self.left + SWEEP, True, True)
        style = styles.decimals(styles.INNER, 0)
        self.cells.append(Cell(self.first - 1, self.left + SWEEP, self.plan.text("head.number"), styles.HEAD))
        self.fills.append(Fill(self.first, self.left + SWEEP, self.row_number(heading), style, rows=self.samples))
        self.col += 1


def stride_of(plan: Plan) -> int:
    """Every how many rows of the table a path has a point.

    Long tables are thinned to about SAMPLES points, but never so far that a turning driver jumps more than COARSEST.
    """
    stride = math.ceil(plan.rows / SAMPLES)
    if plan.mechanism.driver.unit.kind == "angle" and plan.rows > 1:
        step = max(abs(b - a) for a, b in zip(plan.driver, plan.driver[1:], strict=False))
        stride = min(stride, math.floor(COARSEST / step + 1e-9)) if step > 0 else stride
    return max(1, stride)


@dataclass(frozen=True, slots=True)
class Frame:
    """The square window of a chart: its middle and half its side, and the scale bar in its lower left corner.

    A formula of `chart_x` that is filled right is that of `chart_y`.
    """

    x: CellRef
    y: CellRef
    half: CellRef
    series: tuple[Series, ...]

    def chart_x(self, node: Node) -> Node:
        """(x - xc) / h."""
        return al.div(al.sub(node, self.x), self.half)

    def chart_y(self, node: Node) -> Node:
        """(y - yc) / h."""
        return al.div(al.sub(node, self.y), self.half)


def write_frame(
    page: Page,
    title: str,
    x: tuple[Node, Node],
    y: tuple[Node, Node],
    margin: float,
    *,
    unit: str | None = None,
    below: float = BAR_ROOM,
    arrows: Callable[[tuple[Node, Node], float], list[Node]] | None = None,
) -> Frame:
    """The rows of a frame around everything between the least and the most of x and of y.

    `margin`: how much larger than that the window is. Where nothing moves the half side is 1. `unit`: of what is drawn;
    without one, that of lengths. `below`: what stays free at the window's lower edge, at least [half sides]; where that is
    more than the margin leaves, everything stands higher, and a window around something high is larger.
    """
    text = page.plan.text
    above = 1 - 1 / margin
    raised = round(max(0.0, below - above) / 2, 3)
    page.section(title, ["x", "y"])
    ends: list[CellRef] = []
    for key, of_x, of_y in zip(("drawing.from", "drawing.to"), x, y, strict=True):
        page.put(NAME, text(key))
        page.both(FIRST, of_x, of_y)
        ends.append(beside(near(page.cell(FIRST))))
        page.row += 1
    middles = _middle(page, formula("(a+b)/2", a=ends[0], b=ends[1]))
    sizes = [al.sub(replace(ends[1], col=ends[1].col + way), replace(ends[0], col=ends[0].col + way)) for way in (0, 1)]
    if raised:
        sizes[1] = al.mul(al.number(round((1 - above) / (1 - above - raised), 3)), sizes[1])
    room = arrows(middles, raised) if arrows is not None else []
    page.put(NAME, text("drawing.half"))
    size = al.nested("MAX", sizes)
    least = formula("IF(size>0,part*size,1)", size=size, part=margin / 2)
    half = page.formula(FIRST, al.nested("MAX", [least, *room]) if room else least)
    page.row += 1
    if raised:
        page.put(NAME, text("drawing.lowered"))
        page.put(FIRST, 0.0, NUMBER_STYLE)
        page.put(SECOND, raised, NUMBER_STYLE)
        lowered = beside(near(page.cell(FIRST)))
        page.row += 1
        middles = _middle(
            page, formula("middle-lowered*half", middle=near(middles[0]), lowered=lowered, half=near(half))
        )
    series = _scale_bar(page, half, page.plan.mechanism.length_unit if unit is None else unit)
    return Frame(*middles, half, series)


def write_window(page: Page, shapes: Shapes) -> Frame:
    """The frame around all shapes in all positions; larger where arrows that are shown would leave it."""
    ends = []
    for axis in (0, 1):
        both = []
        for function, way in ((LEAST, al.sub), (MOST, al.add)):
            radii = dict.fromkeys(radius for _, radius in shapes.around)
            parts = [
                way(
                    page.over_motion("xy"[axis], function, [p[axis] for p, r in shapes.around if r == radius]),
                    page.over_motion("r", MOST, [radius]) if page.moves(radius) else page.in_row(radius),
                )
                for radius in radii
            ]
            both.append(page.together("xy"[axis], function.removesuffix("IFS"), parts) if parts else al.ZERO)
        ends.append((both[0], both[1]))

    def arrows(middle: Vector, raised: float) -> list[Node]:
        return _tips(page, shapes, middle, raised)

    low = room_of_bars(len(shapes.scales))
    frame = write_frame(page, page.plan.text("drawing.frame"), ends[0], ends[1], MARGIN, below=low, arrows=arrows)
    page.known[HALF.name] = frame.half
    return frame


def _tips(page: Page, shapes: Shapes, middle: Vector, raised: float) -> list[Node]:
    """How large half the side must be so that no arrow ends beyond EDGE: the tip of one at (x, y) lies at
    x + half p, so  half >= (x - xm) / (EDGE - p)  and  half >= (xm - x) / (EDGE + p).

    middle  of the window, were it not moved down by `raised` half sides
    """
    page.apart()
    kinds: dict[Kind, list[Node]] = {}
    for shape in shapes.shapes:
        if not isinstance(shape, Shape) or shape.path != SHAFT or shape.frame is None:
            continue
        for axis, (at, way, centre) in enumerate(zip(shape.frame.origin, shape.frame.along, middle, strict=True)):
            part = transform(way, lambda node: al.ONE if node == HALF else al.tidied(node))
            part = al.add(part, al.number(raised * axis))
            holes = {"at": at, "centre": centre, "part": part, "edge": EDGE}
            parts = kinds.setdefault(shape.kind, [])
            parts += [formula("(at-centre)/(edge-part)", **holes), formula("(centre-at)/(edge+part)", **holes)]
    found = []
    for kind, parts in kinds.items():
        nodes = [al.nested("MAX", chunk) for chunk in chunks_of([page.in_row(part) for part in parts])]
        most = page.over_motion(page.plan.text("arrows.room"), MOST, nodes)
        switch = page.known.get(shown(kind).name)
        page.put(NAME, page.plan.text("arrows.room"))
        cell = page.formula(FIRST, formula("IFERROR(most,0)", most=most))
        page.row += 1
        found.append(cell if switch is None else formula("IF(switch=1,cell,0)", switch=switch, cell=cell))
    return found


def _middle(page: Page, node: Node) -> tuple[CellRef, CellRef]:
    """The row of a middle, x and y: a formula filled right."""
    page.put(NAME, page.plan.text("drawing.middle"))
    page.formula(FIRST, node, cols=2)
    x, y = (beside(page.cell(col)) for col in (FIRST, SECOND))
    page.row += 1
    return x, y


def beside(cell: CellRef) -> CellRef:
    """The cell as a formula reads it that is filled right: then the one beside it."""
    return replace(cell, col_abs=False)


def near(cell: CellRef) -> CellRef:
    """The cell as formulas read it that are the same in every frame: so many rows above."""
    return replace(cell, row_abs=False)


def longest_bar(room: Node) -> Node:
    """The largest of 1, 2 and 5 times a power of ten that a scale bar has room for."""
    each = [formula("10^INT(LOG10(room/count))", room=room, count=count) for count in (2, 5)]
    return formula("MAX(10^INT(LOG10(room)),2*two,5*five)", room=room, two=each[0], five=each[1])


def _scale_bar(page: Page, half: CellRef, unit: str) -> tuple[Series, ...]:
    """A bar of 1, 2 or 5 times a power of ten, at most half the half side long; its length is the label."""
    text, half = page.plan.text, near(half)
    page.put(NAME, text("drawing.bar"))
    length = near(page.formula(FIRST, longest_bar(al.div(half, al.TWO))))
    page.row += 1
    page.put(NAME, text("drawing.bar.label"))
    rounded = formula("ROUND(length,12)", length=length)  # gnumeric computes with more digits and would show them
    words = joined(rounded, f" {unit}" if unit else "")
    label = page.formula(FIRST, words, styles.INNER)
    page.formula(CHART_X, al.add(al.number(LEFT), al.div(length, al.mul(al.TWO, half))))
    page.put(CHART_Y, BOTTOM + 0.07, NUMBER_STYLE)
    name = Series(
        page.named(label), page.reference(page.row, CHART_X), page.reference(page.row, CHART_Y),
        show_name=True, label_side="center", in_legend=False,
    )  # fmt: skip
    page.row += 1
    # two points and no more: in a smooth chart LibreOffice would bend a line through ticks at its ends
    start = page.row
    page.put(NAME, text("drawing.bar"))
    page.put(CHART_X, LEFT, NUMBER_STYLE)
    page.put(CHART_Y, BOTTOM, NUMBER_STYLE)
    page.row += 1
    page.formula(CHART_X, al.add(al.number(LEFT), al.div(length, half)))
    page.put(CHART_Y, BOTTOM, NUMBER_STYLE)
    page.row += 1
    bar = Series(
        text("drawing.bar"), page.reference(start, CHART_X, start + 1), page.reference(start, CHART_Y, start + 1),
        line=INK, width=2.0, in_legend=False,
    )  # fmt: skip
    return bar, name


def arrow_bar(page: Page, scale: Scale, number: int, most: Node, switch: Node) -> list[Series]:
    """The scale bar of a kind of arrows, the bar of this number from below: 1, 2 or 5 times a power of ten long.

    most  the size of the longest arrow;  switch  1 where they are shown
    """
    text = page.plan.text
    page.put(NAME, text("drawing.bar"))
    room = longest_bar(most)
    length = page.formula(FIRST, formula("IF(AND(switch=1,most>0),room,NA())", switch=switch, most=most, room=room))
    height = BOTTOM + BAR_RISE * number
    start = page.row
    page.put(CHART_X, BAR_START, NUMBER_STYLE)
    page.put(CHART_Y, height, NUMBER_STYLE)
    page.row += 1
    words = joined(formula("ROUND(length,12)", length=length), f" {scale.unit}" if scale.unit else "")
    label = page.formula(FIRST, formula('IFERROR(words,"")', words=words), styles.INNER)
    end = formula("start+length/most*longest", start=BAR_START, length=length, most=most, longest=scale.longest)
    page.formula(CHART_X, end)
    page.put(CHART_Y, height, NUMBER_STYLE)
    page.row += 1
    x, y = (page.reference(start, col, page.row - 1) for col in (CHART_X, CHART_Y))
    bar = Series(text("drawing.bar"), x, y, line=scale.color, width=2.0, in_legend=False)
    at = page.reference(page.row - 1, CHART_X), page.reference(page.row - 1, CHART_Y)
    return [bar, Series(page.named(label), *at, show_name=True, label_side="right", in_legend=False)]

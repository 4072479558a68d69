"""The sheet behind the drawing: its rows and columns as they are written, and frames in which a circle stays round.

A chart whose axes run from -1 to 1, hidden, in a square plot area shows true scale when its data are normalised:

    X = (x - xc) / h,    Y = (y - yc) / h

(xc, yc) is the middle of everything shown over the whole sweep and h half the side of a square around it, both live, so
that nothing leaves the window or jumps while the mechanism moves. A scale bar of 1, 2 or 5 times a power of ten says what
the size is.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Call, CellRef, Node, RangeRef, Symbol
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.checks.gaps import chunks_of
from mechsheet.sheet.places import there
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import ALL, formula, joined
from mechsheet.sheet.workbook import Area, Axis, Cell, Content, Fill, Series, SeriesRef, Style

NAME, FIRST, SECOND, CHART_X, CHART_Y, SIXTH, SEVENTH, EIGHTH, NINTH = range(9)
"""Columns: what it is, its own numbers, and its place in the chart; four more where there is more to say."""

SWEEP = NINTH + 2
"""First of the columns that follow the table of positions."""

SAMPLES = 721
"""About so many positions are drawn of a path: half a degree of a full turn, finer than a screen shows."""

COARSEST = math.radians(1)
"""A path leaves no more than this out between two positions, however many turns the sweep has."""

NUMBER_STYLE = styles.decimals(styles.INNER, 4)
INK, QUIET = "404040", "9AA0A6"

HIDDEN_AXIS = Axis(low=-1.0, high=1.0, step=0.5, visible=False, gridlines=False)


class Page:
    """Collects the cells of the sheet; `row` is the next free row of the left part, `col` the next free sweep column."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        self.title = plan.at.titles["drawing"]
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self.row = 0
        self.col = SWEEP
        self.stride = stride_of(plan)
        self.first = plan.at.first
        self.samples = math.ceil((plan.rows - 1) / self.stride) + 1
        if self.stride > 1:
            self._numbers()

    # --- the left part ---------------------------------------------------------------------------------------

    def put(self, col: int, content: Content, style: Style = styles.LABEL) -> None:
        """A constant in the present row; an empty text is no cell."""
        if content != "":
            self.cells.append(Cell(self.row, col, content, style))

    def formula(self, col: int, node: Node, style: Style = NUMBER_STYLE, row: int | None = None) -> CellRef:
        """A formula in the present row, or another; its address."""
        row = self.row if row is None else row
        self.fills.append(Fill(row, col, node, style))
        return CellRef(row, col, True, True)

    def section(self, title: str, heads: Sequence[str] = ()) -> None:
        """A heading across the columns, after an empty row."""
        self.row += 1
        self.put(NAME, title, styles.SECTION)
        for col in range(FIRST, NINTH + 1):
            head = heads[col - FIRST] if col - FIRST < len(heads) else ""
            self.put(col, head or None, styles.SECTION)
        self.row += 1

    def reference(self, first_row: int, col: int, last_row: int | None = None) -> SeriesRef:
        """Cells of a column as a chart reads them."""
        return SeriesRef(self.title, Area(first_row, col, first_row if last_row is None else last_row, col))

    def named(self, cell: CellRef) -> CellRef:
        """A cell of this sheet as a chart on another one names it."""
        return CellRef(cell.row, cell.col, True, True, self.title)

    # --- the sweep -------------------------------------------------------------------------------------------

    def read(self, symbol: str) -> Node:
        """The quantity (internal units) in the row of the table that a row of a sweep column stands for.

        Taken from where people read it: there it is #N/A in rows that do not exist.
        """
        spot = self.plan.at.spots[symbol]
        if not spot.column:
            return self.plan.at.reference(symbol, self.title, None)
        cell: Node = CellRef(self.first, spot.col, sheet=spot.sheet)
        if self.stride > 1:
            number = CellRef(self.first, SWEEP, col_abs=True)
            cell = formula("INDEX(column,number+1)", column=self.column_at(spot), number=number)
        return Call("RADIANS", (cell,)) if spot.degrees else cell

    def at_position(self, symbol: str) -> Node:
        """The quantity (internal units) in the row of the position shown; #N/A where it does not exist."""
        spot = self.plan.at.spots[symbol]
        if not spot.column:
            return self.plan.at.reference(symbol, self.title, None)
        cell = self.indexed(spot)
        return Call("RADIANS", (cell,)) if spot.degrees else cell

    def indexed(self, spot: Spot) -> Node:
        """What stands in a column of the table in the row of the position shown."""
        position = there(self.plan.places.position).cell
        return self.plan.at.bind(
            formula("INDEX(column,position+1)", column=spot.whole(), position=position), self.title
        )

    def column_at(self, spot: Spot) -> RangeRef:
        """A whole column of the table."""
        plan = self.plan
        return RangeRef(
            CellRef(plan.at.first, spot.col, True, True, spot.sheet),
            CellRef(plan.at.last, spot.col, True, True, spot.sheet),
        )

    def column(self, head: str, node: Node) -> Area:
        """A new sweep column."""
        self.cells.append(Cell(self.first - 1, self.col, head, styles.HEAD))
        self.fills.append(Fill(self.first, self.col, node, NUMBER_STYLE, rows=self.samples))
        self.col += 1
        return Area(self.first, self.col - 1, self.first + self.samples - 1, self.col - 1)

    def extremes(self, name: str, symbols: Sequence[str]) -> tuple[Node, Node]:
        """Smallest and largest of columns over the rows that exist, a row of cells for each stretch of them."""
        found: list[tuple[CellRef, CellRef]] = []
        bind, searched = self.plan.at.bind, self.plan.searched
        for number, stretch in enumerate(searched.stretches, 1):
            part_of = partial(
                formula, "INDEX(column,first):INDEX(column,last)", first=stretch.first.cell, last=stretch.last.cell
            )
            rows = [bind(part_of(column=Symbol(ALL + symbol)), self.title) for symbol in symbols]
            for part in chunks_of(rows):
                self.put(NAME, self.plan.text("drawing.stretch", axis=name, number=number))
                low, high = (
                    self.formula(col, bind(formula(
                        'IF(stretches<number,"",found)', stretches=searched.count.cell, number=number,
                        found=Call(way, tuple(part)),
                    ), self.title))
                    for col, way in ((FIRST, "MIN"), (SECOND, "MAX"))
                )  # fmt: skip
                found.append((low, high))
                self.row += 1
        if not found:
            return al.ZERO, al.ZERO
        lows, highs = (RangeRef(found[0][side], found[-1][side]) for side in (0, 1))
        return formula("MIN(lows)", lows=lows), formula("MAX(highs)", highs=highs)

    def _numbers(self) -> None:
        """The table's row numbers that the sweep columns look at; the last one always."""
        heading = CellRef(self.first - 1, SWEEP, True, True)
        number = formula(
            "MIN(stride*(ROW()-ROW(heading)-1),last)", stride=self.stride, heading=heading, last=self.plan.rows - 1
        )
        style = styles.decimals(styles.INNER, 0)
        self.cells.append(Cell(self.first - 1, SWEEP, self.plan.text("head.number"), styles.HEAD))
        self.fills.append(Fill(self.first, SWEEP, number, style, rows=self.samples))
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
    """The square window of a chart: its middle and half its side, and the scale bar in its lower left corner."""

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
    below: float = 0.0,
) -> Frame:
    """The rows of a frame around everything between the least and the most of x and of y.

    `margin`: how much larger than that the window is. Where nothing moves the half side is 1. `unit`: of what is drawn;
    without one, that of lengths. `below`: what stays free at the window's lower edge, at least [half sides]; where that is
    more than the margin leaves, everything stands higher, and a window around something high is larger.
    """
    text = page.plan.text
    page.section(title, [text("drawing.from"), text("drawing.to"), "", text("drawing.middle")])
    above = 1 - 1 / margin
    raised = max(0.0, below - above) / 2
    half_side = CellRef(page.row + 2, FIRST, True, True)  # written below
    middles, sizes = [], []
    for name, (low, high) in (("x", x), ("y", y)):
        page.put(NAME, name)
        a, b = page.formula(FIRST, low), page.formula(SECOND, high)
        middle, size = al.div(al.add(a, b), al.TWO), al.sub(b, a)
        if name == "y" and raised:
            middle = al.sub(middle, al.mul(_rounded(raised), half_side))
            size = al.mul(_rounded((1 - above) / (1 - above - raised)), size)
        middles.append(page.formula(CHART_Y, middle))
        sizes.append(size)
        page.row += 1
    page.put(NAME, text("drawing.half"))
    size = al.nested("MAX", sizes)
    half = page.formula(FIRST, formula("IF(size>0,part*size,1)", size=size, part=margin / 2))
    page.row += 1
    series = _scale_bar(page, half, page.plan.mechanism.length_unit if unit is None else unit)
    return Frame(middles[0], middles[1], half, series)


def _rounded(value: float) -> Node:
    """A share of the window as a short number in a formula."""
    return al.number(round(value, 3))


def longest_bar(room: Node) -> Node:
    """The largest of 1, 2 and 5 times a power of ten that a scale bar has room for."""
    each = [formula("10^INT(LOG10(room/count))", room=room, count=count) for count in (2, 5)]
    return formula("MAX(10^INT(LOG10(room)),2*two,5*five)", room=room, two=each[0], five=each[1])


def _scale_bar(page: Page, half: CellRef, unit: str) -> tuple[Series, ...]:
    """A bar of 1, 2 or 5 times a power of ten, at most half the half side long; its length is the label."""
    text = page.plan.text
    page.put(NAME, text("drawing.bar"))
    length = page.formula(FIRST, longest_bar(al.div(half, al.TWO)))
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


LEFT, BOTTOM = -0.95, -0.95
"""Where the scale bar starts in the window."""

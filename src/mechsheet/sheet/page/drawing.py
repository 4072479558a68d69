"""The drawing of a page: what it needs stands to the right of the table, in few cells, folded away.

    X = (x - xc) / h,    Y = (y - yc) / h        in a square plot from -1 to 1, so that a circle is round

Every corner of a link is a row; a point that stands in the table is read there, another is computed from the angles of
the row that is drawn. Hodographs have such cells, too. Circles of points that turn about fixed pins need no columns: their
window is the pin and the arm.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Call, CellRef, Node, RangeRef, Symbol, Text, Unary, symbols, transform
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.model import ChartRequest, Joint, Link
from mechsheet.sheet import styles
from mechsheet.sheet.checks.geometry import length_in_cells
from mechsheet.sheet.degrees import degrees_together
from mechsheet.sheet.drawing.drawing import DRAWING_INNER, PATH_COLORS
from mechsheet.sheet.drawing.frames import HIDDEN_AXIS, INK, QUIET, longest_bar
from mechsheet.sheet.drawing.outlines import corners, direction_of, line_end, through_of
from mechsheet.sheet.drawing.points import moving_points, pins_of
from mechsheet.sheet.drawing.shapes import link_color
from mechsheet.sheet.over_rows import LEAST, MOST, over_rows
from mechsheet.sheet.page.plan import CHART_HEIGHT, PagePlan, traced_points
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.symbols import plain, rich
from mechsheet.sheet.workbook import Anchor, Area, Cell, Chart, Column, Content, Fill, Series, SeriesRef
from mechsheet.units import behind_number
from mechsheet.words.equations import link_words

NAME, X, Y, MIDDLE = range(4)
"""Columns of the helpers, from the first one; the paths follow after one more."""

MARGIN = 1.25
"""How much larger than everything that moves the window is."""

FEW_POINTS = 3
"""So many moving points have their extents in one formula."""

LEFT, BOTTOM, CAPTION = -0.95, -0.95, 0.93
HODOGRAPH_INNER = (0.08, 0.12, 0.85, 0.85)
"""The square plot below the title, as a part of the chart."""

STYLE = styles.decimals(styles.INNER, 4)
WORDS = replace(styles.INNER, name="", align="left", wrap=True)
"""Wrapped: a text that is too long would be drawn over the columns beside those that are folded away."""


class PageDrawing:
    """Collects the helpers' cells from column `start` on, and the chart."""

    def __init__(self, plan: PagePlan, start: int, charted: Sequence[str]) -> None:
        self.plan = plan
        self.start = start
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self.row = 2
        self.shown: dict[str, CellRef] = {}
        self.last_corner = ""
        self.swings: dict[str, tuple[CellRef, CellRef, CellRef]] = {}
        self.corners: dict[str, tuple[CellRef, CellRef]] = {}
        self.path_columns = 0
        self.cam_reach: CellRef | None = None
        self._text(NAME, plan.text("page.drawing"))
        self.row += 1
        for symbol in charted:
            self._quantity(symbol)
        self._needed()
        self.x, self.y, self.half = self._window(self._extents, MARGIN)
        bar = self._scale_bar(self.half, plan.mechanism.length_unit)
        caption = self._caption()
        links = [self._link(link) for link in plan.mechanism.whole_links[1:]]
        guides = [self._guide(joint) for joint in plan.mechanism.sliding]
        pins = self._pins()
        paths = [self._path(point, index) for index, point in enumerate(self._traced())] + self._cam()
        blocks = [self._block(joint) for joint in plan.mechanism.sliding]
        series = [each for each in (*paths, *guides, *links, *blocks, *pins, *bar, caption) if each is not None]
        title = plan.mechanism.title.of(plan.language)
        self.chart = Chart(
            "", Anchor(0, 0, CHART_HEIGHT, CHART_HEIGHT), tuple(series), HIDDEN_AXIS, HIDDEN_AXIS, legend="",
            inner=DRAWING_INNER, name="drawing", alt_text=plan.text("drawing.alt", title=title),
        )  # fmt: skip

    @property
    def columns(self) -> tuple[Column, ...]:
        """The helpers' columns, folded away."""
        last = self.start + MIDDLE + 1 + self.path_columns
        return (Column(self.start, last, 11.0, level=1, hidden=True), Column(last + 1, last + 1, 3.0, collapsed=True))

    # --- cells ------------------------------------------------------------------------------------------------

    def _text(self, col: int, content: Content) -> None:
        self.cells.append(Cell(self.row, self.start + col, content, WORDS if isinstance(content, str) else STYLE))

    def _formula(self, col: int, node: Node) -> CellRef:
        style = WORDS if col == NAME else STYLE
        self.fills.append(Fill(self.row, self.start + col, transform(node, degrees_together), style))
        return CellRef(self.row, self.start + col, True, True)

    def _ref(self, first: int, col: int, last: int | None = None) -> SeriesRef:
        col += self.start
        return SeriesRef(self.plan.main, Area(first, col, first if last is None else last, col))

    # --- the row that is drawn --------------------------------------------------------------------------------

    def _table_column(self, symbol: str, last: int) -> RangeRef:
        spot = self.plan.at.spots[symbol]
        return RangeRef(CellRef(spot.row, spot.col, True, True), CellRef(last, spot.col, True, True))

    def _quantity(self, symbol: str) -> CellRef:
        """A quantity of the table in the row that is drawn, as people read it."""
        if symbol not in self.shown:
            self._text(NAME, rich(symbol))
            self.shown[symbol] = self._formula(X, self._indexed(symbol))
            self.row += 1
        return self.shown[symbol]

    def _indexed(self, symbol: str) -> Node:
        column = self._table_column(symbol, self.plan.last_looked_at)
        position = self.plan.at.cell("#position", self.plan.main, None)
        return formula("INDEX(column,position+1)", column=column, position=position)

    def _needed(self) -> None:
        """Every angle and displacement that a corner reads has a row, before the others are written."""
        mechanism = self.plan.mechanism
        wanted: list[Node] = []
        for point in moving_points(mechanism):
            wanted += [Symbol(f"{point}.{axis}") for axis in ("x", "y")]
        for joint in mechanism.sliding:
            wanted += [*through_of(mechanism, joint), direction_of(mechanism, joint)]
        for node in wanted:
            self._at_position(node)

    def _at_position(self, node: Node) -> Node:
        """A tree over symbols in the row that is drawn."""
        at = self.plan.at

        def change(part: Node) -> Node:
            if not isinstance(part, Symbol):
                return part
            if part.name not in at.spots:
                return self._at_position(self.plan.page.plain[part.name])
            spot = at.spots[part.name]
            if not spot.column:
                return at.reference(part.name, self.plan.main, None)
            cell: Node = self._indexed(part.name) if part.name.endswith((".x", ".y")) else self._quantity(part.name)
            return Call("RADIANS", (cell,)) if spot.degrees else cell

        return al.tidied(transform(node, change))

    # --- the window -------------------------------------------------------------------------------------------

    def _window(
        self, extents: Callable[[str], tuple[list[Node], list[Node]]], margin: float
    ) -> tuple[CellRef, CellRef, CellRef]:
        """The middle and half the side of a square round all rows, live.

        extents  least and largest places along x or y;  margin: how much larger than that the square is
        """
        middles, sizes = [], []
        for axis in ("x", "y"):
            lows, highs = extents(axis)
            self._text(NAME, axis)
            low, high = self._formula(X, al.smallest(lows)), self._formula(Y, al.largest(highs))
            middles.append(self._formula(MIDDLE, formula("(low+high)/2", low=low, high=high)))
            sizes.append(formula("high-low", low=low, high=high))
            self.row += 1
        self._text(NAME, self.plan.text("drawing.half"))
        half = formula("IF(MAX(w,h)>0,factor*MAX(w,h),1)", w=sizes[0], h=sizes[1], factor=margin / 2)
        cell = self._formula(X, half)
        self.row += 1
        return middles[0], middles[1], cell

    def _extents(self, axis: str) -> tuple[list[Node], list[Node]]:
        """Least and largest of a coordinate: of a point in the table, of a circle about a fixed pin, of a fixed point."""
        plan, at = self.plan, self.plan.at
        lows: list[Node] = []
        highs: list[Node] = []
        fixed = [point for point in plan.mechanism.ground.points if point in pins_of(plan.mechanism)]
        for point in (*fixed, *moving_points(plan.mechanism)):
            symbol = f"{point}.{axis}"
            pivot = self._pivot(point)
            if symbol in at.spots and at.spots[symbol].column:
                column = self._table_column(symbol, plan.last_looked_at)
                lows.append(over_rows(LEAST, column))
                highs.append(over_rows(MOST, column))
            elif pivot is not None:
                link, pin = pivot
                centre = self._at_position(Symbol(f"{pin}.{axis}"))
                arm = self._at_position(length_in_cells(link, pin, point, plan.equations.poses))
                least, most = al.sub(centre, arm), al.add(centre, arm)
                if link.name != plan.mechanism.driver.link:
                    least, most = self._swing(symbol, least, most)
                    if (
                        len(moving_points(plan.mechanism)) > FEW_POINTS
                    ):  # in cells of its own: one formula would be long
                        self._text(NAME, rich(symbol))
                        least, most = self._formula(X, least), self._formula(Y, most)
                        self.row += 1
                lows.append(least)
                highs.append(most)
            elif point in fixed:
                lows.append(self._at_position(Symbol(symbol)))
                highs.append(lows[-1])
            else:
                self._slide_extent(symbol, lows, highs)
        cam = plan.mechanism.cam
        if cam is not None:
            centre, reach = self._at_position(Symbol(f"{cam.center}.{axis}")), self._reach()
            lows.append(al.sub(centre, reach))
            highs.append(al.add(centre, reach))
        if not lows:
            return [al.ZERO], [al.ZERO]
        return lows, highs

    def _reach(self) -> CellRef:
        """About how far a cam's profile lies from its centre: as far as in its own axes along one of them."""
        if self.cam_reach is None:
            columns = [self._table_column(f"cam.{axis}", self.plan.last_looked_at) for axis in ("x", "y")]
            ends = [over_rows(MOST, each) for each in columns] + [al.neg(over_rows(LEAST, each)) for each in columns]
            self._text(NAME, self.plan.text("drawing.radius"))
            self.cam_reach = self._formula(X, al.largest(ends))
            self.row += 1
        return self.cam_reach

    def _swing(self, symbol: str, least: Node, most: Node) -> tuple[Node, Node]:
        """From where to where a coordinate of a rocker's point goes, nearly; of the whole circle, where it turns far.

        By the ends and the middle of its swing: what lies between is at most 13 % of the arm farther out.
        """
        at = self.plan.at
        tree = self.plan.page.plain.get(symbol)
        moving = [name for name in symbols(tree) if self._has_column(name)] if tree else []
        if tree is None or len(set(moving)) != 1:
            return least, most
        turn = moving[0]
        ends = self._ends(turn)
        degrees = at.spots[turn].degrees

        def there(cell: CellRef) -> Node:
            angle: Node = Call("RADIANS", (cell,)) if degrees else cell
            return self._at_position(transform(tree, lambda part: angle if part == Symbol(turn) else part))

        low, middle, high = ends
        near = formula("high-low<=far", high=high, low=low, far=120.0 if degrees else 2.0)
        places = tuple(there(cell) for cell in (low, middle, high))
        return (
            formula("IF(near,some,least)", near=near, some=Call("MIN", places), least=least),
            formula("IF(near,some,most)", near=near, some=Call("MAX", places), most=most),
        )

    def _ends(self, symbol: str) -> tuple[CellRef, CellRef, CellRef]:
        """Least, middle and largest of an angle, as people read it."""
        if symbol not in self.swings:
            column = self._table_column(symbol, self.plan.last_looked_at)
            self._text(NAME, rich(symbol))
            low, high = self._formula(X, over_rows(LEAST, column)), self._formula(Y, over_rows(MOST, column))
            self.swings[symbol] = low, self._formula(MIDDLE, formula("(low+high)/2", low=low, high=high)), high
            self.row += 1
        return self.swings[symbol]

    def _slide_extent(self, symbol: str, lows: list[Node], highs: list[Node]) -> None:
        """Of a coordinate that is a displacement of the table, or a constant."""
        node = self.plan.page.plain.get(symbol, Symbol(symbol))
        sign, bare = (-1, node.operand) if isinstance(node, Unary) else (1, node)
        if not isinstance(bare, Symbol) or not self._has_column(bare.name):
            value = self._at_position(node)
            lows.append(value)
            highs.append(value)
            return
        column = self._table_column(bare.name, self.plan.last_looked_at)
        ends = [over_rows(way, column) for way in (LEAST, MOST)]
        if sign < 0:
            ends = [al.neg(end) for end in reversed(ends)]
        lows.append(ends[0])
        highs.append(ends[1])

    def _has_column(self, symbol: str) -> bool:
        spot = self.plan.at.spots.get(symbol)
        return spot is not None and spot.column

    def _pivot(self, point: str) -> tuple[Link, str] | None:
        """The link with which a point turns about a fixed pin."""
        mechanism = self.plan.mechanism
        for link in mechanism.links[1:]:
            if point in link.points and point not in mechanism.ground.points:
                pin = next((name for name in link.points if name in mechanism.ground.points), None)
                if pin is not None:
                    return link, pin
        return None

    def _chart_x(self, node: Node) -> Node:
        return al.div(al.sub(node, self.x), self.half)

    def _chart_y(self, node: Node) -> Node:
        return al.div(al.sub(node, self.y), self.half)

    # --- what is drawn ----------------------------------------------------------------------------------------

    def _corner(self, point: str) -> None:
        """A row of the chart for a point; where it stands already, that is read."""
        self._text(NAME, rich(point))
        if point in self.corners:
            x, y = self.corners[point]
            self._formula(X, x)
            self._formula(Y, y)
        else:
            x = self._formula(X, self._chart_x(self._at_position(Symbol(f"{point}.x"))))
            y = self._formula(Y, self._chart_y(self._at_position(Symbol(f"{point}.y"))))
            self.corners[point] = x, y
        self.last_corner = point
        self.row += 1

    def _link(self, link: Link) -> Series | None:
        """A bar between two points, a closed polygon round more."""
        plan, first = self.plan, self.row
        order = corners(link, dimension_values(plan.mechanism))
        if not order:
            return None
        if len(order) == 1:
            if order[0] in self.corners:
                return None
            self._corner(order[0])
            return None
        if order[0] == self.last_corner:  # where the link before ends, this one begins
            first, order = first - 1, (*order[1:], order[0]) if len(order) > 2 else order[1:]
        elif len(order) > 2:
            order = (*order, order[0])
        for point in order:
            self._corner(point)
        driven = plan.mechanism.driver.link or next(
            joint.link for joint in plan.mechanism.joints if joint.name == plan.mechanism.driver.joint
        )
        name = link.label.of(plan.language) if link.label else link.name
        x, y = self._ref(first, X, self.row - 1), self._ref(first, Y, self.row - 1)
        return Series(name, x, y, line=link_color(link, driven), width=2.5, in_legend=False)

    def _pins(self) -> list[Series]:
        """Names at all points, a triangle at a fixed pin, a ring at a moving one."""
        mechanism, found = self.plan.mechanism, []
        pins = pins_of(mechanism)
        for point in dict.fromkeys((*pins, *moving_points(mechanism))):
            fixed = point in mechanism.ground.points
            if point not in self.corners:
                self._corner(point)
            x, y = (
                SeriesRef(self.plan.main, Area(cell.row, cell.col, cell.row, cell.col)) for cell in self.corners[point]
            )
            size, inside = (10, QUIET) if fixed else (6, "FFFFFF") if point in pins else (5, INK)
            found.append(
                Series(
                    plain(point), x, y, marker="triangle" if fixed else "circle", marker_size=size, marker_line=INK,
                    marker_fill=inside, show_name=True, label_side="below" if fixed else "above", in_legend=False,
                )
            )  # fmt: skip
        return found

    def _guide(self, joint: Joint) -> Series | None:
        """The line of a sliding joint over the way that its point goes; on a moving link from that link's own point."""
        plan, first = self.plan, self.row
        mechanism = plan.mechanism
        spot = plan.at.spots.get(joint.symbol)
        if spot is None or not spot.column:
            return None
        x, y = (self._at_position(node) for node in through_of(mechanism, joint))
        direction = self._at_position(direction_of(mechanism, joint))
        column = self._table_column(joint.symbol, plan.last_looked_at)
        moving = joint.on != mechanism.ground.name
        base = line_end(joint, mechanism)
        name = plan.text("drawing.slot" if moving else "drawing.rail", symbol=plain(joint.symbol))
        if moving and base:
            self._corner(base)
        for way in (LEAST, MOST):
            self._text(NAME, name)
            end = over_rows(way, column)
            along, across = (al.mul(end, Call(turn, (direction,))) for turn in ("COS", "SIN"))
            self._formula(X, self._chart_x(al.add(x, along)))
            self._formula(Y, self._chart_y(al.add(y, across)))
            self.row += 1
        refs = self._ref(first, X, self.row - 1), self._ref(first, Y, self.row - 1)
        return Series(
            name, refs[0], refs[1], line=QUIET, width=1.5, dash="solid" if moving else "dash", in_legend=False
        )

    def _block(self, joint: Joint) -> Series | None:
        """A square where a sliding joint's point is."""
        if joint.point not in self.corners:
            return None
        x, y = (
            SeriesRef(self.plan.main, Area(cell.row, cell.col, cell.row, cell.col))
            for cell in self.corners[joint.point]
        )
        name = self.plan.text("drawing.block", symbol=plain(joint.symbol))
        return Series(
            name, x, y, marker="square", marker_size=12, marker_line=INK, marker_fill="E3E5E8", in_legend=False
        )

    def _traced(self) -> list[str]:
        """Points with a path that stand in the table."""
        spots = self.plan.at.spots
        wanted = traced_points(self.plan.mechanism)
        return [
            point for point in wanted
            if all(f"{point}.{axis}" in spots and spots[f"{point}.{axis}"].column for axis in ("x", "y"))
        ]  # fmt: skip

    def _path(self, point: str, index: int) -> Series:
        """The path of a point: two columns beside the table."""
        nodes = self._chart_x(self._of_row(f"{point}.x")), self._chart_y(self._of_row(f"{point}.y"))
        x, y = (self._beside(f"{axis} {plain(point)}", node) for axis, node in zip(("X", "Y"), nodes, strict=True))
        return Series(plain(point), x, y, line=PATH_COLORS[index % len(PATH_COLORS)], width=1.25, in_legend=False)

    def _cam(self) -> list[Series]:
        """The profile of a cam, as the cam stands in the row that is drawn: two columns beside the table."""
        cam = self.plan.mechanism.cam
        if cam is None:
            return []
        link = next(link for link in self.plan.mechanism.links if link.name == cam.link)
        angle = self._at_position(Symbol(link.angle_symbol))
        name = link_words(link).of(self.plan.language)
        self._text(NAME, name)
        turn = {"c": self._formula(X, Call("COS", (angle,))), "s": self._formula(Y, Call("SIN", (angle,)))}
        self.row += 1
        along = {"a": self._of_row("cam.x"), "b": self._of_row("cam.y"), **turn}
        x, y = (self._at_position(Symbol(f"{cam.center}.{axis}")) for axis in ("x", "y"))
        columns = (
            self._beside(f"X {name}", self._chart_x(formula("x+a*c-b*s", x=x, **along))),
            self._beside(f"Y {name}", self._chart_y(formula("y+a*s+b*c", y=y, **along))),
        )
        return [Series(name, *columns, line=link_color(link, cam.link), width=2.25, in_legend=False)]

    def _of_row(self, symbol: str) -> CellRef:
        """A column of the table in the row of a column beside it."""
        return CellRef(self.plan.at.first, self.plan.at.spots[symbol].col, col_abs=True)

    def _beside(self, head: str, node: Node) -> SeriesRef:
        """A column beside the table, filled down."""
        plan, col = self.plan, self.start + MIDDLE + 1 + self.path_columns
        self.cells.append(Cell(plan.symbol_row, col, head, styles.HEAD))
        self.fills.append(Fill(plan.at.first, col, node, STYLE, rows=plan.rows))
        self.path_columns += 1
        return SeriesRef(plan.main, Area(plan.at.first, col, plan.at.last, col))

    # --- hodographs -------------------------------------------------------------------------------------------

    def hodograph(self, request: ChartRequest) -> Chart:
        """The ends of velocities from one pole at true scale, and the vectors in the row that is drawn."""
        plan = self.plan
        names = ", ".join(plain(point) for point in request.hodographs)
        title = request.title.of(plan.language) if request.title else plan.text("chart.hodograph", points=names)
        self._text(NAME, title)
        self.row += 1

        def extents(axis: str) -> tuple[list[Node], list[Node]]:
            columns = [self._table_column(f"{point}.v{axis}", plan.last_looked_at) for point in request.hodographs]
            least, most = ([over_rows(way, column) for column in columns] for way in (LEAST, MOST))
            return [al.ZERO, *least], [al.ZERO, *most]

        x, y, half = self._window(extents, MARGIN)
        bar = self._scale_bar(half, f"{plan.mechanism.length_unit}/s")

        def places(read: Callable[[str], Node], point: str) -> tuple[Node, Node]:
            at_x, at_y = (read(f"{point}.v{axis}") for axis in ("x", "y"))
            return al.div(al.sub(at_x, x), half), al.div(al.sub(at_y, y), half)

        curves, vectors = [], []
        for index, point in enumerate(request.hodographs):
            color, name = styles.SERIES[index % len(styles.SERIES)], plain(f"{point}.v")
            curve = [self._beside(f"{axis} {name}", node) for axis, node in
                     zip(("X", "Y"), places(self._of_row, point), strict=True)]  # fmt: skip
            curves.append(Series(name, curve[0], curve[1], line=color, width=1.75, in_legend=False))
            first = self.row
            for ends in (places(lambda _: al.ZERO, point), places(self._indexed, point)):
                self._text(NAME, rich(f"{point}.v"))
                self._formula(X, ends[0])
                self._formula(Y, ends[1])
                self.row += 1
            line = Series(name, self._ref(first, X, first + 1), self._ref(first, Y, first + 1), line=INK, width=1.25,
                          in_legend=False)  # fmt: skip
            end = replace(
                line, x=self._ref(first + 1, X), y=self._ref(first + 1, Y), line="", marker="circle", marker_size=7,
                marker_line=INK, marker_fill=color, show_name=True,
            )  # fmt: skip
            vectors += [line, end]
        return Chart(
            title, Anchor(0, 0, CHART_HEIGHT, CHART_HEIGHT), (*curves, *vectors, *bar), HIDDEN_AXIS, HIDDEN_AXIS,
            legend="", inner=HODOGRAPH_INNER, alt_text=title,
        )  # fmt: skip

    # --- what is written beside -------------------------------------------------------------------------------

    def _scale_bar(self, half: CellRef, unit: str) -> tuple[Series, Series]:
        """A bar of 1, 2 or 5 times a power of ten, at most a quarter of the window; its length is the label."""
        text = self.plan.text
        self._text(NAME, text("drawing.bar"))
        length = self._formula(X, longest_bar(al.div(half, al.TWO)))
        words = self._formula(Y, joined(formula("ROUND(length,12)", length=length), f" {unit}" if unit else ""))
        self.row += 1
        first = self.row
        self._text(X, LEFT)
        self._text(Y, BOTTOM)
        self.row += 1
        self._formula(X, formula("left+length/half", left=al.number(LEFT), length=length, half=half))
        self._text(Y, BOTTOM)
        x, y = self._ref(first, X, self.row), self._ref(first, Y, self.row)
        bar = Series(text("drawing.bar"), x, y, line=INK, width=2.0, in_legend=False)
        named = CellRef(words.row, words.col, True, True, self.plan.main)
        at = self._ref(self.row, X), self._ref(self.row, Y)
        end = Series(named, at[0], at[1], show_name=True, label_side="right", in_legend=False)
        self.row += 1
        return bar, end

    def _caption(self) -> Series:
        """The driver's value in the upper left corner, and what does not close."""
        plan = self.plan
        driver = plan.mechanism.driver
        value = formula("ROUND(value,3)", value=self._quantity(driver.symbol))
        said = self._indexed("#status")
        words: Node = joined(f"{plain(driver.symbol)} = ", value, behind_number(driver.unit.text), "  ", said)
        nothing: Node = Text(plan.text("drawing.nothing"))
        cell = self._formula(NAME, formula("IFERROR(words,nothing)", words=words, nothing=nothing))
        self._text(X, LEFT)
        self._text(Y, CAPTION)
        named = CellRef(cell.row, cell.col, True, True, plan.main)
        series = Series(
            named, self._ref(self.row, X), self._ref(self.row, Y), show_name=True, label_side="right", label_size=10.0,
            in_legend=False,
        )  # fmt: skip
        self.row += 1
        return series

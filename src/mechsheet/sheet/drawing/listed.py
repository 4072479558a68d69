"""The list of shapes in cells: quantities at the position shown, places, corners, names; each block the same columns filled
down.

    places    a point, or the frame of a form: its origin (x, y), where that is in the chart (X, Y), and its two vectors
    corners   of every shape, one a row: a of the first vector and b of the second from the origin of the place with that
              number,  X = X(place) + (a along.x + b across.x) / half

What the formulas of places have in common, and what they read of the tables, stands above them in cells of its own
(`quantities`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import groupby

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import CellRef, Node, RangeRef, Symbol, symbols
from livesheet.formula.vectors import NOWHERE, Vector, minus, plus, times, together
from livesheet.workbook import Rich, Series, SeriesRef
from mechsheet.shapes.colors import INK
from mechsheet.shapes.forms import ARROW_HEAD, ARROWS, LEAST, LETTERS, Mark, Name, Shape, place_of
from mechsheet.shapes.listing import shapes_of
from mechsheet.shapes.loads import HEAD, LONGEST
from mechsheet.shapes.names import POINTS
from mechsheet.shapes.positions import rings_needed, ways_in
from mechsheet.sheet import styles
from mechsheet.sheet.drawing.frames import (
    AT,
    CHART_X,
    CHART_Y,
    EIGHTH,
    FIRST,
    NAME,
    NINTH,
    NUMBER,
    NUMBER_STYLE,
    PART,
    SECOND,
    SEVENTH,
    SIXTH,
    Page,
    arrow_bar,
    beside,
    near,
)
from mechsheet.sheet.drawing.labels import as_described, ways_beside
from mechsheet.sheet.drawing.quantities import KINDS, Quantities
from mechsheet.sheet.quoted import formula, joined
from mechsheet.sheet.shown import rich

DIGITS = 3
"""Of a value beside the name of a force."""

MOST_SERIES = 255
"""Series that a chart of a spreadsheet takes."""

GROWN = 1.25
"""Plates are filled also when dimensions become so many times as large."""

MOST_CORNERS = 24
"""Of a plate that is filled; a traced outline has hundreds."""

DISC = {"pin": (6, "FFFFFF"), "point": (3, INK)}
"""How large a disc inside its ring is [points], and its colour."""


@dataclass(frozen=True, slots=True)
class PointCells:
    """A point at the position shown: its coordinates, and its place in the drawing."""

    x: CellRef
    y: CellRef
    chart_x: CellRef
    chart_y: CellRef


@dataclass(frozen=True, slots=True)
class _Corner:
    """A row of the block of corners: the shape's name, (a, b), and the number of a place."""

    name: str
    a: float
    b: float
    place: int


class Listed:
    """A list of shapes, written on a page from its present row on.

    letters  how high names are (`letters_in`);  besides  writes what is drawn besides

    frame    the window;  points  the cells of every point;  series  what the chart draws, from back to front
    """

    def __init__(self, page: Page, letters: float, besides: Callable[[], Series]) -> None:
        plan = page.plan
        vectors = [KINDS[kind] for kind in plan.arrows]
        found = shapes_of(plan.mechanism, plan.equations.equations, vectors)
        self.page, self.found, self._letters = page, found, letters
        self._numbers: dict[tuple[Vector, Vector, Vector, Node | None], int] = {}
        self._ends: dict[Vector, int] = {}
        self._origins: dict[Vector, int] = {}
        self.points: dict[str, PointCells] = {}
        self._rows: dict[int, tuple[int, int]] = {}
        self._inside: dict[int, int] = {}
        self._drawn = as_described(plan, vectors)
        self._curves: dict[int, int] = {}
        self._marked = [_point_at(shape.at) for shape in found.shapes if isinstance(shape, Mark)]
        self._quantities = quantities = Quantities(page, found, self._marked)
        self.frame = quantities.frame
        corners, named = self._places()
        self._series = self._corners(corners)
        paths = self._paths()
        names = list(self._names(named))
        bars = [
            each
            for number, scale in enumerate(found.scales)
            for each in arrow_bar(page, scale, number, quantities.bound(scale.most), quantities.bound(scale.shown))
        ]
        caption = besides()
        self.series = self._in_both_orders(paths, [*names, *self.frame.series, caption, *bars])

    # --- places and corners --------------------------------------------------------------------------------------

    def _places(self) -> tuple[list[_Corner], list[int]]:
        """The points, then the frames of all forms; returned are the corners that lie in them, and the places of names."""
        page, text = self.page, self.page.plan.text
        heads = [
            "x",
            "y",
            "X",
            "Y",
            *(text(f"drawing.{key}") for key in ("along.x", "along.y", "across.x", "across.y", "number", "size", "at")),
        ]
        page.section(text("drawing.places"), heads)
        self.first_place = page.row
        for point in self._marked:
            row = page.row
            self._place(place_of(point), rich(point))
            x, y, chart_x, chart_y = (page.cell(col, row) for col in (FIRST, SECOND, CHART_X, CHART_Y))
            self.points[point] = PointCells(x, y, chart_x, chart_y)
        found: list[_Corner] = []
        for index, shape in enumerate(self.found.shapes):
            if isinstance(shape, Mark) or shape.kind == "path":
                continue
            start = len(found)
            if shape.is_curve and shape.frame is not None:
                self._curves[index] = self._place(shape.frame.origin, shape.name, shape.vectors[1:])
                continue
            if shape.frame is None:
                found += [_Corner(shape.name, 0.0, 0.0, self._place(at, shape.name)) for at in shape.corners]
                if shape.border and len(shape.corners) > 3:
                    self._inside[index] = len(found) - 1
                    found += self._rings(shape)
            else:
                head = shape.path == ARROW_HEAD
                number = self._place(shape.frame.origin, shape.name, shape.vectors[1:], shape.size, head)
                found += [_Corner(shape.name, a, b, number) for a, b in shape.path]
            self._rows[index] = start, len(found) - 1
        by_origin = {(at, size): number for (at, _, _, size), number in reversed(self._numbers.items())}
        named = [by_origin.get((each.at, each.size)) or self._place(each.at, each.text, size=each.size)
                 for each in self.found.names]  # fmt: skip
        self.last_place = page.row - 1
        for sized, run in groupby(enumerate(self._numbers, self.first_place), lambda each: each[1][-1] is not None):
            rows = [row for row, _ in run]
            part = page.cell(PART, rows[0], anchored=False) if sized else None
            node = self.frame.chart_x(beside(page.cell(FIRST, rows[0], anchored=False)))
            self._filled(CHART_X, self._if_large(node, part), rows[0], rows[-1])
        return found, named

    def _rings(self, plate: Shape) -> Iterator[_Corner]:
        """What fills a plate: each of its corners on the way to the middle of all, again and again."""
        points, count = LETTERS * POINTS / self._letters, len(plate.corners) - 1
        outline = next((each for each in self._drawn.columns(plate) if np.isfinite(each).all()), None)
        if outline is None:
            return
        width = (plate.width - 2 * plate.border) * self._drawn.window.half / points
        if count > MOST_CORNERS:
            return
        middle = times(al.number(1 / count), together(plate.corners[:-1]))
        row = self.first_place + self._place(middle, plate.name) - 1
        for part, col in zip(middle, (FIRST, SECOND), strict=True):
            self._quantities.stands(part, self.page.cell(col, row))
        numbers = [self._place(at, plate.name, (minus(middle, at), NOWHERE)) for at in plate.corners]
        for way in ways_in(rings_needed(GROWN * outline, width)):
            yield from (_Corner(plate.name, way, 0.0, number) for number in numbers)

    def _place(
        self, at: Vector, name: Rich | str, vectors: Sequence[Vector] = (NOWHERE, NOWHERE), size: Node | None = None,
        head: bool = False,
    ) -> int:  # fmt: skip
        """The number of a place, in a row of its own where there is none yet.

        The `head` of an arrow, which begins at the end of its shaft, is found from the row of that.
        """
        page = self.page
        along, across = vectors
        key = at, along, across, size
        if key in self._numbers:
            return self._numbers[key]
        self._numbers[key] = number = len(self._numbers) + 1
        page.put(NAME, name, styles.LABEL if isinstance(name, str) else styles.SYMBOL)
        part = None if size is None else self._part(size)
        self._origin(at)
        if head and part is not None:
            self._head(along, part, self._ends[at])
        else:
            self._vector(SIXTH, along, part)
            self._vector(EIGHTH, across, part)
        if size is not None and along != NOWHERE:
            self._ends.setdefault(plus(at, along), page.row)
        page.put(NUMBER, float(number), styles.decimals(styles.INNER, 0))
        page.row += 1
        return number

    def _origin(self, at: Vector) -> None:
        """x and y of a place: those of the end of the shaft above it, of a point or another place there, or its own."""
        page, shaft, point = self.page, self._ends.get(at), _point_at(at)
        if shaft is not None:
            start, way = (beside(page.cell(col, shaft, anchored=False)) for col in (FIRST, SIXTH))
            page.formula(FIRST, al.add(start, way), cols=2)
        elif point in self.points:
            number = self.points[point].x.row - self.first_place + 1
            page.put(AT, float(number), styles.decimals(styles.INNER, 0))
            points = page.column_of(FIRST, self.first_place, self.first_place + len(self._marked) - 1, anchored=False)
            page.formula(FIRST, formula("INDEX(points,at)", points=points, at=page.cell(AT, anchored=False)), cols=2)
        elif at in self._origins:
            page.formula(FIRST, beside(page.cell(FIRST, self._origins[at], anchored=False)), cols=2)
        else:
            if any(map(symbols, at)):
                self._origins[at] = page.row
            page.both(FIRST, *map(self._quantities.bound, at))
            for col, node in zip((FIRST, SECOND), at, strict=True):
                if isinstance(node, Symbol):
                    self._quantities.stands(node, near(page.cell(col)))

    def _vector(self, col: int, vector: Vector, part: Node | None) -> None:
        """The two numbers of a vector; what is 0 has no cell."""
        page, nodes = self.page, [self._if_large(self._quantities.bound(node), part) for node in vector]
        written = [(each, node) for each, node in enumerate(vector, col) if not al.is_zero(node)]
        if len(written) == 2:
            page.both(col, *nodes)
        for each, node in written:
            if len(written) == 1:
                page.formula(each, nodes[each - col])
            if not isinstance(node, Symbol) and al.value_of(node) is None:
                self._quantities.stands(node, near(page.cell(each)))

    def _head(self, along: Vector, part: CellRef, shaft: int) -> None:
        """The two vectors of an arrow's head: that along its shaft, which is `part` of the longest there may be, and the one
        across, a quarter turn from it; what is 0 has no cell."""
        page = self.page
        for component, col, aside in zip(along, (SIXTH, SEVENTH), (NINTH, EIGHTH), strict=True):
            if al.is_zero(component):
                continue
            way = beside(page.cell(col, shaft, anchored=False))
            node = formula("head/longest*way/part", head=HEAD, longest=LONGEST, way=way, part=part)
            own = near(page.formula(col, self._if_large(node, part)))
            page.formula(aside, self._if_large(al.neg(own) if aside == EIGHTH else own, part))

    def _part(self, size: Node) -> CellRef:
        """The cell of a place that says which part an arrow is of the largest: its own, or what is beside the first place
        of that size, as its shaft's."""
        page, known = self.page, self._quantities.known.get(size)
        if known is None:
            cell = page.formula(PART, formula("IFERROR(part,0)", part=self._quantities.bound(size)))
            self._quantities.stands(size, near(cell))
        else:
            cell = page.formula(PART, known)
        return near(cell)

    @staticmethod
    def _if_large(node: Node, part: Node | None) -> Node:
        """What an arrow needs: #N/A while it is too small to be drawn."""
        return node if part is None else formula("IF(part<least,NA(),node)", part=part, least=LEAST, node=node)

    def _filled(self, col: int, node: Node, first: int, last: int) -> None:
        """Fill rows of a column and of the one beside it, x and y, with one formula."""
        row, self.page.row = self.page.row, first
        self.page.formula(col, node, rows=last - first + 1, cols=2)
        self.page.row = row

    def _corners(self, corners: Sequence[_Corner]) -> dict[int, tuple[Series, ...]]:
        """The block of corners, and by the shape's number what is drawn through its own."""
        page, text = self.page, self.page.plan.text
        page.section(text("drawing.shapes"), ["a", "b", "X", "Y", "", "", "", "", text("drawing.number")])
        start, name = page.row, ""
        for corner in corners:
            page.put(NAME, corner.name if corner.name != name else "")
            name = corner.name
            for col, part in ((FIRST, corner.a), (SECOND, corner.b)):
                if part:
                    page.put(col, round(part, 6), NUMBER_STYLE)
            page.put(NUMBER, float(corner.place), styles.decimals(styles.INNER, 0))
            page.row += 1
        if not corners:
            return {}
        own = {key: page.cell(col, start, anchored=False) for key, col in
               (("a", FIRST), ("b", SECOND), ("number", NUMBER))}  # fmt: skip
        places = {key: self._of_places(col) for key, col in (("place", CHART_X), ("along", SIXTH), ("across", EIGHTH))}
        node = formula(
            "IFERROR(INDEX(place,number)+(a*INDEX(along,number)+b*INDEX(across,number))/half,NA())",
            half=self.frame.half, **places, **own,
        )  # fmt: skip
        self._filled(CHART_X, node, start, page.row - 1)
        return self._lines(start)

    def _of_places(self, col: int) -> RangeRef:
        """A column of all places, for a formula that is filled right: that of x, beside it is that of y."""
        return self.page.column_of(col, self.first_place, self.last_place, anchored=False)

    def _lines(self, start: int) -> dict[int, tuple[Series, ...]]:
        """A line for each shape; the tip of an arrow goes on from its shaft, the mark of a mass centre from its ring.

        A plate has two, its border and on it its inside.
        """
        found: dict[int, tuple[Series, ...]] = {}
        before = -1
        for index, (first, last) in self._rows.items():
            shape = self.found.shapes[index]
            assert isinstance(shape, Shape)
            goes_on = before in found and before == index - 1 and self._belongs(shape, self.found.shapes[before])
            if goes_on:
                (line,) = found.pop(before)
                found[index] = (self._line(line.line, line.width, line.x.area.first_row, start + last, shape.name),)
            elif shape.border:
                outer = self._inside.get(index, last)
                inside = self._line(shape.fill, shape.width - 2 * shape.border, start + first, start + last, shape.name)
                found[index] = self._line(shape.color, shape.width, start + first, start + outer, shape.name), inside
            else:
                found[index] = (self._line(shape.color, shape.width, start + first, start + last, shape.name),)
            before = index
        return found

    def _line(self, color: str, width: float, first: int, last: int, name: str) -> Series:
        x, y = (self.page.reference(first, col, last) for col in (CHART_X, CHART_Y))
        return Series(name, x, y, line=color, width=width, in_legend=False)

    @staticmethod
    def _belongs(shape: Shape, before: Shape | Mark) -> bool:
        return (shape.kind, shape.name) == (before.kind, before.name) and shape.kind in (*ARROWS, "mass")

    # --- what else is drawn --------------------------------------------------------------------------------------

    def _in_both_orders(self, paths: Sequence[Series], besides: Sequence[Series]) -> tuple[Series, ...]:
        """Excel draws the last series on top, LibreOffice the first: what lies lowest is in the middle, with all that covers
        nothing, and from links on each shape on both sides of it, as far as a chart takes so many series."""
        shapes = self.found.shapes
        first = next((n for n, shape in enumerate(shapes) if isinstance(shape, Shape) and shape.border), len(shapes))
        last = max((n for n, shape in enumerate(shapes) if isinstance(shape, Mark)), default=0)
        lowest = [each for n, drawn in self._series.items() if n < first for each in drawn]
        upper = [each for n, drawn in self._series.items() if first <= n < last for each in drawn]
        upper += self._marks()
        upper += [each for n, drawn in self._series.items() if n > max(first, last) for each in drawn]
        once = [*paths, *lowest, *besides]
        room = max(0, MOST_SERIES - len(once) - len(upper))
        return (*upper[: -room - 1 : -1], *once, *upper)

    def _paths(self) -> list[Series]:
        """The paths of points, and what a cam's curves are at the position shown: two sweep columns each."""
        page, found = self.page, []
        page.apart()
        for index, shape in enumerate(self.found.shapes):
            if isinstance(shape, Mark) or not (shape.kind == "path" or shape.is_curve):
                continue
            a, b = (page.in_row(part) for part in shape.corners[0])
            chart = self._in_place(self._curves[index], a, b) if shape.is_curve else (
                self.frame.chart_x(a), self.frame.chart_y(b)
            )  # fmt: skip
            x, y = (
                SeriesRef(page.title, page.column(f"{axis} · {shape.name}", node))
                for axis, node in zip("XY", chart, strict=True)
            )
            found.append(Series(shape.name, x, y, line=shape.color, width=shape.width, in_legend=False))
        return found

    def _in_place(self, number: int, a: Node, b: Node) -> tuple[Node, Node]:
        """Where in the chart  a along + b across  lies, from the origin of a place."""
        row = self.first_place + number - 1
        half, nodes = self.frame.half, []
        for chart, along, across in ((CHART_X, SIXTH, EIGHTH), (CHART_Y, SEVENTH, NINTH)):
            cells = {"at": self.page.cell(chart, row), "along": self.page.cell(along, row)}
            cells["across"] = self.page.cell(across, row)
            nodes.append(formula("at+(a*along+b*across)/half", a=a, b=b, half=half, **cells))
        return nodes[0], nodes[1]

    def _marks(self) -> list[Series]:
        """Rings at the revolute joints, dots at other points.

        LibreOffice has no borders round markers: a ring is a light disc on a dark one.
        """
        back, front = [], []
        for kind, (size, inside) in DISC.items():
            marks = [shape for shape in self.found.shapes if isinstance(shape, Mark) and shape.kind == kind]
            if not marks:
                continue
            first, last = (self.points[_point_at(mark.at)].x.row for mark in (marks[0], marks[-1]))
            x, y = (self.page.reference(first, col, last) for col in (CHART_X, CHART_Y))
            name = self.page.plan.text("drawing.points")
            disc = Series(name, x, y, marker="circle", marker_size=size + 3, in_legend=False)
            back.append(replace(disc, marker_line=INK, marker_fill=INK))
            front.append(replace(disc, marker_size=size, marker_line=inside, marker_fill=inside))
        return [*back, *front]

    def _names(self, places: Sequence[int]) -> Iterator[Series]:
        """Names beside their places; where each stands is chosen for the positions of the description's own dimensions."""
        page, text = self.page, self.page.plan.text
        if not places:
            return
        heads = [text("drawing.name.x"), text("drawing.name.y"), "X", "Y", text("drawing.name.text")]
        page.section(text("drawing.names"), [*heads, "", "", text("drawing.name"), text("drawing.number")])
        start = page.row
        for number, (name, place) in enumerate(zip(self.found.names, places, strict=True), 1):
            page.put(NAME, name.text)
            words: str | CellRef = name.text
            if name.value is not None:
                words = page.named(page.formula(SIXTH, self._with_value(name), styles.INNER))
            for col, count in ((NINTH, number), (NUMBER, place)):
                page.put(col, float(count), styles.decimals(styles.INNER, 0))
            x, y = page.reference(page.row, CHART_X), page.reference(page.row, CHART_Y)
            yield Series(words, x, y, show_name=True, label_side="center", in_legend=False)
            page.row += 1
        way = ways_beside(page, self._drawn, self._letters, page.cell(NINTH, start, anchored=False))
        self._filled(FIRST, way, start, page.row - 1)
        node = formula(
            "IFERROR(INDEX(origins,number)+beside,NA())", origins=self._of_places(CHART_X),
            number=page.cell(NUMBER, start, anchored=False),
            beside=beside(page.cell(FIRST, start, anchored=False)),
        )  # fmt: skip
        self._filled(CHART_X, node, start, page.row - 1)

    def _with_value(self, name: Name) -> Node:
        """`name = 12.3 N`."""
        value = self._quantities.bound(name.value or al.ZERO)
        rounded = formula("ROUND(value,digits-1-INT(LOG10(ABS(value))))", value=value, digits=DIGITS)
        words = joined(f"{name.text} = ", rounded, f" {name.unit}" if name.unit else "")
        return formula("IFERROR(words,name)", words=words, name=name.text)


def _point_at(at: Vector) -> str:
    """The point whose place is at."""
    return at[0].name.rpartition(".")[0] if isinstance(at[0], Symbol) else ""

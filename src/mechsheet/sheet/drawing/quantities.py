"""What the formulas of the drawing read, and in which cell each of it stands.

The list of shapes says in trees over symbols where everything is: a corner at  A.x + 0.1 cos(theta12).  Before the first
shape is written, everything that such trees need for the position shown gets a cell of its own, so that no formula looks the
same thing up twice:

    switches    the cells of the first sheet that hide arrows
    extremes    the least and the largest of the whole motion, as a spring's greatest length
    window      the middle and the half side by which all is divided (`write_window`)
    quantities  those of the tables, in the row of the position shown; the components of a vector side by side
    parts       what several trees have in common and a program would compute again and again

From then on `bound` writes any tree as a formula: a part that has a cell is read there, the rest is written out. Who writes
a further cell that others may read says so (`stands`).
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace

from livesheet.formula.nodes import Binary, Call, CellRef, Node, Symbol, Unary, renamed, symbols, walk
from mechsheet.shapes.forms import Kind, Mark, Shapes, shown
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.drawing.frames import FIRST, NAME, SECOND, Page, near, write_window
from mechsheet.sheet.over_rows import LEAST, MOST
from mechsheet.sheet.plan import ArrowKind
from mechsheet.sheet.shown import rich, rich_both

KINDS: dict[ArrowKind, Kind] = {"velocity": "velocity", "acceleration": "acceleration", "forces": "force"}
"""What the list of shapes calls the arrows that a cell of the first sheet hides."""

COSTLY = ("SQRT", "COS", "SIN", "ABS", "MAX")
"""Functions whose values have a cell of their own where several formulas read them."""


class Quantities:
    """What the formulas of a list of shapes read, written on a page from its present row on.

    marked  points that get a row of their own among the places, where their coordinates stand

    known   by tree the cell in which it stands;  frame  the window
    """

    def __init__(self, page: Page, shapes: Shapes, marked: Collection[str]) -> None:
        self._page, self._shapes, self._marked = page, shapes, marked
        self.known: dict[Node, Node] = {}
        self._switches()
        self._extremes()
        self.frame = write_window(page, shapes)
        page.section(page.plan.text("drawing.quantities"))
        start = page.row
        nodes = list(dict.fromkeys(self._nodes()))
        self._needed(nodes)
        self._in_common(nodes)
        if page.row == start:  # nothing below the heading
            page.put(NAME, page.plan.text("drawing.only_points"))
            page.row += 1

    # --- what is asked of them -----------------------------------------------------------------------------------

    def bound(self, node: Node) -> Node:
        """A tree over symbols as a formula at the position shown."""
        if node in self.known:
            return self.known[node]
        match node:
            case Symbol():
                return self._bound_symbol(node)
            case Call(name, args):
                return Call(name, tuple(map(self.bound, args)))
            case Unary(op, operand):
                return Unary(op, self.bound(operand))
            case Binary(op, left, right):
                return Binary(op, self.bound(left), self.bound(right))
        return node

    def _bound_symbol(self, symbol: Symbol) -> Node:
        page = self._page
        if symbol.name in page.known:
            return page.known[symbol.name]
        if symbol.name not in page.plan.at.spots:
            return self.bound(page.plan.plain[symbol.name])
        return page.at_position(symbol.name)

    def stands(self, node: Node, cell: CellRef) -> None:
        """From now on a tree is read from this cell, if it has none yet."""
        self.known.setdefault(node, cell)

    # --- of the first sheet, and of the whole motion -------------------------------------------------------------

    def _switches(self) -> None:
        plan = self._page.plan
        for kind in plan.arrows:
            self._page.known[shown(KINDS[kind]).name] = plan.at.bind(plan.places.arrows[kind].cell, self._page.title)

    def _extremes(self) -> None:
        """The least and the largest of the motion, each in a cell."""
        page = self._page
        if self._shapes.extremes:
            page.section(page.plan.text("drawing.over_motion"))
        for extreme in self._shapes.extremes:
            function = LEAST if extreme.take == "min" else MOST
            name = page.plan.text(f"drawing.{extreme.take}", number=len(page.known) + 1)
            node = page.over_motion(name, function, extreme.of)
            page.put(NAME, name)
            page.known[extreme.symbol] = page.formula(FIRST, node)
            page.row += 1

    # --- of the position shown -----------------------------------------------------------------------------------

    def _nodes(self) -> Iterator[Node]:
        """All trees of the list of shapes."""
        for shape in self._shapes.shapes:
            if isinstance(shape, Mark):
                yield from shape.at
            elif shape.kind != "path":
                yield from (node for vector in shape.vectors for node in vector)
                if shape.size is not None:
                    yield shape.size
        for name in self._shapes.names:
            yield from (*name.at, *(node for node in (name.value, name.size) if node is not None))
        for scale in self._shapes.scales:
            yield scale.most

    def _needed(self, nodes: Collection[Node]) -> None:
        """The quantities of the tables that trees read."""
        pairs = self._pairs()
        for name in dict.fromkeys(name for node in nodes for name in symbols(node)):
            self._need(name, pairs)

    def _need(self, name: str, pairs: Mapping[str, str]) -> None:
        """A row for a quantity of the table, and for those that one without a cell is found from; points have rows below.
        The two of a pair share one."""
        page, spots = self._page, self._page.plan.at.spots
        symbol = Symbol(name)
        if symbol in self.known or name in page.known:
            return
        if name not in spots:
            for below in symbols(page.plan.plain[name]):
                self._need(below, pairs)
            return
        point, _, axis = name.rpartition(".")
        if spots[name].column and not (axis in ("x", "y") and point in self._marked):
            right = pairs.get(name)
            if right is None or Symbol(right) in self.known:
                page.put(NAME, rich(name), styles.SYMBOL)
                page.formula(FIRST, page.at_position(name))
            else:
                page.put(NAME, rich_both(name, right), styles.SYMBOL)
                page.both(FIRST, page.at_position(name), page.at_position(right))
                self.stands(Symbol(right), near(page.cell(SECOND)))
            self.stands(symbol, near(page.cell(FIRST)))
            page.row += 1

    def _pairs(self) -> dict[str, str]:
        """The components of vectors that stand side by side in a table, as those of a force do: by that of x that of y."""
        spots, found = self._page.plan.at.spots, dict[str, str]()
        for shape in self._shapes.shapes:
            for x, y in () if isinstance(shape, Mark) or shape.kind == "path" else shape.vectors:
                both = dict(zip(symbols(x), symbols(y), strict=False))
                if renamed(x, both) != y:
                    continue
                for of_x, of_y in both.items():
                    here, right = spots.get(of_x), spots.get(of_y)
                    if here is not None and right is not None and _beside_each_other(here, right):
                        found[of_x] = of_y
        return found

    def _in_common(self, nodes: Collection[Node]) -> None:
        """What several trees have in common, the smallest first: larger ones may read it."""
        page, sizes, mosts = self._page, set(self._sizes()), {scale.most for scale in self._shapes.scales}
        counts = Counter(
            part for node in nodes for part in dict.fromkeys(walk(node)) if _is_costly(part) and part not in sizes
        )
        parts = [part for part, count in counts.items() if count > 1]
        for part in sorted(parts, key=lambda each: sum(1 for _ in walk(each))):
            page.put(NAME, page.plan.text("drawing.part"))
            cell = page.formula(FIRST, self.bound(part))
            # the longest of a kind is the same for all arrows
            self.stands(part, cell if part in mosts else near(cell))
            page.row += 1

    def _sizes(self) -> Iterator[Node]:
        """Which part arrows are of the largest: each has its cell beside its place."""
        for each in (*self._shapes.shapes, *self._shapes.names):
            if not isinstance(each, Mark) and each.size is not None:
                yield each.size


def _beside_each_other(here: Spot, right: Spot) -> bool:
    """Whether two columns of one table are neighbours, and read alike."""
    return replace(here, col=here.col + 1, name="") == replace(right, name="")


def _is_costly(node: Node) -> bool:
    return isinstance(node, Call) and node.name in COSTLY and any(True for _ in symbols(node))

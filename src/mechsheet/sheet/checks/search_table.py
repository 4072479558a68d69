"""The sheet of searches: the formulas of the table of positions, filled down at other values of the driver.

Each row is a probe. Columns before those of the positions say what is known, where the probe is (`search_rules`), and what
it has found. All rows of a search have the same formulas, but for its first one, which begins from rows of
*Positions*. Places are counted in rows: 1 is the first row of the table, 2.5 lies halfway between the second and the third.
An angle without jumps is taken within half a turn of what it is in the row from which the search begins.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from dataclasses import replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import (
    Binary,
    Call,
    CellRef,
    Node,
    Number,
    Previous,
    RangeRef,
    Symbol,
    transform,
    with_symbols,
)
from livesheet.workbook import Cell, Content, Fill, Style
from mechsheet.model import TIME
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.checks.search_rules import PLACE
from mechsheet.sheet.driving import by_time, driver_at, time_after
from mechsheet.sheet.plan import NUMBER, STATUS, Plan, TableColumn
from mechsheet.sheet.quoted import ALL, formula
from mechsheet.sheet.table.positions import cell_formula, style_of

LABEL, COLUMN, NEAR, SENSE, LIMIT, SIDE = range(6)
"""The first columns: in words what is sought; in which column of its table; near which row angles are taken; 1 or -1 where
the smallest or the largest value is sought; from which limit, and on which side of it, places are counted by roots."""

KNOWN = SIDE + 1
"""The first of six columns of what a row knows."""

VERTEX_COL, PROBE_COL, VALUE_COL, PLACE_COL = range(KNOWN + 6, KNOWN + 10)
"""Where the parabola has its vertex (of a limit: on which part of the way the probe is); the probe and what it has found, as
places and values of what is known side by side; its place in rows."""

DECIMALS = 6
"""Of places and of what is known of them."""

DRIVER_COL = PLACE_COL + 1
"""The driver's value there; the table's columns follow."""


class SearchTable:
    """The cells of the sheet, and where its columns stand."""

    def __init__(self, plan: Plan, title: str) -> None:
        self.plan = plan
        self.title = title
        own = [column for column in plan.columns if column.col not in (NUMBER, STATUS)]
        self.columns: list[TableColumn] = [
            replace(column, col=col)
            for col, column in enumerate((*own, *plan.rates, *plan.forces, *plan.bands), DRIVER_COL)
        ]
        # the table's columns on this sheet
        spots = {each.symbol: replace(plan.at.spots[each.symbol], sheet=title, col=each.col) for each in self.columns}
        self.at = plan.at.beside(spots)
        self.side = DRIVER_COL + len(self.columns)
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self._reads = {equation.symbol: equation.reads for equation in plan.equations.columns}

    @property
    def rows(self) -> Node:
        """How many rows the table of positions has: a cell of this sheet, where it is read most."""
        return self.plan.searched.rows.cell

    # --- places -----------------------------------------------------------------------------------------------

    def spot(self, row: int, work: int) -> Spot:
        """Where other sheets find a cell beside the table's columns."""
        return Spot(self.title, row, self.side + work)

    def fixed(self, row: int, work: int) -> CellRef:
        """A cell beside the table's columns, wherever it is read."""
        return CellRef(row, self.side + work, True, True)

    def near(self, row: int, work: int) -> CellRef:
        """The same, for formulas that are copied together with it."""
        return CellRef(row, self.side + work, False, True)

    def quantity(self, row: int, symbol: str) -> CellRef:
        """What a probe has found of a quantity, as people read it."""
        return CellRef(row, self.at.spots[symbol].col, False, True)

    # --- the quantity of a search -----------------------------------------------------------------------------
    # Which one it is stands in a cell, as its column among those of its table: so the formulas of searches are alike.

    def number_of(self, symbol: str) -> Node:
        """In which column of its table a quantity stands, counted from the first that is filled down here."""
        return formula("COLUMNS(columns)", columns=self._columns(self._table_of(symbol)[0], symbol))

    def in_row(self, sought: str, row: int, place: Node) -> Node:
        """What its table has of the quantity whose search begins in a row, in the row `place` of the table, from 1."""
        table, number = self._columns(*self._table_of(sought)), CellRef(row, COLUMN, False, True)
        return formula("INDEX(table,place,number)", table=table, place=place, number=number)

    def in_rows(self, sought: str, row: int, first: Node = al.ONE) -> Node:
        """The same in all rows of the table, or from one on.

        `INDEX(table,0,number)` would be all of them, but gnumeric knows no row 0.
        """
        return Binary(":", *(self.in_row(sought, row, place) for place in (first, self.rows)))

    def probed(self, sought: str, probe: int, anchored: bool = False) -> CellRef:
        """What a row here has found of a quantity: by its cell, as a column inserted into the table is not here."""
        return CellRef(probe, self.at.spots[sought].col, anchored, True)

    def _columns(self, first: str, last: str) -> RangeRef:
        """Columns of a table, from one to another, as formulas here read them."""
        start, end = (self.plan.at.column(each, self.title) for each in (first, last))
        return RangeRef(start.start, end.end)

    def _table_of(self, symbol: str) -> tuple[str, str]:
        """The first and the last column of a quantity's table that stand side by side here as they do there."""
        there = self.plan.at.spots
        away = {each.symbol: (there[each.symbol].sheet, there[each.symbol].col - each.col) for each in self.columns}
        together = [each.symbol for each in self.columns if away[each.symbol] == away[symbol]]
        return together[0], together[-1]

    def first_beside(self, symbol: str) -> str:
        """The first quantity of the table in which one stands."""
        return self._table_of(symbol)[0]

    def down(self, row: int, work: int, count: int) -> RangeRef:
        """Cells below each other, wherever they are read."""
        return RangeRef(self.fixed(row, work), self.fixed(row + count - 1, work))

    # --- cells ------------------------------------------------------------------------------------------------

    def put(self, row: int, col: int, content: Content, style: Style) -> None:
        """A constant."""
        self.cells.append(Cell(row, col, content, style))

    def fill(self, row: int, col: int, node: Node, rows: int = 1, style: Style = styles.INNER) -> CellRef:
        """A formula, filled down; its first cell."""
        self.fills.append(Fill(row, col, self.plan.at.bind(node, self.title), style, rows=rows))
        return CellRef(row, col, False, True)

    def work(
        self, row: int, work: int, text: str, style: Style = styles.INNER, /, **holes: Node | float | str
    ) -> CellRef:
        """A formula beside the table's columns; its cell, for formulas that are copied together with it."""
        return self.fill(row, self.side + work, formula(text, **holes), style=style)

    # --- searches ---------------------------------------------------------------------------------------------

    def search(
        self,
        row: int,
        count: int,
        first: Mapping[str, Node],
        names: Sequence[str],
        rules: Mapping[str, Node],
        probing: Mapping[str, Node],
    ) -> dict[str, CellRef]:
        """What the rows of a search know, and where they probe; the cells of the first row by name.

        count    of rows, of which the last makes no probe;  first: what the first row knows, as far as it is read
        names    of the columns of what is known;  rules: that of the next row, over this one's
        probing  trees of the two columns that decide where the probe is, by name
        """
        columns = {"sense": SENSE, "limit": LIMIT, "side": SIDE, "probe": PROBE_COL, "value": VALUE_COL}
        columns |= {name: col for col, name in enumerate((*names, *probing), KNOWN)}

        def at(number: int, anchored: bool = True) -> dict[str, CellRef]:
            """Its cells in a row; not anchored, to be filled right: those of what is known and probed."""
            return {name: CellRef(row + number, col, False, anchored or col < KNOWN) for name, col in columns.items()}

        style = styles.decimals(styles.INNER, DECIMALS)
        for name in names:
            if name in first:
                self.fill(row, columns[name], _filled_right(first[name], at(0), at(0, False)), style=style)
            self.fill(row + 1, columns[name], _filled_right(rules[name], at(0), at(0, False)), count - 1, style)
        for name, col in (("near", NEAR), ("sense", SENSE), ("limit", LIMIT), ("side", SIDE)):
            match first.get(name):
                case Number(value):
                    self.put(row, col, value, styles.INNER)
                case None:
                    continue
                case tree:
                    self.fill(row, col, with_symbols(tree, at(0)))
            self.fill(row + 1, col, CellRef(row, col), count - 1)
        next_row = at(1) | {f"{name}_above": cell for name, cell in at(0).items()}
        for name, tree in probing.items():
            self.fill(row, columns[name], with_symbols(first.get(name, tree), at(0)), style=style)
            self.fill(row + 1, columns[name], with_symbols(tree, next_row), count - 1, style)
        self.fill(row, PLACE_COL, with_symbols(PLACE, at(0)), count, style)
        return at(0)

    def heads(self, row: int, first: int, names: Sequence[str]) -> None:
        """What columns of searches hold, over them."""
        for col, name in enumerate(names, first):
            self.put(row, col, self.plan.text(f"extremes.{name}"), styles.HEAD)

    # --- the table's columns ----------------------------------------------------------------------------------

    def needed(self, symbols: Iterable[str]) -> frozenset[str]:
        """The columns that quantities are computed from, and they themselves."""
        found: set[str] = set()
        stack = list(symbols)
        while stack:
            name = stack.pop()
            if name in self._reads and name not in found:
                found.add(name)
                stack += self._reads[name]
        return frozenset(found)

    def lay(self, first: int, count: int, wanted: Collection[str]) -> None:
        """The driver, and the table's columns that quantities need, in so many rows; place and nearest row stand there."""
        plan = self.plan
        place = CellRef(first, PLACE_COL)
        law, style = plan.mechanism.driver.law, styles.decimals(styles.COLUMN, 4)
        driver = driver_at(plan, place) if law is None else by_time(law, Symbol(TIME))
        if law is not None:
            self.fill(first, self.at.spots[TIME].col, time_after(law, formula("place-1", place=place)), count, style)
        self.fills.append(Fill(first, DRIVER_COL, self.at.bind(driver, self.title, first), style, rows=count))
        columns = self.needed(wanted)
        near = CellRef(first, NEAR, False, True)
        for column in self.columns:
            if column.symbol not in columns or column.equation is None:
                continue
            style = styles.numbered(styles.INNER, style_of(plan, column).number_format)
            expression = transform(column.equation.expression, lambda part: self._nearest(part, near))
            value = cell_formula(plan, self.at, column, expression, self.title, first)
            self.fills.append(Fill(first, column.col, value, style, rows=count))

    def _nearest(self, part: Node, near: CellRef) -> Node:
        """What a quantity is in the nearest row, in place of that of the row above."""
        if not isinstance(part, Previous):
            return part
        there = formula("INDEX(column,near)", column=self.plan.at.column(part.name, self.title), near=near)
        return Call("RADIANS", (there,)) if self.plan.at.spots[part.name].degrees else there


def _filled_right(tree: Node, fixed: Mapping[str, Node], moving: Mapping[str, Node]) -> Node:
    """What a row knows of a place, so that filled right it is what the row knows of the value there: what conditions read is
    `fixed`."""
    match tree:
        case Call("IF", (condition, *ways)):
            return Call("IF", (with_symbols(condition, fixed), *(_filled_right(way, fixed, moving) for way in ways)))
    return with_symbols(tree, moving)


def whole(symbol: str) -> Symbol:
    """All rows of a quantity."""
    return Symbol(ALL + symbol)

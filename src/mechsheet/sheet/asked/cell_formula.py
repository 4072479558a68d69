"""The formula of a two-way table's cell, and the blocks of helper cells that it needs beside the table.

Every cell is on its own, but for angles, whose turns the table of positions counts from row to row: they stand in blocks of
their own, each within half a turn of the cell above it, so that no column jumps; and all columns start within half a turn of
the angle in the table of positions.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import MAX_COLUMNS, Call, CellRef, Node, Symbol
from livesheet.workbook import Cell, Fill
from mechsheet.kinematics.angle_branch import WINDOWED, branches_of, reading_taken, taken_near
from mechsheet.sheet import styles
from mechsheet.sheet.asked.expansion import LIMITS, definitions, expand, needed, varying
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.units import ANGLE, Unit

ABOVE, START, FIRST_DRIVER = "{symbol} above", "{symbol} start", "first driver"
"""Symbols of an angle's block of its own: the cell above, the one above the first row; and of the driver's first value."""

MOST_HELPERS = 100_000
"""Cells of helpers beside a table: as many again as a large table of positions has."""

CELL = "a cell of the table"
"""The symbol of what a cell shows."""


@dataclass(frozen=True, slots=True)
class Blocks:
    """Where things stand on a table's sheet.

    first, head  the row of the driver's first value, and the one above it
    driver       the column of the driver's values
    at, count    the first column of the first block of helpers, and the columns of each; an empty one follows
    """

    first: int
    head: int
    driver: int
    at: int
    count: int

    def col(self, index: int) -> int:
        """The first column of the n-th block of helpers."""
        return self.at + index * (self.count + 1)


class CellFormula:
    """The formula as the top-left cell has it; see `expand`.

    title    of the sheet;  value: what the cells show;  heads: dimension -> the cell of its value, as people read it
    closing  for a sweep in every column: groups that must close besides those that the value depends on (where one does not,
             there is #N/A). The angles then have blocks of their own as they are before they go on from row to row
    helpers  (symbol, formula) of each block of helpers; the first are those of `angles`

    A formula is the same wherever its block stands: only the driver's cell, heads and helpers are relative, and they lie as
    the top-left cell of the block of values sees them.
    """

    def __init__(
        self,
        plan: Plan,
        title: str,
        value: str,
        heads: Mapping[str, CellRef],
        blocks: Blocks,
        closing: Collection[str] = (),
    ) -> None:
        self.plan, self.title, self.value, self.heads, self.blocks = plan, title, value, heads, blocks
        self.driver = plan.mechanism.driver
        self.angles: list[str] = []
        rules = definitions(plan.mechanism, plan.equations)
        given = (self.driver.symbol, *heads)
        free = varying(rules, given)
        columns = {equation.symbol for equation in plan.equations.columns}
        rules = {
            symbol: rule
            for symbol, rule in rules.items()
            if (symbol in free or symbol in columns) and symbol not in given
        }
        self.windows = branches_of(plan.mechanism, plan.equations.equations, plan.nominal)
        rules = self._continued(rules)
        rules[CELL] = self._cell(rules, closing)
        used = needed(CELL, rules)
        apart = {symbol: WINDOWED.format(symbol=symbol) for symbol in self.windows}
        self.angles = [symbol for symbol, taken in apart.items() if taken in used]
        own = [apart[symbol] for symbol in self.angles]
        if closing:  # many cells: only short formulas should wait for the cell above
            own += self.angles
        for limit in LIMITS:
            expansion = expand(CELL, rules, self._bound, self.helper, own, limit)
            self.formula, self.helpers = expansion.formula, expansion.helpers
            if self._has_room():
                break

    # --- cells ------------------------------------------------------------------------------------------------

    @property
    def driver_cell(self) -> CellRef:
        """The driver's value in the row of the cell."""
        return CellRef(self.blocks.first, self.blocks.driver, col_abs=True)

    def helper(self, index: int) -> CellRef:
        """A cell of the n-th block of helpers."""
        return CellRef(self.blocks.first, self.blocks.col(index))

    def above(self, index: int) -> CellRef:
        """The cell above that."""
        return CellRef(self.blocks.head, self.blocks.col(index))

    def _has_room(self) -> bool:
        """Whether the helpers fit on the sheet, and are not too many to be computed at each change."""
        blocks = len(self.helpers)
        return blocks * self.blocks.count * self.plan.rows <= MOST_HELPERS and self.blocks.col(blocks) < MAX_COLUMNS

    @property
    def columns_of_raw_angles(self) -> list[int]:
        """Columns of helpers that are angles [rad] as they are found, before each is taken within half a turn of another."""
        raw = [index for index, (symbol, _) in enumerate(self.helpers)
               if index >= len(self.angles) and self.unit(symbol).kind == "angle"]  # fmt: skip
        return [self.blocks.col(index) + across for index in raw for across in range(self.blocks.count)]

    def unit(self, symbol: str) -> Unit:
        """The unit of a quantity in the equations."""
        if symbol == self.driver.symbol:
            return self.driver.unit
        found = [equation.unit for equation in self.plan.equations.all if equation.symbol == symbol]
        return found[0] if found else ANGLE

    # --- rules ------------------------------------------------------------------------------------------------

    def _continued(self, rules: Mapping[str, Node]) -> dict[str, Node]:
        """The rules with those of the angles as their columns have them, which outputs, gears and racks read."""
        reading = {output.symbol for output in self.plan.mechanism.outputs} | {*self.plan.equations.equations.tied}
        found: dict[str, Node] = {}
        for symbol, rule in rules.items():
            found[symbol] = reading_taken(rule, self.windows) if symbol in reading else rule
            if symbol in self.windows:
                found[WINDOWED.format(symbol=symbol)] = taken_near(Symbol(symbol), self._near(symbol))
        return found

    def _near(self, symbol: str) -> Node:
        """What an angle is taken within half a turn of: the cell above, or a line from where the columns start."""
        above, start = Symbol(ABOVE.format(symbol=symbol)), Symbol(START.format(symbol=symbol))
        driven = al.sub(Symbol(self.driver.symbol), Symbol(FIRST_DRIVER))
        line = al.add(start, al.mul(al.number(self.windows[symbol].slope), driven))
        return formula("IF(ISNUMBER(above),above,line)", above=above, line=line)

    def start(self, symbol: str) -> Node:
        """The angle [rad] near which all columns start: that of the table of positions in the first row that exists, carried
        back to the first row; with no such row what it is with the dimensions as described."""
        plan, window = self.plan, self.windows[symbol]
        row = formula("MATCH(ok,said,0)", ok=plan.ok, said=plan.places.status.whole(self.title))
        angle = self._there(symbol, row)
        if window.slope:
            there = self._there(self.driver.symbol, row)
            way = al.sub(there, self._bound(FIRST_DRIVER))
            angle = al.sub(angle, al.mul(al.number(window.slope), way))
        described = round(window.centre + window.slope * plan.driver[0], 6)
        return formula("IFERROR(angle,described)", angle=angle, described=described)

    def _there(self, symbol: str, row: Node) -> Node:
        """An angle [rad] in a row of the table of positions."""
        value = formula("INDEX(column,row)", column=self.plan.at.column(symbol, self.title), row=row)
        return Call("RADIANS", (value,)) if self.plan.at.spots[symbol].degrees else value

    def _cell(self, rules: Mapping[str, Node], closing: Collection[str]) -> Node:
        """The value as people read it."""
        symbol = WINDOWED.format(symbol=self.value)
        value: Node = Symbol(symbol if symbol in rules else self.value)
        value = Call("DEGREES", (value,)) if self.plan.at.spots[self.value].degrees else value
        others = [Symbol(name) for name in closing if name not in needed(self.value, rules)]
        if others:
            return formula("IF(ISNUMBER(all),value,NA())", all=al.total(others), value=value)
        return value

    def _bound(self, symbol: str) -> Node:
        """The cell of a leaf as the top-left cell of a block reads it."""
        plan = self.plan
        for index, angle in enumerate(self.angles):
            if symbol == ABOVE.format(symbol=angle):
                return self.above(index)
            if symbol == START.format(symbol=angle):
                return CellRef(self.blocks.head, self.blocks.col(index), row_abs=True)
        if symbol in (self.driver.symbol, FIRST_DRIVER):
            cell = CellRef(self.blocks.first, self.blocks.driver, symbol == FIRST_DRIVER, True)
            return Call("RADIANS", (cell,)) if self.driver.unit.in_degrees else cell
        if symbol in self.heads:
            degrees = next(dim.unit.in_degrees for dim in plan.mechanism.dimensions if dim.symbol == symbol)
            return Call("RADIANS", (self.heads[symbol],)) if degrees else self.heads[symbol]
        return plan.at.reference(symbol, self.title, None)


def helper_blocks(found: CellFormula, corner: int) -> tuple[list[Cell], list[Fill]]:
    """The blocks of helpers with their headings, `corner` being the row of these."""
    cells: list[Cell] = []
    fills: list[Fill] = []
    plan, blocks = found.plan, found.blocks
    for index, (symbol, helper) in enumerate(found.helpers):
        col = blocks.col(index)
        bare = symbol.removesuffix(WINDOWED.format(symbol=""))
        unit = plan.mechanism.shown(found.unit(bare).internal).text
        cells.append(Cell(corner, col, rich(bare, f" [{unit}]" if unit else ""), styles.SECTION))
        cells += [Cell(corner, col + further, None, styles.SECTION) for further in range(1, blocks.count)]
        inner = styles.decimals(styles.INNER, decimals_of_kind(plan, found.unit(symbol).kind))
        if index < len(found.angles):
            cells.append(Cell(corner + 1, col, plan.text("table.near"), styles.NOTE))
            fills.append(Fill(blocks.head, col, found.start(found.angles[index]), inner, cols=blocks.count))
        fills.append(Fill(blocks.first, col, helper, inner, rows=plan.rows, cols=blocks.count))
    return cells, fills

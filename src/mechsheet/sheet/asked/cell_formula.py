"""The formula of a two-way table's cell, and the blocks of helper cells that it needs beside the table.

A table has no columns for intermediate symbols, so each is replaced by its equation, over and over, until only cells are
left. An equation that reads the row above (the turns that an angle has gone through) is taken as in the first row of a
sweep: every cell of a table is a sweep of its own. Where a formula would grow longer than wanted, the symbols that make it
long get cells of their own: the helpers.

Every cell is on its own, but for angles, whose turns the table of positions counts from row to row: they stand in blocks of
their own, each within half a turn of the cell above it, so that no column jumps; and all columns start within half a turn of
the angle in the table of positions.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import (
    MAX_COLUMNS,
    Binary,
    Call,
    CellRef,
    Node,
    Number,
    Symbol,
    children,
    symbols,
    transform,
    walk,
)
from livesheet.formula.printer import extra_characters, longest_spelling, print_formula
from livesheet.workbook import Cell, Fill
from mechsheet.kinematics.angle_branch import WINDOWED, branches_of, reading_taken, taken_near
from mechsheet.kinematics.dimensions import dimension_order
from mechsheet.model import Mechanism
from mechsheet.sheet import styles
from mechsheet.sheet.columns.lowering import Assignments
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.shown import rich
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.units import ANGLE, Unit

LIMITS = (250, 1_000, 7_500)
"""Characters of one formula in the language where it has most: what can be read, or more where there is no room for so many
helpers. Excel takes 8,192 of the text as its user reads it."""

DEEPEST = 60
"""Levels of one formula, below the 64 that a spreadsheet takes."""


SHORT = 30
"""A formula of so many characters is no shorter as a reference to a helper."""

MANY = 4
"""Arguments from which on a largest or smallest of many has two halves."""


@dataclass(frozen=True, slots=True)
class Expansion:
    """Bound formulas, as the top-left cell of each block has them.

    formula  of the quantity asked for
    helpers  (symbol, formula) of each block of helper cells, in the order in which they are computed
    """

    formula: Node
    helpers: tuple[tuple[str, Node], ...]


def definitions(mechanism: Mechanism, equations: Assignments) -> dict[str, Node]:
    """What every symbol that is not given equals in the first row of a sweep, in order of solution."""
    given = {dim.symbol: dim.value for dim in mechanism.dimensions if not isinstance(dim.value, float)}
    found = {symbol: given[symbol] for symbol in dimension_order(mechanism) if symbol in given}
    for equation in equations.all:
        found[equation.symbol] = equation.expression if equation.first is None else equation.first
    return found


def varying(rules: Mapping[str, Node], free: Iterable[str]) -> set[str]:
    """The symbols whose value depends on those in `free`, and these themselves."""
    found = set(free)
    for symbol, rule in rules.items():
        if not found.isdisjoint(symbols(rule)):
            found.add(symbol)
    return found


def expand(
    wanted: str,
    rules: Mapping[str, Node],
    bound: Callable[[str], Node],
    helper: Callable[[int], Node],
    apart: Sequence[str] = (),
    limit: int = LIMITS[-1],
) -> Expansion:
    """The formula of the symbol `wanted`.

    rules   what a symbol equals, in order of solution; a symbol without a rule is a leaf
    bound   the cell (or name) of a leaf
    helper  the cell of the n-th block of helpers, as the top-left cell of any block reads it
    apart   symbols that get the first blocks of helpers, in this order, however short they are
    limit   characters of a formula
    """
    work = _Work(rules, bound, helper, apart, limit)
    used = needed(wanted, rules)
    for symbol, rule in rules.items():
        if symbol in used:
            work.expand(symbol, rule)
    return Expansion(work.form(wanted), tuple(work.helpers))


def needed(wanted: str, rules: Mapping[str, Node]) -> set[str]:
    """The symbols that a quantity depends on by the rules, and itself."""
    stack, found = [wanted], {wanted}
    while stack:
        rule = rules.get(stack.pop())
        fresh = [] if rule is None else [name for name in symbols(rule) if name not in found]
        found.update(fresh)
        stack += fresh
    return found


class _Work:
    """The forms found so far, with their length and depth."""

    def __init__(
        self,
        rules: Mapping[str, Node],
        bound: Callable[[str], Node],
        helper: Callable[[int], Node],
        apart: Sequence[str],
        limit: int,
    ) -> None:
        self.limit = limit
        self.rules = rules
        self.bound = bound
        self.helper = helper
        self.forms: dict[str, Node] = {}
        self.lengths: dict[str, int] = {}
        self.depths: dict[str, int] = {}
        self.apart = {symbol: index for index, symbol in enumerate(apart)}
        self.helpers: list[tuple[str, Node]] = [(symbol, Symbol(symbol)) for symbol in apart]

    def form(self, symbol: str) -> Node:
        """The formula of a symbol; a leaf's is its cell."""
        if symbol not in self.forms:
            self._set(symbol, self.bound(symbol))
        return self.forms[symbol]

    def _set(self, symbol: str, form: Node) -> None:
        self.forms[symbol] = form
        self.lengths[symbol] = longest_spelling(form)
        self.depths[symbol] = depth(form)

    def expand(self, symbol: str, rule: Node) -> None:
        """Write a symbol out; what makes it too long becomes a block of helpers first."""
        uses = Counter(part.name for part in walk(rule) if isinstance(part, Symbol))
        for name in uses:
            self.form(name)
        plain = len(print_formula(rule, "text")) + extra_characters(rule)
        while self._too_long(rule, uses, plain):
            movable = [name for name in uses if name in self.rules and self.lengths[name] > SHORT]
            if not movable:
                rule = self._in_halves(symbol, rule)
                break
            self._move_out(max(movable, key=lambda name: uses[name] * self.lengths[name]))
        self._set(symbol, substituted(rule, self.forms))
        if symbol in self.apart:
            index = self.apart[symbol]
            self.helpers[index] = (symbol, self.forms[symbol])
            self._set(symbol, self.helper(index))

    def _too_long(self, rule: Node, uses: Counter[str], plain: int) -> bool:
        length = plain + sum(count * (self.lengths[name] + 2 - len(name)) for name, count in uses.items())
        return length > self.limit or depth(rule) + max((self.depths[name] for name in uses), default=0) > DEEPEST

    def _in_halves(self, symbol: str, rule: Node) -> Node:
        """The rule with the first half of what it takes the largest or smallest of in helpers of its own."""
        many = [part for part in walk(rule) if isinstance(part, Call) and part.name in ("MAX", "MIN")]
        longest = max(many, key=lambda call: len(call.args), default=None)
        if longest is None or len(longest.args) < MANY:
            return rule
        middle = len(longest.args) // 2
        half = Symbol(f"{symbol} half")
        self._set(half.name, self.helper(len(self.helpers)))
        self.helpers.append((symbol, substituted(Call(longest.name, longest.args[:middle]), self.forms)))
        shorter = Call(longest.name, (half, *longest.args[middle:]))
        return transform(rule, lambda part: shorter if part == longest else part)

    def _move_out(self, symbol: str) -> None:
        cell = self.helper(len(self.helpers))
        self.helpers.append((symbol, self.forms[symbol]))
        self._set(symbol, cell)


def substituted(rule: Node, forms: Mapping[str, Node]) -> Node:
    """The rule with its symbols replaced and tidied: what a form of 0 or 1 makes needless is left out."""

    def change(part: Node) -> Node:
        match part:
            case Symbol(name):
                return forms[name]
            case Binary("^", Call("SQRT", (square,)), Number(2.0)):
                return square
            case Binary("/", _, _):
                return part
        return al.tidied(part)

    return transform(rule, change)


def depth(node: Node) -> int:
    """Levels of a tree."""
    deepest, stack = 0, [(node, 1)]
    while stack:
        part, level = stack.pop()
        deepest = max(deepest, level)
        stack += [(child, level + 1) for child in children(part)]
    return deepest


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

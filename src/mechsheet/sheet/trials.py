"""The equations once more, at values of the driver that no row of the table of positions has.

A trial is a row: a value of the driver, and all that follows from it up to what is asked for. Trials stand in stages; the
driver's values of a stage are formulas over what the stages before it found (a bracket, a vertex). So roots and extremes
between rows are found by cells alone, and move when a dimension does.

A trial names a row of the table near it. Angles that the table counts in turns are taken within half a turn of that row's.
Where a group is about to stop closing, its area (or leg) is 0 within `NEAR` of the largest length: there rounding errors
grow by the square root, and the limit itself is what is looked for.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef, Text, shifted, symbols
from mechsheet.sheet import styles
from mechsheet.sheet.expansion import needed, substituted
from mechsheet.sheet.gaps import gap_of
from mechsheet.sheet.lowering import Assignment
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.workbook import Cell, Content, Fill, Style

LABEL, COUNT, NEIGHBOUR, AT = range(4)
"""First columns: what the trial is for, its number, the number (from 1) of a row of the table near it, the driver's value
as people read it."""

NO_LENGTH = 1e-9
"""Parts of the largest length: a shorter vector has no direction here, that of the row near the trial stands for it."""

NEAR = 1e-6
"""Parts of the largest length: gaps smaller than this are dead centres here."""

WORK = ("trial.from", "trial.to", "trial.next")
"""Heads of the last columns: the bracket of a root, and where to look next."""


@dataclass(frozen=True, slots=True)
class Corner:
    """Where the block stands: its sheet, the rows of its headings, its first row and column."""

    sheet: str
    section: int
    head: int
    first: int
    col: int


class Trials:
    """The block while it is being laid out."""

    def __init__(self, plan: Plan, corner: Corner, wanted: Iterable[str]) -> None:
        self.plan = plan
        self.corner = corner
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self.next_row = corner.first
        self.radians = plan.mechanism.driver.unit.in_degrees
        self.groups = [group for group in plan.equations.groups if group.sides]
        self.rules = _rules(plan, wanted)
        self.forms: dict[str, Node] = {}
        self.columns: list[tuple[Content, Node]] = []
        self._columns()
        self.work = corner.col + AT + 1 + len(self.columns)
        self._headings()

    @property
    def width(self) -> int:
        """Columns taken."""
        return self.work + len(WORK) - self.corner.col

    # --- columns ----------------------------------------------------------------------------------------------

    def _columns(self) -> None:
        """The formulas of a row, written for the first one."""
        plan, sheet, row = self.plan, self.corner.sheet, self.corner.first
        driver = plan.mechanism.driver
        at = CellRef(row, self.corner.col + AT, col_abs=True)
        self.forms[driver.symbol] = at
        if self.radians:
            self.forms[driver.symbol] = self._add(rich(driver.symbol, " [rad]"), Call("RADIANS", (at,)))
        tolerance = plan.at.reference(plan.equations.tolerance, sheet, None)
        closed = {group.closes: group for group in plan.equations.groups if group.sides}
        counted = {eq.symbol: eq.expression for eq in plan.equations.columns if self._counts_turns(eq)}
        raws = {name for rule in counted.values() for name in symbols(rule)}
        gaps: list[Node] = []
        for symbol, rule in self.rules.items():
            if symbol in raws:
                continue
            form = (
                self._within_half_turn(symbol, symbols(counted[symbol])[0]) if symbol in counted else self._bound(rule)
            )
            if al.value_of(form) is not None or isinstance(form, CellRef):
                self.forms[symbol] = form  # another column under a second name
                continue
            if symbol in closed:
                group = closed[symbol]
                gap = Call("IFERROR", (self._bound(gap_of(group)), Text("")))
                gaps.append(self._add(plan.text("trial.gap", number=group.number), gap))
                if not al.is_zero(group.sides[-1]):
                    form = _flat_at_limit(gaps[-1], tolerance, form)
            self.forms[symbol] = self._add(rich(symbol), form)
        if gaps:
            self.f = self._add("f", al.add(al.smallest(gaps), al.div(tolerance, al.TWO))).col
        closing = dict.fromkeys(group.closes for group in plan.equations.groups)
        tests = [Call("ISNUMBER", (self.forms[name],)) for name in closing if name in self.forms]
        if tests:
            self.exists = self._add(plan.text("head.exists"), Call("IF", (al.all_of(tests), al.ONE, al.ZERO))).col

    def _counts_turns(self, equation: Assignment) -> bool:
        """True for an angle that is a direction plus the turns gone by, which a column of its own counts."""
        turns = {eq.symbol for eq in self.plan.equations.columns if eq.counts_turns}
        return equation.symbol in self.rules and not turns.isdisjoint(symbols(equation.expression))

    def _within_half_turn(self, symbol: str, raw: str) -> Node:
        """The direction `raw` within half a turn of what the table has for `symbol` in the row near the trial."""
        row = CellRef(self.corner.first, self.corner.col + NEIGHBOUR, col_abs=True)
        there = self.plan.at.area(self.plan.at.spots[symbol], self.corner.sheet)
        near = Call("IFERROR", (Call("INDEX", (there, row)), al.ZERO))
        direction = self._bound(self.rules[raw])
        turned = Call("MOD", (al.add(al.sub(direction, near), al.PI), al.mul(al.TWO, al.PI)))
        found = al.sub(al.add(near, turned), al.PI)
        if not (isinstance(direction, Call) and direction.name == "ATAN2"):
            return found
        tolerance = self.plan.at.reference(self.plan.equations.tolerance, self.corner.sheet, None)
        length = al.largest([Call("ABS", (part,)) for part in direction.args])
        nothing = Binary("<", length, al.mul(Number(NO_LENGTH / 1e-12), tolerance))  # pins that coincide
        return Call("IF", (nothing, near, found))

    def _bound(self, node: Node) -> Node:
        """An expression over what is known so far; symbols without a column are dimensions and constants."""
        for name in symbols(node):
            if name not in self.forms:
                self.forms[name] = self.plan.at.reference(name, self.corner.sheet, None)
        return substituted(node, self.forms)

    def _add(self, head: Content, formula: Node) -> CellRef:
        self.columns.append((head, formula))
        return self._cell(len(self.columns) - 1)

    def _cell(self, index: int) -> CellRef:
        return CellRef(self.corner.first, self.corner.col + AT + 1 + index, col_abs=True)

    def _headings(self) -> None:
        plan, corner = self.plan, self.corner
        self._put(corner.section, corner.col, plan.text("trial.title"), styles.SECTION)
        for col in range(corner.col + 1, corner.col + self.width):
            self._put(corner.section, col, None, styles.SECTION)
        driver = plan.mechanism.driver
        unit = driver.unit.text
        heads: list[Content] = ["", plan.text("head.number"), plan.text("extremes.row")]
        heads += [rich(driver.symbol, f" [{unit}]" if unit else "")]
        heads += [head for head, _ in self.columns]
        heads += [plan.text(key) for key in WORK]
        for index, head in enumerate(heads):
            self._put(corner.head, corner.col + index, head, styles.HEAD)

    def _put(self, row: int, col: int, content: Content, style: Style) -> None:
        self.cells.append(Cell(row, col, content, style))

    # --- rows -------------------------------------------------------------------------------------------------

    def stage(self, groups: list[tuple[str, int]]) -> list[int]:
        """A new stage of trials: (what for, how many) of each; their first rows. An empty row follows.

        The empty row keeps the stages apart: a stage is one block of formulas, which later ones read.
        """
        start, starts = self.next_row, []
        for label, count in groups:
            starts.append(self.next_row)
            self._put(self.next_row, self.corner.col + LABEL, label, styles.LABEL)
            for index in range(count):
                self._put(
                    self.next_row + index, self.corner.col + COUNT, float(index), styles.decimals(styles.INNER, 0)
                )
            self.next_row += count
        rows = self.next_row - start
        for index, (_, formula) in enumerate(self.columns):
            col = self.corner.col + AT + 1 + index
            moved = shifted(formula, start - self.corner.first)
            self.fills.append(Fill(start, col, moved, styles.INNER, rows=rows))
        self.next_row += 1
        return starts

    def drive(self, row: int, count: int, formula: Node, near: Node) -> None:
        """The driver's values of `count` trials from `row` on: a formula for the first of them, filled down.

        near  the number (from 1) of a row of the table near them
        """
        self.fills.append(Fill(row, self.corner.col + AT, formula, styles.INNER, rows=count))
        style = styles.decimals(styles.INNER, 0)
        self.fills.append(Fill(row, self.corner.col + NEIGHBOUR, near, style, rows=count))

    def note(self, row: int, work: int, formula: Node) -> CellRef:
        """A formula in one of the last columns; its cell."""
        self.fills.append(Fill(row, self.work + work, formula, styles.INNER))
        return CellRef(row, self.work + work, True, True)

    def count(self, row: int) -> CellRef:
        """The number of the trial in a row, to be filled down."""
        return CellRef(row, self.corner.col + COUNT, col_abs=True)

    def at(self, row: int) -> CellRef:
        """The driver's value in a row."""
        return CellRef(row, self.corner.col + AT, True, True)

    def value(self, symbol: str, row: int, moving: bool = False) -> Node:
        """What a symbol is in a row; `moving` when the formula is to be filled down from there."""
        form = self.forms[symbol]
        if isinstance(form, CellRef) and not form.row_abs:
            return CellRef(row, form.col, not moving, True)
        return form

    def cell(self, col: int, row: int) -> CellRef:
        """The cell of a column (`f`, `exists`) in a row."""
        return CellRef(row, col, True, True)

    def column(self, col: int, row: int, count: int) -> RangeRef:
        """The cells of a column in `count` rows."""
        return RangeRef(self.cell(col, row), self.cell(col, row + count - 1))


def _flat_at_limit(gap: Node, tolerance: Node, form: Node) -> Node:
    """What a group closes by: 0 within `NEAR` of its limit."""
    near = al.mul(Number(NEAR / 1e-12), tolerance)
    flat = Call("IF", (Binary("<", gap, al.neg(tolerance)), Call("NA"), al.ZERO))
    return Call("IF", (Binary("<", Call("ABS", (gap,)), near), flat, form))


def _rules(plan: Plan, wanted: Iterable[str]) -> dict[str, Node]:
    """The columns that the wanted symbols depend on, as in the first row of a sweep, in order of solution."""
    rules = {eq.symbol: eq.expression if eq.first is None else eq.first for eq in plan.equations.columns}
    used: set[str] = set()
    for symbol in wanted:
        used |= needed(symbol, rules)
    return {symbol: rule for symbol, rule in rules.items() if symbol in used}

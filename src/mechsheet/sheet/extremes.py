"""Extremes of columns between rows: a parabola through the extreme row and its two neighbours, then trials.

    k        (first) row whose value y, or vertex, is the extreme one;  a, b: the values before and after it
    offset   (a - b) / (2 (a - 2 y + b))   steps from row k to the vertex, at most one
    value    y - (a - b)^2 / (8 (a - 2 y + b))

Over a whole turn the last row comes before the first. Where a neighbour does not exist (the end of a sweep, a limit
position), where row k is no peak (a link that turns on and on), or where the driver's values are listed one by one, the
extreme is that of the rows. The error of the value is of the fourth order in the step.

From there `refinement` goes on by trials. At a limit between rows the quantity is taken at the limit itself.
Of mechanisms with very many quantities only the first are refined (`aside.MOST_CELLS`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from typing import Literal

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Boolean, Call, CellRef, Node, Number, RangeRef, Text
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.limits import Found
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.positions import blank_unit, digits_kept
from mechsheet.sheet.refinement import Refinement, Tried, as_shown
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.trials import Trials
from mechsheet.sheet.workbook import Cell, Fill, Style

ROW, BEFORE, AFTER, VALUE, AT = range(5)
"""Cells of one extreme, below each other."""

HERE, BEND, PEAK, ROWS_VALUE, ROWS_AT, TRIAL_VALUE, TRIAL_AT, LIMITS = range(8)
"""Further cells of one extreme, in the part of the sheet that scrolls: what rows say, what trials say, then each limit."""

Sweep = Literal["closed", "open", "part", "list"]
"""A whole turn with the last row equal to the first; one that stops a step before; less than a turn; listed values."""


def sweep_of(plan: Plan) -> Sweep:
    """What the description's sweep of the driver covers."""
    driver = plan.mechanism.driver
    if driver.values or plan.rows < 4:
        return "list"
    if not driver.link or driver.unit.kind != "angle":
        return "part"
    turns = (plan.driver[-1] - plan.driver[0]) / math.tau
    step = (plan.driver[1] - plan.driver[0]) / math.tau
    for kind, covered in (("closed", turns), ("open", turns + step)):
        if round(covered) != 0 and abs(covered - round(covered)) < 1e-9:
            return "closed" if kind == "closed" else "open"
    return "part"


class Extremes:
    """The block: a smallest and a largest value of each symbol. `row` is that of its title, `more` the first that scrolls.

    Writes down where `#max <symbol>`, `#max at <symbol>` and the same for min stand.
    """

    def __init__(
        self, plan: Plan, trials: Trials | None, sheet: str, row: int, more: int, col: int, limits: Sequence[Found]
    ) -> None:
        self.plan = plan
        self.trials = trials
        self.sheet = sheet
        self.row = row
        self.more = more
        self.col = col
        self.limits = limits
        self.sweep = sweep_of(plan)
        self.vertices: dict[str, RangeRef] = {}
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []

    def find_vertices(self, symbols: Sequence[str], row: int, col: int) -> None:
        """A column for each symbol, from `col` on, row by row: the vertex of the parabola through a row and its neighbours
        where that lies within a step, else the value itself. Its extreme shows which peak is the highest, not which row."""
        plan, rows = self.plan, self.plan.rows
        for index, symbol in enumerate(symbols):
            here = col + index
            unit = blank_unit(plan, symbol)
            head = rich(symbol, f" [{unit}] " + plan.text("extremes.vertex"))
            self.cells.append(Cell(self.row + 1, here, head, styles.HEAD))
            style = styles.decimals(styles.INNER, 6)
            column = plan.at.area(plan.at.shown[f"#rounded {symbol}"], self.sheet)
            y = CellRef(column.start.row, column.start.col, sheet=column.start.sheet)
            digits = Number(float(max(0, digits_kept(plan, symbol) - 2)))
            ends = _ends(plan, column, self.sweep, turn_of(plan, symbol))
            first, last = y, replace(y, row=y.row + rows - 1)
            nothing: Node = Text("")
            for cell, at in ((first, 0), (last, rows - 1)) if rows > 1 else ((first, 0),):
                before = ends[0](cell) if at == 0 else replace(cell, row=cell.row - 1)
                after = ends[1](cell) if at == rows - 1 else replace(cell, row=cell.row + 1)
                node = cell if nothing in (before, after) else _row_vertex(before, cell, after, digits)
                self.fills.append(Fill(row + at, here, node, style))
            if rows > 2:
                middle = replace(y, row=y.row + 1)
                node = middle
                if self.sweep != "list":
                    node = _row_vertex(y, middle, replace(y, row=y.row + 2), digits)
                self.fills.append(Fill(row + 1, here, node, style, rows=rows - 2))
            self.vertices[symbol] = RangeRef(CellRef(row, here, True, True), CellRef(row + rows - 1, here, True, True))

    def write(self, symbols: Sequence[str], tried: Mapping[tuple[str, str], Tried]) -> None:
        """All of it. `tried`: the trials of those extremes, by symbol and "min" or "max", that are refined."""
        plan, col = self.plan, self.col
        self._head(self.row, plan.text("extremes.title"), styles.SECTION)
        self._head(self.row + 1, None, styles.HEAD)
        for index in range(2 * len(symbols)):
            self.cells.append(Cell(self.row, col + 1 + index, None, styles.SECTION))
        for index, name in enumerate(("row", "before", "after", "value", "at")):
            self._head(self.row + 2 + index, plan.text(f"extremes.{name}"), styles.LABEL)
        names = ["here", "bend", "peak", "rows.value", "rows.at", *(["trial.value", "trial.at"] if tried else [])]
        for index, name in enumerate(names):
            self._head(self.more + index, plan.text(f"extremes.{name}"), styles.LABEL)
        for index in range(len(self.limits)):
            self._head(self.more + LIMITS + index, plan.text("extremes.limit", number=index + 1), styles.LABEL)
        for index, symbol in enumerate(symbols):
            for side, take in enumerate(("min", "max")):
                here = col + 1 + 2 * index + side
                head = rich(symbol, f" [{blank_unit(plan, symbol)}] {plan.text(f'extremes.{take}')}")
                self.cells.append(Cell(self.row + 1, here, head, styles.HEAD))
                self._extreme(symbol, take, here, tried.get((symbol, take)))

    def _head(self, row: int, content: str | None, style: Style) -> None:
        self.cells.append(Cell(row, self.col, content, style))

    def _formula(self, row: int, col: int, node: Node, places: int = 6) -> CellRef:
        self.fills.append(Fill(row, col, node, styles.decimals(styles.RESULT, places)))
        return CellRef(row, col, True, True)

    def _extreme(self, symbol: str, take: str, col: int, tried: Tried | None) -> None:
        plan = self.plan
        column = plan.at.area(plan.at.shown[f"#rounded {symbol}"], self.sheet)
        drivers = plan.at.column(plan.mechanism.driver.symbol, self.sheet)
        among = self.vertices[symbol]
        k = self._formula(self.row + 2 + ROW, col, Call("MATCH", (Call(take.upper(), (among,)), among, al.ZERO)), 0)
        y = self._formula(self.more + HERE, col, Call("INDEX", (column, k)))
        neighbours = _neighbours(plan, column, k, y, self.sweep, turn_of(plan, symbol))
        a, b = (
            self._formula(self.row + 2 + line, col, node)
            for line, node in zip((BEFORE, AFTER), neighbours, strict=True)
        )
        known = Binary("=", Call("COUNT", (a, b)), al.TWO)
        difference = al.add(al.sub(a, al.mul(al.TWO, y)), b)
        bend = self._formula(self.more + BEND, col, Call("IF", (known, difference, Call("NA"))))
        peak = self._formula(self.more + PEAK, col, _is_vertex(a, y, b, bend))
        rows_value = self._formula(self.more + ROWS_VALUE, col, Call("IF", (peak, _vertex(a, y, b, bend), y)))
        place: Node = Call("INDEX", (drivers, k))
        if self.sweep != "list":
            step = plan.at.reading_shown("#step", self.sheet, None)
            offset = al.div(al.mul(step, al.sub(a, b)), al.mul(al.TWO, bend))
            place = al.add(place, Call("IF", (peak, offset, al.ZERO)))
        rows_at = self._formula(self.more + ROWS_AT, col, place)
        best: Node = rows_value
        best_at: Node = rows_at
        if tried is not None and self.trials is not None:
            value, there = Refinement(plan, self.sheet, self.trials, symbol, k).run(tried, peak, rows_at)
            trial_value = self._formula(self.more + TRIAL_VALUE, col, value)
            trial_at = self._formula(self.more + TRIAL_AT, col, there)
            most: Node = Call(take.upper(), (column,))
            beyond = Binary(">=" if take == "max" else "<=", trial_value, al.sub(most, _signed(take, _rounding(most))))
            good = Call("IF", (Call("ISNUMBER", (trial_value,)), beyond, Boolean(False)))
            best, best_at = Call("IF", (good, trial_value, rows_value)), Call("IF", (good, trial_at, rows_at))
        if self.limits and self.trials is not None:
            cells = [self._at_limit(symbol, take, col, index) for index in range(len(self.limits))]
            ends = RangeRef(cells[0], cells[-1])
            places = RangeRef(self.limits[0].at, self.limits[-1].at)
            most = Call(take.upper(), (ends,))
            beyond = Binary(">" if take == "max" else "<", most, best)
            outside = Call("IF", (Binary(">", Call("COUNT", (ends,)), al.ZERO), beyond, Boolean(False)))
            best_at = Call("IF", (outside, _place_of(places, most, ends), best_at))
            best = Call("IF", (outside, most, best))
        self._formula(self.row + 2 + VALUE, col, best)
        self._formula(self.row + 2 + AT, col, best_at)
        for name, part in ((f"#{take} {symbol}", VALUE), (f"#{take} at {symbol}", AT)):
            plan.at.spots[name] = plan.at.shown[name] = Spot(self.sheet, self.row + 2 + part, col)

    def _at_limit(self, symbol: str, take: str, col: int, index: int) -> CellRef:
        """The quantity at a limit, rounded lest rounding errors decide between equal ends; the column of the largest value
        repeats that of the smallest."""
        row = self.more + LIMITS + index
        if take == "max":
            return self._formula(row, col, CellRef(row, col - 1))
        plan, limit = self.plan, self.limits[index]
        if self.trials is None or symbol not in self.trials.forms:
            return self._formula(row, col, Text(""))
        value = as_shown(plan, symbol, self.trials.value(symbol, limit.trial))
        rounded = Call("ROUND", (value, Number(float(digits_kept(plan, symbol)))))
        return self._formula(row, col, Call("IFERROR", (rounded, Text(""))))


def turn_of(plan: Plan, symbol: str) -> Node | None:
    """A turn in the unit in which an angle is read; None for what is no angle."""
    if plan.equations.of(symbol).unit.kind != "angle":
        return None
    return Number(360.0) if blank_unit(plan, symbol) == "°" else al.mul(al.TWO, al.PI)


def _signed(take: str, node: Node) -> Node:
    return node if take == "max" else al.neg(node)


def _place_of(places: RangeRef, value: Node, among: RangeRef) -> Node:
    """Of cells beside each other the one that stands where `value` stands among others below each other."""
    return Call("INDEX", (places, al.ONE, Call("MATCH", (value, among, al.ZERO))))


def _is_vertex(before: Node, here: Node, after: Node, bend: Node) -> Node:
    """TRUE where both neighbours exist, the three are not in line, and their parabola's vertex lies within a step."""
    bent = Binary(">", Call("ABS", (bend,)), al.mul(al.number(4), _rounding(here)))
    within = Binary("<=", Call("ABS", (al.sub(before, after),)), al.mul(al.TWO, Call("ABS", (bend,))))
    return Call("IF", (Call("ISNUMBER", (bend,)), Call("AND", (bent, within)), Boolean(False)))


def _vertex(before: Node, here: Node, after: Node, bend: Node) -> Node:
    """The value at the vertex."""
    return al.sub(here, al.div(al.square(al.sub(before, after)), al.mul(al.number(8), bend)))


def _row_vertex(before: Node, here: Node, after: Node, digits: Node) -> Node:
    """The vertex, rounded lest rounding errors decide between equal peaks; or the value itself."""
    bend = al.add(al.sub(before, al.mul(al.TWO, here)), after)
    known = Binary("=", Call("COUNT", (before, here, after)), al.number(3))
    bent = Binary(">", Call("ABS", (bend,)), al.mul(al.number(4), _rounding(here)))
    within = Binary("<=", Call("ABS", (al.sub(before, after),)), al.mul(al.TWO, Call("ABS", (bend,))))
    rounded = Call("ROUND", (_vertex(before, here, after, bend), digits))
    return Call("IF", (known, Call("IF", (Call("AND", (bent, within)), rounded, here)), here))


def _rounding(value: Node) -> Node:
    """Values this near to each other count as equal."""
    return al.add(al.mul(Number(1e-9), Call("ABS", (value,))), Number(1e-12))


def _ends(
    plan: Plan, column: RangeRef, sweep: Sweep, turn: Node | None
) -> tuple[Callable[[Node], Node], Callable[[Node], Node]]:
    """What stands before the first row and after the last, as seen from that row's value y: an empty text where there is
    nothing. Across the end of a turn, an angle is brought within half a `turn` of y."""
    rows = plan.rows

    def across(row: int) -> Callable[[Node], Node]:
        value = Call("INDEX", (column, Number(float(row))))

        def seen(y: Node) -> Node:
            if turn is None:
                return value
            half = al.div(turn, al.TWO)
            return al.sub(al.add(y, Call("MOD", (al.add(al.sub(value, y), half), turn))), half)

        return seen

    def nothing(_: Node) -> Node:
        return Text("")

    if sweep == "closed":
        return across(rows - 1), across(2)
    if sweep == "open":
        return across(rows), across(1)
    return nothing, nothing


def _neighbours(plan: Plan, column: RangeRef, k: Node, y: Node, sweep: Sweep, turn: Node | None) -> tuple[Node, Node]:
    """The values before and after row k; an empty text where there is none."""
    if sweep == "list":
        return Text(""), Text("")
    first, last = _ends(plan, column, sweep, turn)
    before = Call("INDEX", (column, Binary("-", k, al.ONE)))
    after = Call("INDEX", (column, Binary("+", k, al.ONE)))
    return (
        Call("IF", (Binary("=", k, al.ONE), first(y), before)),
        Call("IF", (Binary("=", k, Number(float(plan.rows))), last(y), after)),
    )

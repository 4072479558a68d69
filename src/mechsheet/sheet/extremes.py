"""Extremes of columns between rows: a parabola through the extreme row and its two neighbours.

    k        (first) row of the extreme value y;  a, b: the values before and after it
    offset   (a - b) / (2 (a - 2 y + b))   steps from row k to the vertex, at most half a step
    value    y - (a - b)^2 / (8 (a - 2 y + b))

Over a whole turn the last row comes before the first. Where a neighbour does not exist (the end of a sweep, a limit
position), where row k is no peak (a link that turns on and on), or where the driver's values are listed one by one, the
extreme is that of the rows. The error of the value is of the fourth order in the step.
"""

from __future__ import annotations

import math
from typing import Literal

from mechsheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef, Text
from mechsheet.kinematics import algebra as al
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.findings import findings
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.positions import blank_unit
from mechsheet.sheet.symbols import rich
from mechsheet.sheet.workbook import Cell, Fill

ROW, BEFORE, AFTER, VALUE, AT = range(5)
"""Cells of one extreme, below each other."""

Sweep = Literal["closed", "open", "part", "list"]
"""A whole turn with the last row equal to the first; one that stops a step before; less than a turn; listed values."""


def sweep_of(plan: Plan) -> Sweep:
    """What the description's sweep of the driver covers."""
    driver = plan.mechanism.driver
    if driver.values or plan.rows < 4:
        return "list"
    if not driver.link or driver.unit not in ("deg", "rad"):
        return "part"
    turns = (plan.driver[-1] - plan.driver[0]) / math.tau
    step = (plan.driver[1] - plan.driver[0]) / math.tau
    for kind, covered in (("closed", turns), ("open", turns + step)):
        if round(covered) != 0 and abs(covered - round(covered)) < 1e-9:
            return "closed" if kind == "closed" else "open"
    return "part"


def extremes(plan: Plan, sheet: str, row: int, col: int) -> tuple[list[Cell], list[Fill], int]:
    """The block for all symbols of `findings`, its heading in `row`; (cells, formulas, columns taken).

    Writes down where `#max <symbol>`, `#max at <symbol>` and the same for min stand.
    """
    symbols = findings(plan.mechanism, plan.equations).extremes
    if not symbols:
        return [], [], 0
    cells = [Cell(row, col, plan.text("extremes.title"), styles.SECTION), Cell(row + 1, col, None, styles.HEAD)]
    cells += [Cell(row, col + 1 + index, None, styles.SECTION) for index in range(2 * len(symbols))]
    names = ("extremes.row", "extremes.before", "extremes.after", "extremes.value", "extremes.at")
    cells += [Cell(row + 2 + index, col, plan.text(name), styles.LABEL) for index, name in enumerate(names)]
    fills: list[Fill] = []
    sweep = sweep_of(plan)
    for index, symbol in enumerate(symbols):
        for side, take in enumerate(("min", "max")):
            here = col + 1 + 2 * index + side
            head = rich(symbol, f" [{blank_unit(plan, symbol)}] {plan.text(f'extremes.{take}')}")
            cells.append(Cell(row + 1, here, head, styles.HEAD))
            top = row + 2
            for step, node in enumerate(_formulas(plan, sheet, symbol, take, sweep, (top, here))):
                style = styles.decimals(styles.RESULT, 0 if step == ROW else 4)
                fills.append(Fill(top + step, here, node, style))
            for name, part in ((f"#{take} {symbol}", VALUE), (f"#{take} at {symbol}", AT)):
                plan.at.spots[name] = plan.at.shown[name] = Spot(sheet, top + part, here)
    return cells, fills, 1 + 2 * len(symbols)


def _formulas(
    plan: Plan, sheet: str, symbol: str, take: str, sweep: Sweep, corner: tuple[int, int]
) -> tuple[Node, Node, Node, Node, Node]:
    top, col = corner
    column = plan.at.area(plan.at.shown[f"#rounded {symbol}"], sheet)
    drivers = plan.at.column(plan.mechanism.driver.symbol, sheet)
    k, a, b = (CellRef(top + part, col) for part in (ROW, BEFORE, AFTER))
    y = Call("INDEX", (column, k))
    row = Call("MATCH", (Call(take.upper(), (column,)), column, al.ZERO))
    turn: Node | None = None
    if plan.equations.of(symbol).unit == "angle":
        turn = Number(360.0) if blank_unit(plan, symbol) == "°" else al.mul(al.TWO, al.PI)
    before, after = _neighbours(plan, column, k, y, sweep, turn)
    both = Binary("=", Call("COUNT", (a, b)), al.TWO)
    bend = al.add(al.sub(a, al.mul(al.TWO, y)), b)
    falls = (al.sub(y, a), al.sub(y, b)) if take == "max" else (al.sub(a, y), al.sub(b, y))
    flat = _rounding(y)
    peak = Call(
        "AND",
        (
            Binary(">=", Call("MIN", falls), al.mul(al.number(-2), flat)),
            Binary(">", Call("ABS", (bend,)), al.mul(al.number(4), flat)),
        ),
    )
    vertex = al.sub(y, al.div(al.square(al.sub(a, b)), al.mul(al.number(8), bend)))
    value = Call("IF", (both, Call("IF", (peak, vertex, y)), y))
    place: Node = Call("INDEX", (drivers, k))
    if sweep == "list":
        return row, before, after, value, place
    step = plan.at.reading_shown("#step", sheet, None)
    offset = al.div(al.mul(step, al.sub(a, b)), al.mul(al.TWO, bend))
    there = Call("IF", (peak, al.add(place, offset), place))
    return row, before, after, value, Call("IF", (both, there, place))


def _rounding(value: Node) -> Node:
    """Values this near to each other count as equal."""
    return al.add(al.mul(Number(1e-9), Call("ABS", (value,))), Number(1e-12))


def _neighbours(plan: Plan, column: RangeRef, k: Node, y: Node, sweep: Sweep, turn: Node | None) -> tuple[Node, Node]:
    """The values before and after row k; an empty text where there is none. Across the end of a turn, an angle is brought
    within half a `turn` of y."""
    if sweep == "list":
        return Text(""), Text("")
    rows = plan.rows

    def across(row: int) -> Node:
        value = _at(column, row)
        if turn is None:
            return value
        half = al.div(turn, al.TWO)
        return al.sub(al.add(y, Call("MOD", (al.add(al.sub(value, y), half), turn))), half)

    ends: tuple[Node, Node] = (Text(""), Text(""))
    if sweep == "closed":
        ends = (across(rows - 1), across(2))
    elif sweep == "open":
        ends = (across(rows), across(1))
    before = Call("INDEX", (column, Binary("-", k, al.ONE)))
    after = Call("INDEX", (column, Binary("+", k, al.ONE)))
    return (
        Call("IF", (Binary("=", k, al.ONE), ends[0], before)),
        Call("IF", (Binary("=", k, Number(float(rows))), ends[1], after)),
    )


def _at(column: RangeRef, row: int) -> Node:
    return Call("INDEX", (column, Number(float(row))))

"""Limit positions: the values of the driver between which a mechanism can be assembled, as live cells.

Found in the sweep. Where a row exists and its neighbour does not, a limit lies between them. Seven trials cut that step
into eight, seven more cut an eighth into eight; from there regula falsi, and inverse interpolation through three trials
(Brent, Algorithms for Minimization without Derivatives, 1973) on the smallest gap of all groups,

    f = min over groups (a + b - s, s - |a - b|; or hypotenuse - |leg|) + tol / 2,

lead to the limit. Two last trials, a hair before and behind it, prove it: one exists, the other does not. Where they do not
(pins that coincide in one row only; two groups that fail within a 64th of a step), the nearest trial that does not exist is
given instead, with the width that is left.

By formula, for the first group. Of the lengths that must form a triangle one depends on the driver alone; its square (for a
leg: itself) is

    q = A + B cos(theta) + C sin(theta)      a driver that turns
    q = A + B t + C t^2                      a driver that slides

with A, B and C from three trials. The group closes where lo <= q <= hi (law of cosines: (a-b)^2 and (a+b)^2), so

    R = hypot(B, C):   |theta - theta0| >= acos((hi - A) / R)  and  |theta - theta0| <= acos((lo - A) / R)

around theta0 = atan2(B, C). These are the driver's dead centres. A fourth trial shows that q is of that form.
"""

from __future__ import annotations

from dataclasses import dataclass

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef, Text
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.plan import STATUS, Plan
from mechsheet.sheet.rows import exists_column, fixed_column
from mechsheet.sheet.trials import Trials
from mechsheet.sheet.workbook import Cell, Content, Fill, Style

SLOTS = 4
"""Limits of one sweep that are found; there may be more, which are counted."""

PARTS = 8
"""A step is cut into so many, twice."""

HAIR = 1e-8
"""How far before and behind a limit the proof is made, in steps of the driver."""

NOTHING = "–"
"""Where there is no limit. Not an empty text: LibreOffice shows 0 for one in an .ods until it recalculates."""

ROW, AT, WAY, WHY, WITHIN = range(5)
"""Lines of a limit, below each other."""

FROM, TO, NEXT = range(3)
"""Columns of notes of the trials."""


@dataclass(frozen=True, slots=True)
class Slot:
    """A limit in the sweep while it is being found: its trials' first rows in the four stages."""

    number: int
    coarse: int
    fine: int
    near: int
    proof: int


@dataclass(frozen=True, slots=True)
class Found:
    """Cells of a limit that later formulas read: its number or `NOTHING`, the row that exists beside it, its trial."""

    at: CellRef
    last_row: CellRef
    trial: int


def slots_of(plan: Plan) -> int:
    """How many limits of the sweep the workbook has cells for."""
    closing = any(group.sides for group in plan.equations.groups)
    return SLOTS if closing and plan.rows > 1 else 0


class Limits:
    """The block of limits, `col` its first column, and the column that counts them row by row."""

    def __init__(self, plan: Plan, trials: Trials, row: int, first: int, col: int) -> None:
        self.plan = plan
        self.trials = trials
        self.row = row
        self.first = first
        self.col = col
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self.found: list[Found] = []
        self.drivers = plan.at.column(plan.mechanism.driver.symbol, trials.corner.sheet)

    # --- laying out -------------------------------------------------------------------------------------------

    def passed(self, col: int) -> RangeRef:
        """The column of the limits passed so far, row by row; the whole of it."""
        plan = self.plan
        self._put(self.first - 6, col, self.text("passed"), styles.HEAD)
        exists = exists_column(plan).start
        now = CellRef(exists.row + 1, exists.col, sheet=exists.sheet)
        before = CellRef(exists.row, exists.col, sheet=exists.sheet)
        step = Call("IF", (Binary("<>", now, before), al.ONE, al.ZERO))
        style = styles.decimals(styles.INNER, 0)
        self._put(self.first, col, 0.0, style)
        running = Binary("+", CellRef(self.first, col), step)
        self.fills.append(Fill(self.first + 1, col, running, style, rows=plan.rows - 1))
        return RangeRef(CellRef(self.first, col, True, True), CellRef(self.first + plan.rows - 1, col, True, True))

    def text(self, key: str, **parts: object) -> str:
        """A word of the workbook."""
        return self.plan.text(f"limits.{key}", **parts)

    def _put(self, row: int, col: int, content: Content, style: Style) -> None:
        self.cells.append(Cell(row, col, content, style))

    def _formula(self, line: int, col: int, node: Node, style: Style) -> CellRef:
        self.fills.append(Fill(self.row + 2 + line, col, node, style))
        return CellRef(self.row + 2 + line, col, True, True)

    def headings(self) -> None:
        """The block's title and the names of its lines."""
        width = 1 + slots_of(self.plan)
        self._put(self.row, self.col, self.text("title"), styles.SECTION)
        for col in range(self.col + 1, self.col + width):
            self._put(self.row, col, None, styles.SECTION)
        self._put(self.row + 1, self.col, None, styles.HEAD)
        for number in range(1, width):
            self._put(self.row + 1, self.col + number, self.text("number", number=number), styles.HEAD)
        for line, key in enumerate(("row", "at", "way", "why", "within")):
            self._put(self.row + 2 + line, self.col, self.text(key), styles.LABEL)

    # --- limits in the sweep ----------------------------------------------------------------------------------

    def find(self, slot: Slot, passed: RangeRef) -> None:
        """The formulas of one limit."""
        trials, col = self.trials, self.col + slot.number
        number = Number(float(slot.number))
        row = self._formula(ROW, col, Call("MATCH", (number, passed, al.ZERO)), styles.decimals(styles.RESULT, 0))
        ends = Binary(
            "=", Call("INDEX", (exists_column(self.plan), row)), al.ZERO
        )  # the row after the limit is missing
        above = al.sub(row, al.ONE)
        inside, outside = Call("IF", (ends, above, row)), Call("IF", (ends, row, above))
        start = trials.note(slot.coarse, FROM, Call("INDEX", (self.drivers, inside)))
        stop = trials.note(slot.coarse, TO, Call("INDEX", (self.drivers, outside)))
        last_row = trials.note(slot.coarse + 1, FROM, inside)
        self._spread(slot.coarse, PARTS - 1, start, stop, al.ONE, last_row)
        hit = self._first_missing(slot.coarse, PARTS - 1, PARTS)
        eighth = al.div(al.sub(stop, start), al.number(PARTS))
        bracket = trials.note(slot.fine, FROM, al.add(start, al.mul(eighth, al.sub(hit, al.ONE))))
        high = trials.note(slot.fine, TO, al.add(start, al.mul(eighth, hit)))
        self._spread(slot.fine, PARTS + 1, bracket, high, al.ZERO, last_row)
        guess, low, width = self._regula_falsi(slot.fine, bracket, high)
        step = trials.note(slot.near, TO, al.div(width, al.number(PARTS)))
        middle = trials.note(slot.near, FROM, guess)
        trials.drive(slot.near, 3, al.add(middle, al.mul(al.sub(trials.count(slot.near), al.ONE), step)), last_row)
        better = self._inverse(slot.near)
        limit = trials.note(slot.proof, FROM, better)
        hair = trials.note(slot.proof, TO, al.mul(Number(HAIR), al.sub(stop, start)))
        trials.drive(slot.proof, 3, al.add(limit, al.mul(al.sub(trials.count(slot.proof), al.ONE), hair)), last_row)
        there = [trials.cell(trials.exists, slot.proof + index) for index in range(3)]
        wanted = zip(there, (al.ONE, al.ONE, al.ZERO), strict=True)
        proved = trials.note(slot.proof, NEXT, Call("AND", tuple(Binary("=", cell, value) for cell, value in wanted)))
        self._results(slot, col, row, ends, proved, (limit, low, width, hair))
        self.found.append(Found(CellRef(self.row + 2 + AT, col, True, True), last_row, slot.proof + 1))

    def _results(
        self, slot: Slot, col: int, row: CellRef, ends: Node, proved: Node, cells: tuple[Node, Node, Node, Node]
    ) -> None:
        """The lines that people read."""
        plan = self.plan
        limit, low, width, hair = cells
        nothing = Text(NOTHING)
        number = styles.decimals(styles.RESULT, 6)
        beyond = al.add(low, width)  # the missing row itself where only that one is missing: pins that coincide there
        self._formula(AT, col, Call("IFERROR", (Call("IF", (proved, limit, beyond)), nothing)), number)
        words = Call("IF", (ends, Text(self.text("ends")), Text(self.text("begins"))))
        self._formula(WAY, col, Call("IFERROR", (words, nothing)), styles.VERDICT_MIDDLE)
        missing = Call("IF", (ends, row, al.sub(row, al.ONE)))
        why = Call("INDEX", (fixed_column(plan, STATUS), missing))
        self._formula(WHY, col, Call("IFERROR", (why, nothing)), styles.VERDICT)
        within = Call("ABS", (Call("IF", (proved, hair, width)),))
        style = styles.numbered(styles.RESULT, styles.ERROR.number_format)
        self._formula(WITHIN, col, Call("IFERROR", (within, nothing)), style)
        for name, line in ((f"#limit {slot.number}", AT), (f"#limit way {slot.number}", WAY)):
            spot = Spot(self.trials.corner.sheet, self.row + 2 + line, col)
            plan.at.spots[name] = plan.at.shown[name] = spot

    def _spread(self, row: int, count: int, start: Node, stop: Node, offset: Node, near: Node) -> None:
        """Trials between two values of the driver: `offset` parts of the way for the first, one part more for each."""
        part = al.div(al.add(self.trials.count(row), offset), al.number(PARTS))
        self.trials.drive(row, count, al.add(start, al.mul(al.sub(stop, start), part)), near)

    def _first_missing(self, row: int, count: int, otherwise: int) -> Node:
        """The number (from 1) of the first trial that does not exist."""
        column = self.trials.column(self.trials.exists, row, count)
        found = Call("IFERROR", (Call("MATCH", (al.ZERO, column, al.ZERO)), al.number(otherwise)))
        first = self.trials.at(row)
        known = Call("IF", (Call("ISNUMBER", (first,)), found, Call("NA")))
        return self.trials.note(row, NEXT, known)

    def _regula_falsi(self, row: int, low: Node, high: Node) -> tuple[Node, Node, Node]:
        """Of the two trials around the limit: where the chord through them meets zero, the one that exists, their way."""
        trials = self.trials
        later = Call("MAX", (al.TWO, self._first_missing(row, PARTS + 1, PARTS + 1)))
        f = trials.column(trials.f, row, PARTS + 1)
        inside = trials.note(row + 1, FROM, Call("INDEX", (f, al.sub(later, al.ONE))))
        outside = trials.note(row + 1, TO, Call("INDEX", (f, later)))
        width = al.div(al.sub(high, low), al.number(PARTS))
        share = trials.note(row + 1, NEXT, al.div(inside, al.sub(inside, outside)))
        exists = trials.note(row + 2, FROM, al.add(low, al.mul(width, al.sub(later, al.TWO))))
        way = trials.note(row + 2, TO, width)
        return al.add(exists, al.mul(way, share)), exists, way

    def _inverse(self, row: int) -> Node:
        """Where f is 0 by the parabola t(f) through three trials (Lagrange's form)."""
        trials = self.trials
        points = [(trials.at(row + index), trials.cell(trials.f, row + index)) for index in range(3)]
        total: Node = al.ZERO
        for index, (t, f) in enumerate(points):
            (_, g), (_, h) = (points[other] for other in range(3) if other != index)
            weight = al.div(al.mul(g, h), al.mul(al.sub(f, g), al.sub(f, h)))
            total = al.add(total, al.mul(t, weight))
        return total

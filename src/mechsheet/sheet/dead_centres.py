"""The driver's dead centres by formula: where the first group stops closing, whatever the sweep covers.

Of the lengths that must form a triangle one depends on the driver alone; its square (of a leg: itself) is

    q = A + B cos(theta) + C sin(theta)      a driver that turns
    q = A + B t + C t^2                      a driver that slides

with theta counted from 17 degrees, and A, B and C from three trials (17, 107 and 197 degrees; or -1, 0 and 1 times a
length). The group closes where
lo <= q <= hi (by the law of cosines (a-b)^2 and (a+b)^2). For a driver that turns, with R = hypot(B, C), that is

    acos((hi - A) / R) <= |theta - theta0| <= acos((lo - A) / R),      theta0 = 17 deg + atan2(B, C),

and for one that slides, with t0 = -B / (2 C) and the extreme value m = A - B^2 / (4 C),

    sqrt((lo - m) / C) <= |t - t0| <= sqrt((hi - m) / C).

A fourth trial shows that q is of that form.
"""

from __future__ import annotations

import numpy as np

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Boolean, Call, CellRef, Node, Number, Text
from mechsheet.sheet import styles
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.expansion import substituted
from mechsheet.sheet.plan import DRIVER, Plan
from mechsheet.sheet.reach import SAME, Reach
from mechsheet.sheet.trials import Trials
from mechsheet.sheet.workbook import Cell, Fill

TRIALS = 4
"""Trials that tell A, B and C, and the form."""

PROVING = 3.9
"""The driver's value of the last trial: radians, or times the length."""

START = 17.0
"""The first trial of a driver that turns [deg]: not 0, where links point along an axis and rounding decides about turns."""

LOWEST = -100.0
"""Middles of ranges are shown from here on, for a turn [deg]: the usual ones (0, 90, 180, -90) lie well inside."""

NOTHING, WITHOUT_END = "–", "∞"

TOUCHING = 1e-12
"""A limit that is touched to this part is not passed."""


class DeadCentres:
    """The cells: a list of labels and values in two columns, from `row` on."""

    def __init__(self, plan: Plan, trials: Trials, reach: Reach, row: int, col: int) -> None:
        self.plan = plan
        self.trials = trials
        self.reach = reach
        self.row = row
        self.col = col
        self.cells: list[Cell] = []
        self.fills: list[Fill] = []
        self.turns = reach.form == "turn"

    def write(self, row: int) -> None:
        """All of it; `row` is the first of its trials."""
        links = self.reach.group.label.of(self.plan.language)
        self.cells.append(Cell(self.row, self.col, self.text("title"), styles.SECTION))
        self.cells.append(Cell(self.row, self.col + 1, None, styles.SECTION))
        self.cells.append(Cell(self.row + 1, self.col, links, styles.NOTE))
        self.row += 2
        self._drive(row)
        centre, inner, outer = self._centre(*self._coefficients(row))
        self._ranges(centre, inner, outer)

    # --- small things -----------------------------------------------------------------------------------------

    def text(self, key: str) -> str:
        """A word of the workbook."""
        return self.plan.text(f"dead.{key}")

    def line(self, key: str, node: Node, places: int = 6) -> CellRef:
        """A label and a value."""
        self.cells.append(Cell(self.row, self.col, self.text(key), styles.LABEL))
        self.fills.append(Fill(self.row, self.col + 1, node, styles.decimals(styles.RESULT, places)))
        self.row += 1
        return CellRef(self.row - 1, self.col + 1, True, True)

    def bound(self, node: Node, row: int) -> Node:
        """An expression as the trial in a row has it."""
        return substituted(node, _Forms(self.trials, row))

    def shown(self, node: Node) -> Node:
        """A value of the driver as people read it."""
        return Call("DEGREES", (node,)) if self.trials.radians else node

    # --- the formula ------------------------------------------------------------------------------------------

    def _drive(self, row: int) -> None:
        if self.turns:
            quarter = Number(90.0) if self.trials.radians else al.div(al.PI, al.TWO)
            self.trials.drive(row, 3, al.add(self._first(), al.mul(self.trials.count(row), quarter)), al.ONE)
            proving = Number(round(np.degrees(PROVING), 1)) if self.trials.radians else Number(PROVING)
            self.trials.drive(row + 3, 1, proving, al.ONE)
            return
        size = al.div(
            self.plan.at.reference(self.plan.equations.tolerance, self.trials.corner.sheet, None), Number(1e-12)
        )
        self.trials.drive(row, 3, al.mul(al.sub(self.trials.count(row), al.ONE), size), al.ONE)
        self.trials.drive(row + 3, 1, al.mul(Number(PROVING), size), al.ONE)

    def _first(self) -> Node:
        """The driver's value of the first trial, as people read it."""
        return Number(START) if self.trials.radians else Number(round(np.radians(START), 3))

    def _coefficients(self, row: int) -> tuple[CellRef, CellRef, CellRef, CellRef, CellRef | None]:
        """A, B, C, lo, hi."""
        q = [self.trials.note(row + index, 0, self.bound(self.reach.quantity, row + index)) for index in range(TRIALS)]
        at = [self.trials.at(row + index) for index in range(TRIALS)]
        if self.turns:
            a = self.line("A", al.div(al.add(q[0], q[2]), al.TWO))
            b = self.line("B", al.div(al.sub(q[0], q[2]), al.TWO))
            c = self.line("C", al.sub(q[1], a))
            angle: Node = al.sub(at[3], self._first())
            angle = Call("RADIANS", (angle,)) if self.trials.radians else angle
            parts = al.add(al.mul(b, Call("COS", (angle,))), al.mul(c, Call("SIN", (angle,))))
        else:
            a = self.line("A", q[1])
            b = self.line("B", al.div(al.sub(q[2], q[0]), al.mul(al.TWO, at[2])))
            bend = al.div(al.sub(al.div(al.add(q[0], q[2]), al.TWO), a), al.square(at[2]))
            c = self.line("C", bend if self.reach.form == "slide" else al.ZERO)
            parts = al.add(al.mul(b, at[3]), al.mul(c, al.square(at[3])))
        lo = self.line("lo", self.bound(self.reach.lo, row))
        hi = self.line("hi", self.bound(self.reach.hi, row)) if self.reach.hi is not None else None
        size = al.largest([Call("ABS", (node,)) for node in q])
        off = al.div(Call("ABS", (al.sub(al.add(a, parts), q[3]),)), size)
        self.fills.append(Fill(self.row, self.col + 1, off, styles.numbered(styles.RESULT, styles.ERROR.number_format)))
        self.cells.append(Cell(self.row, self.col, self.text("off"), styles.LABEL))
        self.off = CellRef(self.row, self.col + 1, True, True)
        self.row += 1
        return a, b, c, lo, hi

    def _centre(
        self, a: CellRef, b: CellRef, c: CellRef, lo: CellRef, hi: CellRef | None
    ) -> tuple[CellRef, CellRef, CellRef]:
        """theta0 (or t0), and between which distances from it the group closes: inner 0 and outer pi (or infinite) mean
        that there is no such limit; #N/A that it closes nowhere."""
        good = Binary("<", self.off, Number(SAME))
        if self.turns:
            radius = self.line("R", al.sqrt(al.add(al.square(b), al.square(c))))
            centre: Node = al.atan2(b, c)
            first = Call("RADIANS", (self._first(),)) if self.trials.radians else self._first()
            centre = al.add(first, centre)
            inner = _arc(al.sub(hi, a), radius, al.ZERO, Call("NA")) if hi is not None else al.ZERO
            outer = _arc(al.sub(lo, a), radius, Call("NA"), al.PI)
            centre = self.line("centre", self.shown(Call("IF", (good, centre, Call("NA")))))
            return centre, self.line("inner", self.shown(inner)), self.line("outer", self.shown(outer))
        if self.reach.form == "line" and hi is not None:
            middle = al.div(al.sub(al.div(al.add(lo, hi), al.TWO), a), b)
            reach = Call("ABS", (al.div(al.sub(hi, lo), al.mul(al.TWO, b)),))
            centre = self.line("centre", Call("IF", (good, middle, Call("NA"))))
            return centre, self.line("inner", Number(0.0)), self.line("outer", reach)
        middle = al.div(al.neg(b), al.mul(al.TWO, c))
        least = self.line("R", al.sub(a, al.div(al.square(b), al.mul(al.number(4), c))))
        centre = self.line("centre", Call("IF", (good, middle, Call("NA"))))
        squares = [al.div(al.sub(end, least), c) for end in (lo, hi) if end is not None]
        inner_at = self.line("inner", Call("SQRT", (Call("MAX", (al.ZERO, squares[0])),)))
        if hi is None:
            return centre, inner_at, self.line("outer", Text(WITHOUT_END))
        nowhere = Binary("<", squares[1], al.ZERO)
        return centre, inner_at, self.line("outer", Call("IF", (nowhere, Call("NA"), Call("SQRT", (squares[1],)))))

    def _ranges(self, centre: CellRef, inner: CellRef, outer: CellRef) -> None:
        """From where to where the driver can go: one range, or two beside each other."""
        turn = Number(360.0) if self.trials.radians else al.mul(al.TWO, al.PI)
        half_turn = Number(180.0) if self.trials.radians else al.PI
        hole = Binary(">", inner, al.ZERO)
        if self.turns:
            lowest = Number(LOWEST) if self.trials.radians else Call("RADIANS", (Number(LOWEST),))
            open_ = Binary(">=", outer, half_turn)
            two: Node = Call("AND", (hole, Call("NOT", (open_,))))
            free: Node = Call("AND", (Call("NOT", (hole,)), open_))
            opposite = al.add(centre, half_turn)
            one_middle = Call("IF", (open_, opposite, centre))
            half = Call("IF", (two, _half(outer, inner), Call("IF", (open_, al.sub(half_turn, inner), outer))))
            between = al.div(al.add(inner, outer), al.TWO)
            middles = [Call("IF", (two, al.add(centre, between), one_middle)), al.sub(centre, between)]
            middles = [al.add(Call("MOD", (al.sub(middle, lowest), turn)), lowest) for middle in middles]
            ends = [(al.sub(middle, half), al.add(middle, half)) for middle in middles]
        else:
            two, free = hole, Call("AND", (Call("NOT", (hole,)), Call("NOT", (Call("ISNUMBER", (outer,)),))))
            far, near = al.add(centre, outer), al.add(centre, inner)
            mirror_far, mirror_near = al.sub(centre, outer), al.sub(centre, inner)
            endless = Call("ISNUMBER", (outer,))
            far = Call("IF", (endless, far, Text(WITHOUT_END)))
            mirror_far = Call("IF", (endless, mirror_far, Text(f"-{WITHOUT_END}")))
            ends = [(Call("IF", (two, near, mirror_far)), far), (mirror_far, mirror_near)]
        if self.reach.form != "line" and self.reach.hi is not None:
            nowhere = Binary(">", inner, outer)
        else:
            nowhere = Binary("<", al.ONE, al.ZERO)
        state = Call("IF", (nowhere, Number(-1.0), Call("IF", (free, al.ZERO, Call("IF", (two, al.TWO, al.ONE))))))
        count = self.line("count", Call("IFERROR", (state, Number(-1.0))), 0)
        self._spot("#input ranges", count)
        cells = []
        for index, (start, stop) in enumerate(ends, 1):
            there = Binary(">=", count, Number(float(index)))
            cells += [
                self.line(key, Call("IF", (there, node, Text(NOTHING))))
                for key, node in (("from", start), ("to", stop))
            ]
        other = self.line("here", Call("IF", (self._starts_in(cells[2], cells[3]), al.TWO, al.ONE)), 0)
        second = Binary("=", other, al.TWO)
        for index, key in enumerate(("from", "to", "from other", "to other")):
            self._spot(f"#input {key}", self.line(key, Call("IF", (second, cells[(index + 2) % 4], cells[index]))))

    def _starts_in(self, low: CellRef, high: CellRef) -> Node:
        """TRUE where the sweep starts in a range."""
        start = CellRef(self.plan.at.first, DRIVER, True, True, self.plan.table)
        if self.turns:
            turn = Number(360.0) if self.trials.radians else al.mul(al.TWO, al.PI)
            inside: Node = Binary("<=", Call("MOD", (al.sub(start, low), turn)), al.sub(high, low))
        else:
            inside = Call("AND", (self._beyond(start, low, ">="), self._beyond(start, high, "<=")))
        return Call("IFERROR", (inside, Boolean(False)))

    @staticmethod
    def _beyond(value: Node, end: CellRef, way: str) -> Node:
        """A comparison with the end of a range; an end that is no number is not there."""
        return Call("IF", (Call("ISNUMBER", (end,)), Binary(way, value, end), Binary("<>", end, Text(NOTHING))))

    def _spot(self, name: str, cell: CellRef) -> None:
        spot = Spot(self.trials.corner.sheet, cell.row, cell.col)
        self.plan.at.spots[name] = self.plan.at.shown[name] = spot


class _Forms(dict[str, Node]):
    """The cells of symbols in the row of a trial, the driver's own among them; else a dimension or a constant."""

    def __init__(self, trials: Trials, row: int) -> None:
        super().__init__()
        self.trials, self.row = trials, row

    def __missing__(self, name: str) -> Node:
        if name in self.trials.forms:
            return self.trials.value(name, self.row)
        return self.trials.plan.at.reference(name, self.trials.corner.sheet, None)


def _arc(part: Node, radius: Node, beyond: Node, below: Node) -> Node:
    """acos(part / radius) by the arc tangent of the two legs; `beyond` where part reaches radius, `below` -radius."""
    square = al.mul(al.sub(radius, part), al.add(radius, part))
    angle = al.atan2(part, Call("SQRT", (square,)))
    most = al.mul(radius, Number(1 - TOUCHING))
    return Call("IF", (Binary(">=", part, most), beyond, Call("IF", (Binary("<=", part, al.neg(most)), below, angle))))


def _half(one: Node, other: Node) -> Node:
    return al.div(al.sub(one, other), al.TWO)

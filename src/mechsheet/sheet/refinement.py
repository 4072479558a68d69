"""An extreme between rows, found by trials: Newton's method on the slope of a quantity.

Three trials around the vertex of the parabola through rows, and five around the vertex of theirs,

    slope = (y1 - y-1) / 2,                             bend = y-1 - 2 y0 + y1
    slope = (8 (y1 - y-1) - (y2 - y-2)) / 12,           bend = (16 (y1 + y-1) - (y2 + y-2) - 30 y0) / 12
    vertex at  -slope / bend,  value  y0 - slope^2 / (2 bend)

in units of their distance, a degree of a driver that turns. The error of a vertex squares from one to the next; what is left
is of the fourth order in that distance.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Call, CellRef, Node, Number
from mechsheet.sheet import styles
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.positions import blank_unit
from mechsheet.sheet.trials import Trials
from mechsheet.sheet.workbook import Fill

FARTHEST = 30.0
"""A vertex is sought so many trials' distances away at most."""

FLAT = 1e-7
"""A curve whose second difference is a smaller part of its size is flat: rounding would decide where its vertex is."""

FROM, TO, NEXT = range(3)
"""Columns of notes of the trials."""


@dataclass(frozen=True, slots=True)
class Tried:
    """First rows of the trials of one extreme, in the first stage and in the second."""

    first: int
    second: int


class Refinement:
    """Trials around a vertex: three, then five around the vertex of their parabola (slope and bend of fourth order)."""

    def __init__(self, plan: Plan, sheet: str, trials: Trials, symbol: str, near: CellRef) -> None:
        self.plan = plan
        self.sheet = sheet
        self.trials = trials
        self.symbol = symbol
        self.near = near
        self.step = al.mul(plan.at.reading_shown("#step", sheet, None), al.number(_beside(plan)))

    def run(self, tried: Tried, peak: Node, start: CellRef) -> tuple[Node, Node]:
        """(value, driver's value) of the extreme; errors where there is no peak between rows."""
        trials = self.trials
        first = trials.note(tried.first, FROM, Call("IF", (peak, start, Call("NA"))))
        a, y, b = self._values(tried.first, 3, first)
        bend = trials.note(tried.first + 1, NEXT, al.add(al.sub(a, al.mul(al.TWO, y)), b))
        slope = trials.note(tried.first, NEXT, al.div(al.sub(b, a), al.TWO))
        shift = trials.note(tried.first + 2, NEXT, self._shift(slope, bend, y))
        second = trials.note(tried.second, FROM, al.add(first, al.mul(self.step, shift)))
        a, b, y, c, d = self._values(tried.second, 5, second)
        eight, twelve, sixteen, thirty = (al.number(n) for n in (8, 12, 16, 30))
        slope = trials.note(tried.second, NEXT, al.div(al.sub(al.mul(eight, al.sub(c, b)), al.sub(d, a)), twelve))
        inner, outer = al.mul(sixteen, al.add(b, c)), al.add(a, d)
        bend = trials.note(tried.second + 1, NEXT, al.div(al.sub(al.sub(inner, outer), al.mul(thirty, y)), twelve))
        shift = trials.note(tried.second + 2, NEXT, self._shift(slope, bend, y))
        return al.add(y, al.div(al.mul(shift, slope), al.TWO)), al.add(second, al.mul(self.step, shift))

    def _values(self, row: int, count: int, middle: CellRef) -> list[CellRef]:
        """The quantity, as the table shows it, in trials beside each other."""
        trials = self.trials
        place = al.sub(trials.count(row), al.number(count // 2))
        trials.drive(row, count, al.add(middle, al.mul(place, self.step)), self.near)
        value = trials.value(self.symbol, row, moving=True)
        trials.fills.append(
            Fill(row, trials.work + TO, as_shown(self.plan, self.symbol, value), styles.INNER, rows=count)
        )
        return [CellRef(row + index, trials.work + TO, True, True) for index in range(count)]

    def _shift(self, slope: CellRef, bend: CellRef, value: CellRef) -> Node:
        """How many trials' distances the vertex is away, `FARTHEST` at most; 0 where the curve is flat."""
        plan = self.plan
        shift = al.neg(al.div(slope, bend))
        limited = Call("MAX", (al.number(-FARTHEST), Call("MIN", (al.number(FARTHEST), shift))))
        scale: Node = al.div(plan.at.reference(plan.equations.tolerance, self.sheet, None), Number(1e-12))
        if plan.equations.of(self.symbol).unit.kind == "angle":
            scale = Number(57.3) if blank_unit(plan, self.symbol) == "°" else al.ONE
        least = al.mul(Number(FLAT), al.add(Call("ABS", (value,)), scale))
        return Call("IF", (Binary("<", Call("ABS", (bend,)), least), al.ZERO, limited))


def _beside(plan: Plan) -> float:
    """Distance of trials in steps of the driver: a degree, or a 360th of the range of a slide."""
    step = abs(plan.driver[1] - plan.driver[0])
    if plan.mechanism.driver.unit.kind == "angle":
        return float(f"{math.radians(1.0) / step:.6g}")
    return float(f"{abs(plan.driver[-1] - plan.driver[0]) / 360 / step:.6g}")


def as_shown(plan: Plan, symbol: str, value: Node) -> Node:
    """A trial's value as people read it."""
    return Call("DEGREES", (value,)) if plan.at.shown[symbol].degrees else value

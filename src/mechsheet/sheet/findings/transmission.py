"""How well each group transmits force: its worst angle of transmission."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np

from livesheet.formula.nodes import Call, CellRef, Node, Number, RangeRef, Symbol
from mechsheet.kinematics.equations import Group
from mechsheet.kinematics.numeric import Array
from mechsheet.sheet.findings.finding import Finding, InTitle, Line, good, look
from mechsheet.sheet.findings.ratios import HIGH_LOW
from mechsheet.sheet.findings.reading import Reading
from mechsheet.sheet.findings.searched import Expected, SearchedMotion
from mechsheet.sheet.over_rows import LEAST, MOST, over_rows
from mechsheet.sheet.plan import SYMBOL, VALUE
from mechsheet.sheet.quoted import ALL, formula, joined
from mechsheet.sheet.table.positions import decimals_of_kind
from mechsheet.sheet.transmission import RIGHT, STRAIGHT, acute, poor_limit, worst_of_rows, worst_words
from mechsheet.units import behind_number

ROUNDED = 2e-6
"""Angles by arccos [rad], at a dead centre."""


class Transmission(Finding):
    """The angle of transmission that is farthest from 90 degrees, as an acute angle; that of the rows where the sheet of
    extremes was deleted.

    all  the groups that have one: the line under the title names the worst
    """

    placed = by_rows = tells_place = True

    def __init__(self, group: Group, all: tuple[Group, ...]) -> None:
        self.group, self.all = group, all
        self.key = key_of(group)

    def line(self, on: Reading) -> Line:
        plan, group, value = on.plan, self.group, on.value(self.key)
        high, low = (on.column_extreme(way, group.transmission) for way in HIGH_LOW)
        unit, shown = plan.mechanism.angle_unit, plan.at.spots[group.transmission].degrees
        right, straight = (Number(90.0), Number(180.0)) if shown else (RIGHT, STRAIGHT)

        def fold(low: Node, high: Node) -> tuple[Node, Node]:
            return acute(low, high, group.kind != "RRR", right, straight)

        folded = fold(low, high)
        poor = formula("value<limit", value=value, limit=poor_limit(plan.mechanism))
        converted = unit.in_degrees and not shown
        place = on.occurs_at_least(
            group.transmission, fold, formula("RADIANS(value)", value=value) if converted else value
        )
        said = worst_words(plan, value, on.beside(self.key, place), poor, on.of_rows_only)
        column = Symbol(ALL + group.transmission)
        in_rows = acute(over_rows(LEAST, column), over_rows(MOST, column), group.kind != "RRR")
        least = on.while_there("extremes", Call("MIN", folded), Call("MIN", in_rows))
        said = on.while_there("extremes", joined(said, on.about(group.transmission)), worst_of_rows(plan, value, poor))
        if converted:
            least = formula("DEGREES(least)", least=least)
        return Line(
            f"μ{group.number} ({group.pins[-1]})", on.where_known(least), formula('IFERROR(said,"")', said=said), unit.text,
            decimals_of_kind(plan, "angle"), occurs=formula("IFERROR(place,NA())", place=place), itself=("value", "words"),
            levels=(
                look("AND(ISNUMBER(value),poor)", value=value, poor=poor),
                good("ISNUMBER(FIND(fair,said))", said=on.words(self.key), fair=on.text("fair")),
            ),
        )  # fmt: skip

    def in_title(self, on: Reading) -> InTitle:
        if self.group != self.all[0]:
            return InTitle()
        what = f"; {on.text('line.transmission')} "
        if len(self.all) == 1:
            return InTitle(here=formula('IF(ISNUMBER(value),what&words,"")', value=on.value(self.key), what=what,
                                        words=on.words(self.key)))  # fmt: skip
        symbols, values, said = (self._column(on, col) for col in (SYMBOL, VALUE, on.meaning))
        return InTitle(here=formula(
            'IFERROR(what&INDEX(symbols,worst)&" "&INDEX(said,worst),"")', what=what, symbols=symbols, said=said,
            worst=on.worst_group(values),
        ))  # fmt: skip

    def left(self, on: Reading) -> Node | str:
        if self.group != self.all[0]:
            return ""
        unit, angles = on.plan.mechanism.angle_unit, self._column(on, VALUE)
        least = formula("ROUND(MIN(angles),digits)", angles=angles, digits=1 if unit.in_degrees else 2)
        said = joined(f"{on.text('line.transmission')} ", least, f"{behind_number(unit.text)}; ")
        return formula('IF(COUNT(angles)>0,said,"")', angles=angles, said=said)

    def _column(self, on: Reading, col: int) -> RangeRef:
        """The cells of a column in the lines of all groups."""
        first, last = (on.rows[key_of(group)] for group in (self.all[0], self.all[-1]))
        return RangeRef(CellRef(first, col, True, True), CellRef(last, col, True, True))

    def expected(self, motion: SearchedMotion) -> Mapping[str, Expected]:
        if not motion.search.count or motion.too_many:
            return {self.key: Expected([])}
        found = self._least(motion, motion.says(self.key, "rows.only")) if motion.sure or motion.page else None
        if found is None:
            return {}
        least, most = found
        of_rows = self._least(motion, rows_only=True)
        expected = motion.as_far(self.key, [least], [of_rows[0]] if of_rows else [])
        scale = motion.angle_scale
        allowed = motion.part(self.key) * max(most - least, 1e-3 * scale) + ROUNDED * scale
        return {self.key: Expected(expected, allowed)}

    def _least(self, motion: SearchedMotion, rows_only: bool) -> tuple[float, float] | None:
        """The least and the largest acute angle; of several stretches, in their rows."""

        def acute_of(angle: Array) -> Array:
            return np.minimum(angle, math.pi - angle) if self.group.kind == "RRR" else math.pi / 2 - np.abs(angle)

        rows_only = rows_only or motion.page or len(motion.search.row_stretches) > 1
        extremes = motion.search.extremes(self.group.transmission, acute_of, rows_only=rows_only)
        return None if extremes is None else (extremes[0] * motion.angle_scale, extremes[2] * motion.angle_scale)


def key_of(group: Group) -> str:
    """The key of a group's line."""
    return f"transmission_{group.number}"

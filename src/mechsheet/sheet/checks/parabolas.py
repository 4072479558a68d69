"""Extremes of quantities whose derivatives are no columns: at vertices of parabolas, from the best row on.

The first probe is at the vertex of the parabola through that row and its neighbours, the second a tenth of a row beside it
(or as far on the row's other side, where the first is worse than the row), the others at the vertex of the parabola through
the last three points.

Beside a limit a quantity y goes to its value there as a root does. Where the best row is the last before a limit, all
parabolas are over the root of the distance from it:

    y(w) = y0 + b w + c w^2,   w^2 = |u - limit|
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

from livesheet.formula import algebra as al
from livesheet.formula.nodes import CellRef, Node
from mechsheet.sheet.checks.probes import ALL_ROWS, AT, SIDE, VALUE, Block, Probes
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula

PROBES = 4
"""With three, an extreme that is steep on one side only was found, but not where it is: time ratios were 2 % off."""

BESIDE = 0.1
"""How far beside the first probe the second is made, in rows."""

FROM_LIMIT = 0.125
"""How far from a limit the second probe is made, at least: as a part of the root of the row's distance."""

AT_LIMIT = 1e-3
"""The same where the quantity has no number at the limit, where the row's then stands: it may grow without bound there."""

BEFORE = -9.0
"""A place before all others: of no limit."""

FROM_END = 0.25
"""How far from the motion's first or last row the first probe is made, where the parabola's vertex lies beyond it."""

ARRIVED = 1e-6
"""Two probes that are no farther from each other [rows] have found the place; their difference is rounding."""

ROOT = SIDE + 8
"""Working cells: the root of a probe's distance from a limit, or the distance."""

DIFFERENCES = ROOT + 1
"""Working cells: divided differences of the probes, of first, second and third order."""

Point = tuple[Node, Node]
"""A place and the quantity there."""


@dataclass(frozen=True, slots=True)
class Parabolas:
    """The probes of a block, whose best row stands in its anchor.

    column   the quantity in all rows
    around   more than 0 where the probes go on beyond the last row, into the first
    rows     first and last row of the stretch;  ends: the places where it begins and ends, between rows
    limited  whether the stretch may end between rows: then two rows below the probes hold the quantity where it does
    """

    probes: Probes
    block: Block
    way: Literal["min", "max"]
    column: Node
    around: Node
    rows: tuple[CellRef, CellRef]
    ends: tuple[CellRef, CellRef]
    limited: bool

    def write(self) -> None:
        """All places, and what they are found from."""
        self._first_probes()
        self._further_probes()

    def turn(self) -> Node:
        """Where the cubic through all probes (Newton's form, over the way from the last one) has its extreme."""
        at, known = ([cell(index) for index in range(PROBES + 1)] for cell in (self._at, self._value))
        for order in range(1, PROBES):
            for index in range(PROBES, order, -1):
                known[index] = self.probes.work(
                    self.block.row + index, DIFFERENCES + order - 1, 'IFERROR((y-y_before)/(x-x_before),"")', y=known[index],
                    y_before=known[index - 1], x=at[index], x_before=at[index - order],
                )  # fmt: skip
        first, second, third = (self.probes.cell(self.block.row + PROBES, DIFFERENCES + order) for order in range(3))
        far, before, last = at[-3:]
        linear = formula("2*(second+third*(2*last-before-far))", second=second, third=third, last=last, before=before,
                         far=far)  # fmt: skip
        constant = formula("first+(last-before)*(second+third*(last-far))", first=first, second=second, third=third,
                           last=last, before=before, far=far)  # fmt: skip
        # of both roots the one beside the last probe
        way = formula("2*constant/(linear+SIGN(linear)*SQRT(linear^2-12*third*constant))", linear=linear,
                      constant=constant, third=third)  # fmt: skip
        return formula("IF(ABS(last-before)<arrived,last,last-way)", last=last, before=before, arrived=ARRIVED, way=way)

    @property
    def _plan(self) -> Plan:
        return self.probes.plan

    def _at(self, index: int) -> CellRef:
        """The place of a probe; of the best row, where it is 0."""
        return self.probes.cell(self.block.row + index, AT)

    def _value(self, index: int) -> CellRef:
        """The quantity there."""
        return self.probes.cell(self.block.row + index, VALUE)

    def _first_probes(self) -> None:
        """At the vertex of the parabola through three rows of the stretch; then beside it, or on the row's other side."""
        probes, row, around = self.probes, self.block.row, self.around
        here = self._at(0)
        low, high = self.ends
        place = self._vertex_of_rows()
        if self.limited:
            place = formula("IF(limit>0,root,place)", limit=self._limit(), root=self._first_root(), place=place)
        one = probes.work(row + 1, AT, "place", place=place)
        worse = formula("there>best" if self.way == "min" else "there<best", there=self._value(1), best=self._value(0))
        aside = formula("IF(worse,2*here-one,one+IF(one-here>1E-6,-beside,beside))", worse=worse, here=here, one=one,
                        beside=BESIDE)  # fmt: skip
        if self.limited:
            aside = formula("IF(limit>0,root,aside)", limit=self._limit_cell, root=self._second_root(), aside=aside)
        probes.work(
            row + 2, AT, "MAX(IF(wraps>0,0,low),MIN(IF(wraps>0,2*rows,high),aside))",
            wraps=around, low=low, high=high, rows=ALL_ROWS, aside=aside,
        )  # fmt: skip

    def _vertex_of_rows(self) -> Node:
        """The vertex of the parabola through the best row and its neighbours; beside the stretch's end through its last
        three."""
        probes, row, around, column = self.probes, self.block.row, self.around, self.column
        here = self._at(0)
        # of several stretches the rows are all, so the probes know the first one only
        first, last = self.rows
        low, high = self.ends
        middle = probes.work(
            row + 1, SIDE + 3, "IF(wraps>0,here,MAX(first+1,MIN(last-1,here)))",
            wraps=around, here=here, first=first, last=last,
        )  # fmt: skip
        before, value, after = (
            probes.work(row + 1, SIDE + work, "INDEX(column,number)", column=column, number=number)
            for work, number in zip((4, 5, 6), neighbours(middle, around, ALL_ROWS), strict=True)
        )
        vertex = formula(
            "middle+IFERROR((before-after)/(2*(before-2*value+after)),0)",
            middle=middle, before=before, value=value, after=after,
        )  # fmt: skip
        # beyond the motion's first or last row there is nothing: a dip may lie between it and the next
        least, most = (
            formula("IF(AND(here=edge,end=edge),here+far,end)", here=here, edge=edge, end=end, far=far)
            for edge, end, far in ((first, low, FROM_END), (last, high, -FROM_END))
        )
        return formula(
            "IF(wraps>0,MAX(here-1,MIN(here+1,vertex)),MAX(least,here-1,MIN(most,here+1,vertex)))",
            wraps=around, here=here, vertex=vertex, least=least, most=most,
        )  # fmt: skip

    def _further_probes(self) -> None:
        """At the vertex of the parabola through the row and the two probes; then through the three probes."""
        probes, row = self.probes, self.block.row
        (low, high), around = self.ends, self.around
        middle = self._at(1)
        if self.limited:
            self._root(1)
        vertex: Node
        for probe in range(3, PROBES + 1):
            points: list[Point] = [(self._at(index), self._value(index)) for index in range(probe - 3, probe)]
            if self.limited:  # over the root of the distance from a limit, as a part of the row's
                self._root(probe - 1)
                roots: list[Node] = [probes.cell(row + index, ROOT) for index in range(1, probe)]
                points = list(zip([al.ONE, *roots][-3:], (value for _, value in points), strict=True))
                vertex = formula("limit+(here-limit)*MAX(0,vertex)^IF(limit>0,2,1)", limit=self._limit_cell,
                                 here=self._at(0), vertex=vertex_of(points))  # fmt: skip
            else:
                vertex = vertex_of(points)
            place = formula(
                "MAX(IF(wraps>0,middle-1,MAX(low,middle-1)),MIN(IF(wraps>0,middle+1,MIN(high,middle+1)),vertex))",
                wraps=around, middle=middle, vertex=vertex, low=low, high=high,
            )  # fmt: skip
            # at the motion's first or last row the second probe is that row again: then between it and the first
            known = formula("(here+middle)/2", here=self._at(0), middle=middle) if probe == 3 else middle
            probes.work(row + probe, AT, "IFERROR(place,known)", place=place, known=known)

    # --- beside a limit ---------------------------------------------------------------------------------------

    @property
    def _limit_cell(self) -> CellRef:
        return self.probes.cell(self.block.row + 3, SIDE)

    def _limit(self) -> CellRef:
        """The limit beside the best row, where there is one, else a place before all."""
        (first, last), (low, high) = self.rows, self.ends
        return self.probes.work(
            self.block.row + 3, SIDE,
            "IF(wraps>0,before,IF(AND(here=first,low<first),low,IF(AND(here=last,high>last),high,before)))",
            wraps=self.around, here=self._at(0), first=first, last=last, low=low, high=high, before=BEFORE,
        )  # fmt: skip

    def _first_root(self) -> CellRef:
        """The place of the parabola's vertex through the limit, the row beside it and the next: no nearer to the limit than
        halfway (in w), no farther than the next row."""
        probes, row = self.probes, self.block.row
        here, limit = self._at(0), self._limit_cell
        at_low, at_high = (self._value(PROBES + index) for index in (1, 2))
        there = probes.work(row + 3, SIDE + 1, "IF(limit=low,at_low,at_high)", limit=limit, low=self.ends[0], at_low=at_low,
                            at_high=at_high)  # fmt: skip
        far = formula("ABS(here-limit)", here=here, limit=limit)
        root = formula(
            "IFERROR(((far+1)*rise-far*next)/(2*(SQRT(far+1)*rise-SQRT(far)*next)),0)", far=far,
            rise=formula("best-there", best=self._value(0), there=there),
            next=formula("next-there", next=probes.cell(row + 1, SIDE + 5), there=there),
        )  # fmt: skip
        return probes.work(row + 3, SIDE + 2, "limit+SIGN(here-limit)*MAX(far/4,MIN(far+1,MAX(0,root)^2))", limit=limit,
                           here=here, far=far, root=root)  # fmt: skip

    def _second_root(self) -> Node:
        """The same through the limit, the first probe and the row; some way off the limit in any case, so that something is
        learnt."""
        probes, row = self.probes, self.block.row
        here, limit, there = self._at(0), self._limit_cell, probes.cell(row + 3, SIDE + 1)
        root = formula(
            "((one-there)-w^2*(best-there))/(2*((one-there)-w*(best-there)))", w=probes.cell(row + 1, ROOT), there=there,
            one=self._value(1), best=self._value(0),
        )  # fmt: skip
        return formula(
            "limit+SIGN(here-limit)*MIN(far+1,far*IF(there=best,close,MAX(least,IFERROR(root,0)))^2)", limit=limit,
            here=here, root=root, far=formula("ABS(here-limit)", here=here, limit=limit), least=FROM_LIMIT, there=there,
            best=self._value(0), close=AT_LIMIT,
        )  # fmt: skip

    def _root(self, index: int) -> None:
        """The root of a probe's distance from the limit beside the best row, as a part of the row's; without limit the
        distance from a place before all."""
        self.probes.work(
            self.block.row + index, ROOT, "((place-limit)/(here-limit))^IF(limit>0,0.5,1)", limit=self._limit_cell,
            here=self._at(0), place=self._at(index),
        )  # fmt: skip


def neighbours(middle: Node, around: Node, rows: Node) -> tuple[Node, Node, Node]:
    """The numbers of a row and those beside it: the first row's neighbour is the last, where the motion goes around."""
    turned = formula("IF(wraps=1,rows-1,rows)", wraps=around, rows=rows)
    before, after = (
        formula(
            f"1+MOD(middle{sign}1-1,IF(wraps>0,turned,2*rows))", middle=middle, wraps=around, turned=turned, rows=rows
        )
        for sign in "-+"
    )
    return before, middle, after


def vertex_of(points: Sequence[Point]) -> Node:
    """Where the parabola through three points (u, y) has its vertex."""
    (one, y_one), (two, y_two), (three, y_three) = points
    return formula(
        "two-((two-one)^2*(y_two-y_three)-(two-three)^2*(y_two-y_one))"
        "/(2*((two-one)*(y_two-y_three)-(two-three)*(y_two-y_one)))",
        one=one, two=two, three=three, y_one=y_one, y_two=y_two, y_three=y_three,
    )  # fmt: skip

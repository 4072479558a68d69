"""Extremes of quantities whose derivatives by the driver are columns: where the first derivative changes sign.

Between the best row and the neighbour towards which the quantity still grows (s from 0 to 1) the place is read from the
derivative d by inverse Hermite interpolation, from d and its slope c by s at both rows, D = d1 - d0, t = -d0/D:

    s = t^2 (3 - 2 t) + t (1 - t)^2 D/c0 + t^2 (t - 1) D/c1

The second probe is one Newton step from there. Where no neighbour brackets the extreme, beside a limit, both are Newton
steps. Source: Brent, Algorithms for Minimization without Derivatives, 1973, chapter 4 (inverse interpolation).
"""

from __future__ import annotations

from collections.abc import Collection
from typing import Literal

from livesheet.formula.nodes import CellRef, Node, Symbol
from mechsheet.kinematics.rates.rate_columns import COEFFICIENTS
from mechsheet.model import Mechanism
from mechsheet.sheet.checks.probes import ALL_ROWS, AT, SIDE, Block, Probes
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import ALL, formula

PROBES = 2


def known(plan: Plan, symbol: str) -> bool:
    """Whether the workbook looks between its rows, and by the derivatives."""
    return not plan.rows_only and differentiated(plan.mechanism, {column.symbol for column in plan.rates}, symbol)


def differentiated(mechanism: Mechanism, rates: Collection[str], symbol: str) -> bool:
    """Whether both derivatives are columns, in rows that are equally far from each other in the driver's value."""
    return mechanism.driver.law is None and all(name in rates for name in derivatives(symbol))


def write(
    probes: Probes,
    block: Block,
    symbol: str,
    way: Literal["min", "max"],
    wraps: Node,
    rows: tuple[Node, Node],
    ends: tuple[Node, Node],
) -> Node:
    """The two probes; the best row stands in the block's anchor. Where one more would be.

    wraps  more than 0 where the ends of the rows are neighbours
    rows   first and last row of the stretch;  ends: the places where it begins and ends, between rows
    """
    plan, row = probes.plan, block.row
    once, twice = derivatives(symbol)
    probes.lay(block, [symbol, once, twice])
    here = probes.cell(row, AT)
    step = formula("RADIANS(_step)" if plan.mechanism.driver.unit.in_degrees else "_step")

    def by_rows(at: int, there: Node) -> list[CellRef]:
        """Both derivatives by the number of the row, in a row of the table."""
        return [
            probes.work(
                at, SIDE + work, f"INDEX(column,row_there)*step^{power}", column=Symbol(ALL + name), row_there=there,
                step=step,
            )
            for work, name, power in ((3, once, 1), (4, twice, 2))
        ]  # fmt: skip

    here_once, here_twice = by_rows(row + 1, here)
    side = probes.work(row + 1, SIDE + 5, f"IF(here_once{'>' if way == 'max' else '<'}0,1,-1)", here_once=here_once)
    there = probes.work(
        row + 1, SIDE + 6,
        "IF(wraps>0,1+MOD(here+side-1,IF(wraps=1,all-1,all)),MAX(first,MIN(last,here+side)))",
        wraps=wraps, here=here, side=side, all=ALL_ROWS, first=rows[0], last=rows[1],
    )  # fmt: skip
    there_once, there_twice = by_rows(row + 2, there)
    part = probes.work(
        row + 2, SIDE + 5, "IFERROR(here_once/(here_once-there_once),0)", here_once=here_once, there_once=there_once
    )
    hermite = formula(
        "t^2*(3-2*t)+side*t*(1-t)*change*((1-t)/here_twice-t/there_twice)", t=part, side=side, here_twice=here_twice,
        there_twice=there_twice, change=formula("there_once-here_once", there_once=there_once, here_once=here_once),
    )  # fmt: skip
    inverse = probes.work(row + 2, SIDE + 6, "IFERROR(hermite,t)", hermite=hermite, t=part)
    crossed = formula("AND(t>0,t<1)", t=part)
    first = probes.work(
        row + 1, AT, "IF(crossed,here+side*IF(AND(s>0,s<1),s,t),beside)", crossed=crossed, here=here, side=side,
        s=inverse, t=part, beside=_newton(here, here, here_once, here_twice, wraps, ends),
    )  # fmt: skip

    def from_probe(at: Node, index: int) -> Node:
        """One Newton step from a probe."""
        cells = [CellRef(row + index, probes.at.spots[name].col, True, True) for name in (once, twice)]
        rates = [formula(f"cell*step^{power}", cell=cell, step=step) for power, cell in enumerate(cells, 1)]
        return _newton(at, here, rates[0], rates[1], wraps, ends)

    second = probes.work(row + 2, AT, "place", place=from_probe(first, 1))
    return from_probe(second, 2)


def derivatives(symbol: str) -> tuple[str, str]:
    """The names of a quantity's first and second derivative by the driver."""
    once, twice = COEFFICIENTS
    return symbol + once, symbol + twice


def _newton(at: Node, here: Node, once: Node, twice: Node, wraps: Node, ends: tuple[Node, Node]) -> Node:
    """A step from a place, no farther than a row from the best one, and not beyond a limit; none at a dead centre."""
    step = formula("MAX(here-1,MIN(here+1,at-once/twice))", here=here, at=at, once=once, twice=twice)
    return formula("IFERROR(IF(wraps>0,step,MAX(low,MIN(high,step))),at)", wraps=wraps, step=step, at=at, low=ends[0],
                   high=ends[1])  # fmt: skip

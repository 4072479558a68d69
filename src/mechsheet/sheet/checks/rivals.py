"""Rows that may have more beside them than what was found: probes look for an extreme beside the best row only.

Beside a row that is better than both its neighbours a parabola has at most an eighth of the second difference more than in
the row; twice that is asked about, since a quantity may be steeper. A row that is as good as the best one, as in a motion
that is symmetrical, is its twin and has the same beside it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from livesheet.formula.nodes import CellRef, Node, RangeRef, Symbol
from mechsheet.sheet.checks.parabolas import DIFFERENCES
from mechsheet.sheet.checks.probes import ALL_ROWS, Probes
from mechsheet.sheet.quoted import ALL, formula

COUNT = DIFFERENCES + 3
"""Working cells: how many rivals there are of all rows; where not all close, above the best row, and below it; at the
first row, and beside that at the last."""

FROM, TO, PROMISE, TWIN = range(COUNT + 1, COUNT + 5)
"""Beside them: from which to which row of a part they are looked for; what a row must promise, and below it what is before
the first and behind the last row; up to which value a row is no twin of the best one."""


FAR = "(ABS(number+1-here)>1)*(ABS(number+1-again)>1)"
"""Whether rows, numbered from 0, are no neighbours of the one `here`, nor of `AGAIN`."""

AGAIN = "IF(AND(wraps=1,here=1),rows,IF(AND(wraps=1,here=rows),1,here))"
"""The row at the other end of a closed turn that is the same one."""


def peak(more: str) -> str:
    """Whether rows are better than both their neighbours; `more`, as below, is the sign of what is better."""
    return f"(own{more}=before)*(own{more}=after)"


def promises(more: str, less: str) -> str:
    """Whether they promise more than what was found, and are no twins."""
    return f"(own{less}twin)*(1.5*own-(before+after)/4{more}promise)"


OUTSIDE = "IF(wraps=0,3*(own-after)+third,IF(wraps=1,near,far))"
"""What is before the first row, or behind the last: beyond the other end (its own row, and the one beside it), or on the
parabola through the three rows there."""


def at_end(more: str, less: str) -> str:
    """1 where the row at an end is a rival, which `here` is not beside, from this end or the other (rows `end`, `other`)."""
    peak = f"AND(own{more}=outside,own{more}=after,own{less}twin,1.5*own-(outside+after)/4{more}promise)"
    return f"IF(AND(ABS(here-end)>1,OR(wraps=0,ABS(here-other)>1),{peak}),1,0)"


def write(
    probes: Probes, row: int, way: str, symbol: str, span: tuple[Node, Node], wraps: Node, found: Node, allowed: Node,
    here: Node, most: Node,
) -> None:  # fmt: skip
    """The cells beside a block of probes, from its anchor's row on.

    span   the first and the last row;  wraps: 1, 2 where these are neighbours (one row twice, or not), else 0
    found  what is given;  allowed: by so much more is nothing
    here   the row that probes have begun from;  most: the best of the rows
    """
    more, less, plus, minus = (">", "<", "+", "-") if way == "max" else ("<", ">", "-", "+")
    promise = probes.work(row, PROMISE, f"found{plus}allowed", found=found, allowed=allowed)
    twin = probes.work(row, TWIN, f"most{minus}allowed", most=most, allowed=allowed)
    ends = {"here": here, "first": span[0], "last": span[1], "wraps": wraps}
    limits = {"promise": promise, "twin": twin}
    column = Symbol(ALL + symbol)
    before, own, after = (_part(probes, symbol, offset) for offset in (0, 1, 2))
    number = _part(probes, "#number", 1)
    again = probes.work(row, FROM, AGAIN, rows=ALL_ROWS, **ends)
    probes.work(
        # rows that are inserted beside the first or last two are not in all three
        row, COUNT, f"IFERROR(SUMPRODUCT({FAR}*{peak(more)}*{promises(more, less)}),IF(ROWS(before)=ROWS(after),0,1))",
        own=own, before=before, after=after,
        number=number, again=again, here=here, **limits,
    )  # fmt: skip
    for index, texts in enumerate((("first+1", "here-2"), ("here+2", "last-1")), 1):
        start, end = (probes.work(row + index, at, text, **ends) for at, text in zip((FROM, TO), texts, strict=True))
        part = {
            name: formula(f"INDEX(column,start{away}):INDEX(column,end{away})", column=column, start=start, end=end)
            for name, away in (("own", ""), ("before", "-1"), ("after", "+1"))
        }
        whole = formula("last-first+1=rows", rows=ALL_ROWS, **ends)
        probes.work(
            row + index, COUNT, f"IF(OR(whole,start>end),0,SUMPRODUCT({promises(more, less)}))", whole=whole, start=start,
            end=end, **part, **limits,
        )  # fmt: skip
    test = at_end(more, less)
    for at, count in ((PROMISE, COUNT), (TWIN, FROM)):
        probes.work(row + 3, count, "rival", rival=_end(probes, row + 1, at, column, ends, test, limits))


def there_are(probes: Probes, row: int) -> Node:
    """Whether there is one."""
    return formula("SUM(counts)+last>0", counts=probes.cells_down(row, COUNT, 4), last=probes.cell(row + 3, FROM))


def _part(probes: Probes, symbol: str, offset: int) -> RangeRef:
    """The rows of a column that are first, second or third (from 0) of three neighbours."""
    plan = probes.plan
    spot = plan.at.spots[symbol]
    start = CellRef(plan.at.first + offset, spot.col, True, True, spot.sheet)
    return RangeRef(start, replace(start, row=plan.at.last - 2 + offset))


def _end(
    probes: Probes, row: int, at: int, column: Node, ends: dict[str, Node], test: str, limits: Mapping[str, Node]
) -> Node:
    """Whether the first row (at `PROMISE`), or the last one, is a rival."""
    end, other, inward, back = ("first", "last", "+", "-") if at == PROMISE else ("last", "first", "-", "+")
    places = {
        "own": end,
        "after": f"{end}{inward}1",
        "third": f"{end}{inward}2",
        "far": other,
        "near": f"{other}{back}1",
    }
    y = {name: formula(f"INDEX(column,{place})", column=column, **ends) for name, place in places.items()}
    outside = probes.work(row, at, OUTSIDE, wraps=ends["wraps"], **y)
    return formula(test, here=ends["here"], end=ends[end], other=ends[other], wraps=ends["wraps"], outside=outside,
                   own=y["own"], after=y["after"], **limits)  # fmt: skip

"""Rows that may have more beside them than what was found: a search looks for an extreme beside the best row only.

Beside a row that is better than both its neighbours a parabola has at most an eighth of the second difference more than in
the row; twice that is asked about, since a quantity may be steeper. A row that is as good as the best one, as in a motion
that is symmetrical, is its twin and has the same beside it.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from livesheet.formula.nodes import CellRef, Node, RangeRef, Symbol
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.checks.search_table import SearchTable
from mechsheet.sheet.places import there
from mechsheet.sheet.quoted import ALL, formula

COUNT = 0
"""Working cells: how many rivals there are of all rows; where not all close, above the best row, and below it; at the
first row, and beside that at the last, and whether rows were inserted where nobody looks."""

FROM, TO, PROMISE, TWIN = range(COUNT + 1, COUNT + 5)
"""Beside it: from which to which row of a part they are looked for; what a row must promise, and below it what is before
the first and behind the last row; up to which value a row is no twin of the best one."""


FAR = "(ABS(number+1-here)>1)*(ABS(number+1-again)>1)"
"""Whether rows, numbered from 0, are no neighbours of the one `here`, nor of `AGAIN`."""

AGAIN = "IF(AND(wraps=1,here=1),rows,IF(AND(wraps=1,here=rows),1,here))"
"""The row at the other end of a closed turn that is the same one."""


PEAK = "(sense*own<=sense*before)*(sense*own<=sense*after)"
"""Whether rows are better than both their neighbours; `sense` is 1 where the least is sought, -1 where the largest."""

PROMISES = "(sense*own>sense*twin)*(sense*(1.5*own-(before+after)/4)<sense*promise)"
"""Whether they promise more than what was found, and are no twins."""


OUTSIDE = "IF(wraps=0,3*(own-after)+third,IF(wraps=1,near,far))"
"""What is before the first row, or behind the last: beyond the other end (its own row, and the one beside it), or on the
parabola through the three rows there."""


AT_END = (
    "IF(AND(ABS(here-end)>1,OR(wraps=0,ABS(here-other)>1),sense*own<=sense*outside,sense*own<=sense*after,"
    "sense*own>sense*twin,sense*(1.5*own-(outside+after)/4)<sense*promise),1,0)"
)
"""1 where the row at an end is a rival, which `here` is not beside, from this end or the other (rows `end`, `other`)."""


def write(
    table: SearchTable, row: int, at: int, sense: Node, symbol: str, span: tuple[Node, Node], wraps: Node, found: Node,
    allowed: Node, here: Node, most: Node,
) -> None:  # fmt: skip
    """The cells beside a search, from its first row on.

    at     the first of their working columns
    span   the first and the last row;  wraps: 1, 2 where these are neighbours (one row twice, or not), else 0
    found  what is given;  allowed: by so much more is nothing
    here   the row that the search has begun from;  most: the best of the rows
    """
    promise = table.work(row, at + PROMISE, "found-sense*allowed", found=found, sense=sense, allowed=allowed)
    twin = table.work(row, at + TWIN, "most+sense*allowed", most=most, sense=sense, allowed=allowed)
    ends = {"here": here, "first": span[0], "last": span[1], "wraps": wraps}
    limits = {"promise": promise, "twin": twin, "sense": sense}
    column = Symbol(ALL + symbol)
    before, own, after = (_part(table, table.plan.at.spots[symbol], offset) for offset in (0, 1, 2))
    number = _part(table, there(table.plan.places.number), 1)
    again = table.work(row, at + FROM, AGAIN, rows=table.rows, **ends)
    table.work(
        row, at + COUNT, f"IFERROR(SUMPRODUCT({FAR}*{PEAK}*{PROMISES}),0)", own=own, before=before, after=after,
        number=number, again=again, here=here, **limits,
    )  # fmt: skip
    # rows that are inserted beside the first or last two are not in all three
    table.work(row + 3, at + TO, "IF(ROWS(before)=ROWS(after),0,1)", before=before, after=after)
    for index, (begin, further, until) in enumerate((("first", "+1", "here-2"), ("here", "+2", "last-1")), 1):
        # where all rows close, there is no part of them
        begin = f"IF(last-first+1=rows,rows,{begin}){further}"
        start = table.work(row + index, at + FROM, begin, rows=table.rows, **ends)
        end = table.work(row + index, at + TO, until, **ends)
        part = {
            name: formula(f"INDEX(column,start{away}):INDEX(column,end{away})", column=column, start=start, end=end)
            for name, away in (("own", ""), ("before", "-1"), ("after", "+1"))
        }
        table.work(
            row + index, at + COUNT, f"IF(start>end,0,SUMPRODUCT({PROMISES}))", start=start, end=end, **part, **limits
        )
    for work, count in ((PROMISE, COUNT), (TWIN, FROM)):
        rival = _end(table, (row + 1, at + work), work, column, ends, limits)
        table.work(row + 3, at + count, "rival", rival=rival)


def there_are(table: SearchTable, row: int, at: int) -> Node:
    """Whether there is one."""
    counts = RangeRef(table.near(row, at + COUNT), table.near(row + 3, at + COUNT))
    last = RangeRef(table.near(row + 3, at + FROM), table.near(row + 3, at + TO))
    return formula("SUM(counts,last)>0", counts=counts, last=last)


def _part(table: SearchTable, spot: Spot, offset: int) -> RangeRef:
    """The rows of a column that are first, second or third (from 0) of three neighbours."""
    plan = table.plan
    start = CellRef(plan.at.first + offset, spot.col, True, True, spot.sheet)
    return RangeRef(start, replace(start, row=plan.at.last - 2 + offset))


def _end(
    table: SearchTable,
    cell: tuple[int, int],
    way: int,
    column: Node,
    ends: dict[str, Node],
    limits: Mapping[str, Node],
) -> Node:
    """Whether the first row (at `PROMISE`), or the last one, is a rival."""
    end, other, inward, back = ("first", "last", "+", "-") if way == PROMISE else ("last", "first", "-", "+")
    places = {
        "own": end,
        "after": f"{end}{inward}1",
        "third": f"{end}{inward}2",
        "far": other,
        "near": f"{other}{back}1",
    }
    y = {name: formula(f"INDEX(column,{place})", column=column, **ends) for name, place in places.items()}
    outside = table.work(*cell, OUTSIDE, wraps=ends["wraps"], **y)
    return formula(AT_END, here=ends["here"], end=ends[end], other=ends[other], wraps=ends["wraps"], outside=outside,
                   own=y["own"], after=y["after"], **limits)  # fmt: skip

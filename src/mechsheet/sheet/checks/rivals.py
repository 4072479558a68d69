"""Rows that may have more beside them than what was found: a search looks for an extreme beside the best row only.

Beside a row that is better than both its neighbours a parabola has at most an eighth of the second difference more than in
the row; twice that is asked about, since a quantity may be steeper. A row that is as good as the best one, as in a motion
that is symmetrical, is its twin and has the same beside it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from functools import reduce

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, RangeRef, Symbol, with_symbols
from mechsheet.sheet.addresses import Spot
from mechsheet.sheet.checks.search_rules import OFFER, SETTLED
from mechsheet.sheet.checks.search_table import SearchTable
from mechsheet.sheet.places import there
from mechsheet.sheet.quoted import ALL, formula

COUNT, PARTS, PROMISE, TWIN, OTHER_END = 0, (1, 4), 7, 8, 9
"""Working cells: how many rivals there are of all rows, and below it whether the first row is one, whether the last is, and
whether rows were inserted where nobody looks. Where not all rows close, of the rows before the best one and of those behind
it: from which to which row they are looked for, and how many there are. What a row must promise, and up to which value it is
no twin of the best one; below these what is before the first and behind the last row, and in these; `AGAIN`."""


AGAIN = formula("IF(AND(wraps=1,here=1),rows,IF(AND(wraps=1,here=rows),1,here))")
"""The row at the other end of a closed turn that is the same one as `here`, from which a search begins."""

FAR = (formula("ABS(number+1-here)>1"), formula("ABS(number+1-again)>1"))
"""Whether rows, numbered from 0, are no neighbours of either."""

PEAK = (formula("sense*own<=sense*before"), formula("sense*own<=sense*after"))
"""Whether rows are better than both their neighbours; `sense` is 1 where the least is sought, -1 where the largest."""

NO_TWIN = formula("sense*own>sense*twin")
TWIN_BELOW = formula("of_rows+sense*allowed")
"""Whether they are no twins of the best row."""

MORE = formula("sense*offer<sense*promise")
PROMISE_BEYOND = formula("found-sense*allowed")
"""Whether that is more than what was found."""

ALLOWED = formula("settled*ABS(of_rows-other)", settled=SETTLED)
"""By so much more is nothing: `of_rows` and `other` are the best and the worst of the rows."""

OUTSIDE = formula("IF(wraps=0,3*(own-after)+third,IF(wraps=1,near,far))")
"""What is before the first row, or behind the last: beyond the other end (its own row, and the one beside it), or on the
parabola through the three rows there."""

AT_END = (
    *(formula(text) for text in ("ABS(here-end)>1", "OR(wraps=0,ABS(here-other_end)>1)")),
    *(formula(text) for text in ("sense*own<=sense*outside", "sense*own<=sense*after")),
    NO_TWIN,
)
"""Whether the row at an end is a peak which `here` is not beside, from this end or the other, and no twin."""

_PROMISES = (NO_TWIN, with_symbols(MORE, {"offer": OFFER}))
RIVALS, OF_PART = reduce(al.mul, (*FAR, *PEAK, *_PROMISES)), reduce(al.mul, _PROMISES)
RIVAL_AT_END = formula(
    "IF(all,1,0)", all=Call("AND", (*AT_END, with_symbols(_PROMISES[1], {"before": Symbol("outside")})))
)
"""Of rows, of those of a part of the table, and of one at an end: 1 where they are rivals."""


def write(table: SearchTable, row: int, at: int, symbol: str, known: Mapping[str, Node]) -> None:
    """The cells beside a search, from its first row on.

    at     the first of their working columns
    known  what the search's rules read, and what is given (`found`)
    """
    known = {**known, "allowed": with_symbols(ALLOWED, known)}
    promise, twin = (
        table.work(row, at + work, "value", value=with_symbols(tree, known))
        for work, tree in ((PROMISE, PROMISE_BEYOND), (TWIN, TWIN_BELOW))
    )
    ends = {name: known[name] for name in ("here", "first", "last", "wraps")}
    limits = {"promise": promise, "twin": twin, "sense": known["sense"]}
    column = Symbol(ALL + symbol)
    before, own, after = (_part(table, table.plan.at.spots[symbol], offset) for offset in (0, 1, 2))
    number = _part(table, there(table.plan.places.number), 1)
    again = table.work(row, at + OTHER_END, "again", again=with_symbols(AGAIN, ends | {"rows": table.rows}))
    columns: dict[str, Node] = {"own": own, "before": before, "after": after, "number": number, "again": again}
    rivals = with_symbols(RIVALS, ends | limits | columns)
    table.work(row, at + COUNT, "IFERROR(SUMPRODUCT(rivals),0)", rivals=rivals)
    for below, way in enumerate((PROMISE, TWIN), 1):
        rival = _end(table, (row + 1, at + way), way, lambda place: table.in_row(symbol, row, place), ends, limits)
        table.work(row + below, at + COUNT, "rival", rival=rival)
    # rows that are inserted beside the first or last two are not in all three, of no column of its table
    before, after = (_part(table, table.plan.at.spots[table.first_beside(symbol)], offset) for offset in (0, 2))
    table.work(row + 3, at + COUNT, "IF(ROWS(before)=ROWS(after),0,1)", before=before, after=after)
    for work, begin, until in zip(PARTS, ("first", "here"), ("here-2", "last-1"), strict=True):
        # where all rows close, there is no part of them
        begin = f"IF(last-first+1=rows,rows,{begin}){'+1' if begin == 'first' else '+2'}"
        edges = (
            table.work(row, at + work, begin, rows=table.rows, **ends),
            table.work(row, at + work + 1, until, **ends),
        )
        start, end = (replace(cell, col_abs=False) for cell in edges)
        part = {  # three times each: by its own column, which is shorter
            name: formula(f"INDEX(column,start{away}):INDEX(column,end{away})", column=column, start=start, end=end)
            for name, away in (("own", ""), ("before", "-1"), ("after", "+1"))
        }
        rivals = with_symbols(OF_PART, limits | part)
        table.work(row, at + work + 2, "IF(start>end,0,SUMPRODUCT(rivals))", start=start, end=end, rivals=rivals)


def there_are(table: SearchTable, row: int, at: int) -> Node:
    """Whether there is one."""
    counts = RangeRef(table.near(row, at + COUNT), table.near(row + 3, at + COUNT))
    earlier, later = (table.near(row, at + work + 2) for work in PARTS)
    return formula("SUM(counts,earlier,later)>0", counts=counts, earlier=earlier, later=later)


def _part(table: SearchTable, spot: Spot, offset: int) -> RangeRef:
    """The rows of a column that are first, second or third (from 0) of three neighbours."""
    plan = table.plan
    start = CellRef(plan.at.first + offset, spot.col, True, True, spot.sheet)
    return RangeRef(start, replace(start, row=plan.at.last - 2 + offset))


def _end(
    table: SearchTable,
    cell: tuple[int, int],
    way: int,
    in_row: Callable[[Node], Node],
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
    y = {name: in_row(formula(place, **ends)) for name, place in places.items()}
    y["own"] = table.work(cell[0] + 1, cell[1], "own", own=y["own"])
    known = {**ends, **limits, **y, "end": ends[end], "other_end": ends[other]}
    outside = table.work(*cell, "outside", outside=with_symbols(OUTSIDE, known))
    return with_symbols(RIVAL_AT_END, known | {"outside": outside})

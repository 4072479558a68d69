"""One number of a whole column that leaves out rows without a value."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, CellRef, Node, Number, RangeRef, Symbol, Text, with_symbols
from mechsheet.kinematics.whole_turns import SAME_AGAIN, Change
from mechsheet.model import Driver
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula, joined
from mechsheet.units import Unit, turn

LEAST, MOST = "MINIFS", "MAXIFS"

NUMBERS = "<1E+300"
"""What numbers are, and errors are not: rows without a position are left out."""


ENDS = {
    "first": 'INDEX(column,SUMPRODUCT(MATCH(TRUE,column<>"",0)))',
    "last": 'LOOKUP(2,1/(column<>""),column)',
}
"""The first and the last number of a column in which errors stand above, between and below: an error stays one in the
comparison, and is passed over. gnumeric knows no ISNUMBER of many cells, LibreOffice no LOOKUP among errors as they are."""


def over_rows(function: str, column: Node, *besides: Node) -> Node:
    """The least or the largest of the numbers of a column, of rows in which those `besides` say nothing."""
    tests = (column, Text(NUMBERS), *(part for each in besides for part in (each, Text(""))))
    return Call(function, (column, *tests))


AS_LARGE = 1e-9
"""Two numbers that differ by so small a part are as large: the rest is rounding, which no two programs do alike."""


def as_large_as(size: Node) -> Node:
    """From which number on one is as large as `size`, which is not below 0."""
    return al.mul(size, al.number(1 - AS_LARGE))


def largest_size(most: Node, least: Node) -> Node:
    """The largest size of numbers of either sign, by the largest and the least of them."""
    return formula("MAX(most,-(least))", most=most, least=least)


def largest_size_in(cells: Node) -> Node:
    """The largest size of numbers of either sign in cells that hold no errors."""
    return largest_size(Call("MAX", (cells,)), Call("MIN", (cells,)))


def row_of_size(column: Node, size: Node) -> Node:
    """The number of the first row whose number, of either sign, is as large as `size`, the largest of the column."""
    least = as_large_as(size)
    return formula("SUMPRODUCT(MATCH(1,(column>=least)+(column<=-(least)),0))", column=column, least=least)


Test = tuple[RangeRef, str]
"""A column beside the one a number is taken of, and what stands there in rows that count."""


def mean_of_motion(
    driver: Driver, column: RangeRef, tests: Sequence[Test], turns: Node | None, headed: bool = True
) -> Node:
    """The mean of a column over the motion: by the trapezoidal rule between neighbouring rows that both count.

    So the row that closes a turn is not counted twice. All rows count alike where the driver's values are listed, where no
    two that count are neighbours, and where the rows are a whole turn without the one that closes it.

    tests   what rows that count have beside the column;  turns: whether they are such a turn; None where they cannot be
    headed  whether a text stands above the columns
    """
    if driver.values or column.start.row == column.end.row:
        return _alike(column, tests)
    neighbours, alike = both_means(column, tests, headed)
    if turns is not None:
        neighbours = formula("IF(turns,NA(),mean)", turns=turns, mean=neighbours)
    return formula("IFERROR(neighbours,alike)", neighbours=neighbours, alike=alike)


def both_means(column: RangeRef, tests: Sequence[Test], headed: bool = True) -> tuple[Node, Node]:
    """The mean by the trapezoidal rule, an error where no two rows that count are neighbours; and that in which all rows
    count alike."""
    upper, lower = _halves(column, headed)
    both = tuple(part for each, text in tests for half in _halves(each, headed) for part in (half, Text(text)))
    mean = formula("(one+other)/2", one=Call("AVERAGEIFS", (upper, *both)), other=Call("AVERAGEIFS", (lower, *both)))
    # rows that are inserted above the first or beside the last one are in one half only
    alike = formula("IF(ROWS(upper)=ROWS(lower),alike,NA())", alike=_alike(column, tests), upper=upper, lower=lower)
    return mean, alike


def _alike(column: RangeRef, tests: Sequence[Test]) -> Node:
    return Call("AVERAGEIFS", (column, *(part for each, text in tests for part in (each, Text(text)))))


def torn(driver: Driver, column: RangeRef) -> Node | None:
    """Whether rows were inserted beside the first or the last of a table: then the two halves by which a mean is taken are
    not alike, and there is none. None where it is not taken so."""
    if driver.values or column.start.row == column.end.row:
        return None
    upper, lower = _halves(column, headed=True)
    return formula("ROWS(upper)<>ROWS(lower)", upper=upper, lower=lower)


def with_torn(plan: Plan, words: Node | str, column: RangeRef) -> Node | str:
    """Words of a mean, which say why there is none where rows were inserted at an end of the table."""
    test = torn(plan.mechanism.driver, column)
    return (
        words if test is None else joined(words, formula('IF(torn,said,"")', torn=test, said=plan.text("summary.torn")))
    )


def stretches_of(column: RangeRef, besides: Sequence[RangeRef]) -> Node:
    """How many stretches of rows a column has numbers in, where those `besides` say nothing: rows that begin one."""
    tests = ((column, Text(NUMBERS)), *((each, Text("")) for each in besides))
    every = tuple(part for test in tests for part in test)
    both = tuple(part for each, text in tests for half in _halves(each, True) for part in (half, text))
    return formula("here-(with_before)", here=Call("COUNTIFS", every), with_before=Call("COUNTIFS", both))


def mean_of_rows(plan: Plan, symbol: str, sheet: str) -> Node:
    """That of a column of the tables, over rows in which the mechanism closes, for a formula on a sheet."""
    found = plan.searched.means.get(symbol)
    if found is not None:
        turns = formula("AND(whole=2,closed=rows)", whole=plan.searched.whole.cell, closed=plan.places.closed.cell,
                        rows=plan.places.rows.cell)  # fmt: skip
        neighbours, alike = (each.cell for each in found)
        return formula("IFERROR(IF(turns,alike,neighbours),alike)", turns=turns, neighbours=neighbours, alike=alike)
    return mean_of_motion(plan.mechanism.driver, plan.at.column(symbol, sheet), rows_that_close(plan, sheet), None)


def rows_that_close(plan: Plan, sheet: str) -> list[Test]:
    """What rows have in which the mechanism closes, for a formula on a sheet."""
    return [(plan.places.status.whole(sheet), plan.text("status.ok"))]


def first_row(plan: Plan) -> Node:
    """The first row in which the mechanism closes, counted from 1."""
    return plan.searched.stretches[0].first.cell


def last_row(plan: Plan) -> Node:
    """The last one: of every stretch in one range, so that it reads back as it was written."""
    first, last = (plan.searched.stretches[at].last for at in (0, -1))
    ends = (CellRef(spot.row, spot.col, True, True, spot.sheet) for spot in (first, last))
    return formula("MAX(rows)", rows=RangeRef(*ends))


END_ROWS = {"first": first_row, "last": last_row}
"""Where the parts of takes that are values of one row are found."""


def may_leave_out(plan: Plan) -> bool:
    """Whether rows may be a whole turn without the one that closes it: the driver turns by steps, and no gear is on its
    way."""
    driver, tied = plan.mechanism.driver, plan.equations.equations.tied
    return bool(driver.link) and not driver.values and driver.law is None and not tied


def meeting(change: Change, unit: Unit) -> Node:
    """Whether the rows at the ends of whole turns are neighbours for a quantity: it comes back with the mechanism.

    An angle may have gone on by a turn. What reads an angle otherwise than through sines comes back or not, as its rows say;
    where the last is left out they cannot, and the quantity ends with them.

    A tree over the quantity at the `start` and at the `end`, `half` a turn, the `span` of its rows, and what the rows cover,
    `whole`.
    """
    if change == "nothing":
        return formula("TRUE")
    if change == "turns" and unit.kind == "angle" and not unit.per:
        return formula("ABS(start-end)<half")
    return formula("AND(whole=1,ABS(start-end)<=same*span)", same=SAME_AGAIN)


def ends_meet(plan: Plan, symbol: str, unit: Unit, column: Node, ends: tuple[Node, Node]) -> Node:
    """The same over cells: a column, and its values at the ends."""
    half, span = turn(plan.at.spots[symbol].degrees) / 2.0, formula("MAX(column)-MIN(column)", column=column)
    known = {"start": ends[0], "end": ends[1], "half": Number(half), "span": span, "whole": plan.searched.whole.cell}
    return with_symbols(meeting(plan.periods.change(symbol), unit), known)


def whole_turns(by_law: bool, tied: bool) -> Node:
    """What the rows cover: 1 for whole turns whose last row is the first again, 2 where that row is left out, else 0.

    A tree over how many turns the rows cover (`covered`), and would with one row more (`more`); by_law: in time. Where gears
    or further drivers are on the way (tied), `back` says whether what they decide is in the last row what it was before.
    """
    is_whole = {name: formula("ABS(ROUND(turns,0)-turns)<1E-9", turns=Symbol(name)) for name in ("covered", "more")}
    if tied:
        return formula("IF(AND(covers,ROUND(covered,0)>0),IFERROR(IF(back,1,0),0),0)", covers=is_whole["covered"])
    if by_law:
        return formula("IF(AND(covered>0.5,covers),1,0)", covers=is_whole["covered"])
    return formula("IF(covers,IF(ROUND(covered,0)>0,1,0),IF(misses,2,0))", covers=is_whole["covered"],
                   misses=is_whole["more"])  # fmt: skip


def is_back(angle: bool) -> Node:
    """Whether a quantity is in the `last` row what it was in the `first`: an angle but for whole turns, else in parts of the
    mechanism's `size`."""
    if angle:
        return formula("ABS(ROUND(way,0)-way)<1E-9", way=formula("(last-first)/turn"))
    return formula("ABS(last-first)<1E-9*size")


def _halves(column: RangeRef, headed: bool) -> tuple[RangeRef, RangeRef]:
    """The row before each, and each: from the heading on, which is no number, so that both begin above rows that are
    inserted below the first; else all rows but the last, and all but the first."""
    start, end = (replace(cell, row=cell.row - 1) for cell in (column.start, column.end))
    if headed:
        return RangeRef(start, end), column
    return replace(column, end=end), replace(column, start=replace(column.start, row=column.start.row + 1))


def but_last(column: RangeRef) -> Node:
    """All rows but the last, wherever rows are inserted."""
    return formula("INDEX(column,1):INDEX(column,ROWS(column)-1)", column=column)


def but_first(column: RangeRef) -> Node:
    """All rows but the first."""
    return formula("INDEX(column,2):INDEX(column,ROWS(column))", column=column)


def at_end(end: str, column: Node, *besides: Node) -> Node:
    """The "first" or the "last" number of a column, of rows in which those `besides` say nothing."""
    if not besides:
        return formula(ENDS[end], column=column)
    filled = formula('column<>""', column=column)
    for each in besides:
        filled = formula('filled*(each="")', filled=filled, each=each)
    pattern = {"first": "INDEX(column,SUMPRODUCT(MATCH(1,filled,0)))", "last": "LOOKUP(2,1/filled,column)"}[end]
    return formula(pattern, column=column, filled=filled)

"""One number of a whole column that leaves out rows without a value."""

from __future__ import annotations

from mechsheet.formula.nodes import Call, Node, Text
from mechsheet.sheet.quoted import formula

LEAST, MOST, MEAN = "MINIFS", "MAXIFS", "AVERAGEIF"

NUMBERS = "<1E+300"
"""What numbers are, and errors are not: rows without a position are left out."""


ENDS = {
    "first": 'INDEX(column,SUMPRODUCT(MATCH(TRUE,column<>"",0)))',
    "last": 'LOOKUP(2,1/(column<>""),column)',
}
"""The first and the last number of a column in which errors stand above, between and below: an error stays one in the
comparison, and is passed over. gnumeric knows no ISNUMBER of many cells, LibreOffice no LOOKUP among errors as they are."""


def over_rows(function: str, column: Node, *besides: Node) -> Node:
    """The least, the largest or the mean of the numbers of a column, of rows in which those `besides` have numbers too."""
    tests = tuple(part for each in (column, *besides) for part in (each, Text(NUMBERS)))
    if function == MEAN:
        if besides:
            return Call("AVERAGEIFS", (column, *tests))
        return formula("AVERAGEIF(column,numbers)", column=column, numbers=NUMBERS)
    return Call(function, (column, *tests))


def at_end(end: str, column: Node, *besides: Node) -> Node:
    """The "first" or the "last" number of a column, of rows in which those `besides` have numbers too."""
    if not besides:
        return formula(ENDS[end], column=column)
    filled = formula('column<>""', column=column)
    for each in besides:
        filled = formula('filled*(each<>"")', filled=filled, each=each)
    pattern = {"first": "INDEX(column,SUMPRODUCT(MATCH(1,filled,0)))", "last": "LOOKUP(2,1/filled,column)"}[end]
    return formula(pattern, column=column, filled=filled)

"""Cells that only say where something is: of rows that are equal up to rounding, each program may name another one."""

from __future__ import annotations

import math
from typing import Any

from livesheet.formula.nodes import Call, CellRef, Node, Number, RangeRef, Scalar, walk
from mechsheet.checking.report import TOLERANCE, difference


def names_an_equal_row(formula: Node, sheet: str, values: Any, theirs: Scalar, scale: float) -> bool:
    """Whether `theirs` is a right answer of `formula`, which has INDEX(places; MATCH(sought; column; 0)) in it.

    It is when it stands in `places` beside a value of `column` that is what is sought, to the tolerance. `values` are
    the engine's; `scale` is the length that counts as one.
    """
    for part in walk(formula):
        match part:
            case Call("INDEX", (RangeRef() as places, Call("MATCH", (sought, RangeRef() as column, Number(0.0))))):
                target = _value(sought, sheet, values)
                pairs = zip(_column(places, sheet, values), _column(column, sheet, values), strict=False)
                if isinstance(target, float) and any(
                    isinstance(found, float)
                    and difference(found, target, scale) <= TOLERANCE
                    and difference(place, theirs) <= TOLERANCE
                    for place, found in pairs
                ):
                    return True
    return False


def _value(node: Node, sheet: str, values: Any) -> Scalar:
    """What is sought: a cell, or the extreme of a column."""
    match node:
        case CellRef(row, col, _, _, other):
            found: Scalar = values.get(other or sheet, row, col)
            return found
        case Call("MAX" | "MIN" as name, (RangeRef() as area,)):
            numbers = [value for value in _column(area, sheet, values) if isinstance(value, float)]
            return (max if name == "MAX" else min)(numbers, default=math.nan)
        case _:
            return None


def _column(area: RangeRef, sheet: str, values: Any) -> list[Scalar]:
    if area.start.col != area.end.col:
        return []
    found: list[Scalar] = values.column(area.start.sheet or sheet, area.start.col, area.start.row, area.end.row)
    return found

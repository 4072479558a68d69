"""Every formula's value against somebody else's, cell by cell."""

from __future__ import annotations

import math
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, Literal

from livesheet.formula.book import Book
from livesheet.formula.nodes import ErrorValue, Scalar, shifted
from livesheet.formula.references import cell_address
from mechsheet.checking.excuses.cells import EqualRows
from mechsheet.checking.report import Comparison, Tally, difference
from mechsheet.checking.rules import Rules, ignored_in
from mechsheet.kinematics.dimensions import is_length
from mechsheet.sheet.asked.requested import tables_of
from mechsheet.sheet.plan import Plan
from mechsheet.units import turn

Compared = Literal["value", "error", "nothing"]


@dataclass(frozen=True, slots=True)
class Angles:
    """Where a mechanism's workbook holds angles, as (sheet, column) -> period, and counts of turns (period 1).

    ATAN2(-1, 0) is pi or -pi by the sign of a rounding error: programs may differ by a turn there, and in the count of
    turns that makes up for it. `size` is the mechanism's: lengths far smaller than 1 are compared on their own scale.
    """

    periods: Mapping[tuple[str, int], float] = field(default_factory=dict)
    size: float = 1.0


def angles_in(plan: Plan) -> Angles:
    """The angles of a mechanism's workbook."""
    periods = {}
    for column in plan.columns:
        if column.equation is None:
            continue
        if column.equation.unit.kind == "angle":
            periods[plan.table, column.col] = turn(plan.at.spots[column.symbol].degrees)
    # a table's angle before it goes on from the cell above: of atan2(0, -1) a rounding error makes half a turn or minus that
    for table in tables_of(plan):
        periods |= {(table.title, col): turn(False) for col in table.found.columns_of_raw_angles}
    lengths = [abs(dim.value) for dim in plan.mechanism.dimensions if isinstance(dim.value, float) and is_length(dim)]
    return Angles(periods, min(1.0, max(lengths, default=1.0) or 1.0))


def compare_cells(
    judge: str,
    book: Book,
    values: Any,
    theirs: Callable[[str, int, int], Scalar],
    angles: Angles | None = None,
    rules: Rules | None = None,
    but: Collection[int] = (),
    compared: Callable[[str, int, int], Compared] = lambda _sheet, _row, _col: "value",
) -> Comparison:
    """The engine's value of every formula against `theirs(sheet, row, col)`.

    but       blocks that are left out, by their number
    compared  what is compared in a cell of a sheet: values, whether there is one or an error, nothing
    """
    angles, rules = angles or Angles(), rules or Rules()
    ignored = ignored_in(book, rules.ignore)
    equal = EqualRows(values, angles.size)
    tally = Tally(judge, tolerance=rules.relative)
    number = -1
    for sheet in book.sheets:
        for block in sheet.blocks:
            number += 1
            if number in but:
                continue
            for col in range(block.col, block.col + block.cols):
                ours = values.column(sheet.title, col, block.row, block.row + block.rows - 1)
                scale = column_scale(ours, angles.size)
                period = angles.periods.get((sheet.title, col))
                for row, value in enumerate(ours, block.row):
                    what = compared(sheet.title, row, col)
                    if what == "nothing" or ignored.has(sheet.title, row, col):
                        continue
                    other = theirs(sheet.title, row, col)
                    apart = difference(value, other, scale, period)
                    if what == "error" and isinstance(value, ErrorValue) == isinstance(other, ErrorValue):
                        apart = 0.0
                    if apart > rules.relative:
                        formula = shifted(block.formula, row - block.row, col - block.col)
                        if _is_near(value, other, rules.absolute) or equal.has(formula, sheet.title, other):
                            apart = 0.0
                    if apart > tally.worst or apart > rules.relative:
                        tally.note(apart, cell_address(sheet.title, row, col), value, other)
                    else:
                        tally.cells += 1
    return tally.result()


def _is_near(ours: Scalar, theirs: Scalar, absolute: float) -> bool:
    return type(ours) is float and type(theirs) is float and abs(ours - theirs) <= absolute


def column_scale(column: Sequence[Scalar], size: float) -> float:
    """What a difference in a column is measured by: its largest value, or the size where the values are smaller still.

    A column that passes through zero has rounding errors of its large values there.
    """
    numbers = [abs(value) for value in column if isinstance(value, float) and math.isfinite(value)]
    return max([size, *numbers])

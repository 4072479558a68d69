"""Checks that have one value for the whole workbook: what its sheets repeat of one another, found another way round.

They see what the geometry of a row cannot: steps of the driver, rows that are not whole, a cell of the first sheet that was
typed over, a helper column that reads the wrong row.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Call, CellRef, Node, Number, RangeRef, Symbol, Text, transform
from mechsheet.sheet.geometry import place
from mechsheet.sheet.plan import DRIVER, NUMBER, STATUS, TOLERANCE, VALUE, Plan, TableColumn
from mechsheet.sheet.positions import digits_kept
from mechsheet.sheet.rows import exists_column, fixed_column

ROUNDING = Number(1e-9)
"""Parts of a value (or of a unit of the driver) below this are rounding."""

LAST_DIGITS = 1e-12
"""Parts of a number that its last digits make."""

WHOLE = ("variable", "point")
"""Kinds of columns that have a number in every row that exists; an output may have a pole."""

RECOMPUTED = "recomputed"
"""The check that counts cells which differ from their copies."""

COUNTED = 100
"""Columns that one formula counts."""

EVERY_NUMBER = Text("<1E+300")
"""Criterion of SUMIF that leaves out errors and texts."""


@dataclass(frozen=True, slots=True)
class Whole:
    """One check: the key of its name, its value, how far from 0 that may be, and what else must be TRUE.

    parts  what the value is the largest (or the sum) of: a long list of them is written into cells of its own
    total  True for the sum
    value  the value, from the largest part or the sum
    """

    key: str
    parts: tuple[Node, ...]
    limit: Node
    needs: Node | None = None
    total: bool = False
    value: Callable[[Node], Node] = lambda joined: joined


def whole_table(plan: Plan, sheet: str, rounding: Node) -> list[Whole]:
    """All of them, eight at most, as formulas of `sheet`; `rounding` is the length below which a difference is rounding."""
    found = [Whole("fixed", fixed_points(plan, sheet), rounding)]
    if not plan.mechanism.driver.values:
        found.append(Whole("steps", (steps(plan),), ROUNDING))
    found.append(rows(plan, sheet))
    if any(dim.derived for dim in plan.mechanism.dimensions):
        found.append(Whole("derived", derived_values(plan, sheet), ROUNDING))
    missing = Binary("=", _row_of(plan, sheet, exists_column(plan)), al.ZERO)
    shown = position_shown(plan, sheet)
    found.append(Whole("position", shown, ROUNDING, value=lambda most: Call("IF", (missing, al.ZERO, most))))
    found.append(Whole("summaries", summaries(plan, sheet), ROUNDING))
    found.append(Whole(RECOMPUTED, (plan.at.reference("#differ", sheet, None),), al.ZERO))
    return found


def fixed_points(plan: Plan, sheet: str) -> tuple[Node, ...]:
    """Differences between fixed points' coordinates and their places in the description."""
    ground = plan.mechanism.ground
    parts: list[Node] = []
    cells = {
        point: (plan.at.reading_shown(f"{point}.x", sheet, None), plan.at.reading_shown(f"{point}.y", sheet, None))
        for point in ground.points
    }
    for point in ground.points:
        for cell, node in zip(cells[point], place(ground, point, cells), strict=True):
            parts.append(Call("ABS", (al.sub(cell, plan.at.bind(node, sheet, None)),)))
    return tuple(parts)


def steps(plan: Plan) -> Node:
    """Root of the sum of squares of what the driver's steps differ from the step given, and its start from the start."""
    start, step = (plan.at.reading_shown(key, "", None) for key in ("#start", "#step"))
    first = CellRef(plan.at.first, DRIVER, True, True, plan.table)
    total: Node = al.square(Binary("-", first, start))
    if plan.rows > 1:
        last = CellRef(plan.at.last, DRIVER, True, True, plan.table)
        later = RangeRef(CellRef(plan.at.first + 1, DRIVER, True, True, plan.table), last)
        earlier = RangeRef(first, CellRef(plan.at.last - 1, DRIVER, True, True, plan.table))
        differences = Binary("-", Binary("-", later, earlier), step)
        total = Binary("+", total, Call("SUMPRODUCT", (al.square(differences),)))
    return Call("SQRT", (total,))


def derived_values(plan: Plan, sheet: str) -> tuple[Node, ...]:
    """Derived dimensions against their formulas, computed once more."""
    differences = []
    for dim in plan.mechanism.dimensions:
        if not isinstance(dim.value, float):
            cell = plan.at.reference(dim.symbol, sheet, None)
            differences.append(_difference(cell, plan.at.bind(dim.value, sheet, None)))
    return tuple(differences)


def position_shown(plan: Plan, sheet: str) -> tuple[Node, ...]:
    """What the first sheet shows against the row of that number, and outputs against their formulas there."""
    position = plan.at.reference("#position", sheet, None)
    numbers = fixed_column(plan, NUMBER)
    driver = plan.mechanism.driver.symbol
    cells = {driver: plan.blocks["position"].rows[driver], **plan.blocks["variables"].rows}
    outputs = {output.symbol for output in plan.mechanism.outputs}
    differences = []
    for symbol, row in cells.items():
        cell: Node = CellRef(row, VALUE, True, True, plan.main)
        there = Call("SUMIF", (numbers, position, plan.at.column(symbol, sheet)))
        differences.append(_difference_or_pole(cell, there) if symbol in outputs else _difference(cell, there))
    for output in plan.mechanism.outputs:
        cell = CellRef(cells[output.symbol], VALUE, True, True, plan.main)
        cell = Call("RADIANS", (cell,)) if output.unit.in_degrees else cell
        differences.append(_difference_or_pole(cell, _there(plan, sheet, output.formula)))
    return tuple(differences)


def _difference_or_pole(one: Node, other: Node) -> Node:
    """Two errors, where an output has a pole, are alike."""
    errors = [Call("ISERROR", (node,)) for node in (one, other)]
    return Call("IF", (Call("AND", tuple(errors)), al.ZERO, _difference(one, other)))


def _there(plan: Plan, sheet: str, formula: Node) -> Node:
    """An output's formula over what the table shows in the row of the position."""

    def change(part: Node) -> Node:
        if not isinstance(part, Symbol):
            return part
        spot = plan.at.shown[part.name]
        if not spot.column:
            return plan.at.reference(part.name, sheet, None)
        value = _row_of(plan, sheet, plan.at.column(part.name, sheet))
        return Call("RADIANS", (value,)) if spot.degrees else value

    return transform(formula, change)


def _row_of(plan: Plan, sheet: str, column: Node) -> Node:
    position = plan.at.reference("#position", sheet, None)
    return Call("INDEX", (column, Binary("+", position, al.ONE)))


def summaries(plan: Plan, sheet: str) -> tuple[Node, ...]:
    """Helper columns against those that they repeat (by sums), and summaries against their columns."""
    differences = []
    for column in plan.columns:
        if column.kind in ("blank", "rounded"):
            differences.append(_copy(plan, sheet, column))
    for summary in plan.mechanism.summaries:
        row = plan.blocks["summary"].rows[summary.symbol]
        value, place = (CellRef(row, col, True, True, plan.main) for col in (VALUE, TOLERANCE))
        column_ = plan.at.area(plan.at.shown[f"#blank {summary.of}"], sheet)
        largest, smallest = Call("LARGE", (column_, al.ONE)), Call("SMALL", (column_, al.ONE))
        expected: dict[str, Node] = {
            "max": largest,
            "min": smallest,
            "range": al.sub(largest, smallest),
            "mean": al.div(Call("SUM", (column_,)), Call("COUNT", (column_,))),
        }
        found: list[Node] = []
        if summary.take in expected:
            found.append(_difference(value, expected[summary.take]))
        if summary.take in ("max", "min") and not plan.mechanism.driver.values:
            drivers = plan.at.column(plan.mechanism.driver.symbol, sheet)
            found.append(_difference(value, Call("SUMIF", (drivers, place, column_))))
        nothing = Binary("=", Call("COUNT", (column_,)), al.ZERO)
        missing = Call("IF", (Call("ISNA", (value,)), al.ZERO, al.ONE))
        differences += [Call("IF", (nothing, missing, difference)) for difference in found]
    return tuple(differences)


def _copy(plan: Plan, sheet: str, column: TableColumn) -> Node:
    """How far a helper column's sum is from that of its original; of a rounded one, in units of what rounding may make."""
    copy = plan.at.area(plan.at.shown[f"#{column.kind} {column.symbol}"], sheet)
    total = Call("SUM", (copy,))
    original = Call("SUMIF", (plan.at.column(column.symbol, sheet), EVERY_NUMBER))
    if column.kind == "blank":
        return _difference(total, original)
    digit = Number(plan.rows * 10.0 ** -digits_kept(plan, column.symbol))
    largest = al.largest([Call("MAX", (copy,)), al.neg(Call("MIN", (copy,)))])  # may have fewer decimals than are kept
    room = Binary("+", digit, Binary("*", Number(plan.rows * LAST_DIGITS), largest))
    return Binary("*", ROUNDING, Binary("/", Call("ABS", (Binary("-", total, original),)), room))


def rows(plan: Plan, sheet: str) -> Whole:
    """Numbers that people read, words "ok" and rows that every group closes, less as many as there should be of them
    for the rows that exist: 0 when each row is whole or empty."""
    total = Call("SUM", (exists_column(plan),))
    shown = [plan.at.column(eq.symbol, sheet) for eq in plan.equations.columns if eq.role in WHOLE]
    chunks = range(0, len(shown), COUNTED)
    counts: list[Node] = [Call("COUNT", tuple(shown[start : start + COUNTED])) for start in chunks]
    counts.append(Call("COUNTIF", (fixed_column(plan, STATUS), Text(plan.text("status.ok")))))
    closing = list(dict.fromkeys(group.closes for group in plan.equations.groups))
    if closing:
        pairs = ((plan.at.area(plan.at.spots[name], sheet), EVERY_NUMBER) for name in closing)
        counts.append(Call("COUNTIFS", tuple(part for pair in pairs for part in pair)))
    expected = al.mul(al.number(len(shown) + 1 + (1 if closing else 0)), total)
    some = Binary(">", total, al.ZERO)
    return Whole("rows", tuple(counts), al.ZERO, some, total=True, value=lambda found: al.sub(found, expected))


def _difference(one: Node, other: Node) -> Node:
    return Binary("/", Call("ABS", (Binary("-", one, other),)), Binary("+", al.ONE, Call("ABS", (one,))))

"""How the fast path says each function it knows: from (lowering, argument trees) to the number of a value.

Everything here relies on what lowering relies on: that the cells read hold numbers. A function that is not in FUNCTIONS, or
is used in a way that its entry refuses, is the interpreter's.
"""

from __future__ import annotations

from collections.abc import Callable

from ...formula.nodes import CellRef, Node, Number, RangeRef
from ..graph import area_read
from ..kernels.math import BELOW_HALF
from ..layout import Area
from .lowering import Effect, Lowering, UnsuitableError

Args = tuple[Node, ...]
Lowered = Callable[[Lowering, Args], int]

MOST_SUMMED = 7  # up to here numpy's own summation adds one after the other

UFUNCS = {
    "SIN": "sin", "COS": "cos", "TAN": "tan", "ASIN": "arcsin", "ACOS": "arccos", "ATAN": "arctan", "SINH": "sinh",
    "COSH": "cosh", "TANH": "tanh", "ASINH": "arcsinh", "ACOSH": "arccosh", "ATANH": "arctanh", "RADIANS": "radians",
    "DEGREES": "degrees", "SQRT": "sqrt", "ABS": "absolute", "SIGN": "sign", "EXP": "exp", "LN": "log",
    "LOG10": "log10", "INT": "floor",
}  # fmt: skip
"""Functions that are one numpy operation, with nothing to check but the processor's flags."""


def _ufunc(op: str) -> Lowered:
    return lambda low, args: low.value(op, (low.number(args[0]),))


def _expect(condition: bool) -> None:
    if not condition:
        raise UnsuitableError


def _pi(low: Lowering, args: Args) -> int:
    del args
    return low.constant(3.141592653589793)


def _na(low: Lowering, args: Args) -> int:
    del args
    return low.value("error", (), None, False, "error")


def _n(low: Lowering, args: Args) -> int:
    """N of a cell that holds a number is that number."""
    _expect(isinstance(args[0], CellRef))
    return low.number(args[0])


def _row(low: Lowering, args: Args) -> int:
    row, moves = low.block.row + 1, low.block.rows > 1
    if args:
        cell = args[0]
        if not isinstance(cell, CellRef):
            raise UnsuitableError
        row, moves = cell.row + 1, moves and not cell.row_abs
    return low.value("count", (), row, True) if moves else low.constant(row)


def _atan2(low: Lowering, args: Args) -> int:
    x, y = low.number(args[0]), low.number(args[1])
    low.effect(Effect("somewhere", x, y))
    return low.value("arctan2", (y, x))


def _power(low: Lowering, args: Args) -> int:
    return low.power(low.number(args[0]), args[1])


def _mod(low: Lowering, args: Args) -> int:
    number, divisor = low.number(args[0]), low.number(args[1])
    whole = low.value("floor", (low.value("divide", (number, divisor)),))
    return low.value("subtract", (number, low.value("multiply", (divisor, whole))))


def _round(low: Lowering, args: Args) -> int:
    number, digits = low.number(args[0]), args[1]
    _expect(isinstance(digits, Number))
    if isinstance(digits, Number) and digits.value != 0:
        return low.value("rounded", (number,), digits.value)
    half = low.value("copysign", (low.constant(BELOW_HALF), number))
    return low.value("trunc", (low.value("add", (number, half)),))


# --- several values, ranges -----------------------------------------------------------------------------------------


def _joined(op: str, low: Lowering, parts: list[int]) -> int:
    total = parts[0]
    for part in parts[1:]:
        total = low.value(op, (total, part))
    return total


def _extreme(op: str, reduced: str) -> Lowered:
    def lowered(low: Lowering, args: Args) -> int:
        parts = [_reduced(low, reduced, a) if isinstance(a, RangeRef) else low.number(a) for a in args]
        return _joined(op, low, parts)

    return lowered


def _sum(low: Lowering, args: Args) -> int:
    if len(args) == 1 and isinstance(args[0], RangeRef):
        return _reduced(low, "sum", args[0])
    _expect(0 < len(args) <= MOST_SUMMED)
    return _joined("add", low, [low.number(arg) for arg in args])


def _sumsq(low: Lowering, args: Args) -> int:
    _expect(len(args) <= MOST_SUMMED)
    return _joined("add", low, [low.value("square", (low.number(arg),)) for arg in args])


def _corners(node: RangeRef) -> tuple[CellRef, CellRef]:
    start, end = node.start, node.end
    if not isinstance(start, CellRef) or not isinstance(end, CellRef):
        raise UnsuitableError
    return start, end


def _fixed_rows(low: Lowering, node: RangeRef) -> bool:
    return low.block.rows == 1 or all(ref.row_abs for ref in _corners(node))


def _filled(low: Lowering, node: RangeRef) -> tuple[Area, str]:
    """The cells that a range means anywhere in the block, and their kind: all filled, and none by this segment."""
    area = area_read(node, low.block, low.sheets)
    if area is None:
        raise UnsuitableError
    producers = low.layout.producers(area)
    _expect(not producers & low.results.keys())
    for col in range(area.col, area.col + area.cols):
        column = low.layout.columns[area.sheet].get(col)
        band = column.band_at(area.row) if column is not None else None
        _expect(band is not None and area.row + area.rows <= band.row + band.rows)
    return area, low.read(producers)


def _line(low: Lowering, node: Node) -> int:
    """A range that is the same all over the block, as an array: a slice of one column, or its cells picked together."""
    if not isinstance(node, RangeRef) or not _fixed_rows(low, node):
        raise UnsuitableError
    area, kind = _filled(low, node)
    line = "line" if kind == "number" else "text line"
    if area.cols == 1:
        place = low.layout.place(area.sheet, area.row, area.col)
        return low.value("line", (), (place, place + area.rows), False, line)
    places = tuple(
        low.layout.place(area.sheet, area.row + row, area.col + col)
        for row in range(area.rows)
        for col in range(area.cols)
    )
    return low.value("gathered", (), places, False, line)


def _reduced(low: Lowering, op: str, node: RangeRef) -> int:
    """One number from a range."""
    line = _line(low, node)
    _expect(low.values[line].kind == "line")
    return low.value(f"line_{op}", (line,))


def _index(low: Lowering, args: Args) -> int:
    """INDEX of one row or column: the place is checked when the code runs."""
    _expect(isinstance(args[0], RangeRef) and len(args) in (2, 3))
    node = args[0]
    if not isinstance(node, RangeRef):
        raise UnsuitableError
    start, end = _corners(node)
    if start.col == end.col:
        _expect(len(args) == 2 or args[2] == Number(1.0))
        place = low.number(args[1])
    else:
        _expect(start.row == end.row and (len(args) == 2 or args[1] == Number(1.0)))
        place = low.number(args[-1])
    line = _line(low, node)
    return low.value("pick", (line, place), kind="number" if low.values[line].kind == "line" else "text")


# --- logic ----------------------------------------------------------------------------------------------------------


def _truth(low: Lowering, flag: bool) -> int:
    return low.value("truth", (), flag, False, "true" if flag else "false")


def _is(*kinds: str) -> Lowered:
    """Questions about one cell. What is computed for the question alone could hide its errors."""

    def lowered(low: Lowering, args: Args) -> int:
        _expect(isinstance(args[0], CellRef))
        return _truth(low, low.values[low.lower(args[0])].kind in kinds)

    return lowered


def _all_or_any(op: str, decides: str) -> Lowered:
    """AND, OR: a truth known beforehand decides, or does not matter."""

    def lowered(low: Lowering, args: Args) -> int:
        total = -1
        for arg in args:
            mask = low.mask(arg)
            kind = low.values[mask].kind
            if kind == decides:
                return mask
            if kind == "mask":
                total = mask if total < 0 else low.value(op, (total, mask), kind="mask")
        return _truth(low, decides == "false") if total < 0 else total

    return lowered


def _not(low: Lowering, args: Args) -> int:
    mask = low.mask(args[0])
    kind = low.values[mask].kind
    return low.value("logical_not", (mask,), kind="mask") if kind == "mask" else _truth(low, kind == "false")


def _if(low: Lowering, args: Args) -> int:
    _expect(len(args) == 3)
    mask = low.mask(args[0])
    kind = low.values[mask].kind
    if kind != "mask":
        return low.lower(args[1] if kind == "true" else args[2])
    then, otherwise = low.lower(args[1]), low.lower(args[2])
    kinds = low.values[then].kind, low.values[otherwise].kind
    if kinds in (("number", "number"), ("text", "text")):
        return low.value("where", (mask, then, otherwise), kind=kinds[0])
    # Rows that exist are the rule in a column; what a lone cell says when kinds differ is anybody's guess.
    _expect(low.values[mask].along or "error" in kinds)
    if kinds[0] == "number":
        low.effect(Effect("always", mask))
        return then
    _expect(kinds[1] == "number")
    low.effect(Effect("never", mask))
    return otherwise


def _first(low: Lowering, args: Args) -> int:
    """IFERROR, IFNA: an error would have stopped the code."""
    found = low.lower(args[0])
    _expect(low.values[found].kind != "error")
    return found


FUNCTIONS: dict[str, Lowered] = {
    **{name: _ufunc(op) for name, op in UFUNCS.items()},
    "PI": _pi, "NA": _na, "N": _n, "ROW": _row, "ATAN2": _atan2, "POWER": _power, "MOD": _mod, "ROUND": _round,
    "MIN": _extreme("minimum", "min"), "MAX": _extreme("maximum", "max"), "SUM": _sum, "SUMSQ": _sumsq, "INDEX": _index,
    "ISNUMBER": _is("number"), "ISTEXT": _is("text"), "ISNA": _is(), "ISERROR": _is(),
    "AND": _all_or_any("logical_and", "false"), "OR": _all_or_any("logical_or", "true"), "NOT": _not, "IF": _if,
    "IFERROR": _first, "IFNA": _first,
}  # fmt: skip

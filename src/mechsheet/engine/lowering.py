"""From trees to straight-line code: the values that a segment of blocks needs, each once.

A *segment* is a set of blocks of the same height that can be computed row range by row range. Lowering assumes that every
cell read holds a number and that nothing goes wrong; what could go wrong is either reported by the processor's flags or
guarded by an effect. `UnsuitableError` sends a block to the careful evaluator for good.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from ..formula.nodes import (
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    Missing,
    Node,
    Number,
    RangeRef,
    Text,
    Unary,
)
from .graph import area_read
from .kernels_math import BELOW_HALF, NEAR
from .layout import Area, Layout
from .recurrence import Held, RunningSum

ROWS, COLS = 1, 2
"""Bits of a value's extent: it varies along the rows, along the columns, along both, or (0) not at all."""


class UnsuitableError(Exception):
    """The fast path cannot say this."""


class Value(NamedTuple):
    """One value: an operation on earlier values (by number). `kind`: number, mask, true, false, text or error."""

    op: str
    args: tuple[int, ...] = ()
    data: object = None
    extent: int = 0
    kind: str = "number"


class Effect(NamedTuple):
    """Something to do at a place in the order: check a mask, store a block's result, fill a block with a text."""

    what: str
    value: int
    data: object = None


@dataclass(slots=True)
class Reads:
    """What a segment reads: columns by where their first row lies (with its producers), and everything else by producer."""

    columns: dict[int, frozenset[int]] = field(default_factory=dict)
    others: set[int] = field(default_factory=set)


UNARY = {
    "SIN": "sin", "COS": "cos", "TAN": "tan", "ASIN": "arcsin", "ACOS": "arccos", "ATAN": "arctan", "SINH": "sinh",
    "COSH": "cosh", "TANH": "tanh", "ASINH": "arcsinh", "ACOSH": "arccosh", "ATANH": "arctanh", "RADIANS": "radians",
    "DEGREES": "degrees", "SQRT": "sqrt", "ABS": "absolute", "SIGN": "sign", "EXP": "exp", "LN": "log",
    "LOG10": "log10", "INT": "floor",
}  # fmt: skip
"""Functions that are one numpy operation, with nothing to check but the processor's flags."""

_ARITHMETIC = {"+": "add", "-": "subtract", "*": "multiply", "/": "divide"}
_MOST_SUMMED = 7  # up to here numpy's own summation adds one after the other


class Lowering:
    """Collects the values and effects of one segment, block after block."""

    def __init__(self, layout: Layout, sheets: dict[str, int]) -> None:
        self.layout = layout
        self.sheets = sheets
        self.values: list[Value] = []
        self.order: list[int | Effect] = []
        self.reads = Reads()
        self.results: dict[int, int] = {}
        self._numbers: dict[Value, int] = {}
        self._effects: set[Effect] = set()
        self._block = 0

    def add(self, number: int, formula: Node, recurrence: RunningSum | Held | None) -> None:
        """Add a block. Raises UnsuitableError, leaving everything as it was."""
        mark = len(self.values), len(self.order), dict(self.reads.columns), set(self.reads.others)
        self._block = number
        try:
            if recurrence is not None:
                result = self._recurrence(number, recurrence)
            else:
                result = self._lower(formula)
                if isinstance(formula, Binary) and formula.op in "+-":
                    result = self._snapped(result)
            self._store(number, result)
        except (UnsuitableError, RecursionError) as problem:
            self._undo(*mark)
            raise UnsuitableError from problem
        self.results[number] = result

    def _undo(self, values: int, order: int, columns: dict[int, frozenset[int]], others: set[int]) -> None:
        for value in self.values[values:]:
            del self._numbers[value]
        for item in self.order[order:]:
            if isinstance(item, Effect):
                self._effects.discard(item)
        del self.values[values:]
        del self.order[order:]
        self.reads = Reads(columns, others)

    def _value(
        self, op: str, args: tuple[int, ...] = (), data: object = None, extent: int | None = None, kind: str = "number"
    ) -> int:
        """The number of a value, the same for the same operation on the same values."""
        if extent is None:
            extent = 0
            for arg in args:
                extent |= self.values[arg].extent
        value = Value(op, args, data, extent, kind)
        found = self._numbers.get(value)
        if found is None:
            found = self._numbers[value] = len(self.values)
            self.values.append(value)
            self.order.append(found)
        return found

    def _effect(self, effect: Effect) -> None:
        if effect not in self._effects:
            self._effects.add(effect)
            self.order.append(effect)

    def _store(self, number: int, result: int) -> None:
        kind = self.values[result].kind
        if kind == "text":
            self.layout.texts.number(str(self.values[result].data))  # known to all evaluations of the plan
            self._effect(Effect("fill", result, number))
        elif kind == "number":
            self._effect(Effect("store", result, number))
        else:
            raise UnsuitableError

    def _number(self, node: Node) -> int:
        found = self._lower(node)
        if self.values[found].kind != "number":
            raise UnsuitableError
        return found

    def constant(self, number: float) -> int:
        """A number that stands in the formula (told apart by its text: 0.0 and -0.0 are equal, and differ)."""
        return self._value("constant", (), repr(float(number)))

    def _lower(self, node: Node) -> int:
        match node:
            case Number(number):
                return self.constant(number)
            case CellRef():
                return self._cell(node)
            case Binary():
                return self._chain(node)
            case Unary(op, operand):
                return self._signed(op, operand)
            case Call(name, args):
                return self._call(name, args)
            case Text(text):
                return self._value("text", (), text, 0, "text")
            case Boolean(flag):
                return self._value("truth", (), flag, 0, "true" if flag else "false")
            case ErrorValue():
                return self._value("error", (), None, 0, "error")
            case _:
                raise UnsuitableError

    def _chain(self, node: Binary) -> int:
        run: list[Binary] = []
        left: Node = node
        while isinstance(left, Binary):
            run.append(left)
            left = left.left
        total = self._lower(left)
        for part in reversed(run):
            total = self._operate(part.op, total, part.right)
        return total

    def _operate(self, op: str, left: int, right: Node) -> int:
        if op in ("=", "<>", "<", "<=", ">", ">="):
            return self._compared(op, left, self._number(right))
        if self.values[left].kind != "number":
            raise UnsuitableError
        if op == "^":
            return self._power(left, right)
        if op not in _ARITHMETIC:
            raise UnsuitableError
        return self._value(_ARITHMETIC[op], (left, self._number(right)))

    def _power(self, base: int, exponent: Node) -> int:
        """Only exponents that stand in the formula: the others may be 0 or 2, which have their own rules."""
        sign = 1.0
        if isinstance(exponent, Unary) and exponent.op == "-":
            sign, exponent = -1.0, exponent.operand
        if not isinstance(exponent, Number) or exponent.value == 0:
            raise UnsuitableError
        number = sign * exponent.value
        return self._value("square", (base,)) if number == 2 else self._value("power", (base, self.constant(number)))

    def _signed(self, op: str, operand: Node) -> int:
        value = self._number(operand)
        if op == "+":
            return value
        return self._value("negative", (value,)) if op == "-" else self._value("divide", (value, self.constant(100)))

    def _snapped(self, result: int) -> int:
        op, args = self.values[result].op, self.values[result].args
        if op not in ("add", "subtract"):
            return result
        return self._value("snap", (result, args[0]))

    def _compared(self, op: str, left: int, right: int) -> int:
        """As `compare_numbers`: nearly equal is equal, measured at the right side."""
        if self.values[left].kind != "number":
            raise UnsuitableError
        margin = self._value("multiply", (self._value("absolute", (right,)), self.constant(NEAR)))
        low = self._value("subtract", (right, margin)) if op in ("<", ">=", "=", "<>") else -1
        high = self._value("add", (right, margin)) if op in ("<=", ">", "=", "<>") else -1
        simple = {"<": ("less", low), ">=": ("greater_equal", low), "<=": ("less_equal", high), ">": ("greater", high)}
        if op in simple:
            name, limit = simple[op]
            return self._value(name, (left, limit), kind="mask")
        inside = (
            self._value("greater_equal", (left, low), kind="mask"),
            self._value("less_equal", (left, high), kind="mask"),
        )
        same = self._value("logical_and", inside, kind="mask")
        return same if op == "=" else self._value("logical_not", (same,), kind="mask")

    # references

    def _cell(self, node: CellRef) -> int:
        block = self.layout.blocks[self._block]
        area = area_read(node, block, self.sheets)
        if area is None:
            raise UnsuitableError
        if area.rows == area.cols == 1:
            return self._single(area)
        if area.rows > 1 and area.cols == 1:
            return self._column(area)
        return self._across(area)

    def _single(self, area: Area) -> int:
        place = self.layout.place(area.sheet, area.row, area.col)
        producers = self.layout.producers(area)
        if place < 0:
            raise UnsuitableError
        for producer in producers & self.results.keys():
            if self.layout.block_area(producer) != area:
                raise UnsuitableError  # one row of a column that is only being computed
            return self.results[producer]
        self.reads.others |= producers
        return self._value("cell", (), place)

    def _column(self, area: Area) -> int:
        band = self.layout.columns[area.sheet][area.col].band_at(area.row) if self._has(area) else None
        if band is None or area.row + area.rows > band.row + band.rows:
            raise UnsuitableError
        producers = self.layout.producers(area)
        for producer in producers & self.results.keys():
            own = self.layout.block_area(producer)
            if own == area:
                return self.results[producer]
            if own.row < area.row or own.cols > 1:
                raise UnsuitableError  # rows further down are not computed yet
        place = band.offset + area.row - band.row
        self.reads.columns[place] = frozenset(producers) | self.reads.columns.get(place, frozenset())
        return self._value("column", (), place, ROWS)

    def _across(self, area: Area) -> int:
        """Cells of one row, or of a rectangle, along the columns of a wide block."""
        places = [self.layout.place(area.sheet, area.row, area.col + index) for index in range(area.cols)]
        producers = self.layout.producers(area)
        if min(places) < 0 or producers & self.results.keys():
            raise UnsuitableError
        if area.rows == 1:
            self.reads.others |= producers
            return self._value("across", (), tuple(places), COLS)
        raise UnsuitableError

    def _has(self, area: Area) -> bool:
        return area.col in self.layout.columns[area.sheet]

    # functions

    def _call(self, name: str, args: tuple[Node, ...]) -> int:
        if name in UNARY and len(args) == 1:
            return self._value(UNARY[name], (self._number(args[0]),))
        special = getattr(self, f"_call_{name.lower()}", None)
        if special is None or any(isinstance(arg, Missing) for arg in args):
            raise UnsuitableError
        found: int = special(args)
        return found

    def _call_pi(self, args: tuple[Node, ...]) -> int:
        del args
        return self.constant(3.141592653589793)

    def _call_na(self, args: tuple[Node, ...]) -> int:
        del args
        return self._value("error", (), None, 0, "error")

    def _call_row(self, args: tuple[Node, ...]) -> int:
        block = self.layout.blocks[self._block]
        if args:
            raise UnsuitableError
        if block.rows == 1:
            return self.constant(block.row + 1)
        return self._value("count", (), block.row + 1, ROWS)

    def _call_atan2(self, args: tuple[Node, ...]) -> int:
        x, y = self._number(args[0]), self._number(args[1])
        self._effect(Effect("somewhere", x, y))
        return self._value("arctan2", (y, x))

    def _call_power(self, args: tuple[Node, ...]) -> int:
        return self._power(self._number(args[0]), args[1])

    def _call_mod(self, args: tuple[Node, ...]) -> int:
        number, divisor = self._number(args[0]), self._number(args[1])
        whole = self._value("floor", (self._value("divide", (number, divisor)),))
        return self._value("subtract", (number, self._value("multiply", (divisor, whole))))

    def _call_round(self, args: tuple[Node, ...]) -> int:
        if not isinstance(args[1], Number) or args[1].value != 0:
            raise UnsuitableError
        number = self._number(args[0])
        half = self._value("copysign", (self.constant(BELOW_HALF), number))
        return self._value("trunc", (self._value("add", (number, half)),))

    def _extreme(self, op: str, args: tuple[Node, ...]) -> int:
        total = self._number(args[0])
        for arg in args[1:]:
            total = self._value(op, (total, self._number(arg)))
        return total

    def _call_min(self, args: tuple[Node, ...]) -> int:
        found = self._reduced("min", args)
        return self._extreme("minimum", args) if found is None else found

    def _call_max(self, args: tuple[Node, ...]) -> int:
        found = self._reduced("max", args)
        return self._extreme("maximum", args) if found is None else found

    def _call_sum(self, args: tuple[Node, ...]) -> int:
        found = self._reduced("sum", args)
        if found is None and len(args) > _MOST_SUMMED:
            raise UnsuitableError
        return self._extreme("add", args) if found is None else found

    def _call_sumsq(self, args: tuple[Node, ...]) -> int:
        if len(args) > _MOST_SUMMED:
            raise UnsuitableError
        total = self._value("square", (self._number(args[0]),))
        for arg in args[1:]:
            total = self._value("add", (total, self._value("square", (self._number(arg),))))
        return total

    def _reduced(self, op: str, args: tuple[Node, ...]) -> int | None:
        """One number from a column that is the same for the whole segment and lies side by side."""
        if not any(isinstance(arg, RangeRef) for arg in args):
            return None
        block = self.layout.blocks[self._block]
        node = args[0]
        if len(args) > 1 or not isinstance(node, RangeRef) or not self._fixed(node, block.rows, block.cols):
            raise UnsuitableError
        area = area_read(node, block, self.sheets)
        if area is None or area.cols > 1 or not self._has(area):
            raise UnsuitableError
        band = self.layout.columns[area.sheet][area.col].band_at(area.row)
        producers = self.layout.producers(area)
        if band is None or area.row + area.rows > band.row + band.rows or producers & self.results.keys():
            raise UnsuitableError
        self.reads.others |= producers
        place = band.offset + area.row - band.row
        return self._value(op, (), (place, place + area.rows))

    @staticmethod
    def _fixed(node: RangeRef, rows: int, cols: int) -> bool:
        return all(
            isinstance(ref, CellRef) and (ref.row_abs or rows == 1) and (ref.col_abs or cols == 1)
            for ref in (node.start, node.end)
        )

    def _call_isnumber(self, args: tuple[Node, ...]) -> int:
        """Cells are taken to hold numbers; a result that is not computed for its own sake would hide its errors."""
        if not isinstance(args[0], CellRef):
            raise UnsuitableError
        kind = self.values[self._lower(args[0])].kind
        return self._value("truth", (), kind == "number", 0, "true" if kind == "number" else "false")

    def _mask(self, node: Node) -> int:
        found = self._lower(node)
        if self.values[found].kind == "number":
            return self._value("not_equal", (found, self.constant(0)), kind="mask")
        if self.values[found].kind not in ("mask", "true", "false"):
            raise UnsuitableError
        return found

    def _joined(self, op: str, decides: str, args: tuple[Node, ...]) -> int:
        """AND, OR: a truth known beforehand decides, or does not matter."""
        total = -1
        for arg in args:
            mask = self._mask(arg)
            kind = self.values[mask].kind
            if kind == decides:
                return mask
            if kind == "mask":
                total = mask if total < 0 else self._value(op, (total, mask), kind="mask")
        if total < 0:
            flag = decides == "false"
            return self._value("truth", (), flag, 0, "true" if flag else "false")
        return total

    def _call_and(self, args: tuple[Node, ...]) -> int:
        return self._joined("logical_and", "false", args)

    def _call_or(self, args: tuple[Node, ...]) -> int:
        return self._joined("logical_or", "true", args)

    def _call_not(self, args: tuple[Node, ...]) -> int:
        mask = self._mask(args[0])
        kind = self.values[mask].kind
        if kind == "mask":
            return self._value("logical_not", (mask,), kind="mask")
        return self._value("truth", (), kind == "false", 0, "true" if kind == "false" else "false")

    def _call_if(self, args: tuple[Node, ...]) -> int:
        if len(args) != 3:
            raise UnsuitableError
        mask = self._mask(args[0])
        kind = self.values[mask].kind
        if kind != "mask":
            return self._lower(args[1] if kind == "true" else args[2])
        then = self._lower(args[1])
        otherwise = self._lower(args[2])
        kinds = self.values[then].kind, self.values[otherwise].kind
        if kinds == ("number", "number"):
            return self._value("where", (mask, then, otherwise))
        if kinds == ("error", "number"):
            self._effect(Effect("never", mask))
            return otherwise
        if kinds[0] == "number":
            self._effect(Effect("always", mask))
            return then
        raise UnsuitableError

    def _recurrence(self, number: int, kind: RunningSum | Held) -> int:
        block = self.layout.blocks[number]
        place = self.layout.place(self.layout.block_sheets[number], block.row - 1, block.col)
        if place < 0 or place != self.layout.block_offsets[number] - 1:
            raise UnsuitableError
        producers = self.layout.producers(Area(self.layout.block_sheets[number], block.row - 1, block.col, 1, 1))
        if producers & self.results.keys():
            raise UnsuitableError
        self.reads.columns[place] = frozenset(producers) | {number}
        if isinstance(kind, RunningSum):
            step = self._number(kind.step)
            if kind.op == "-":
                step = self._value("negative", (step,))
            return self._value("running", (step,), (place, kind.step_first), ROWS)
        value = self._number(kind.value)
        mask = self._mask(kind.condition)
        if self.values[mask].kind != "mask":
            if (self.values[mask].kind == "true") == kind.taken:
                return value
            raise UnsuitableError
        if not kind.taken:
            mask = self._value("logical_not", (mask,), kind="mask")
        return self._value("held", (mask, value), place, ROWS)

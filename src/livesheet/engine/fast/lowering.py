"""From trees to straight-line code: the values that a segment of blocks needs, each once.

A *segment* is a set of blocks of the same height that can be computed row range by row range. Lowering assumes that every
cell read holds a number and that nothing goes wrong; what could go wrong is either reported by the processor's flags or
guarded by an effect. `UnsuitableError` sends a block to the interpreter for good.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import NamedTuple, TypeAlias

from ...formula.book import Block
from ...formula.nodes import (
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    Missing,
    Node,
    Number,
    Text,
    Unary,
    shifted,
)
from ..graph import area_read
from ..layout import Area, Layout
from ..values.cells import NEAR
from ..values.coerce import compare_numbers

MOST_VALUES = 4096
"""Values of a segment: code without end takes long to compile."""


class UnsuitableError(Exception):
    """The fast path cannot say this."""


class Value(NamedTuple):
    """One value: an operation on earlier values (by number).

    along  whether it differs from row to row
    kind   number, mask, true or false (a truth known beforehand), text (its number in the table), error, line (an array of
          numbers) or text line
    """

    op: str
    args: tuple[int, ...] = ()
    data: object = None
    along: bool = False
    kind: str = "number"


class Effect(NamedTuple):
    """Something to do at a place in the order: check a mask, store a block's result."""

    what: str
    value: int
    data: object = None


@dataclass(slots=True)
class Reads:
    """What a segment reads.

    columns  where the first rows of columns lie that are read row by row -> their producers;  others  other producers
    texts    producers that must hold texts, and nothing else
    """

    columns: dict[int, frozenset[int]] = field(default_factory=dict)
    others: set[int] = field(default_factory=set)
    texts: set[int] = field(default_factory=set)

    def copy(self) -> Reads:
        """Reads that can be changed apart from these."""
        return Reads(dict(self.columns), set(self.others), set(self.texts))


_ARITHMETIC = {"+": "add", "-": "subtract", "*": "multiply", "/": "divide"}


Functions: TypeAlias = "Mapping[str, Callable[[Lowering, tuple[Node, ...]], int]]"


class Lowering:
    """Collects the values and effects of one segment, block after block.

    `texts` holds the producers known to hold texts alone, of this segment and of those before it.
    """

    def __init__(self, layout: Layout, sheets: dict[str, int], functions: Functions, texts: set[int]) -> None:
        self.layout = layout
        self.functions = functions
        self.texts = texts
        self.sheets = sheets
        self.values: list[Value] = []
        self.order: list[int | Effect] = []
        self.reads = Reads()
        self.results: dict[int, int] = {}
        self._numbers: dict[Value, int] = {}
        self._effects: set[Effect] = set()
        self._block: Block | None = None

    @property
    def block(self) -> Block:
        """The column being lowered, as a block of its own."""
        if self._block is None:
            raise RuntimeError("nothing is being lowered")
        return self._block

    def add(self, number: int, formula: Node) -> None:
        """Add a block. Raises UnsuitableError, leaving everything as it was."""
        mark = len(self.values), len(self.order), self.reads.copy()
        try:
            self.results[number] = result = self._stored(number, formula)
        except (UnsuitableError, RecursionError) as problem:
            self._undo(*mark)
            raise UnsuitableError from problem
        if self.values[result].kind == "text":
            self.texts.add(number)

    def _stored(self, number: int, formula: Node) -> int:
        """Have each column of a block computed and stored; the value of the first one. All are numbers, or all texts."""
        block, offset = self.layout.blocks[number], self.layout.block_offsets[number]
        results = []
        for right in range(block.cols):
            seen = shifted(formula, 0, right) if right else formula
            self._block = Block(block.row, block.col + right, block.rows, 1, seen)
            results.append(self._column_result(seen))
            self.effect(Effect("store", results[-1], offset + right * block.rows))
        if len({self.values[result].kind for result in results}) > 1 or len(self.order) > MOST_VALUES:
            raise UnsuitableError
        return results[0]

    def _column_result(self, formula: Node) -> int:
        """The number of the values that a column shows."""
        result = self.lower(formula)
        if isinstance(formula, Binary) and formula.op in "+-":
            result = self._snapped(result)
        if self.values[result].kind not in ("number", "text"):
            raise UnsuitableError
        return result

    def _undo(self, values: int, order: int, reads: Reads) -> None:
        for value in self.values[values:]:
            del self._numbers[value]
        for item in self.order[order:]:
            if isinstance(item, Effect):
                self._effects.discard(item)
        del self.values[values:]
        del self.order[order:]
        self.reads = reads

    def value(
        self, op: str, args: tuple[int, ...] = (), data: object = None, along: bool = False, kind: str = "number"
    ) -> int:
        """The number of a value, the same for the same operation on the same values."""
        along = along or any(self.values[arg].along for arg in args)
        value = Value(op, args, data, along, kind)
        found = self._numbers.get(value)
        if found is None:
            found = self._numbers[value] = len(self.values)
            self.values.append(value)
            self.order.append(found)
        return found

    def effect(self, effect: Effect) -> None:
        """Something to do here, once."""
        if effect not in self._effects:
            self._effects.add(effect)
            self.order.append(effect)

    def number(self, node: Node) -> int:
        """A tree whose value is a number."""
        found = self.lower(node)
        if self.values[found].kind != "number":
            raise UnsuitableError
        return found

    def constant(self, number: float) -> int:
        """A number that stands in the formula (told apart by its text: 0.0 and -0.0 are equal, and differ)."""
        return self.value("constant", (), repr(float(number)))

    def lower(self, node: Node) -> int:
        """The number of a tree's value."""
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
                function = self.functions.get(name)
                if function is None or any(isinstance(arg, Missing) for arg in args):
                    raise UnsuitableError
                return function(self, args)
            case Text(text):
                if not self.layout.texts.takes(text):
                    raise UnsuitableError
                self.layout.texts.number(text)  # known to all evaluations of the plan
                return self.value("text", (), text, False, "text")
            case Boolean(flag):
                return self.value("truth", (), flag, kind="true" if flag else "false")
            case ErrorValue():
                return self.value("error", (), None, False, "error")
            case _:
                raise UnsuitableError

    def _chain(self, node: Binary) -> int:
        run: list[Binary] = []
        left: Node = node
        while isinstance(left, Binary):
            run.append(left)
            left = left.left
        total = self.lower(left)
        for part in reversed(run):
            total = self._operate(part.op, total, part.right)
        return total

    def _operate(self, op: str, left: int, right: Node) -> int:
        if op in ("=", "<>", "<", "<=", ">", ">="):
            other = self.lower(right)
            if {self.values[left].kind, self.values[other].kind} == {"number", "text"}:
                return self._apart(op, self.values[left].kind == "number")
            return self._compared(op, left, other)
        if self.values[left].kind != "number":
            raise UnsuitableError
        if op == "^":
            return self.power(left, right)
        if op not in _ARITHMETIC:
            raise UnsuitableError
        return self.value(_ARITHMETIC[op], (left, self.number(right)))

    def power(self, base: int, exponent: Node) -> int:
        """Along rows only exponents that stand in the formula: the others may be 0 or 2, which have their own rules."""
        sign = 1.0
        if isinstance(exponent, Unary) and exponent.op == "-":
            sign, exponent = -1.0, exponent.operand
        if not isinstance(exponent, Number):
            power = self.number(exponent)
            if self.values[base].along or self.values[power].along or sign < 0:
                raise UnsuitableError
            return self.value("power_of", (base, power))
        if exponent.value == 0:
            raise UnsuitableError
        number = sign * exponent.value
        return self.value("square", (base,)) if number == 2 else self.value("power", (base, self.constant(number)))

    def _signed(self, op: str, operand: Node) -> int:
        value = self.number(operand)
        if op == "+":
            return value
        return self.value("negative", (value,)) if op == "-" else self.value("divide", (value, self.constant(100)))

    def _snapped(self, result: int) -> int:
        op, args = self.values[result].op, self.values[result].args
        if op not in ("add", "subtract"):
            return result
        return self.value("snap", (result, args[0]))

    def _apart(self, op: str, number_first: bool) -> int:
        """A number beside a text: numbers come before texts."""
        flag = op == "<>" or (op != "=" and (op[0] == "<") == number_first)
        return self.value("truth", (), flag, kind="true" if flag else "false")

    def _compared(self, op: str, left: int, right: int) -> int:
        """As `compare_numbers`: nearly equal is equal, measured at the right side. Truths are the same or not."""
        if self.values[left].kind == self.values[right].kind == "mask" and op in ("=", "<>"):
            apart = self.value("not_equal", (left, right), kind="mask")
            return apart if op == "<>" else self.value("logical_not", (apart,), kind="mask")
        if self.values[left].kind != "number" or self.values[right].kind != "number":
            raise UnsuitableError
        sides = self.values[left], self.values[right]
        if sides[0].op == sides[1].op == "constant":
            flag = bool(compare_numbers(op, float(str(sides[0].data)), float(str(sides[1].data))))
            return self.value("truth", (), flag, kind="true" if flag else "false")
        margin = self.value("multiply", (self.value("absolute", (right,)), self.constant(NEAR)))
        low = self.value("subtract", (right, margin)) if op in ("<", ">=", "=", "<>") else -1
        high = self.value("add", (right, margin)) if op in ("<=", ">", "=", "<>") else -1
        simple = {"<": ("less", low), ">=": ("greater_equal", low), "<=": ("less_equal", high), ">": ("greater", high)}
        if op in simple:
            name, limit = simple[op]
            return self.value(name, (left, limit), kind="mask")
        inside = (
            self.value("greater_equal", (left, low), kind="mask"),
            self.value("less_equal", (left, high), kind="mask"),
        )
        same = self.value("logical_and", inside, kind="mask")
        return same if op == "=" else self.value("logical_not", (same,), kind="mask")

    # references

    def read(self, producers: set[int]) -> str:
        """Take note of what is read by all rows, and say what kind it will be: number or text."""
        if producers <= self.texts:
            self.reads.texts |= producers
            return "text"
        if producers & self.texts:
            raise UnsuitableError
        self.reads.others |= producers
        return "number"

    def _cell(self, node: CellRef) -> int:
        area = area_read(node, self.block, self.sheets)
        if area is None:
            raise UnsuitableError
        if area.rows == area.cols == 1:
            return self._single(area)
        return self._column(area)

    def _single(self, area: Area) -> int:
        place = self.layout.place(area.sheet, area.row, area.col)
        producers = self.layout.producers(area)
        if place < 0 or producers & self.results.keys():  # one row of a column that is only being computed
            raise UnsuitableError
        return self.value("cell", (), place, kind=self.read(producers))

    def _column(self, area: Area) -> int:
        column = self.layout.columns[area.sheet].get(area.col)
        band = None if column is None else column.band_at(area.row)
        if band is None or area.row + area.rows > band.row + band.rows:
            raise UnsuitableError  # beyond the end of what lies side by side
        producers = self.layout.producers(area)
        for producer in producers & self.results.keys():
            own = self.layout.block_area(producer)
            if own == area:
                return self.results[producer]
            if own.row < area.row:
                raise UnsuitableError  # rows further down are not computed yet
        place = band.offset + area.row - band.row
        if producers <= self.texts:
            return self.value("column", (), place, True, self.read(producers))
        self.reads.columns[place] = frozenset(producers) | self.reads.columns.get(place, frozenset())
        return self.value("column", (), place, True)

    def mask(self, node: Node) -> int:
        """A condition: a mask, or a truth known beforehand."""
        found = self.lower(node)
        if self.values[found].kind == "number":
            return self.value("not_equal", (found, self.constant(0)), kind="mask")
        if self.values[found].kind not in ("mask", "true", "false"):
            raise UnsuitableError
        return found

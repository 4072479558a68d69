"""A formula as a Python function of the row, for values of any kind: what a loop of floats leaves.

A value is a float, a text, a truth value, None for a blank; an error is raised, as it is the same for all that reads it.
Python evaluates from the left, so the first error is the one that the cell shows. What is not said here (an unknown
function, a text where a number is wanted) is the interpreter's: `LeftError` when it turns up, no code if known before.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ...formula.book import Block
from ...formula.nodes import Binary, Boolean, Call, CellRef, ErrorValue, Node, Number, Scalar, Text, Unary
from ..graph import area_read
from ..kernels.arithmetic import Arithmetic
from ..kernels.math import BELOW_HALF, rounded_one
from ..layout import Layout
from ..values.calling import to_number
from ..values.cells import BLANK, BOOLEAN, DIV0, ERROR, NA, NEAR, NUM, TEXT, VALUE, Texts, error_code
from .lowered_functions import MOST_SUMMED, UFUNCS
from .scalars import scalar, scalar_power, snap, trunc
from .scalars import sign as sign_of

CellCode = Callable[[int], Scalar]

_DEEPEST = 60
"""Calls inside one another in one expression: Python's parser takes some ninety."""


class CellError(Exception):
    """An error value on its way to the cell."""

    def __init__(self, code: int) -> None:
        super().__init__(code)
        self.code = code


class LeftError(Exception):
    """Something that only the interpreter can do."""


@dataclass(slots=True)
class Memory:
    """The flat array of one evaluation as Python reads it fastest."""

    numbers: Any
    codes: Any
    texts: Texts

    def look(self, place: int) -> Scalar:
        """What stands at a place (-1: nothing). Raises CellError for an error."""
        if place < 0:
            return None
        code = self.codes[place]
        if not code:
            number: float = self.numbers[place]
            return number
        if code >= ERROR:
            raise CellError(code)
        if code == BLANK:
            return None
        return self.texts.text(self.numbers[place]) if code == TEXT else bool(self.numbers[place])

    def code(self, place: int) -> int:
        """What kind of value stands at a place."""
        found: int = BLANK if place < 0 else self.codes[place]
        return found


def cell_code(
    layout: Layout, sheets: dict[str, int], block: Block, arithmetic: Arithmetic
) -> Callable[[Memory], CellCode] | None:
    """From the memory of an evaluation to a function of the row (0 is the block's first) that gives a cell's value."""
    if layout.date1904 or layout.texts.settings.case_sensitive:
        return None  # here texts compare without regard to case, and dates in texts count from 1900
    writer = _Writer(layout, sheets, block, arithmetic)
    try:
        text = writer.result(block.formula)
        source = f"def make(look, code):\n    return lambda k: {text}\n"
        namespace = {**_NAMES, "atan2": _atan2(scalar("arctan2", arithmetic)), **writer.names}
        exec(compile(source, "<cell>", "exec"), namespace)
    except (_UnsaidError, RecursionError, SyntaxError, MemoryError):
        return None
    make: Any = namespace["make"]
    return lambda memory: make(memory.look, memory.code)


class _UnsaidError(Exception):
    pass


class _Writer:
    """Writes a formula as a Python expression."""

    def __init__(self, layout: Layout, sheets: dict[str, int], block: Block, arithmetic: Arithmetic) -> None:
        self.arithmetic = arithmetic
        self.layout = layout
        self.sheets = sheets
        self.block = block
        self.names: dict[str, Any] = {}
        self.depth = 0

    def result(self, formula: Node) -> str:
        """The cell's value: a last sum snapped, a blank as 0."""
        if isinstance(formula, Binary) and formula.op in "+-":
            op = "plus" if formula.op == "+" else "minus"
            return f"{op}_snapped({self.number(formula.left)}, {self.number(formula.right)})"
        return f"shown({self.value(formula)})"

    def number(self, node: Node) -> str:
        """An expression whose value is a float."""
        if isinstance(node, Number) or (isinstance(node, Binary) and node.op in _ARITHMETIC):
            return self.value(node)
        if isinstance(node, Unary) and node.op != "+":
            return self.value(node)
        return f"number({self.value(node)})"

    def flat(self, node: Node) -> str:
        """As `number`, where anything but a number is the interpreter's."""
        return self.value(node) if isinstance(node, Number) else f"only_number({self.value(node)})"

    def value(self, node: Node) -> str:
        """An expression that gives a tree's value."""
        self.depth += 1
        if self.depth > _DEEPEST:
            raise _UnsaidError
        try:
            return self._value(node)
        finally:
            self.depth -= 1

    def _value(self, node: Node) -> str:
        match node:
            case Number(number):
                return f"({float(number)!r})" if math.isfinite(number) else self._unsaid()
            case Text(text):
                return repr(text)
            case Boolean(flag):
                return repr(flag)
            case ErrorValue(name):
                return f"fail({error_code(name)})"
            case CellRef():
                return f"look({self.place(node)})"
            case Unary("+", operand):
                return self.value(operand)
            case Unary("-", operand):
                return f"(-{self.number(operand)})"
            case Unary("%", operand):
                return f"({self.number(operand)} / 100)"
            case Binary("^", base, exponent):
                return self._power(base, exponent)
            case Binary(op, left, right) if op in _ARITHMETIC:
                return f"{_ARITHMETIC[op]}({self.number(left)}, {self.number(right)})"
            case Binary(op, left, right) if op in _COMPARED:
                return f"{_COMPARED[op]}({self.value(left)}, {self.value(right)})"
            case Call(name, args) if name in _CALLS:
                return _CALLS[name](self, args)
            case Call(name, (only,)) if name in UFUNCS:
                return f"{self._ufunc(UFUNCS[name])}({self.flat(only)})"
        return self._unsaid()

    def _unsaid(self) -> str:
        raise _UnsaidError

    def place(self, node: CellRef) -> str:
        """Where a cell lies, of the row k."""
        area = area_read(node, self.block, self.sheets)
        if area is None:
            return self._unsaid()
        moves = self.block.rows > 1 and not node.row_abs
        column = self.layout.columns[area.sheet].get(area.col)
        band = None if column is None else column.band_at(area.row)
        if band is not None and area.row + area.rows <= band.row + band.rows:
            place = band.offset + area.row - band.row
            return f"{place} + k" if moves else str(place)
        name = f"places_{area.sheet}_{area.row}_{area.col}"
        self.names[name] = [self.layout.place(area.sheet, area.row + down, area.col) for down in range(area.rows)]
        return f"{name}[k]" if moves else f"{name}[0]"

    def _power(self, base: Node, exponent: Node) -> str:
        sign, node = 1.0, exponent
        if isinstance(node, Unary) and node.op == "-":
            sign, node = -1.0, node.operand
        if not isinstance(node, Number) or node.value == 0 or not math.isfinite(node.value):
            return self._unsaid()
        power = sign * node.value
        if power == 2:
            return f"squared({self.number(base)})"
        name = f"power_{len(self.names)}"
        self.names[name] = _raised(power, scalar_power(power, self.arithmetic))
        return f"{name}({self.number(base)})"

    def _ufunc(self, op: str) -> str:
        self.names[op] = (
            _guarded(sign_of if op == "sign" else scalar(op, self.arithmetic)) if op not in _EXACT else _EXACT[op]
        )
        return op

    def condition(self, node: Node) -> str:
        """An expression whose value is a truth."""
        return self.value(node) if self.is_truth(node) else f"truth({self.value(node)})"

    def is_truth(self, node: Node) -> bool:
        """Whether a tree gives truth values whatever its cells hold."""
        match node:
            case Boolean():
                return True
            case Binary(op):
                return op in _COMPARED
            case Call(name):
                return name in _TRUTHS
        return False


def _if(writer: _Writer, args: tuple[Node, ...]) -> str:
    if len(args) not in (2, 3):
        raise _UnsaidError
    otherwise = writer.value(args[2]) if len(args) == 3 else "False"
    return f"({writer.value(args[1])} if {writer.condition(args[0])} else {otherwise})"


def _instead(name: str) -> Callable[[_Writer, tuple[Node, ...]], str]:
    def written(writer: _Writer, args: tuple[Node, ...]) -> str:
        if len(args) != 2:
            raise _UnsaidError
        return f"{name}(lambda: {writer.value(args[0])}, lambda: {writer.value(args[1])})"

    return written


def _asks(test: str) -> Callable[[_Writer, tuple[Node, ...]], str]:
    def written(writer: _Writer, args: tuple[Node, ...]) -> str:
        if len(args) != 1 or not isinstance(args[0], CellRef):
            raise _UnsaidError
        return f"(code({writer.place(args[0])}) {test})"

    return written


def _joined(name: str) -> Callable[[_Writer, tuple[Node, ...]], str]:
    def written(writer: _Writer, args: tuple[Node, ...]) -> str:
        if not args or not all(writer.is_truth(arg) for arg in args):
            raise _UnsaidError
        return f"{name}(({', '.join(map(writer.value, args))},))"

    return written


def _not(writer: _Writer, args: tuple[Node, ...]) -> str:
    if len(args) != 1:
        raise _UnsaidError
    return f"(not {writer.condition(args[0])})"


def _of_numbers(name: str, least: int, most: int) -> Callable[[_Writer, tuple[Node, ...]], str]:
    def written(writer: _Writer, args: tuple[Node, ...]) -> str:
        if not least <= len(args) <= most:
            raise _UnsaidError
        return f"{name}({', '.join(map(writer.flat, args))})"

    return written


def _round(writer: _Writer, args: tuple[Node, ...]) -> str:
    if len(args) != 2 or not isinstance(args[1], Number):
        raise _UnsaidError
    digits = math.trunc(args[1].value)
    if args[1].value == 0:
        return f"rounded_whole({writer.flat(args[0])})"
    if not 1 <= abs(digits) <= 307:
        raise _UnsaidError
    return f"finite(rounded_one({writer.flat(args[0])}, {digits}))"


def _power(writer: _Writer, args: tuple[Node, ...]) -> str:
    if len(args) != 2:
        raise _UnsaidError
    return writer.value(Binary("^", args[0], args[1]))


_CALLS: dict[str, Callable[[_Writer, tuple[Node, ...]], str]] = {
    "IF": _if, "IFERROR": _instead("iferror"), "IFNA": _instead("ifna"), "AND": _joined("all"), "OR": _joined("any"),
    "NOT": _not, "ISNUMBER": _asks("== 0"), "ISTEXT": _asks(f"== {TEXT}"), "ISLOGICAL": _asks(f"== {BOOLEAN}"),
    "ISBLANK": _asks(f"== {BLANK}"), "ISNA": _asks(f"== {NA}"), "ISERROR": _asks(f">= {ERROR}"),
    "PI": lambda *_: "(3.141592653589793)", "NA": lambda *_: f"fail({NA})",
    "ATAN2": _of_numbers("atan2", 2, 2), "MOD": _of_numbers("modulo", 2, 2), "ROUND": _round, "POWER": _power,
    "MIN": _of_numbers("least", 1, MOST_SUMMED), "MAX": _of_numbers("greatest", 1, MOST_SUMMED),
    "SUM": _of_numbers("total", 1, MOST_SUMMED),
}  # fmt: skip
_TRUTHS = frozenset(("AND", "OR", "NOT", "ISNUMBER", "ISTEXT", "ISLOGICAL", "ISBLANK", "ISNA", "ISERROR"))
_ARITHMETIC = {"+": "plus", "-": "minus", "*": "times", "/": "over"}
_COMPARED = {"=": "equal", "<>": "unequal", "<": "less", "<=": "at_most", ">": "more", ">=": "at_least"}


# --- what the expressions call ------------------------------------------------------------------------------------------


def _finite(number: float) -> float:
    if number - number != 0.0:
        raise CellError(NUM)
    return number


def _fail(code: int) -> float:
    raise CellError(code)


def _number(value: Scalar) -> float:
    if isinstance(value, float):
        return value
    if isinstance(value, str):
        raise LeftError
    return to_number(value)


def _only_number(value: Scalar) -> float:
    if isinstance(value, float):
        return value
    raise LeftError


def _shown(value: Scalar) -> Scalar:
    return 0.0 if value is None else value


def _over(left: float, right: float) -> float:
    if right == 0:
        raise CellError(DIV0)
    return _finite(left / right)


def _raised(exponent: float, function: Callable[[float], float]) -> Callable[[float], float]:
    def power(base: float) -> float:
        if base == 0:
            if exponent < 0:
                raise CellError(DIV0)
            return 0.0
        try:
            return _finite(function(base))
        except (ValueError, ArithmeticError):
            raise CellError(NUM) from None

    return power


def _guarded(function: Callable[..., float]) -> Callable[..., float]:
    def guarded(*numbers: float) -> float:
        try:
            return _finite(function(*numbers))
        except (ValueError, ArithmeticError):
            raise CellError(NUM) from None

    return guarded


def _atan2(function: Callable[[float, float], float]) -> Callable[[float, float], float]:
    def atan2(x: float, y: float) -> float:
        if x == 0 == y:
            raise CellError(DIV0)
        return function(y, x)

    return atan2


def _modulo(number: float, divisor: float) -> float:
    if divisor == 0:
        raise CellError(DIV0)
    return _finite(number - divisor * ((number / divisor) // 1.0))


def _total(*numbers: float) -> float:
    result = numbers[0]
    for number in numbers[1:]:
        result += number
    return _finite(result)


def _truth(value: Scalar) -> bool:
    if isinstance(value, str):
        word = value.strip().upper()
        if word not in ("TRUE", "FALSE"):
            raise CellError(VALUE)
        return word == "TRUE"
    return bool(value)


def _compared(op: str) -> Callable[[Scalar, Scalar], bool]:
    """As `values.coerce.compared`: numbers before texts before truth values, a blank as the other side asks."""

    def compare(left: Scalar, right: Scalar) -> bool:
        if left.__class__ is float and right.__class__ is float:
            return numeric(left, right)
        left, right = _beside(left, right), _beside(right, left)
        kinds = _kind(left), _kind(right)
        if kinds[0] != kinds[1]:
            return op == "<>" or (op != "=" and (kinds[0] < kinds[1]) == (op[0] == "<"))
        if isinstance(left, str) and isinstance(right, str):
            a, b = left.casefold(), right.casefold()
            return numeric(0.0 if a <= b else 1.0, 0.0 if b <= a else 1.0)
        return numeric(to_number(left), to_number(right))

    numeric: Callable[[Any, Any], bool] = {
        "<": _less,
        "<=": _at_most,
        ">": _more,
        ">=": _at_least,
        "=": _equal,
        "<>": _unequal,
    }[op]
    return compare


def _beside(value: Scalar, other: Scalar) -> Scalar:
    if value is not None:
        return value
    if isinstance(other, str):
        return ""
    return False if isinstance(other, bool) else 0.0


def _kind(value: Scalar) -> int:
    return 1 if isinstance(value, str) else 2 if isinstance(value, bool) else 0


def _less(left: float, right: float) -> bool:
    return left < right - NEAR * abs(right)


def _at_most(left: float, right: float) -> bool:
    return left <= right + NEAR * abs(right)


def _more(left: float, right: float) -> bool:
    return left > right + NEAR * abs(right)


def _at_least(left: float, right: float) -> bool:
    return left >= right - NEAR * abs(right)


def _equal(left: float, right: float) -> bool:
    return right - NEAR * abs(right) <= left <= right + NEAR * abs(right)


def _unequal(left: float, right: float) -> bool:
    return not right - NEAR * abs(right) <= left <= right + NEAR * abs(right)


def _iferror(first: Callable[[], Scalar], second: Callable[[], Scalar]) -> Scalar:
    try:
        return first()
    except CellError:
        return second()


def _ifna(first: Callable[[], Scalar], second: Callable[[], Scalar]) -> Scalar:
    try:
        return first()
    except CellError as problem:
        if problem.code != NA:
            raise
        return second()


_EXACT: dict[str, Callable[[float], float]] = {"absolute": abs, "floor": lambda number: number // 1.0}
_NAMES: dict[str, Any] = {
    "finite": _finite, "fail": _fail, "number": _number, "only_number": _only_number, "shown": _shown,
    "plus": lambda a, b: _finite(a + b), "minus": lambda a, b: _finite(a - b), "times": lambda a, b: _finite(a * b),
    "over": _over, "plus_snapped": lambda a, b: snap(_finite(a + b), a), "squared": lambda a: _finite(a * a),
    "minus_snapped": lambda a, b: snap(_finite(a - b), a), "modulo": _modulo, "total": _total,
    "least": lambda *numbers: min(numbers), "greatest": lambda *numbers: max(numbers),
    "truth": _truth, "rounded_one": rounded_one,
    "rounded_whole": lambda a: trunc(a + math.copysign(BELOW_HALF, a)), "iferror": _iferror, "ifna": _ifna,
    **{name: _compared(op) for op, name in _COMPARED.items()},
}  # fmt: skip

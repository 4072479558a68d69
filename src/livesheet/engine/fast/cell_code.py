"""A formula as a Python function of the row, for values of any kind: what a loop of floats leaves, and single cells.

A value is a float, a text, a truth value, None for a blank; an error is raised, as it is the same for all that reads it.
Python evaluates from the left, so the first error is the one that the cell shows. What is not said here (most functions of
ranges, a text where a number is wanted) is the interpreter's: `LeftError` when it turns up, no code if known before.

Code is made where a step has been interpreted so often that making it pays. It is what makes a workbook that is kept open
quick: without it 52 workbooks of generated/ take 5 times as long to be computed again, and an answer of
benchmarks/bench_session.py 20 times.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from ...formula.book import Block
from ...formula.functions import FUNCTIONS
from ...formula.nodes import (
    Apply,
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    FunctionRef,
    Local,
    Node,
    Number,
    RangeRef,
    Text,
    Unary,
    shifted,
    walk,
)
from ..graph import area_read, reads_anywhere
from ..interpreter.evaluator import Evaluator
from ..kernels.math import Arithmetic
from ..layout import Layout
from ..values.cells import BLANK, BOOLEAN, ERROR, NA, TEXT, Frame, error_code
from .cell_functions import COMPARED, EXACT, MOST, NAMES, CellCode, Memory, direction, guarded, power_of, raised
from .lowered_functions import MOST_SUMMED, UFUNCS
from .scalars import scalar, scalar_power
from .scalars import sign as sign_of

_DEEPEST = 60
"""Calls inside one another in one expression: Python's parser takes some ninety."""


def cell_code(
    layout: Layout, sheet: int, block: Block, arithmetic: Arithmetic, alone: bool = True, leading_only: bool = False
) -> CellCode:
    """How a column of one block is computed.

    alone  whether the interpreter would take the cells one by one, too: numpy raises arrays to powers other than 2 by other
           code than single numbers
    """
    writer = _Writer(layout, sheet, block, arithmetic, alone)
    parts = writer.in_turn(block.formula)
    last = parts[-1]
    instead = float(last.value) if len(parts) > 1 and isinstance(last, Number) else None
    parts = parts if instead is None else parts[:-1]
    leading = tuple(tuple(writer.leading(part)[0]) for part in parts)
    if leading_only or layout.date1904 or layout.texts.settings.case_sensitive:
        return CellCode(
            leading, instead, None
        )  # code compares texts without regard to case, and counts dates in texts from 1900
    try:
        source = f"lambda m, k: {writer.result(block.formula)}"
        namespace = {**NAMES, "atan2": direction(scalar("arctan2", arithmetic)), **writer.names}
        return CellCode(leading, instead, eval(compile(source, "<cell>", "eval"), namespace))
    except (_UnsaidError, RecursionError, SyntaxError, MemoryError):
        return CellCode(leading, instead, None)


class _UnsaidError(Exception):
    pass


class _Writer:
    """Writes a formula as a Python expression."""

    def __init__(self, layout: Layout, sheet: int, block: Block, arithmetic: Arithmetic, alone: bool) -> None:
        self.sheet = sheet
        self.alone = alone
        self.arithmetic = arithmetic
        self.layout = layout
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
                return f"m.look({self.place(node)})"
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
            case Binary("&", left, right):
                return f"joined({self.value(left)}, {self.value(right)})"
            case Binary(op, left, right) if op in COMPARED:
                return f"{COMPARED[op]}({self.value(left)}, {self.value(right)})"
            case Call():
                try:
                    return self._called(node)
                except _UnsaidError:
                    return self._interpreted(node)
        return self._unsaid()

    def _called(self, call: Call) -> str:
        name, args = call.name, call.args
        if name in _CALLS:
            return _CALLS[name](self, args)
        if name in UFUNCS and len(args) == 1:
            return f"{self._ufunc(UFUNCS[name])}({self.flat(args[0])})"
        return f"m.called({name!r}, {', '.join(self._singles(name, args))})"

    def _interpreted(self, call: Call) -> str:
        """A part of the formula by the interpreter: a function of ranges, say, under an IF."""
        if not self.alone or self.depth == 1 or call.name in _WHOLE or reads_anywhere(call):
            raise _UnsaidError
        for part in walk(call):
            if isinstance(part, Local | Apply | FunctionRef) or (
                isinstance(part, Call) and FUNCTIONS[part.name].volatile
            ):
                raise _UnsaidError
        frame = self.sheet, self.block.row, self.block.col
        return f"m.interpreted({self._named('part', call)}, {frame}, k)"

    def _unsaid(self) -> str:
        raise _UnsaidError

    def _singles(self, name: str, args: tuple[Node, ...]) -> list[str]:
        """The arguments of a function of single values, whose kernel makes no difference where they come from."""
        row = FUNCTIONS[name]
        kinds = row.kinds_of(len(args))
        if not args or len(kinds) < len(args) or not set(kinds) <= _SINGLE or row.volatile:
            raise _UnsaidError
        return [self.value(arg) if kind == "t" else self.flat(arg) for arg, kind in zip(args, kinds, strict=True)]

    def in_turn(self, node: Node) -> list[Node]:
        """The formula, or of IFERROR what is tried one after the other."""
        match node:
            case Call("IFERROR", (first, second)):
                return [*self.in_turn(first), *self.in_turn(second)]
        return [node]

    def leading(self, node: Node) -> tuple[list[tuple[int, int]], bool]:
        """`CellCode.leading`; and whether a tree is no more than a cell or a number, which cannot go wrong by itself."""
        match node:
            case Number():
                return [], True
            case CellRef():
                place, step = self._spot(node)
                return ([(place, step)], True) if isinstance(place, int) and place >= 0 else ([], False)
            case Binary(op, left, right) if op in COMPARED or op in "+-*/^&":
                return self._leading_of((left, right))
            case Unary(operand=operand):
                return self._leading_of((operand,))
            case Call("IF", (condition, *_)):
                return self._leading_of((condition,))
            case Call(name, args) if name in UFUNCS or name in _IN_ORDER:
                return self._leading_of(args)
        return [], False

    def _leading_of(self, parts: tuple[Node, ...]) -> tuple[list[tuple[int, int]], bool]:
        found: list[tuple[int, int]] = []
        for part in parts:
            leading, bare = self.leading(part)
            found += leading
            if not bare:
                break
        return found, False

    def place(self, node: CellRef) -> str:
        """Where a cell lies, of the row k."""
        place, step = self._spot(node)
        if isinstance(place, int):
            return f"{place} + k" if step else str(place)
        return f"{self._named('places', place)}[k]"

    def _spot(self, node: CellRef) -> tuple[int | list[int], int]:
        """The place of a cell, and its step from row to row; all its places where these do not lie side by side."""
        area = area_read(node, self.block, self.layout.sheets)
        if area is None:
            raise _UnsaidError
        moves = self.block.rows > 1 and not node.row_abs
        column = self.layout.columns[area.sheet].get(area.col)
        band = None if column is None else column.band_at(area.row)
        if band is not None and area.row + area.rows <= band.row + band.rows:
            return band.offset + area.row - band.row, int(moves)
        places = [self.layout.place(area.sheet, area.row + down, area.col) for down in range(area.rows)]
        return (places, 1) if moves else (places[0], 0)

    def line(self, node: Node) -> tuple[str, tuple[int, int]]:
        """The places of a short row or column as an expression; rows and columns (at most, for `INDEX(…):INDEX(…)`)."""
        match node:
            case Binary(":", Call("INDEX", (line, first)), Call("INDEX", (other, last))) if line == other:
                places, size = self.line(line)
                return f"m.part({places}, lambda: {self.number(first)}, lambda: {self.number(last)})", size
            case RangeRef(CellRef() as start, CellRef() as end):
                area = area_read(node, self.block, self.layout.sheets)
            case _:
                raise _UnsaidError
        rows, cols = 1 + abs(end.row - start.row), 1 + abs(end.col - start.col)
        moves = self.block.rows > 1 and not (start.row_abs and end.row_abs)
        if area is None or min(rows, cols) > 1 or max(rows, cols) > MOST or (moves and start.row_abs != end.row_abs):
            raise _UnsaidError
        column = self.layout.columns[area.sheet].get(area.col)
        band = None if column is None or cols > 1 else column.band_at(area.row)
        if band is not None and area.row + area.rows <= band.row + band.rows:
            place = band.offset + area.row - band.row
            if moves:
                return f"range({place} + k, {place + rows} + k)", (rows, cols)
            return self._named("line", range(place, place + rows)), (rows, cols)
        if moves and cols > 1:
            raise _UnsaidError
        if moves:
            moving = [self.layout.place(area.sheet, area.row + down, area.col) for down in range(area.rows)]
            return f"{self._named('line', moving)}[k : k + {rows}]", (rows, cols)
        cells = [(area.row + down, area.col + right) for down in range(rows) for right in range(cols)]
        return self._named("line", [self.layout.place(area.sheet, *cell) for cell in cells]), (rows, cols)

    def _named(self, word: str, thing: object) -> str:
        name = f"{word}_{len(self.names)}"
        self.names[name] = thing
        return name

    def _power(self, base: Node, exponent: Node) -> str:
        sign, node = 1.0, exponent
        if isinstance(node, Unary) and node.op == "-":
            sign, node = -1.0, node.operand
        if node == Number(2.0) and sign > 0:
            return f"squared({self.number(base)})"
        if not self.alone:
            raise _UnsaidError
        if not isinstance(node, Number) or node.value == 0 or not math.isfinite(node.value):
            own = self.arithmetic.operations.get("power")
            self.names["to_power"] = power_of(own or (lambda base, exponent: float(np.power(base, exponent))))
            return f"to_power({self.number(base)}, {self.number(exponent)})"
        power = sign * node.value
        name = self._named("power", raised(power, scalar_power(power, self.arithmetic)))
        return f"{name}({self.number(base)})"

    def _ufunc(self, op: str) -> str:
        self.names[op] = (
            guarded(sign_of if op == "sign" else scalar(op, self.arithmetic)) if op not in EXACT else EXACT[op]
        )
        return op

    def condition(self, node: Node) -> str:
        """An expression whose value is a truth."""
        return self.value(node) if self.is_truth(node) else f"truth({self.value(node)})"

    def counted(self, node: Node) -> str:
        """The same where texts and blanks may be passed over: those are the interpreter's."""
        return self.value(node) if self.is_truth(node) else f"only_truth({self.value(node)})"

    def is_number(self, node: Node) -> bool:
        """Whether a tree is an operation of numbers."""
        return isinstance(node, Binary) and (node.op in _ARITHMETIC or node.op == "^")

    def is_truth(self, node: Node) -> bool:
        """Whether a tree gives truth values whatever its cells hold."""
        match node:
            case Boolean():
                return True
            case Binary(op):
                return op in COMPARED
            case Call(name):
                return name in _TRUTHS
        return False


def _if(writer: _Writer, args: tuple[Node, ...]) -> str:
    if len(args) not in (2, 3):
        raise _UnsaidError
    otherwise = writer.value(args[2]) if len(args) == 3 else "False"
    return f"({writer.value(args[1])} if {writer.condition(args[0])} else {otherwise})"


def _instead(name: str) -> Callable[[_Writer, tuple[Node, ...]], str]:
    return lambda writer, args: f"{name}(lambda: {writer.value(args[0])}, lambda: {writer.value(args[1])})"


def _asks(test: str) -> Callable[[_Writer, tuple[Node, ...]], str]:
    def written(writer: _Writer, args: tuple[Node, ...]) -> str:
        if not isinstance(args[0], CellRef):
            raise _UnsaidError
        return f"(m.code({writer.place(args[0])}) {test})"

    return written


def _joined(name: str) -> Callable[[_Writer, tuple[Node, ...]], str]:
    return lambda writer, args: f"{name}(({', '.join(map(writer.counted, args))},))"


def _of_numbers(name: str) -> Callable[[_Writer, tuple[Node, ...]], str]:
    return lambda writer, args: f"{name}({', '.join(map(writer.flat, args))})"


def _fold(name: str) -> Callable[[_Writer, tuple[Node, ...]], str]:
    """Of numbers and short lines; not of more than numpy adds one after the other, where that makes a difference."""

    def written(writer: _Writer, args: tuple[Node, ...]) -> str:
        parts, cells = [], 0
        for arg in args:
            if isinstance(arg, RangeRef | Binary) and not writer.is_number(arg):
                places, (rows, cols) = writer.line(arg)
                parts.append(f"*m.in_line({places})")
                cells += rows * cols
            else:
                parts.append(writer.flat(arg))
                cells += 1
        if not parts or (cells if name == "total" else len(parts)) > MOST_SUMMED:
            raise _UnsaidError
        return f"{name}({', '.join(parts)})"

    return written


def _fold_if(name: str) -> Callable[[_Writer, tuple[Node, ...]], str]:
    def written(writer: _Writer, args: tuple[Node, ...]) -> str:
        places, size = writer.line(args[0])
        return f"{name}(*m.in_line_if({places}, {_asked(writer, args[1:], size)}))"

    return written


def _n(writer: _Writer, args: tuple[Node, ...]) -> str:
    if not isinstance(args[0], CellRef):
        raise _UnsaidError
    return f"number_in({writer.value(args[0])})"


def _count(writer: _Writer, args: tuple[Node, ...]) -> str:
    return f"float({' + '.join(f'm.count({writer.line(arg)[0]})' for arg in args)})"


def _match(writer: _Writer, args: tuple[Node, ...]) -> str:
    if len(args) != 3 or args[2] != Number(0.0):
        raise _UnsaidError
    return f"m.match({writer.value(args[0])}, {writer.line(args[1])[0]})"


def _count_if(writer: _Writer, args: tuple[Node, ...]) -> str:
    return f"m.count_if({_asked(writer, args)})"


def _asked(writer: _Writer, args: tuple[Node, ...], size: tuple[int, int] | None = None) -> str:
    """Pairs of a line, all of one size, and what is asked for in it."""
    lines = [writer.line(arg) for arg in args[::2]]
    sizes = {found for _, found in lines} | ({size} if size else set())
    if len(args) % 2 or len(sizes) != 1 or any(isinstance(arg, Binary) for arg in args[::2]):
        raise _UnsaidError
    return ", ".join(
        f"({places}, {_criterion(writer, arg)})" for (places, _), arg in zip(lines, args[1::2], strict=True)
    )


def _criterion(writer: _Writer, node: Node) -> str:
    match node:
        case Number() | Text():
            return writer.value(node)
        case CellRef():
            return f"m.criterion({writer.place(node)})"
    raise _UnsaidError


def _index(writer: _Writer, args: tuple[Node, ...]) -> str:
    if len(args) != 2 or not isinstance(args[0], RangeRef):
        raise _UnsaidError
    return f"m.indexed({writer.line(args[0])[0]}, {writer.number(args[1])})"


def _round(writer: _Writer, args: tuple[Node, ...]) -> str:
    if not isinstance(args[1], Number):
        raise _UnsaidError
    digits = math.trunc(args[1].value)
    if args[1].value == 0:
        return f"rounded_whole({writer.flat(args[0])})"
    if not 1 <= abs(digits) <= 307:
        raise _UnsaidError
    return f"finite(rounded_one({writer.flat(args[0])}, {digits}))"


def _row(writer: _Writer, args: tuple[Node, ...]) -> str:
    if args and not isinstance(args[0], CellRef):
        raise _UnsaidError
    cell = args[0] if args and isinstance(args[0], CellRef) else None
    if cell is not None and (cell.row_abs or writer.block.rows == 1):
        return f"({cell.row + 1.0!r})"
    return f"({(writer.block.row if cell is None else cell.row) + 1.0!r} + k)"


# Calls have as many arguments as their functions take: the others have been refused (`resolve`).
_CALLS: dict[str, Callable[[_Writer, tuple[Node, ...]], str]] = {
    "IF": _if, "IFERROR": _instead("iferror"), "IFNA": _instead("ifna"), "AND": _joined("all"), "OR": _joined("any"),
    "NOT": lambda writer, args: f"(not {writer.condition(args[0])})",
    "ISNUMBER": _asks("== 0"), "ISTEXT": _asks(f"== {TEXT}"), "ISLOGICAL": _asks(f"== {BOOLEAN}"),
    "ISBLANK": _asks(f"== {BLANK}"), "ISNA": _asks(f"== {NA}"), "ISERROR": _asks(f">= {ERROR}"),
    "PI": lambda *_: "(3.141592653589793)", "NA": lambda *_: f"fail({NA})",
    "ATAN2": _of_numbers("atan2"), "MOD": _of_numbers("modulo"), "ROUND": _round,
    "POWER": lambda writer, args: writer.value(Binary("^", *args)),
    "MIN": _fold("least"), "MAX": _fold("greatest"), "SUM": _fold("total"),
    "MINIFS": _fold_if("least"), "MAXIFS": _fold_if("greatest"),
    "N": _n, "ROW": _row, "COUNT": _count, "COUNTIF": _count_if, "COUNTIFS": _count_if, "MATCH": _match, "INDEX": _index,
}  # fmt: skip
_TRUTHS = frozenset(("AND", "OR", "NOT", "ISNUMBER", "ISTEXT", "ISLOGICAL", "ISBLANK", "ISNA", "ISERROR"))
_WHOLE = frozenset(("IF", "IFERROR", "IFNA"))
"""Functions whose parts are computed only where they are needed, which leave more to code when they stand in it."""
_IN_ORDER = frozenset(("ATAN2", "MIN", "MAX", "AND", "OR", "NOT"))
"""Functions whose arguments are all computed, from the left, before anything else."""
_SINGLE = frozenset("npyatd")
"""Kinds of arguments (`functions.txt`) that are single values, without those that may be errors."""
_ARITHMETIC = {"+": "plus", "-": "minus", "*": "times", "/": "over"}


class CellCodes:
    """The cells of a step's blocks, column by column.

    patience  how often cells are interpreted before code is made, which takes as long as interpreting a cell twice or
              three times
    alone     as of `cell_code`
    """

    def __init__(self, layout: Layout, patience: int, alone: bool = True) -> None:
        self.layout = layout
        self.patience = patience
        self.alone = alone
        self._made: dict[tuple[int, int, bool], CellCode] = {}

    def due(self) -> bool:
        """Another time that cells are computed: whether by code, as far as there is some."""
        self.patience -= 1
        return self.patience < 0

    def compute(self, memory: Memory, number: int, formula: Node, down: int, right: int = 0) -> None:
        """Compute a cell of a block: as far as can be by code, else by the interpreter."""
        place = self.layout.block_offsets[number] + right * self.layout.blocks[number].rows + down
        if not memory.fill(self.code(memory.ev, number, formula, right), down, place):
            self.interpret(memory.ev, number, formula, down, right)

    def interpret(self, ev: Evaluator, number: int, formula: Node, down: int, right: int) -> None:
        """Compute a cell of a block by the interpreter."""
        block = self.layout.blocks[number]
        frame = Frame(self.layout.block_sheets[number], block.row + down, block.col + right, 1, 1, down, right)
        found = ev.result(formula, frame)
        place = self.layout.block_offsets[number] + right * block.rows + down
        ev.numbers[place] = found.numbers
        ev.codes[place] = 0 if found.codes is None else found.codes

    def code(self, ev: Evaluator, number: int, formula: Node, right: int = 0, by_code: bool = True) -> CellCode:
        """The code of a column of a block, without `by_code` no more than what costs nothing to make."""
        key = number, right, by_code
        if key not in self._made:
            block, sheet = self.layout.blocks[number], self.layout.block_sheets[number]
            seen = shifted(formula, 0, right) if right else formula
            column = Block(block.row, block.col + right, block.rows, 1, seen)
            self._made[key] = cell_code(self.layout, sheet, column, ev.around.arithmetic, self.alone, not by_code)
        return self._made[key]

"""The one expression tree: descriptions, equations, workbook formulas and the engine all use it.

Nodes are frozen and hashable, so a tree can be a dictionary key (common subexpressions, runs of equal formulas).
Function names are the spreadsheet's (OOXML spelling, without `_xlfn.`), with the spreadsheet's argument order:
`Call("ATAN2", (x, y))` takes x first whatever dialect it was read from. A tree means what it says: operators carry no
parentheses, `Unary("-", Binary("^", 2, 2))` is -4; how a dialect must be parenthesised to say so is the printer's matter.

Rows and columns count from 0 everywhere inside the program; only text says A1.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from operator import is_
from typing import Any, Literal, TypeAlias

from ..said import say

MAX_ROWS = 1_048_576
MAX_COLUMNS = 16_384


@dataclass(frozen=True, slots=True)
class Number:
    """A finite constant."""

    value: float


@dataclass(frozen=True, slots=True)
class Text:
    """A text constant."""

    value: str


@dataclass(frozen=True, slots=True)
class Boolean:
    """TRUE or FALSE."""

    value: bool


@dataclass(frozen=True, slots=True)
class ErrorValue:
    """An error as a value, "#N/A", "#DIV/0!", "#NUM!", "#VALUE!", "#REF!", "#NAME?", "#NULL!": a constant and a result."""

    code: str

    def __str__(self) -> str:
        return self.code


@dataclass(frozen=True, slots=True)
class Missing:
    """An argument left out: the second of `IF(A1,,2)`."""


@dataclass(frozen=True, slots=True)
class Symbol:
    """A quantity of the mechanism: a dimension, a mode, a variable, `C.x`. Never in a workbook: the sheet binds it."""

    name: str


@dataclass(frozen=True, slots=True)
class Direction:
    """The direction of the vector (x, y) [rad] as an angle without jumps along a sweep; at one position that of ATAN2.

    Only in equations: each edge (sheet, program, page) writes it in its own way.
    """

    y: Node
    x: Node


@dataclass(frozen=True, slots=True)
class TriangleAngle:
    """The angle [rad, 0 to pi] between two sides of a triangle, opposite the third: the law of cosines.

    acos((beside^2 + other^2 - opposite^2) / (2 beside other)). Only in equations, as `Direction`.
    """

    opposite: Node
    beside: Node
    other: Node


@dataclass(frozen=True, slots=True)
class Root:
    """The unknown of that name of a system of equations, followed from row to row along a sweep by Newton's method.

    given  what the system's equations read besides its unknowns. Only in equations, as `Direction`.
    """

    unknown: str
    given: tuple[Node, ...]


@dataclass(frozen=True, slots=True)
class Previous:
    """The quantity in the row above (the driver's previous value). Never in a workbook."""

    name: str


@dataclass(frozen=True, slots=True)
class CellRef:
    """One cell. `row_abs`, `col_abs` are the `$` anchors; `sheet` is None for the formula's own sheet.

    A relative reference holds the target as seen from the cell the formula stands in: fill-down shifts it
    (`shifted`). A target outside the sheet is #REF!.
    """

    row: int
    col: int
    row_abs: bool = False
    col_abs: bool = False
    sheet: str | None = None


@dataclass(frozen=True, slots=True)
class RangeRef:
    """A rectangle of cells, corner to corner; a whole column runs from row 0 to MAX_ROWS - 1 (and has absolute rows)."""

    start: CellRef
    end: CellRef


@dataclass(frozen=True, slots=True)
class NameRef:
    """A defined name; `sheet` when it is written `Sheet1!name`."""

    name: str
    sheet: str | None = None


@dataclass(frozen=True, slots=True)
class Unary:
    """`-x`, `+x` or `x%`."""

    op: Literal["-", "+", "%"]
    operand: Node


@dataclass(frozen=True, slots=True)
class Binary:
    """An operator between two operands: + - * / ^ & = <> < <= > >=, and for references `,` union, ` ` intersection, `:`."""

    op: str
    left: Node
    right: Node


@dataclass(frozen=True, slots=True)
class Call:
    """A function with its arguments."""

    name: str
    args: tuple[Node, ...] = ()


@dataclass(frozen=True, slots=True)
class ArrayLiteral:
    """`{1,2;3,4}`: rows of constants."""

    rows: tuple[tuple[Node, ...], ...]


@dataclass(frozen=True, slots=True)
class SheetsRef:
    """`Sheet1:Sheet3!A1:B2`: the same cells of several sheets that follow one another; `area` names no sheet."""

    first: str
    last: str
    area: Node


@dataclass(frozen=True, slots=True)
class TableRef:
    """A structured reference, `Table1[[#Headers],[a]:[b]]`.

    table     None for the table the formula stands in
    parts     any of "all", "data", "headers", "totals", "this row"; none means the data
    first, last  the columns, both None for all of them
    """

    table: str | None
    parts: frozenset[str] = frozenset()
    first: str | None = None
    last: str | None = None


@dataclass(frozen=True, slots=True)
class Foreign:
    """What cannot be computed from the workbook alone: a cell of another workbook, or what `why` says.

    `text` as the file spells it.
    """

    text: str
    why: str = say("a reference to another workbook")


UNKNOWN_FUNCTION = say("an unknown function")
"""Why a `Foreign` stands for a call: the workbook's own macros may define the function."""


@dataclass(frozen=True, slots=True)
class Local:
    """A name that LET or LAMBDA gives, in small letters; `optional` where LAMBDA lets a call leave it out."""

    name: str
    optional: bool = False


@dataclass(frozen=True, slots=True)
class Arrayed:
    """What is computed as in an array formula wherever it stands: the expression that a defined name stands for."""

    operand: Node


@dataclass(frozen=True, slots=True)
class FunctionRef:
    """A defined name that stands for a function; relative references in it are as seen from (row, col) of `sheet`."""

    name: str
    sheet: str
    row: int = 0
    col: int = 0


@dataclass(frozen=True, slots=True)
class Apply:
    """A call of what an expression gives: `LAMBDA(x,x+1)(3)`, or of a name of LET or of the workbook."""

    function: Node
    args: tuple[Node, ...] = ()


Node: TypeAlias = (
    Number
    | Text
    | Boolean
    | ErrorValue
    | Missing
    | Symbol
    | Previous
    | Direction
    | TriangleAngle
    | Root
    | CellRef
    | RangeRef
    | NameRef
    | Unary
    | Binary
    | Call
    | ArrayLiteral
    | SheetsRef
    | TableRef
    | Foreign
    | Local
    | Arrayed
    | FunctionRef
    | Apply
)

Scalar: TypeAlias = float | str | bool | ErrorValue | None
"""What a cell can hold: a number, a text, a truth value, an error, or nothing."""


_OPERANDS: Mapping[type, Callable[[Any], tuple[Node, ...]]] = {
    Binary: lambda node: (node.left, node.right),
    Call: lambda node: node.args,
    Unary: lambda node: (node.operand,),
    Arrayed: lambda node: (node.operand,),
    Direction: lambda node: (node.y, node.x),
    TriangleAngle: lambda node: (node.opposite, node.beside, node.other),
    Root: lambda node: node.given,
    Apply: lambda node: (node.function, *node.args),
    SheetsRef: lambda node: (node.area,),
    RangeRef: lambda node: (node.start, node.end),
    ArrayLiteral: lambda node: tuple(item for row in node.rows for item in row),
}
"""Nodes that have operands; by their type, as trees are walked millions of times."""


def children(node: Node) -> tuple[Node, ...]:
    """The direct operands of a node, in reading order."""
    operands = _OPERANDS.get(type(node))
    return operands(node) if operands else ()


def walk(node: Node) -> Iterator[Node]:
    """The node and everything below it, parents first (a stack, not recursion: formulas may be deep)."""
    stack = [node]
    while stack:
        current = stack.pop()
        yield current
        operands = _OPERANDS.get(type(current))
        if operands:
            stack.extend(operands(current)[::-1])


def transform(node: Node, change: Callable[[Node], Node]) -> Node:
    """The tree with `change` applied to every node, leaves first. `change` returns its argument where nothing changes."""
    return _transformed(node, change, _CALLS)


_CALLS = 100
"""How far down a tree is followed by calls, which are quick; below that by a stack: a sum may have thousands of terms."""


def _transformed(node: Node, change: Callable[[Node], Node], calls: int) -> Node:
    operands = _OPERANDS.get(type(node))
    if operands is None:
        return change(node)
    if not calls:
        return _by_stack(node, change)
    below = operands(node)
    # leaves, which are most of a tree, are changed here: a call for each would cost more than the change
    changed = tuple(
        [_transformed(each, change, calls - 1) if type(each) in _OPERANDS else change(each) for each in below]
    )
    return change(_with_operands(node, below, changed))


def _by_stack(node: Node, change: Callable[[Node], Node]) -> Node:
    done: list[Node] = []
    stack: list[tuple[Node, bool]] = [(node, False)]
    while stack:
        current, visited = stack.pop()
        below = children(current)
        if below and not visited:
            stack.append((current, True))
            stack.extend((child, False) for child in reversed(below))
            continue
        if below:
            changed = tuple(done[-len(below) :])
            del done[-len(below) :]
            current = _with_operands(current, below, changed)
        done.append(change(current))
    return done[0]


def _with_operands(node: Node, old: tuple[Node, ...], new: tuple[Node, ...]) -> Node:
    return node if all(map(is_, old, new)) else rebuilt(node, new)


def rebuilt(node: Node, below: tuple[Node, ...]) -> Node:
    """The node with other operands, given in the order of `children`."""
    match node:
        case Binary():
            return Binary(node.op, below[0], below[1])
        case Call():
            return Call(node.name, below)
        case RangeRef():
            start, end = below
            if isinstance(start, CellRef) and isinstance(end, CellRef):
                return RangeRef(start, end)
            return ErrorValue("#REF!")
        case Unary():
            return Unary(node.op, below[0])
        case Arrayed():
            return Arrayed(below[0])
        case Direction():
            return Direction(*below)
        case TriangleAngle():
            return TriangleAngle(*below)
        case Root():
            return Root(node.unknown, below)
        case Apply():
            return Apply(below[0], below[1:])
        case SheetsRef(first, last, _):
            return below[0] if isinstance(below[0], ErrorValue) else SheetsRef(first, last, below[0])
        case ArrayLiteral(rows):
            items = iter(below)
            return ArrayLiteral(tuple(tuple(next(items) for _ in row) for row in rows))
        case _:
            return node


def with_symbols(node: Node, values: Mapping[str, Node]) -> Node:
    """The tree with other expressions in place of some of its symbols; what they hold themselves stays."""
    return transform(node, lambda part: values.get(part.name, part) if isinstance(part, Symbol) else part)


def renamed(node: Node, names: Mapping[str, str]) -> Node:
    """The tree with some of its symbols under other names."""
    return with_symbols(node, {old: Symbol(new) for old, new in names.items()})


def symbols(node: Node) -> tuple[str, ...]:
    """Names of the quantities read from this row, each once, in reading order."""
    return tuple(dict.fromkeys(part.name for part in walk(node) if isinstance(part, Symbol)))


def calls(node: Node) -> tuple[str, ...]:
    """Names of the functions that are called, each once, in reading order."""
    return tuple(dict.fromkeys(part.name for part in walk(node) if isinstance(part, Call)))


def anchored(part: Node) -> Node:
    """A reference that means these cells wherever it is read: $A$1; what is none stays as it is."""
    return CellRef(part.row, part.col, True, True, part.sheet) if isinstance(part, CellRef) else part


def shifted(node: Node, rows: int, cols: int = 0, wrap: bool = False) -> Node:
    """The formula as fill-down (or fill-right) writes it `rows` further down and `cols` further right.

    wrap  beyond the last row comes the first one, as in the relative references of defined names; else there is #REF!
    """
    if rows == cols == 0 and not wrap:
        return node

    def move(part: Node) -> Node:
        if not isinstance(part, CellRef):
            return part
        row = part.row if part.row_abs else part.row + rows
        col = part.col if part.col_abs else part.col + cols
        if wrap:
            row, col = row % MAX_ROWS, col % MAX_COLUMNS
        if 0 <= row < MAX_ROWS and 0 <= col < MAX_COLUMNS:
            return CellRef(row, col, part.row_abs, part.col_abs, part.sheet)
        return ErrorValue("#REF!")

    return transform(node, move)

"""Ways in which a formula goes wrong: each turns a tree into one that is wrong in one place."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from livesheet.formula.nodes import (
    MAX_COLUMNS,
    MAX_ROWS,
    Binary,
    Call,
    CellRef,
    NameRef,
    Node,
    Number,
    Text,
    Unary,
    transform,
)


@dataclass(frozen=True, slots=True)
class Damage:
    """One damage: `new` stands in place of the node that `transform` visits as number `place`.

    kind  "operator", "reference", "anchor", "sign", "function" or "constant"
    """

    kind: str
    place: int
    new: Node

    def of(self, formula: Node) -> Node:
        """The formula with the damage."""
        count = -1

        def change(part: Node) -> Node:
            nonlocal count
            count += 1
            return self.new if count == self.place else part

        return transform(formula, change)


OPERATORS = {
    "+": ("-",),
    "-": ("+",),
    "*": ("/", "+"),
    "/": ("*",),
    "^": ("*",),
    "=": ("<>",),
    "<>": ("=",),
    "<": (">", "<="),
    ">": ("<", ">="),
    "<=": (">", "<"),
    ">=": ("<", ">"),
}
"""Operator -> what is typed instead."""

ARITHMETIC = ("+", "-", "*", "/", "^")

FUNCTIONS = {
    "SIN": "COS",
    "COS": "SIN",
    "TAN": "SIN",
    "ASIN": "ACOS",
    "ACOS": "ASIN",
    "ATAN": "TAN",
    "SQRT": "ABS",
    "SIGN": "ABS",
    "RADIANS": "DEGREES",
    "DEGREES": "RADIANS",
    "MAX": "MIN",
    "MIN": "MAX",
    "LARGE": "SMALL",
    "SMALL": "LARGE",
    "SUM": "AVERAGE",
    "AVERAGE": "SUM",
    "COUNT": "SUM",
    "COUNTIF": "SUMIF",
    "SUMPRODUCT": "SUMSQ",
    "AND": "OR",
    "OR": "AND",
    "ROUND": "ROUNDDOWN",
    "ISNUMBER": "ISTEXT",
    "INT": "ABS",
}
"""Function -> the one that is taken for it, with the same arguments."""

LEFT_OUT = ("RADIANS", "DEGREES", "ABS", "SQRT", "ROUND", "NOT", "IFERROR")
"""Functions that may be forgotten: their first argument stands alone."""

SWAPPED = {"ATAN2": (1, 0), "IF": (0, 2, 1)}
"""Functions whose arguments are taken in another order."""


def damages(formula: Node, names: Sequence[str] = ()) -> list[Damage]:
    """Every damage of a formula, each in one place, in the order of the tree.

    `names`: the book's names, which may be taken for each other.
    """
    parts: list[Node] = []

    def see(part: Node) -> Node:
        parts.append(part)
        return part

    transform(formula, see)
    return [
        Damage(kind, place, new)
        for place, part in enumerate(parts)
        for kind, new in _variants(part, names)
        if new != part
    ]


def _variants(part: Node, names: Sequence[str]) -> Iterator[tuple[str, Node]]:
    """What may stand in the place of one node."""
    match part:
        case Binary(op, left, right):
            for other in OPERATORS.get(op, ()):
                yield "operator", Binary(other, left, right)
            if op in ARITHMETIC:
                yield "sign", Binary(op, Unary("-", left), right)
            if op == "*":
                yield "sign", Binary(op, left, Unary("-", right))
        case Unary("-", operand):
            yield "sign", operand
        case CellRef():
            yield from (("reference", moved) for moved in neighbours(part))
            yield "anchor", replace(part, row_abs=not part.row_abs)
            yield "anchor", replace(part, col_abs=not part.col_abs)
        case NameRef(name, None):
            known = [other for other in names if other.casefold() != name.casefold()]
            if known:
                after = next((other for other in known if other > name), known[0])
                yield "reference", NameRef(after)
        case Call(name, args):
            yield from (("function", call) for call in _calls(name, args))
        case Number(value):
            yield "constant", Number(value + 1.0)
            if value:
                yield "constant", Number(value * 1.01)
                yield "constant", Number(-value)
        case Text(value) if value:
            yield "constant", Text(value + "x")


def neighbours(cell: CellRef) -> Iterator[CellRef]:
    """The cells below, above and beside one, within the sheet."""
    for down, right in ((1, 0), (-1, 0), (0, 1), (0, -1)):
        row, col = cell.row + down, cell.col + right
        if 0 <= row < MAX_ROWS and 0 <= col < MAX_COLUMNS:
            yield replace(cell, row=row, col=col)


def _calls(name: str, args: tuple[Node, ...]) -> Iterator[Node]:
    if name in FUNCTIONS:
        yield Call(FUNCTIONS[name], args)
    if name in LEFT_OUT and args:
        yield args[0]
    order = SWAPPED.get(name, ())
    if order and len(args) == len(order):
        yield Call(name, tuple(args[index] for index in order))

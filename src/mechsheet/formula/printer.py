"""Tree to text, with the fewest parentheses that say what the tree says in the dialect's own way of binding."""

from __future__ import annotations

import re
from collections.abc import Callable

from ..diagnostics import FormulaError
from .dialects import DIALECTS, MAX_NESTING, Dialect
from .functions import spelling
from .nodes import (
    MAX_COLUMNS,
    MAX_ROWS,
    ArrayLiteral,
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    Missing,
    NameRef,
    Node,
    Number,
    Previous,
    RangeRef,
    Symbol,
    Text,
    Unary,
)
from .parser import DESCRIPTION_FUNCTIONS
from .references import column_letters, parse_cell, reference_text

_ATOM = 1000
_UNION = 5  # a union stands in parentheses everywhere but inside its own
_PLAIN_SHEET = re.compile(r"[^\W\d]\w*")
_R1C1 = re.compile(r"[rR]?[0-9]*[cC]?[0-9]*")
_DESCRIPTION_NAMES = {tree: name for name, tree in DESCRIPTION_FUNCTIONS.items()}


def print_formula(node: Node, dialect: str = "excel") -> str:
    """The text of a tree.

    "excel"        what an .xlsx holds in <f>: no leading `=`, English, commas
    "openformula"  what follows `of:=`: `[.A1]`, semicolons, arrays with `|`
    "description"  the description's own expressions; only symbols, numbers and its functions can be said in it
    "text"         for people: textbook binding, small letters, `;` between arguments, atan2(x; y) as in the cell

    Numbers have the fewest digits that read back as the same number. Raises FormulaError beyond MAX_NESTING levels, and
    ValueError for a tree that the dialect cannot say (a symbol in a workbook, a cell in a description).
    """
    return _Printer(DIALECTS[dialect]).text(node)


def number_text(value: float, exponent: str = "E") -> str:
    """The shortest text that reads back as `value`, without a needless `.0`: 5, 0.1, 1E+22."""
    if value != value or value in (float("inf"), float("-inf")):
        raise ValueError(f"{value} is no number of a formula")
    text = repr(float(value))
    return text.removesuffix(".0").replace("e", exponent)


def quote_sheet(sheet: str) -> str:
    """A sheet's name as a reference spells it: quoted unless it is a plain word that looks like no cell."""
    plain = _PLAIN_SHEET.fullmatch(sheet) and not parse_cell(sheet) and not _R1C1.fullmatch(sheet)
    if plain and sheet.upper() not in ("TRUE", "FALSE"):
        return sheet
    return "'" + sheet.replace("'", "''") + "'"


class _Printer:
    def __init__(self, dialect: Dialect) -> None:
        self.dialect = dialect
        self.depth = 0
        self.reference: Callable[[CellRef | RangeRef], str] = {
            "openformula": _openformula_reference,
            "excel": _excel_reference,
            "text": _excel_reference,
        }.get(dialect.name, _no_reference)

    def text(self, node: Node) -> str:
        return self.bound(node)[0]

    def bound(self, node: Node) -> tuple[str, int]:
        """The text and how strongly its outermost operator binds."""
        match node:
            case Number(value):
                return self.number(value)
            case Unary(op, operand):
                return self.unary(op, operand)
            case Binary():
                return self.chain(node)
            case Call(name, args):
                return self.call(name, args)
            case ArrayLiteral(rows):
                lines = (self.dialect.array_column.join(self.text(item) for item in row) for row in rows)
                return "{" + self.dialect.array_row.join(lines) + "}", _ATOM
            case CellRef() | RangeRef():
                return self.reference(node), _ATOM
            case _:
                return self.word(node), _ATOM

    def inside(self, node: Node, minimum: int) -> str:
        """The text as an operand of something that binds with `minimum`: in parentheses where it binds less strongly."""
        self.depth += 1
        if self.depth > MAX_NESTING:
            raise FormulaError(f"a formula nested deeper than {MAX_NESTING} levels cannot be written")
        text, power = self.bound(node)
        self.depth -= 1
        return f"({text})" if power < minimum else text

    def number(self, value: float) -> tuple[str, int]:
        small = self.dialect.name in ("description", "text")
        text = number_text(value, "e" if small else "E")
        return text, self.dialect.prefix if text.startswith("-") else _ATOM

    def unary(self, op: str, operand: Node) -> tuple[str, int]:
        if op == "%":
            return self.inside(operand, self.dialect.postfix) + "%", self.dialect.postfix
        return op + self.inside(operand, self.dialect.prefix), self.dialect.prefix

    def chain(self, node: Binary) -> tuple[str, int]:
        """A run of operators down the left side, in one loop: a sum may have thousands of terms."""
        run: list[Binary] = []
        left: Node = node
        while isinstance(left, Binary):
            run.append(left)
            left = left.left
        text, power = self.operand(left)
        for part in reversed(run):
            text, power = self.infix(part.op, text, power, part.right)
        return text, power

    def operand(self, node: Node) -> tuple[str, int]:
        self.depth += 1
        text, power = self.bound(node)
        self.depth -= 1
        return text, power

    def infix(self, op: str, left: str, left_power: int, right: Node) -> tuple[str, int]:
        if op == "," and self.dialect.name == "excel":
            # The union's own parentheses come from `inside`; at the top and as an argument it binds least of all.
            left = left[1:-1] if left_power == _UNION else left
            return f"({left},{self.inside(right, 0)})", _UNION
        if op not in self.dialect.infix:
            raise ValueError(f"{op!r} cannot be written in {self.dialect.name}")
        power = self.dialect.infix[op]
        leans_right = op in self.dialect.leans_right
        if left_power == _UNION:
            left_power = _ATOM
        if left_power < power + leans_right:
            left = f"({left})"
        text = self.inside(right, power + (not leans_right))
        sign = self.dialect.spelling.get(op, op)
        if op in self.dialect.spaced:
            sign = f" {sign} "
        return f"{left}{sign}{text}", power

    def call(self, name: str, args: tuple[Node, ...]) -> tuple[str, int]:
        if self.dialect.name == "description":
            return self.description_call(name, args)
        if self.dialect.name == "text":
            if name == "PI" and not args:
                return "pi", _ATOM
            if name == "SUMSQ" and not any(isinstance(arg, RangeRef) for arg in args):
                return self.bound(_squares(args))
            shown = name.lower()
        else:
            shown = spelling(name, self.dialect.name)
        return f"{shown}({self.arguments(args)})", _ATOM

    def arguments(self, args: tuple[Node, ...]) -> str:
        return self.dialect.argument.join(self.inside(arg, 0) for arg in args)

    def description_call(self, name: str, args: tuple[Node, ...]) -> tuple[str, int]:
        if name == "PI" and not args:
            return "pi", _ATOM
        match name, args:
            case "SQRT", (Call("SUMSQ", (_, _) as legs),):
                return f"hypot({self.arguments(legs)})", _ATOM
        if name not in _DESCRIPTION_NAMES:
            raise ValueError(f"{name} cannot be written in a description")
        ordered = args[::-1] if name == "ATAN2" else args
        return f"{_DESCRIPTION_NAMES[name]}({self.arguments(ordered)})", _ATOM

    def word(self, node: Node) -> str:
        name = self.dialect.name
        match node:
            case Symbol(symbol) if name in ("description", "text"):
                return symbol
            case Previous(symbol) if name == "text":
                return f"previous({symbol})"
            case _ if name == "description":
                raise ValueError(f"{type(node).__name__} cannot be written in a description")
            case Text(value):
                return '"' + value.replace('"', '""') + '"'
            case Boolean(value):
                shown = "TRUE" if value else "FALSE"
                return shown + "()" if name == "openformula" else shown.lower() if name == "text" else shown
            case ErrorValue(code):
                return code
            case Missing():
                return ""
            case NameRef(word, None):
                return word
            case NameRef(word, str(sheet)):
                return f"${quote_sheet(sheet)}.{word}" if name == "openformula" else f"{quote_sheet(sheet)}!{word}"
            case _:
                raise ValueError(f"{type(node).__name__} cannot be written in {name}")


def _squares(args: tuple[Node, ...]) -> Node:
    """x^2 + y^2, which a person reads sooner than SUMSQ(x; y)."""
    total: Node = Binary("^", args[0], Number(2))
    for arg in args[1:]:
        total = Binary("+", total, Binary("^", arg, Number(2)))
    return total


def _no_reference(node: CellRef | RangeRef) -> str:
    raise ValueError(f"{type(node).__name__} cannot be written in a description")


def _corners(node: RangeRef, before: str) -> tuple[str, str]:
    """The two sides of the colon; `before` stands in front of each column or row. Whole columns lose their rows."""
    start, end = node.start, node.end
    if start.row == 0 and end.row == MAX_ROWS - 1 and start.row_abs and end.row_abs:
        first, second = ("$" * ref.col_abs + column_letters(ref.col) for ref in (start, end))
    elif start.col == 0 and end.col == MAX_COLUMNS - 1 and start.col_abs and end.col_abs:
        first, second = ("$" * ref.row_abs + str(ref.row + 1) for ref in (start, end))
    else:
        first, second = reference_text(start), reference_text(end)
    return before + first, before + second


def _excel_reference(node: CellRef | RangeRef) -> str:
    if isinstance(node, CellRef):
        sheet, text = node.sheet, reference_text(node)
    else:
        sheet, text = node.start.sheet, ":".join(_corners(node, ""))
    return text if sheet is None else f"{quote_sheet(sheet)}!{text}"


def _openformula_reference(node: CellRef | RangeRef) -> str:
    if isinstance(node, CellRef):
        sheet, text = node.sheet, "." + reference_text(node)
    else:
        sheet, text = node.start.sheet, ":".join(_corners(node, "."))
    return f"[{text}]" if sheet is None else f"[${quote_sheet(sheet)}{text}]"

"""Tree to text, with the fewest parentheses that say what the tree says in the dialect's own way of binding.

How long a text is for those who read it in another language: SQRT is PIERWIASTEK in Polish, KAREKÖK in Turkish. A file holds
English names. Excel counts the characters of a formula as its user reads it: one of 8,000 characters here may have 12,000
there, and can then not be edited any more.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from typing import NamedTuple, TypeAlias

from ..diagnostics import FormulaError
from ..said import say
from .dialects import DIALECTS, MAX_NESTING, Dialect
from .functions import spelling
from .nodes import (
    MAX_COLUMNS,
    MAX_ROWS,
    Apply,
    ArrayLiteral,
    Binary,
    Boolean,
    Call,
    CellRef,
    ErrorValue,
    Foreign,
    FunctionRef,
    Local,
    Missing,
    NameRef,
    Node,
    Number,
    Previous,
    RangeRef,
    SheetsRef,
    Symbol,
    TableRef,
    Text,
    Unary,
    children,
    transform,
    walk,
)
from .parser import DESCRIPTION_FUNCTIONS
from .references import column_letters, parse_cell, reference_text
from .tables import table_text
from .written import WRITTEN, pairwise, plain_degrees, real_powers, signs_apart

_ATOM = 1000
_UNION = _ATOM + 1  # a union in its own parentheses, which a union around it takes off
_PLAIN_SHEET = re.compile(r"(?=[\0-ÿ])[^\W\d]\w*")  # LibreOffice's charts want quotes around others, as U+015E
_R1C1 = re.compile(r"[rR]?[0-9]*[cC]?[0-9]*")
_DESCRIPTION_NAMES = {tree: name for name, tree in DESCRIPTION_FUNCTIONS.items()} | {"HYPOT": "hypot"}


Names: TypeAlias = Callable[[Symbol | Previous], str]
"""How a program or a textbook spells a quantity of this row, and of the row above."""


def print_formula(
    node: Node, dialect: str = "excel", names: Names | None = None, calls: Mapping[str, str] | None = None
) -> str:
    """The text of a tree.

    "excel"        what an .xlsx holds in <f>: no leading `=`, English, commas
    "openformula"  what follows `of:=`: `[.A1]`, semicolons, arrays with `|`
    "description"  the description's own expressions; only symbols, numbers and its functions can be said in it
    "text"         for people: textbook binding, small letters, `;` between arguments, atan2(x; y) as in the cell
    others         those of `written.py`, in which `names` spells the quantities; `calls` are functions beside its own

    Numbers have the fewest digits that read back as the same number. Raises FormulaError beyond MAX_NESTING levels, and
    ValueError for a tree that the dialect cannot say (a symbol in a workbook, a cell in a description).
    """
    table = DIALECTS.get(dialect) or WRITTEN[dialect]
    return _Printer(replace(table, calls={**table.calls, **calls}) if calls else table, names).text(node)


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


class _Printed(NamedTuple):
    """A piece of text, how strongly its outermost operator binds, and how deep things are nested in it."""

    text: str
    power: int
    depth: int = 0


class _Printer:
    """Puts texts together from the leaves up, with a stack of its own: a sum may have thousands of terms."""

    def __init__(self, dialect: Dialect, names: Names | None = None) -> None:
        self.dialect = dialect
        self.names = names
        self.reference: Callable[[CellRef | RangeRef], str] = {
            "openformula": _openformula_reference,
            "excel": _excel_reference,
            "text": _excel_reference,
        }.get(dialect.name, _no_reference)

    def text(self, root: Node) -> str:
        done: list[_Printed] = []
        rewrite = _REWRITES.get(self.dialect.name)
        # with each node how many of the texts that are done are its operands'; -1 while they are not
        stack = [(transform(root, rewrite) if rewrite else root, -1)]
        while stack:
            node, count = stack.pop()
            if count < 0:
                below = () if isinstance(node, RangeRef) else children(node)
                if below:
                    stack.append((node, len(below)))
                    stack += [(child, -1) for child in reversed(below)]
                    continue
                done.append(self.piece(node, []))
                continue
            parts = done[-count:]
            del done[-count:]
            done.append(self.piece(node, parts))
            if done[-1].depth > MAX_NESTING:
                raise FormulaError(
                    say("a formula nested deeper than {most} levels cannot be written", most=MAX_NESTING)
                )
        return done[0].text

    def piece(self, node: Node, parts: list[_Printed]) -> _Printed:
        """A node's text from those of its operands."""
        match node:
            case Number(value):
                return self.number(value)
            case Unary(op, _):
                return self.unary(op, parts[0])
            case Binary(op, _, _):
                return self.infix(op, *parts)
            case Call(name, _):
                return self.call(name, parts, node.args)
            case ArrayLiteral(rows):
                items = iter(parts)
                lines = (self.dialect.array_column.join(next(items).text for _ in row) for row in rows)
                return _Printed("{" + self.dialect.array_row.join(lines) + "}", _ATOM)
            case CellRef() | RangeRef():
                return _Printed(self.reference(node), _ATOM)
            case SheetsRef(first, last, _):
                return _Printed(self.through_sheets(first, last, parts[0].text), _ATOM)
            case Apply():
                function, *args = parts
                text = f"{function.text}({self.dialect.argument.join(arg.text for arg in args)})"
                return _Printed(text, _ATOM, max(part.depth for part in parts) + 1)
            case _:
                word = self.word(node)
                signed = self.dialect.sets_signs_apart and word.startswith("-")
                return _Printed(word, self.dialect.prefix if signed else _ATOM)

    def number(self, value: float) -> _Printed:
        text = number_text(value, "e" if self.dialect.small else "E")
        return _Printed(text, self.dialect.prefix if text.startswith("-") else _ATOM)

    def unary(self, op: str, operand: _Printed) -> _Printed:
        if op == "%":
            inner = _inside(operand, self.dialect.postfix)
            return _Printed(inner.text + "%", self.dialect.postfix, inner.depth)
        inner = _inside(operand, self.dialect.prefix)
        if self.dialect.sets_signs_apart and inner.text.startswith("-"):
            inner = _Printed(f"({inner.text})", _ATOM, inner.depth + 1)
        return _Printed(op + inner.text, self.dialect.prefix, inner.depth + 1)

    def infix(self, op: str, left: _Printed, right: _Printed) -> _Printed:
        if op == "," and self.dialect.name == "excel":
            # A union brings its own parentheses, because a comma alone would separate arguments.
            if left.power == _UNION:  # one more area inside the same parentheses
                return _Printed(f"({left.text[1:-1]},{right.text})", _UNION, max(left.depth, right.depth + 1))
            return _Printed(f"({left.text},{right.text})", _UNION, max(left.depth, right.depth) + 1)
        if op not in self.dialect.infix:
            raise ValueError(f"{op!r} cannot be written in {self.dialect.name}")
        power = self.dialect.infix[op]
        if op in self.dialect.shapes:
            return self.shaped(op, left, right)
        leans_right = op in self.dialect.leans_right
        left, right = _inside(left, power + leans_right), _inside(right, power + (not leans_right))
        if self.dialect.sets_signs_apart and right.text.startswith("-"):
            right = _Printed(f"({right.text})", _ATOM, right.depth + 1)
        sign = self.dialect.spelling.get(op, op)
        if op in self.dialect.spaced:
            sign = f" {sign} "
        depth = max(left.depth, right.depth + leans_right)
        return _Printed(f"{left.text}{sign}{right.text}", power, depth)

    def shaped(self, op: str, left: _Printed, right: _Printed) -> _Printed:
        """An operator that is drawn: what stands in braces needs no parentheses."""
        shape = self.dialect.shapes[op]
        if op == "^":
            left = _inside(left, _ATOM)
        power = self.dialect.infix[op]
        return _Printed(shape.format(left.text, right.text), power, max(left.depth, right.depth) + 1)

    def call(self, name: str, parts: list[_Printed], args: tuple[Node, ...]) -> _Printed:
        if self.dialect.calls:
            return self.written_call(name, parts, args)
        if name == "PI" and not parts and self.dialect.name in ("description", "text"):
            return _Printed("pi", _ATOM)
        if self.dialect.name == "text":
            shown = name.lower()
        elif self.dialect.name != "description":
            shown = spelling(name, self.dialect.name)
        elif name in _DESCRIPTION_NAMES:
            shown = _DESCRIPTION_NAMES[name]
            parts = parts[::-1] if name == "ATAN2" else parts
        else:
            raise ValueError(f"{name} cannot be written in a description")
        arguments = self.dialect.argument.join(part.text for part in parts)
        return _Printed(f"{shown}({arguments})", _ATOM, max((part.depth for part in parts), default=0) + 1)

    def written_call(self, name: str, parts: list[_Printed], args: tuple[Node, ...]) -> _Printed:
        """A function of a dialect that is only written."""
        if name not in self.dialect.calls:
            raise ValueError(f"{name} cannot be written in {self.dialect.name}")
        depth = max((part.depth for part in parts), default=0) + 1
        texts = [part.text for part in parts]
        if name in self.dialect.short and isinstance(args[0], Symbol):
            return _Printed(self.dialect.short[name].format(*texts), self.dialect.infix["*"] + 1, depth)
        return _Printed(self.dialect.calls[name].format(*texts), _ATOM, depth)

    def through_sheets(self, first: str, last: str, area: str) -> str:
        """The same cells of several sheets."""
        if self.dialect.name != "openformula":
            quoted = any(quote_sheet(sheet) != sheet for sheet in (first, last))
            sheets = f"{first}:{last}"
            return (f"'{sheets.replace(chr(39), chr(39) * 2)}'" if quoted else sheets) + f"!{area}"
        start, _, end = area[1:-1].partition(":")
        return f"[${quote_sheet(first)}{start}:${quote_sheet(last)}{end or start}]"

    def word(self, node: Node) -> str:
        name = self.dialect.name
        if self.names is not None and isinstance(node, Symbol | Previous):
            return self.names(node)
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
            case Local(local, optional):
                return ("_xlop." if optional else "_xlpm.") + local if name == "excel" else local
            case FunctionRef(function, sheet):
                return function if sheet or name != "excel" else f"_xleta.{function}"
            case TableRef():
                return table_text(node)
            case Foreign(text):
                return text
            case NameRef(word, None):
                return word
            case NameRef(word, str(sheet)):
                return f"${quote_sheet(sheet)}.{word}" if name == "openformula" else f"{quote_sheet(sheet)}!{word}"
            case _:
                raise ValueError(f"{type(node).__name__} cannot be written in {name}")


def _inside(part: _Printed, minimum: int) -> _Printed:
    """An operand of something that binds with `minimum`: in parentheses where it binds less strongly."""
    return part if part.power >= minimum else _Printed(f"({part.text})", _ATOM, part.depth + 1)


def _with_squares(node: Node) -> Node:
    """x^2 + y^2, which a person reads sooner than SUMSQ(x; y)."""
    if not isinstance(node, Call) or node.name != "SUMSQ" or any(isinstance(arg, RangeRef) for arg in node.args):
        return node
    total: Node = Binary("^", node.args[0], Number(2))
    for arg in node.args[1:]:
        total = Binary("+", total, Binary("^", arg, Number(2)))
    return total


def _with_hypot(node: Node) -> Node:
    match node:
        case Call("SQRT", (Call("SUMSQ", (x, y)),)):
            return Call("HYPOT", (x, y))
    return node


_REWRITES = {
    "text": _with_squares,
    "description": _with_hypot,
    "octave": plain_degrees,
    "python": real_powers,
    "geogebra": plain_degrees,
    "latex": pairwise,
    "numbers": pairwise,
    "basic": signs_apart,
}


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


LONGEST_NAMES = {
    "ABS": 12, "ACOS": 7, "AND": 4, "ASIN": 7, "ATAN": 7, "ATAN2": 8, "CHOOSE": 15, "COLUMN": 11, "COS": 3, "COUNT": 12,
    "COUNTIF": 11, "COUNTIFS": 18, "DEGREES": 7, "EXP": 11, "IF": 6, "IFERROR": 11, "INDEX": 7, "INT": 13, "ISNA": 19,
    "ISNUMBER": 10, "ISTEXT": 9, "LARGE": 13, "LN": 8, "LOG10": 5, "MATCH": 13, "MAX": 6, "MIN": 6, "MOD": 7, "NA": 16,
    "NOT": 5, "OR": 5, "PI": 8, "RADIANS": 9, "ROUND": 11, "ROW": 8, "SIGN": 11, "SIN": 4, "SMALL": 13, "SQRT": 11, "SUM": 6,
    "SUMIF": 11, "SUMPRODUCT": 19, "SUMSQ": 14, "TAN": 3, "TEXT": 15, "VALUE": 11,
}  # fmt: skip
"""Characters of a function's longest name among 17 languages of Excel (bg cs da de es fi fr hu it nb nl pl pt pt-BR ru sv
tr; the lists of PhpSpreadsheet 5)."""

MORE = 8
"""So many characters longer a function may be that is not among them."""


def longest_spelling(node: Node) -> int:
    """Characters of a formula, without the equals sign, in the language where it has most."""
    return len(print_formula(node, "excel")) + extra_characters(node)


def extra_characters(node: Node) -> int:
    """By how many characters a formula is longer in the language where it has most."""
    calls = (part.name for part in walk(node) if isinstance(part, Call))
    return sum(max(0, LONGEST_NAMES.get(name, len(name) + MORE) - len(name)) for name in calls)

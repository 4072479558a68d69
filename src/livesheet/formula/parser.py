"""Text to tree, for the description's expressions and for the formulas of both workbook formats."""

from __future__ import annotations

import re

from ..diagnostics import Fault, FormulaError, near_miss
from ..said import say, say_count
from .dialects import DESCRIPTION, DIALECTS, Dialect
from .functions import MANY, canonical_name
from .lexer import COMPARED, QUOTED, Token, fail
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
    RangeRef,
    SheetsRef,
    Symbol,
    Text,
)
from .precedence import Parser, number_value
from .references import COLUMN, ROW, column_index, parse_reference
from .tables import parse_table

_LOCAL = "_xlpm."
"""Before the names that LET and LAMBDA give, in an .xlsx."""
_OPTIONAL = "_xlop."
"""Before the names of LAMBDA that a call may leave out."""
_FUNCTION = "_xleta."
"""Before the name of a function that is an argument itself."""


class SheetParser(Parser):
    """Keeps the spaces: one of them may be the intersection."""

    spaces = True

    _STARTS = frozenset(("cell", "columns", "rows", "sheet", "name", "function", "open", "reference", "error", "table"))

    def operator(self) -> str | None:
        """As above; a space between two references is the intersection, any other space means nothing."""
        if self.next.kind == "space":
            after = next(t for t in self.tokens[self.place :] if t.kind != "space")
            if self.dialect.name == "excel" and after.kind in self._STARTS:
                return " "
            self.skip_space()
        return super().operator()

    def pass_operator(self, op: str) -> None:
        """On past the operator; the space that is an intersection is all of it."""
        if op == " ":
            self.skip_space()
        if self.dialect.name != "excel" or op != " ":
            self.take()

    def combine(self, op: str, left: Node, right: Node) -> Node:
        """The node of an infix operator; two cells and a colon are one range."""
        if op == ":" and isinstance(left, SheetsRef) and isinstance(left.area, CellRef) and isinstance(right, CellRef):
            return SheetsRef(left.first, left.last, RangeRef(left.area, right))
        if op == ":" and isinstance(left, CellRef) and isinstance(right, CellRef) and right.sheet in (None, left.sheet):
            return RangeRef(left, CellRef(right.row, right.col, right.row_abs, right.col_abs, left.sheet))
        if op == ":" and any(isinstance(side, Number | Text | Boolean) for side in (left, right)):
            raise fail(self.text, self.next.column, say('a constant beside ":", where references stand, before'))
        return Binary(op, left, right)

    def operand(self) -> Node:
        """What an operator works on, with the spill operator `#` behind it and calls of what it gives."""
        if self.next.text == "@" and self.next.kind == "op":
            self.take()
            self.deeper()
            node: Node = Call("SINGLE", (self.expression(self.dialect.infix[" "]),))
            self.depth -= 1
            return node
        node = self.simple_operand()
        while True:
            if self.next.text == "#" and self.next.kind == "op":
                self.take()
                node = Call("ANCHORARRAY", (node,))
            elif self.next.kind == "open" and isinstance(node, Call | Apply | Foreign):
                node = Apply(node, self.arguments())
            else:
                return node

    def error(self) -> ErrorValue:
        """An error; one in place of a deleted sheet's title has the cells behind it."""
        text = self.take().text
        return ErrorValue("#REF!" if text.startswith("#REF!") else text)

    def simple_operand(self) -> Node:
        """A constant, a reference, a name, a function's call, an array, or something in parentheses."""
        token = self.next
        match token.kind:
            case "number":
                return Number(number_value(self.text, self.take()))
            case "text":
                return Text(self.take().text[1:-1].replace('""', '"'))
            case "error":
                return self.error()
            case "open":
                return self.parenthesised()
            case "array":
                return self.array()
            case "function":
                return self.function()
            case "sheet":
                return self.qualified()
            case "reference":
                return _bracketed(self.text, self.take())
            case "table":
                table = parse_table(self.take().text)
                if table is None:
                    raise fail(self.text, token.column, say("{text} is not a structured reference,", text=token.text))
                return table
            case "cell" | "columns" | "rows" | "name":
                return self.reference(None)
            case _:
                raise self.unexpected(say('a value, a reference, a function or "("'))

    def parenthesised(self) -> Node:
        """What stands in parentheses; in OOXML commas there are unions."""
        self.take()
        self.deeper()
        node = self.expression(0)
        self.skip_space()
        while self.dialect.name == "excel" and self.next.kind == "separator":
            self.take()
            node = Binary(",", node, self.expression(0))
            self.skip_space()
        self.close()
        return node

    def function(self) -> Node:
        """A function's call."""
        written = self.take().text
        args = self.arguments()
        if written.lower().startswith(_LOCAL):
            return Apply(Local(_folded(written)), args)
        name = canonical_name(written, self.dialect.name)
        if name in ("TRUE", "FALSE") and not args:
            return Boolean(name == "TRUE")
        return Call(name, args)

    def argument(self) -> Node:
        """An argument, or that it is missing."""
        self.skip_space()
        if self.next.kind in ("separator", "close"):
            return Missing()
        node = self.expression(0)
        self.skip_space()
        return node

    def array(self) -> Node:
        """`{1,2;3,4}`."""
        self.take()
        rows: list[list[Node]] = [[]]
        while True:
            self.skip_space()
            rows[-1].append(self.constant())
            self.skip_space()
            kind = self.next.kind
            if kind == "separator":
                self.take()
            elif kind == "row_separator":
                self.take()
                rows.append([])
            elif kind == "array_end":
                self.take()
                break
            else:
                raise self.unexpected(say('a separator or "}"'))
        if len({len(row) for row in rows}) > 1:
            raise fail(self.text, self.next.column, say("the rows of an array differ in length"))
        return ArrayLiteral(tuple(tuple(row) for row in rows))

    def constant(self) -> Node:
        """One item of an array."""
        sign = self.take().text if self.next.kind == "op" and self.next.text in "+-" else ""
        if self.next.kind == "number":
            value = number_value(self.text, self.take())
            return Number(-value if sign == "-" else value)
        if not sign:
            if self.next.kind in ("text", "error"):
                return self.operand()
            if self.next.text.upper() in ("TRUE", "FALSE"):
                value_text = self.take().text.upper()
                if self.next.kind == "open":
                    self.take()
                    self.deeper()
                    self.close()
                return Boolean(value_text == "TRUE")
        raise self.unexpected(say("a constant of an array"))

    def qualified(self) -> Node:
        """What follows `Sheet1!` (in OpenFormula, `$Sheet1.` before a name)."""
        token = self.take()
        sheet = _unquote(token.text[:-1].removeprefix("$"))
        if sheet == "[0]":  # this workbook itself
            sheet = ""
        if "[" in sheet and self.next.kind in ("cell", "columns", "rows", "name", "function", "error"):
            return Foreign(token.text + self.take().text)
        if self.next.kind == "error":
            return self.error()
        if self.next.kind not in ("cell", "columns", "rows", "name"):
            raise self.unexpected(say("a reference or a name"))
        if ":" in sheet:
            first, _, last = sheet.partition(":")
            return SheetsRef(_unquote(first), _unquote(last), self.reference(None))
        return self.reference(sheet or None)

    def reference(self, sheet: str | None) -> Node:
        """A cell, whole columns or rows, a name, TRUE or FALSE."""
        token = self.take()
        if token.kind in ("columns", "rows"):
            first, second = token.text.split(":")
            return _strip(self.text, token, first, second, sheet)
        if token.kind == "cell":
            ref = parse_reference(token.text, sheet)
            if ref is not None:
                return ref
            if "$" in token.text:
                raise fail(self.text, token.column, say("{text} is outside the sheet,", text=token.text))
        word = token.text.lower()
        if sheet is None and word in ("true", "false"):
            return Boolean(word == "true")
        if sheet is None and word.startswith(_LOCAL):
            return Local(_folded(token.text))
        if sheet is None and word.startswith(_OPTIONAL):
            return Local(word[len(_OPTIONAL) :].casefold(), True)
        if sheet is None and word.startswith(_FUNCTION):
            return FunctionRef(canonical_name(token.text[len(_FUNCTION) :], self.dialect.name), "")
        return NameRef(token.text.removeprefix("$$"), sheet)  # LibreOffice's mark of a name of the whole document


def _unquote(sheet: str) -> str:
    return sheet[1:-1].replace("''", "'") if sheet.startswith("'") else sheet


def _strip(text: str, token: Token, first: str, second: str, sheet: str | None) -> RangeRef:
    """Whole columns (`A:C`) or whole rows (`1:3`)."""
    columns = COLUMN.fullmatch(first), COLUMN.fullmatch(second)
    if columns[0] and columns[1]:
        (abs1, a), (abs2, b) = columns[0].groups(), columns[1].groups()
        left, right = column_index(a.upper()), column_index(b.upper())
        if max(left, right) < MAX_COLUMNS:
            return RangeRef(
                CellRef(0, left, True, bool(abs1), sheet), CellRef(MAX_ROWS - 1, right, True, bool(abs2), sheet)
            )
    rows = ROW.fullmatch(first), ROW.fullmatch(second)
    if rows[0] and rows[1]:
        (abs1, a), (abs2, b) = rows[0].groups(), rows[1].groups()
        top, bottom = int(a) - 1, int(b) - 1
        if max(top, bottom) < MAX_ROWS:
            return RangeRef(
                CellRef(top, 0, bool(abs1), True, sheet), CellRef(bottom, MAX_COLUMNS - 1, bool(abs2), True, sheet)
            )
    raise fail(text, token.column, say("{text} is outside the sheet,", text=token.text))


def _folded(written: str) -> str:
    """A name of LET or LAMBDA without its mark."""
    return written[len(_LOCAL) :].casefold()


def _bracketed(text: str, token: Token) -> Node:
    """OpenFormula's `[.A1]`, `[$'Sheet x'.$A$1:.B2]`, `[.A:.A]`."""
    inside = token.text[1:-1]
    if "#REF!" in inside:
        return ErrorValue("#REF!")
    if re.match(rf"\$?{QUOTED}#", inside):
        return Foreign(token.text)
    sheet, rest = _sheet_part(text, token, inside)
    if ":" not in rest:
        ref = parse_reference(rest, sheet)
        if ref is None:
            raise fail(text, token.column, say("{text} is not a reference of a sheet,", text=token.text))
        return ref
    first, _, second = rest.partition(":")
    second_sheet, second = _sheet_part(text, token, second)
    if second_sheet not in (None, sheet):
        corners = parse_reference(first), parse_reference(second)
        if sheet is None or second_sheet is None or corners[0] is None or corners[1] is None:
            raise fail(text, token.column, say("{text} is not a reference of a sheet,", text=token.text))
        area = corners[0] if corners[0] == corners[1] else RangeRef(corners[0], corners[1])
        return SheetsRef(sheet, second_sheet, area)
    start, end = parse_reference(first, sheet), parse_reference(second, sheet)
    if start is None or end is None:
        return _strip(text, token, first, second, sheet)
    return RangeRef(start, end)


def _sheet_part(text: str, token: Token, part: str) -> tuple[str | None, str]:
    """(sheet or None, the rest after the dot)."""
    part = part.removeprefix("$")
    if part.startswith("'"):
        end = 1
        while part[end] != "'" or part[end + 1 : end + 2] == "'":
            end += 2 if part[end] == "'" else 1
        sheet, rest = part[: end + 1], part[end + 1 :]
    else:
        sheet, dot, rest = part.partition(".")
        rest = dot + rest
    if not rest.startswith("."):
        raise fail(text, token.column, say("{text} is not a reference of a sheet,", text=token.text))
    return (_unquote(sheet) or None), rest[1:]


_DESCRIPTION_ARITY = {"atan2": (2, 2), "hypot": (2, 2), "where": (3, 3), "min": (1, MANY), "max": (1, MANY)}
DESCRIPTION_FUNCTIONS = {
    name: name.upper()
    for name in (
        "sin", "cos", "tan", "asin", "acos", "atan", "atan2", "sqrt", "abs", "sign", "min", "max", "exp", "ln",
        "radians", "degrees",
    )
}  # fmt: skip
"""Description's function -> the tree's; `hypot` is beside them, as SQRT(SUMSQ(a, b))."""

_ALLOWED = (*DESCRIPTION_FUNCTIONS, "hypot", "where")

RESERVED = frozenset(("pi", *_ALLOWED))
"""Names that mean something in every expression."""


def parse_description(text: str) -> Node:
    """The tree of a description's expression: `+ - * / ^`, parentheses, numbers, `pi`, symbols (`C.x` too) and functions.

    `atan2(y, x)` becomes Call("ATAN2", (x, y)), `hypot(a, b)` SQRT(SUMSQ(a, b)),
    `where(c, x, y)` (x where c is greater than 0, else y) IF(c>0, x, y), `pi` PI(). Raises FormulaError with the
    column and what was expected; unknown functions and wrong numbers of arguments are all reported together.
    """
    return _DescriptionParser(text, DESCRIPTION).parse()


def parse_formula(text: str, dialect: str = "excel") -> Node:
    """The tree of a workbook's formula, in "excel" (OOXML, English) or "openformula" spelling, with or without its `=`.

    A relative reference means the cell it names, as seen from the cell the formula stands in. Any function name is taken
    (the engine reports those it does not know, with their cells). Raises FormulaError with the column.
    """
    body = text.removeprefix("of:") if dialect == "openformula" else text
    return SheetParser(body.removeprefix("="), DIALECTS[dialect]).parse()


class _DescriptionParser(Parser):
    def __init__(self, text: str, dialect: Dialect) -> None:
        super().__init__(text, dialect)
        self.faults: list[Fault] = []

    def parse(self) -> Node:
        node = super().parse()
        if self.faults:
            raise FormulaError(self.faults)
        return node

    def unexpected(self, expected: str, hint: str = "") -> FormulaError:
        token, before = self.next, self.tokens[self.place - 1] if self.place else None
        if token.text == "*" and before is not None and before.text == "*":
            hint = say('write "^" for a power')
        elif token.kind == "separator" and self.depth == 0:
            hint = say('the decimal sign is "."; "," stands between arguments only')
        elif token.text in ("deg", "degrees", "°") and before is not None and before.kind == "number":
            hint = say("write radians({number}) for {number} degrees", number=before.text)
        elif token.kind in ("name", "number", "open") and expected.startswith("an operator"):
            hint = say('a product is written with "*"')
        return super().unexpected(expected, hint)

    def operand(self) -> Node:
        token = self.next
        if token.kind == "number":
            return Number(number_value(self.text, self.take()))
        if token.kind == "open":
            return self.parenthesised()
        if token.kind != "name":
            raise self.unexpected(say('a number, a name, a function or "("'))
        self.take()
        if self.next.kind == "open":
            return self.function(token)
        if token.text == "pi":
            return Call("PI")
        if token.text in _ALLOWED:
            raise self.unexpected(say('"(" after the function {text}', text=token.text))
        return Symbol(token.text)

    def function(self, name: Token) -> Node:
        args = list(self.arguments())
        if name.text not in _ALLOWED:
            self.unknown(name)
            return Call(name.text, tuple(args))
        least, most = _DESCRIPTION_ARITY.get(name.text, (1, 1))
        if not least <= len(args) <= most:
            self.arity(name, len(args), least, most)
        elif name.text == "atan2":
            args.reverse()
        elif name.text == "hypot":
            return Call("SQRT", (Call("SUMSQ", tuple(args)),))
        elif name.text == "where":
            return Call("IF", (Binary(">", args[0], Number(0.0)), *args[1:]))
        return Call(DESCRIPTION_FUNCTIONS.get(name.text, "SQRT"), tuple(args))

    def unknown(self, name: Token) -> None:
        if name.text.lower() == "if":
            hint = COMPARED
        elif name.text == "pi":
            hint = say('pi is a number: write it without parentheses, "2*pi"')
        else:
            hint = near_miss(name.text.lower(), _ALLOWED) or say("functions: {names}", names=" ".join(_ALLOWED))
        message = say("unknown function {text} at column {column}", text=name.text, column=name.column)
        self.faults.append(Fault(message, source=self.text, hint=hint))

    def arity(self, name: Token, count: int, least: int, most: int) -> None:
        takes = say_count("1 argument", "{count} arguments", least)
        takes = say_count("at least 1 argument", "at least {count} arguments", least) if most == MANY else takes
        message = say(
            "{text} takes {takes}, found {count}, at column {column}",
            text=name.text,
            takes=takes,
            count=count,
            column=name.column,
        )
        self.faults.append(Fault(message, source=self.text))

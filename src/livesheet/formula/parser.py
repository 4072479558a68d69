"""Text to tree, for the description's expressions and for the formulas of both workbook formats."""

from __future__ import annotations

from ..diagnostics import Fault, FormulaError, near_miss
from ..said import say, say_count
from .dialects import DESCRIPTION, DIALECTS, Dialect
from .functions import MANY
from .lexer import COMPARED, Token
from .nodes import Binary, Call, Node, Number, Symbol
from .precedence import Parser, number_value
from .sheet_parser import SheetParser

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

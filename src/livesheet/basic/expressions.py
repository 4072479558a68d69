"""An expression in Basic as the tree of a formula: its operators bind otherwise, its functions have other names."""

from __future__ import annotations

import re

from ..diagnostics import FormulaError
from ..formula.dialects import COMPARISONS, MATHEMATICS, Dialect
from ..formula.functions import FUNCTIONS
from ..formula.lexer import Token
from ..formula.nodes import Binary, Boolean, Call, ErrorValue, Node, Number, Symbol, Text
from ..formula.precedence import Parser
from ..said import say

_TOKEN = re.compile(
    r"""\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?)[#!&%@]?
    | (?P<text>"(?:[^"]|"")*") | (?P<name>[^\W\d]\w*)[%&!\#@$]? | (?P<op><>|<=|>=|:=|[-+*/\\^=<>&.])
    | (?P<open>\() | (?P<close>\)) | (?P<separator>,))""",
    re.VERBOSE,
)
_SAME = {
    "abs": "ABS", "atn": "ATAN", "cos": "COS", "sin": "SIN", "tan": "TAN", "exp": "EXP", "log": "LN", "sqr": "SQRT",
    "sgn": "SIGN", "int": "INT", "fix": "TRUNC", "iif": "IF", "iserror": "ISERROR", "isnumeric": "ISNUMBER",
    "ismissing": "ISOMITTED",
}  # fmt: skip
"""Function of Basic -> the one of spreadsheets that does the same."""

_PLAIN, _WHOLE = ("cdbl", "csng", "cvar", "val"), ("cint", "clng")
_ERRORS = {
    2000: "#NULL!", 2007: "#DIV/0!", 2015: "#VALUE!", 2023: "#REF!", 2029: "#NAME?", 2036: "#NUM!", 2042: "#N/A",
}  # fmt: skip
_ERROR_NAMES = {
    "xlerrnull": 2000, "xlerrdiv0": 2007, "xlerrvalue": 2015, "xlerrref": 2023, "xlerrname": 2029, "xlerrnum": 2036,
    "xlerrna": 2042,
}  # fmt: skip

_NOT = 5
"""How strongly Not binds: less than comparisons, more than And."""

_READ = Dialect(
    "basic", {"or": 1, "xor": 1, "and": 3, **COMPARISONS, **MATHEMATICS, "mod": 32, "\\": 34}, prefix=45, postfix=0
)
"""As Excel reads it; what we write has parentheses where LibreOffice reads it otherwise."""

_OPERATORS = ("or", "xor", "and", "not", "mod")
"""Those that are words."""

MOST_NESTED = 30
"""Levels within each other: of parentheses and signs of an expression, of blocks of a function. People write fewer, and each
is some calls deep."""

MOST_TOKENS = 600
"""Of an expression: a sum is as deep a tree as it has terms."""


class NotReadError(Exception):
    """What stands there is none of what is read."""


def too_deep() -> NotReadError:
    """The error of levels within each other."""
    return NotReadError(say("what is nested deeper than {most} levels", most=MOST_NESTED))


def tokens(text: str) -> list[Token]:
    """The tokens of a statement, names in small letters; signs and operators that are words are of kind "op"."""
    found: list[Token] = []
    place, text = 0, text.strip()
    while place < len(text):
        match = _TOKEN.match(text, place)
        if match is None:
            raise NotReadError(text[place:])
        kind = str(match.lastgroup)
        read = match[kind] if kind == "text" else match[kind].lower()
        found.append(Token("op" if read in _OPERATORS else kind, read, place + 1))
        place = match.end()
    return found


def whole(node: Node) -> Node:
    """A number rounded as Basic does it: halves to the even one."""
    half = Call("ROUND", (Binary("/", node, Number(2.0)), Number(0.0)))
    is_half = Binary("=", Call("ABS", (Binary("-", node, Call("TRUNC", (node,))),)), Number(0.5))
    return Call("IF", (is_half, Binary("*", Number(2.0), half), Call("ROUND", (node, Number(0.0)))))


def expression(listed: list[Token]) -> Node:
    """The tree of an expression. Raises NotReadError."""
    if len(listed) > MOST_TOKENS:
        raise NotReadError(say("an expression of more than {most} words and signs", most=MOST_TOKENS))
    parser = _Parser("", _READ, [*listed, Token("end", "", 0)])
    try:
        return parser.parse()
    except FormulaError:
        raise NotReadError(parser.next.text or "…") from None


class _Parser(Parser):
    """Not is an operator with one side; a call may be of a function of Basic, of the module or of spreadsheets."""

    def deeper(self) -> None:
        self.depth += 1
        if self.depth > MOST_NESTED:
            raise too_deep()

    def expression(self, minimum: int) -> Node:
        if self.next.text == "not" and minimum > _NOT:
            raise NotReadError(self.next.text)
        return super().expression(minimum)

    def signed(self) -> Node:
        if self.next.text != "not":
            return super().signed()
        self.take()
        self.deeper()
        node = Call("NOT", (self.expression(_NOT),))
        self.depth -= 1
        return node

    def combine(self, op: str, left: Node, right: Node) -> Node:
        return _two_sided(op, left, right)

    def operand(self) -> Node:
        if self.next.kind == "open":
            return self.parenthesised()
        token = self.take()
        match token.kind:
            case "number":
                return Number(float(token.text.replace("d", "e")))
            case "text":
                return Text(token.text[1:-1].replace('""', '"'))
            case "name":
                return self.named(token.text)
        raise NotReadError(token.text or "…")

    def named(self, name: str) -> Node:
        """A variable, a call, or a function of Excel's that Basic reaches through its object."""
        if name in ("true", "false"):
            return Boolean(name == "true")
        of_program = False
        while self.next.kind == "op" and self.next.text == ".":
            if name not in ("worksheetfunction", "application", "math", "vba"):
                raise NotReadError(f"{name}.")
            of_program = of_program or name in ("worksheetfunction", "application")
            self.take()
            name = self.take().text
        called = self.next.kind == "open"
        args = self.arguments() if called else ()
        if of_program:
            return _of_program(name, args)
        return _called(name, args) if called else Symbol(name)


def _two_sided(op: str, left: Node, right: Node) -> Node:
    if op in ("or", "and", "xor"):
        return Call(op.upper(), (left, right))
    if op == "\\":
        return Call("TRUNC", (Binary("/", whole(left), whole(right)),))
    if op == "mod":
        left, right = whole(left), whole(right)
        return Binary("-", left, Binary("*", right, Call("TRUNC", (Binary("/", left, right),))))
    return Binary(op, left, right)


def _of_program(name: str, args: tuple[Node, ...]) -> Node:
    if name.upper() not in FUNCTIONS:
        raise NotReadError(name)
    return Call(name.upper(), args)


def _called(name: str, args: tuple[Node, ...]) -> Node:
    if name == "cverr" and len(args) == 1:
        number = _ERROR_NAMES.get(args[0].name) if isinstance(args[0], Symbol) else None
        number = int(args[0].value) if isinstance(args[0], Number) else number
        if number in _ERRORS:
            return ErrorValue(_ERRORS[number])
        raise NotReadError(name)
    if name in _PLAIN and len(args) == 1:
        return args[0]
    if name in _WHOLE and len(args) == 1:
        return whole(args[0])
    if name == "round" and args:
        return whole(args[0]) if len(args) == 1 else Call("ROUND", args)
    return Call(_SAME[name], args) if name in _SAME else Call(name, args)

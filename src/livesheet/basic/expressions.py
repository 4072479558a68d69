"""An expression in Basic as the tree of a formula: its operators bind otherwise, its functions have other names."""

from __future__ import annotations

import re
from typing import NamedTuple

from ..formula.functions import FUNCTIONS
from ..formula.nodes import Binary, Boolean, Call, ErrorValue, Node, Number, Symbol, Text, Unary
from ..said import say

_TOKEN = re.compile(
    r"""\s*(?:(?P<number>(?:\d+\.?\d*|\.\d+)(?:[eEdD][-+]?\d+)?)[#!&%@]?
    | (?P<text>"(?:[^"]|"")*") | (?P<name>[^\W\d]\w*)[%&!\#@$]? | (?P<op><>|<=|>=|:=|[-+*/\\^=<>&(),.]))""",
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
_COMPARED = ("=", "<>", "<", ">", "<=", ">=")


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


class Token(NamedTuple):
    """kind: number, text, name or op; names in small letters."""

    kind: str
    text: str


def tokens(text: str) -> list[Token]:
    """The tokens of a statement."""
    found: list[Token] = []
    place, text = 0, text.strip()
    while place < len(text):
        match = _TOKEN.match(text, place)
        if match is None:
            raise NotReadError(text[place:])
        kind = str(match.lastgroup)
        found.append(Token(kind, match[kind] if kind == "text" else match[kind].lower()))
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
    parser = _Parser(listed)
    node = parser.implied(0)
    if parser.listed:
        raise NotReadError(parser.listed[0].text)
    return node


class _Parser:
    """Tokens that are left; one method for each strength of operators, the weakest first."""

    def __init__(self, listed: list[Token]) -> None:
        self.listed = list(listed)
        self.depth = 0

    def at(self, *texts: str) -> bool:
        return bool(self.listed) and self.listed[0].kind != "text" and self.listed[0].text in texts

    def take(self) -> Token:
        if not self.listed:
            raise NotReadError("…")
        return self.listed.pop(0)

    def deeper(self) -> None:
        """One level more, up to the limit."""
        self.depth += 1
        if self.depth > MOST_NESTED:
            raise too_deep()

    def expect(self, text: str) -> None:
        if not self.at(text):
            raise NotReadError(self.listed[0].text if self.listed else text)
        self.take()

    def implied(self, level: int) -> Node:
        """Operators of two sides: or, and, not, comparisons, + -, Mod, \\, * /."""
        if level == 2 and self.at("not"):
            self.take()
            self.deeper()
            node: Node = Call("NOT", (self.implied(2),))
            self.depth -= 1
            return node
        if level == len(_LEVELS):
            return self.signed()
        left = self.implied(level + 1)
        while self.at(*_LEVELS[level]):
            op = self.take().text
            left = _two_sided(op, left, self.implied(level + 1))
        return left

    def signed(self) -> Node:
        """An operand with its signs; what stands in parentheses comes by here, too."""
        self.deeper()
        if self.at("-", "+"):
            sign = self.take().text
            node = self.signed()
            node = Unary("-", node) if sign == "-" else node
        else:
            node = self.power()
        self.depth -= 1
        return node

    def power(self) -> Node:
        left = self.operand()
        while self.at("^"):
            self.take()
            left = Binary("^", left, self.signed() if self.at("-", "+") else self.operand())
        return left

    def operand(self) -> Node:
        token = self.take()
        match token.kind:
            case "number":
                return Number(float(token.text.replace("d", "e")))
            case "text":
                return Text(token.text[1:-1].replace('""', '"'))
            case "name":
                return self.named(token.text)
        if token.text != "(":
            raise NotReadError(token.text)
        node = self.implied(0)
        self.expect(")")
        return node

    def named(self, name: str) -> Node:
        """A variable, a call, or a function of Excel's that Basic reaches through its object."""
        if name in ("true", "false"):
            return Boolean(name == "true")
        of_program = False
        while self.at("."):
            if name not in ("worksheetfunction", "application", "math", "vba"):
                raise NotReadError(f"{name}.")
            of_program = of_program or name in ("worksheetfunction", "application")
            self.take()
            name = self.take().text
        if not self.at("("):
            if of_program:
                return _of_program(name, ())
            return Symbol(name)
        self.take()
        args: list[Node] = []
        while not self.at(")"):
            args.append(self.implied(0))
            if not self.at(")"):
                self.expect(",")
        self.take()
        return _of_program(name, tuple(args)) if of_program else _called(name, tuple(args))


_LEVELS = (("or", "xor"), ("and",), _COMPARED, ("+", "-"), ("mod",), ("\\",), ("*", "/"))


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

"""Equations as mathematics, as far as the text of one cell goes: Greek letters, subscripts, powers, roots, bars.

SQRT((A.x - a1)^2 + A.y^2)   is written   √((x_A − a_1)² + y_A²), with real subscripts and superscripts
"""

from __future__ import annotations

from string import Formatter

from livesheet.formula import algebra as al
from livesheet.formula.nodes import (
    Binary,
    Boolean,
    Call,
    Direction,
    Node,
    Number,
    Previous,
    Symbol,
    Text,
    TriangleAngle,
    Unary,
)
from livesheet.formula.printer import number_text
from livesheet.workbook import Rich
from mechsheet.sheet.quoted import formula
from mechsheet.words.catalogue import Language, words
from mechsheet.words.symbols import parts

Part = tuple[str, str]
"""A piece of text and how it is set: "", "italic", "sub" or "super"."""

_POWER = {"=": 10, "<>": 10, "<": 10, "<=": 10, ">": 10, ">=": 10, "+": 30, "-": 30, "*": 40, "/": 40, "^": 60}
_SIGNS = {
    "*": "·",
    "-": " − ",
    "+": " + ",
    "/": "/",
    "<>": " ≠ ",
    "<=": " ≤ ",
    ">=": " ≥ ",
    "=": " = ",
    "<": " < ",
    ">": " > ",
}
_NEGATIVE, _ATOM = 35, 100

_NAMES = {"ATAN": "arctan", "ASIN": "arcsin", "ACOS": "arccos", "ATAN2": "arctan2"}


def written(node: Node, language: Language) -> Rich:
    """The right-hand side of an equation."""
    return Rich(tuple(merged(_Pen(language).write(node)[0])))


class _Pen:
    def __init__(self, language: Language) -> None:
        self.language: Language = language

    def write(self, node: Node) -> tuple[list[Part], int]:
        """The pieces, and how strongly the outermost operator binds."""
        match node:
            case Number(value):
                return self.number(value), _ATOM if value >= 0 else _NEGATIVE
            case Symbol(name):
                return symbol_parts(name), _ATOM
            case Previous(name):
                return [*symbol_parts(name), (f" ({words(self.language, 'notes.above')})", "")], _ATOM
            case Unary("%", operand):
                return [*self.inside(operand, _ATOM), ("%", "")], _ATOM
            case Unary(op, operand):
                return [("−" if op == "-" else "+", ""), *self.inside(operand, _POWER["*"])], _NEGATIVE
            case Binary("^", base, exponent):
                return self.raised(base, exponent)
            case Binary("*", Number() as factor, Call("PI", ())):
                return [*self.number(factor.value), ("π", "")], _POWER["*"]
            case Binary("*" | "/") if (unsigned := _unsigned(node)) is not None:  # −track/2, not (−track)/2
                return self.write(Unary("-", unsigned))
            case Binary(op, left, right):
                power = _POWER[op]
                pieces = [*self.inside(left, power), (_SIGNS[op], "")]
                minimum = _NEGATIVE + 1 if op == "-" else power + (op == "/")  # a − (−b)
                return [*pieces, *self.inside(right, minimum)], power
            case Call(name, args):
                return self.call(name, args)
            case Direction(y, x):
                return self.write(formula("ATAN(rise/run)", rise=y, run=x))
            case TriangleAngle(opposite, beside, other):
                return self.write(Call("ACOS", (al.triangle_cosine(opposite, beside, other),)))
            case Text(value):
                return [(f"“{value}”", "")], _ATOM
            case Boolean(value):
                return [(str(value).lower(), "")], _ATOM
        raise ValueError(f"no equation holds a {type(node).__name__}")

    def inside(self, node: Node, minimum: int) -> list[Part]:
        """An operand, in parentheses where it binds less strongly."""
        pieces, power = self.write(node)
        return [("(", ""), *pieces, (")", "")] if power < minimum else pieces

    def number(self, value: float) -> list[Part]:
        """A number with the language's decimal sign; 1e-12 as a power of ten."""
        mantissa, _, exponent = number_text(value, "e").replace("-", "−").partition("e")
        mantissa = mantissa.replace(".", words(self.language, "number.decimal"))
        if not exponent:
            return [(mantissa, "")]
        return [("10" if mantissa == "1" else f"{mantissa}·10", ""), (exponent, "super")]

    def raised(self, base: Node, exponent: Node) -> tuple[list[Part], int]:
        """A power: a plain exponent is set high, another stands behind a caret. sin(x) squared keeps its parentheses."""
        below = self.inside(base, _ATOM)
        if isinstance(exponent, Number | Symbol) and all(kind in ("", "italic") for _, kind in self.write(exponent)[0]):
            return [*below, ("".join(text for text, _ in self.write(exponent)[0]), "super")], _POWER["^"]
        return [*below, ("^", ""), *self.inside(exponent, _ATOM)], _POWER["^"]

    def call(self, name: str, args: tuple[Node, ...]) -> tuple[list[Part], int]:
        """A function in its usual dress."""
        match name, args:
            case "PI", ():
                return [("π", "")], _ATOM
            case "NA", ():
                return [(words(self.language, "notes.missing"), "")], _ATOM
            case "SQRT", (arg,):
                return [("√", ""), *self.inside(arg, _ATOM)], _ATOM
            case "ABS", (arg,):
                return [("|", ""), *self.write(arg)[0], ("|", "")], _ATOM
            case "RADIANS", (Number(value),):
                return [*self.number(value), ("°", "")], _ATOM
            case "SUMSQ", _:
                return self.write(_squares(args))
            case "ROUND", (arg, Number(0.0)):
                return self.function(words(self.language, "notes.round"), (arg,))
            case "ISNUMBER", (arg,):
                return [*self.inside(arg, _ATOM), (f" {words(self.language, 'notes.is_number')}", "")], 5
            case (("AND" | "OR"), _):
                return self.listed(args, words(self.language, f"notes.{name.lower()}")), 5
            case "IF", (test, yes, no):
                return self.cases(test, yes, no), 1
            case "CHOOSE", (number, *values):  # the one of that number: [a; b; c] with the number set low
                below = "".join(text for text, _ in self.write(number)[0])
                return [("[", ""), *self.listed(tuple(values), ";"), ("]", ""), (below, "sub")], _ATOM
        return self.function(_NAMES.get(name, name.lower()), args)

    def function(self, name: str, args: tuple[Node, ...]) -> tuple[list[Part], int]:
        """name(a; b)."""
        return [(f"{name}(", ""), *self.listed(args, ";"), (")", "")], _ATOM

    def listed(self, args: tuple[Node, ...], between: str) -> list[Part]:
        """a; b, or: a or b."""
        gap = f"{between} " if between == ";" else f" {between} "
        pieces: list[Part] = []
        for index, arg in enumerate(args):
            pieces += [(gap, "")] if index else []
            pieces += self.inside(arg, 2)
        return pieces

    def cases(self, test: Node, yes: Node, no: Node) -> list[Part]:
        """`value; #N/A if test`: the usual case first. In Turkish the condition stands before what it leads to."""
        if yes == Call("NA"):
            missing: list[Part] = [(words(self.language, "notes.missing"), "")]
            return [*self.inside(no, 2), ("; ", ""), *self.provided(test, missing)]
        otherwise = f"; {words(self.language, 'notes.otherwise')} "
        return [*self.provided(test, self.inside(yes, 2)), (otherwise, ""), *self.inside(no, 2)]

    def provided(self, test: Node, then: list[Part]) -> list[Part]:
        """`value if test`, `test ise value`."""
        pieces = {"value": then, "test": self.inside(test, 2)}
        found: list[Part] = []
        for between, name, _, _ in Formatter().parse(words(self.language, "notes.if")):
            found += [(between, "")] if between else []
            found += pieces[name] if name else []
        return found


def symbol_parts(symbol: str) -> list[Part]:
    """A symbol with its subscript."""
    letter, subscript = parts(symbol)
    return [(letter, "italic"), (subscript, "sub")] if subscript else [(letter, "italic")]


def _unsigned(node: Node) -> Node | None:
    """The product or quotient without the minus that it begins with; None where it begins with none."""
    match node:
        case Unary("-", operand):
            return operand
        case Binary(("*" | "/") as op, left, right) if (unsigned := _unsigned(left)) is not None:
            return Binary(op, unsigned, right)
    return None


def _squares(args: tuple[Node, ...]) -> Node:
    total: Node = Binary("^", args[0], Number(2.0))
    for arg in args[1:]:
        total = Binary("+", total, Binary("^", arg, Number(2.0)))
    return total


def merged(pieces: list[Part]) -> list[Part]:
    """Neighbours that are set alike as one piece: files are smaller, and programs draw them the same."""
    result: list[Part] = []
    for text, kind in pieces:
        if result and result[-1][1] == kind:
            result[-1] = (result[-1][0] + text, kind)
        elif text:
            result.append((text, kind))
    return result

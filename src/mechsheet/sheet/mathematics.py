"""Equations as mathematics, as far as the text of one cell goes: Greek letters, subscripts, powers, roots, bars.

SQRT((A.x - a1)^2 + A.y^2)   is written   √((x_A − a_1)² + y_A²), with real subscripts and superscripts

Velocity and acceleration loop equations as a textbook writes them are derivatives of a group's loop closure by time.

    r e^(i theta)   ->   (r' + i omega r) e^(i theta)   ->   (r'' - omega^2 r + i (alpha r + 2 omega r')) e^(i theta)

Source: Soeylemez, Mechanisms, sections 4.2 and 4.3.
"""

from __future__ import annotations

from collections.abc import Callable
from string import Formatter

from livesheet.formula import algebra as al
from livesheet.formula.derivatives import derivative
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
    symbols,
)
from livesheet.formula.printer import number_text
from livesheet.workbook import Rich
from mechsheet.kinematics.equations import Loop, Vector
from mechsheet.model import rate_symbols
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.words.catalogue import Language, words
from mechsheet.words.symbols import parts, plain

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


Rate = tuple[Node, Node]

NOTHING: Rate = (al.ZERO, al.ZERO)


class LoopRates:
    """The loops of a mechanism, differentiated by time."""

    def __init__(self, plan: Plan) -> None:
        self.plan = plan
        mechanism, equations = plan.mechanism, plan.equations.equations
        self.rules = {equation.symbol: equation.expression for equation in equations.all}
        self.known: dict[str, Rate] = dict(equations.turning)
        for joint in mechanism.joints:
            first, second = rate_symbols(joint.symbol, False)
            self.known[joint.symbol] = (Symbol(first), Symbol(second))
        driver = mechanism.driver_rates
        self.known[mechanism.driver.symbol] = (Symbol(driver[0]), Symbol(driver[1]))

    def velocities(self, loop: Loop) -> Rich:
        """The loop's first derivative."""
        return self._equation(loop, self._velocity)

    def accelerations(self, loop: Loop) -> Rich:
        """The loop's second derivative."""
        return self._equation(loop, self._acceleration)

    def _equation(self, loop: Loop, write: Callable[[Vector], list[Part]]) -> Rich:
        sides: list[list[Part]] = []
        for side in (loop.left, loop.right):
            terms = [term for vector in side if (term := write(vector))]
            joined: list[Part] = []
            for index, term in enumerate(terms):
                joined += [(" + ", ""), *term] if index else term
            sides.append(joined or [("0", "")])
        return Rich((*sides[0], (" = ", ""), *sides[1]))

    # --- one vector -------------------------------------------------------------------------------------------

    def _velocity(self, vector: Vector) -> list[Part]:
        length, (omega, _) = vector.length, self._rate(vector.angle.expression())
        slides, _ = self._rate(length)
        turns = al.mul(length, omega)
        return self._product([(slides, False), (turns, True)], vector)

    def _acceleration(self, vector: Vector) -> list[Part]:
        length, (omega, alpha) = vector.length, self._rate(vector.angle.expression())
        velocity, slides = self._rate(length)
        along = al.sub(slides, al.mul(length, al.square(omega)))
        across = al.add(al.mul(length, alpha), al.mul(al.TWO, al.mul(velocity, omega)))
        return self._product([(along, False), (across, True)], vector)

    def _product(self, factors: list[tuple[Node, bool]], vector: Vector) -> list[Part]:
        """(real + i imaginary) e^(i angle); nothing where both are 0."""
        left = [(node, across) for node, across in factors if not al.is_zero(node)]
        if not left:
            return []
        parts: list[Part] = []
        for index, (node, across) in enumerate(left):
            parts += [(" + ", "")] if index else []
            text = [*written(node, self.plan.language).parts]
            several = any(sign in word for word, kind in text for sign in ("+", "−") if not kind)
            inside: list[Part] = [("(", ""), *text, (")", "")] if across and several else text
            parts += [("i", "italic"), ("·", ""), *inside] if across else inside
        angle = vector.angle
        if angle.constant and angle.degrees == 0:
            return parts
        several = len(left) > 1 or any(sign in word for word, kind in parts for sign in (" + ", " − ") if not kind)
        whole: list[Part] = [("(", ""), *parts, (")", "")] if several else parts
        turn = written(angle.expression(), self.plan.language)
        return [*whole, ("·", ""), ("e", "italic"), ("i" + _raised(angle.expression(), turn), "super")]

    def _rate(self, node: Node) -> Rate:
        """First and second derivative of what is a sum of angles, or of displacements."""
        first: Node = al.ZERO
        second: Node = al.ZERO
        for name in symbols(node):
            once, twice = self.known[name] if name in self.known else self._followed(name)
            if not (al.is_zero(once) and al.is_zero(twice)):
                by = derivative(node, name)
                first, second = al.add(first, al.mul(by, once)), al.add(second, al.mul(by, twice))
        return first, second

    def _followed(self, name: str) -> Rate:
        """Of a symbol that stands for an expression."""
        return self._rate(self.rules[name]) if name in self.rules else NOTHING


def _raised(angle: Node, turn: Rich) -> str:
    """An angle as plain text, which can be set high."""
    if isinstance(angle, Symbol):
        return plain(angle.name)
    return f"({turn.plain})"

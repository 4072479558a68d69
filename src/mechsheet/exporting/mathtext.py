"""Expressions in LaTeX, with symbols and with the numbers of one position, step by step; for LaTeX and Markdown alike."""

from __future__ import annotations

import math
import re
import unicodedata
from collections.abc import Callable, Iterable

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Node, Number, Previous, Symbol, transform
from livesheet.formula.printer import number_text, print_formula
from mechsheet.exporting.lowering import Lowering, Step
from mechsheet.kinematics.equations import Vector
from mechsheet.kinematics.numeric import value
from mechsheet.model import Mechanism
from mechsheet.plotting.sampling import Sample, sample
from mechsheet.sheet.table.positions import decimals_of, decimals_of_kind
from mechsheet.units import NUMBER, Unit
from mechsheet.words.catalogue import Language, words
from mechsheet.words.symbols import GREEK, parts


class Position:
    """A row of a sample.

    steps   of the equations, by the equation that they belong to
    values  of dimensions, constants, modes, drivers and columns in internal units, by symbol; NaN where there is no number
    """

    def __init__(self, mechanism: Mechanism, at: float | None) -> None:
        self.sample: Sample = sample(mechanism, at, None)
        self.steps = Lowering(self.sample).steps
        self.values = {symbol: float(column[self.sample.shown]) for symbol, column in self.sample.values.items()}
        with np.errstate(all="ignore"):
            for symbol, steps in self.steps.items():
                self._add_helpers(symbol, steps)

    def _add_helpers(self, symbol: str, steps: tuple[Step, ...]) -> None:
        """The values of the steps before an equation's own."""
        for step in steps[:-1]:
            if step.counts_turns:
                within = self.values[steps[0].symbol]
                self.values[step.symbol] = float(np.round((self.values[symbol] - within) / math.tau))
            else:
                self.values[step.symbol] = float(value(step.expression, self.values, rooted=True))


RAW = "#"
"""A symbol that begins so is LaTeX already."""

RATIO = "ratio"
"""What has no unit and lies between -1 and 1: sines and cosines in a table."""

RATIO_DECIMALS = 4
DIGITS = 6
"""Of a number without a unit (an area): significant digits."""

EXACT = 12
"""Digits of a constant of the description: more than anybody writes, fewer than rounding makes of 0.1 + 0.2."""

_COMMANDS = {letter: f"\\{name}" for name, letter in GREEK.items()} | {"φ": r"\varphi", "ε": r"\varepsilon"}
_PRIMES = {"′": "'", "″": "''", "‴": "'''"}
_DOTS = {"\u0307": r"\dot", "\u0308": r"\ddot"}
_POINTS = re.compile(r"(?:[A-Z]\d*)+")
_TRIGONOMETRY = ("SIN", "COS", "TAN")


def symbol_math(symbol: str) -> str:
    """theta13 as \\theta_{13}, A.x as x_{A}, A0B0 as A_{0}B_{0}; other words upright or in italics."""
    if symbol.startswith(RAW):
        return symbol.removeprefix(RAW)
    letter, subscript = parts(symbol)
    plain = letter.rstrip("".join(_PRIMES))
    primes = "".join(_PRIMES[sign] for sign in letter[len(plain) :])
    if not subscript:
        return _letter(plain) + primes
    return f"{_letter(plain)}_{{{','.join(_subscript(part) for part in subscript.split(','))}}}{primes}"


def _letter(word: str) -> str:
    if word in _COMMANDS:
        return _COMMANDS[word]
    base, dots = unicodedata.normalize("NFD", word)[:1], unicodedata.normalize("NFD", word)[1:]
    if dots in _DOTS:
        return rf"{_DOTS[dots]}{{{_letter(base)}}}"
    if len(word) == 1 and word.isascii():
        return word
    if _POINTS.fullmatch(word):
        return point_math(word)
    return rf"\mathit{{{_plain(word)}}}" if word.isascii() else rf"\text{{{_plain(word)}}}"


def _subscript(word: str) -> str:
    if word.isdigit() or (len(word) == 1 and word.isascii()):
        return word
    return point_math(word) if _POINTS.fullmatch(word) else rf"\text{{{_plain(word)}}}"


def point_math(name: str) -> str:
    """A point's name: A0 as A_{0}."""
    if not _POINTS.fullmatch(name):
        return rf"\text{{{_plain(name)}}}"
    return re.sub(r"([A-Z])(\d+)", r"\1_{\2}", name)


def _plain(word: str) -> str:
    return re.sub(r"([_#%&$])", r"\\\1", word)


def decimal(text: str, language: Language) -> str:
    """A number's text with the language's decimal sign; braces keep a comma from being spaced like a list."""
    sign = words(language, "number.decimal")
    return text if sign == "." else text.replace(".", f"{{{sign}}}")


def seen(code: str) -> int:
    """About how many characters of LaTeX code are seen."""
    return len(re.sub(r"\\[A-Za-z]+|[{}\\^_]", "", code))


def packed(terms: Iterable[str], width: int) -> list[str]:
    """Terms joined by their signs, as many on a line as it has room for."""
    lines = [""]
    for term in terms:
        sign, plain = (" - ", term[1:]) if term.startswith("-") else (" + ", term)
        joined = lines[-1] + sign + plain if lines[-1] else term
        if lines[-1] and seen(joined) > width:
            lines.append(sign.lstrip() + plain)
        else:
            lines[-1] = joined
    return lines


def on_paper(node: Node) -> Node:
    """As a textbook writes it: 30 degrees, not 30 degrees in radians."""
    match node:
        case Call("RADIANS", (Number(value),)):
            return Symbol(f"{RAW}{number_text(value)}^\\circ")
    return node


class Pen:
    """Writes for one position in its language."""

    def __init__(self, position: Position) -> None:
        self.position = position
        self.language: Language = position.sample.plan.language
        self.angle_unit = position.sample.plan.mechanism.angle_unit
        self.units = _units(position)
        self.decimals = {kind: _decimals(position, kind) for kind in ("length", "angle")} | {RATIO: RATIO_DECIMALS}

    # --- with symbols -----------------------------------------------------------------------------------------

    def formula(self, node: Node) -> str:
        """An expression with its symbols."""
        return print_formula(self._prepared(node), "latex", lambda part: symbol_math(part.name))

    def _prepared(self, node: Node) -> Node:
        return transform(transform(node, on_paper), self._constant)

    def _constant(self, node: Node) -> Node:
        """A number that is no whole one, in the language's spelling."""
        if not isinstance(node, Number) or (node.value.is_integer() and abs(node.value) < 1e9):
            return node
        mantissa, _, exponent = f"{node.value:.{EXACT}g}".partition("e")
        text = decimal(mantissa, self.language)
        return Symbol(f"{RAW}{text} \\cdot 10^{{{int(exponent)}}}" if exponent else RAW + text)

    def terms(self, node: Node, write: Callable[[Node], str]) -> list[str]:
        """The terms of a sum, each with its sign, written by `write`; of anything else the whole."""
        found: list[str] = []
        waiting: list[tuple[int, Node]] = [(1, transform(node, on_paper))]
        while waiting:
            sign, part = waiting.pop()
            match part:
                case Binary("+" | "-" as op, left, right):
                    waiting += [(sign if op == "+" else -sign, right), (sign, left)]
                case _:
                    found.append(write(part if sign > 0 else al.neg(part)))
        return found

    def vector(self, vector: Vector) -> str:
        """r e^{i theta}; along the axes r and i r."""
        angle = vector.angle
        if angle.constant and angle.degrees == 0:
            return self.formula(vector.length)
        if angle.constant and angle.degrees == 90:
            return self.formula(Binary("*", Symbol(f"{RAW}i"), vector.length))
        turn = self.formula(angle.expression())
        exponent = turn if isinstance(angle.expression(), Symbol) else f"({turn})"
        return self.formula(Binary("*", vector.length, Symbol(f"{RAW}e^{{i{exponent}}}")))

    # --- with numbers -----------------------------------------------------------------------------------------

    def substituted(self, node: Node, unit: Unit) -> str:
        """An expression of that unit with the position's numbers in place of its symbols."""
        prepared = self._prepared(node)
        if self.angle_unit.in_degrees:
            prepared = _half_turns(prepared, _is_angle(unit))
        return print_formula(prepared, "numbers", self._number)

    def _number(self, part: Symbol | Previous) -> str:
        if part.name.startswith(RAW):
            return part.name.removeprefix(RAW)
        return self.shown(self.position.values[part.name], self.units.get(part.name, NUMBER))

    def shown(self, value: float, unit: Unit) -> str:
        """A value in internal units as people read it, rounded; angles with their sign of degree."""
        if not _is_angle(unit):
            return self.rounded(value, "number" if unit.per else unit.kind)
        sign = r"^\circ" if self.angle_unit.in_degrees else ""
        return self.rounded(self.angle_unit.to_shown(value), unit.kind) + sign

    def rounded(self, value: float, kind: str) -> str:
        """A number with the decimals of its kind; one without a unit with a few significant digits."""
        if math.isnan(value):
            return r"\text{–}"
        text = f"{value:.{self.decimals[kind]}f}" if kind in self.decimals else f"{value:.{DIGITS}g}"
        if float(text) == 0:
            text = text.removeprefix("-")
        mantissa, _, exponent = text.partition("e")
        mantissa = decimal(mantissa, self.language)
        return rf"{mantissa} \cdot 10^{{{int(exponent)}}}" if exponent else mantissa

    def result(self, symbol: str) -> str:
        """The value of a symbol with its unit."""
        unit = self.units.get(symbol, NUMBER)
        return self.shown(self.position.values[symbol], unit) + self.unit_math(unit)

    def unit_math(self, unit: Unit) -> str:
        """The unit after a number; degrees stand at the number itself."""
        word = (self.angle_unit if _is_angle(unit) else self.position.sample.plan.mechanism.shown(unit)).text
        word = word.replace("²", "^2")
        return rf"\ \mathrm{{{_plain(word)}}}" if word not in ("", "°") else ""


def _is_angle(unit: Unit) -> bool:
    """Angles are shown in the file's unit; angular velocities in radians per second."""
    return unit.kind == "angle" and not unit.per


def _units(position: Position) -> dict[str, Unit]:
    """Symbol -> unit of its value; a mode is a number without one."""
    mechanism = position.sample.plan.mechanism
    units = {dim.symbol: dim.unit for dim in mechanism.dimensions}
    units |= {step.symbol: step.unit for steps in position.steps.values() for step in steps}
    given = (mechanism.driver.symbol, *mechanism.given_by_row)
    return units | {symbol: mechanism.given_unit(symbol) or NUMBER for symbol in given}


def _decimals(position: Position, kind: str) -> int:
    """Decimals that the tolerances justify: of angles by the tolerances of angles, where there are any."""
    mechanism = position.sample.plan.mechanism
    own = mechanism.angle_unit
    tolerances = [dim.tolerance for dim in mechanism.dimensions if dim.tolerance and dim.unit == own]
    if kind == "angle" and tolerances:
        return decimals_of(min(tolerances))
    return decimals_of_kind(position.sample.plan, kind)


def _half_turns(node: Node, is_angle: bool) -> Node:
    """pi as 180 degrees, where it is an angle: in a sum that is one, and inside sine, cosine and tangent."""

    def inside(part: Node) -> Node:
        return Symbol(f"{RAW}180^\\circ") if part == Call("PI") else part

    def arguments(part: Node) -> Node:
        if isinstance(part, Call) and part.name in _TRIGONOMETRY:
            return Call(part.name, tuple(transform(arg, inside) for arg in part.args))
        return part

    return transform(node, inside if is_angle else arguments)

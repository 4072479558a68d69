"""Columns of the sheet of velocities: influence coefficients, and what they are found from.

A formula that a person cannot read at a glance has no use: a long one is told by the length that it will have in a cell, and
the first terms of a long sum stand in a column of their own.
"""

from __future__ import annotations

from collections.abc import Callable, Collection

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Node, Symbol
from livesheet.formula.printer import print_formula
from livesheet.formula.vectors import Vector
from livesheet.said import Words
from mechsheet.kinematics.equations import Condition
from mechsheet.kinematics.ledger import Ledger
from mechsheet.model import Mechanism
from mechsheet.units import NUMBER, Unit
from mechsheet.words.equations import phrase

COEFFICIENTS = (".d", ".dd")
"""What a symbol's first and second derivative by the driver's variable end in."""


def order_words(order: int) -> Words:
    """Of velocity, of acceleration."""
    return phrase("velocity_word" if order == 1 else "acceleration_word")


class RateColumns:
    """Writes them into the ledger.

    angles  symbols whose derivatives are of angles, the others are of lengths
    """

    def __init__(self, mechanism: Mechanism, ledger: Ledger, unknown: Collection[str]) -> None:
        """`unknown`: coefficients that will stand on the sheet, too."""
        self.mechanism, self.ledger, self.unknown = mechanism, ledger, unknown
        self.cells = CellLengths(mechanism, ledger)
        self.angles = {link.angle_symbol for link in mechanism.links}

    def length(self, node: Node) -> float:
        """About so many characters a cell's formula has."""
        self.cells.own.update(self.unknown)
        return self.cells.of(node)

    def unit(self, lengths: int, order: int = 0) -> Unit:
        """The unit of lengths to a power, by the driver's unit to the power `order`."""
        length = self.mechanism.length_unit
        power = lengths - (order if self.mechanism.driver.joint and length else 0)
        if power == 0:
            return NUMBER
        name = length + {1: "", 2: "²"}.get(abs(power), f"^{abs(power)}")
        return Unit("number", name if power > 0 else f"1/{name}")

    def per_length(self, unit: Unit) -> Unit:
        """The unit of such a quantity divided by a length; where lengths have none it is the same."""
        powers = range(-2, 4) if self.mechanism.length_unit else ()
        return next((self.unit(power - 1) for power in powers if self.unit(power).text == unit.text), unit)

    def within(self, node: Node, base: str, unit: Unit, label: Words) -> Node:
        """A sum of which no cell holds more than can be read: its first terms stand in a column of their own."""
        return self.cells.split(node, lambda part: self.define(base, part, unit, label))

    def hoist(self, base: str, node: Node, unit: Unit, label: Words) -> Node:
        """In a column of its own, unless it is simple."""
        if al.is_simple(node):
            return node
        return self.define(base, self.within(node, base, unit, label), unit, label)

    def hoist_vector(self, base: str, vector: Vector, order: int, label: Callable[[str], Words]) -> Vector:
        """The parts of a length's derivative, each in a column of its own unless it is simple; `label`: of x, of y."""
        x, y = (
            self.hoist(f"{base}_{axis}", node, self.unit(1, order), label(axis))
            for axis, node in zip("xy", vector, strict=True)
        )
        return x, y

    def define(self, base: str, node: Node, unit: Unit, label: Words, *exists: Condition) -> Symbol:
        """A column of its own."""
        name = self.ledger.reserve(base)
        self.cells.own.add(name)
        return self.ledger.define(name, node, unit, label, "coefficient", exists)

    def coefficient(self, symbol: str, order: int, node: Node, turns: bool | None = None) -> None:
        """The first or the second derivative of a symbol."""
        turns = symbol in self.angles if turns is None else turns
        label = phrase("coefficient", symbol=symbol, order=order_words(order))
        name = f"{symbol}{COEFFICIENTS[order - 1]}"
        self.ledger.define(name, node, self.unit(0 if turns else 1, order), label, "coefficient")

    def point(self, point: str, order: int, rate: Vector) -> Vector:
        """The first or the second coefficients of a point; those that have columns already are read there."""
        found = []
        for axis, node in zip("xy", rate, strict=True):
            name = f"{point}.{axis}{COEFFICIENTS[order - 1]}"
            if name not in self.ledger.values:
                label = phrase("coefficient", symbol=f"{axis} {point}", order=order_words(order))
                part = self.within(node, f"{point}_{axis}", self.unit(1, order), label)
                self.cells.own.add(name)
                self.ledger.define(name, part, self.unit(1, order), label, "coefficient")
            found.append(Symbol(name))
        return found[0], found[1]


LONGEST = 118
"""Characters of a cell's formula."""

REFERENCE = 13
"""Characters of a reference to another sheet: `Positions!AB4`."""

SHORT_REFERENCE = 10
"""And of one to the sheet of rates: `Rates!AB4`."""


class CellLengths:
    """`own`: the symbols that stand on the sheet in question itself;  near: those on a sheet with a short title."""

    def __init__(self, mechanism: Mechanism, ledger: Ledger) -> None:
        self.names = mechanism.references == "names"
        self.ledger = ledger
        self.own: set[str] = set()
        self.near: frozenset[str] = frozenset()

    def of(self, node: Node) -> int:
        """About so many characters a cell's formula has."""
        return len(print_formula(node, "text", lambda symbol: "x" * self._wide(symbol.name)))

    def _wide(self, name: str) -> int:
        """Of a symbol: a cell of the same sheet, a name, or a cell of another sheet."""
        if name in self.own:
            return 4
        if name in self.near:
            return SHORT_REFERENCE
        return len(name) if self.names and name in self.ledger.constant_symbols else REFERENCE

    def split(self, node: Node, column: Callable[[Node], Node], longest: int = LONGEST) -> Node:
        """A sum of at most `longest` characters: its first terms stand in a `column` of their own."""
        terms = terms_of(node)
        while len(terms) > 2 and self.of(al.total(terms)) > longest:
            count = next((n for n in range(len(terms) - 1, 1, -1) if self.of(al.total(terms[:n])) <= longest), 1)
            if count == 1:
                break
            terms = [column(al.total(terms[:count])), *terms[count:]]
        return al.total(terms)


def terms_of(node: Node) -> list[Node]:
    """The terms of a sum with their signs."""
    match node:
        case Binary("+", left, right):
            return [*terms_of(left), *terms_of(right)]
        case Binary("-", left, right):
            return [*terms_of(left), *(al.neg(term) for term in terms_of(right))]
    return [node]

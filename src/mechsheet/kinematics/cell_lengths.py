"""How long a formula will be in a cell, and long sums in parts: what a person cannot read at a glance has no use."""

from __future__ import annotations

from collections.abc import Callable

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Node
from livesheet.formula.printer import print_formula
from mechsheet.kinematics.ledger import Ledger
from mechsheet.model import Mechanism

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

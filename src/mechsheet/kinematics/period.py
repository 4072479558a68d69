"""What a turn of the driver changes of a quantity by itself: nothing, whole turns of an angle, or anything.

A quantity that reads an angle other than through its sine or cosine (`x - 20*theta12`, `theta12/10`, a load that grows with
the angle) does not come back with the mechanism: the motion has ends for it, even over a whole turn.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Literal, Protocol

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Node, Previous, Symbol, Unary, children
from mechsheet.model import TIME
from mechsheet.units import Unit

Change = Literal["nothing", "turns", "anything"]

SAME_AGAIN = 1e-6
"""As a part of its range a quantity may be off in the last row of a turn what it was in the first: that is rounding."""

_ORDER: tuple[Change, ...] = ("nothing", "turns", "anything")

_PERIODIC = ("SIN", "COS", "TAN")


class _Equation(Protocol):
    """A column: of mathematics, or as cells have it."""

    @property
    def symbol(self) -> str: ...
    @property
    def expression(self) -> Node: ...
    @property
    def unit(self) -> Unit: ...
    @property
    def role(self) -> str: ...


class Periods:
    """Of the columns of a mechanism whose driver turns.

    driven  symbols of what is driven
    """

    def __init__(self, columns: Iterable[_Equation], driven: Iterable[str]) -> None:
        self._columns = {column.symbol: column for column in columns}
        self._known: dict[str, Change] = dict.fromkeys(driven, "turns")
        if TIME not in self._columns:  # without a motion law a part of a guide's equations may be called t
            self._known[TIME] = "anything"

    def change(self, symbol: str) -> Change:
        """What a turn changes of a quantity; an angle that the mechanism has goes on by whole turns, or not at all."""
        if symbol not in self._known:
            column = self._columns.get(symbol)
            found: Change = "nothing"
            if column is not None:
                angle = column.role != "output" and column.unit.kind == "angle" and not column.unit.per
                found = "turns" if angle else self.of(column.expression)
            self._known[symbol] = found
        return self._known[symbol]

    def of(self, node: Node) -> Change:
        """The same of an expression."""
        match node:
            case Symbol(name):
                return self.change(name)
            case Previous():
                return "nothing"
            case Call(name, (argument,)) if name in _PERIODIC:
                return "anything" if self.of(argument) == "anything" else "nothing"
            case Unary("+" | "-") | Binary("+" | "-"):
                return max(map(self.of, children(node)), key=_ORDER.index)
            case Binary("*", one, other) if _whole(one) or _whole(other):
                return self.of(other if _whole(one) else one)
        return "nothing" if all(self.of(part) == "nothing" for part in children(node)) else "anything"


def _whole(node: Node) -> bool:
    """Whether it is a whole number."""
    factor = al.value_of(node)
    return factor is not None and factor == round(factor)

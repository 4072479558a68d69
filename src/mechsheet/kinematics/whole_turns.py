"""What a whole turn of the driver means for a quantity: whether it comes back, and how its mean counts the rows.

A quantity that reads an angle other than through its sine or cosine (`x - 20*theta12`, `theta12/10`, a load that grows with
the angle) does not come back with the mechanism: the motion has ends for it, even over a whole turn.
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any, Literal, Protocol

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Node, Previous, Symbol, Unary, children
from mechsheet.kinematics.driving import step_of
from mechsheet.kinematics.numeric import Array
from mechsheet.model import TIME, Mechanism
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


LEAST_OF_TURN = 4
"""Fewer rows are no turn."""


def mean_of_motion(columns: Array, there: Any, alike: Any) -> Array:
    """The mean of a quantity over the motion, for each row of `columns` (..., n): by the trapezoidal rule between neighbours
    that are both there, so that the row that closes a turn is not counted twice; 0 where nothing is there.

    there  which values exist (..., n);  alike: where all of them count alike (...): of listed values, and of a turn
           without the row that closes it. They also do where no two that are there are neighbours.
    """
    counts = np.asarray(there, bool)
    known = np.where(counts, columns, 0.0)
    pairs = np.asarray(counts[..., 1:] & counts[..., :-1], float)
    weights = np.zeros(counts.shape)
    weights[..., 1:] += pairs / 2
    weights[..., :-1] += pairs / 2
    alike = np.asarray(alike, bool) | ~pairs.any(axis=-1)
    weights = np.where(alike[..., None], counts, weights)
    return np.asarray((known * weights).sum(axis=-1) / np.maximum(weights.sum(axis=-1), 1.0))


def rows_count_alike(mechanism: Mechanism, rows: Array, tied: bool) -> bool:
    """Whether in a mean over the motion all rows count alike: of listed values, and of whole turns without the row that
    would close them.

    rows  the driver's values [rad or length unit];  tied: whether gears or racks are on the way, which close later
    """
    driver = mechanism.driver
    if driver.values or tied or not driver.link or driver.law is not None or len(rows) < LEAST_OF_TURN:
        return bool(driver.values)
    turns = abs(step_of(rows)) * len(rows) / math.tau
    return abs(round(turns) - turns) < 1e-9 and round(turns) > 0

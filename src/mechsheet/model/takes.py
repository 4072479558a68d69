"""Takes: the numbers that a quantity's whole motion is summed up by. Each is declared once, here; everybody else loops.

A take is a formula over a few *parts* of the motion of a quantity:

    least, largest   its extremes, between the rows too where somebody looks there
    first, last      its values in the first and the last row that has a position
    mean             over the motion, by the trapezoidal rule; of what `of_row` makes of the quantity x in each row

Whoever computes (cells, arrays of designs, a search, a student's column) finds the parts his own way and puts them in. Every
take has the unit of its quantity.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, symbols, transform

Way = Literal["min", "max"]

WAYS: dict[str, Way] = {"least": "min", "largest": "max"}
"""The parts that are extremes, and which."""

PARTS = (*WAYS, "first", "last", "mean")
"""All parts. A further one is found in each place that finds parts: `docs/contributing.md` lists them."""

X = Symbol("x")
"""The quantity in one row."""


@dataclass(frozen=True, slots=True)
class Take:
    """One of them.

    key     how the description calls it; its words are `take.` and the key (`words/catalogues/`)
    value   a formula over the parts
    of_row  what the mean is of: x, or a formula over it, which then has a column of its own in a workbook
    mark    what that column's symbol has behind the quantity's
    """

    key: str
    value: Node
    of_row: Node = X
    mark: str = ""

    def __post_init__(self) -> None:
        if unknown := {*self.parts} - {*PARTS}:
            raise ValueError(f"no parts of a motion: {unknown}")

    @property
    def parts(self) -> tuple[str, ...]:
        """The parts that it reads."""
        return tuple(symbols(self.value))

    @property
    def ways(self) -> tuple[Way, ...]:
        """The extremes that it reads: none, one, or the smallest and the largest."""
        return tuple(way for part, way in WAYS.items() if part in self.parts)

    @property
    def occurs_with(self) -> str:
        """The part that occurs where the take does; "" where it has none, as a mean or a range."""
        return self.value.name if isinstance(self.value, Symbol) and self.value.name != "mean" else ""

    @property
    def linear(self) -> bool:
        """Whether it changes with a dimension as the same take of the quantity's changes."""
        return self.of_row == X

    def over(self, part: Callable[[str], Node]) -> Node:
        """Its formula with a formula for each part."""
        return transform(self.value, lambda node: part(node.name) if isinstance(node, Symbol) else node)

    def row(self, x: Node) -> Node:
        """What the mean is of in a row, where the quantity is x."""
        return transform(self.of_row, lambda node: x if node == X else node)

    def of_constant(self, x: Node) -> Node:
        """Of what is the same in every row."""
        return self.over(lambda part: self.row(x) if part == "mean" else x)

    def column(self, quantity: str) -> str:
        """The symbol of the column that the mean is of."""
        return quantity + self.mark


TAKES = {
    take.key: take
    for take in (
        Take("max", Symbol("largest")),
        Take("min", Symbol("least")),
        Take("range", Binary("-", Symbol("largest"), Symbol("least"))),
        Take("first", Symbol("first")),
        Take("last", Symbol("last")),
        Take("mean", Symbol("mean")),
        Take("rms", Call("SQRT", (Symbol("mean"),)), Binary("^", X, Number(2.0)), "²"),  # what heats a motor
    )
}
"""All that a description may ask for, by key."""

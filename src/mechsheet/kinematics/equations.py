"""The ordered list of assignments that solves a mechanism: small data, its checker, and its printer.

    symbol = expression        in internal units (radians, the file's length unit)

An expression reads dimensions, modes, and symbols assigned before it; `Previous(x)` reads x of the row above (then
`first` is the expression of the first row). `validate` refuses a list that reads what is not solved yet or solves a
symbol twice.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from mechsheet.formula.nodes import Node, Previous, symbols, walk
from mechsheet.model import Words

Kind = Literal["constant", "driver", "intermediate", "variable", "point", "output"]
Unit = Literal["length", "angle", "number"]


@dataclass(frozen=True, slots=True)
class Equation:
    """One assignment.

    kind   "constant" has one value for all rows (a cell beside the dimensions); the others are columns
    unit   "length", "angle" (radians), "number", or any label an output was given ("mm^2"); "deg" outputs are "angle"
    group  0 for the driver's side, n for the n-th group in order of solution, -1 for outputs
    """

    symbol: str
    expression: Node
    kind: Kind
    unit: str
    label: Words
    group: int = 0
    first: Node | None = None

    @property
    def reads(self) -> tuple[str, ...]:
        """Symbols of this row that the expression reads."""
        found = dict.fromkeys(symbols(self.expression))
        if self.first is not None:
            found |= dict.fromkeys(symbols(self.first))
        return tuple(found)

    @property
    def reads_previous(self) -> tuple[str, ...]:
        """Symbols of the row above that the expression reads."""
        return tuple(dict.fromkeys(part.name for part in walk(self.expression) if isinstance(part, Previous)))


@dataclass(frozen=True, slots=True)
class Group:
    """One Assur group in order of solution.

    kind          "RRR", "RRP", "RPR", "PRP", "RPP"
    links         names of its links (a massless block of a pin-slot joint is called after its slot)
    mode          symbol of the mode cell, "" where there is only one assembly
    mode_value    +1 or -1 as the sketch says
    mode_words    what +1 and -1 look like
    closes        symbol that is a number where the group can be assembled, and #N/A where it cannot
    degenerate    TRUE in a row where the group closes but its position is undetermined (pins coincide, so that a link can
                  turn about them; lines coincide), or None
    open          True when the sketch said nothing about this group
    transmission  angle of the transmission: symbol whose sine measures how well the group transmits force, or ""
    sides         lengths that must form a triangle for the group to close: its three sides; or the hypotenuse and a leg of
                  a right triangle; none where two lines meet
    """

    number: int
    kind: str
    links: tuple[str, ...]
    pins: tuple[str, ...]
    mode: str
    mode_value: int
    mode_words: tuple[Words, Words]
    closes: str
    degenerate: Node | None
    open: bool
    label: Words
    transmission: str = ""
    sides: tuple[Node, ...] = ()


@dataclass(frozen=True, slots=True)
class Equations:
    """All equations of a mechanism: constants first, then columns, in order of solution.

    positive   symbols of dimensions that are lengths between joints: they must stay greater than zero; the driver's, too
    tolerance  symbol of the constant below which a length counts as zero
    """

    constants: tuple[Equation, ...]
    columns: tuple[Equation, ...]
    groups: tuple[Group, ...]
    positive: tuple[str, ...]
    tolerance: str

    @property
    def all(self) -> tuple[Equation, ...]:
        """Constants and columns."""
        return self.constants + self.columns

    def of(self, symbol: str) -> Equation:
        """The equation of a symbol."""
        return next(equation for equation in self.all if equation.symbol == symbol)


def validate(equations: Equations, given: tuple[str, ...]) -> None:
    """Raise ValueError unless every symbol is solved once, before it is read. `given`: dimensions and the driver."""
    known = set(given) | {group.mode for group in equations.groups if group.mode}
    solved = {equation.symbol for equation in equations.all}
    for equation in equations.all:
        missing = [name for name in equation.reads if name not in known]
        if missing:
            raise ValueError(f"{equation.symbol}: {missing[0]} is not solved yet")
        strangers = [name for name in equation.reads_previous if name not in solved | known]
        if strangers:
            raise ValueError(f"{equation.symbol}: {strangers[0]} is never solved")
        if equation.symbol in known:
            raise ValueError(f"{equation.symbol} is solved twice")
        if (equation.kind == "constant") != (equation in equations.constants):
            raise ValueError(f"{equation.symbol} stands in the wrong list")
        known.add(equation.symbol)

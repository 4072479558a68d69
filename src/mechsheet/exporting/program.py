"""A mechanism as a program in any language would hold it: what is given, what follows once, and the columns in order.

Everything is an expression tree of the equations list; a language prints it with its own dialect and its own names. Only
here is decided how a column that reads the row above is computed: as a running sum, or row by row.
"""

from __future__ import annotations

from collections.abc import Callable, Collection
from dataclasses import dataclass
from typing import Literal

from mechsheet.exporting.identifiers import identifiers
from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Binary, Call, Node, Number, Previous, Symbol, symbols, walk
from mechsheet.formula.parser import parse_description
from mechsheet.formula.printer import print_formula
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.solve import dimension_order, solve
from mechsheet.model import Dimension, Mechanism, Quantity
from mechsheet.sheet.lowering import Assignment, Assignments, lowered
from mechsheet.sheet.positions import shown_number

WIDTH = 100
"""Characters of a line of a program that has a comment."""


@dataclass(frozen=True, slots=True)
class Line:
    """`symbol = node` with what it means; `unit` is that of the value, "" for a plain number."""

    symbol: str
    node: Node
    unit: str
    words: str


@dataclass(frozen=True, slots=True)
class ColumnLine:
    """A quantity that has one value per row.

    way    "still": the expression has one value for all rows; "whole": the expression over whole columns;
           "running": the running sum of `node`, whose first term is `first`; "rows": row by row, `first` in the first
    group  number of the group, 0 on the driver's side, -1 for outputs
    """

    symbol: str
    node: Node
    way: Literal["still", "whole", "running", "rows"]
    first: Node | None
    unit: str
    words: str
    group: int


@dataclass(frozen=True, slots=True)
class Program:
    """The parts in order.

    given      dimensions that a user may change;  derived  those that follow, and the constants of the equations
    modes      assembly modes, +1 or -1
    start, stop, step, or values  the driver's, as expressions
    exists     true in a row that every group closes
    shown      driver, variables, points and outputs: what the program hands back
    names      symbol -> its name in the language
    """

    mechanism: Mechanism
    equations: Equations
    given: tuple[Line, ...]
    derived: tuple[Line, ...]
    modes: tuple[Line, ...]
    sweep: tuple[Node, Node, Node] | None
    values: tuple[Node, ...]
    columns: tuple[ColumnLine, ...]
    exists: Node
    shown: tuple[str, ...]
    names: dict[str, str]

    @property
    def moving(self) -> frozenset[str]:
        """The symbols that have one value per row."""
        return frozenset((self.mechanism.driver.symbol, *(column.symbol for column in self.columns)))

    def unit_of(self, symbol: str) -> str:
        """The unit of a shown symbol's value: "rad", the length unit, an output's own label, or ""."""
        if symbol == self.mechanism.driver.symbol:
            return "rad" if self.mechanism.driver.unit in ("deg", "rad") else self.mechanism.length_unit
        return unit_word(self.mechanism, self.equations.of(symbol).unit)

    def print(self, node: Node, dialect: str, previous: Callable[[str], str], row: Callable[[str], str] = str) -> str:
        """The text of an expression; `previous` and `row` say how a moving name is written for the row above and this."""

        def name(part: Symbol | Previous) -> str:
            plain = self.names[part.name]
            if isinstance(part, Previous):
                return previous(plain)
            return row(plain) if part.name in self.moving else plain

        return print_formula(node, dialect, name)


def heading(program: Program, number: int) -> str:
    """What stands over the columns of a group."""
    if number <= 0:
        return "outputs" if number < 0 else "driver's side"
    group = program.equations.groups[number - 1]
    return f"group {number} ({group.kind}): {one_line(group.label.of(program.mechanism.language))}"


def commented(code: str, words: str, mark: str) -> list[str]:
    """A line of code with its comment behind it, or over it where there is no room."""
    if not words:
        return [code]
    if len(code) + len(words) + 4 <= WIDTH:
        return [f"{code}  {mark} {words}"]
    indent = " " * (len(code) - len(code.lstrip()))
    return [f"{indent}{mark} {words}", code]


def program_of(mechanism: Mechanism, reserved: Collection[str]) -> Program:
    """The program of a mechanism; no name in it is one of `reserved`. Raises MechanismError."""
    solved = solve(mechanism)
    equations = lowered(mechanism, solved)
    language = mechanism.language
    dimensions = {dim.symbol: dim for dim in mechanism.dimensions}
    order = [dimensions[symbol] for symbol in dimension_order(mechanism)]
    constants = [
        Line(eq.symbol, eq.expression, unit_word(mechanism, eq.unit), one_line(eq.label.of(language)))
        for eq in equations.constants
    ]
    modes = tuple(
        Line(group.mode, Number(float(group.mode_value)), "", f"+1: {plus.of(language)}, -1: {minus.of(language)}")
        for group in equations.groups
        if group.mode
        for plus, minus in [group.assemblies]
    )
    driver = mechanism.driver
    degrees = driver.unit == "deg"
    sweep = (
        None if driver.values else tuple(quantity(part, degrees) for part in (driver.start, driver.stop, driver.step))
    )
    columns = _columns(mechanism, equations)
    kept = [eq.symbol for eq in equations.columns if eq.role in ("variable", "point", "output")]
    wanted = [driver.symbol, *dimensions, *(line.symbol for line in modes), *(eq.symbol for eq in equations.all)]
    return Program(
        mechanism,
        solved,
        tuple(_dimension(mechanism, dim) for dim in order if not dim.derived),
        (*(_dimension(mechanism, dim) for dim in order if dim.derived), *constants),
        modes,
        (sweep[0], sweep[1], sweep[2]) if sweep else None,
        tuple(quantity(value, degrees) for value in driver.values),
        columns,
        _exists(equations),
        tuple(dict.fromkeys([driver.symbol, *kept])),
        identifiers(dict.fromkeys(wanted), reserved),
    )


def _dimension(mechanism: Mechanism, dim: Dimension) -> Line:
    unit = {"deg": "rad", "1": ""}.get(dim.unit, dim.unit)
    words = one_line(dim.label.of(mechanism.language)) if dim.label else ""
    return Line(dim.symbol, quantity(dim.value, dim.unit == "deg"), unit, words)


def quantity(value: Quantity, degrees: bool) -> Node:
    """A quantity of the model; a plain number of degrees as RADIANS(30), which a person can read."""
    if isinstance(value, str):
        return parse_description(value)
    number = al.number(shown_number(value, degrees))
    return Call("RADIANS", (number,)) if degrees and not al.is_zero(number) else number


def unit_word(mechanism: Mechanism, unit: str) -> str:
    """The unit of an equation's value in internal units, as a word."""
    return {"length": mechanism.length_unit, "angle": "rad", "number": ""}.get(unit, unit)


def one_line(text: str) -> str:
    """A text of the description on one line, free of control characters: it may stand in a comment."""
    return "".join(letter for letter in " ".join(text.split()) if letter.isprintable())


def _columns(mechanism: Mechanism, equations: Assignments) -> tuple[ColumnLine, ...]:
    moving = {mechanism.driver.symbol}
    found = []
    for equation in equations.columns:
        line = _column(mechanism, equation, moving)
        found.append(line)
        moving.add(line.symbol)
    return tuple(found)


def _column(mechanism: Mechanism, equation: Assignment, moving: Collection[str]) -> ColumnLine:
    unit, words = unit_word(mechanism, equation.unit), one_line(equation.label.of(mechanism.language))
    node, first = equation.expression, equation.first
    way: Literal["still", "whole", "running", "rows"] = "whole"
    if first is not None:
        way = "rows"
        match node:
            case Binary("+", Previous(symbol), step) if symbol == equation.symbol and Previous(symbol) not in walk(
                step
            ):
                way, node = "running", step
    elif not any(symbol in moving for symbol in symbols(node)):
        way = "still"
    return ColumnLine(equation.symbol, node, way, first, unit, words, equation.group)


def _exists(equations: Assignments) -> Node:
    """True in a row that every group closes."""
    tests = tuple(Call("ISNUMBER", (Symbol(group.closes),)) for group in equations.groups if group.closes)
    return Call("AND", tests) if tests else Call("ISNUMBER", (al.ZERO,))

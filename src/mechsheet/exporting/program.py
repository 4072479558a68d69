"""A mechanism as a program in any language would hold it: what is given, what follows once, and the columns in order.

Everything is an expression tree of the equations list; a language prints it with its own dialect and its own names. What is
no function of spreadsheets becomes a call of a helper that each language brings along: `CONTINUOUS` takes the jumps out of
an angle over the rows, `TRIANGLE` is the angle of a triangle opposite the first of its sides.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Direction, Node, Number, Symbol, TriangleAngle, symbols, transform
from livesheet.formula.printer import print_formula
from mechsheet.compiled import Compiled
from mechsheet.exporting.functions.routines import missing_where
from mechsheet.exporting.identifiers import identifiers
from mechsheet.kinematics.dimensions import dimension_order
from mechsheet.kinematics.equations import FORCES, RATES, Condition, Equation, Equations, Group, System
from mechsheet.kinematics.newton.lost_assembly import scales
from mechsheet.kinematics.sketched import tell
from mechsheet.model import TIME, Dimension, Law, Mechanism, Quantity
from mechsheet.units import NUMBER, Unit

BESIDE = (*RATES, *FORCES)
"""Roles of what stands beside the positions."""

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
class Loop:
    """A group that Newton's method solves row by row, and where it begins.

    described  symbols that change from the values for which the start values were found to those asked for, and these
    way        what follows from them, in order, over a share of the way
    besides    what else the way and the group read: it stays as it is
    scales     in what each unknown is measured: 1 for an angle, else the largest length
    """

    system: System
    described: tuple[tuple[str, float], ...]
    way: tuple[Line, ...]
    besides: tuple[str, ...]
    scales: tuple[float, ...]

    @property
    def there(self) -> tuple[str, ...]:
        """What a function for the way is given."""
        return (*(symbol for symbol, _ in self.described), *self.besides)


@dataclass(frozen=True, slots=True)
class ColumnLine:
    """A quantity that has one value per row: `node` over whole columns.

    still  the expression has one value for all rows;  group  number of the group, 0 on the driver's side, -1 for outputs
    loop   Newton's method finds it, with the other unknowns of a system, row by row (`node` says nothing then)
    """

    symbol: str
    node: Node
    still: bool
    unit: str
    words: str
    group: int
    loop: Loop | None = None


@dataclass(frozen=True, slots=True)
class Program:
    """The parts in order.

    given      dimensions that a user may change;  derived  those that follow, and the constants of the equations
    modes      assembly modes, +1 or -1
    start, stop, step, or values  the driver's, as expressions; neither where it moves by a law
    listed     what is listed beside `values`, by symbol: speeds, accelerations
    exists     true in a row that every group closes
    shown      driver, variables, points, rates and outputs: what the program hands back
    names      symbol -> its name in the language
    """

    mechanism: Mechanism
    equations: Equations
    given: tuple[Line, ...]
    derived: tuple[Line, ...]
    modes: tuple[Line, ...]
    sweep: tuple[Node, Node, Node] | None
    values: tuple[Node, ...]
    listed: Mapping[str, tuple[Node, ...]]
    columns: tuple[ColumnLine, ...]
    exists: Node
    shown: tuple[str, ...]
    names: dict[str, str]

    @property
    def given_by_row(self) -> tuple[str, ...]:
        """The driver, and what has a value in each row beside it."""
        return self.mechanism.driver.symbol, *self.mechanism.given_by_row

    @property
    def asked_by_row(self) -> tuple[str, ...]:
        """What a caller may give row by row: by a motion law the time, from which the driver follows."""
        return self.given_by_row if self.law is None else (TIME,)

    @property
    def law(self) -> Law | None:
        """The motion law, if the driver has one."""
        return self.mechanism.driver.law

    def unit_shown(self, symbol: str) -> Unit:
        """The unit in which people read a symbol's value."""
        return self.mechanism.shown(self.mechanism.given_unit(symbol) or self.equations.of(symbol).unit)

    def unit_of(self, symbol: str) -> str:
        """The unit of a shown symbol's value: "rad", the length unit, an output's own label, or ""."""
        return self.unit_shown(symbol).internal.text

    def print(self, node: Node, dialect: str, calls: Mapping[str, str]) -> str:
        """The text of an expression; `calls` spell the helpers, `{0}` being the first argument."""
        return print_formula(node, dialect, lambda part: self.names[part.name], calls)


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


def program_of(compiled: Compiled, reserved: Collection[str]) -> Program:
    """The program of a mechanism; no name in it is one of `reserved`. Raises MechanismError."""
    mechanism, equations = compiled.mechanism, compiled.equations
    tell(mechanism, equations)
    language = mechanism.language
    dimensions = {dim.symbol: dim for dim in mechanism.dimensions}
    order = [dimensions[symbol] for symbol in dimension_order(mechanism)]
    constants = [
        Line(
            eq.symbol,
            _constant(eq),
            mechanism.shown(eq.unit.internal).text,
            one_line(eq.label.of(language)),
        )
        for eq in equations.constants
    ]
    modes = tuple(
        Line(group.mode, Number(float(group.mode_value)), "", _assemblies(group, language))
        for group in equations.groups
        if group.mode and group.follows is None
    )
    found = tuple(
        Line(group.mode, group.follows, "", _assemblies(group, language))
        for group in equations.groups
        if group.follows is not None
    )
    driver = mechanism.driver
    sweep = (
        None
        if not driver.stepped
        else tuple(quantity(part, driver.unit) for part in (driver.start, driver.stop, driver.step))
    )
    columns = _columns(mechanism, equations)
    kept = [eq.symbol for eq in equations.columns if eq.role in ("variable", "point", "rate", "force", "output")]
    given = (driver.symbol, *mechanism.given_by_row)
    lists = dict(zip(mechanism.driver_rates, (driver.speeds, driver.accelerations), strict=True))
    listed = {name: tuple(quantity(each, NUMBER) for each in values) for name, values in lists.items() if values}
    listed |= {
        each.symbol: tuple(quantity(one, each.unit) for one in each.values) for each in mechanism.drivers if each.values
    }
    wanted = [*given, *dimensions, *(line.symbol for line in (*modes, *found)), *(eq.symbol for eq in equations.all)]
    wanted += [column.symbol for column in columns]
    return Program(
        mechanism,
        equations,
        tuple(_dimension(mechanism, dim) for dim in order if not dim.derived),
        (*(_dimension(mechanism, dim) for dim in order if dim.derived), *constants, *found),
        modes,
        (sweep[0], sweep[1], sweep[2]) if sweep else None,
        tuple(quantity(value, driver.unit) for value in driver.values),
        listed,
        columns,
        _exists(equations),
        tuple(dict.fromkeys([*given, *kept])),
        identifiers(dict.fromkeys(wanted), reserved),
    )


def _assemblies(group: Group, language: str) -> str:
    """What each value of a mode means."""
    pairs = zip(group.mode_values, group.assemblies, strict=True)
    if group.system is None:
        return ", ".join(f"{value:+d}: {words.of(language)}" for value, words in pairs)
    return "; ".join(f"{value}: {words.of(language)}" for value, words in pairs)


def _dimension(mechanism: Mechanism, dim: Dimension) -> Line:
    words = one_line(dim.label.of(mechanism.language)) if dim.label else ""
    return Line(dim.symbol, quantity(dim.value, dim.unit), dim.unit.internal.text, words)


def quantity(value: Quantity, unit: Unit) -> Node:
    """A quantity of the model; a plain number of degrees as RADIANS(30), which a person can read."""
    if not isinstance(value, float):
        return value
    number = al.number(unit.written(value))
    return Call("RADIANS", (number,)) if unit.in_degrees and not al.is_zero(number) else number


def one_line(text: str) -> str:
    """A text of the description on one line, free of control characters: it may stand in a comment."""
    return "".join(letter for letter in " ".join(text.split()) if letter.isprintable())


def _columns(mechanism: Mechanism, equations: Equations) -> tuple[ColumnLine, ...]:
    moving = {mechanism.driver.symbol, *mechanism.given_by_row}
    systems = {name: group.system for group in equations.groups if group.system for name in group.system.unknowns}
    passes = {each.symbol for system in systems.values() for each in system.body}
    after = _read_afterwards(equations, passes)
    closed: dict[tuple[Condition, ...], Symbol] = {}
    found = []
    for equation in equations.columns:
        if equation.symbol in systems:
            found += _loop(equation, systems[equation.symbol], equations, mechanism)
            moving.add(equation.symbol)
            continue
        if any(equation.symbol in system.variables for system in systems.values()):
            equation = replace(equation, exists=())  # the loop says where it is none
        elif (
            equation.symbol not in after and equation.role not in BESIDE and passes & {equation.symbol, *equation.reads}
        ):
            continue  # within the loop, or what the table says of it
        still = not moving.intersection(equation.reads)
        moving.add(equation.symbol)
        if equation.exists and equation.exists not in closed:
            line = _closed(equation, len(closed), still)
            closed[equation.exists] = Symbol(line.symbol)
            found.append(line)
        node = _with_helpers(equation.expression)
        if equation.exists:
            node = Call("IF", (closed[equation.exists], al.rooted(node), Call("NA")))
            still = False  # the condition has one value per row
        unit, words = mechanism.shown(equation.unit.internal).text, one_line(equation.label.of(mechanism.language))
        found.append(ColumnLine(equation.symbol, node, still, unit, words, equation.group))
    return tuple(found)


def _read_afterwards(equations: Equations, passes: Collection[str]) -> set[str]:
    """Parts of a pass that velocities and forces read where it has arrived: the Jacobian."""
    found: set[str] = set()
    for equation in reversed(equations.columns):
        if equation.role in BESIDE or equation.symbol in found:
            found.update(name for name in equation.reads if name in passes)
    return found


def _loop(equation: Equation, system: System, equations: Equations, mechanism: Mechanism) -> list[ColumnLine]:
    """The unknowns of a system, all in one line: that of the first."""
    if equation.symbol != system.unknowns[0]:
        return []
    language = mechanism.language
    way = tuple(Line(each.symbol, _constant(each), "", one_line(each.label.of(language))) for each in system.way)
    moving = {*(line.symbol for line in way), *(symbol for symbol, _ in system.described)}
    read = [name for line in way for name in symbols(line.node)]
    besides = tuple(name for name in dict.fromkeys((*read, *system.given)) if name not in moving)
    loop = Loop(system, system.described, way, besides, scales(mechanism, equations, system))
    words = one_line(equation.label.of(language))
    return [ColumnLine(equation.symbol, al.ZERO, False, "", words, equation.group, loop)]


def _closed(equation: Equation, number: int, still: bool) -> ColumnLine:
    """Where the conditions of an equation hold; others of its group share them."""
    tests = tuple(Binary(">=", condition.margin, condition.least) for condition in equation.exists)
    name = f"closed {number + 1}"  # no description can use a name with a blank in it
    return ColumnLine(name, al.all_of(tests), still, "", "", equation.group)


def _constant(equation: Equation) -> Node:
    """A value that all rows share, where it exists."""
    value = _with_helpers(equation.expression)
    return value if equation.fails is None else missing_where(equation.fails, al.rooted(value))


def _with_helpers(expression: Node) -> Node:
    """The expression as arrays compute it: helpers called for what is no function of spreadsheets."""

    def called(part: Node) -> Node:
        match part:
            case Direction(y, x):
                return Call("CONTINUOUS", (al.atan2(x, y),))
            case TriangleAngle(opposite, beside, other):
                return Call("TRIANGLE", (opposite, beside, other))
        return part

    return transform(expression, called)


def _exists(equations: Equations) -> Node:
    """True in a row that every group closes."""
    tests = tuple(Call("ISNUMBER", (Symbol(group.closes),)) for group in equations.groups if group.closes)
    return Call("AND", tests) if tests else Call("ISNUMBER", (al.ZERO,))

"""The equations as steps of a computation, in two forms.

                           at one position (functions, a construction, a       over whole columns (arrays)
                           solution on paper)
exists                     `missing`, beside the step                           a step of its own, which others share
Direction(y, x)            the direction within half a turn, the turns that     CONTINUOUS(direction): no jumps over the
                           a table would have counted, and their sum            rows
TriangleAngle(a, b, c)     Heron's area once a triangle, then its angle         TRIANGLE(a; b; c)
Root(x, given)             the call of a procedure (`functions/routines`)       a loop for all unknowns together

CONTINUOUS and TRIANGLE are no functions of spreadsheets: each language brings them along.
"""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import dataclass, replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Call, Direction, Node, Symbol, TriangleAngle, symbols, transform
from livesheet.said import Words
from mechsheet.compiled import Compiled
from mechsheet.kinematics.equations import FORCES, RATES, Condition, Equation, Equations, Group, System
from mechsheet.kinematics.ledger import FreshNames, given_names, without_group
from mechsheet.kinematics.newton.changed_dimensions import scales
from mechsheet.model import Mechanism
from mechsheet.units import NUMBER, Unit
from mechsheet.words.equations import NOTHING, phrase

BESIDE = (*RATES, *FORCES)
"""Roles of what stands beside the positions."""


@dataclass(frozen=True, slots=True)
class Step:
    """`symbol = expression`, over what is given and the steps before it; no number where `missing` is true.

    counts_turns  True for the step that stands for a number of turns: 0 where only one position is known
    group         number of the group, 0 on the driver's side, -1 for outputs
    still         of a column: the expression has one value for all rows
    loop          of a column: Newton's method finds it, with the other unknowns of a system, row by row
    """

    symbol: str
    expression: Node
    missing: Node | None = None
    label: Words = NOTHING
    unit: Unit = NUMBER
    counts_turns: bool = False
    group: int = 0
    still: bool = False
    loop: Loop | None = None

    @property
    def reads(self) -> tuple[str, ...]:
        """Symbols of the expression and of what decides whether it has a number."""
        return (*symbols(self.expression), *(() if self.missing is None else symbols(self.missing)))


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
    way: tuple[Step, ...]
    besides: tuple[str, ...]
    scales: tuple[float, ...]

    @property
    def there(self) -> tuple[str, ...]:
        """What a function for the way is given."""
        return (*(symbol for symbol, _ in self.described), *self.besides)


# --- at one position ------------------------------------------------------------------------------------------------------


class Lowering:
    """The steps in order of solution.

    steps    by the equation that they belong to; its own step is the last
    holders  equation -> the step beside which its conditions stand: itself, or the area of its triangle
    """

    def __init__(self, compiled: Compiled) -> None:
        equations = compiled.equations
        found = [*(equation.symbol for equation in equations.all), *compiled.modes]
        self._names = FreshNames([*given_names(compiled.mechanism), *found])
        self._groups = {group.number: group for group in equations.groups}
        self._areas: dict[frozenset[Node], str] = {}
        self.holders: dict[str, str] = {}
        self.steps: dict[str, tuple[Step, ...]] = {}
        for equation in equations.all:
            self.holders[equation.symbol] = equation.symbol
            self.steps[equation.symbol] = tuple(self._lowered(equation))

    def _lowered(self, equation: Equation) -> list[Step]:
        symbol, label, unit = equation.symbol, equation.label, equation.unit
        match equation.expression:
            case Direction(y, x):
                # a name of its own beside phi, which is a function of spreadsheets
                raw = self._names.reserve(f"{without_group(symbol, equation.group)}_0", equation.group)
                turns = self._names.reserve("turns", equation.group)
                whole = al.mul(al.mul(al.TWO, al.PI), Symbol(turns))
                return [
                    Step(raw, al.atan2(x, y), None, phrase("within_half_a_turn", angle=label), unit),
                    Step(turns, al.ZERO, counts_turns=True),
                    Step(symbol, al.add(Symbol(raw), whole), None, label, unit),
                ]
            case TriangleAngle(opposite, beside, other):
                steps, area = self._area(equation, (beside, other, opposite))
                angle = al.triangle_angle(opposite, beside, other, Symbol(area))
                return [*steps, Step(symbol, angle, None, label, unit)]
        return [Step(symbol, equation.expression, equation.fails, label, unit)]

    def _area(self, equation: Equation, sides: tuple[Node, ...]) -> tuple[list[Step], str]:
        """The step of a triangle's area, unless another of its angles has brought it, and its symbol."""
        key = frozenset(sides)
        steps = []
        if key not in self._areas:
            group = self._groups.get(equation.group)
            own = group is not None and frozenset(group.sides) == key
            base = "Delta" if own else f"Delta{without_group(equation.symbol, equation.group).removeprefix('gamma')}"
            area = self._areas[key] = self._names.reserve(base, equation.group)
            label = area_words(equation, group if own else None)
            expression = al.triangle_area(*(group.sides if group is not None and own else sides))
            steps.append(Step(area, expression, equation.fails, label, NUMBER))
        self.holders[equation.symbol] = self._areas[key]
        return steps, self._areas[key]


def area_words(equation: Equation, group: Group | None) -> Words:
    """The area by which an angle is found: of a group's triangle, or of a link's own."""
    if group is None:
        return phrase("area_for", symbol=equation.symbol)
    return phrase("area", name="".join(group.pins))


# --- over whole columns ---------------------------------------------------------------------------------------------------


def constants_of(mechanism: Mechanism, equations: Equations) -> tuple[Step, ...]:
    """What all rows share."""
    found = []
    for equation in equations.constants:
        step = constant(equation)
        if equation.symbol == equations.tolerance:
            # no row has a position while an input is none that a mechanism can have
            impossible = equations.impossible(mechanism.driver.symbol)
            step = replace(step, expression=missing_where(impossible, step.expression))
        found.append(step)
    return tuple(found)


def constant(equation: Equation) -> Step:
    """A value that all rows share, where it exists."""
    value = _with_helpers(equation.expression)
    value = value if equation.fails is None else missing_where(equation.fails, al.rooted(value))
    return Step(equation.symbol, value, None, equation.label, equation.unit)


def columns_of(mechanism: Mechanism, equations: Equations) -> tuple[Step, ...]:
    """What has one value for each row."""
    moving = {mechanism.driver.symbol, *mechanism.given_by_row}
    systems = {name: group.system for group in equations.groups if group.system for name in group.system.unknowns}
    arrived = {name for system in systems.values() for name in system.variables}
    passes = {each.symbol for system in systems.values() for each in system.body}
    after = _read_afterwards(equations, passes)
    closed: dict[tuple[Condition, ...], Symbol] = {}
    found = []
    for equation in equations.columns:
        symbol, exists, group = equation.symbol, equation.exists, equation.group
        if symbol in systems:
            if symbol == systems[symbol].unknowns[0]:
                loop = _loop(mechanism, equations, systems[symbol])
                found.append(Step(symbol, al.ZERO, None, equation.label, equation.unit, group=group, loop=loop))
            moving.add(symbol)
            continue
        if symbol in arrived:
            exists = ()  # the loop says where it is none
        elif symbol not in after and equation.role not in BESIDE and passes & {symbol, *equation.reads}:
            continue  # within the loop, or what the table says of it
        still = not moving.intersection(equation.reads)
        moving.add(symbol)
        node = _with_helpers(equation.expression)
        if exists:
            if exists not in closed:
                name = f"closed {len(closed) + 1}"  # no description can use a name with a blank in it
                tests = tuple(Binary(">=", condition.margin, condition.least) for condition in exists)
                closed[exists] = Symbol(name)
                found.append(Step(name, al.all_of(tests), group=group, still=still))
            node = Call("IF", (closed[exists], al.rooted(node), Call("NA")))
            still = False  # the condition has one value per row
        found.append(Step(symbol, node, None, equation.label, equation.unit, group=group, still=still))
    return tuple(found)


def _read_afterwards(equations: Equations, passes: Collection[str]) -> set[str]:
    """Parts of a pass that velocities and forces read where it has arrived: the Jacobian."""
    found: set[str] = set()
    for equation in reversed(equations.columns):
        if equation.role in BESIDE or equation.symbol in found:
            found.update(name for name in equation.reads if name in passes)
    return found


def _loop(mechanism: Mechanism, equations: Equations, system: System) -> Loop:
    way = tuple(constant(each) for each in system.way)
    moving = {*(step.symbol for step in way), *(symbol for symbol, _ in system.described)}
    read = [name for step in way for name in symbols(step.expression)]
    besides = tuple(name for name in dict.fromkeys((*read, *system.given)) if name not in moving)
    return Loop(system, system.described, way, besides, scales(mechanism, equations, system))


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


def missing_where(condition: Node | None, value: Node) -> Node:
    """The value, or #N/A where the condition is true."""
    return value if condition is None else Call("IF", (condition, Call("NA"), value))

"""Where equations are written down while a mechanism is being solved: unique names, constants told from columns, values.

Names that the description gives stay as they are; new ones stand beside them. The values ride along (a few rows of numpy) so
that the sketch can pick each group's assembly mode as soon as the group's equations stand.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import chain, count

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.names import folded
from livesheet.formula.nodes import Call, Direction, Node, Number, Root, Symbol, symbols
from livesheet.said import Words
from mechsheet.kinematics.equations import Condition, Equation, ForceKind, Role, System
from mechsheet.kinematics.newton.system import followed
from mechsheet.kinematics.numeric import Array, evaluate_equation
from mechsheet.model import Mechanism
from mechsheet.units import ANGLE, LENGTH, NUMBER, Unit
from mechsheet.words.equations import NOTHING, phrase

CLOSING = 1e-12
"""A gap below this part of the largest length counts as closed: rounding at a dead centre, not a limit passed."""


class Ledger:
    """The growing list of equations.

    constant_symbols  symbols that have one value for all rows
    positive          input dimensions (or the driver's displacement) used as the length of a link between joints
    ways              by symbol of a follower that a cam moves its first three derivatives by the cam's angle
    values            the columns' values over the first `rows` rows, by symbol
    """

    def __init__(
        self, dimensions: dict[str, float], driver: str, given: Mapping[str, Array], taken: Iterable[str]
    ) -> None:
        self.dimensions = dimensions
        self.rows = len(given[driver])
        self.values: dict[str, Array] = {name: np.full(self.rows, number) for name, number in dimensions.items()}
        self.values |= given
        self.driver = driver
        self.constant_symbols = set(dimensions)
        self.constants: list[Equation] = []
        self.columns: list[Equation] = []
        self.positive: dict[str, None] = {}
        self.tolerance: Node = al.ZERO  # set to its symbol by whoever knows the lengths
        self.group = 0
        self.systems: dict[str, System] = {}  # by the symbol of each unknown
        self.ways: dict[str, tuple[Node, ...]] = {}
        self.following = self.rows  # so many rows follow one another: the others are picked from what comes later
        self._names = FreshNames(taken)
        self._size: Node | None = None

    def reserve(self, base: str, numbered: bool = True) -> str:
        """A name like `base` that nothing else has: `phi`, in the second group `phi_2` unless it is not `numbered`."""
        return self._names.reserve(base, self.group if numbered else 0)

    def mode(self) -> Symbol:
        """The assembly mode of the present group, `mode_1`: a constant that is +1 until the sketch says otherwise."""
        name = self.reserve(f"mode_{self.group}" if self.group <= 1 else "mode")
        self.constant_symbols.add(name)
        self.values[name] = np.ones(self.rows)
        return Symbol(name)

    def set_mode(self, name: str, number: int, start: int) -> None:
        """Let a mode be +1, -1 or the number of an assembly, and compute the columns again from position `start` on."""
        self.values[name] = np.full(self.rows, float(number))
        self._recompute(start)

    def is_constant(self, node: Node) -> bool:
        """True when an expression has one value for all rows."""
        return all(name in self.constant_symbols for name in symbols(node))

    def define(
        self,
        symbol: str,
        expression: Node,
        unit: Unit,
        label: Words,
        role: Role,
        exists: Sequence[Condition] = (),
        force: ForceKind = "",
    ) -> Symbol:
        """Write `symbol = expression` down and compute it. `role` "constant" is for all rows, others are columns."""
        equation = Equation(symbol, expression, role, unit, label, self.group, tuple(exists), force)
        if role == "constant":
            self.constants.append(equation)
            self.constant_symbols.add(symbol)
        else:
            self.columns.append(equation)
        self._compute(equation)
        return Symbol(symbol)

    def _compute(self, equation: Equation) -> None:
        """Its values; of the unknowns of a system all at once."""
        if not isinstance(equation.expression, Root):
            self.values[equation.symbol] = evaluate_equation(equation, self.values, self.rows)
            return
        system = self.systems[equation.symbol]
        if equation.symbol == system.unknowns[0]:
            for name, column in followed(system, self.values, self.rows).items():
                column[self.following :] = np.nan
                self.values[name] = column

    def size(self) -> Node:
        """The largest length, as a constant of its own."""
        if self._size is None:
            node = al.mul(Number(1.0 / CLOSING), self.tolerance)
            self._size = self.define(
                self.reserve("size", numbered=False), node, LENGTH, phrase("largest_length"), "constant"
            )
        return self._size

    def hoist(self, base: str, expression: Node, unit: Unit, label: Words, exists: Sequence[Condition] = ()) -> Node:
        """The expression itself when it is simple, else a new constant or intermediate column that holds it."""
        if al.is_simple(expression):
            return expression
        parts = [expression, *(node for condition in exists for node in (condition.margin, condition.least))]
        role: Role = "constant" if all(self.is_constant(part) for part in parts) else "intermediate"
        return self.define(self.reserve(base), expression, unit, label, role, exists)

    def column(self, base: str, expression: Node, unit: Unit, label: Words, exists: Sequence[Condition] = ()) -> Symbol:
        """A new intermediate column."""
        return self.define(self.reserve(base), expression, unit, label, "intermediate", exists)

    def hoist_angle(self, base: str, angle: Angle, label: Words) -> Angle:
        """The angle with its symbolic part made simple."""
        return Angle(self.hoist(base, angle.node, ANGLE, label), angle.degrees)

    def number(self, node: Node) -> float:
        """Value of a constant expression."""
        probe = Equation("", node, "constant", NUMBER, NOTHING)
        return float(evaluate_equation(probe, self.values, self.rows)[0])

    @property
    def largest_length(self) -> float:
        """In what positions are measured."""
        return self.number(self.tolerance) / CLOSING

    def turning(self, system: System) -> tuple[bool, ...]:
        """Which unknowns of a system are angles."""
        return tuple(self.of(name).unit.kind == "angle" for name in system.variables)

    def is_positive(self, node: Node) -> bool:
        """True for a length that is positive because of what it is made of.

        A symbol counts when it is positive now; it is noted in `positive`, and the workbook then insists on it.
        """
        plain = al.value_of(node)
        if plain is not None:
            return plain > 0
        match node:
            case Symbol(name) if bool(np.all(self.values[name] > 0)):
                if name in self.dimensions or name == self.driver:
                    self.positive[name] = None
                return True
            case Call("SQRT" | "ABS", _):
                return True
        return False

    def direction(self, base: str, x: Node, y: Node, label: Words) -> Symbol:
        """The direction of the vector (x, y), an angle without jumps."""
        return self.column(base, Direction(y, x), ANGLE, label)

    def first_number(self, symbol: str) -> int | None:
        """The first row in which a column is a number."""
        found = np.flatnonzero(np.isfinite(self.values[symbol]))
        return int(found[0]) if len(found) else None

    def of(self, symbol: str) -> Equation:
        """The column of a symbol."""
        return next(equation for equation in self.columns if equation.symbol == symbol)

    def replace_expression(self, symbol: str, expression: Node) -> None:
        """Give a column another expression (used to take whole turns out of an angle)."""
        at = self.columns.index(self.of(symbol))
        self.columns[at] = replace(self.columns[at], expression=expression)
        self._recompute(at)

    def _recompute(self, start: int) -> None:
        for equation in self.columns[start:]:
            self._compute(equation)


def given_names(mechanism: Mechanism) -> list[str]:
    """Every name that the description gives to a quantity."""
    return [
        *(dimension.symbol for dimension in mechanism.dimensions),
        *(output.symbol for output in mechanism.outputs),
        *(each.symbol for each in mechanism.motion_numbers),
        *(link.angle_symbol for link in mechanism.links),
        *(joint.symbol for joint in mechanism.joints),
        *mechanism.driven_symbols,
        *(name for name in mechanism.given_by_row if name not in mechanism.driven_symbols),
        *_rates(mechanism),
        *(mechanism.cam.symbols if mechanism.cam else ()),
    ]


def _rates(mechanism: Mechanism) -> tuple[str, ...]:
    """The names of angular velocities and accelerations, where there are any."""
    if mechanism.driver.speed is None:
        return ()
    return tuple(name for link in mechanism.links for name in link.rate_symbols)


def without_group(symbol: str, group: int) -> str:
    """The symbol without the number of its group: what `FreshNames.reserve` made it from."""
    return symbol.removesuffix(f"_{group}") if group > 1 else symbol


class FreshNames:
    """Names for quantities that no description gave one."""

    def __init__(self, taken: Iterable[str]) -> None:
        self._taken = {folded(name) for name in taken}

    def reserve(self, base: str, group: int) -> str:
        """A name like `base` that nothing else has: `phi`, in the second group `phi_2`."""
        group = max(group, 1)
        first = [base, f"{base}_1"] if group == 1 else [f"{base}_{group}"]
        further = (f"{base}_{group}_{number}" for number in count(2))
        name = next(name for name in chain(first, further) if folded(name) not in self._taken)
        self._taken.add(folded(name))
        return name

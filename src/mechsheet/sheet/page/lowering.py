"""The equations as one writes them on the blackboard: the law of cosines by arccos, points written where they are read.

    TriangleAngle(a, b, c)   IFERROR(ACOS(ROUND((b^2 + c^2 - a^2) / (2 b c), 12)), NA())
    leg of a right triangle  psi = IFERROR(ASIN(ROUND(n / a, 12)), NA()),  then  w = a cos(psi)
    Direction(y, x)          ATAN2; the table's cells add the turns that bring it next to the row above (see `table`)

Rounded to 12 digits, since a cosine of 1 + 1e-16 at a dead centre must not be an error. An error d of the cosine is one of
d / sin(angle) of the angle: 5e-13 rad where it is large, 1e-9 rad within 0.03 degrees of a dead centre, 1e-6 rad in it.

What the sheets have besides is left out: a point of a link that turns about a fixed pin is written where it is read, a
quantity that stays the same is a cell and no column, and what nobody reads is not there.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass, replace

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Direction, Node, Symbol, TriangleAngle, symbols, transform, walk
from mechsheet.kinematics.dimensions import dimension_values, largest_length
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.equations import Condition, Equation, Equations, Group
from mechsheet.kinematics.ledger import FreshNames, given_names
from mechsheet.kinematics.numeric import value as numeric
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Mechanism
from mechsheet.sheet.columns.lowering import Assignment, Assignments, assignment_of, guarded, pins_apart
from mechsheet.sheet.quoted import formula
from mechsheet.sheet.table.status import NEAR
from mechsheet.units import LENGTH
from mechsheet.words.equations import phrase

DIGITS = 12
"""Digits of a cosine or sine that count."""


@dataclass(frozen=True, slots=True)
class PageAssignments(Assignments):
    """The equations of a page.

    closes  by number of a group: a column that has a value exactly where the group can be assembled
    plain   symbols that have no cell: what they are
    """

    closes: Mapping[int, str]
    plain: Mapping[str, Node]


def lowered(mechanism: Mechanism, equations: Equations, kept: Collection[str], drawn: bool) -> PageAssignments:
    """The equations of a page.

    kept   symbols that are read by charts, summaries and paths, and so are columns
    drawn  True when the drawing needs every point: else one that nobody reads is left out
    """
    return _Lowering(mechanism, equations, frozenset(kept), drawn).result()


class _Lowering:
    def __init__(self, mechanism: Mechanism, equations: Equations, kept: frozenset[str], drawn: bool) -> None:
        self.equations = equations
        self.drawn = drawn
        self.kept = kept
        modes = [group.mode for group in equations.groups if group.mode]
        symbols_found = [equation.symbol for equation in equations.all]
        self.names = FreshNames([*given_names(mechanism), *symbols_found, *modes])
        self.still = {*dimension_values(mechanism), *modes, *(equation.symbol for equation in equations.constants)}
        self.known = {*self.still, mechanism.driver.symbol, *mechanism.given_by_row}
        values = dimension_values(mechanism)
        self.size = largest_length(mechanism, values) or 1.0
        self.nominal = sweep(mechanism, equations, given_values(mechanism, values))
        self.plain: dict[str, Node] = {}
        self.legs: dict[Node, Node] = {}
        self.constants: list[Assignment] = []
        self.columns: list[Assignment] = []
        self.done: set[str] = set()

    def result(self) -> PageAssignments:
        """All of them."""
        for equation in self.equations.all:
            if equation.symbol not in self.done:
                self._hoist_legs(equation)
                self._lower(equation)
        closes = {group.number: self._closes(group) for group in self.equations.groups}
        read = self._read(closes.values())
        self.plain |= {
            each.symbol: each.expression for each in (*self.constants, *self.columns) if each.symbol not in read
        }
        constants, columns = (
            tuple(each for each in found if each.symbol in read) for found in (self.constants, self.columns)
        )
        return PageAssignments(self.equations, constants, columns, self.equations.groups, {}, {}, closes, self.plain)

    # --- one equation -----------------------------------------------------------------------------------------

    def _lower(self, equation: Equation) -> None:
        group = self.equations.group_of(equation)
        expression = self._seen(equation.expression)
        reaches = any(each.reach for each in equation.exists)
        if group is not None and equation.symbol == group.closes and reaches and len(group.sides) == 2:
            self._leg(equation, group)
            return
        match expression:
            case Direction(y, x):
                raw = al.atan2(x, y)
                apart = [
                    Condition(self._seen(each.margin), each.least) for each in pins_apart(self.equations, equation)
                ]
                self._add(equation, guarded(apart, raw), expression, continuous=not self._stays(raw))
            case TriangleAngle(opposite, beside, other):
                angle = _inverse("ACOS", al.triangle_cosine(opposite, beside, other))
                self._add(equation, self._where_it_exists(equation, angle), expression)
            case _ if self._is_plain(equation, expression):
                self.plain[equation.symbol] = expression
            case _:
                self._add(equation, self._where_it_exists(equation, expression), expression)

    def _leg(self, equation: Equation, group: Group) -> None:
        """The angle opposite a leg by its sine, before the other leg, which is the hypotenuse times its cosine."""
        hypotenuse, leg = (self._seen(side) for side in group.sides)
        beside = next(
            each for each in self.equations.columns
            if each.group == group.number and each.expression == al.atan2(Symbol(equation.symbol), group.sides[1])
        )  # fmt: skip
        ratio = al.div(leg, hypotenuse)
        angle = replace(beside, exists=equation.exists)
        self._add(angle, self._where_it_exists(angle, _inverse("ASIN", ratio)), Call("ASIN", (ratio,)))
        length = formula("hypotenuse*COS(angle)", hypotenuse=hypotenuse, angle=Symbol(beside.symbol))
        self._add(equation, length, length)

    def _add(self, equation: Equation, expression: Node, says: Node, continuous: bool = False) -> None:
        still = equation.symbol not in self.kept and equation.role != "output" and self._stays(expression)
        if still:
            self.still.add(equation.symbol)
        target = self.constants if equation.role == "constant" or still else self.columns
        target.append(assignment_of(equation, expression, says, expression if continuous else None))
        self.known.add(equation.symbol)
        self.done.add(equation.symbol)

    def _stays(self, expression: Node) -> bool:
        """True for what has one value for all rows."""
        return all(name in self.still for name in symbols(expression))

    def _seen(self, node: Node) -> Node:
        """The tree with everything that has no cell of its own in its place."""

        def change(part: Node) -> Node:
            if isinstance(part, Symbol):
                part = self.plain.get(part.name, part)
            return self.legs.get(al.tidied(part), part)

        return al.tidied(transform(node, change))

    def _is_plain(self, equation: Equation, expression: Node) -> bool:
        """True for what needs no column: a point on a circle about a fixed pin, a quantity that is another one."""
        if equation.symbol in self.kept or self._guards(equation):
            return False
        if equation.role == "intermediate":
            return al.is_simple(expression)
        if equation.role == "constant":
            return al.is_simple(expression) and equation.symbol.endswith((".x", ".y"))
        if equation.role != "point":
            return False
        moving = [name for name in symbols(expression) if name not in self.still]
        turned = sum(isinstance(part, Call) and part.name in ("COS", "SIN") for part in walk(expression))
        return al.is_simple(expression) or (len(set(moving)) == 1 and turned <= 1)

    # --- what must hold ---------------------------------------------------------------------------------------

    def _where_it_exists(self, equation: Equation, expression: Node) -> Node:
        guards = self._guards(equation)
        return guarded(guards, expression) if guards else expression

    def _guards(self, equation: Equation) -> list[Condition]:
        """The conditions that the formula does not see by itself: pins that may coincide, lines that may be parallel."""
        if equation.role == "coefficient":  # a dead centre is asked for in every row
            return [Condition(self._seen(each.margin), self._seen(each.least)) for each in equation.exists]
        found = []
        group = self.equations.group_of(equation)
        if group is not None and group.only_undetermined:
            return [Condition(self._seen(each.margin), each.least) for each in equation.exists]
        for condition in equation.exists:
            if condition.reach:
                continue
            margin = condition.margin
            if isinstance(margin, Call) and margin.name == "MIN":
                parts = [part for part in margin.args if not self._stays(self._seen(part))]
                margin = al.smallest(parts) if parts else al.ONE
            near = NEAR * (1.0 if equation.unit.kind == "number" else self.size)
            if not self._stays(self._seen(margin)) and self._least(margin) < near:
                found.append(Condition(self._seen(margin), condition.least))
        return found

    def _least(self, margin: Node) -> float:
        with np.errstate(all="ignore"):
            values = np.atleast_1d(numeric(margin, self.nominal))
        return float(np.min(values[np.isfinite(values)], initial=np.inf))

    # --- columns of a group -----------------------------------------------------------------------------------

    def _hoist_legs(self, equation: Equation) -> None:
        """The two parts of a distance as columns of their own, before the first equation of their group that reads them."""
        group = self.equations.group_of(equation)
        if group is None or equation.symbol.endswith((".x", ".y")):
            return
        for other in self.equations.columns:
            if other.group != group.number or not isinstance(other.expression, Direction):
                continue
            for axis, part in (("x", other.expression.x), ("y", other.expression.y)):
                tree = self._seen(part)
                if (
                    al.is_simple(tree)
                    or tree in self.legs
                    or self._stays(tree)
                    or part not in walk(equation.expression)
                ):
                    continue
                if all(name in self.known for name in symbols(tree)):
                    name = self.names.reserve(f"{'s' if group.kind == 'RRR' else 'r'}_{axis}", group.number)
                    label = phrase("part_of", what=other.label, axis=axis)
                    self._add(Equation(name, tree, "intermediate", LENGTH, label, group.number), tree, tree)
                    self.legs[tree] = Symbol(name)

    def _closes(self, group: Group) -> str:
        """Its own measure where that is a column, else an angle or displacement that the group decides."""
        own = self._seen(Symbol(group.closes))
        moving = [each.symbol for each in self.columns]
        for name in (
            *symbols(own),
            *group.unknowns,
            *(each.symbol for each in self.columns if each.group == group.number),
        ):
            if name in moving and any(each.symbol == name and each.group == group.number for each in self.columns):
                return name
        return ""

    def _read(self, roots: Collection[str]) -> set[str]:
        """Symbols that somebody reads: the roots, variables and outputs, and all that they read."""
        by_symbol = {each.symbol: each for each in (*self.constants, *self.columns)}
        waiting = [*roots, *self.kept, *(group.transmission for group in self.equations.groups)]
        roles = ("variable", "rate", "force", "output", *(("point",) if self.drawn else ()))
        waiting += [each.symbol for each in by_symbol.values() if each.role in roles]
        read: set[str] = set()
        while waiting:
            name = waiting.pop()
            if name in by_symbol and name not in read:
                read.add(name)
                waiting += by_symbol[name].reads
            elif name in self.plain:
                waiting += symbols(self.plain[name])
        return read


def _inverse(function: str, argument: Node) -> Node:
    """The inverse function, an angle where there is one: every program's own error for ACOS(1.2) becomes #N/A."""
    rounded = formula("ROUND(argument,digits)", argument=argument, digits=float(DIGITS))
    return formula("IFERROR(angle,NA())", angle=Call(function, (rounded,)))

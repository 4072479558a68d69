"""The equations as cells compute them: what is mathematics in `kinematics` becomes formulas of one row and the row above.

    exists, beside an equation      the group's margin in a column of its own, read as IF(margin < -tol, NA(), the equation):
                                    never what a program makes of ACOS(2)
    Direction(y, x)                 ATAN2 and as many turns as bring it within half a turn of the row above
    TriangleAngle(a, b, c)          the law of cosines by ATAN2 of b^2 + c^2 - a^2 and four times the area: ACOS is an error
                                    where rounding makes a cosine of 1 + 1e-16, and loses digits in a thin triangle

Source: W. Kahan, "Miscalculating area and angles of a needle-like triangle".
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import (
    Binary,
    Call,
    Direction,
    Node,
    Previous,
    Symbol,
    TriangleAngle,
    symbols,
    walk,
)
from mechsheet.kinematics.equations import Condition, Equation, Equations, Group, LinkPose, Role
from mechsheet.kinematics.naming import FreshNames, given_names
from mechsheet.model import Mechanism, Words
from mechsheet.sheet.quoted import formula
from mechsheet.units import LENGTH, Unit
from mechsheet.words.equations import phrase

TURN = al.mul(al.TWO, al.PI)


@dataclass(frozen=True, slots=True)
class Assignment:
    """One cell, or one column of cells: `symbol = expression`, where `Previous(x)` reads x of the row above.

    says    the same as mathematics, for people to read
    first   what stands in the first row instead, where the expression reads the row above; fields else as in `Equation`
    """

    symbol: str
    expression: Node
    says: Node
    role: Role
    unit: Unit
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
class Assignments:
    """The equations of a mechanism for cells, constants first, then columns; `equations` are what they say.

    margins  by number of a group: the column that says how far it is from coming apart, where it can
    """

    equations: Equations
    constants: tuple[Assignment, ...]
    columns: tuple[Assignment, ...]
    groups: tuple[Group, ...]
    margins: Mapping[int, str]

    @property
    def listed(self) -> tuple[Assignment, ...]:
        """What is given row by row: nothing computes it."""
        return tuple(_given(equation) for equation in self.equations.listed)

    @property
    def all(self) -> tuple[Assignment, ...]:
        """Constants and columns."""
        return self.constants + self.columns

    @property
    def positive(self) -> tuple[str, ...]:
        """Symbols of dimensions that are lengths between joints."""
        return self.equations.positive

    @property
    def tolerance(self) -> str:
        """Symbol of the constant below which a length counts as zero."""
        return self.equations.tolerance

    @property
    def poses(self) -> Mapping[str, LinkPose]:
        """Where each link is, by its name."""
        return self.equations.poses

    def of(self, symbol: str) -> Assignment:
        """The assignment of a symbol."""
        return next(each for each in (*self.all, *self.listed) if each.symbol == symbol)


def lowered(mechanism: Mechanism, equations: Equations) -> Assignments:
    """The equations for cells, in the same order; what one equation needs besides stands just before it."""
    return _Lowering(mechanism, equations).result()


class _Lowering:
    def __init__(self, mechanism: Mechanism, equations: Equations) -> None:
        self.equations = equations
        self.driver = mechanism.driver.symbol
        found = [*(equation.symbol for equation in equations.all), *(group.mode for group in equations.groups)]
        self.names = FreshNames([*given_names(mechanism), *found])
        self.tests: dict[tuple[Condition, ...], Node] = {}
        self.margins: dict[int, str] = {}
        self.constants: list[Assignment] = []
        self.columns: list[Assignment] = []

    def result(self) -> Assignments:
        """All of them, and the groups."""
        for equation in self.equations.all:
            self._lower(equation)
        return Assignments(
            self.equations, tuple(self.constants), tuple(self.columns), self.equations.groups, self.margins
        )

    def _lower(self, equation: Equation) -> None:
        match equation.expression:
            case _ if equation.symbol == self.equations.tolerance:
                self._add(equation, self._tolerance(equation.expression))
            case Direction(y, x):
                self._direction(equation, y, x)
            case TriangleAngle(opposite, beside, other):
                self._triangle_angle(equation, opposite, beside, other)
            case expression:
                self._add(equation, self._where_it_exists(equation, expression))

    def _add(self, equation: Equation, expression: Node, first: Node | None = None) -> Symbol:
        target = self.constants if equation.role == "constant" else self.columns
        target.append(
            Assignment(
                equation.symbol, expression, equation.expression, equation.role, equation.unit, equation.label,
                equation.group, first,
            )
        )  # fmt: skip
        return Symbol(equation.symbol)

    def _tolerance(self, expression: Node) -> Node:
        """No number while an input is none that a mechanism can have: then no row claims a position."""
        # a driven slide is a column: where it is no length, its group comes apart in that row
        lengths = tuple(Symbol(name) for name in self.equations.positive if name != self.driver)
        modes = [Symbol(group.mode) for group in self.equations.groups if group.mode]
        wrong: list[Node] = [Binary("<=", al.smallest(lengths), al.ZERO)] if lengths else []
        wrong += [formula("ABS(mode)<>1", mode=mode) for mode in modes]
        if not wrong:
            return expression
        test = wrong[0] if len(wrong) == 1 else Call("OR", tuple(wrong))
        return formula("IF(wrong, NA(), least)", wrong=test, least=expression)

    def _triangle_angle(self, equation: Equation, opposite: Node, beside: Node, other: Node) -> None:
        """By ATAN2. All angles of a group have the same sine side, so that they fit together to the last digit; a link's
        own triangle has its area written out."""
        if equation.role == "constant" or not any(each.reach for each in equation.exists):
            area = al.triangle_area(beside, other, opposite)
            self._add(equation, guarded(equation.exists, al.triangle_angle(opposite, beside, other, area)))
            return
        sides = next(group.sides for group in self.equations.groups if group.number == equation.group)
        angle = angle_by_sides(opposite, beside, other, sine_side(*sides))
        self._add(equation, formula("IF(fails, NA(), value)", fails=self._fails(equation), value=angle))

    def _where_it_exists(self, equation: Equation, expression: Node) -> Node:
        """The expression, or #N/A where one of its conditions fails."""
        if not equation.exists:
            return expression
        if equation.role == "constant" or not any(each.reach for each in equation.exists):
            return guarded(equation.exists, expression)
        return formula("IF(fails, NA(), value)", fails=self._fails(equation), value=al.rooted(expression))

    def _fails(self, equation: Equation) -> Node:
        """Whether a group comes apart, by the column of its margin."""
        if equation.exists not in self.tests:
            reaches = next(each for each in equation.exists if each.reach)
            others = [each for each in equation.exists if each is not reaches]
            number = equation.group
            label = phrase("margin")
            name = self.names.reserve("k", number)
            margin = replace(
                equation, symbol=name, expression=reaches.margin, role="intermediate", unit=LENGTH, label=label
            )
            column = self._add(margin, guarded(others, reaches.margin))
            self.margins.setdefault(number, name)
            self.tests[equation.exists] = Binary("<", column, reaches.least)
        return self.tests[equation.exists]

    def _direction(self, equation: Equation, y: Node, x: Node) -> None:
        """ATAN2 and whole turns. After a row without a direction (none is known, or pins coincide) it begins anew."""
        raw = al.atan2(x, y)
        apart = pins_apart(self.equations, equation)
        turns = formula("IFERROR(ROUND((above-raw)/turn,0),0)", above=Previous(equation.symbol), raw=raw, turn=TURN)
        first, further = (guarded(apart, angle) for angle in (raw, al.add(raw, al.mul(TURN, turns))))
        self._add(equation, further, first=first)


def _given(equation: Equation) -> Assignment:
    return Assignment(
        equation.symbol, equation.expression, equation.expression, equation.role, equation.unit, equation.label
    )


def pins_apart(equations: Equations, direction: Equation) -> tuple[Condition, ...]:
    """What must hold for the direction by which a slot through its own pivot is found: the pin is not on the pivot."""
    group = next((group for group in equations.groups if group.number == direction.group), None)
    return equations.of(group.closes).exists if group is not None and group.only_undetermined else ()


def sine_side(a: Node, b: Node, c: Node) -> Node:
    """Four times the area of a triangle; less than 0 below the root is rounding at a dead centre."""
    return formula("SQRT(MAX(0,((a_+b_)^2-c_^2)*(c_^2-(a_-b_)^2)))", a_=a, b_=b, c_=c)


def angle_by_sides(opposite: Node, beside: Node, other: Node, sine: Node) -> Node:
    """The angle of a triangle: ATAN2 of its cosine side b^2 + c^2 - a^2 and its sine side, 4 areas."""
    return al.atan2(al.cosine_side(opposite, beside, other), sine)


def guarded(conditions: Iterable[Condition], value: Node) -> Node:
    """The value where all conditions hold, else #N/A; a root of what may be a rounding error below 0 is then 0."""
    fails = [condition.fails for condition in conditions]
    if not fails:
        return value
    test = fails[0] if len(fails) == 1 else Call("OR", tuple(fails))
    return Call("IF", (test, Call("NA"), al.rooted(value)))

"""The equations as cells compute them: what is mathematics in `kinematics` becomes formulas of one row and the row above.

    exists, beside an equation      the group's margin in a column of its own, read as IF(margin < -tol, NA(), the equation):
                                    never what a program makes of ACOS(2)
    Direction(y, x)                 ATAN2 and as many turns as bring it within half a turn of the row above
    Root(x, given)                  passes of Newton's method beside each other, started from the row above
    TriangleAngle(a, b, c)          the law of cosines by ATAN2 of b^2 + c^2 - a^2 and four times the area: ACOS is an error
                                    where rounding makes a cosine of 1 + 1e-16, and loses digits in a thin triangle

Source: W. Kahan, "Miscalculating area and angles of a needle-like triangle".
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace

from livesheet.formula import algebra as al
from livesheet.formula.nodes import (
    Binary,
    Call,
    Direction,
    Node,
    Previous,
    Root,
    Symbol,
    TriangleAngle,
    symbols,
    transform,
    walk,
)
from livesheet.said import Words
from mechsheet.kinematics.equations import Condition, Equation, Equations, Group, LinkPose, Role, System
from mechsheet.kinematics.ledger import FreshNames, given_names
from mechsheet.kinematics.newton.newton_equations import ITERATED
from mechsheet.kinematics.newton.system import CLOSED
from mechsheet.model import Mechanism
from mechsheet.sheet.quoted import formula
from mechsheet.units import LENGTH, NUMBER, Unit
from mechsheet.words.equations import phrase

TURN = al.mul(al.TWO, al.PI)

FITS = "fits"
"""Of a group solved by Newton's method: whether the passes have arrived in the same assembly."""


@dataclass(frozen=True, slots=True)
class Assignment:
    """One cell, or one column of cells: `symbol = expression`, where `Previous(x)` reads x of the row above.

    says    the same as mathematics, for people to read
    first   what the expression comes to with nothing above, where it reads the row above. All rows of a table hold the
            expression: over the first stands a heading, a text, with which sums are errors
    Fields else are as in `Equation`.
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

    margins    by number of a group: the column that says how far it is from coming apart, where it can
    crossings  by number of a group whose pin is where two lines meet: the column of the sine of the angle between them,
               where they can turn parallel
    """

    equations: Equations
    constants: tuple[Assignment, ...]
    columns: tuple[Assignment, ...]
    groups: tuple[Group, ...]
    margins: Mapping[int, str]
    crossings: Mapping[int, str]

    @property
    def listed(self) -> tuple[Assignment, ...]:
        """What is given row by row: nothing computes it."""
        return tuple(assignment_of(equation) for equation in self.equations.listed)

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


def assignment_of(
    equation: Equation, expression: Node | None = None, says: Node | None = None, first: Node | None = None
) -> Assignment:
    """The cells of an equation; where nothing else is given they hold and say what it does."""
    own, unit, label = equation.expression, equation.unit, equation.label
    return Assignment(
        equation.symbol, expression or own, says or own, equation.role, unit, label, equation.group, first
    )


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
        self.systems = [group.system for group in equations.groups if group.system is not None]
        self.constants: list[Assignment] = []
        self.columns: list[Assignment] = []

    def result(self) -> Assignments:
        """All of them, and the groups."""
        for equation in self.equations.all:
            self._lower(equation)
        # where a group is found by Newton's method there are no rows between the rows, and limits are known to the step
        groups = self.equations.groups
        margins, crossings = ({}, {}) if self.systems else (self.margins, self._crossings())
        return Assignments(self.equations, tuple(self.constants), tuple(self.columns), groups, margins, crossings)

    def _crossings(self) -> dict[int, str]:
        """Of lines that turn against each other; where they do not, a slide's displacement says whether the group closes."""
        sines = {each.symbol for each in self.columns if each.unit.kind == NUMBER.kind}
        lines = (group for group in self.equations.groups if group.kind == "PRP")
        return {group.number: group.closes for group in lines if group.closes in sines}

    def _lower(self, equation: Equation) -> None:
        match equation.expression:
            case _ if equation.symbol == self.equations.tolerance:
                # no number while an input is none that a mechanism can have: then no row claims a position
                impossible = self.equations.impossible(self.driver)
                least = equation.expression
                if impossible is not None:
                    least = formula("IF(impossible,NA(),least)", impossible=impossible, least=least)
                self._add(equation, least)
            case Direction(y, x):
                self._direction(equation, y, x)
            case Root(unknown, _):
                system = next(each for each in self.systems if unknown in each.unknowns)
                if unknown == system.unknowns[0]:
                    self._passes(equation, system)
                self._add(equation, _next(system, unknown, system.passes), says=_step(system, unknown))
            case expression if any(equation.symbol in system.variables for system in self.systems):
                self._iterated(equation, expression)
            case expression if self._reads_passes_alone(equation):
                # the last pass has numbers where the links do not meet, too
                value = guarded(equation.exists, expression)
                self._add(equation, formula("IF(fits,value,NA())", fits=Symbol(_fits(equation.group)), value=value))
            case TriangleAngle(opposite, beside, other):
                self._triangle_angle(equation, opposite, beside, other)
            case expression:
                self._add(equation, self._where_it_exists(equation, expression))

    def _add(self, equation: Equation, expression: Node, first: Node | None = None, says: Node | None = None) -> Symbol:
        target = self.constants if equation.role == "constant" else self.columns
        target.append(assignment_of(equation, expression, says, first))
        return Symbol(equation.symbol)

    def _passes(self, equation: Equation, system: System) -> None:
        """All passes but the last step: where each begins, and what follows there."""
        labels = {each.symbol: each.label for each in self.equations.columns}
        units = {each.symbol: each.unit for each in self.equations.columns}
        for number in range(1, system.passes + 1):
            for unknown, variable in zip(system.unknowns, system.variables, strict=True):
                node, first = _next(system, unknown, number - 1), None
                if number == 1:
                    first = Symbol(in_pass(unknown, 0))
                    # under the heading is neither: there it all begins
                    node = formula(
                        "IF(ISNUMBER(there),last,IF(ISNUMBER(start),start,begin))", there=Previous(variable),
                        last=Previous(unknown), start=Previous(in_pass(unknown, 1)), begin=first,
                    )  # fmt: skip
                own = replace(equation, symbol=in_pass(unknown, number), expression=Symbol(unknown),
                              unit=units[unknown], label=labels[unknown])  # fmt: skip
                self._add(own, node, first, _step(system, unknown) if number > 1 else Symbol(variable))
            for part in system.body:
                own = replace(part, symbol=in_pass(part.symbol, number), group=equation.group)
                self._add(own, in_this_pass(system, part.expression, number))

    def _reads_passes_alone(self, equation: Equation) -> bool:
        """Whether a coefficient follows from the last pass and what is the same in every row: of the Jacobian alone."""
        group = self.equations.group_of(equation)
        if equation.role != "coefficient" or group is None or group.system is None:
            return False
        system = group.system
        body, read = {each.symbol for each in system.body}, set(equation.reads)
        return bool(read & body) and not (read - body) & {each.symbol for each in self.equations.columns}

    def _iterated(self, equation: Equation, expression: Node) -> None:
        """What the passes have arrived at, where it fits and the determinant has kept its sign."""
        system = next(each for each in self.systems if equation.symbol in each.variables)
        fits = _fits(equation.group)
        if equation.symbol == system.variables[0]:
            test = formula(
                "AND(MAX(residual,begun)<=closed,det*first>0)", residual=Symbol(system.residual), closed=CLOSED,
                begun=Symbol(in_pass(system.residual, 0)),  # a start that leads nowhere is no sign of an assembly
                det=Symbol(system.determinant), first=Symbol(in_pass(system.determinant, 0)),
            )  # fmt: skip
            own = replace(equation, symbol=fits, role="iteration", unit=NUMBER, label=phrase("newton_fits"))
            self._add(own, test, says=formula("residual<=closed", residual=Symbol(system.residual), closed=CLOSED))
        self._add(equation, formula("IF(fits,value,NA())", fits=Symbol(fits), value=expression))

    def _triangle_angle(self, equation: Equation, opposite: Node, beside: Node, other: Node) -> None:
        """By ATAN2. All angles of a group have the same sine side, so that they fit together to the last digit; a link's
        own triangle has its area written out."""
        group = self.equations.group_of(equation) if equation.role != "constant" else None
        if group is not None and any(each.reach for each in equation.exists):
            angle = angle_by_sides(opposite, beside, other, sine_side(*group.sides))
        else:
            angle = al.triangle_angle(opposite, beside, other, al.triangle_area(beside, other, opposite))
        self._add(equation, self._where_it_exists(equation, angle))

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
        """ATAN2 and whole turns. It begins anew under the heading, and after a row without a direction (none is known, or
        pins coincide); but not where the row above was deleted: then nobody knows the turns, and it is an error."""
        raw = al.atan2(x, y)
        apart = pins_apart(self.equations, equation)
        turns = formula("IFERROR(ROUND((above-raw)/turn,0),0/ISREF(above))", above=Previous(equation.symbol),
                        raw=raw, turn=TURN)  # fmt: skip
        first, further = (guarded(apart, angle) for angle in (raw, al.add(raw, al.mul(TURN, turns))))
        self._add(equation, further, first=first)


def _fits(group: int) -> str:
    """The symbol that says of a group whether the passes have arrived."""
    return ITERATED.format(symbol=FITS if group == 1 else f"{FITS}_{group}")


def in_pass(symbol: str, number: int) -> str:
    """The symbol of what a system's body calls so, in the pass of that number; 0 is where it all begins."""
    return f"{symbol.partition(' ')[0]} {number}"


def in_this_pass(system: System, node: Node, number: int) -> Node:
    """An expression of a system's body in the pass of that number."""
    own = {*system.unknowns, *(each.symbol for each in system.body)}

    def change(part: Node) -> Node:
        return Symbol(in_pass(part.name, number)) if isinstance(part, Symbol) and part.name in own else part

    return transform(node, change)


def _step(system: System, unknown: str) -> Node:
    """x - J^-1 F, as people write it."""
    return al.sub(Symbol(unknown), system.corrections[system.unknowns.index(unknown)])


def _next(system: System, unknown: str, number: int) -> Node:
    """An unknown after the pass of that number: x - (J^-1 F)."""
    return in_this_pass(system, _step(system, unknown), number)


def pins_apart(equations: Equations, direction: Equation) -> tuple[Condition, ...]:
    """What must hold for the direction by which a slot through its own pivot is found: the pin is not on the pivot."""
    group = equations.group_of(direction)
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
    return formula("IF(fails,NA(),value)", fails=test, value=al.rooted(value))

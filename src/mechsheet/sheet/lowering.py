"""The equations as cells compute them: what is mathematics in `kinematics` becomes formulas of one row and the row above.

exists, beside an equation      IF(it fails, NA(), the equation): never what a program makes of ACOS(2)
Direction(y, x)                 ATAN2 within half a turn, a column that counts the turns gone by, and their sum
TriangleAngle(a, b, c)          Heron's area once a triangle, then ATAN2 of the two legs: acos loses half its digits at a
                                dead centre, this loses none
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import (
    Call,
    Direction,
    Node,
    Previous,
    Symbol,
    TriangleAngle,
    symbols,
    transform,
    walk,
)
from mechsheet.kinematics.equations import Equation, Equations, Group, Role
from mechsheet.kinematics.naming import FreshNames, given_names, without_group
from mechsheet.model import Mechanism, Words
from mechsheet.units import ANGLE, NUMBER, Unit

TURN = al.mul(al.TWO, al.PI)


@dataclass(frozen=True, slots=True)
class Assignment:
    """One cell, or one column of cells: `symbol = expression`, where `Previous(x)` reads x of the row above.

    first         what stands in the first row instead, where the expression reads the row above
    counts_turns  True for the column that counts the turns an angle has gone through; fields else as in `Equation`
    """

    symbol: str
    expression: Node
    role: Role
    unit: Unit
    label: Words
    group: int = 0
    first: Node | None = None
    counts_turns: bool = False

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

    groups  those of the equations; `closes` of each is the column that is #N/A where it cannot be joined
    """

    equations: Equations
    constants: tuple[Assignment, ...]
    columns: tuple[Assignment, ...]
    groups: tuple[Group, ...]

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

    def of(self, symbol: str) -> Assignment:
        """The assignment of a symbol."""
        return next(each for each in self.all if each.symbol == symbol)


def lowered(mechanism: Mechanism, equations: Equations) -> Assignments:
    """The equations for cells, in the same order; what one equation needs besides stands just before it."""
    return _Lowering(mechanism, equations).result()


class _Lowering:
    def __init__(self, mechanism: Mechanism, equations: Equations) -> None:
        self.equations = equations
        found = [*(equation.symbol for equation in equations.all), *(group.mode for group in equations.groups)]
        self.names = FreshNames([*given_names(mechanism), *found])
        self.groups = {group.number: group for group in equations.groups}
        self.areas: dict[frozenset[Node], Node] = {}
        self.constants: list[Assignment] = []
        self.columns: list[Assignment] = []

    def result(self) -> Assignments:
        """All of them, and the groups."""
        for equation in self.equations.all:
            self._lower(equation)
        groups = tuple(replace(group, closes=self._closing(group)) for group in self.equations.groups)
        return Assignments(self.equations, tuple(self.constants), tuple(self.columns), groups)

    def _closing(self, group: Group) -> str:
        area = self.areas.get(frozenset(group.sides))
        return area.name if isinstance(area, Symbol) else group.closes

    def _lower(self, equation: Equation) -> None:
        match equation.expression:
            case Direction(y, x):
                self._direction(equation, y, x)
            case TriangleAngle(opposite, beside, other):
                area = self._area(equation, opposite, beside, other)
                self._add(equation, al.triangle_angle(opposite, beside, other, area))
            case expression:
                self._add(equation, guarded(equation, expression))

    def _add(self, equation: Equation, expression: Node, first: Node | None = None) -> Symbol:
        target = self.constants if equation.role == "constant" else self.columns
        target.append(
            Assignment(equation.symbol, expression, equation.role, equation.unit, equation.label, equation.group, first)
        )
        return Symbol(equation.symbol)

    def _help(
        self, base: str, equation: Equation, expression: Node, unit: Unit, label: Words, first: Node | None = None
    ) -> Symbol:
        """A cell or column that an equation needs besides its own."""
        role: Role = "constant" if equation.role == "constant" else "intermediate"
        name = self.names.reserve(base, equation.group)
        # `Previous("")` is the column itself in the row above, whose name is known only here.
        expression = transform(expression, lambda part: Previous(name) if part == Previous("") else part)
        helper = replace(equation, symbol=name, role=role, unit=unit, label=label)
        return self._add(helper, expression, first)

    def _area(self, equation: Equation, opposite: Node, beside: Node, other: Node) -> Node:
        """The area of the triangle, which its angles share; #N/A where its sides do not meet."""
        key = frozenset((opposite, beside, other))
        if key not in self.areas:
            group = self.groups.get(equation.group)
            in_group = group is not None and frozenset(group.sides) == key
            sides = group.sides if group is not None and in_group else (beside, other, opposite)
            label = area_words(equation, group if in_group else None)
            base = (
                "Delta" if in_group else f"Delta{without_group(equation.symbol, equation.group).removeprefix('gamma')}"
            )
            form = guarded(equation, al.triangle_area(*sides))
            self.areas[key] = self._help(base, equation, form, NUMBER, label)
        return self.areas[key]

    def _direction(self, equation: Equation, y: Node, x: Node) -> None:
        """ATAN2 plus as many turns as have gone by. Where rows are missing the last direction known is held over them."""
        base, label = without_group(equation.symbol, equation.group), equation.label
        raw = self._help(f"{base}_0", equation, al.atan2(x, y), ANGLE, half_turn_words(label))
        if equation.group <= 1:
            # Nothing before it can be missing. Pins that coincide have no direction: ATAN2(0, 0) is an error in most
            # programs, which must not spread.
            last: Node = Previous(raw.name)
            counted: Node = Call("ISNUMBER", (al.sub(last, raw),))
        else:
            counted = Call("ISNUMBER", (raw,))
            held = self._help(
                f"{base}_held",
                equation,
                Call("IF", (counted, raw, Previous(""))),
                ANGLE,
                Words("last direction known", "bilinen son doğrultu"),
                first=Call("IF", (counted, raw, al.ZERO)),
            )
            last = Previous(held.name)
        step = Call("IF", (counted, Call("ROUND", (al.div(al.sub(last, raw), TURN), al.ZERO)), al.ZERO))
        turns = self._help(
            "turns",
            equation,
            al.add(Previous(""), step),
            NUMBER,
            Words("turns gone by", "tamamlanan tur sayısı"),
            first=al.ZERO,
        )
        self.columns[-1] = replace(self.columns[-1], counts_turns=True)
        self._add(equation, al.add(raw, al.mul(TURN, turns)))


def guarded(equation: Equation, value: Node) -> Node:
    """The value where the equation exists, else #N/A; a root of what may be a rounding error below 0 is then 0."""
    return value if equation.fails is None else Call("IF", (equation.fails, Call("NA"), al.rooted(value)))


def half_turn_words(angle: Words) -> Words:
    """The direction of which an angle without jumps is made."""
    return Words(f"{angle.en}, within half a turn", angle.tr)


def area_words(equation: Equation, group: Group | None) -> Words:
    """The area by which an angle is found: of a group's triangle, or of a link's own."""
    if group is None:
        return Words(f"area of the triangle of {equation.symbol}", f"{equation.symbol} üçgeninin alanı")
    p, q, r = group.pins
    return Words(f"area of triangle {p}{q}{r}", f"{p}{q}{r} üçgeninin alanı")

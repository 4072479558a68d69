"""The equations as cells compute them: what is mathematics in `kinematics` becomes formulas of one row and the row above.

    exists, beside an equation      IF(it fails, NA(), the equation): never what a program makes of ACOS(2)
    Direction(y, x)                 ATAN2 within half a turn, a column that counts the turns gone by, and their sum
    TriangleAngle(a, b, c)          Heron's area once a triangle, then ATAN2 of the two legs: acos loses half its digits at a
                                    dead centre, this loses none

Source of the area's form: W. Kahan, "Miscalculating area and angles of a needle-like triangle".
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import (
    Call,
    Direction,
    Node,
    Number,
    Previous,
    Symbol,
    TriangleAngle,
    symbols,
    transform,
    walk,
)
from mechsheet.kinematics.equations import Condition, Equation, Equations, Group, Role
from mechsheet.kinematics.naming import FreshNames, given_names
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
                cosine_side = al.sub(al.add(al.square(beside), al.square(other)), al.square(opposite))
                self._add(equation, al.atan2(cosine_side, al.mul(al.number(4), area)))
            case expression:
                self._add(equation, guarded(equation.exists, expression))

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
            label = _area_of_group(group) if group is not None and in_group else _area_beside(equation)
            base = "Delta" if in_group else f"Delta{_base(equation).removeprefix('gamma')}"
            form = guarded(equation.exists, _heron(*sides))
            self.areas[key] = self._help(base, equation, form, NUMBER, label)
        return self.areas[key]

    def _direction(self, equation: Equation, y: Node, x: Node) -> None:
        """ATAN2 plus as many turns as have gone by. Where rows are missing the last direction known is held over them."""
        base, label = _base(equation), equation.label
        raw = self._help(
            f"{base}_0", equation, al.atan2(x, y), ANGLE, Words(f"{label.en}, within half a turn", label.tr)
        )
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


def _base(equation: Equation) -> str:
    """The symbol without the number of its group."""
    return equation.symbol.removesuffix(f"_{equation.group}") if equation.group > 1 else equation.symbol


def guarded(conditions: Iterable[Condition], value: Node) -> Node:
    """The value where all conditions hold, else #N/A; a root of what may be a rounding error below 0 is then 0."""
    fails = [condition.fails for condition in conditions]
    if not fails:
        return value
    test = fails[0] if len(fails) == 1 else Call("OR", tuple(fails))
    return Call("IF", (test, Call("NA"), rooted(value)))


def rooted(value: Node) -> Node:
    """The value, where a root of less than 0 is 0: beside a condition that holds, that is rounding."""

    def change(part: Node) -> Node:
        match part:
            case Call("SQRT", (square,)):
                return Call("SQRT", (Call("MAX", (al.ZERO, square)),))
        return part

    return transform(value, change)


def _heron(a: Node, b: Node, c: Node) -> Node:
    """sqrt((a+b+c)(a+b-c)(c+a-b)(c-a+b)) / 4."""
    product = al.mul(
        al.mul(al.mul(al.add(al.add(a, b), c), al.sub(al.add(a, b), c)), al.sub(al.add(c, a), b)),
        al.add(al.sub(c, a), b),
    )
    return al.div(Call("SQRT", (product,)), Number(4.0))


def _area_of_group(group: Group) -> Words:
    p, q, r = group.pins
    return Words(f"area of triangle {p}{q}{r}", f"{p}{q}{r} üçgeninin alanı")


def _area_beside(equation: Equation) -> Words:
    """The area by which an angle of a link's own triangle is found."""
    return Words(f"area of the triangle of {equation.symbol}", f"{equation.symbol} üçgeninin alanı")

"""The equations as steps of a computation at one position: for functions, and for a solution on paper.

Direction(y, x)            the direction within half a turn, the turns that a table would have counted, and their sum
TriangleAngle(a, b, c)     Heron's area once a triangle, then its angle from the area
"""

from __future__ import annotations

from dataclasses import dataclass

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Direction, Node, Symbol, TriangleAngle, symbols
from livesheet.said import Words
from mechsheet.compiled import Compiled
from mechsheet.kinematics.equations import Equation, Group
from mechsheet.kinematics.naming import FreshNames, given_names, without_group
from mechsheet.units import NUMBER, Unit
from mechsheet.words.equations import NOTHING, phrase


@dataclass(frozen=True, slots=True)
class Step:
    """`symbol = expression`, over what is given and the steps before it; no number where `missing` is true.

    counts_turns  True for the step that stands for a number of turns: 0 where only one position is known
    """

    symbol: str
    expression: Node
    missing: Node | None = None
    label: Words = NOTHING
    unit: Unit = NUMBER
    counts_turns: bool = False

    @property
    def reads(self) -> tuple[str, ...]:
        """Symbols of the expression and of what decides whether it has a number."""
        return (*symbols(self.expression), *(() if self.missing is None else symbols(self.missing)))


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

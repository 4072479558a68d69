"""In which turn an angle is given where no row above says so: in a function, and at the head of a table's column.

An angle that follows from a `Direction` is known up to whole turns only. Each is taken into one turn around a straight line
over the driver, which is fitted to the values that it has with the dimensions as described.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Call, Direction, Node, Symbol, symbols, transform
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.numeric import Array
from mechsheet.model import Mechanism

WINDOWED = "{symbol} windowed"
"""The symbol of an angle taken into its turn (no description can use a name with a blank in it)."""

TURN = al.mul(al.TWO, al.PI)


@dataclass(frozen=True, slots=True)
class AngleBranch:
    """A turn wide, around the line  centre + slope * driver:  slope 0 for a link that swings, +-1 for one that turns."""

    slope: int
    centre: float

    def taken(self, angle: Node, driver: Node) -> Node:
        """The angle [rad] in that turn: low + MOD(angle - low, a turn)."""
        edge = Angle(al.mul(al.number(self.slope), driver), round(math.degrees(self.centre)) - 180.0).expression()
        return al.add(Call("MOD", (al.sub(angle, edge), TURN)), edge)


def taken_near(angle: Node, place: Node) -> Node:
    """The angle [rad] within half a turn of a place."""
    return al.sub(al.add(place, Call("MOD", (al.add(al.sub(angle, place), al.PI), TURN))), al.PI)


def reading_taken(node: Node, angles: Collection[str]) -> Node:
    """An output, or what a gear or rack decides, that reads these angles as they are taken into their turns.

    Inside the equations of groups an angle may be off by whole turns: they take its sine and cosine, or add it to others.
    An output may halve it, a rack makes a way of it.
    """

    def change(part: Node) -> Node:
        if isinstance(part, Symbol) and part.name in angles:
            return Symbol(WINDOWED.format(symbol=part.name))
        return part

    return transform(node, change) if any(name in angles for name in symbols(node)) else node


def branches_of(mechanism: Mechanism, equations: Equations, values: Mapping[str, Array]) -> dict[str, AngleBranch]:
    """The turn of each variable that is known up to whole turns, in order of solution.

    values  of every symbol over the sweep, with the dimensions as described
    """
    driver = values[mechanism.driver.symbol]
    turns = mechanism.driver.unit.kind == "angle" and bool(np.ptp(driver) > 0)
    return {symbol: _branch(values[symbol], driver, turns) for symbol in _known_up_to_turns(equations)}


def _known_up_to_turns(equations: Equations) -> list[str]:
    """Angles of links that are a `Direction` or follow from one.

    What a gear or rack makes of such an angle does not: it reads the angle as it is taken.
    """
    following: set[str] = set()
    found = []
    for equation in equations.columns:
        if equation.symbol in equations.tied:
            continue
        if isinstance(equation.expression, Direction) or not following.isdisjoint(equation.reads):
            following.add(equation.symbol)
            if equation.role == "variable" and equation.unit.kind == "angle":
                found.append(equation.symbol)
    return found


def _branch(angle: Array, driver: Array, turns: bool) -> AngleBranch:
    known = np.isfinite(angle)
    if not known.any():
        return AngleBranch(0, 0.0)
    angle, driver = angle[known], driver[known]
    slope = 0
    if turns and np.ptp(driver) > 0:
        slope = round(float((angle[-1] - angle[0]) / (driver[-1] - driver[0]))) if driver[-1] != driver[0] else 0
    rest = angle - slope * driver
    return AngleBranch(slope, float(rest.max() + rest.min()) / 2)

"""Which columns the table has in which Newton's method begins: the way from the dimensions to the group, and its passes."""

from __future__ import annotations

from dataclasses import dataclass

from livesheet.formula.nodes import Node, symbols
from mechsheet.kinematics.equations import System
from mechsheet.kinematics.newton.system import leading
from mechsheet.sheet.columns.lowering import Assignment, Assignments


@dataclass(frozen=True, slots=True)
class StartColumns:
    """What stands in the table, from left to right, behind the share of the way and before what is lost on it.

    given   dimensions, values of drivers, unknowns of groups before;  way: what the group reads of what follows from them
    passes  the unknowns, and what follows from them
    """

    given: tuple[str, ...]
    way: tuple[Assignment, ...]
    passes: tuple[str, ...]

    @property
    def width(self) -> int:
        """How many columns there are."""
        return len(self.given) + len(self.way) + len(self.passes) + 2


def start_columns(equations: Assignments, system: System) -> StartColumns:
    """The columns of a group's table."""
    rules = {each.symbol: symbols(begun(each)) for each in equations.all if each.symbol != equations.tolerance}
    given, way = leading(system.given, rules, [name for name, _ in system.described])
    passes = (*system.unknowns, *(each.symbol for each in system.body))
    return StartColumns(given, tuple(equations.of(symbol) for symbol in way), passes)


def begun(assignment: Assignment) -> Node:
    """What an assignment is in a row with nothing above."""
    return assignment.expression if assignment.first is None else assignment.first

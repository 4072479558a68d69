"""Columns that the equations do not have: what a mean is of, a flywheel's energy, the way to where Newton's method begins.

What a mean is of, where that is not the quantity itself (its square, for a root mean square), is a column of its own,
because no spreadsheet has a mean that squares and leaves out rows without a position; and so that the mean's cell reads
like every other mean.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeVar

from livesheet.formula.nodes import Node, Previous, Symbol, symbols
from mechsheet.kinematics.equations import FORCES, RATES, Role, System
from mechsheet.kinematics.newton.system import leading
from mechsheet.model import ENERGY, Mechanism, Summary, energy_unit
from mechsheet.sheet.columns.lowering import Assignment, Assignments
from mechsheet.sheet.quoted import SHOWN, formula
from mechsheet.units import Unit
from mechsheet.words.equations import phrase

Lowered = TypeVar("Lowered", bound=Assignments)


def with_averaged(mechanism: Mechanism, equations: Lowered) -> Lowered:
    """The equations, with these columns behind all others, each on the sheet of its quantity."""
    columns: dict[str, Role] = dict.fromkeys((mechanism.driver.symbol, *mechanism.given_by_row), "driver")
    columns |= {equation.symbol: equation.role for equation in equations.columns}
    found = {
        summary.take.column(summary.of): _averaged(mechanism, equations, summary, columns[summary.of])
        for summary in mechanism.summaries
        if summary.of in columns and summary.take.column(summary.of) not in columns
    }
    return replace(equations, columns=(*equations.columns, *found.values())) if found else equations


def _averaged(mechanism: Mechanism, equations: Assignments, summary: Summary, role: Role) -> Assignment:
    take, column = summary.take, summary.take.column(summary.of)
    shown = mechanism.shown(mechanism.given_unit(summary.of) or equations.of(summary.of).unit).text
    unit = Unit("number", f"({shown}){take.mark}" if set(" /·") & set(shown) else shown and shown + take.mark)
    role = "coefficient" if role in RATES else "dynamic" if role in FORCES else "intermediate"
    says, label = take.row(Symbol(summary.of)), phrase("averaged", symbol=column)
    return Assignment(column, take.row(Symbol(SHOWN + summary.of)), says, role, unit, label)


MEAN = "mean torque"
"""The symbol of the mean, which stands in a line of the first sheet."""

MEAN_NEEDS = ("forces", "extremes")
"""Keys of the sheets without which the mean is empty: of the torque, and of what says whether the rows are whole turns."""


def with_energy(mechanism: Mechanism, equations: Assignments) -> Assignments:
    """The equations, with the flywheel's column where the description has one."""
    if mechanism.flywheel is None or mechanism.dynamics is None:
        return equations
    torque = equations.equations.efforts[0]

    def step(mean: Node) -> Node:
        return formula(
            "((before+torque)/2-mean)*(driver-driver_before)", before=Previous(torque), torque=Symbol(torque), mean=mean,
            driver=Symbol(mechanism.driver.symbol), driver_before=Previous(mechanism.driver.symbol),
        )  # fmt: skip

    unit = Unit("moment", energy_unit(mechanism.dynamics, mechanism.length_unit))
    mean = Symbol(MEAN)
    # nothing is stored in the first row, above which are texts; 0 times the mean says where there is none, which is an
    # empty text once a sheet that it needs was deleted
    first = formula("IFERROR(0*mean,NA())", mean=mean)
    own = formula("N(energy)+IFERROR(step,first)", energy=Previous(ENERGY), step=step(mean), first=first)
    says = formula("energy+step", energy=Previous(ENERGY), step=step(Symbol("T_m")))
    column = Assignment(ENERGY, own, says, "force", unit, phrase("flywheel_energy"), 0, first)
    return replace(equations, columns=(*equations.columns, column))


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

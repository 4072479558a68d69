"""The flywheel's column: the energy that it has given since the first row, by trapezia.

    E = E above + ((T12 above + T12) / 2 - mean) (theta12 - theta12 above),   0 in the first row

The mean is over whole turns, in a cell of the first sheet: #N/A where the rows are none, or the speed is not constant.
"""

from __future__ import annotations

from dataclasses import replace

from livesheet.formula.nodes import Node, Previous, Symbol
from mechsheet.model import ENERGY, Mechanism, energy_unit
from mechsheet.sheet.columns.lowering import Assignment, Assignments
from mechsheet.sheet.quoted import formula
from mechsheet.units import Unit
from mechsheet.words.equations import phrase

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

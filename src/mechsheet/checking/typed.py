"""The mechanism and its equations with what a person has typed into the cells."""

from __future__ import annotations

from dataclasses import replace

from mechsheet.checking.inputs import Inputs
from mechsheet.kinematics.equations import Equations
from mechsheet.model import Mechanism
from mechsheet.sheet.plan import Plan


def typed(mechanism: Mechanism, inputs: Inputs) -> Mechanism:
    """With the values of further drivers as they are typed, row by row."""
    drivers = tuple(
        replace(driver, values=tuple(float(value) for value in inputs.given[driver.symbol]))
        if driver.values
        else driver
        for driver in mechanism.drivers
    )
    return replace(mechanism, drivers=drivers) if drivers else mechanism


def changed(mechanism: Mechanism, inputs: Inputs) -> Mechanism:
    """The mechanism with what has been typed into the cells."""
    values = tuple(inputs.given[mechanism.driver.symbol].tolist())
    listed = replace(mechanism, driver=replace(mechanism.driver, values=values))
    return replace(
        typed(mechanism, inputs),
        dimensions=tuple(
            dim if dim.derived else replace(dim, value=inputs.dimensions[dim.symbol]) for dim in mechanism.dimensions
        ),
        driver=mechanism.driver if mechanism.driver.law is not None else with_listed_rates(listed, inputs).driver,
    )


def equations_as_typed(plan: Plan, inputs: Inputs) -> Equations:
    """The plan's own equations with the assemblies of the cells: their start values are those of the workbook."""
    equations = plan.equations.equations
    groups = (
        replace(group, assembly=group.assembly_of(inputs.modes[group.mode])) if group.mode in inputs.modes else group
        for group in equations.groups
    )
    return replace(equations, groups=tuple(groups))


def with_listed_rates(mechanism: Mechanism, inputs: Inputs) -> Mechanism:
    """The mechanism with the speeds and accelerations that stand in the cells."""
    speeds, accelerations = (tuple(inputs.given[name].tolist()) if name in inputs.given else ()
                             for name in mechanism.driver_rates)  # fmt: skip
    return replace(mechanism, driver=replace(mechanism.driver, speeds=speeds, accelerations=accelerations))

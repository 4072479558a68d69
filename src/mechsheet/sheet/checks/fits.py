"""Do velocities and accelerations fit the links? Both ways round each group must give its closing point the same ones.

Measured from points, velocities and accelerations, not by the equations that these were found from. As a length: the
difference over the angular velocities in it (their squares and the angular accelerations). What a cam moves rests at
times, where all of these are 0 or rounding, as each program has it: there it is over a small part of the cam's own.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, TypeAlias

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Call, Node, Symbol, symbols
from mechsheet.sheet.checks.gaps import chunks_of
from mechsheet.sheet.geometry import largest_length
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula
from mechsheet.units import ANGLE, LENGTH, Unit

RESTING = 1e-9
"""What turns by less than this part of the cam's speed rests: all that is left of it is rounding."""

Column: TypeAlias = tuple[Literal["velocity", "acceleration"], int, Node]


def fit_columns(plan: Plan, sheet: str, row: int) -> list[Column]:
    """(what, number of the group, largest difference) of each column, as formulas of `sheet` for a row of the table.

    An empty text in rows without velocities.
    """
    found: list[Column] = []
    for number, parts in plan.equations.equations.fits.items():
        found += _columns(plan, sheet, row, "velocity", number, parts.velocity, "ABS(rate)")
    for number, parts in plan.equations.equations.fits.items():
        found += _columns(plan, sheet, row, "acceleration", number, parts.acceleration, "rate^2")
    return found


def _columns(
    plan: Plan, sheet: str, row: int, what: Literal["velocity", "acceleration"], number: int, parts: Sequence[Node],
    size: str,
) -> list[Column]:  # fmt: skip
    """Each part over what it is measured by, in as few columns as their length allows."""
    group = plan.equations.groups[number - 1]
    own = {*plan.mechanism.driver_rates, *(eq.symbol for eq in plan.equations.columns if eq.group == group.number)}
    known = _rates(plan)
    rates = [
        name for name in dict.fromkeys(name for part in parts for name in symbols(part)) if name in own & known.keys()
    ]
    speeds = [name for name in rates if known[name].per == 1]
    turning = {name: _turning(plan, name, known[name]) for name in rates}
    scale = al.total(formula(size, rate=turning[name]) for name in speeds)
    scale = al.total([scale, *(Call("ABS", (turning[name],)) for name in rates if name not in speeds)])
    if plan.mechanism.segments is not None:
        scale = formula("MAX(scale,rest*cam)", scale=scale, rest=RESTING, cam=_of_cam(plan, what))
    whole = [plan.at.bind(formula("ABS(part)/(scale)", part=part, scale=scale), sheet, row) for part in parts]
    return [
        (what, number, formula('IFERROR(most,"")', most=Call("MAX", tuple(chunk)) if len(chunk) > 1 else chunk[0]))
        for chunk in chunks_of(whole)
    ]


def _of_cam(plan: Plan, what: Literal["velocity", "acceleration"]) -> Node:
    speed, acceleration = (Symbol(name) for name in plan.mechanism.driver_rates)
    if what == "velocity":
        return formula("ABS(speed)", speed=speed)
    return formula("(speed^2+ABS(acceleration))", speed=speed, acceleration=acceleration)


def _rates(plan: Plan) -> dict[str, Unit]:
    """Velocities and accelerations, the driver's too; not coefficients of points, which stand for their velocities."""
    driver = LENGTH if plan.mechanism.driver.joint else ANGLE
    speed, acceleration = plan.mechanism.driver_rates
    found = {equation.symbol: equation.unit for equation in plan.equations.columns if equation.role == "rate"}
    return {speed: driver.per_time(), acceleration: driver.per_time().per_time()} | found


def _turning(plan: Plan, name: str, unit: Unit) -> Node:
    """A sliding velocity over the largest length, which is what an angular one would be."""
    if unit.kind == "angle":
        return Symbol(name)
    return formula("rate/(longest)", rate=Symbol(name), longest=largest_length(plan.equations))

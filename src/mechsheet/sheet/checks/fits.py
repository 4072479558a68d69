"""Do velocities and accelerations fit the links? Both ways round each group must give its closing point the same ones.

Measured from points, velocities and accelerations, not by the equations that these were found from. As a length: the
difference over the angular velocities in it (their squares and the angular accelerations).
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from mechsheet.formula import algebra as al
from mechsheet.formula.nodes import Call, Node, Symbol, symbols
from mechsheet.sheet.checks.gaps import chunks_of
from mechsheet.sheet.plan import Plan
from mechsheet.sheet.quoted import formula

Fit = tuple[Literal["velocity", "acceleration"], int, Node]

DIGITS = 1e12
"""The tolerance times this is the largest length."""


def fit_columns(plan: Plan, sheet: str, row: int) -> list[Fit]:
    """(what, number of the group, largest difference) of each column, as formulas of `sheet` for a row of the table.

    An empty text in rows without velocities.
    """
    found: list[Fit] = []
    for number, parts in plan.equations.equations.fits.items():
        found += _columns(plan, sheet, row, "velocity", number, parts[:2], "ABS(rate)")
    for number, parts in plan.equations.equations.fits.items():
        found += _columns(plan, sheet, row, "acceleration", number, parts[2:], "rate^2")
    return found


def _columns(
    plan: Plan, sheet: str, row: int, what: Literal["velocity", "acceleration"], number: int, parts: Sequence[Node],
    size: str,
) -> list[Fit]:  # fmt: skip
    """Each part over what it is measured by, in as few columns as their length allows."""
    group = plan.equations.groups[number - 1]
    own = {*plan.mechanism.driver_rates, *(eq.symbol for eq in plan.equations.columns if eq.group == group.number)}
    rates = dict.fromkeys(name for part in parts for name in symbols(part) if name in own and _is_rate(plan, name))
    speeds = [name for name in rates if name.startswith("omega") or name.endswith(".v")]
    scale = al.total(formula(size, rate=_turning(plan, name)) for name in speeds)
    scale = al.total([scale, *(Call("ABS", (_turning(plan, name),)) for name in rates if name not in speeds)])
    whole = [plan.at.bind(formula("ABS(part)/(scale)", part=part, scale=scale), sheet, row) for part in parts]
    return [
        (what, number, formula('IFERROR(most,"")', most=Call("MAX", tuple(chunk)) if len(chunk) > 1 else chunk[0]))
        for chunk in chunks_of(whole)
    ]


def _is_rate(plan: Plan, name: str) -> bool:
    """Velocities and accelerations, the driver's too; not coefficients of points, which stand for their velocities."""
    if name in plan.mechanism.driver_rates:
        return True
    equation = next((each for each in plan.equations.columns if each.symbol == name), None)
    return equation is not None and equation.role == "rate"


def _turning(plan: Plan, name: str) -> Node:
    """A sliding velocity over the largest length, which is what an angular one would be."""
    if not name.endswith((".v", ".a")):
        return Symbol(name)
    return formula(
        "rate/(digits*tolerance)", rate=Symbol(name), digits=DIGITS, tolerance=Symbol(plan.equations.tolerance)
    )

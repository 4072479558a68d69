"""What a quantity is that a table shows: of an equation, or one that is given row by row."""

from __future__ import annotations

from mechsheet.sheet.plan import Plan


def words_of(plan: Plan, symbol: str) -> str:
    """What a quantity is: of an equation, or one that is given row by row beside the driver."""
    mechanism = plan.mechanism
    if symbol not in mechanism.given_by_row:
        return plan.equations.of(symbol).label.of(plan.language)
    if symbol in mechanism.listed_symbols:
        return plan.text("drivers.listed")
    keys = dict(zip(mechanism.driver_rates, ("speed", "acceleration"), strict=True))
    return plan.text(f"given.{keys.get(symbol, symbol)}")

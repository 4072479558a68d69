"""How quantities are shown and typed, wherever they stand: their units, and what a cell takes."""

from __future__ import annotations

from livesheet.formula.nodes import Number, Unary
from livesheet.workbook import Area, Validation
from mechsheet.sheet.plan import Plan
from mechsheet.units import Unit
from mechsheet.words.symbols import plain


def unit_of_column(plan: Plan, symbol: str) -> Unit:
    """The unit in which a column is shown."""
    mechanism = plan.mechanism
    return mechanism.shown(mechanism.given_unit(symbol) or plan.equations.of(symbol).unit)


def shown_unit(plan: Plan, symbol: str) -> str:
    """The same as text: `°`."""
    return unit_of_column(plan, symbol).text


def input_validation(plan: Plan, area: Area, symbol: str) -> Validation:
    """What may be typed into cells that hold values of `symbol`: a number; of a length between joints one above 0."""
    positive = symbol in plan.equations.positive
    key = "positive" if positive else "number"
    title, message = plan.text(f"hint.{key}.title"), plan.text(f"hint.{key}", symbol=plain(symbol))
    return Validation(
        area,
        "decimal",
        ">" if positive else "between",
        Number(0.0) if positive else Unary("-", Number(1e100)),
        None if positive else Number(1e100),
        input_title=title,
        input_message=message,
        error_title=title,
        error_message=message,
    )

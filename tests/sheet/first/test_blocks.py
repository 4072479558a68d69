"""What may be typed into an input: every length above 0, every number elsewhere; what is refused, and why."""

from types import SimpleNamespace

import pytest

from livesheet.formula.scalar import evaluate
from livesheet.workbook import Area
from mechsheet.sheet.shown import input_validation

PLAN = SimpleNamespace(equations=SimpleNamespace(positive={"a1"}), text=lambda key, **parts: (key, *parts.values()))


def taken(rule, number):
    low, high = (limit and evaluate(limit, {}) for limit in (rule.low, rule.high))
    return {">": lambda: number > low, "between": lambda: low <= number <= high}[rule.operator]()


@pytest.mark.parametrize(("symbol", "yes", "no"), [("a1", (1e-3, 0.5, 1.0, 1e9), (0.0, -1.0)),
                                                   ("beta", (-1e9, -0.5, 0.0, 1e9), ())])  # fmt: skip
def test_what_may_be_typed(symbol, yes, no):
    rule = input_validation(PLAN, Area(1, 2, 3, 4), symbol)
    assert rule.area == Area(1, 2, 3, 4) and rule.kind == "decimal"
    assert all(taken(rule, number) for number in yes) and not any(taken(rule, number) for number in no)
    said = "hint.positive" if no else "hint.number"
    assert rule.input_title == rule.error_title == (f"{said}.title",)
    assert rule.input_message[0] == rule.error_message[0] == said

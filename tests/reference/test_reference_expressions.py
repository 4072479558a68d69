import tomllib

import numpy as np
import pytest
from reference_cases import CASES

from mechsheet.diagnostics import MechanismError
from mechsheet.reference.expressions import evaluate, names_in

TABLE = tomllib.loads((CASES / "expressions.toml").read_text(encoding="utf-8"))
VALUES = {"a": 2.0, "b": 0.5, "lambda": 3.0, "ı": 4.0, "C.x": 7.0}


@pytest.mark.parametrize("text", TABLE)
def test_value(text):
    assert evaluate(text, VALUES) == pytest.approx(TABLE[text], rel=1e-15, abs=1e-15)


def test_over_a_sweep():
    x = np.linspace(0, 1, 5)
    assert np.array_equal(evaluate("max(x, 0.5)^2 - k", {"x": x, "k": 1.0}), np.maximum(x, 0.5) ** 2 - 1)


def test_outside_a_range_is_not_a_number():
    assert np.isnan(evaluate("acos(2)", {}))
    assert np.isnan(evaluate("sqrt(0 - 1)", {}))
    assert np.isinf(evaluate("1/0", {}))


@pytest.mark.parametrize(
    "text",
    [
        "",
        "1 +",
        "2 3",
        "a(1)",
        "sin",
        "sin()",
        "sin(x=1)",
        "a ** b",
        "[1]",
        "1 if a else b",
        "__import__('os')",
        "a;b",
        "1//2",
    ],
)
def test_refused(text):
    with pytest.raises(MechanismError):
        evaluate(text, VALUES)


def test_unknown_name():
    with pytest.raises(MechanismError, match='"a9"'):
        evaluate("a9 + 1", VALUES)


def test_names_in_order():
    assert names_in("atan2(b, a) + pi*a") == ("b", "a")

import tomllib

import numpy as np
import pytest
from reference_cases import CASES

from livesheet.formula.nodes import CellRef, Text
from livesheet.formula.parser import parse_description
from mechsheet.diagnostics import MechanismError
from mechsheet.reference.expressions import evaluate

TABLE = tomllib.loads((CASES / "expressions.toml").read_text(encoding="utf-8"))
VALUES = {"a": 2.0, "b": 0.5, "lambda": 3.0, "ı": 4.0, "C.x": 7.0}


def value(text, values=VALUES):
    return evaluate(parse_description(text), values)


@pytest.mark.parametrize("text", TABLE)
def test_value(text):
    assert value(text) == pytest.approx(TABLE[text], rel=1e-15, abs=1e-15)


def test_over_a_sweep():
    x = np.linspace(0, 1, 5)
    assert np.array_equal(value("max(x, 0.5)^2 - k", {"x": x, "k": 1.0}), np.maximum(x, 0.5) ** 2 - 1)


def test_outside_a_range_is_not_a_number():
    assert np.isnan(value("acos(2)"))
    assert np.isnan(value("sqrt(0 - 1)"))
    assert np.isinf(value("1/0"))


@pytest.mark.parametrize("node", [CellRef(0, 0), Text("a")])
def test_refused(node):
    with pytest.raises(MechanismError, match="no expression"):
        evaluate(node, VALUES)


def test_unknown_name():
    with pytest.raises(MechanismError, match='"a9"'):
        value("a9 + 1")

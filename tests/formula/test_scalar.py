"""Numbers of expression trees, and the exceptions where there is none."""

import math

import pytest

from livesheet.formula.nodes import Binary, Call, CellRef, Node, Number, Symbol, Unary
from livesheet.formula.scalar import evaluate

TWO = Number(2.0)
GOOD: list[tuple[Node, float]] = [
    (Unary("-", Binary("^", TWO, TWO)), -4.0),
    (Binary("^", Unary("-", TWO), TWO), 4.0),
    (Binary("^", TWO, Binary("^", Number(3.0), TWO)), 512.0),
    (Call("ATAN2", (Number(0.0), Number(1.0))), math.pi / 2),  # x first
    (Call("SUMSQ", (Number(3.0), Number(4.0))), 25.0),
    (Call("PI"), math.pi),
    (Call("MOD", (Number(-1.0), Number(360.0))), 359.0),
    (Call("IF", (Binary(">", Symbol("a"), TWO), Number(1.0), Call("ACOS", (Symbol("a"),)))), 1.0),
    (Call("SIGN", (Number(-7.0),)), -1.0),
    (Call("MAX", (Number(1.0), Symbol("a"))), 3.0),
    (Call("MAX", (Symbol("a"),)), 3.0),  # Python's own max asks for a list then
    (Call("MIN", (Symbol("a"),)), 3.0),
    (Unary("%", Number(50.0)), 0.5),
]
BAD: list[tuple[Node, str]] = [
    (Binary("/", TWO, Number(0.0)), "division by zero"),
    (Call("ACOS", (TWO,)), "arc cosine of 2"),
    (Call("SQRT", (Number(-1.0),)), "square root of -1"),
    (Call("LN", (Number(0.0),)), "logarithm of 0"),
    (Call("ATAN2", (Number(0.0), Number(0.0))), r"\(0, 0\)"),
    (Binary("^", Number(-8.0), Binary("/", Number(1.0), Number(3.0))), "not a real number"),
    (Binary("^", Number(1e200), TWO), "too large"),
    (Call("EXP", (Number(1e4),)), "too large"),
    (Binary("*", Number(1e200), Number(1e200)), "not a finite number"),
    (CellRef(0, 0), "CellRef has no numeric value"),
    (Call("VLOOKUP", (TWO,)), "VLOOKUP has no numeric value"),
    (Call("ATAN2", (TWO,)), "does not take 1 argument"),
    (Call("POWER", (TWO,)), "does not take 1 argument"),
    (Call("POWER", (TWO, TWO, TWO)), "does not take 3 arguments"),
]


@pytest.mark.parametrize(("node", "expected"), GOOD)
def test_value(node: Node, expected: float) -> None:
    assert evaluate(node, {"a": 3.0}) == pytest.approx(expected, abs=1e-15)


@pytest.mark.parametrize(("node", "message"), BAD)
def test_no_value(node: Node, message: str) -> None:
    with pytest.raises((ArithmeticError, ValueError), match=message):
        evaluate(node, {})


def test_unknown_symbol() -> None:
    with pytest.raises(KeyError, match="b"):
        evaluate(Symbol("b"), {"a": 1.0})

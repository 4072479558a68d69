"""Each rule of differentiation against differences, and how derivatives read."""

import numpy as np
import pytest

from livesheet.formula.derivatives import derivative
from livesheet.formula.nodes import Binary, Boolean, Call, Direction, Number, Symbol, Text, TriangleAngle, Unary
from livesheet.formula.parser import parse_description
from livesheet.formula.printer import print_formula
from mechsheet.kinematics.numeric import value

WEIGHTS = np.array([1 / 280, -4 / 105, 1 / 5, -4 / 5, 0, 4 / 5, -1 / 5, 4 / 105, -1 / 280])
STEP = 1e-3
AT = {"x": 0.37, "y": 0.81, "z": 1.3}
X, Y, Z = (Symbol(name) for name in AT)


def by_differences(node, name):
    known = AT | {name: AT[name] + STEP * np.arange(-4, 5)}
    return float(np.broadcast_to(value(node, known), (9,)) @ WEIGHTS) / STEP


FORMULAS = """
x + y*x - y/x
-x * +y
(x - y)/(x*y + z)
x^2
x^1
x^3 * y^(-2)
x^y
y^x
(x*y)^z
sin(x*y)
cos(2*x)
tan(x + y)
asin(x*y)
acos(x - y)
atan(x^2)
atan2(x*y, z - x)
sqrt(x + z)
abs(x - y)
abs(y - x)
exp(x*y)
ln(x + z^2)
radians(x^2)
degrees(x*y)
sign(x - y)
min(x, y)
max(x, y)
min(x*y, y, z)
max(x*y, x, y^2)
hypot(x, y - z)
sin(cos(x)) / sqrt(hypot(x, y) + ln(z))
""".strip().splitlines()


@pytest.mark.parametrize("text", FORMULAS)
def test_formulas(text):
    node = parse_description(text)
    for name in AT:
        assert value(derivative(node, name), AT) == pytest.approx(by_differences(node, name), rel=1e-9, abs=1e-10)


@pytest.mark.parametrize(
    "node",
    [
        Direction(Binary("*", X, Y), Binary("-", Z, X)),
        TriangleAngle(X, Y, Binary("*", Number(0.8), Z)),
        TriangleAngle(Z, X, Binary("+", X, Y)),
        Call("SUMSQ", (X, Binary("*", Y, X), Number(3.0))),
        Call("ROUND", (X, Number(2.0))),
        Call("MAX", (Binary("*", X, X),)),
        Call("IF", (Binary("<", X, Y), Binary("*", X, X), Y)),
        Call("IF", (Binary(">", X, Y), Binary("*", X, X), Binary("*", X, Z))),
        Unary("%", Binary("*", X, X)),
        Call("PI"),
    ],
    ids=str,
)
def test_nodes_without_a_spelling_in_descriptions(node):
    for name in AT:
        assert value(derivative(node, name), AT) == pytest.approx(by_differences(node, name), rel=1e-9, abs=1e-10)


def test_second_derivatives():
    node = parse_description("sin(x*y) * sqrt(x^2 + z) / ln(x + z)")
    once = derivative(node, "x")
    assert value(derivative(once, "x"), AT) == pytest.approx(by_differences(once, "x"), rel=1e-9)
    assert value(derivative(once, "z"), AT) == pytest.approx(by_differences(once, "z"), rel=1e-9)


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("a2*cos(theta)", "-(a2*sin(theta))"),
        ("theta", "1"),
        ("5*a + sin(b)", "0"),
        ("3*theta - a", "3"),
        ("theta^2", "2*theta"),
        ("theta^3", "3*theta^2"),
        ("theta^1", "1"),
        ("theta/a", "1/a"),
        ("a/theta", "-a/theta^2"),
        ("sqrt(theta)", "1/(2*sqrt(theta))"),
        ("sin(theta + a)", "cos(theta + a)"),
        ("max(theta, theta)", "1"),
    ],
)
def test_they_read_as_a_person_writes_them(text, shown):
    assert print_formula(derivative(parse_description(text), "theta"), "description").replace(" ", "") == shown.replace(
        " ", ""
    )


def test_what_has_none():
    assert derivative(Boolean(True), "x") == Number(0.0)
    for node in (Text("x"), Call("GAMMA", (X,)), Call("MAX", ()), Binary("<", X, Y)):
        with pytest.raises(ValueError, match="has no derivative"):
            derivative(node, "x")

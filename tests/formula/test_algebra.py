"""Formulas are put together without zeros and ones, and mean what the plain ones mean."""

import itertools
import math

import pytest

from livesheet.formula import algebra as al
from livesheet.formula.algebra import Angle
from livesheet.formula.nodes import Binary, Call, Number, Symbol, Unary
from livesheet.formula.printer import print_formula
from livesheet.formula.scalar import evaluate

A, B = Symbol("a"), Symbol("b")
KNOWN = {"a": 0.7, "b": -1.9}
OPERANDS = [
    *(al.number(value) for value in (0.0, 1.0, -1.0, 2.0, -2.5)),
    A, B, Unary("-", A), Unary("-", B), Binary("-", A, B), Binary("-", B, A), Binary("+", A, B), Binary("*", A, B),
]  # fmt: skip
PLAIN = {al.add: "+", al.sub: "-", al.mul: "*", al.div: "/"}


def shown(node):
    return print_formula(node, "text").replace(" ", "")


@pytest.mark.parametrize("function", PLAIN, ids=PLAIN.get)
def test_the_value_is_that_of_the_plain_formula(function):
    for left, right in itertools.product(OPERANDS, OPERANDS):
        if function is al.div and al.is_zero(right):
            continue
        plain = Binary(PLAIN[function], left, right)
        assert evaluate(function(left, right), KNOWN) == pytest.approx(evaluate(plain, KNOWN), rel=1e-15, abs=1e-15)
        assert al.tidied(plain) == function(left, right)


@pytest.mark.parametrize("node", OPERANDS, ids=shown)
def test_negation_and_square(node):
    assert evaluate(al.neg(node), KNOWN) == -evaluate(node, KNOWN)
    assert al.neg(al.neg(node)) == node
    assert al.tidied(Unary("-", node)) == al.neg(node)
    assert evaluate(al.square(node), KNOWN) == pytest.approx(evaluate(node, KNOWN) ** 2, rel=1e-15)
    assert evaluate(al.sqrt(al.square(node)), KNOWN) == pytest.approx(abs(evaluate(node, KNOWN)), rel=1e-15)


@pytest.mark.parametrize(
    ("node", "text"),
    [
        (al.add(al.ZERO, A), "a"),
        (al.add(A, al.ZERO), "a"),
        (al.add(A, Unary("-", B)), "a-b"),
        (al.add(Unary("-", A), B), "b-a"),
        (al.add(al.number(2), al.number(-5)), "-3"),
        (al.sub(A, al.ZERO), "a"),
        (al.sub(al.ZERO, A), "-a"),
        (al.sub(A, A), "0"),
        (al.sub(A, Unary("-", B)), "a+b"),
        (al.sub(al.number(2), al.number(5)), "-3"),
        (al.mul(al.ZERO, A), "0"),
        (al.mul(A, al.ZERO), "0"),
        (al.mul(al.ONE, A), "a"),
        (al.mul(A, al.ONE), "a"),
        (al.mul(al.number(-1), A), "-a"),
        (al.mul(A, al.number(-1)), "-a"),
        (al.mul(Unary("-", A), Unary("-", B)), "a*b"),
        (al.mul(A, Unary("-", B)), "-(a*b)"),
        (al.mul(al.number(-2), al.number(3)), "-6"),
        (al.div(al.ZERO, A), "0"),
        (al.div(A, al.ONE), "a"),
        (al.div(A, al.number(-1)), "-a"),
        (al.neg(al.ZERO), "0"),
        (al.neg(Binary("-", A, B)), "b-a"),
        (al.square(Unary("-", A)), "a^2"),
        (al.square(al.number(-3)), "9"),
        (al.sqrt(al.square(A)), "abs(a)"),
        (al.sqrt(Binary("^", A, Number(3.0))), "sqrt(a^3)"),
        (al.total([]), "0"),
        (al.total([A, al.ZERO, B]), "a+b"),
        (al.largest([A]), "a"),
        (al.smallest([A, B]), "min(a;b)"),
        (al.all_of([al.less(A, B), al.less(B, A)]), "and(a<b;b<a)"),
        (al.atan2(A, B), "atan2(a;b)"),
        (al.call("SIN", A), "sin(a)"),
        (al.cos(al.Angle(Unary("-", A))), "cos(a)"),
        (al.cos(al.Angle(Unary("+", A))), "cos(+a)"),
    ],
)
def test_it_reads_as_a_person_writes(node, text):
    assert shown(node) == text


@pytest.mark.parametrize(("value", "root"), [(4.0, 2.0), (0.0, 0.0), (-1e-17, 0.0)])
def test_a_root_of_what_rounding_has_made_negative_is_zero(value, root):
    assert evaluate(al.rooted(al.mul(al.number(3), Call("SQRT", (A,)))), {"a": value}) == 3 * root
    assert al.rooted(al.rooted(Call("SQRT", (A,)))) == al.rooted(Call("SQRT", (A,)))


def test_constants():
    assert al.number(-0.0) == Number(0.0)
    assert [al.value_of(node) for node in (al.number(-2), Number(3.0), A, Unary("-", A), Unary("+", al.ONE))] == [
        -2, 3, None, None, None,
    ]  # fmt: skip
    simple = [A, Unary("-", A), al.ONE, al.number(-2), al.PI, Unary("-", al.PI)]
    assert all(al.is_simple(node) for node in simple)
    assert not any(
        al.is_simple(node) for node in (al.add(A, B), Call("SIN", (A,)), Unary("-", al.add(A, B)), Unary("%", A))
    )


@pytest.mark.parametrize("count", [100, 101, 250, 300])
def test_more_arguments_than_a_function_takes_are_nested(count):
    nodes = [Symbol(f"a{n}") for n in range(count)]
    known = {f"a{n}": math.sin(n) for n in range(count)}
    for function, expected in ((al.largest, max), (al.smallest, min)):
        node = function(nodes)
        assert evaluate(node, known) == expected(known.values())
        assert len(node.args) == (count if count <= al.MOST_ARGUMENTS else -(-count // al.MOST_ARGUMENTS))


TURNS = [0, 30, 45, 90, 135, 180, 270, 360, 450, 540, -30, -90, -180, -270, -450]


@pytest.mark.parametrize("degrees", TURNS)
@pytest.mark.parametrize("node", [al.ZERO, A, Unary("-", A), al.add(A, B)], ids=shown)
def test_angles_with_right_angles_in_them(node, degrees):
    angle = Angle(node, degrees)
    expected = evaluate(node, KNOWN) + math.radians(degrees)
    assert evaluate(angle.expression(), KNOWN) == pytest.approx(expected, abs=1e-14)
    assert evaluate(al.cos(angle), KNOWN) == pytest.approx(math.cos(expected), abs=1e-14)
    assert evaluate(al.sin(angle), KNOWN) == pytest.approx(math.sin(expected), abs=1e-14)
    if degrees % 90 == 0:
        assert "pi" not in shown(al.cos(angle)) + shown(al.sin(angle))
        if angle.constant:  # free of rounding
            assert evaluate(al.cos(angle), {}) == round(math.cos(expected))
            assert evaluate(al.sin(angle), {}) == round(math.sin(expected))
    other = Angle(B, 60.0)
    assert evaluate((angle + other).expression(), KNOWN) == pytest.approx(expected + KNOWN["b"] + math.pi / 3)
    assert evaluate((angle - other).expression(), KNOWN) == pytest.approx(expected - KNOWN["b"] - math.pi / 3)
    assert evaluate((-angle).expression(), KNOWN) == pytest.approx(-expected, abs=1e-14)


@pytest.mark.parametrize(
    ("degrees", "text"),
    [
        (0, "a"),
        (180, "a+pi"),
        (-180, "a-pi"),
        (90, "a+pi/2"),
        (-270, "a-3*pi/2"),
        (360, "a+2*pi"),
        (30, "a+radians(30)"),
    ],
)
def test_angles_in_the_textbook_s_way(degrees, text):
    assert shown(Angle(A, degrees).expression()) == text


def test_a_round_number_of_degrees_is_known_again():
    for degrees in (0, 30, 41.25, 90, -120.5, 360):
        assert al.right_angle(math.radians(degrees)) == Angle(al.ZERO, degrees)
    assert al.right_angle(1.0) == Angle(Number(1.0))
    assert al.right_angle(-1.0) == Angle(al.number(-1.0))
    assert al.right_angle(math.radians(30) + 1e-12).degrees == 0

"""Building formulas that read as a person would write them: sums without zeros, products without ones, angles in turns.

These functions only tidy; they never change a value (x*0 becomes 0 because no quantity here can be infinite).
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from livesheet.formula.nodes import Binary, Call, Node, Number, Symbol, Unary, transform

MOST_ARGUMENTS = 100
"""Arguments of one call: well below the 255 that spreadsheets take, for formulas that can be read."""

ZERO, ONE, TWO = Number(0.0), Number(1.0), Number(2.0)
PI = Call("PI")


def number(value: float) -> Node:
    """A constant; a negative one as the unary minus of a positive one, as formulas are written."""
    return Unary("-", Number(-value)) if value < 0 else Number(value + 0.0)


def as_node(quantity: Node | float) -> Node:
    """A quantity of the model, a number or an expression, as a formula."""
    return number(quantity) if isinstance(quantity, float) else quantity


def value_of(node: Node) -> float | None:
    """The number a constant node stands for, or None."""
    if isinstance(node, Number):
        return node.value
    if isinstance(node, Unary) and node.op == "-" and isinstance(node.operand, Number):
        return -node.operand.value
    return None


def is_zero(node: Node) -> bool:
    """True for the constant 0."""
    return value_of(node) == 0


def neg(a: Node) -> Node:
    """-a."""
    if is_zero(a):
        return ZERO
    if isinstance(a, Unary) and a.op == "-":
        return a.operand
    if isinstance(a, Binary) and a.op == "-":
        return Binary("-", a.right, a.left)
    return Unary("-", a)


def add(a: Node, b: Node) -> Node:
    """a + b."""
    x, y = value_of(a), value_of(b)
    if x is not None and y is not None:
        return number(x + y)
    if x == 0:
        return b
    if y == 0:
        return a
    if isinstance(b, Unary) and b.op == "-":
        return Binary("-", a, b.operand)
    if isinstance(a, Unary) and a.op == "-":
        return Binary("-", b, a.operand)
    return Binary("+", a, b)


def sub(a: Node, b: Node) -> Node:
    """a - b."""
    x, y = value_of(a), value_of(b)
    if x is not None and y is not None:
        return number(x - y)
    if y == 0:
        return a
    if x == 0:
        return neg(b)
    if a == b:
        return ZERO
    if isinstance(b, Unary) and b.op == "-":
        return Binary("+", a, b.operand)
    return Binary("-", a, b)


def mul(a: Node, b: Node) -> Node:
    """a * b."""
    x, y = value_of(a), value_of(b)
    if x is not None and y is not None:
        return number(x * y)
    if 0 in (x, y):
        return ZERO
    if x == 1:
        return b
    if y == 1:
        return a
    if x == -1:
        return neg(b)
    if y == -1:
        return neg(a)
    if isinstance(a, Unary) and a.op == "-":
        return neg(mul(a.operand, b))
    if isinstance(b, Unary) and b.op == "-":
        return neg(mul(a, b.operand))
    return Binary("*", a, b)


def div(a: Node, b: Node) -> Node:
    """a / b."""
    if is_zero(a):
        return ZERO
    if value_of(b) == 1:
        return a
    if value_of(b) == -1:
        return neg(a)
    return Binary("/", a, b)


def tidied(node: Node) -> Node:
    """A sum, difference, product or quotient without the zeros and ones that make it longer; any other node as it is."""
    match node:
        case Binary("+", left, right):
            return add(left, right)
        case Binary("-", left, right):
            return sub(left, right)
        case Binary("*", left, right):
            return mul(left, right)
        case Binary("/", left, right):
            return div(left, right)
        case Unary("-", operand):
            return neg(operand)
    return node


def square(a: Node) -> Node:
    """a^2 (of -a the same)."""
    x = value_of(a)
    if x is not None:
        return number(x * x)
    if isinstance(a, Unary) and a.op == "-":
        a = a.operand
    return Binary("^", a, TWO)


def sqrt(a: Node) -> Node:
    """The square root; of a single square the absolute value."""
    if isinstance(a, Binary) and a.op == "^" and a.right == TWO:
        return Call("ABS", (a.left,))
    return Call("SQRT", (a,))


def call(name: str, *args: Node) -> Node:
    """A function of nodes."""
    return Call(name, args)


def largest(nodes: Sequence[Node]) -> Node:
    """MAX of any number of nodes: nested where there are more than a function takes (255 arguments)."""
    return _nested("MAX", nodes)


def smallest(nodes: Sequence[Node]) -> Node:
    """MIN of any number of nodes, as `largest`."""
    return _nested("MIN", nodes)


def all_of(conditions: Sequence[Node]) -> Node:
    """AND of any number of conditions, as `largest`."""
    return _nested("AND", conditions)


def total(nodes: Iterable[Node]) -> Node:
    """The sum of any number of nodes."""
    result: Node = ZERO
    for node in nodes:
        result = add(result, node)
    return result


def nested(function: str, nodes: Sequence[Node]) -> Node:
    """A function of any number of nodes that may be nested, as MAX and SUM may."""
    while len(nodes) > MOST_ARGUMENTS:
        chunks = range(0, len(nodes), MOST_ARGUMENTS)
        nodes = [Call(function, tuple(nodes[start : start + MOST_ARGUMENTS])) for start in chunks]
    return Call(function, tuple(nodes))


def _nested(function: str, nodes: Sequence[Node]) -> Node:
    return nodes[0] if len(nodes) == 1 else nested(function, nodes)


def atan2(x: Node, y: Node) -> Node:
    """The direction of (x, y), x FIRST as in every spreadsheet."""
    return Call("ATAN2", (x, y))


def less(a: Node, b: Node) -> Node:
    """a < b."""
    return Binary("<", a, b)


def any_of(conditions: Sequence[Node]) -> Node:
    """OR of any number of conditions, as `largest`."""
    return _nested("OR", conditions)


def rooted(value: Node) -> Node:
    """The value, where a root of less than 0 is 0: beside a condition that holds, that is rounding."""

    def change(part: Node) -> Node:
        match part:
            case Call("SQRT", (under,)) if not _never_below_zero(under):
                return Call("SQRT", (Call("MAX", (ZERO, under)),))
        return part

    return transform(value, change)


def _never_below_zero(node: Node) -> bool:
    """Whether it reads MAX(0, ...)."""
    return isinstance(node, Call) and node.name == "MAX" and ZERO in node.args


def triangle_area(a: Node, b: Node, c: Node) -> Node:
    """Heron's area: sqrt((a+b+c)(a+b-c)(c+a-b)(c-a+b)) / 4.

    Source of the form: W. Kahan, "Miscalculating area and angles of a needle-like triangle".
    """
    product = mul(mul(mul(add(add(a, b), c), sub(add(a, b), c)), sub(add(c, a), b)), add(sub(c, a), b))
    return div(Call("SQRT", (product,)), Number(4.0))


def cosine_side(opposite: Node, beside: Node, other: Node) -> Node:
    """beside^2 + other^2 - opposite^2: the cosine of a triangle's angle, times 2 beside other."""
    return sub(add(square(beside), square(other)), square(opposite))


def triangle_cosine(opposite: Node, beside: Node, other: Node) -> Node:
    """The cosine of the angle between two sides of a triangle, as every textbook has it."""
    return Binary("/", cosine_side(opposite, beside, other), Binary("*", Binary("*", TWO, beside), other))


def triangle_angle(opposite: Node, beside: Node, other: Node, area: Node) -> Node:
    """The angle of a triangle from its area: acos would lose half its digits at a dead centre, this loses none."""
    return atan2(cosine_side(opposite, beside, other), mul(Number(4.0), area))


@dataclass(frozen=True, slots=True)
class Angle:
    """An angle as a symbolic part and a number of degrees, so that right angles and full turns can be added up."""

    node: Node = ZERO
    degrees: float = 0.0

    def __add__(self, other: Angle) -> Angle:
        return Angle(add(self.node, other.node), self.degrees + other.degrees)

    def __sub__(self, other: Angle) -> Angle:
        return Angle(sub(self.node, other.node), self.degrees - other.degrees)

    def __neg__(self) -> Angle:
        return Angle(neg(self.node), -self.degrees)

    @property
    def constant(self) -> bool:
        """True when only a number of degrees is left."""
        return is_zero(self.node)

    def expression(self) -> Node:
        """The angle in radians as a formula: `phi + PI()`, `theta - RADIANS(30)`."""
        magnitude = abs(self.degrees)
        halves = magnitude / 180
        if magnitude == 0:
            part: Node = ZERO
        elif halves == 1:
            part = PI
        elif halves == int(halves):
            part = mul(Number(halves), PI)
        elif halves * 2 == int(halves * 2):
            part = div(mul(number(halves * 2), PI), TWO)
        else:
            part = Call("RADIANS", (Number(magnitude),))
        return add(self.node, part) if self.degrees >= 0 else sub(self.node, part)


def right_angle(value: float) -> Angle:
    """A number of radians as an Angle: in degrees when it is a readable number of them, else as it is.

    The rounding is at most 1e-9 of a degree away only if the writer meant the round number (30 degrees arrive here as
    0.5235987755982988).
    """
    degrees = math.degrees(value)
    if math.isclose(degrees, round(degrees, 6), rel_tol=4e-16, abs_tol=1e-14):
        return Angle(ZERO, round(degrees, 6))
    return Angle(number(value), 0.0)


def _exact(angle: Angle) -> tuple[float, float] | None:
    """Cosine and sine of a constant multiple of 90 degrees, free of rounding."""
    if not angle.constant or angle.degrees % 90:
        return None
    return {0: (1.0, 0.0), 90: (0.0, 1.0), 180: (-1.0, 0.0), 270: (0.0, -1.0)}[int(angle.degrees % 360)]


def _without_sign(node: Node) -> Node:
    return node.operand if isinstance(node, Unary) and node.op == "-" else node


def cos(angle: Angle) -> Node:
    """cos(angle), exact at right angles; added quarter turns are taken out: cos(a + 90 deg) = -sin(a)."""
    exact = _exact(angle)
    if exact:
        return number(exact[0])
    turn = angle.degrees % 360
    plain = Angle(angle.node)
    if turn == 0:
        return Call("COS", (_without_sign(angle.node),))
    if turn == 180:
        return neg(cos(plain))
    if turn == 90:
        return neg(sin(plain))
    if turn == 270:
        return sin(plain)
    return Call("COS", (angle.expression(),))


def sin(angle: Angle) -> Node:
    """sin(angle), exact at right angles; added quarter turns are taken out."""
    exact = _exact(angle)
    if exact:
        return number(exact[1])
    turn = angle.degrees % 360
    plain = Angle(angle.node)
    if turn == 0:
        bare = _without_sign(angle.node)
        return Call("SIN", (bare,)) if bare == angle.node else neg(Call("SIN", (bare,)))
    if turn == 180:
        return neg(sin(plain))
    if turn == 90:
        return cos(plain)
    if turn == 270:
        return neg(cos(plain))
    return Call("SIN", (angle.expression(),))


def is_simple(node: Node) -> bool:
    """True for what can stand in a formula again and again: a number, a symbol, or minus one of them."""
    if isinstance(node, Unary) and node.op == "-":
        node = node.operand
    return isinstance(node, Number | Symbol) or node == PI

"""Vectors in the plane as pairs of expressions."""

from __future__ import annotations

from collections.abc import Iterable
from functools import reduce
from typing import TypeAlias

from livesheet.formula import algebra as al
from livesheet.formula.nodes import Binary, Node, Unary

Vector: TypeAlias = tuple[Node, Node]

NOWHERE: Vector = (al.ZERO, al.ZERO)


def plus(a: Vector, b: Vector) -> Vector:
    """a + b."""
    return al.add(a[0], b[0]), al.add(a[1], b[1])


def minus(a: Vector, b: Vector) -> Vector:
    """a - b, without parentheses."""
    return less(a[0], b[0]), less(a[1], b[1])


def less(a: Node, b: Node) -> Node:
    """a - b, its parts added one by one: a - (b - c) is a - b + c."""
    match b:
        case Binary("+", left, right):
            return less(less(a, left), right)
        case Binary("-", left, right):
            return al.add(less(a, left), right)
    return al.sub(a, b)


def over(a: Node, b: Node) -> Node:
    """a / b, a sign in front of all of it."""
    if isinstance(a, Unary) and a.op == "-":
        return al.neg(over(a.operand, b))
    if isinstance(b, Unary) and b.op == "-":
        return al.neg(over(a, b.operand))
    return al.div(a, b)


def times(factor: Node, a: Vector) -> Vector:
    """factor a."""
    return al.mul(factor, a[0]), al.mul(factor, a[1])


def turned(a: Vector) -> Vector:
    """J a: a quarter turn counter-clockwise."""
    return al.neg(a[1]), a[0]


def cross(a: Vector, b: Vector) -> Node:
    """a x b."""
    return al.sub(al.mul(a[0], b[1]), al.mul(a[1], b[0]))


def negative(a: Vector) -> Vector:
    """-a."""
    return al.neg(a[0]), al.neg(a[1])


def dot(a: Vector, b: Vector) -> Node:
    """a . b."""
    return al.add(al.mul(a[0], b[0]), al.mul(a[1], b[1]))


def size(a: Vector) -> Node:
    """|a|."""
    return al.sqrt(al.add(al.square(a[0]), al.square(a[1])))


def together(vectors: Iterable[Vector]) -> Vector:
    """All vectors, one added to the other."""
    return reduce(plus, vectors, NOWHERE)

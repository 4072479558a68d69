"""Angles as people read them in formulas: sums of degrees are added as they are, `θ14 = φ − ψ` is `=F14-G14`."""

from __future__ import annotations

import math

from livesheet.formula.nodes import Binary, Call, Node, Number, Unary

HALF_TURN = 180.0


def in_degrees(node: Node) -> Node:
    """An angle given in radians, in degrees: each branch and each term for itself."""
    match node:
        case Call("NA", ()):
            return node
        case Call("IF", (test, one, other)):
            return Call("IF", (test, in_degrees(one), in_degrees(other)))
        case Call("IFERROR", (one, other)):
            return Call("IFERROR", (in_degrees(one), in_degrees(other)))
        case Call("RADIANS", (angle,)):
            return angle
        case Call("PI", ()):
            return Number(HALF_TURN)
        case Number(value):
            return Number(float(f"{math.degrees(value):.15g}"))
        case Unary(op, angle) if _reads_degrees(angle):
            return Unary(op, in_degrees(angle))
        case Binary("+" | "-" as sign, left, right) if _reads_degrees(left) or _reads_degrees(right):
            return Binary(sign, in_degrees(left), in_degrees(right))
        case Binary("*", left, right) if _reads_degrees(right):
            return _product(left, in_degrees(right))
        case Binary("*", left, right) if _reads_degrees(left):
            return _product(in_degrees(left), right)
        case Binary("/", left, Number(count)) if _reads_degrees(left):
            return _parted(in_degrees(left), count)
    return Call("DEGREES", (node,))


def degrees_together(node: Node) -> Node:
    """RADIANS(a) + RADIANS(b) as RADIANS(a + b)."""
    match node:
        case Binary("+" | "-" as sign, Call("RADIANS", (one,)), Call("RADIANS", (other,))):
            return Call("RADIANS", (Binary(sign, one, other),))
    return node


def _product(left: Node, right: Node) -> Node:
    """Of two numbers one: 3 * 180 is 540."""
    match left, right:
        case Number(one), Number(other):
            return Number(one * other)
    return Binary("*", left, right)


def _parted(angle: Node, count: float) -> Node:
    """A part of an angle; of a number of degrees it is a number."""
    match angle:
        case Number(value):
            return Number(value / count)
        case Binary("*", Number(value), factor):
            return Binary("*", Number(value / count), factor)
        case Binary("*", factor, Number(value)):
            return Binary("*", Number(value / count), factor)
    return Binary("/", angle, Number(count))


def _reads_degrees(node: Node) -> bool:
    match node:
        case Call("RADIANS", _) | Call("PI", ()):
            return True
        case Unary(_, angle):
            return _reads_degrees(angle)
        case Binary("+" | "-" | "*", left, right):
            return _reads_degrees(left) or _reads_degrees(right)
        case Binary("/", left, Number()):
            return _reads_degrees(left)
    return False

"""A four-bar on A0B0 = +x, as expressions over its lengths a1 to a4: what kinds of synthesis ask of it and draw."""

from __future__ import annotations

from mechsheet.synthesis.kind import Line


def output_angle(theta: str) -> str:
    """ψ where the input link stands at `theta` from A0B0: direction B0→A less or plus the angle of the triangle AB0B.

    theta  an expression in parentheses
    """
    squared = _diagonal_squared(theta)
    triangle = f"acos(({squared} + a4^2 - a3^2)/(2*a4*sqrt{squared}))"
    return f"atan2(a2*sin{theta}, a2*cos{theta} - a1) - mode*{triangle} - psi_offset"


def transmission_angle(theta: str) -> str:
    """Angle of coupler and output there, `theta` likewise."""
    return f"acos((a3^2 + a4^2 - {_diagonal_squared(theta)})/(2*a3*a4))"


def _diagonal_squared(theta: str) -> str:
    """Of A and B0."""
    return f"(a1^2 + a2^2 - 2*a1*a2*cos{theta})"


def position(key: str, n: int, theta: str, psi: str) -> Line:
    """The links at position `n`, by the angles of input and output."""
    vertices = (
        ("A0", "0", "0"),
        (f"A{n}", f"a2*cos({theta})", f"a2*sin({theta})"),
        (f"B{n}", f"a1 + a4*cos({psi})", f"a4*sin({psi})"),
        ("B0", "a1", "0"),
    )
    return Line(key, vertices, n - 1, number=n)


INPUT_TURNS = "min(a3 + a4 - a1 - a2, abs(a1 - a2) - abs(a3 - a4))"
"""Above 0 where the input link turns fully: A comes from one side of B0 to the other, and coupler and output reach it."""

RANGE_ROWS = 81


def part(first: str, last: str) -> str:
    """The input angle in row `n` of so many, from the first point to the last."""
    return f"{first} + ({last} - {first})*n/{RANGE_ROWS - 1}"

"""What a task asks for, and what the mechanism that comes out does: in closed form, from its lengths as they are used.

One row for each: what is wanted, what is got, and their difference. Over the names of results (as used), inputs and steps.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from mechsheet.model import Synthesis


@dataclass(frozen=True, slots=True)
class Requirement:
    """One row.

    key     of its words, with `parts`
    wanted  an expression;  got  another, of an angle but for whole turns
    kind    "angle", "length" or "number"
    """

    key: str
    wanted: str
    got: str
    kind: str
    parts: tuple[tuple[str, object], ...] = ()


def _of_function(task: Synthesis) -> list[Requirement]:
    found = []
    for n in range(1, int(task.chosen["points"]) + 1):
        found.append(
            Requirement("psi", f"psi_p{n}", output_angle(f"(theta_p{n} + theta_offset)"), "angle", (("number", n),))
        )
    return found


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


def _of_dead_centres(_: Synthesis) -> list[Requirement]:
    far, near = (f"acos((a1^2 + a4^2 - (a3 {sign} a2)^2)/(2*a1*a4))" for sign in "+-")
    first, second = (f"acos((a1^2 + (a3 {sign} a2)^2 - a4^2)/(2*a1*(a3 {sign} a2)))" for sign in "+-")
    return [
        Requirement("swing_given", "psi", f"abs({far} - {near})", "angle"),
        Requirement("turn", "phi", f"pi + mode*({second} - {first})", "angle"),
    ]


def _of_guidance(_: Synthesis) -> list[Requirement]:
    found = []
    for pivot, length in (("A", "a2"), ("B", "a4")):
        for n in (2, 3):
            way = f"hypot(x_{pivot}_{n} - x_{pivot}0, y_{pivot}_{n} - y_{pivot}0)"
            parts = (("start", f"{pivot}0"), ("end", pivot), ("number", n))
            found.append(Requirement("length_at_pose", length, way, "length", parts))
    return found


def _of_slider(_: Synthesis) -> list[Requirement]:
    far, near = "sqrt((a3 + a2)^2 - c^2)", "sqrt((a3 - a2)^2 - c^2)"
    return [
        Requirement("stroke", "stroke", f"{far} - {near}", "length"),
        Requirement("alpha", "alpha", "asin(c/(a3 - a2)) - asin(c/(a3 + a2))", "angle"),
    ]


def _of_lever(_: Synthesis) -> list[Requirement]:
    half = "asin(crank/centre)"
    return [
        Requirement("stroke", "stroke", "2*lever*crank/centre", "length"),
        Requirement("time_ratio", "time_ratio", f"(pi + 2*{half})/(pi - 2*{half})", "number"),
    ]


REQUIREMENTS: dict[str, Callable[[Synthesis], list[Requirement]]] = {
    "function": _of_function,
    "dead-centres": _of_dead_centres,
    "guidance": _of_guidance,
    "quick-return-slider": _of_slider,
    "quick-return-lever": _of_lever,
}


def requirements(task: Synthesis) -> list[Requirement]:
    """The rows of a task."""
    return REQUIREMENTS[task.kind](task)

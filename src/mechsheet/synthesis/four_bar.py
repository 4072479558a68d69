"""What kinds of synthesis share of what they ask and draw, as expressions over lengths and angles.

A four-bar has A0B0 = +x and the lengths a1 to a4. Where a task leaves the ratio λ = a3/a2 free, the sheet shows the least
transmission angle over it, of four-bars and of slider-cranks.
"""

from __future__ import annotations

from mechsheet.synthesis.kind import MU, Curve, Line


def output_angle(theta: str) -> str:
    """ψ where the input link stands at `theta` from A0B0: direction B0→A less or plus the angle of the triangle AB0B, which
    follows from the transmission angle there.

    theta  an expression in parentheses
    """
    return f"atan2(a2*sin{theta}, a2*cos{theta} - a1) - mode*atan2(a3*sin({MU}), a4 - a3*cos({MU})) - psi_offset"


def transmission_angle(theta: str) -> str:
    """Angle of coupler and output there, `theta` likewise."""
    return f"acos((a3^2 + a4^2 - (a1^2 + a2^2 - 2*a1*a2*cos{theta}))/(2*a3*a4))"


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


LAST_RATIO = "400"
"""A coupler of so many cranks is none that anybody builds: beyond it no best one is looked for."""

FIRST_RATIO = "1.0005"
"""Of the table over λ; the last is `LAST_RATIO`."""

RATIO_ROWS = 121


def curve_over_ratio(crank: str, rocker: str, least: str, cosine: str, together: str) -> Curve:
    """The least transmission angle over λ, in equal steps of its logarithm.

    crank, rocker  lengths in parts of a1, or of the stroke; of a slider-crank `rocker` is the eccentricity
    least, cosine  of the least transmission angle: what its cosine is found from, and the cosine
    together       above 0 where one assembly has both dead centres; else there is no angle
    """
    return Curve(
        RATIO_ROWS,
        {
            "lam": (f"exp(ln({FIRST_RATIO}) + ln({LAST_RATIO}/{FIRST_RATIO})*n/{RATIO_ROWS - 1})", "number"),
            "crank": (crank, "number"),
            "rocker": (rocker, "number"),
            "least": (least, "number"),
            "mu": (f"where({together}, acos({cosine}), acos(2))", "angle"),
        },
        "lam",
        "mu",
    )

"""The curve of the least transmission angle over λ = a3/a2: of the kinds whose task leaves that ratio free."""

from __future__ import annotations

from mechsheet.synthesis.kind import Curve

LONGEST = "400"
"""A coupler of so many cranks is none that anybody builds: beyond it no best one is looked for."""

FIRST = "1.0005"
"""Of the table over λ; the last is `LONGEST`."""

ROWS = 121


def curve_over_ratio(crank: str, rocker: str, least: str, cosine: str, together: str) -> Curve:
    """The least transmission angle over λ, in equal steps of its logarithm.

    crank, rocker  lengths in parts of a1, or of the stroke; of a slider-crank `rocker` is the eccentricity
    least, cosine  of the least transmission angle: what its cosine is found from, and the cosine
    together       above 0 where one assembly has both dead centres; else there is no angle
    """
    return Curve(
        ROWS,
        {
            "lam": (f"exp(ln({FIRST}) + ln({LONGEST}/{FIRST})*n/{ROWS - 1})", "number"),
            "crank": (crank, "number"),
            "rocker": (rocker, "number"),
            "least": (least, "number"),
            "mu": (f"where({together}, acos({cosine}), acos(2))", "angle"),
        },
        "lam",
        "mu",
    )

"""Quick-return mechanism with a slotted lever: stroke of the lever's end, time ratio and crank are given.

The crank turns 360/(1 + t) degrees on the quick way: at the dead centres it stands square to the lever, so half the swing is

    g = 90 - 180/(1 + t) degrees,   centre distance = crank/sin(g),   lever = stroke/(2 sin(g))

Of Whitworth's mechanism, whose crank goes round the lever's pivot: offset of the pivots = crank cos(180/(1 + t)).
Source: Khurmi & Gupta, Theory of Machines, sections 5.3 and 5.4.
"""

from __future__ import annotations

from mechsheet.model import Synthesis
from mechsheet.synthesis.kind import Kind, Line, Requirement
from mechsheet.synthesis.writing import Writer


def _write(w: Writer) -> None:
    """Inputs, steps and results."""
    length, angle = w.units.length, w.units.angle
    w.length("stroke")
    w.number("time_ratio")
    w.length("crank")
    w.also("crank")
    w.step("turn_back", "2*pi/(1 + time_ratio)", angle, "turn_back")
    w.step("half_swing", "pi/2 - turn_back/2", angle, "half_swing")
    w.also("half_swing")
    w.result("centre", "crank/sin(half_swing)", length, "centre", "half_swing - 1e-9")
    w.result("lever", "stroke/(2*sin(half_swing))", length, "lever", "half_swing - 1e-9")
    w.result("offset", "crank*cos(turn_back/2)", length, "whitworth_offset", "half_swing - 1e-9")
    w.result("swing", "2*half_swing", angle, "swing", "half_swing - 1e-9")


# --- what the sheet says and draws ---------------------------------------------------------------------------------

HALF = "asin(crank/centre)"
"""Half the swing."""


def _asked(_: Synthesis) -> list[Requirement]:
    return [
        Requirement("stroke", "stroke", "2*lever*crank/centre", "length"),
        Requirement("time_ratio", "time_ratio", f"(pi + 2*{HALF})/(pi - 2*{HALF})", "number"),
    ]


def _figure(_: Synthesis) -> list[Line]:
    """The lever at both dead centres, the crank square to it, and the way of the lever's end between them."""
    lines = []
    arm = "sqrt(centre^2 - crank^2)"
    for n, sign in ((1, ""), (2, "-")):
        pin = (f"A{n}", f"{sign}{arm}*sin({HALF})", f"{arm}*cos({HALF})")
        end = (f"B{n}", f"{sign}lever*sin({HALF})", f"lever*cos({HALF})")
        lines.append(Line("figure.dead", (("B0", "0", "0"), pin, end), n - 1, number=n))
        lines.append(Line("figure.crank", (("A0", "0", "centre"), pin), n - 1, "dash", False, n))
    on_way = [f"({HALF}*{n}/6)" for n in range(-6, 7)]
    vertices = tuple(("", f"lever*sin{at}", f"lever*cos{at}") for at in on_way)
    return [*lines, Line("figure.swing", vertices, 4, "dash", False)]


KIND = Kind(
    _write,
    _asked,
    _figure,
    ("meets", "sensitivity"),
    numbers=("time_ratio",),
    positive=("stroke", "time_ratio", "crank"),
    own=("crank",),
)

"""Quick-return mechanism with a slotted lever: stroke of the lever's end, time ratio and crank are given.

The crank turns 360/(1 + t) degrees on the quick way: at the dead centres it stands square to the lever, so half the swing is

    g = 90 - 180/(1 + t) degrees,   centre distance = crank/sin(g),   lever = stroke/(2 sin(g))

Of Whitworth's mechanism, whose crank goes round the lever's pivot: offset of the pivots = crank cos(180/(1 + t)).
Source: Khurmi & Gupta, Theory of Machines, sections 5.3 and 5.4.
"""

from __future__ import annotations

from mechsheet.synthesis.writing import Writer


def write(w: Writer) -> None:
    """Inputs, steps and results."""
    length, angle = w.units.length, w.units.angle
    w.length("stroke", positive=True)
    w.number("time_ratio", positive=True)
    w.length("crank", positive=True)
    w.also("crank")
    w.step("turn_back", "2*pi/(1 + time_ratio)", angle, "turn_back")
    w.step("half_swing", "pi/2 - turn_back/2", angle, "half_swing")
    w.also("half_swing")
    w.result("centre", "crank/sin(half_swing)", length, "centre", "half_swing - 1e-9")
    w.result("lever", "stroke/(2*sin(half_swing))", length, "lever", "half_swing - 1e-9")
    w.result("offset", "crank*cos(turn_back/2)", length, "whitworth_offset", "half_swing - 1e-9")
    w.result("swing", "2*half_swing", angle, "swing", "half_swing - 1e-9")

"""Quick-return mechanisms: with a slotted lever, and with an eccentric slider-crank. Stroke and time ratio are given.

The lever's crank is given, too. It turns 360/(1 + t) degrees on the quick way: at the dead centres it stands square to the
lever, so half the swing is

    g = 90 - 180/(1 + t) degrees,   centre distance = crank/sin(g),   lever = stroke/(2 sin(g))

Of Whitworth's mechanism, whose crank goes round the lever's pivot: offset of the pivots = crank cos(180/(1 + t)).
Source: Khurmi & Gupta, Theory of Machines, sections 5.3 and 5.4.

Crank and rod of the slider-crank are in line at its dead centres, alpha = 180 (t - 1)/(t + 1) degrees apart; with
lam = a3/a2

    a2 = stroke/sqrt(2 (lam^2 + 1) - 2 (lam^2 - 1) cos(alpha)),   a3 = lam a2,   c = (a3^2 - a2^2) sin(alpha)/stroke

With K = (stroke/a2)^2 = p lam^2 + q, p = 2 (1 - cos(alpha)), q = 2 (1 + cos(alpha)), the least transmission angle, whose
cosine is (a2 + c)/a3, is largest at the middle root of  K^3 = q/(4 p) ((4 + p) K - 4 q)^2.
The slider reaches both ends in one assembly for lam^2 p < q lam, that is lam < 1/tan(alpha/2)^2.
Source: Soeylemez, Mechanisms, section 7.2.
"""

from __future__ import annotations

from mechsheet.model import Synthesis
from mechsheet.synthesis.four_bar import curve_over_ratio
from mechsheet.synthesis.kind import BETWEEN_DEAD_CENTRES, Curve, Kind, Line, Requirement
from mechsheet.synthesis.writing import Writer, root

# --- a slotted lever -----------------------------------------------------------------------------------------------


def _write_lever(w: Writer) -> None:
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


HALF = "asin(crank/centre)"
"""Half the swing."""


def _asked_of_lever(_: Synthesis) -> list[Requirement]:
    return [
        Requirement("stroke", "stroke", "2*lever*crank/centre", "length"),
        Requirement("time_ratio", "time_ratio", f"(pi + 2*{HALF})/(pi - 2*{HALF})", "number"),
    ]


def _lever_figure(_: Synthesis) -> list[Line]:
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


LEVER = Kind(
    _write_lever,
    _asked_of_lever,
    _lever_figure,
    ("meets", "sensitivity"),
    numbers=("time_ratio",),
    positive=("stroke", "time_ratio", "crank"),
    own=("crank",),
)


# --- an eccentric slider-crank -------------------------------------------------------------------------------------

NOT_EQUAL = "abs(alpha) - 1e-9"
"""With a time ratio of 1 the slider-crank is central."""


def _write_slider(w: Writer) -> None:
    """Inputs, steps and results."""
    length, plain = w.units.length, w.units.number
    w.length("stroke")
    w.number("time_ratio")
    w.result("alpha", "pi*(time_ratio - 1)/(time_ratio + 1)", w.units.angle, "alpha")
    w.step("p", "2*(1 - cos(alpha))", plain, "less_cosine")
    w.step("q", "2*(1 + cos(alpha))", plain, "more_cosine")
    _slider_ratio(w)
    if w.task.has("a2"):
        w.also("a2")
    else:
        w.result("a2", "stroke/sqrt(p*lam^2 + q)", length, "crank", "lam - 1")
    w.result("a3", "lam*a2", length, "rod", "lam - 1")
    if w.task.has("c"):
        w.also("c")
    else:
        w.result("c", "(a3^2 - a2^2)*sin(alpha)/stroke", length, "eccentricity")
    w.step("together", "q - p*lam", plain, "slider_together")
    w.step("cos_mu", "(a2 + abs(c))/a3", plain, "cos_mu_slider")
    w.result("mu_min", "acos(cos_mu)", w.units.angle, "mu_min", "min(together, 1 - cos_mu)")


def _slider_ratio(w: Writer) -> None:
    """lam: given, from the crank's length, from the eccentricity, or the best."""
    plain = w.units.number
    if w.task.has("lam"):
        w.number("lam", words="lam")
        w.also("lam")
        return
    words = "lam_from_crank"
    if w.task.has("a2"):
        w.length("a2", words="crank")
        w.step("lam_squared", "((stroke/a2)^2 - q)/p", plain, "lam_squared", NOT_EQUAL)
    elif w.task.has("c"):
        w.length("c", words="eccentricity")
        over = "(stroke*sin(alpha) - c*p)"
        w.step("lam_squared", f"(c*q + stroke*sin(alpha))/{over}", plain, "lam_squared", f"abs({over}) - 1e-12*stroke")
    else:
        words = "best_lam"
        needs = f"min({NOT_EQUAL}, cos(alpha))"
        w.step("b_cubic", "-q/(4*p)*(4 + p)^2", plain, "cubic_b", needs)
        w.step("c_cubic", "2*q^2/p*(4 + p)", plain, "cubic_c", needs)
        w.step("d_cubic", "-4*q^3/p", plain, "cubic_d", needs)
        root(w, "K", middle=True)
        w.step("lam_squared", "(K - q)/p", plain, "lam_squared")
    w.result("lam", "sqrt(lam_squared)", plain, words, "lam_squared - 1")


FAR, NEAR = "sqrt((a3 + a2)^2 - c^2)", "sqrt((a3 - a2)^2 - c^2)"
"""The slider at its ends, along the guide."""


def _asked_of_slider(_: Synthesis) -> list[Requirement]:
    return [
        Requirement("stroke", "stroke", f"{FAR} - {NEAR}", "length"),
        Requirement("alpha", "alpha", "asin(c/(a3 - a2)) - asin(c/(a3 + a2))", "angle"),
    ]


def _slider_figure(_: Synthesis) -> list[Line]:
    lines = []
    for n, way, reach in ((1, FAR, "(a3 + a2)"), (2, NEAR, "(a2 - a3)")):
        crank = (f"A{n}", f"{way}*a2/{reach}", f"-c*a2/{reach}")
        lines.append(Line("figure.dead", (("A0", "0", "0"), crank, (f"B{n}", way, "-c")), n - 1, number=n))
    guide = (("", "0", "-c"), ("", f"{FAR} + a2", "-c"))
    return [*lines, Line("figure.guide", guide, 4, "dash", False)]


def _slider_curve(_: Synthesis) -> Curve:
    return curve_over_ratio(
        crank="1/sqrt(p*lam^2 + q)",
        rocker="(lam^2 - 1)*crank^2*abs(sin(alpha))",
        least="crank + rocker",
        cosine="least/(lam*crank)",
        together="q - p*lam",
    )


SLIDER = Kind(
    _write_slider,
    _asked_of_slider,
    _slider_figure,
    BETWEEN_DEAD_CENTRES,
    _slider_curve,
    numbers=("time_ratio", "lam"),
    positive=("stroke", "time_ratio", "lam", "a2"),
    turns="a3 - a2 - abs(c)",
)

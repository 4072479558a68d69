"""Quick return with an eccentric slider-crank: stroke and time ratio are given.

At the dead centres crank and rod are in line, alpha = 180 (t - 1)/(t + 1) degrees apart; with lam = a3/a2

    a2 = stroke/sqrt(2 (lam^2 + 1) - 2 (lam^2 - 1) cos(alpha)),   a3 = lam a2,   c = (a3^2 - a2^2) sin(alpha)/stroke

With K = (stroke/a2)^2 = p lam^2 + q, p = 2 (1 - cos(alpha)), q = 2 (1 + cos(alpha)), the least transmission angle, whose
cosine is (a2 + c)/a3, is largest at the middle root of  K^3 = q/(4 p) ((4 + p) K - 4 q)^2.
The slider reaches both ends in one assembly for lam^2 p < q lam, that is lam < 1/tan(alpha/2)^2.
Source: Soeylemez, Mechanisms, section 7.2.
"""

from __future__ import annotations

from mechsheet.model import Synthesis
from mechsheet.synthesis.cubic import root
from mechsheet.synthesis.kind import BETWEEN_DEAD_CENTRES, Curve, Kind, Line, Requirement
from mechsheet.synthesis.over_ratio import curve_over_ratio
from mechsheet.synthesis.writing import Writer

NOT_EQUAL = "abs(alpha) - 1e-9"
"""With a time ratio of 1 the slider-crank is central."""


def _write(w: Writer) -> None:
    """Inputs, steps and results."""
    length, plain = w.units.length, w.units.number
    w.length("stroke")
    w.number("time_ratio")
    w.result("alpha", "pi*(time_ratio - 1)/(time_ratio + 1)", w.units.angle, "alpha")
    w.step("p", "2*(1 - cos(alpha))", plain, "less_cosine")
    w.step("q", "2*(1 + cos(alpha))", plain, "more_cosine")
    _ratio(w)
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


def _ratio(w: Writer) -> None:
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
        root(w, "K", "b_cubic", "c_cubic", "d_cubic", middle=True)
        w.step("lam_squared", "(K - q)/p", plain, "lam_squared")
    w.result("lam", "sqrt(lam_squared)", plain, words, "lam_squared - 1")


# --- what the sheet says and draws ---------------------------------------------------------------------------------

FAR, NEAR = "sqrt((a3 + a2)^2 - c^2)", "sqrt((a3 - a2)^2 - c^2)"
"""The slider at its ends, along the guide."""


def _asked(_: Synthesis) -> list[Requirement]:
    return [
        Requirement("stroke", "stroke", f"{FAR} - {NEAR}", "length"),
        Requirement("alpha", "alpha", "asin(c/(a3 - a2)) - asin(c/(a3 + a2))", "angle"),
    ]


def _figure(_: Synthesis) -> list[Line]:
    lines = []
    for n, way, reach in ((1, FAR, "(a3 + a2)"), (2, NEAR, "(a2 - a3)")):
        crank = (f"A{n}", f"{way}*a2/{reach}", f"-c*a2/{reach}")
        lines.append(Line("figure.dead", (("A0", "0", "0"), crank, (f"B{n}", way, "-c")), n - 1, number=n))
    guide = (("", "0", "-c"), ("", f"{FAR} + a2", "-c"))
    return [*lines, Line("figure.guide", guide, 4, "dash", False)]


def _curve(_: Synthesis) -> Curve:
    return curve_over_ratio(
        crank="1/sqrt(p*lam^2 + q)",
        rocker="(lam^2 - 1)*crank^2*abs(sin(alpha))",
        least="crank + rocker",
        cosine="least/(lam*crank)",
        together="q - p*lam",
    )


KIND = Kind(
    _write,
    _asked,
    _figure,
    BETWEEN_DEAD_CENTRES,
    _curve,
    numbers=("time_ratio", "lam"),
    positive=("stroke", "time_ratio", "lam", "a2"),
    turns="a3 - a2 - abs(c)",
)

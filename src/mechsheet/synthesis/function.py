"""Function generation by a four-bar linkage: pairs of angles of its two pivoted links.

    k1 cos(psi) - k2 cos(theta) + k3 = cos(theta - psi)
    k1 = a1/a2,  k2 = a1/a4,  k3 = (a1^2 + a2^2 - a3^2 + a4^2)/(2 a2 a4)

with theta of the input and psi of the output, both from A0B0. Three pairs decide k1, k2, k3; more of them by least squares
of the same equation. A negative a2 or a4 is a link whose angle is counted from its other side.
Source: F. Freudenstein, Approximate synthesis of four-bar linkages, Trans. ASME 77 (1955).
"""

from __future__ import annotations

from livesheet.formula.nodes import Symbol, with_symbols
from livesheet.formula.parser import parse_description
from mechsheet.model import Synthesis
from mechsheet.synthesis.four_bar import INPUT_TURNS, RANGE_ROWS, output_angle, part, position, transmission_angle
from mechsheet.synthesis.kind import MU, THROUGH_POINTS, Columns, Curve, Kind, Line, Requirement
from mechsheet.synthesis.writing import DETERMINED, Writer
from mechsheet.words.equations import ENDS

DECIDING = 3
"""So many points decide the lengths; more are met by least squares, so nearly as it goes."""


def _write(w: Writer) -> None:
    """Inputs, steps and results."""
    w.length("a1")
    w.also("a1")
    count = w.task.points
    if w.task.function is None:
        for number in range(1, count + 1):
            w.angle(f"theta_p{number}", "theta", number - 1, number=number)
            w.angle(f"psi_p{number}", "psi", number - 1, number=number)
    else:
        _points_of_function(w, count)
    plain = w.units.number
    for n in range(1, count + 1):
        w.step(f"T{n}", f"cos(theta_p{n})", plain, "cos_theta", number=n)
        w.step(f"C{n}", f"cos(psi_p{n})", plain, "cos_psi", number=n)
        w.step(f"E{n}", f"cos(theta_p{n} - psi_p{n})", plain, "cos_difference", number=n)
    if count == DECIDING:
        _three(w)
    else:
        _least_squares(w, count)
    _links(w)
    _assembly(w, count)


def _points_of_function(w: Writer, count: int) -> None:
    """Chebyshev's spacing over the range of x; theta grows with x, psi with f(x), each in proportion."""
    plain = w.units.number
    for place, end in enumerate(("first", "last")):
        w.number(f"x_{end}", "x", place, words="x", end=ENDS[place])
        w.angle(f"theta_{end}", "theta", place, words="theta.end", end=ENDS[place])
        w.angle(f"psi_{end}", "psi", place, words="psi.end", end=ENDS[place])
    for place, end in enumerate(("first", "last")):
        _value_of_function(w, f"f_{end}", f"x_{end}", "f_at_end", end=ENDS[place])
    for n in range(1, count + 1):
        w.step(f"x_p{n}", f"(x_first + x_last)/2 - (x_last - x_first)/2*cos({2 * n - 1}*pi/{2 * count})", plain,
               "chebyshev", number=n)  # fmt: skip
        _value_of_function(w, f"f_p{n}", f"x_p{n}", "f_at", number=n)
        w.step(f"theta_p{n}", f"theta_first + (theta_last - theta_first)*(x_p{n} - x_first)/(x_last - x_first)",
               w.units.angle, "theta_scaled", "abs(x_last - x_first)", number=n)  # fmt: skip
        w.step(f"psi_p{n}", f"psi_first + (psi_last - psi_first)*(f_p{n} - f_first)/(f_last - f_first)",
               w.units.angle, "psi_scaled", "abs(f_last - f_first)", number=n)  # fmt: skip


def _value_of_function(w: Writer, name: str, x: str, words: str, **parts: object) -> None:
    assert w.task.function is not None
    w.node(name, with_symbols(w.task.function, {"x": Symbol(w.names[x])}), w.units.number, words, **parts)


def _three(w: Writer) -> None:
    """The first equation less each of the others, and Cramer's rule."""
    plain = w.units.number
    needs = f"abs(D) - {DETERMINED}"
    w.step("D", "(T1 - T2)*(C1 - C3) - (C1 - C2)*(T1 - T3)", plain, "determinant")
    w.step("k1", "((T1 - T2)*(E1 - E3) - (T1 - T3)*(E1 - E2))/D", plain, "k1", needs)
    w.step("k2", "((C1 - C2)*(E1 - E3) - (C1 - C3)*(E1 - E2))/D", plain, "k2", needs)
    w.step("k3", "E1 - k1*C1 + k2*T1", plain, "k3")


def _least_squares(w: Writer, count: int) -> None:
    """The normal equations, with the means taken out: then k3 follows from the means."""
    plain = w.units.number
    for letter, words in (("T", "mean_theta"), ("C", "mean_psi"), ("E", "mean_difference")):
        total = " + ".join(f"{letter}{n}" for n in range(1, count + 1))
        w.step(f"{letter}_m", f"({total})/{count}", plain, words)
    for one, other in ("CC", "TT", "CT", "CE", "TE"):
        products = (f"({one}{n} - {one}_m)*({other}{n} - {other}_m)" for n in range(1, count + 1))
        w.step(f"S_{one}{other}", " + ".join(products), plain, "sum_of_products", one=one, other=other)
    needs = f"abs(D) - {DETERMINED}"
    w.step("D", "S_CC*S_TT - S_CT^2", plain, "determinant")
    w.step("k1", "(S_CE*S_TT - S_TE*S_CT)/D", plain, "k1", needs)
    w.step("k2", "(S_CE*S_CT - S_TE*S_CC)/D", plain, "k2", needs)
    w.step("k3", "E_m - k1*C_m + k2*T_m", plain, "k3")


def _links(w: Writer) -> None:
    length, angle = w.units.length, w.units.angle
    w.step("a2_signed", "a1/k1", length, "a2_signed", f"abs(k1) - {DETERMINED}")
    w.step("a4_signed", "a1/k2", length, "a4_signed", f"abs(k2) - {DETERMINED}")
    w.step("a3_squared", "a1^2 + a2_signed^2 + a4_signed^2 - 2*a2_signed*a4_signed*k3", w.units.number, "a3_squared")
    w.result("a2", "abs(a2_signed)", length, "a2", "a3_squared")
    w.result("a3", "sqrt(a3_squared)", length, "a3", "a3_squared")
    w.result("a4", "abs(a4_signed)", length, "a4", "a3_squared")
    w.result("theta_offset", "where(a2_signed, 0, pi)", angle, "theta_offset", "a3_squared")
    w.result("psi_offset", "where(a4_signed, 0, pi)", angle, "psi_offset", "a3_squared")


def _assembly(w: Writer, count: int) -> None:
    """On which side of A0B0's diagonal A-B0 the pin B lies at each point: the assembly that most of the points have."""
    plain = w.units.number
    for n in range(1, count + 1):
        # (B0 - A) x (B - A), with A = a2 (cos theta, sin theta) and B - B0 = a4 (cos psi, sin psi)
        cross = f"a4_signed*(a1*sin(psi_p{n}) - a2_signed*sin(psi_p{n} - theta_p{n}))"
        w.step(f"side_p{n}", f"sign({cross})", plain, "side", "a3_squared", number=n)
        w.one_of_two(f"side_p{n}")
    total = " + ".join(f"side_p{n}" for n in range(1, count + 1))
    w.result("mode", f"where(0.5 + {total}, 1, -1)", plain, "mode")
    w.one_of_two("mode")


# --- what the sheet says and draws ---------------------------------------------------------------------------------


def _numbers(task: Synthesis) -> range:
    """Of the points."""
    return range(1, int(task.chosen["points"]) + 1)


def _asked(task: Synthesis) -> list[Requirement]:
    return [
        Requirement(
            "psi",
            f"psi_p{n}",
            output_angle(theta := f"(theta_p{n} + theta_offset)"),
            "angle",
            (("number", n),),
            f"theta_p{n}",
            transmission_angle(theta),
        )
        for n in _numbers(task)
    ]


def _figure(task: Synthesis) -> list[Line]:
    return [position("figure.point", n, f"theta_p{n} + theta_offset", f"psi_p{n} + psi_offset") for n in _numbers(task)]


def _curve(task: Synthesis) -> Curve:
    """The output over the range of the input: of a function beside what is wanted."""
    count = len(_numbers(task))
    ends = ("theta_p1", f"theta_p{count}") if task.function is None else ("theta_first", "theta_last")
    columns: Columns = {"theta": (part(*ends), "angle")}
    if task.function is not None:
        x = parse_description(part("x_first", "x_last"))
        risen = parse_description("psi_first + (psi_last - psi_first)*(f - f_first)/(f_last - f_first)")
        columns["wanted"] = (with_symbols(risen, {"f": with_symbols(task.function, {"x": x})}), "angle")
    columns[MU] = (transmission_angle("(theta + theta_offset)"), "angle")
    columns["raw"] = (output_angle("(theta + theta_offset)"), "angle")
    middle = f"psi_p{(count + 1) // 2}"
    columns["got"] = (f"{middle} + atan2(sin(raw - {middle}), cos(raw - {middle}))", "angle")
    return Curve(RANGE_ROWS, columns, "theta", "got", "wanted" if task.function is not None else "")


KIND = Kind(
    _write,
    _asked,
    _figure,
    THROUGH_POINTS,
    _curve,
    angles=("theta", "psi"),
    numbers=("x",),
    positive=("a1",),
    own=("a1",),
    pairs=True,
    turns=INPUT_TURNS,
    steps=lambda task: [f"theta_p{n + 1} - theta_p{n}" for n in _numbers(task)[:-1]],
    decided=lambda task: len(_numbers(task)) <= DECIDING,
)

"""A crank-rocker by its dead centres: the rocker swings by psi while the crank turns by phi, and back by 360 - phi.

With lam = a3/a2 all lengths follow, as a part of a1:

    D^2 = (1 - cos(phi - psi)) + (1 + cos(phi - psi)) lam^2
    a2 = sqrt(2) sin(psi/2)/D,   a3 = lam a2,   a4 = sqrt((1 - cos(phi)) + (1 + cos(phi)) lam^2)/D

The dead centres lie on one side of A0B0, so that one assembly has both, for lam < (1 + m)/(1 - m), m being the smaller of
u and 1/u, u = -cos(phi - psi/2)/cos(psi/2). The lam with the largest least transmission angle is t/sqrt(Q), Q > 0 of

    Q^3 + 2 Q^2 - t^2 Q - t^2 (1 + t^2)/u^2 = 0,   t = tan(phi/2), u = tan((phi - psi)/2)

The loop closure equations of the two dead centres, crank and coupler in line (the text's equations 9 and 10), are

    (a2 + a3) e^(i beta) - a4 e^(i psi_1) = a1,   (a2 - a3) e^(i (beta + phi)) - a4 e^(i (psi_1 + psi)) = a1

and with Z1 = a2 e^(i beta)/a1, Z2 = a4 e^(i psi_1)/a1 (equations 11 and 12)

    (1 + lam) Z1 - Z2 = 1,   (1 - lam) e^(i phi) Z1 - e^(i psi) Z2 = 1

of which the lengths above are the absolute values.
Sources: Soeylemez, Mechanisms, section 7.1, "The classical transmission angle problem"; F. Freudenstein and E. J. F.
Primrose, The classical transmission angle problem, IMechE conference on mechanisms (1972).
"""

from __future__ import annotations

from mechsheet.model import Synthesis
from mechsheet.synthesis.four_bar import INPUT_TURNS, LAST_RATIO, curve_over_ratio, position
from mechsheet.synthesis.kind import BETWEEN_DEAD_CENTRES, Curve, Kind, Line, Requirement
from mechsheet.synthesis.writing import Writer, root


def _write(w: Writer) -> None:
    """Inputs, steps and results."""
    w.length("a1")
    w.also("a1")
    w.angle("psi", words="swing_given")
    _turn(w)
    domain = "min(min(psi, pi - psi), min(phi - (pi + psi)/2, (3*pi + psi)/2 - phi))"
    w.step("domain", domain, w.units.angle, "domain")
    _ratio(w)
    _lengths(w)
    _positions(w)
    _transmission(w)


def _turn(w: Writer) -> None:
    """The crank's turn on the slow way, given or from the time ratio."""
    if w.task.has("phi"):
        w.angle("phi", words="turn")
        w.also("phi")
        w.result("time_ratio", "phi/(2*pi - phi)", w.units.number, "time_ratio", "2*pi - phi")
    else:
        w.number("time_ratio")
        w.also("time_ratio")
        w.result("phi", "pi + pi*(time_ratio - 1)/(time_ratio + 1)", w.units.angle, "turn")


def _ratio(w: Writer) -> None:
    """lam: given, from the crank's length, or the best."""
    plain = w.units.number
    w.step("A", "1 - cos(phi - psi)", plain, "less_cosine", "domain")
    w.step("B", "1 + cos(phi - psi)", plain, "more_cosine", "domain")
    if w.task.has("lam"):
        w.number("lam", words="lam")
        w.also("lam")
    elif w.task.has("a2"):
        w.length("a2", words="crank")
        w.step("lam_squared", "(2*(sin(psi/2)*a1/a2)^2 - A)/B", plain, "lam_squared")
        w.result("lam", "sqrt(lam_squared)", plain, "lam_from_crank", "lam_squared - 1")
    else:
        w.step("t_squared", "tan(phi/2)^2", plain, "t_squared", "abs(cos(phi/2)) - 1e-9")
        w.step("u_squared", "tan((phi - psi)/2)^2", plain, "u_squared", "domain")
        w.step("b_cubic", "2 + 0*t_squared", plain, "cubic_b")
        w.step("c_cubic", "-t_squared", plain, "cubic_c")
        w.step("d_cubic", "-t_squared*(1 + t_squared)/u_squared", plain, "cubic_d")
        root(w, "Q")
        w.step("lam_squared", "t_squared/Q", plain, "lam_squared", "Q")
        w.result("lam", "sqrt(lam_squared)", plain, "best_lam", f"min(lam_squared - 1, {LAST_RATIO}^2 - lam_squared)")


def _lengths(w: Writer) -> None:
    """The absolute values of Z1 and Z2."""
    length = w.units.length
    w.step("D", "sqrt(A + B*lam^2)", w.units.number, "D", "lam - 1")
    if w.task.has("a2"):
        w.also("a2")
    else:
        w.result("a2", "a1*sqrt(2)*sin(psi/2)/D", length, "crank")
    w.result("a3", "lam*a2", length, "coupler", "D")
    w.result("a4", "a1*sqrt((1 - cos(phi)) + (1 + cos(phi))*lam^2)/D", length, "rocker")


def _positions(w: Writer) -> None:
    """Where B is at the first dead centre, seen from B0 in parts of a1: R, the text's Z2, from its equations 11 and 12."""
    plain, angle = w.units.number, w.units.angle
    w.step("kappa", "(1 - lam)/(1 + lam)", plain, "kappa", "D")
    w.step("num_x", "1 - kappa*cos(phi)", plain, "numerator")
    w.step("num_y", "-kappa*sin(phi)", plain, "numerator")
    w.step("den_x", "kappa*cos(phi) - cos(psi)", plain, "denominator")
    w.step("den_y", "kappa*sin(phi) - sin(psi)", plain, "denominator")
    w.step("R_x", "(num_x*den_x + num_y*den_y)/(den_x^2 + den_y^2)", plain, "rocker_part")
    w.step("R_y", "(num_y*den_x - num_x*den_y)/(den_x^2 + den_y^2)", plain, "rocker_part")
    w.result("theta_1", "atan2(R_y, 1 + R_x)", angle, "theta_1")
    w.result("psi_1", "atan2(R_y, R_x)", angle, "psi_1")
    w.step("together", "R_y*(R_x*sin(psi) + R_y*cos(psi))", plain, "together")
    w.result("mode", "where(R_y, 1, -1)", plain, "mode_dead")
    w.one_of_two("mode")


def _transmission(w: Writer) -> None:
    """The least transmission angle of a turn: crank and ground in line."""
    plain = w.units.number
    w.step("cos_1", "(a3^2 + a4^2 - (a1 - a2)^2)/(2*a3*a4)", plain, "cos_mu_near")
    w.step("cos_2", "(a3^2 + a4^2 - (a1 + a2)^2)/(2*a3*a4)", plain, "cos_mu_far")
    w.step("cos_mu", "max(abs(cos_1), abs(cos_2))", plain, "cos_mu")
    w.result("mu_min", "acos(cos_mu)", w.units.angle, "mu_min", "min(together, 1 - cos_mu)")


# --- what the sheet says and draws ---------------------------------------------------------------------------------


def _asked(_: Synthesis) -> list[Requirement]:
    far, near = (f"acos((a1^2 + a4^2 - (a3 {sign} a2)^2)/(2*a1*a4))" for sign in "+-")
    first, second = (f"acos((a1^2 + (a3 {sign} a2)^2 - a4^2)/(2*a1*(a3 {sign} a2)))" for sign in "+-")
    return [
        Requirement("swing_given", "psi", f"abs({far} - {near})", "angle"),
        Requirement("turn", "phi", f"pi + mode*({second} - {first})", "angle"),
    ]


def _figure(_: Synthesis) -> list[Line]:
    """Both dead centres, and the way of B between them."""
    first = position("figure.dead", 1, "theta_1", "psi_1")
    second = position("figure.dead", 2, "theta_1 + phi", "psi_1 + psi")
    on_way = [f"(psi_1 + psi*{n}/12)" for n in range(13)]
    vertices = tuple(("", f"a1 + a4*cos{at}", f"0 + a4*sin{at}") for at in on_way)
    return [first, second, Line("figure.swing", vertices, 4, "dash", False)]


def _curve(_: Synthesis) -> Curve:
    u = "(-cos(phi - psi/2)/cos(psi/2))"
    near, far = (f"abs((lam*crank)^2 + rocker^2 - (1 {sign} crank)^2)" for sign in "-+")
    return curve_over_ratio(
        crank="sqrt(1 - cos(psi))/sqrt(A + B*lam^2)",
        rocker="sqrt((1 - cos(phi)) + (1 + cos(phi))*lam^2)/sqrt(A + B*lam^2)",
        least=f"max({near}, {far})",
        cosine="least/(2*lam*crank*rocker)",
        together=f"1 + min({u}, 1/{u}) - lam*(1 - min({u}, 1/{u}))",
    )


KIND = Kind(
    _write,
    _asked,
    _figure,
    BETWEEN_DEAD_CENTRES,
    _curve,
    angles=("psi", "phi"),
    numbers=("time_ratio", "lam"),
    positive=("a1", "a2", "time_ratio", "lam"),
    own=("a1",),
    turns=INPUT_TURNS,
    alt=True,
)

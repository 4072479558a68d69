"""Guidance of a body through three poses by a four-bar linkage: its coupler is the body.

Each of the two cranks holds a point of the body at a constant distance from a fixed pivot. Of each one thing is given:

    moving   a point of the body: the fixed pivot is the centre of the circle through its three places
    fixed    the fixed pivot: seen from the body it lies on a circle about the point of the body (inversion)
    turns    by how much the crank turns: W (e^(i beta_j) - 1) + Z (e^(i alpha_j) - 1) = P_j - P_1, j = 2, 3

Source: R. L. Norton, Design of Machinery, sections 5.3 to 5.8.
"""

from __future__ import annotations

from mechsheet.model import Synthesis
from mechsheet.synthesis.four_bar import INPUT_TURNS, RANGE_ROWS, part, transmission_angle
from mechsheet.synthesis.kind import THROUGH_POINTS, Curve, Kind, Line, Requirement
from mechsheet.synthesis.writing import DETERMINED, Writer

PIVOTS = ("A", "B")

ENDS = ("", "_2", "_3")
"""Of the names of a pin's coordinates at the three poses."""


def _write(w: Writer) -> None:
    """Inputs, steps and results."""
    for n in (1, 2, 3):
        w.length(f"x_p{n}", "poses", n - 1, 0, words="pose_x", number=n)
        w.length(f"y_p{n}", "poses", n - 1, 1, words="pose_y", number=n)
        w.angle(f"alpha_p{n}", "poses", n - 1, 2, words="pose_angle", number=n)
    for n in (2, 3):
        w.step(f"delta_{n}", f"alpha_p{n} - alpha_p1", w.units.angle, "turn_of_body", number=n)
    for pivot in PIVOTS:
        if w.task.has(pivot, "moving", 0):
            _by_moving(w, pivot)
        elif w.task.has(pivot, "fixed", 0):
            _by_fixed(w, pivot)
        else:
            _by_turns(w, pivot)
    _links(w)
    for pivot in PIVOTS:
        _turns(w, pivot)
    _assembly(w)


def _by_moving(w: Writer, s: str) -> None:
    """The fixed pivot of a point of the body."""
    for place, axis in enumerate("xy"):
        w.length(f"{axis}_{s}", s, "moving", place, words="moving", axis=axis, point=s)
        w.also(f"{axis}_{s}")
    _places(w, s)
    _centre(w, s, f"{s}0", [f"{s}", f"{s}_2", f"{s}_3"], "fixed_pivot")


def _places(w: Writer, s: str) -> None:
    """Where the point of the body is at the second and the third pose."""
    length = w.units.length
    for n in (2, 3):
        dx, dy = f"(x_{s} - x_p1)", f"(y_{s} - y_p1)"
        c, sine = f"cos(delta_{n})", f"sin(delta_{n})"
        w.step(f"x_{s}_{n}", f"x_p{n} + {dx}*{c} - {dy}*{sine}", length, "place", point=s, number=n, axis="x")
        w.step(f"y_{s}_{n}", f"y_p{n} + {dx}*{sine} + {dy}*{c}", length, "place", point=s, number=n, axis="y")


def _by_fixed(w: Writer, s: str) -> None:
    """The point of the body of a fixed pivot."""
    fixed, length = f"{s}0", w.units.length
    for place, axis in enumerate("xy"):
        w.length(f"{axis}_{fixed}", s, "fixed", place, words="fixed", axis=axis, point=fixed)
        w.also(f"{axis}_{fixed}")
    for n in (2, 3):
        dx, dy = f"(x_{fixed} - x_p{n})", f"(y_{fixed} - y_p{n})"
        c, sine = f"cos(delta_{n})", f"sin(delta_{n})"
        # turned back by delta
        w.step(f"x_{fixed}_{n}", f"x_p1 + {dx}*{c} + {dy}*{sine}", length, "seen", point=fixed, number=n, axis="x")
        w.step(f"y_{fixed}_{n}", f"y_p1 - {dx}*{sine} + {dy}*{c}", length, "seen", point=fixed, number=n, axis="y")
    _centre(w, s, s, [fixed, f"{fixed}_2", f"{fixed}_3"], "moving_pivot")
    _places(w, s)


def _centre(w: Writer, s: str, centre: str, points: list[str], words: str) -> None:
    """The centre of the circle through three points."""
    length, plain = w.units.length, w.units.number
    first = points[0]
    for n, point in zip((2, 3), points[1:], strict=True):
        w.step(f"u_{s}{n}", f"x_{point} - x_{first}", length, "chord", point=s, number=n, axis="x")
        w.step(f"v_{s}{n}", f"y_{point} - y_{first}", length, "chord", point=s, number=n, axis="y")
        w.step(f"h_{s}{n}", f"(u_{s}{n}^2 + v_{s}{n}^2)/2", plain, "half_square", point=s, number=n)
    w.step(f"det_{s}", f"u_{s}2*v_{s}3 - v_{s}2*u_{s}3", plain, "circle_determinant", point=s)
    needs = f"abs(det_{s}) - {DETERMINED}*max(h_{s}2, h_{s}3)"
    x = f"x_{first} + (h_{s}2*v_{s}3 - h_{s}3*v_{s}2)/det_{s}"
    y = f"y_{first} + (u_{s}2*h_{s}3 - u_{s}3*h_{s}2)/det_{s}"
    for axis, text in (("x", x), ("y", y)):
        w.result(f"{axis}_{centre}", text, length, words, needs, point=centre, axis=axis)


def _by_turns(w: Writer, s: str) -> None:
    """Both pivots from the turns of the crank: two complex linear equations, by Cramer's rule."""
    length, plain = w.units.length, w.units.number
    for place, n in enumerate((2, 3)):
        w.angle(f"beta_{s}{n}", s, "turns", place, words="beta", point=s, number=n)
    for n in (2, 3):
        for letter, angle, key in (("E", f"beta_{s}{n}", "turn_vector"), ("F", f"delta_{n}", "body_vector")):
            w.step(f"{letter}x_{s}{n}", f"cos({angle}) - 1", plain, key, number=n, axis="x")
            w.step(f"{letter}y_{s}{n}", f"sin({angle})", plain, key, number=n, axis="y")
    # det = E2 F3 - E3 F2, in the complex plane
    vector = {f"{key}{n}": (f"{key}x_{s}{n}", f"{key}y_{s}{n}") for key in "EF" for n in (2, 3)}
    way = {n: (f"(x_p{n} - x_p1)", f"(y_p{n} - y_p1)") for n in (2, 3)}
    for axis in "xy":
        text = f"{_product(vector['E2'], vector['F3'], axis)} - {_product(vector['E3'], vector['F2'], axis)}"
        w.step(f"det{axis}_{s}", text, plain, "turns_det", axis=axis)
    w.step(f"det_{s}", f"detx_{s}^2 + dety_{s}^2", plain, "turns_square", point=s)
    # W = (d2 F3 - d3 F2)/det,  Z = (E2 d3 - E3 d2)/det
    for letter, other, sign, key in (("W", "F", 1, "arm"), ("Z", "E", -1, "rest")):
        for axis in "xy":
            two = _product(way[2], vector[f"{other}3"], axis)
            three = _product(way[3], vector[f"{other}2"], axis)
            text = f"{two} - {three}" if sign > 0 else f"{three} - {two}"
            w.step(f"N{letter}{axis}_{s}", text, length, "turns_numerator", vector=letter, axis=axis)
        x, y, needs = f"N{letter}x_{s}", f"N{letter}y_{s}", f"det_{s} - 1e-24"
        w.step(f"{letter}x_{s}", f"({x}*detx_{s} + {y}*dety_{s})/det_{s}", length, key, needs, axis="x", point=s)
        w.step(f"{letter}y_{s}", f"({y}*detx_{s} - {x}*dety_{s})/det_{s}", length, key, needs, axis="y", point=s)
    for axis in "xy":
        w.result(f"{axis}_{s}", f"{axis}_p1 - Z{axis}_{s}", length, "moving_pivot", point=s, axis=axis)
        w.result(f"{axis}_{s}0", f"{axis}_{s} - W{axis}_{s}", length, "fixed_pivot", point=f"{s}0", axis=axis)
    _places(w, s)


def _product(one: tuple[str, str], other: tuple[str, str], axis: str) -> str:
    """A part of the complex product of two vectors; in parentheses."""
    (a, b), (c, d) = one, other
    return f"({a}*{c} - {b}*{d})" if axis == "x" else f"({a}*{d} + {b}*{c})"


def _links(w: Writer) -> None:
    """Lengths, the body in the coupler's frame, the angles of crank and ground at the first pose."""
    length, angle = w.units.length, w.units.angle
    for name, start, end in (("a1", "A0", "B0"), ("a2", "A0", "A"), ("a3", "A", "B"), ("a4", "B0", "B")):
        w.result(name, f"hypot(x_{end} - x_{start}, y_{end} - y_{start})", length, "length_of", start=start, end=end)
    for name, start, end, key in (("theta_1", "A0", "A", "crank_angle"), ("gamma_1", "A", "B", "coupler_angle")):
        w.result(name, f"atan2(y_{end} - y_{start}, x_{end} - x_{start})", angle, key)
    dx, dy = "(x_p1 - x_A)", "(y_p1 - y_A)"
    w.result("u_P", f"{dx}*cos(gamma_1) + {dy}*sin(gamma_1)", length, "body_in_coupler", axis="x")
    w.result("v_P", f"{dy}*cos(gamma_1) - {dx}*sin(gamma_1)", length, "body_in_coupler", axis="y")


def _turns(w: Writer, s: str) -> None:
    """By how much the crank turns from the first pose, within half a turn either way."""
    if w.task.has(s, "turns", 0):
        for n in (2, 3):
            w.also(f"beta_{s}{n}")
        return
    for n in (2, 3):
        ax, ay = f"(x_{s} - x_{s}0)", f"(y_{s} - y_{s}0)"
        bx, by = f"(x_{s}_{n} - x_{s}0)", f"(y_{s}_{n} - y_{s}0)"
        w.result(f"beta_{s}{n}", f"atan2({ax}*{by} - {ay}*{bx}, {ax}*{bx} + {ay}*{by})", w.units.angle, "beta",
                 point=s, number=n)  # fmt: skip


def _assembly(w: Writer) -> None:
    """On which side of the diagonal A-B0 the pin B lies at each pose."""
    plain = w.units.number
    for n, end in enumerate(ENDS, 1):
        ax, ay, bx, by = f"x_A{end}", f"y_A{end}", f"x_B{end}", f"y_B{end}"
        side = f"sign((x_B0 - {ax})*({by} - {ay}) - (y_B0 - {ay})*({bx} - {ax}))"
        w.step(f"side_p{n}", side, plain, "side_pose", number=n)
        w.one_of_two(f"side_p{n}")
    w.result("mode", "where(0.5 + side_p1 + side_p2 + side_p3, 1, -1)", plain, "mode_poses")
    w.one_of_two("mode")


# --- what the sheet says and draws ---------------------------------------------------------------------------------


def _asked(_: Synthesis) -> list[Requirement]:
    found = []
    for pivot, length in (("A", "a2"), ("B", "a4")):
        for n in (2, 3):
            way = f"hypot(x_{pivot}_{n} - x_{pivot}0, y_{pivot}_{n} - y_{pivot}0)"
            parts = (("start", f"{pivot}0"), ("end", pivot), ("number", n))
            found.append(Requirement("length_at_pose", length, way, "length", parts))
    return found


def _figure(_: Synthesis) -> list[Line]:
    """The four-bar at each pose, and the body as a triangle on its coupler."""
    lines = []
    for n, end in enumerate(ENDS, 1):
        a, b = (f"x_A{end}", f"y_A{end}"), (f"x_B{end}", f"y_B{end}")
        links = (("A0", "x_A0", "y_A0"), (f"A{n}", *a), (f"B{n}", *b), ("B0", "x_B0", "y_B0"))
        lines.append(Line("figure.pose", links, n - 1, number=n))
        body = ((f"P{n}", f"x_p{n}", f"y_p{n}"), ("", *a), ("", *b), ("", f"x_p{n}", f"y_p{n}"))
        lines.append(Line("figure.body", body, n - 1, "dot", False, n))
    return lines


def _curve(_: Synthesis) -> Curve:
    toward = "atan2(y_B0 - y_A0, x_B0 - x_A0)"
    theta = part("theta_1", "(theta_1 + beta_A3)")
    mu = transmission_angle(f"(theta - {toward})")
    return Curve(RANGE_ROWS, {"theta": (theta, "angle"), "mu": (mu, "angle")}, "theta", "mu")


def _least_angle() -> str:
    """Of A→B and B0→B at the poses: their cross product's share of the two lengths'."""
    across = [f"abs((x_B{n} - x_A{n})*(y_B{n} - y_B0) - (y_B{n} - y_A{n})*(x_B{n} - x_B0))" for n in ENDS]
    return f"asin(min(1, min({', '.join(across)})/(a3*a4)))"


KIND = Kind(
    _write,
    _asked,
    _figure,
    THROUGH_POINTS,
    _curve,
    angles=("turns", "poses.3"),
    turns=INPUT_TURNS,
    steps=lambda _: ["beta_A2", "beta_A3 - beta_A2"],
    beside=_least_angle(),
)

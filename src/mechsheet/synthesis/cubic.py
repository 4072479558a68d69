"""The roots of a cubic as steps: Cardano's formula, then one step of Newton's method for the last digits."""

from __future__ import annotations

from mechsheet.synthesis.writing import Writer


def root(w: Writer, name: str, b: str, c: str, d: str, middle: bool = False) -> None:
    """Steps for a real root of  x^3 + b x^2 + c x + d = 0, whose last is `name`; b, c, d are names of steps.

    The largest where there are three; `middle`: the one between the others, where there are three.
    """
    plain = w.units.number
    w.step("p_cubic", f"{c} - {b}^2/3", plain, "depressed")
    w.step("q_cubic", f"2*{b}^3/27 - {b}*{c}/3 + {d}", plain, "depressed")
    w.step("disc", "(q_cubic/2)^2 + (p_cubic/3)^3", plain, "discriminant")
    turn = " - 2*pi/3" if middle else ""
    cosine = "max(-1, min(1, 3*q_cubic/(2*p_cubic)*sqrt(-3/p_cubic)))"
    three = f"2*sqrt(-p_cubic/3)*cos(acos({cosine})/3{turn})"
    if middle:
        w.step("y_cubic", three, plain, "depressed_root", "-disc")
    else:
        w.step("w_cubic", "where(disc, -sign(q_cubic)*(abs(q_cubic)/2 + sqrt(disc))^(1/3), 0)", plain, "cardano")
        w.step("y_cubic", f"where(disc, w_cubic - p_cubic/(3*w_cubic), {three})", plain, "depressed_root")
    w.step("x_cubic", f"y_cubic - {b}/3", plain, "cubic_root")
    value, slope = f"(((x_cubic + {b})*x_cubic + {c})*x_cubic + {d})", f"((3*x_cubic + 2*{b})*x_cubic + {c})"
    w.step(name, f"x_cubic - {value}/{slope}", plain, "cubic_newton")
    w.roots[w.names[name]] = (w.names[b], w.names[c], w.names[d])

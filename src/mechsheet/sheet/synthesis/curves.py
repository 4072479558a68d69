"""The table of a curve over a range: of a function generator its output, of the others how well they transmit."""

from __future__ import annotations

from dataclasses import dataclass

from mechsheet.formula.nodes import Node, with_symbols
from mechsheet.formula.parser import parse_description
from mechsheet.model import Synthesis
from mechsheet.sheet.synthesis.requirements import output_angle, transmission_angle
from mechsheet.synthesis.dead_centres import LONGEST

Columns = dict[str, tuple[str | Node, str]]

RANGE_ROWS, RATIO_ROWS = 81, 121

FIRST_RATIO = "1.0005"
"""Of the table over λ; the last is `LONGEST`."""


@dataclass(frozen=True, slots=True)
class Curve:
    """A table of so many rows. Expressions are over names of results and steps, `n` (the row, from 0) and keys of columns.

    columns  key -> (expression, "angle" or "number"), from left to right; what cannot be is #N/A
    x, y     keys of the chart's axes;  wanted  key of the curve that is wanted, where there is one
    """

    rows: int
    columns: Columns
    x: str
    y: str
    wanted: str = ""


def curve_of(task: Synthesis) -> Curve | None:
    """The table of a task; None where there is nothing to draw over a range."""
    match task.kind:
        case "function":
            return _of_function(task)
        case "guidance":
            return _of_guidance()
        case "dead-centres":
            return _of_crank_rocker()
        case "quick-return-slider":
            return _of_slider()
    return None


def _part(first: str, last: str, count: int) -> str:
    return f"{first} + ({last} - {first})*n/{count - 1}"


def _of_function(task: Synthesis) -> Curve:
    count = int(task.chosen["points"])
    ends = ("theta_p1", f"theta_p{count}") if task.function is None else ("theta_first", "theta_last")
    columns: Columns = {"theta": (_part(*ends, RANGE_ROWS), "angle")}
    if task.function is not None:
        x = parse_description(_part("x_first", "x_last", RANGE_ROWS))
        risen = parse_description("psi_first + (psi_last - psi_first)*(f - f_first)/(f_last - f_first)")
        columns["wanted"] = (with_symbols(risen, {"f": with_symbols(task.function, {"x": x})}), "angle")
    columns["raw"] = (output_angle("(theta + theta_offset)"), "angle")
    middle = f"psi_p{(count + 1) // 2}"
    columns["got"] = (f"{middle} + atan2(sin(raw - {middle}), cos(raw - {middle}))", "angle")
    columns["mu"] = (transmission_angle("(theta + theta_offset)"), "angle")
    return Curve(RANGE_ROWS, columns, "theta", "got", "wanted" if task.function is not None else "")


def _of_guidance() -> Curve:
    toward = "atan2(y_B0 - y_A0, x_B0 - x_A0)"
    columns: Columns = {
        "theta": (_part("theta_1", "(theta_1 + beta_A3)", RANGE_ROWS), "angle"),
        "mu": (transmission_angle(f"(theta - {toward})"), "angle"),
    }
    return Curve(RANGE_ROWS, columns, "theta", "mu")


def _of_crank_rocker() -> Curve:
    u = "(-cos(phi - psi/2)/cos(psi/2))"
    near, far = (f"abs((lam*crank)^2 + rocker^2 - (1 {sign} crank)^2)" for sign in "-+")
    return _of_ratio(
        crank="sqrt(1 - cos(psi))/sqrt(A + B*lam^2)",
        rocker="sqrt((1 - cos(phi)) + (1 + cos(phi))*lam^2)/sqrt(A + B*lam^2)",
        least=f"max({near}, {far})",
        cosine="least/(2*lam*crank*rocker)",
        together=f"1 + min({u}, 1/{u}) - lam*(1 - min({u}, 1/{u}))",
    )


def _of_slider() -> Curve:
    return _of_ratio(
        crank="1/sqrt(p*lam^2 + q)",
        rocker="(lam^2 - 1)*crank^2*abs(sin(alpha))",
        least="crank + rocker",
        cosine="least/(lam*crank)",
        together="q - p*lam",
    )


def _of_ratio(crank: str, rocker: str, least: str, cosine: str, together: str) -> Curve:
    """The least transmission angle over λ, in equal steps of its logarithm.

    crank, rocker  lengths in parts of a1, or of the stroke; of a slider-crank `rocker` is the eccentricity
    least, cosine  of the least transmission angle: what its cosine is found from, and the cosine
    together       above 0 where one assembly has both dead centres; else there is no angle
    """
    columns: Columns = {
        "lam": (f"exp(ln({FIRST_RATIO}) + ln({LONGEST}/{FIRST_RATIO})*n/{RATIO_ROWS - 1})", "number"),
        "crank": (crank, "number"),
        "rocker": (rocker, "number"),
        "least": (least, "number"),
        "mu": (f"where({together}, acos({cosine}), acos(2))", "angle"),
    }
    return Curve(RATIO_ROWS, columns, "lam", "mu")

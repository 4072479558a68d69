"""The table of a curve over a range: of a function generator its output, of the others how well they transmit."""

from __future__ import annotations

from dataclasses import dataclass

from mechsheet.formula.nodes import Node, with_symbols
from mechsheet.formula.parser import parse_description
from mechsheet.model import Synthesis
from mechsheet.sheet.synthesis.requirements import output_angle, transmission_angle

Columns = dict[str, tuple[str | Node, str]]

RANGE_ROWS, RATIO_ROWS = 81, 121

FIRST_RATIO, LAST_RATIO = "1.0005", "400"
"""Of the table over λ."""


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
            return _of_ratio(_CRANK_ROCKER)
        case "quick-return-slider":
            return _of_ratio(_SLIDER)
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


_CRANK_ROCKER = {
    "lam": f"exp(ln({FIRST_RATIO}) + ln({LAST_RATIO}/{FIRST_RATIO})*n/{RATIO_ROWS - 1})",
    "crank": "sqrt(1 - cos(psi))/sqrt(A + B*lam^2)",
    "rocker": "sqrt((1 - cos(phi)) + (1 + cos(phi))*lam^2)/sqrt(A + B*lam^2)",
    "least": "max(abs((lam*crank)^2 + rocker^2 - (1 - crank)^2), abs((lam*crank)^2 + rocker^2 - (1 + crank)^2))",
}

_SLIDER = {
    "lam": _CRANK_ROCKER["lam"],
    "crank": "1/sqrt(p*lam^2 + q)",
    "rocker": "(lam^2 - 1)*crank^2*abs(sin(alpha))",
    "least": "crank + rocker",
}


def _of_ratio(parts: dict[str, str]) -> Curve:
    """The least transmission angle over λ; nothing where no assembly has both dead centres."""
    columns: Columns = {key: (text, "number") for key, text in parts.items()}
    u = "(-cos(phi - psi/2)/cos(psi/2))"
    if parts is _SLIDER:
        limit = "q - p*lam"
        cosine = "least/(lam*crank)"
    else:
        limit = f"1 + min({u}, 1/{u}) - lam*(1 - min({u}, 1/{u}))"
        cosine = "least/(2*lam*crank*rocker)"
    columns["mu"] = (f"where({limit}, acos({cosine}), acos(2))", "angle")
    return Curve(RATIO_ROWS, columns, "lam", "mu")

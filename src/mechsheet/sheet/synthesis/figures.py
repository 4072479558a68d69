"""What the chart of positions shows: lines through points, in the plane of the mechanism.

Over the names of results (as used), inputs and steps; A0 is the origin, but where the task has a frame of its own.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from mechsheet.model import Synthesis

Vertex = tuple[str, str, str]
"""Name, x, y."""


@dataclass(frozen=True, slots=True)
class Line:
    """A line through vertices.

    key     of its words in the legend, with `number`
    color   number of the catalogue's colour;  dash  "solid", "dash", "dot";  pins  circles at the vertices
    """

    key: str
    vertices: tuple[Vertex, ...]
    color: int = 0
    dash: Literal["solid", "dash", "dot"] = "solid"
    pins: bool = True
    number: int = 0


def _arc(key: str, x: str, y: str, radius: str, first: str, turn: str, color: int) -> Line:
    steps = [f"({first} + {turn}*{n}/12)" for n in range(13)]
    vertices = tuple(("", f"{x} + {radius}*cos{at}", f"{y} + {radius}*sin{at}") for at in steps)
    return Line(key, vertices, color, "dash", False)


def _four_bar(key: str, n: int, theta: str, psi: str) -> Line:
    """The four-bar on A0B0 at its position `n`, by the angles of input and output."""
    vertices = (
        ("A0", "0", "0"),
        (f"A{n}", f"a2*cos({theta})", f"a2*sin({theta})"),
        (f"B{n}", f"a1 + a4*cos({psi})", f"a4*sin({psi})"),
        ("B0", "a1", "0"),
    )
    return Line(key, vertices, n - 1, number=n)


def _of_dead_centres(_: Synthesis) -> list[Line]:
    first = _four_bar("figure.dead", 1, "theta_1", "psi_1")
    second = _four_bar("figure.dead", 2, "theta_1 + phi", "psi_1 + psi")
    return [first, second, _arc("figure.swing", "a1", "0", "a4", "psi_1", "psi", 4)]


def _of_slider(_: Synthesis) -> list[Line]:
    far, near = "sqrt((a3 + a2)^2 - c^2)", "sqrt((a3 - a2)^2 - c^2)"
    lines = []
    for n, way, reach in ((1, far, "(a3 + a2)"), (2, near, "(a2 - a3)")):
        crank = (f"A{n}", f"{way}*a2/{reach}", f"-c*a2/{reach}")
        lines.append(Line("figure.dead", (("A0", "0", "0"), crank, (f"B{n}", way, "-c")), n - 1, number=n))
    guide = (("", "0", "-c"), ("", f"{far} + a2", "-c"))
    return [*lines, Line("figure.guide", guide, 4, "dash", False)]


def _of_lever(_: Synthesis) -> list[Line]:
    lines = []
    half = "asin(crank/centre)"
    for n, sign in ((1, ""), (2, "-")):
        arm = "sqrt(centre^2 - crank^2)"
        lever = (("B0", "0", "0"), (f"A{n}", f"{sign}{arm}*sin({half})", f"{arm}*cos({half})"),
                 (f"B{n}", f"{sign}lever*sin({half})", f"lever*cos({half})"))  # fmt: skip
        lines.append(Line("figure.dead", lever, n - 1, number=n))
        lines.append(Line("figure.crank", (("A0", "0", "centre"), lever[1]), n - 1, "dash", False, n))
    return lines


def _of_guidance(_: Synthesis) -> list[Line]:
    lines = []
    for n, end in ((1, ""), (2, "_2"), (3, "_3")):
        a, b = (f"x_A{end}", f"y_A{end}"), (f"x_B{end}", f"y_B{end}")
        links = (("A0", "x_A0", "y_A0"), (f"A{n}", *a), (f"B{n}", *b), ("B0", "x_B0", "y_B0"))
        lines.append(Line("figure.pose", links, n - 1, number=n))
        body = ((f"P{n}", f"x_p{n}", f"y_p{n}"), ("", *a), ("", *b), ("", f"x_p{n}", f"y_p{n}"))
        lines.append(Line("figure.body", body, n - 1, "dot", False, n))
    return lines


def _of_function(task: Synthesis) -> list[Line]:
    return [
        _four_bar("figure.point", n, f"theta_p{n} + theta_offset", f"psi_p{n} + psi_offset")
        for n in range(1, int(task.chosen["points"]) + 1)
    ]


FIGURES: dict[str, Callable[[Synthesis], list[Line]]] = {
    "function": _of_function,
    "dead-centres": _of_dead_centres,
    "guidance": _of_guidance,
    "quick-return-slider": _of_slider,
    "quick-return-lever": _of_lever,
}


def lines_of(task: Synthesis) -> list[Line]:
    """The lines of a task's figure."""
    return FIGURES[task.kind](task)

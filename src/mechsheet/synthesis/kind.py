"""What a kind of synthesis declares: how its task is read and solved, and what the sheet says and draws of it.

All in expressions over the kind's own names, as `writing` writes them; of a result they mean the length that is used.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Literal

from livesheet.formula.nodes import Node, with_symbols
from livesheet.formula.parser import parse_description
from mechsheet.model import Synthesis, TaskPlace
from mechsheet.synthesis.writing import Writer

Measure = Literal["angle", "length", "number"]

MU = "mu"
"""What the transmission angle at a point is called in what is asked there."""

THROUGH_POINTS = (
    "meets",
    "assemblies",
    "order",
    "closes_throughout",
    "transmission_used",
    "at_dead_centre",
    "grashof",
    "sensitivity",
)
"""Verdicts on a mechanism that has to pass points, or poses."""

BETWEEN_DEAD_CENTRES = ("meets", "together", "turns", "transmission_least", "sensitivity")
"""Verdicts on one whose dead centres are asked for."""


@dataclass(frozen=True, slots=True)
class Requirement:
    """One row of what is asked: what is wanted, what the mechanism that comes out does.

    key     of its words, with `parts`
    wanted  an expression;  got  another, of an angle but for whole turns; it may read `MU`
    at      the angle of the input link there, where the task has points;  mu: the transmission angle there, which the sheet
            has beside it
    """

    key: str
    wanted: str
    got: str
    measure: Measure
    parts: tuple[tuple[str, object], ...] = ()
    at: str = ""
    mu: str = ""

    @property
    def got_alone(self) -> Node:
        """What is got, where no cell has the transmission angle."""
        got = parse_description(self.got)
        return with_symbols(got, {MU: parse_description(self.mu)}) if self.mu else got


Vertex = tuple[str, str, str]
"""Name, x, y."""


@dataclass(frozen=True, slots=True)
class Line:
    """A line of the figure through vertices; A0 is the origin, but where the task has a frame of its own.

    key     of its words in the legend, with `number`
    color   number of the catalogue's colour;  pins  circles at the vertices
    """

    key: str
    vertices: tuple[Vertex, ...]
    color: int = 0
    dash: Literal["solid", "dash", "dot"] = "solid"
    pins: bool = True
    number: int = 0


Columns = dict[str, tuple[str | Node, Measure]]


@dataclass(frozen=True, slots=True)
class Curve:
    """A table over a range, and its chart. Its expressions may also name `n` (the row, from 0) and columns before them.

    columns  key -> (expression, measure), from left to right; what cannot be is #N/A
    x, y     keys of the chart's axes;  wanted  key of the curve that is wanted, where there is one
    """

    rows: int
    columns: Columns
    x: str
    y: str
    wanted: str = ""


def no_curve(_: Synthesis) -> None:
    """Of a kind that has nothing to draw over a range."""


@dataclass(frozen=True, slots=True)
class Kind:
    """A kind of synthesis.

    write     its inputs, steps and results
    angles    keys of the task whose numbers are angles; `poses.3` is the third number of each item of `poses`
    numbers   keys of plain numbers; all others are lengths
    positive  keys whose numbers must be greater than 0;  own: keys that a dimension of the same name can give
    pairs     whether the task is pairs of angles, or a function that gives them
    asked     the rows of what is asked
    figure    the lines of the figure;  curve  the table over a range
    verdicts  names of what is said of the mechanism that comes out, in order (`sheet/synthesis/requirement_checks.py`)
    turns     above 0 where the input link turns fully, a length, over results; "" where it always does
    steps     by how much the input link turns from each point to the next: for the verdict `order`
    beside    the least angle between coupler and output at the points, where they have no input angle: for `at_dead_centre`
    alt       whether the workbook has Alt's chart
    decided   whether its solution does all that is asked: of more points than decide it none does
    """

    write: Callable[[Writer], None]
    asked: Callable[[Synthesis], list[Requirement]]
    figure: Callable[[Synthesis], list[Line]]
    verdicts: tuple[str, ...]
    curve: Callable[[Synthesis], Curve | None] = no_curve
    angles: tuple[str, ...] = ()
    numbers: tuple[str, ...] = ()
    positive: tuple[str, ...] = ()
    own: tuple[str, ...] = ()
    pairs: bool = False
    turns: str = ""
    steps: Callable[[Synthesis], list[str]] = lambda _: []
    beside: str = ""
    alt: bool = False
    decided: Callable[[Synthesis], bool] = lambda _: True

    def measure(self, place: TaskPlace) -> Measure:
        """What the number that stands there is."""
        names = {part for part in place if isinstance(part, str)}
        if isinstance(place[-1], int):
            names.add(f"{place[0]}.{place[-1] + 1}")
        if names & set(self.angles):
            return "angle"
        return "number" if names & set(self.numbers) else "length"

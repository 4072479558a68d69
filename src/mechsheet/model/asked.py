"""What is asked of a mechanism: an exercise for students, a task that gives its dimensions, a study of designs, bands."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

from livesheet.formula.nodes import Node
from livesheet.said import Words


def values_in(low: float, high: float, step: float) -> int:
    """How many values low, low + step, ... up to high are."""
    return math.floor((high - low) / step + 1e-9) + 1


@dataclass(frozen=True, slots=True)
class Vary:
    """A dimension that is another one for each student: low, low + step, ... up to high, in its own unit."""

    symbol: str
    low: float
    high: float
    step: float

    @property
    def count(self) -> int:
        """How many values it can have."""
        return values_in(self.low, self.high, self.step)


@dataclass(frozen=True, slots=True)
class Need:
    """What drawn dimensions must fulfil: `left operator right` over summaries in their units; that every row exists."""

    left: Node | None = None
    operator: str = ""
    right: Node | None = None
    text: str = "all rows"


@dataclass(frozen=True, slots=True)
class Exercise:
    """What is asked of students.

    asked      marks by variable, coordinate, rate, force, output or summary; empty: all link angles, displacements, outputs
    tolerance  of the mechanism's size; radians for angles
    follow_through  whether what is right but for an earlier fault has its marks;  not_live  the share of a mark for what
               does not follow the dimensions
    """

    asked: Mapping[str, float] = field(default_factory=dict)
    vary: tuple[Vary, ...] = ()
    need: tuple[Need, ...] = ()
    tolerance: float = 1e-4
    follow_through: bool = True
    not_live: float = 0.5


TaskPlace: TypeAlias = tuple[str | int, ...]
"""Where the task of a synthesis says something, below [synthesis]: ("theta", 1), ("A", "moving", 0), ("stroke",)."""


@dataclass(frozen=True, slots=True)
class Synthesis:
    """A task from which dimensions are found; its inputs and all steps of its solution are dimensions of the mechanism.

    kind      one of `mechsheet.synthesis.kinds.KINDS`
    task      where the description says it -> symbol of the input dimension
    steps     symbols of the derived dimensions that solve the task, in order
    results   name of a result -> symbol of its exact value
    taken     dimension of the mechanism -> the result that it is
    positive  symbols of inputs that must be greater than 0
    chosen    what the task says beside its numbers: how many points, which of several keys is given
    rounding  symbol of what lengths are rounded to before they are used, "" where they are not
    mode      symbol of the assembly mode cell that follows from the task -> the result that says it
    function  the function that is to be generated, over `x`; None where the task has none
    reasons   steps that may not exist, in order -> why there is no solution then
    sides     symbols of steps that are 1 or −1
    roots     symbol of a root of x^3 + b x^2 + c x + d = 0 -> symbols of b, c and d
    replaced  results in whose place the mechanism has a dimension of its own by the same name
    names     what inputs, steps and results are called in the kind's own equations -> their symbols
    """

    kind: str
    task: Mapping[TaskPlace, str]
    steps: tuple[str, ...]
    results: Mapping[str, str]
    taken: Mapping[str, str]
    positive: tuple[str, ...] = ()
    chosen: Mapping[str, str] = field(default_factory=dict)
    rounding: str = ""
    mode: Mapping[str, str] = field(default_factory=dict)
    function: Node | None = None
    reasons: tuple[tuple[str, Words], ...] = ()
    replaced: tuple[str, ...] = ()
    names: Mapping[str, str] = field(default_factory=dict)
    sides: tuple[str, ...] = ()
    roots: Mapping[str, tuple[str, str, str]] = field(default_factory=dict)

    @property
    def inputs(self) -> tuple[str, ...]:
        """Symbols of the task's input dimensions, in its order."""
        return tuple(self.task.values())

    @property
    def used(self) -> dict[str, str]:
        """Name of a result -> symbol of the mechanism's dimension, or of the assembly mode cell, that it has for it."""
        own = ((name, name) for name in self.replaced)
        return {name: symbol for symbol, name in (*own, *self.taken.items(), *self.mode.items())}

    @property
    def ends(self) -> tuple[str, ...]:
        """Symbols that all have a value where the task has a solution: those of the mechanism's dimensions."""
        names = tuple(self.taken.values()) or tuple(self.results)
        return tuple(dict.fromkeys(self.results[name] for name in names))


@dataclass(frozen=True, slots=True)
class Range:
    """What a study does with a dimension, in its own unit: low, low + step, ... up to high, or any number between low and
    high where `step` is 0; or one of `values`."""

    symbol: str
    low: float = 0.0
    high: float = 0.0
    step: float = 0.0
    values: tuple[float, ...] = ()

    @property
    def count(self) -> int:
        """How many values it has where it steps or lists them."""
        return len(self.values) or values_in(self.low, self.high, self.step)


@dataclass(frozen=True, slots=True)
class Condition:
    """What a design must meet.

    kind   "compare": sides[0] operators[0] sides[1] ..., over dimensions, summaries and extremes in the units shown;
           "closes": in every row; "crank": the link `name` goes on turning; "grashof": in the loop `name` some link can turn
    other  True where the opposite is asked for: `not crank(rocker)`
    """

    text: str
    kind: Literal["compare", "closes", "crank", "grashof"]
    name: str = ""
    other: bool = False
    sides: tuple[Node, ...] = ()
    operators: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Objective:
    """What is to be as small, or as large, as can be: an expression as in conditions."""

    text: str
    value: Node
    largest: bool = False


EXTREME = "{take}({of})"
"""The symbol of an extreme that is no summary of its own, in conditions and objectives: min(mu)."""


@dataclass(frozen=True, slots=True)
class Study:
    """Which designs are tried, which are kept, and what is best.

    sample  "grid": every combination of the ranges, the last one changing first; "sobol": `count` points of Sobol's
            sequence, scrambled by `seed`
    best    how many designs are listed
    """

    vary: tuple[Range, ...]
    sample: Literal["grid", "sobol"] = "grid"
    count: int = 0
    seed: int = 0
    keep: tuple[Condition, ...] = ()
    objectives: tuple[Objective, ...] = ()
    best: int = 50


@dataclass(frozen=True, slots=True)
class Tolerances:
    """What bands are asked for: of which variables, coordinates and outputs, and of which summaries, by symbol.

    quantities  those of the summaries, too, in the order in which they have columns
    named       whether the description names them; else all are asked for that a tolerance changes
    """

    quantities: tuple[str, ...]
    summaries: tuple[str, ...]
    named: bool = True

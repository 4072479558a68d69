"""What a model is written in: quantities, symbols by rule, labels in several languages, places of points in
their link's frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from livesheet.formula.nodes import Node
from livesheet.said import Words

Quantity: TypeAlias = float | Node


GROUND = 1
"""The number of the fixed link."""


TIME = "t"
"""The time of a motion law [s]."""


POINT_RATES = ("vx", "vy", "v", "ax", "ay", "a")
"""Of a point C the velocity and the acceleration, `C.vx`: components in the ground's frame, and their magnitude."""


def rate_symbols(symbol: str, turns: bool) -> tuple[str, str]:
    """What the first and second derivative by time of an angle or a displacement are called.

    omega13, alpha13 of theta13; omega_q, alpha_q of an angle q; s14.v, s14.a of a displacement
    """
    if not turns:
        return f"{symbol}.v", f"{symbol}.a"
    tail = symbol.removeprefix("theta") if symbol.startswith("theta") and symbol != "theta" else f"_{symbol}"
    return f"omega{tail}", f"alpha{tail}"


SHAKING = ("shaking.x", "shaking.y", "shaking.m")
"""What the forces of inertia of all links shake the ground with: the force's parts, and its moment about the origin."""


ENERGY = "E_f"
"""What the flywheel has given by the position, from the first row on: the integral of the torque less its mean."""


def center_symbol(number: int) -> str:
    """`G3`, the mass centre of link 3 where it is no point of its own: G3.x, G3.vx."""
    return f"G{number}"


def pair_symbol(letter: str, first: int, second: int) -> str:
    """`F34` of links 3 and 4; `F3_10` where a number has two digits."""
    return f"{letter}{first}{second}" if max(first, second) < 10 else f"{letter}{first}_{second}"


@dataclass(frozen=True, slots=True)
class Label(Words):
    """A text of the description: one, or one for each language; what has none in a language has the English one.

    others  language -> text, besides the English one
    """

    text: str
    others: tuple[tuple[str, str], ...] = ()

    def of(self, language: str) -> str:
        """The text in a language."""
        return dict(self.others).get(language, self.text)


@dataclass(frozen=True, slots=True)
class Cartesian:
    """A point at (x, y) in its link's frame."""

    x: Quantity
    y: Quantity


@dataclass(frozen=True, slots=True)
class Polar:
    """A point at distance `r` from the frame's origin, in the direction `angle` [rad] from the frame's x axis."""

    r: Quantity
    angle: Quantity


@dataclass(frozen=True, slots=True)
class Distances:
    """A point by its distances from two points of the same link; `side` as seen going from the first to the second."""

    first: str
    first_distance: Quantity
    second: str
    second_distance: Quantity
    side: Literal["left", "right"]


GivenPoint: TypeAlias = Cartesian | Polar | Distances

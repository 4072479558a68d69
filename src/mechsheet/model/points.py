"""Where a point of a link is in the link's own frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

from .symbols import Quantity


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

"""Units: what kind of quantity a number is, how its unit is written, and by what factor the program's own number is shown.

Inside, angles are in radians and lengths in the mechanism's length unit, times in seconds. An equation says no more than the
kind (`ANGLE`, `LENGTH`); in which unit people read it is the mechanism's matter (`Mechanism.shown`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from typing import Literal, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

Value = TypeVar("Value", float, NDArray[np.float64])

Kind: TypeAlias = Literal["length", "angle", "number", "force", "moment", "power", "label"]
"""A "label" is whatever a description writes behind an output's numbers: the program knows nothing of it."""


def turn(in_degrees: bool) -> float:
    """A whole turn, as degrees or radians."""
    return 360.0 if in_degrees else math.tau


@dataclass(frozen=True, slots=True)
class Unit:
    """A unit.

    symbol  as a description writes it: "deg", "rad", "mm", "N·m", "1" for a plain number; "" where only the kind is known
    factor  what a number in internal units is multiplied by to be shown
    per     by which power of time it is divided: 1 for a speed, 2 for an acceleration
    """

    kind: Kind
    symbol: str = ""
    factor: float = 1.0
    per: int = 0

    @property
    def text(self) -> str:
        """As it stands behind a number: `°`, `mm`, `rad/s²`, nothing for a plain number."""
        over = {0: "", 1: "/s", 2: "/s²", 3: "/s³"}.get(self.per, f"/s^{self.per}")
        return {"deg": "°", "1": "1" if over else ""}.get(self.symbol, self.symbol) + over

    @property
    def in_degrees(self) -> bool:
        """Whether what is shown are degrees, for the program's radians."""
        return self.kind == "angle" and self.factor != 1.0

    @property
    def internal(self) -> Unit:
        """The unit of the program's own numbers: radians for degrees."""
        return replace(RAD, per=self.per) if self.kind == "angle" else self

    def per_time(self) -> Unit:
        """The unit of the derivative by time [s]."""
        return replace(self, per=self.per + 1)

    def to_shown(self, number: Value) -> Value:
        """An internal number, or an array of them, in this unit."""
        return number * self.factor

    def to_internal(self, number: Value) -> Value:
        """A number in this unit, or an array of them, in internal units."""
        return number * (1 / self.factor)

    def written(self, number: float) -> float:
        """An internal number as a person wrote it in this unit: 30 for the 0.5235987755982988 that 30 degrees became."""
        shown = self.to_shown(number)
        plain = round(shown, 10)
        return plain if self.in_degrees and math.isclose(shown, plain, rel_tol=1e-14, abs_tol=1e-13) else shown


DEG = Unit("angle", "deg", math.degrees(1.0))
RAD = Unit("angle", "rad")
NUMBER = Unit("number", "1")
SECONDS = Unit("number", "s")
ANGLE = Unit("angle")
"""An angle, shown as the mechanism shows angles."""
LENGTH = Unit("length")
"""A length, in the mechanism's length unit."""


def behind_number(text: str) -> str:
    """A unit's text as it stands behind a number: ` mm`, but `°` without a gap, nothing for a plain number."""
    return text if text in ("", "°") else f" {text}"


def unit_of(symbol: str, length_unit: str) -> Unit:
    """The unit that a description means by `symbol`: "deg", "rad", "1", its length unit, or a label of its own."""
    known = {unit.symbol: unit for unit in (DEG, RAD, NUMBER)}
    return known.get(symbol) or Unit("length" if symbol == length_unit else "label", symbol)

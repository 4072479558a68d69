"""From the position that a sketch shows to the first row: the group followed over the driver's values in between."""

from __future__ import annotations

import math

import numpy as np

from mechsheet.diagnostics import Fault, MechanismError
from mechsheet.kinematics.numeric import Array
from mechsheet.model import Driver, Words
from mechsheet.said import say

STEP = math.radians(1.0)
FEWEST, MOST = 24, 390
"""Steps between two values of the driver: fewer than the rows that are looked at when a mechanism is solved."""


def way(start: float, end: float, turns: bool) -> Array:
    """Values of the driver from one to another, in small steps."""
    count = math.ceil(abs(end - start) / STEP) if turns else FEWEST
    return np.linspace(start, end, min(max(count, FEWEST), MOST) + 1)


def cannot_follow(links: Words, driver: Driver, place: float) -> MechanismError:
    """The mechanism comes apart on the way, at this value of the driver [rad or length unit]."""
    where = {"symbol": driver.symbol, "value": float(driver.unit.to_shown(place))}
    return MechanismError(
        Fault(
            say(
                "from the position that the sketch shows {links} cannot be followed to the first one: they "
                "come apart at {symbol} = {value:.4g}",
                links=links,
                **where,
            ),
            key="assembly.at",
            hint=say("sketch a position of the same stretch, or begin the sweep in it"),
        )
    )

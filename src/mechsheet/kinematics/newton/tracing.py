"""From the position that a sketch shows to the first row: the group followed over the driver's values in between."""

from __future__ import annotations

import math

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.said import Words, say
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.numeric import Array
from mechsheet.model import Driver

STEP = math.radians(1.0)
FEWEST, MOST = 24, 390
"""Steps between two values of the driver: fewer than the rows that are looked at when a mechanism is solved."""


def way(start: float, end: float, turns: bool) -> Array:
    """Values of the driver from one to another, in small steps."""
    count = math.ceil(abs(end - start) / STEP) if turns else FEWEST
    return np.linspace(start, end, min(max(count, FEWEST), MOST) + 1)


def cannot_show(links: Words) -> MechanismError:
    """There is no position where the sketch is said to show one."""
    message = say("the sketch cannot show this position: there {links} cannot be joined", links=links)
    hint = say("check `at`, which is in the driver's unit, and the lengths of these links")
    return MechanismError(Fault(message, key="assembly.at", hint=hint))


def cannot_follow(links: Words, driver: Driver, at: float, place: float) -> MechanismError:
    """What the sketch shows at the driver's value `at` comes apart on the way, at another [rad or length unit]."""
    where = {"symbol": driver.symbol, "value": float(driver.unit.to_shown(place))}
    start = float(driver.unit.to_shown(at))
    return MechanismError(
        Fault(
            say(
                "from the position that the sketch shows {links} cannot be followed to the first one: they "
                "come apart at {symbol} = {value:.4g}",
                links=links,
                **where,
            ),
            key="assembly.at",
            hint=say(
                "begin the sweep at {symbol} = {start:.4g}, where it exists, or sketch a position of the first one's "
                "stretch",
                symbol=driver.symbol,
                start=start,
            ),
        )
    )

"""A speed of the other sense than the rows: the minus is forgotten where an angle falls from row to row."""

from __future__ import annotations

import itertools
from collections.abc import Iterator

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import symbols
from livesheet.said import Said, say
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import Mechanism
from mechsheet.units import DEG, behind_number


def way_back_doubts(mechanism: Mechanism) -> Iterator[Fault]:
    """What is to be said of rows that go down beside a speed that leads up.

    A minus before the speed of rows that go up is meant: nobody writes one by mistake, and a crank that turns clockwise may
    be listed from 0 to 360 all the same.
    """
    driver = mechanism.driver
    values = dimension_values(mechanism)
    speed = driver.speed
    if speed is None or not set(symbols(speed)) <= values.keys():  # a law, a list, or a formula of the driver
        return
    if driver.values:
        rows = [number(each, values) for each in driver.values]
    else:
        rows = [number(driver.start, values), number(driver.stop, values)]
    if len(rows) < 2 or number(speed, values) <= 0 or any(later >= row for row, later in itertools.pairwise(rows)):
        return
    first, last = (f"{driver.unit.to_shown(row):g}{behind_number(driver.unit.text)}" for row in (rows[0], rows[-1]))
    message = say(
        "the rows go down, from {first} to {last}, and the speed leads up: velocities and damper forces are of the way back",
        first=first, last=last,
    )  # fmt: skip
    yield Fault(message, key="driver.speed", hint=_hint(mechanism))


def _hint(mechanism: Mechanism) -> Said:
    cells = (each for each in mechanism.dimensions if each.path == ("driver", "speed") and each.shown is not None)
    given = next(cells, None)
    if given is None:
        return say("put a minus before the speed; or, where the way back is meant, let the rows go up")
    new = f'"-{given.shown:.12g} {given.unit.text.replace("°", DEG.symbol)}"'
    return say("write speed = {new}; or, where the way back is meant, let the rows go up", new=new)

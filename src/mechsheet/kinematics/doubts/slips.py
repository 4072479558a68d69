"""Numbers that are likely slips: in another unit than the one that counts, or without their minus.

kg mm² are written where kg m² count, degrees where radians do; the minus of a speed is forgotten where an angle falls from
row to row.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

from livesheet.diagnostics import Fault
from livesheet.formula.nodes import symbols
from livesheet.said import Said, say
from mechsheet.kinematics.dimensions import dimension_values, largest_length
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import Mechanism
from mechsheet.units import DEG, RAD, behind_number

OUTSIZED = 100.0
"""A radius of gyration of so many times the mechanism's size is a slip: mm for m make a thousand, while what a crank drives
through gears may well be counted to it."""

TURNS, STEP = 2.0, 1.0
"""A driver that goes so many turns [turns] from 0 and beyond, by at least such a step [rad], is meant to go by degrees: rows
that are 57 degrees apart show nothing of so long a motion."""


def inertia_doubts(mechanism: Mechanism) -> Iterator[Fault]:
    """What is to be said of links whose mass would have to lie far outside of the mechanism."""
    dynamics = mechanism.dynamics
    if dynamics is None:
        return
    values = dimension_values(mechanism)
    size = largest_length(mechanism, values)
    for each in dynamics.masses:
        if each.mass is None or each.inertia is None:
            continue
        mass, inertia = number(each.mass, values), number(each.inertia, values)
        if not (mass > 0 and inertia > 0 and size > 0):
            continue
        radius = math.sqrt(inertia / mass) / (dynamics.metre or 1.0)
        if radius > OUTSIZED * size:
            message = say(
                "with this mass the radius of gyration is {radius:.3g} {unit}, {times:.0f} times the size of the mechanism",
                radius=radius, unit=mechanism.length_unit, times=radius / size,
            )  # fmt: skip
            hint = say("check its unit, and that of the mass")
            if dynamics.metre is not None:
                hint = say('a plain number counts in kg m²; write "{number:g} kg mm²" if that is meant', number=inertia)
            yield Fault(message, key=f"links.{each.link}.inertia", hint=hint)


def sweep_doubts(mechanism: Mechanism) -> Iterator[Fault]:
    """What is to be said of a driver that turns on and on, by steps that are large in radians and usual in degrees."""
    driver = mechanism.driver
    if driver.unit != RAD:
        return
    values, law = dimension_values(mechanism), driver.law
    if driver.values:
        rows = [number(each, values) for each in driver.values]
        step = min((abs(later - earlier) for earlier, later in itertools.pairwise(rows)), default=0.0)
    elif law is not None:
        rows = [values[law.start], values[law.stop]]
        step = abs(rows[1] - rows[0]) / (law.rows - 1)
    else:
        rows = [number(each, values) for each in (driver.start, driver.stop)]
        step = abs(number(driver.step, values))
    farthest = max(rows, key=abs)
    if step >= STEP and abs(farthest) > TURNS * math.tau:
        message = say(
            "the driver goes to {farthest:g} rad, {turns:.3g} turns, by {step:.3g} rad from row to row",
            farthest=farthest, turns=abs(farthest) / math.tau, step=step,
        )  # fmt: skip
        yield Fault(message, key="driver", hint=say('if degrees are meant, write angle_unit = "deg" in [mechanism]'))


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
    yield Fault(message, key="driver.speed", hint=_reversed_speed(mechanism))


def _reversed_speed(mechanism: Mechanism) -> Said:
    cells = (each for each in mechanism.dimensions if each.path == ("driver", "speed") and each.shown is not None)
    given = next(cells, None)
    if given is None:
        return say("put a minus before the speed; or, where the way back is meant, let the rows go up")
    new = f'"-{given.shown:.12g} {given.unit.text.replace("°", DEG.symbol)}"'
    return say("write speed = {new}; or, where the way back is meant, let the rows go up", new=new)

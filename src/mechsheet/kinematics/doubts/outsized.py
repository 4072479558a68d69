"""Numbers in another unit than the one that counts: kg mm² written where kg m² count, degrees where radians do."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.lengths import largest_length
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import Mechanism
from mechsheet.units import RAD

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

"""Moments of inertia that no link of this size has: kg mm² written where kg m² count."""

from __future__ import annotations

import math
from collections.abc import Iterator

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.lengths import largest_length
from mechsheet.kinematics.points_in_link import number
from mechsheet.model import Mechanism

OUTSIZED = 100.0
"""A radius of gyration of so many times the mechanism's size is a slip: mm for m make a thousand, while what a crank drives
through gears may well be counted to it."""


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

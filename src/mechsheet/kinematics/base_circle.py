"""A base circle that is not the one at which a follower starts whose place is written out."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.said import say
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.points_in_link import number
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Mechanism

ROUNDED = 0.01
"""By such a part of the base circle a start may be rounded that somebody has typed."""


def base_circle_doubts(mechanism: Mechanism, equations: Equations) -> Iterator[Fault]:
    """What is to be said of a cam that comes less near to its centre than its base circle, or nearer.

    A profile touches its base circle where the follower is nearest to the centre and at rest; it never goes below it.
    """
    cam = mechanism.cam
    if cam is None:
        return
    values = dimension_values(mechanism)
    found = sweep(mechanism, equations, given_values(mechanism, values))
    near = np.hypot(found["cam.x"], found["cam.y"])
    near, radius = near[np.isfinite(near)], number(cam.base_radius, values)
    if not len(near) or abs(near.min() - radius) <= ROUNDED * radius:
        return
    message = say(
        "the profile comes as near to its centre as {near:.6g}; the base circle has {radius:.6g}",
        near=float(near.min()), radius=radius,
    )  # fmt: skip
    hint = say("`start` says where the follower is at angle 0, `base_radius` how near that is: make them agree")
    if cam.decides_start:
        hint = say("the motion goes below its start: begin it where the follower is lowest")
    yield Fault(message, key="cam.base_radius", hint=hint)

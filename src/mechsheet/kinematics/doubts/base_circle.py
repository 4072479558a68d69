"""A base circle that is not the one at which a follower starts whose place is written out."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy as np

from livesheet.diagnostics import Fault
from livesheet.formula import algebra as al
from livesheet.said import say
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.equations import Equations
from mechsheet.kinematics.points_in_link import number
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Mechanism, Segments

ROUNDED = 0.01
"""By such a part of the base circle a start may be rounded that somebody has typed."""

SAME = 1e-9
"""Ends of segments that differ by such a part of the longest way are one height."""


def base_circle_doubts(mechanism: Mechanism, equations: Equations) -> Iterator[Fault]:
    """What is to be said of a cam that comes less near to its centre than its base circle, or nearer.

    A profile touches its base circle where the follower is nearest to the centre and at rest; it never goes below it. Where
    the base circle decides the start that is on it, and only a motion that goes below its start is doubted.
    """
    cam, follower, motion = mechanism.cam, mechanism.follower, mechanism.segments
    if cam is None or follower is None or motion is None:
        return
    values = dimension_values(mechanism)
    rows = given_values(mechanism, values)[mechanism.driver.symbol]
    meet = [number(angle, values) for angle in motion.seams]  # a motion may end between two rows
    found = sweep(mechanism, equations, np.unique(np.concatenate([rows, meet])))
    distances = np.sqrt(found["cam.x"] ** 2 + found["cam.y"] ** 2)
    if not np.isfinite(distances).any():
        return
    place = int(np.nanargmin(distances))
    near, radius = float(distances[place]), number(cam.base_radius, values)
    if abs(near - radius) <= ROUNDED * radius:
        return
    way = float(found[follower.symbol][place]) - number(motion.start, values)
    if near > radius and (cam.decides_start or not _rests(motion, way, values)):
        return
    message = say(
        "the profile comes as near to its centre as {near:.6g}; the base circle has {radius:.6g}",
        near=near, radius=radius,
    )  # fmt: skip
    hint = say("`start` says where the follower is at angle 0, `base_radius` how near that is: make them agree")
    if cam.decides_start:
        hint = say("the motion goes below its start: begin it where the follower is lowest")
    yield Fault(message, key="cam.base_radius", hint=hint)


def _rests(motion: Segments, way: float, values: Mapping[str, float]) -> bool:
    """Whether the follower rests at that end of a segment which is nearest to `way` from its start.

    By the law of even velocity it never rests, and its profile stays outside the base circle.
    """
    ends = [
        (each.law, end) for each in motion.parts
        for end in (number(each.lift, values), number(al.add(each.lift, each.by), values))
    ]  # fmt: skip
    nearest = min((end for _, end in ends), key=lambda end: abs(end - way))
    span = max(abs(end) for _, end in ends)
    return any(law != "uniform" and abs(end - nearest) <= SAME * span for law, end in ends)

"""Where links are when another link is the ground: the driver then turns two moving links against each other.

Any link of a random mechanism is held fast; what was the ground moves, and so do both sides of the driven joint.
"""

import math
from dataclasses import replace

import numpy as np
import pytest

from mechsheet import reference
from mechsheet.description import loads
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Sketch
from random_mechanisms import Grower

FIRST_ROW = 1e-8
"""Part of the size by which the first row may miss the sketch, which is made of it."""


def positions(mechanism):
    equations = solve(mechanism)
    dimensions = dimension_values(mechanism)
    return equations, sweep(mechanism, equations, driver_values(mechanism, dimensions))


def held(mechanism, values, link):
    """The mechanism with another ground, and its sketch: the positions of the first row, seen from that link."""
    equations = solve(mechanism)
    first = {name: float(column[0]) for name, column in values.items()}

    pose = equations.poses[link.name]
    x, y, angle = (float(value(part, first)) for part in (pose.x, pose.y, pose.angle))
    c, s = math.cos(angle), math.sin(angle)
    points = {}
    for point in dict.fromkeys(name for each in mechanism.links if each is not link for name in each.points):
        if point not in link.points:
            dx, dy = first[f"{point}.x"] - x, first[f"{point}.y"] - y
            points[point] = (dx * c + dy * s, dy * c - dx * s)
    links = [link, *(each for each in mechanism.links if each is not link)]
    return replace(
        mechanism,
        links=tuple(replace(each, number=number) for number, each in enumerate(links, 1)),
        driver=replace(mechanism.driver, symbol="turned"),
        sketch=Sketch(points, {joint.symbol: first[joint.symbol] for joint in mechanism.joints}),
    )


CLOSED_BY_THE_FAR_LINK = 50
"""Here a pin of the driven pair's second link, placed in that link's own frame, closes a group of Newton's method."""


@pytest.mark.cases(3)
@pytest.mark.slow
@pytest.mark.parametrize("seed", [*range(8), CLOSED_BY_THE_FAR_LINK])
def test_any_link_may_be_the_ground(seed):
    mechanism = loads(Grower(seed, 1 + seed % 4).text(9))
    equations, values = positions(mechanism)
    if not np.isfinite([values[group.closes][0] for group in equations.groups]).all():
        pytest.skip("the first position does not exist")
    solved = 0
    for link in mechanism.links[1:]:
        if link.name == mechanism.driver.link:
            continue
        other = held(mechanism, values, link)
        try:
            _, found = positions(other)
        except MechanismError:  # seen from there it takes more than four unknowns, or another assembly is too near
            continue
        solved += 1
        size = max(abs(coordinate) for place in other.sketch.points.values() for coordinate in place)
        for condition, gap in reference.residuals(other, {}, found).items():
            assert np.nanmax(np.abs(gap), initial=0.0) < 1e-9 * size, (link.name, condition)
        for point, place in other.sketch.points.items():
            there = (found[f"{point}.x"][0], found[f"{point}.y"][0])
            assert there == pytest.approx(place, abs=FIRST_ROW * size), (link.name, point)
    assert solved > 0

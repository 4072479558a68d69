"""What must not depend on how a mechanism is written down: where it stands, how large it is, its mirror, names, order."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mechsheet.description import loads
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.points_in_link import number
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import Cartesian, Polar
from random_mechanisms import Grower

SEEDS = range(24)


def given(seed):
    """The mechanism with plain numbers for places, so that they can be moved."""
    mechanism = loads(Grower(seed, 1 + seed % 4).text(9))
    values = dimension_values(mechanism)

    def plain(place):
        if isinstance(place, Polar):
            r, angle = number(place.r, values), number(place.angle, values)
            return Cartesian(r * math.cos(angle), r * math.sin(angle))
        return Cartesian(number(place.x, values), number(place.y, values))

    links = tuple(
        replace(link, points={name: plain(place) for name, place in link.points.items()}) for link in mechanism.links
    )
    return replace(mechanism, dimensions=(), links=links)


def values_of(mechanism):
    equations = solve(mechanism)
    values = sweep(mechanism, equations, driver_values(mechanism, dimension_values(mechanism)))
    return equations, values


def points_of(mechanism, values):
    names = [point for link in mechanism.links[1:] for point in link.points]
    return {point: np.stack([values[f"{point}.x"], values[f"{point}.y"]]) for point in names}


def mapped(mechanism, place, joint, driver, sketch):
    """The mechanism with places, joints, driver values and sketch mapped."""
    return replace(
        mechanism,
        links=tuple(
            replace(link, points={name: place(link, at) for name, at in link.points.items()})
            for link in mechanism.links
        ),
        joints=tuple(joint(item) for item in mechanism.joints),
        driver=replace(mechanism.driver, **{key: driver(getattr(mechanism.driver, key)) for key in ("start", "stop")}),
        sketch=replace(mechanism.sketch, points={name: sketch(*at) for name, at in mechanism.sketch.points.items()}),
    )


def assert_same(mechanism, other, turn):
    """The other mechanism's points are the first one's, turned by `turn` (a function of an array (2, n))."""
    _, values = values_of(mechanism)
    _, others = values_of(other)
    expected, found = points_of(mechanism, values), points_of(other, others)
    size = np.nanmax([np.nanmax(np.abs(xy), initial=1.0) for xy in expected.values()])
    for point, xy in expected.items():
        wanted = turn(xy)
        scale = size * max(1.0, np.nanmax(np.abs(wanted), initial=1.0) / size)
        np.testing.assert_allclose(found[point], wanted, atol=1e-9 * scale, rtol=0, equal_nan=True, err_msg=point)


@pytest.mark.parametrize("seed", SEEDS)
def test_moving_and_turning_the_ground(seed):
    mechanism = given(seed)
    angle, dx, dy = 0.7, 31.0, -12.0
    c, s = math.cos(angle), math.sin(angle)

    def turned(x, y):
        return (x * c - y * s + dx, x * s + y * c + dy)

    def place(link, at):
        return Cartesian(*turned(at.x, at.y)) if link.number == 1 else at

    def joint(item):
        if item.on != "ground":
            return item
        through = turned(*item.through) if not isinstance(item.through, str) else item.through
        return replace(item, through=through, angle=item.angle + angle)

    # a joint whose `link` is the ground keeps its line on the other link: the ground turns under it
    if any(item.link == "ground" for item in mechanism.joints):
        mechanism_joint = joint

        def joint(item):
            return (
                replace(item, orientation=item.orientation - angle) if item.link == "ground" else mechanism_joint(item)
            )

    other = mapped(mechanism, place, joint, lambda value: value + angle, turned)
    assert_same(mechanism, other, lambda xy: np.stack(turned(xy[0], xy[1])))


@pytest.mark.parametrize("seed", SEEDS)
@pytest.mark.parametrize("factor", [1e-3, 1000.0])
def test_scaling(seed, factor):
    mechanism = given(seed)

    def joint(item):
        if isinstance(item.through, str):
            return item
        return replace(item, through=tuple(factor * part for part in item.through))

    other = mapped(
        mechanism,
        lambda _, at: Cartesian(factor * at.x, factor * at.y),
        joint,
        lambda value: value,
        lambda x, y: (factor * x, factor * y),
    )
    other = replace(
        other,
        sketch=replace(other.sketch, symbols={key: factor * value for key, value in other.sketch.symbols.items()}),
    )
    assert_same(mechanism, other, lambda xy: factor * xy)


@pytest.mark.cases(12)
@pytest.mark.parametrize("seed", SEEDS)
def test_mirroring_swaps_the_modes_of_triangles(seed):
    """y -> -y: triangles turn over (RRR modes swap); which of two displacements is larger stays as it is."""
    mechanism = given(seed)

    def joint(item):
        through = item.through if isinstance(item.through, str) else (item.through[0], -item.through[1])
        return replace(item, through=through, angle=-item.angle, orientation=-item.orientation)

    other = mapped(
        mechanism,
        lambda _, at: Cartesian(at.x, -at.y),
        joint,
        lambda value: -value,
        lambda x, y: (x, -y),
    )
    other = replace(other, driver=replace(other.driver, step=-mechanism.driver.step))
    assert_same(mechanism, other, lambda xy: np.stack([xy[0], -xy[1]]))
    ours, theirs = solve(mechanism).groups, solve(other).groups
    for group, mirrored in zip(ours, theirs, strict=True):
        if not group.open:
            assert mirrored.mode_value == (-group.mode_value if group.kind == "RRR" else group.mode_value)


@pytest.mark.parametrize("seed", SEEDS)
def test_order_and_names_change_nothing(seed):
    mechanism = given(seed)
    new_name = {link.name: f"part_{index}" for index, link in enumerate(mechanism.links)}
    links = [replace(link, name=new_name[link.name]) for link in mechanism.links]
    reordered = [links[0], *reversed(links[1:])]
    reordered = [replace(link, number=index) for index, link in enumerate(reordered, 1)]
    joints = [replace(item, link=new_name[item.link], on=new_name[item.on]) for item in reversed(mechanism.joints)]
    crank = next(link for link in reordered if link.name == new_name["crank"])
    driver = replace(
        mechanism.driver, link=crank.name, relative_to=new_name[mechanism.driver.relative_to], symbol=crank.angle_symbol
    )
    other = replace(mechanism, links=tuple(reordered), joints=tuple(joints), driver=driver)
    assert_same(mechanism, other, lambda xy: xy)

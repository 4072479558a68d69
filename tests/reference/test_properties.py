"""What must not change: a mechanism moved, turned, scaled, mirrored, renamed, or told in another order."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from reference_cases import read

from mechsheet.description import loads
from mechsheet.model import Cartesian, Mechanism, Sketch
from mechsheet.reference import dimension_values, driver_values, residuals, solve, variables, worst
from mechsheet.reference.expressions import number
from mechsheet.reference.geometry import points_in_links, through
from random_mechanisms import Grower

pytestmark = pytest.mark.slow

ROWS = 13
FEW = settings(max_examples=20, deadline=None, derandomize=True)
SEEDS = st.builds(
    lambda seed, dyads: loads(Grower(seed, dyads).text(rows=ROWS, step=29.0)), st.integers(0, 2**31), st.integers(1, 5)
)


def plain(m: Mechanism) -> Mechanism:
    """The same with every quantity a number, and without dimensions."""
    values = dimension_values(m)
    located = points_in_links(m, values)
    links = tuple(
        replace(a, points={p: Cartesian(*map(float, xy)) for p, xy in located[a.name].items()}) for a in m.links
    )
    joints = tuple(
        replace(
            j,
            through=tuple(map(float, through(j, located, values))),
            angle=number(j.angle, values),
            orientation=number(j.orientation, values),
        )
        for j in m.joints
    )
    sketch = Sketch(
        {p: (number(x, values), number(y, values)) for p, (x, y) in m.sketch.points.items()},
        {s: number(q, values) for s, q in m.sketch.symbols.items()},
    )
    driver = replace(m.driver, values=tuple(map(float, driver_values(m, values))))
    return replace(m, dimensions=(), links=links, joints=joints, driver=driver, sketch=sketch, outputs=())


def carried(m, turn=0.0, shift=(0.0, 0.0), scale=1.0, flip=1.0):
    """A plain mechanism whose ground is mirrored (flip = -1), scaled, turned and shifted; and the map of its places."""

    def world(x, y):
        c, s = scale * math.cos(turn), scale * math.sin(turn)
        return c * x - s * flip * y + shift[0], s * x + c * flip * y + shift[1]

    def body(x, y):
        return scale * x, scale * flip * y

    ground = m.ground.name
    links = tuple(
        replace(a, points={p: Cartesian(*(world if a.name == ground else body)(c.x, c.y)) for p, c in a.points.items()})
        for a in m.links
    )
    joints = tuple(
        replace(
            j,
            through=(world if j.on == ground else body)(*j.through),
            angle=flip * j.angle + (turn if j.on == ground else 0.0),
            orientation=flip * j.orientation - (turn if j.link == ground else 0.0),
        )
        for j in m.joints
    )
    lengths = {j.symbol for j in m.joints}
    sketch = Sketch(
        {p: world(*xy) for p, xy in m.sketch.points.items()},
        {s: scale * q if s in lengths else flip * q + turn for s, q in m.sketch.symbols.items()},
    )
    values = tuple(flip * v + turn for v in m.driver.values)
    return replace(m, links=links, joints=joints, sketch=sketch, driver=replace(m.driver, values=values)), world


def assert_same_places(one, other, world=lambda x, y: (x, y)):
    """Points agree up to what rounding does near limits; the same rows exist."""
    assert np.array_equal(one.exists, other.exists)
    assert np.array_equal(one.undetermined, other.undetermined)
    for point, xy in one.points.items():
        wanted = np.stack(world(xy[:, 0], xy[:, 1]), axis=1)[one.exists]
        error = np.abs(other.points[point][one.exists] - wanted)
        assert (error <= 1e-9 * (other.size + np.abs(wanted))).all(), point


@FEW
@given(SEEDS)
def test_every_row_of_a_grown_mechanism_closes(m):
    found = solve(m)
    assert found.exists[0], "it was drawn in its first position"
    judged, _ = worst(residuals(m, {}, variables(found)))
    assert np.nanmax(judged) < 1e-11 * found.size
    for pose in found.poses.values():
        steps = np.abs(np.diff(pose[:, 2]))  # NaN on either side of a gap
        assert np.max(steps, where=np.isfinite(steps), initial=0) <= np.pi + 1e-9


@FEW
@given(
    SEEDS,
    st.floats(-4, 4),
    st.tuples(st.floats(-1e4, 1e4), st.floats(-1e4, 1e4)),
    st.sampled_from([1e-6, 0.01, 1.0, 7.3, 1e6]),
    st.sampled_from([1.0, -1.0]),
)
def test_ground_moved_turned_scaled_mirrored(m, turn, shift, scale, flip):
    m = plain(m)
    other, world = carried(m, turn, (scale * shift[0], scale * shift[1]), scale, flip)
    assert_same_places(solve(m), solve(other), world)


@FEW
@given(SEEDS, st.randoms(use_true_random=False))
def test_renamed_and_reordered(m, random):
    m = plain(m)
    first = solve(m)
    names = [link.name for link in m.links]
    new = dict(zip(names, random.sample([f"body{i}" for i in range(len(names))], len(names)), strict=True))
    links = list(m.links[1:])
    random.shuffle(links)
    links = [
        replace(a, name=new[a.name], points=dict(random.sample(list(a.points.items()), len(a.points))))
        for a in (m.ground, *links)
    ]
    joints = [replace(j, name=f"j{i}", link=new[j.link], on=new[j.on]) for i, j in enumerate(m.joints)]
    random.shuffle(joints)
    driver = replace(m.driver, link=new[m.driver.link], relative_to=new[m.driver.relative_to])
    again = solve(replace(m, links=tuple(links), joints=tuple(joints), driver=driver))
    assert_same_places(first, again)
    for name, pose in first.poses.items():
        turned = (again.poses[new[name]] - pose)[first.exists, 2] / (2 * np.pi)
        assert np.abs(turned - np.round(turned)).max() < 1e-9


@FEW
@given(SEEDS)
def test_a_pin_in_a_slot_is_a_block_without_mass(m):
    """Each pin-slot joint written as a block with a revolute and a prismatic joint: the same numbers."""
    m = plain(m)
    links, joints = list(m.links), []
    for joint in m.joints:
        if joint.kind == "pin-slot":
            block = replace(
                m.links[0],
                name=f"block {joint.name}",
                number=50 + len(links),
                points={joint.point: Cartesian(0.0, 0.0)},
            )
            links.append(block)
            joint = replace(joint, kind="prismatic", link=block.name, orientation=0.3)
        joints.append(joint)
    first, again = solve(m), solve(replace(m, links=tuple(links), joints=tuple(joints)))
    assert_same_places(first, again)
    for symbol, s in first.displacements.items():
        assert np.nanmax(np.abs(again.displacements[symbol] - s)) <= 1e-9 * (first.size + np.nanmax(np.abs(s)))


@FEW
@given(st.integers(0, 10**6))
def test_rows_stand_alone(seed):
    """A driver value gives the same position in whatever order the values come."""
    m = read("drag-link")
    values = np.radians(np.arange(0, 360, 9.0))
    order = np.random.default_rng(seed).permutation(len(values))
    order = np.concatenate([[0], order[order != 0]])
    straight, shuffled = solve(m, values=values), solve(m, values=values[order])
    assert np.abs(straight.points["B"][order] - shuffled.points["B"]).max() < 1e-13

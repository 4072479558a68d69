"""Which assembly is taken."""

from dataclasses import replace

import numpy as np
import pytest
from reference_cases import EXAMPLES, read

from mechsheet.diagnostics import MechanismError
from mechsheet.model import Sketch
from mechsheet.reference import assemblies, solve


def sketched(m, **entries):
    points = {k: v for k, v in entries.items() if isinstance(v, tuple)}
    return replace(m, sketch=Sketch(points, {k: v for k, v in entries.items() if k not in points}))


def test_all_assemblies_of_a_six_link():
    m = read("six-link-dwell", EXAMPLES)
    found = assemblies(m, None, 0.3)
    assert len(found) == 4
    assert len({tuple(np.round([pose[link][2] for link in ("rocker", "output")], 6)) for pose in found}) == 4


def test_sketch_takes_the_nearest():
    m = read("six-link-dwell", EXAMPLES)
    for wanted in assemblies(m, None, 0.3):
        x, y, theta = wanted["rocker"]
        b = (x + 600 * np.cos(theta) + 30, y + 600 * np.sin(theta) - 20)
        found = solve(sketched(m, B=b, theta16=wanted["output"][2] + 0.2), values=[0.3])
        for link, pose in wanted.items():
            apart = found.poses[link][0] - pose
            apart[2] = (apart[2] + np.pi) % (2 * np.pi) - np.pi
            assert np.abs(apart).max() < 1e-9


def test_what_stands_on_a_loop_decides_it_when_the_sketch_leaves_it_out():
    m = read("fivelink")
    full = solve(m)
    c = tuple(full.points["C"][0])
    assert np.abs(solve(sketched(m, C=c)).points["B"] - full.points["B"]).max() < 1e-9


def test_rough_poses():
    m = read("six-link-dwell", EXAMPLES)
    for wanted in assemblies(m, None, 0.0):
        rough = {link: (x + 30, y - 40, theta + 0.1) for link, (x, y, theta) in wanted.items()}
        found = solve(m, start=rough)
        for link, (_, _, theta) in wanted.items():
            assert found.poses[link][0, 2] == pytest.approx(theta, abs=1e-9)


@pytest.mark.slow
def test_rough_poses_of_a_later_row():
    """The first loop closes long before the second: its assembly is the one shown where both do."""
    m = read("stephenson")
    values = np.radians(np.arange(-150, 36, 5.0))
    first = solve(m, values=values)
    row = int(np.argmax(first.exists))
    assert row > 10
    for wanted in assemblies(m, None, values[row]):
        rough = {link: (round(x, 3), round(y, 3), round(theta, 3)) for link, (x, y, theta) in wanted.items()}
        found = solve(m, start=rough, values=values)
        assert found.exists[row]
        for link, pose in wanted.items():
            assert np.abs(found.poses[link][row] - pose)[:2].max() < 1e-9
            assert np.cos(found.poses[link][row, 2] - pose[2]) > 1 - 1e-12


def test_start_names_the_turn():
    m = read("four-bar", EXAMPLES)
    first = {link: tuple(pose[0]) for link, pose in solve(m).poses.items()}
    x, y, theta = first["rocker"]
    first["rocker"] = (x, y, theta + 2 * np.pi)
    assert solve(m, start=first).poses["rocker"][0, 2] == pytest.approx(theta + 2 * np.pi)


def test_displacement_of_a_block_that_is_a_link():
    m = read("six-link-dwell", EXAMPLES)
    s = solve(m).displacements["s65"][0]
    assert solve(sketched(m, B=(740, 750), s65=s)).displacements["s65"][0] == pytest.approx(s)
    assert solve(sketched(m, B=(740, 750), s65=-s)).displacements["s65"][0] == pytest.approx(-s)


def test_first_row_that_exists_is_not_the_first():
    m = read("dead-centre")
    angles = np.radians([100, 150, 200, 260, 300])
    found = solve(sketched(m, B=(2.0, -4.0)), values=angles)
    assert (
        found.exists.tolist() == [False, False, False, False, True] or found.exists.tolist() == [False] * 3 + [True] * 2
    )
    first = int(np.argmax(found.exists))
    both = assemblies(m, None, angles[first])
    nearest = min(both, key=lambda pose: _far(pose, (2.0, -4.0)))
    assert found.poses["rocker"][first, 2] % (2 * np.pi) == pytest.approx(nearest["rocker"][2] % (2 * np.pi))


def _far(pose, target):
    x, y, theta = pose["rocker"]
    return np.hypot(x + 3 * np.cos(theta) - target[0], y + 3 * np.sin(theta) - target[1])


def test_no_assembly():
    m = read("dead-centre")
    assert assemblies(m, None, np.pi) == []


@pytest.mark.parametrize(("entries", "word"), [({"Z": (1, 2)}, "no point"), ({"theta19": 1.0}, "no variable")])
def test_sketch_of_something_else(entries, word):
    with pytest.raises(MechanismError, match=word):
        solve(sketched(read("four-bar", EXAMPLES), **entries))


def test_start_of_something_else():
    with pytest.raises(MechanismError, match="no link"):
        solve(read("four-bar", EXAMPLES), start={"cranc": (0, 0, 0)})

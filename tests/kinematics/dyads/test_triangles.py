"""A joint between two moving links that is driven inside a loop that moves: solved as a triangle in a moving frame."""

from dataclasses import replace

import numpy as np
import pytest

from folders import TEMPLATES
from judging import judged
from mechsheet import reference
from mechsheet.description import load, loads
from mechsheet.diagnostics import MechsheetError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import rough_poses, sweep
from mechsheet.library import linkage
from within_cases import LOADER, loader


@pytest.mark.ci
@pytest.mark.slow
def test_random_cylinders_between_links_that_move():
    rng = np.random.default_rng(18)
    closed = 0
    for _ in range(4):
        mechanism = loads(loader(rng))
        try:
            equations = solve(mechanism)
        except MechsheetError as error:
            assert "cannot be joined" in str(error) or "lies between" in str(error)  # lengths that do not fit
            continue
        assert [group.kind for group in equations.groups] == ["RRR", "RRR"]
        if closed < 1:
            assert judged(replace(mechanism, driver=replace(mechanism.driver, speed=None, acceleration=None))).agrees
        closed += rates_agree(mechanism, equations)
    assert closed >= 2


def rates_agree(mechanism, equations):
    """Assert that angular velocities and accelerations are the reference's; whether there is a row to judge."""
    values = sweep(mechanism, equations, driver_values(mechanism, dimension_values(mechanism)))
    solution = reference.solve(mechanism, start=rough_poses(mechanism, equations))
    expected = reference.rates(solution)
    for number in (2, 3, 4, 5):
        for name, column in zip(("omega", "alpha"), expected[f"theta1{number}"], strict=True):
            found, calm = values[f"{name}1{number}"], np.abs(expected[f"theta1{number}"][0]) < 1
            rows = solution.exists & calm
            assert np.allclose(found[rows], column[rows], rtol=1e-8, atol=1e-9)
    return bool(solution.exists.any())


@pytest.mark.parametrize("name", ["scissor-lift-between-arms", "stephenson-ii-motor"])
def test_templates(name):
    mechanism = load(TEMPLATES / f"{name}.toml")
    groups = solve(mechanism).groups
    assert len(groups[1].links) > 4  # pair and dyad have become one link
    found = linkage.load(TEMPLATES / f"{name}.toml").solve()
    assert found


def test_the_platform_of_the_lift_is_level_and_as_high_as_its_angle_says():
    found = linkage.load(TEMPLATES / "scissor-lift-between-arms.toml").solve()
    assert np.max(np.abs(found["theta16"])) < 1e-12
    assert np.max(np.abs(found["level"])) < 1e-9
    length = np.hypot(found["K.x"] - found["D.x"], found["K.y"] - found["D.y"])
    assert np.allclose(length, 290 + found["s"], rtol=0, atol=1e-9)
    rate = np.gradient(found["W.y"], found["s"], edge_order=2)
    assert np.allclose(rate[2:-2], found["gain"][2:-2], rtol=5e-3)


@pytest.mark.slow
def test_strokes_of_an_excavator_turn_dipper_and_bucket_as_published():
    """Strokes and angles that the source states of its machine, to its 0.1 mrad."""
    path = TEMPLATES / "excavator.toml"
    found = linkage.load(path).solve()
    assert np.allclose(np.radians(found["gamma"][[0, -1]]), [0.7839, -2.8659], rtol=0, atol=1e-4)
    for length, turned in ((1046, -0.5103), (1556, -2.5848)):
        assembly = {"mode_1": 1, "mode_2": 1, "mode_3": 1}  # the sketch shows another length
        dipper = linkage.load(path, {"l": length, **assembly}).solve()["theta14"]
        against_boom = np.radians(dipper + 10)
        assert np.allclose(np.exp(1j * against_boom), np.exp(1j * turned), rtol=0, atol=1e-4)


def test_either_side_of_the_cylinder_as_the_sketch_has_it():
    """Crank and coupler mirrored at the cylinder: the other assembly, another motion."""
    sizes = {"a1": 70, "a2": 35, "a3": 60, "a4": 56, "closed": 32, "p": 16, "q": 38, "aside": 0}
    text = LOADER.format(**sizes)
    modes = [solve(loads(text.replace("A = [10, 30]", f"A = {place}"))).groups[0].mode_value for place in
             ("[10, 30]", "[50, 10]")]  # fmt: skip
    assert modes == [1, -1]

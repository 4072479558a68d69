"""Sweeps through change points, gaps, turns, and positions that are undetermined."""

from dataclasses import replace

import numpy as np
import pytest
from reference_cases import CASES, EXAMPLES, read

from livesheet.formula.parser import parse_description
from mechsheet.diagnostics import MechanismError
from mechsheet.model import Cartesian, Driver, Joint, Link
from mechsheet.reference import dimension_values, driver_values, residuals, solve, variables, worst
from mechsheet.units import DEG

EVERY = sorted(path.stem for path in CASES.glob("*.toml") if path.stem != "expressions")


@pytest.mark.parametrize("name", EVERY)
def test_every_row_closes(name):
    found = solve(read(name))
    assert np.array_equal(np.isfinite(found.residual), found.exists)
    assert not (found.exists & found.undetermined).any()
    judged, conditions = worst(residuals(found.mechanism, {}, variables(found)))
    assert np.array_equal(np.isfinite(judged), found.exists)
    assert np.nanmax(judged) < 2e-14 * found.size
    assert all(bool(c) == e for c, e in zip(conditions, found.exists, strict=True))
    for pose in found.poses.values():
        steps = np.abs(np.diff(pose[found.exists, 2]))
        assert steps.max(initial=0) <= np.pi + 1e-9


def test_parallelogram_keeps_its_mode_at_the_change_point():
    """Up to 180 degrees the rocker goes with the crank; past it the same mode is the crossed assembly."""
    found = solve(read("parallelogram"))
    assert found.exists.all()
    crank = np.degrees(found.driver)
    rocker = np.degrees(found.poses["rocker"][:, 2])
    together = (crank % 360 <= 180.001) | (crank % 360 > 359.999)
    assert np.abs(rocker - crank)[crank < 181].max() < 1e-8
    assert (np.cos(np.radians(rocker - crank))[together] > 1 - 1e-12).all()
    assert (np.cos(np.radians(rocker - crank))[~together] < 0.97).all()
    flat = np.isclose(crank % 180, 0)
    assert np.abs(found.points["B"][flat, 1]).max() < 1e-13 * 70


@pytest.mark.parametrize(("sketch", "together"), [((100.0, 1.0), True), ((100.0, -1.0), False)])
def test_sketch_tells_modes_apart_in_a_first_row_that_both_share(sketch, together):
    m = read("parallelogram")
    m = replace(m, sketch=replace(m.sketch, points={"B": sketch}), driver=replace(m.driver, start=0.0, stop=np.pi / 2))
    found = solve(m)
    difference = found.poses["rocker"][1:, 2] - found.driver[1:]
    assert (np.abs(difference) < 1e-9).all() == together


def test_undetermined_rows_say_so():
    found = solve(read("rhombus"))
    degrees = np.round(np.degrees(found.driver)).astype(int)
    assert list(degrees[found.undetermined]) == [0, 360]
    assert list(degrees[~found.exists]) == [0, 360]
    assert np.isnan(found.poses["coupler"][found.undetermined]).all()
    slotted = solve(read("slotted-lever"))
    assert list(np.round(np.degrees(slotted.driver[slotted.undetermined]))) == [0, 360]
    assert (slotted.displacements["s"][slotted.exists] > 0).all()


def test_dead_centre_is_a_row_and_beyond_is_none():
    found = solve(read("dead-centre"))
    assert found.exists.tolist() == [True, True, True, True, False, False, False, False, True, True, True]
    assert not found.undetermined.any()
    stretched = found.points["B"][2] - found.points["A"][2]
    assert stretched == pytest.approx([1.6, -1.2], abs=1e-14)
    rows = [0, 1, 9]  # at 270 and 360 degrees lie two more dead centres
    before, outer = found.points["B"][rows] - found.points["A"][rows], [4.0, 0.0] - found.points["A"][rows]
    crossing = outer[:, 0] * before[:, 1] - outer[:, 1] * before[:, 0]
    assert (crossing > 0).all(), "the mode is the same on both sides of the gap"


def test_drag_link_turns_fully():
    found = solve(read("drag-link"))
    assert found.exists.all()
    for link in ("coupler", "follower"):
        angle = found.poses[link][:, 2]
        assert angle[-1] - angle[0] == pytest.approx(-8 * np.pi, abs=1e-12)
        assert np.abs(np.diff(angle)).max() < 0.7
    assert found.poses["crank"][-1, 2] == -8 * np.pi


def test_trammel():
    found = variables(solve(read("trammel")))
    angle = found["theta12"]
    assert np.abs(found["P.x"] - 2 * np.cos(angle)).max() < 1e-14
    assert np.abs(found["P.y"] - 5 * np.sin(angle)).max() < 2e-14
    assert np.abs(found["theta14"]).max() == 0.0
    driven = solve(read("trammel-by-slider"))
    assert np.array_equal(driven.exists, np.abs(driven.driver) <= 3)
    s = driven.driver[driven.exists]
    assert np.abs(driven.displacements["sy"][driven.exists] - np.sqrt(9 - s**2)).max() < 1e-14


def test_scotch_yoke():
    found = variables(solve(read("scotch-yoke")))
    angle, slope = found["theta12"], np.radians(80)
    y = (2 * np.sin(angle) + 1) / np.sin(slope)
    assert np.abs(found["y"] - y).max() < 1e-14
    assert np.abs(found["x"] - (2 * np.cos(angle) - y * np.cos(slope))).max() < 1e-14


def test_one_solution_is_kept_past_parallel_slots():
    """Lines that turn past each other: the sign of the determinant changes, the position is the only one."""
    found = solve(read("turning-slots"))
    parallel = np.isclose(np.sin(found.driver), 0)
    assert np.array_equal(found.exists, ~parallel)
    assert not found.undetermined.any()
    rows = found.exists
    assert np.abs(found.displacements["x"] - 2 / np.tan(np.where(rows, found.driver, 1)))[rows].max() < 1e-13


def test_pin_that_runs_far_away():
    """Hundreds of lengths away, a lever still finds the pin: the rounding of its place is no miss."""
    found = solve(read("far-pin"))
    away = np.array([0.0, 2.0]) + found.displacements["x"][:, None] * [1.0, 0.0] - [1.0, -1.0]
    rows = found.exists
    assert np.array_equal(rows, ~np.isclose(np.sin(found.driver), 0))
    assert np.abs(away[rows]).max() > 300
    assert np.abs(found.displacements["t"] / np.hypot(*away.T) - 1)[rows].max() < 1e-13
    miss = found.poses["lever"][rows, 2] + np.radians(20) - np.arctan2(*away[rows].T[::-1])
    assert np.abs(np.sin(miss)).max() < 1e-13


def test_driven_by_a_cylinder():
    found = solve(read("boom"))
    reach = np.hypot(1.2, 0.1) + np.array([-1, 1]) * np.hypot(1, 0.3)
    assert np.array_equal(found.exists, (found.driver >= abs(reach[0])) & (found.driver <= reach[1]))
    rows = found.exists
    assert np.abs(np.hypot(*(found.points["P"] - [1, -0.3]).T) - found.driver)[rows].max() < 1e-14
    assert (found.points["P"][rows] @ [0.3, 1] > 0).all()
    assert np.abs(found.poses["rod"] - found.poses["barrel"])[rows, 2].max() < 1e-14


def test_driver_between_moving_links():
    found = solve(read("relative-driver"))
    assert np.abs(found.poses["coupler"][:, 2] - found.poses["crank"][:, 2] - found.driver).max() < 1e-13
    forward = replace(found.mechanism, driver=Driver(symbol="theta12", unit=DEG, link="crank", relative_to="ground"))
    start = {link: tuple(pose[0]) for link, pose in found.poses.items()}
    again = solve(forward, start=start, values=found.poses["crank"][:, 2])
    assert again.exists.all()
    assert np.abs(again.points["B"] - found.points["B"]).max() < 1e-7


def test_group_of_class_three_is_followed():
    """A six-link driven from its other end: the positions are those that its easy direction gives."""
    easy = solve(read("stephenson"))
    assert easy.exists.all()
    turning = easy.poses["output"][:, 2]
    assert (np.diff(turning) > 0).all() or (np.diff(turning) < 0).all()
    hard = replace(easy.mechanism, driver=Driver(symbol="theta16", unit=DEG, link="output", relative_to="ground"))
    start = {link: tuple(pose[0]) for link, pose in easy.poses.items()}
    found = solve(hard, start=start, values=turning)
    assert found.exists.all()
    for link, pose in easy.poses.items():
        assert np.abs(found.poses[link] - pose).max() < 1e-9


def test_large_sweep_equals_small_ones():
    """No row depends on the rows around it: each alone is the same, bit for bit apart from the last digits."""
    m = read("six-link-dwell", EXAMPLES)
    whole = solve(m, values=np.linspace(0, 2 * np.pi, 721))
    few = solve(m, values=np.linspace(0, 2 * np.pi, 13))
    assert np.abs(whole.points["D"][::60] - few.points["D"]).max() < 1e-14 * whole.size


def test_dimensions_and_values_replace_those_of_the_model():
    m = read("four-bar", EXAMPLES)
    found = solve(m, {"a1": 65.0}, values=[0.5])
    assert found.dimensions["a1"] == 65.0
    assert found.points["B0"][0] == pytest.approx([65.0, 0.0])
    assert found.driver.tolist() == [0.5]


def test_point_whose_distances_make_no_triangle():
    """Nothing is joined at C: the rows exist, C does not. The alpha1 of the six-link places the ground: no row exists."""
    found = solve(read("four-bar", EXAMPLES), {"b3": 1.0})
    assert found.exists.all()
    assert np.isnan(found.points["C"]).all()
    found = solve(read("six-link-dwell", EXAMPLES), {"A0B0": 1.0})
    assert not found.exists.any()
    assert all(np.isnan(v).all() for k, v in variables(found).items() if k != "theta12")


def test_driver_value_that_is_no_number_is_no_row():
    m = read("fivelink")
    found = solve(
        replace(m, driver=replace(m.driver, values=(parse_description("acos(2)"), 0.5, parse_description("1/0"))))
    )
    assert found.exists.tolist() == [False, True, False]
    m = read("stephenson")
    turned = replace(m, driver=replace(m.driver, link="output", values=(2.5, parse_description("acos(2)"), 2.51)))
    assert not solve(turned).exists[1]


def test_wrong_mobility():
    m = read("fivelink")
    with pytest.raises(MechanismError, match="mobility is not the number of drivers"):
        solve(replace(m, joints=()))


def test_held_twice_and_loose_elsewhere():
    """Two struts hold the crank, a two-link chain hangs loose: the count is right, the structure is not."""
    m = read("four-bar", EXAMPLES)
    brace = Joint("brace", "pin-slot", "crank", "ground", "A", (0.0, 0.0), 0.0, 0.0, "s")
    loose = Link("loose", 5, {"C": Cartesian(0.0, 0.0)})
    with pytest.raises(MechanismError, match="loose"):
        solve(replace(m, links=(*m.links, loose), joints=(brace,)))


def test_driver_values_are_those_asked_for():
    m = read("drag-link")
    assert np.array_equal(solve(m).driver, driver_values(m, dimension_values(m)))

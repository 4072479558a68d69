"""What a cam presses on a link that its motion does not move directly: other links lie between, of every kind of group."""

import re

import numpy as np
import pytest
from test_reactions import sines, weighed

from chosen import part
from driven_by_cams import driven_by_cam
from mechsheet import reference
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.sweep import rough_poses, sweep
from random_cams import cam, loaded
from random_mechanisms import Grower

STEEP, DEAD = 0.02, 1e-3
"""No digit is asked for where the cosine of the pressure angle is less, or the sine at which a group is driven."""

CHAINS = ("stephenson-ii-class-iv", "double-butterfly", "planar-3rpr")
DRIVEN_PAIRS = ("stephenson-ii-motor", "cylinder-boom", "scissor-lift-between-arms", "quick-return-lever")
GEARS = ("geared-five-bar", "rack-slider", "sun-and-planet")
DYADS = ("shaper", "klann", "oldham", "six-bar-r-rrr-rrt", "double-parallelogram", "toggle-press")


def swept(text):
    mechanism = loads(text)
    equations, dimensions = solve(mechanism), dimension_values(mechanism)
    return mechanism, equations, sweep(mechanism, equations, given_values(mechanism, dimensions))


def compared(text):
    """The largest difference from the reference, as a part of the column's size; how many rows, how many columns."""
    mechanism, equations, found = swept(text)
    solution = reference.solve(mechanism, start=rough_poses(mechanism, equations))
    known = reference.further(solution)
    rows = solution.exists & (sines(equations, found) > DEAD) & (np.abs(np.cos(known["alpha"])) > STEEP)
    known[equations.efforts[1]] = known[equations.efforts[0]]
    worst, names = 0.0, (*equations.shown_forces, equations.efforts[1], *mechanism.cam.symbols)
    for name in names if rows.any() else ():
        ours, theirs = found[name][rows], known[name][rows]
        assert np.array_equal(np.isnan(ours), np.isnan(theirs)), name
        there = np.isfinite(theirs)
        largest = max(np.max(np.abs(known[each][rows][there]), initial=0.0) for each in names if each[0] == name[0])
        worst = max(worst, np.max(np.abs(ours - theirs)[there] / (1e-3 + largest), initial=0.0))
    return worst, np.sum(rows), len(names)


def press(text):
    """The press with the ram's motion given, a load and a spring on the ram, masses; the roller stays on the bell crank."""
    text = text.replace("[links.ram]\n", '[links.ram]\nmass = 5\ncenter = "E"\n')
    text = text.replace("[links.rod]\n", "[links.rod]\nmass = 1\ncenter = [50, 3]\ninertia = 0.002\n")
    text = text.replace('link = "ram"\non', 'name = "slide"\nlink = "ram"\non')
    text = text.replace('[driver]\nlink = "crank"\n', '[driver]\njoint = "slide"\nstart = 113.14452277867852\n')
    text = text.replace("by = -25", "by = 30").replace("E = [160, -100]", "C = [30, 48]\nD = [170, 6]")
    return (
        text
        + """
[dynamics]
gravity = 9.81
[[loads]]
link = "ram"
point = "E"
force = [0, 300]
[[loads]]
name = "K"
between = ["G", "E"]
stiffness = 2
free_length = 40
"""
    )


@pytest.fixture
def ram():
    return press(template_text("cam-linkage"))


@pytest.mark.cases(4)
@pytest.mark.parametrize("seed", part(range(60), 6))
def test_behind_random_dyads_it_is_the_references(seed):
    """One to three dyads of any kind, masses, loads, often a spring with a damper; every other one has a face."""
    text = weighed(driven_by_cam(Grower(seed, 1 + seed % 3).text(), seed, seed % 2 == 1), seed)
    worst, _, columns = compared(text)
    assert columns > 10
    assert worst < 1e-9


@pytest.mark.slow
@pytest.mark.cases(5)
@pytest.mark.parametrize("face", [False, True], ids=["roller", "face"])
@pytest.mark.parametrize("name", [*CHAINS, *DRIVEN_PAIRS, *GEARS, *DYADS])
def test_behind_chains_gears_and_driven_pairs_it_is_the_references(name, face):
    text = weighed(driven_by_cam(template_text(name), 1, face), 3)
    worst, rows, _ = compared(text)
    assert rows > 10
    assert worst < 1e-8


@pytest.mark.parametrize("seed", part(range(20), 3))
def test_a_roller_on_a_coupler(seed):
    worst, rows, _ = compared(loaded(cam(seed, "coupler")))
    assert rows > 60
    assert worst < 1e-11


def test_a_press_whose_ram_is_to_move_by_the_law(ram):
    worst, rows, _ = compared(ram)
    assert rows == 73
    assert worst < 1e-11


@pytest.mark.slow
def test_power_in_is_power_out(ram):
    """The cam's torque, and what its force does on the bell crank, is how fast the energy of all the rest changes."""
    mechanism = loads(ram)
    equations = solve(mechanism)
    phi = np.radians(np.arange(0.0, 360.0, 0.05))
    found = sweep(mechanism, equations, {"phi": phi})
    speed = 2 * np.pi  # 60 rpm
    gx, gy = (np.gradient(found[f"G3.{axis}"], phi) * speed / 1000 for axis in "xy")
    moving = (5 * found["y.v"] ** 2 / 1e6 + gx**2 + gy**2 + 0.002 * found["omega13"] ** 2) / 2
    lifted = (5 * 9.81 * found["E.y"] + 9.81 * found["G3.y"] - 300 * found["E.y"]) / 1000
    strained = 2 * (np.hypot(found["E.x"] - 160, found["E.y"]) - 40) ** 2 / 2 / 1000
    power = np.gradient(moving + lifted + strained, phi)
    inner = slice(5, -5)
    assert np.max(np.abs(found["T15"] - power)[inner]) < 2e-4 * np.max(np.abs(power))
    pressed = found["N"] * found["lever"] * found["y.d"] / 1000
    assert np.max(np.abs(pressed - found["T15"])) < 1e-10
    reach = np.hypot(found["V_x"], found["V_y"]) * np.cos(found["alpha"])
    assert np.max(np.abs(np.abs(found["lever"]) - reach)) < 1e-12  # N is the effort over cos alpha and the way


def test_where_it_lifts_off_and_the_spring_that_holds(ram):
    """Pulled down by 120 N the ram wants to leave in a part of the turn; a spring that is shorter by the column's least
    length just keeps it there."""
    text = ram.replace("force = [0, 300]", "force = [0, -120]")
    _, _, found = swept(text)
    assert np.min(found["N"]) < 0 < np.max(found["N"])
    needed = float(np.min(found["K.hold"]))  # the ram hangs on the spring: the shorter the more it presses
    for more, holds in ((-1e-6, True), (1e-6, False)):
        _, _, changed = swept(text.replace("free_length = 40", f"free_length = {needed + more!r}"))
        assert (np.min(changed["N"]) >= 0) == holds


def test_no_force_where_the_cam_could_not_move_the_link():
    """A cam about the pivot of the link that it presses on: the normal goes through the pivot."""
    text = template_text("four-bar")
    text = weighed(driven_by_cam(text, 1), 3)
    locked = re.sub(r'center = "CAM"', 'center = "B0"', text)
    mechanism, _, found = swept(locked)
    assert mechanism.cam.point in next(
        link.points for link in mechanism.links if "B0" in link.points and link.number > 1
    )
    assert np.isnan(found["N"]).all()
    assert np.isfinite(swept(text)[2]["N"]).all()


def test_a_dwell_has_a_pressure_angle_and_a_force(ram):
    """While the ram waits below, the cam bears what the load and the spring press, though nothing moves."""
    _, _, found = swept(ram)
    waits = (found["phi"] > np.radians(121)) & (found["phi"] < np.radians(179))
    assert np.ptp(found["y"][waits]) == 0
    assert np.max(np.abs(found["theta12.d"][waits])) == 0
    assert np.isfinite(found["alpha"][waits]).all()
    assert np.ptp(found["N"][waits]) < 1e-9 * np.max(np.abs(found["N"][waits]))
    assert np.max(np.abs(found["T15"][waits])) < 1e-9

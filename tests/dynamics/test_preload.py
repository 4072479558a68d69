"""What a cam presses on its follower, and the spring that holds the two together."""

import math

import numpy as np
import pytest

from mechsheet import reference
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.sweep import rough_poses, sweep


def swept(mechanism):
    equations, dimensions = solve(mechanism), dimension_values(mechanism)
    return equations, dimensions, sweep(mechanism, equations, given_values(mechanism, dimensions))


def valve(speed=3000, free_length=48.0):
    text = template_text("cam-valve")
    text = text.replace("value = 3000", f"value = {speed}").replace("value = 48", f"value = {free_length}")
    return swept(loads(text))[1:]


def test_valve_train_by_newtons_law():
    """N = k (l0 - l1 + lift) + m a, the torque N s', and what the side of the face asks of the guide."""
    dimensions, found = valve()
    lift, speed = found["s"] - dimensions["rb"], 3000 * math.pi / 30
    inertia = 0.12 * found["s.dd"] * speed**2 / 1000
    by_hand = 25 * (48 - 40 + lift) + inertia
    assert np.max(np.abs(found["N"] - by_hand)) < 1e-10
    assert found["N"][-1] == pytest.approx(200)  # the valve is closed
    assert np.max(np.abs(found["T13"] - by_hand * found["s.d"] / 1000)) < 1e-12
    assert np.max(np.abs(np.abs(found["F12.c"]) - np.abs(found["T13"]))) < 1e-12
    assert np.max(np.abs(25 * (found["K.hold"] - 40 + lift) + inertia)) < 1e-10


def test_the_spring_that_holds_it_just_holds_it():
    """At 4000 rpm the tappet leaves the cam; with the largest of the column it touches everywhere, with less it does not."""
    _, found = valve(4000)
    assert min(found["N"]) < -10
    needed = max(found["K.hold"])
    for more, holds in ((1e-6, True), (-1e-6, False)):
        _, changed = valve(4000, needed + more)
        assert (min(changed["N"]) >= 0) == holds


def test_side_thrust_of_a_slide():
    """Pressed down with 300 N, the roller is held by 300/cos alpha, the guide by 300 tan alpha."""
    text = template_text("cam-slide")
    _, _, found = swept(loads(text + '\n[[loads]]\nlink = "follower"\npoint = "C"\nforce = [0, -300]\n'))
    assert np.max(np.abs(found["N"] - 300 / np.cos(found["alpha"]))) < 1e-9
    assert np.max(np.abs(np.abs(found["F12.n"]) - 300 * np.abs(np.tan(found["alpha"])))) < 1e-9
    assert np.max(np.abs(found["F13"] - found["N"])) < 1e-9  # the cam's bearing holds the same force


def test_a_cam_that_drives_a_press():
    """The cam's torque, and the roller's force on the bell crank, do the work of the ram's load."""
    text = template_text("cam-linkage")
    mechanism = loads(text + '\n[[loads]]\nlink = "ram"\npoint = "E"\nforce = [0, 800]\n')
    equations, dimensions, found = swept(mechanism)
    known = reference.further(reference.solve(mechanism, dimensions, start=rough_poses(mechanism, equations)))
    work = -0.8 * found["y.d"] * -1  # the ram goes down with y
    assert np.max(np.abs(found["T15"] - work)) < 1e-9
    pressed = found["N"] * 0.085 * np.cos(found["alpha"]) * found["theta12.d"]
    assert np.max(np.abs(np.abs(pressed) - np.abs(work))) < 1e-9
    for name in equations.shown_forces:
        assert np.max(np.abs(found[name] - known[name])) < 1e-9, name

"""A mechanism turned, moved or seen in a mirror has the same rates and forces, turned or mirrored with it."""

import numpy as np
import pytest

from mechsheet.description import loads
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.sweep import sweep

FORCES = ("F12", "F14", "F23", "F34")


def pair(vector):
    return f"[{float(vector.real)!r}, {float(vector.imag)!r}]"


def described(turn=0.0, origin=0j, mirrored=False):
    """A four-bar with a slider on its rocker's end: masses, gravity, a force, a torque, a spring; turned and moved so."""
    sign = -1 if mirrored else 1
    turned = np.exp(1j * turn)

    def at(place):
        return origin + turned * (np.conj(place) if mirrored else place)

    def along(vector):
        return turned * (np.conj(vector) if mirrored else vector)

    angle = float(np.degrees(turn))
    return f"""
format = 1
[mechanism]
name = "turned"
[links.ground]
points = {{ A0 = {pair(at(0))}, B0 = {pair(at(70 + 10j))}, E = {pair(at(120 - 20j))} }}
[links.crank]
points = {{ A0 = [0, 0], A = [30, 0] }}
mass = 0.5
center = [10, {sign * 4}]
[links.coupler]
points = {{ A = [0, 0], B = [62, 0], C = [30, {sign * 25}] }}
mass = 1.2
center = "C"
inertia = 8e-4
[links.rocker]
points = {{ B0 = [0, 0], B = [56, 0], D = [40, {sign * 20}] }}
mass = 0.8
center = [28, 0]
inertia = 5e-4
[links.rod]
points = {{ D = [0, 0], Q = [150, 0] }}
mass = 0.4
center = [75, 0]
[links.ram]
points = {{ Q = [0, 0] }}
mass = 2.5
[[joints]]
type = "prismatic"
link = "ram"
on = "ground"
point = "Q"
through = "E"
angle = {angle!r}
orientation = 0
[driver]
link = "crank"
start = {angle!r}
stop = {angle + sign * 345!r}
step = {sign * 15}
speed = {sign * 6.5}
acceleration = {sign * -3.0}
[dynamics]
gravity = {pair(along(0.7 - 9.81j))}
[[loads]]
link = "coupler"
point = "C"
force = {pair(along(40 - 25j))}
[[loads]]
link = "rocker"
torque = {sign * 1.5}
[[loads]]
name = "K"
between = ["C", "E"]
stiffness = 0.8
free_length = 60
[assembly]
B = {pair(at(55 + 60j))}
Q = {pair(at(210 - 20j))}
"""


def solved(text):
    mechanism = loads(text)
    equations = solve(mechanism)
    return sweep(mechanism, equations, driver_values(mechanism, dimension_values(mechanism)))


@pytest.fixture(scope="module")
def upright():
    return solved(described())


def force(values, name):
    return values[f"{name}.x"] + 1j * values[f"{name}.y"]


@pytest.mark.parametrize(
    ("turn", "origin", "mirrored"),
    [(0.0, 35 - 80j, False), (2.1, 0j, False), (-1.2, 14 + 5j, False), (0.0, 0j, True), (0.9, -60 + 33j, True)],
)
def test_forces_turn_with_the_mechanism(upright, turn, origin, mirrored):
    values = solved(described(turn, origin, mirrored))
    sign = -1 if mirrored else 1
    size = np.nanmax(np.abs(upright["T12"]))
    assert np.isfinite(upright["T12"]).all()
    assert values["T12"] == pytest.approx(sign * upright["T12"], abs=1e-10 * size)
    for name in FORCES:
        ours = force(upright, name)
        ours = np.exp(1j * turn) * (np.conj(ours) if mirrored else ours)
        assert np.abs(force(values, name) - ours).max() < 1e-10 * np.abs(ours).max(), name
    for name in ("omega13", "alpha13", "omega14", "alpha14", "omega15", "alpha15"):
        assert values[name] == pytest.approx(sign * upright[name], abs=1e-11 * np.abs(upright[name]).max()), name
    for name in ("s16.v", "s16.a"):
        assert values[name] == pytest.approx(upright[name], abs=1e-11 * np.abs(upright[name]).max()), name
    slide = next(name for name in upright if name.startswith("F16") and name.endswith(".n"))
    assert values[slide] == pytest.approx(sign * upright[slide], abs=1e-9 * np.abs(upright[slide]).max())

"""Power, shaking force and the motion of mass centres, where somebody asks for them."""

import numpy as np
import pytest

from in_line import IN_LINE
from mechsheet import loads, reference
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.sweep import sweep

ASKED = (
    "power",
    "shaking.x",
    "shaking.y",
    "shaking.m",
    "G2.x",
    "G2.vx",
    "G2.v",
    "G3.y",
    "G3.vy",
    "G3.v",
    "G3.ax",
    "G3.a",
)
MASSES = {
    "crank": "mass = 1.1\ncenter = [20, 5]\ninertia = 3e-4",
    "rod": "mass = 0.7\ncenter = [90, 6]\ninertia = 2e-3",
}


def moving(masses, asked=ASKED):
    text = IN_LINE.replace("step = 15", "step = 15\nspeed = 12\nacceleration = 5")
    for link, keys in masses.items():
        text = text.replace(f"[links.{link}]", f"[links.{link}]\n{keys}")
    charts = (asked[start : start + 8] for start in range(0, len(asked), 8))
    return text + "".join(f'[[charts]]\nx = "theta12"\ny = {list(names)}\n' for names in charts)


def solved(text):
    mechanism = loads(text)
    equations = solve(mechanism)
    driver = driver_values(mechanism, dimension_values(mechanism))
    return mechanism, equations, sweep(mechanism, equations, driver)


def test_they_are_what_momentum_and_energy_say():
    mechanism, equations, values = solved(moving(MASSES | {"piston": "mass = 0.9"}))
    theirs = reference.further(reference.solve(mechanism))
    assert {*ASKED} <= {equation.symbol for equation in equations.columns}
    for name in ASKED:
        scale = np.max(np.abs(theirs[name]))
        assert values[name] == pytest.approx(theirs[name], abs=1e-12 * scale), name
    assert values["power"] == pytest.approx(values["T12"] * 12, rel=1e-12)
    # all that holds the links is inertia, so the ground carries nothing else
    assert values["shaking.x"] == pytest.approx(-values["F12.x"], abs=1e-9)
    pins = values["F12.y"] + values["F14.n"]
    assert values["shaking.y"] == pytest.approx(-pins, abs=1e-9)


def test_a_balanced_crank_shakes_nothing():
    _, _, values = solved(moving({"crank": "mass = 3\ncenter = [0, 0]\ninertia = 0.5"}, ASKED[:4]))
    assert not np.any(values["shaking.x"])
    assert values["shaking.m"] == pytest.approx(np.full(25, -0.5 * 5))


def test_only_what_is_asked_for_and_names_of_ones_own_come_first():
    _, equations, _ = solved(moving(MASSES, ("T12",)))
    assert not equations.forces("whole", "center")
    own = moving(MASSES, ("power",)) + '[outputs.power]\nformula = "2*T12*omega12"\nunit = "W"\n'
    _, equations, values = solved(own)
    assert not equations.forces("whole")
    assert values["power"] == pytest.approx(2 * 12 * values["T12"])

"""Gears, belts, racks and further drivers against closed forms, and in random linkages against the reference."""

import math

import numpy as np
import pytest

from chosen import part
from judging import judged
from mechsheet import reference
from mechsheet.description import loads
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep

FIVE_BAR = """
format = 1
mechanism = {{ name = "five-bar", length_unit = "m" }}
[links.ground]
points = {{ A0 = [{x1!r}, 0], B0 = [{x2!r}, 0] }}
[links.left]
points = {{ A0 = [0, 0], A = [{a!r}, 0] }}
[links.left-rod]
points = {{ A = [0, 0], P = [{b!r}, 0] }}
[links.right-rod]
points = {{ B = [0, 0], P = [{c!r}, 0] }}
[links.right]
points = {{ B0 = [0, 0], B = [{u!r}, 0] }}
{rest}
"""

NORTON = {"x1": 0.0, "x2": 3.0, "a": 5.0, "b": 7.0, "c": 8.0, "u": 4.0}
"""Norton, Design of Machinery, problem 4-4: f 3, a 5, b 7, c 8, d 4."""

TRAIN = """
format = 1
mechanism = { name = "train" }
dimensions = { zs = { value = 20, unit = "1" }, zp = { value = 15, unit = "1" } }
links.ground.points = { O = [0, 0] }
links.sun.points = { O = [0, 0] }
links.planet.points = { A = [0, 0], P = [10, 0] }
links.arm.points = { O = [0, 0], A = [50, 0] }
joints = [
    { type = "gear", link = "planet", on = "sun", arm = "arm", ratio = "-zs/zp", phase = 7 },
    { type = "gear", link = "planet", on = "ground", arm = "arm", ratio = "(zs+2*zp)/zp", phase = 7 },
]
driver = { link = "sun", start = 0, stop = 720, step = 40 }
"""


def positions(text):
    mechanism = loads(text)
    return sweep(mechanism, solve(mechanism), driver_values(mechanism, dimension_values(mechanism)))


@pytest.mark.parametrize(("mode", "rods"), [("P = [10, 6]", (17.6, 64.0)), ("P = [-1.3, -1.5]", (-133.7, 180.0))])
def test_geared_five_bar_of_the_text(mode, rods):
    gear = '[[joints]]\ntype = "gear"\nlink = "right"\non = "left"\nratio = -0.5\nphase = 0\n'
    drive = f'[driver]\nlink = "left"\nvalues = [45]\n[assembly]\n{mode}\n'
    found = positions(FIVE_BAR.format(**NORTON, rest=gear + drive))
    angles = [math.degrees(found[name][0]) for name in ("theta13", "theta14")]
    assert np.remainder(np.subtract(angles, rods) + 180, 360) - 180 == pytest.approx(0, abs=0.07)


def test_epicyclic_train_driven_by_its_sun():
    """Willis: the arm turns zs / (zs + zr) as fast as the sun, the planet so that it rolls on the ring."""
    found = positions(TRAIN)
    sun, arm = found["theta12"], found["theta14"]
    assert arm == pytest.approx(sun * 20 / 70, abs=1e-12)
    assert found["theta13"] - arm == pytest.approx(math.radians(7) - 50 / 15 * arm, abs=1e-12)


def test_both_drivers_of_a_robot():
    """A public example: both motors given, the tool at (0, 0.3)."""
    rest = (
        '[driver]\nlink = "left"\nvalues = ["0.52040625"]\n[[drivers]]\nlink = "right"\nvalues = ["1.30998849"]\n'
        "[assembly]\nP = [0, 0.3]\n"
    )
    found = positions(FIVE_BAR.format(x1=-0.125, x2=0.125, a=0.205, b=0.205, c=0.205, u=0.205, rest=rest))
    assert (found["P.x"][0], found["P.y"][0]) == pytest.approx((0, 0.3), abs=1e-8)


def random_five_bar(seed):
    """A five-bar with a gear, a belt, or a second driver of one of the three ways; some rows do not exist."""
    random = np.random.default_rng(seed)
    sizes = {"x1": 0.0, "x2": random.uniform(2, 6), "a": random.uniform(1, 3), "u": random.uniform(1, 3)}
    sizes |= {"b": random.uniform(4, 8), "c": random.uniform(4, 8)}
    phase, ratio = random.uniform(-180, 180), random.choice([-2.0, -1.0, -0.5, 0.7, 1.5, 3.0])
    start, rows = random.uniform(0, 360), 9
    values = [float(value) for value in np.cumsum(random.uniform(5, 20, rows))]
    ways = [
        f'[[joints]]\ntype = "gear"\nlink = "right"\non = "left"\nratio = {ratio}\nphase = {phase!r}\n',
        f'[[joints]]\ntype = "belt"\nlink = "right"\non = "left"\nratio = {ratio}\nphase = {phase!r}\n',
        f'[[drivers]]\nlink = "right"\nvalues = {values}\n',
        f'[[drivers]]\nlink = "right"\nfollows = "{abs(ratio)}*theta12 + sin(theta12) + {phase / 60!r}"\n',
        f'[[drivers]]\nlink = "right"\nvalue = {phase!r}\n',
    ]
    drive = f'[driver]\nlink = "left"\nstart = {start!r}\nstop = {start + 40 * (rows - 1)!r}\nstep = 40\n'
    return FIVE_BAR.format(**{key: float(value) for key, value in sizes.items()}, rest=ways[seed % 5] + drive)


@pytest.mark.cases(10)
@pytest.mark.parametrize("seed", range(20))
def test_random_ties_against_the_reference(seed):
    mechanism = loads(random_five_bar(seed))
    try:
        solve(mechanism)
    except MechanismError:
        pytest.skip("closes nowhere")
    comparison = judged(mechanism)
    assert comparison.agrees and comparison.worst < 1e-9, comparison


@pytest.mark.parametrize("kind", ["gear", "belt"])
def test_wheels_turn_on_and_on(kind):
    """Angles of wheels pass many turns, and are shown so."""
    text = TRAIN.replace('"gear", link = "planet", on = "sun"', f'"{kind}", link = "planet", on = "sun"')
    assert positions(text)["theta13"][-1] == pytest.approx(math.radians(7) - 35 / 15 * 720 * 20 / 70 * math.pi / 180)


def test_rates_of_a_second_driver_by_the_chain_rule():
    rest = (
        '[driver]\nlink = "left"\nstart = 80\nstop = 105\nstep = 5\nspeed = 2\nacceleration = 3\n'
        '[[drivers]]\nlink = "right"\nfollows = "pi - theta12 + 0.2*sin(2*theta12)"\n[assembly]\nP = [0, 0.3]\n'
        '[outputs]\nq = { formula = "theta13.d", unit = "1" }\n'
    )
    mechanism = loads(FIVE_BAR.format(x1=-0.125, x2=0.125, a=0.205, b=0.205, c=0.205, u=0.205, rest=rest))
    found = sweep(mechanism, solve(mechanism), driver_values(mechanism, {}))
    theirs = reference.rates(reference.solve(mechanism))
    for name, tail in (("theta13", "13"), ("theta14", "14"), ("theta15", "15")):
        once, twice = theirs[name]
        assert found[f"omega{tail}"] == pytest.approx(2 * once, rel=1e-9)
        assert found[f"alpha{tail}"] == pytest.approx(4 * twice + 3 * once, rel=1e-8, abs=1e-9)


SUN_AND_PLANET = """
format = 1
mechanism = {{ name = "sun-and-planet" }}
links.ground.points = {{ O = [0, 0], P = [{px!r}, {py!r}] }}
links.sun.points = {{ O = [0, 0], M = [60, 0] }}
links.arm.points = {{ O = [0, 0], A = [{arm!r}, 0] }}
links.rod.points = {{ A = [0, 0], B = [{rod!r}, 0] }}
links.beam.points = {{ P = [0, 0], B = [{beam!r}, 0] }}
joints = [{{ type = "{kind}", link = "rod", on = "sun", arm = "arm", ratio = {ratio}, phase = {phase!r} }}]
driver = {{ link = "{driven}", {rows} }}
[assembly]
A = [{ax!r}, {ay!r}]
B = [0, 900]
"""
"""Watt's: the planet is fixed to the connecting rod. Driven at the sun, arm, rod and beam must be found all at once."""

WATT = {"px": -800, "py": 900, "arm": 200, "rod": 1000, "beam": 800, "kind": "gear", "ratio": -1, "phase": 8.0,
        "ax": 100.0, "ay": 173.0}  # fmt: skip


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("kind", ["gear", "belt"])
def test_a_gear_inside_a_group_against_the_closed_form(kind):
    """Driven at its arm it is a four-bar and a gear behind it; driven at the sun it reads that motion backwards."""
    own = WATT | {"kind": kind}
    closed = positions(SUN_AND_PLANET.format(**own, driven="arm", rows="start = 60, stop = 420, step = 5"))
    sun = np.degrees(closed["theta12"])
    text = SUN_AND_PLANET.format(**own, driven="sun", rows=f"values = {sun.tolist()}")
    (group,) = solve(loads(text)).groups
    assert group.system is not None
    found = positions(text)
    for name in ("theta13", "theta14", "theta15"):
        assert np.remainder(found[name] - closed[name] + np.pi, math.tau) - np.pi == pytest.approx(0, abs=1e-12), name


@pytest.mark.cases(1)
@pytest.mark.slow
@pytest.mark.parametrize("seed", part(range(40), 8))
def test_random_gears_inside_groups_against_the_reference(seed):
    random = np.random.default_rng(seed)
    arm, beam = random.uniform(150, 250), random.uniform(700, 900)
    own = WATT | {"arm": float(arm), "beam": float(beam), "ratio": float(random.uniform(-2, -0.5)),
                  "phase": float(random.uniform(-20, 20)), "kind": ("gear", "belt")[seed % 2]}  # fmt: skip
    start = float(random.uniform(0, 90))
    rows = f"start = {start!r}, stop = {start + 23 * 8!r}, step = 8"
    try:
        comparison = judged(loads(SUN_AND_PLANET.format(**own, driven="sun", rows=rows)))
    except MechanismError as error:
        assert "cannot be joined" in str(error) or "lies between" in str(error) or "too large" in str(error)
        pytest.skip("no such sun-and-planet")
    assert comparison.agrees and comparison.worst < 1e-9, comparison


ROLLING = """
format = 1
mechanism = {{ name = "rolling-wheel" }}
links.ground.points = {{ A0 = [0, 0] }}
links.crank.points = {{ A0 = [0, 0], A = [{a!r}, 0] }}
links.rod.points = {{ A = [0, 0], E = [{b!r}, 0] }}
links.wheel.points = {{ C = [0, 0], E = [{e!r}, 0] }}
links.carriage.points = {{ C = [0, 0] }}
joints = [
    {{ type = "prismatic", name = "way", link = "carriage", on = "ground", point = "C", through = [0, 12], symbol = "s" }},
    {{ type = "rack", joint = "way", link = "wheel", arm = "carriage", radius = {r!r}, phase = {phase!r} }},
]
driver = {{ {driven}, {rows} }}
[assembly]
A = [{ax!r}, {ay!r}]
"""
"""A wheel that rolls on a rack, pushed at an eccentric pin. Driven at the crank it must be found all at once."""

WHEEL = {"a": 30.0, "b": 130.0, "e": 20.0, "r": -40.0, "phase": 140.0, "ax": 20.0, "ay": 20.0}

RACK_ROD = """
format = 1
mechanism = {{ name = "rack-and-rod" }}
links.ground.points = {{ A0 = [0, 0], B0 = [{x!r}, 0] }}
links.crank.points = {{ A0 = [0, 0], A = [{a!r}, 0] }}
links.rod.points = {{ A = [0, 0] }}
links.block.points = {{ B0 = [0, 0] }}
links.pinion.points = {{ B0 = [0, 0], C = [0, 20] }}
joints = [
    {{ type = "prismatic", name = "rack", link = "block", on = "rod", point = "B0", through = "A", symbol = "s" }},
    {{ type = "rack", joint = "rack", link = "pinion", arm = "block", radius = {r!r}, phase = {phase!r} }},
]
driver = {{ {driven}, {rows} }}
[assembly]
A = [{ax!r}, {ay!r}]
"""
"""A rod with teeth slides in a block on the axis of a pinion. Driven at the pinion it must be found all at once."""

LONG = {"x": 100.0, "a": 120.0, "r": 15.0, "phase": 90.0, "ax": 90.0, "ay": 80.0}
RODS = {"x": 100.0, "a": 30.0, "r": 15.0, "phase": 90.0, "ax": 21.0, "ay": 21.0}


@pytest.mark.parametrize(
    ("text", "own", "driven", "rows", "back", "names"),
    [
        (ROLLING, WHEEL, 'joint = "way"', "start = 120, stop = 138, step = 1", "crank", ("theta13", "theta14", "s")),
        (RACK_ROD, RODS, 'link = "crank"', "start = 30, stop = 170, step = 5", "pinion", ("theta12", "theta13", "s")),
        (RACK_ROD, LONG, 'link = "crank"', "start = 30, stop = 180, step = 10", "pinion", ("theta12", "s")),
    ],
)
def test_a_rack_inside_a_group_against_the_closed_form(text, own, driven, rows, back, names):
    """Driven at one end it has a closed form, driven at the other it reads that motion backwards."""
    forth = text.format(**own, driven=driven, rows=rows)
    closed = positions(forth)
    symbol = next(link.angle_symbol for link in loads(forth).links if link.name == back)
    there = text.format(**own, driven=f'link = "{back}"', rows=f"values = {np.degrees(closed[symbol]).tolist()}")
    (group,) = solve(loads(there)).groups
    assert group.system is not None
    found = positions(there)
    for name in names:
        gap = found[name] - closed[name]
        gap = gap if name == "s" else np.remainder(gap + np.pi, math.tau) - np.pi
        assert gap == pytest.approx(0, abs=1e-9 if name == "s" else 1e-11), name


@pytest.mark.slow
@pytest.mark.parametrize("seed", part(range(40), 6))
def test_random_racks_inside_groups_against_the_reference(seed):
    random = np.random.default_rng(seed)
    text, own, driven = ((ROLLING, WHEEL, "crank"), (RACK_ROD, RODS, "pinion"), (RACK_ROD, LONG, "pinion"))[seed % 3]
    own = own | {name: float(own[name] * random.uniform(0.9, 1.1)) for name in ("a", "r", "phase")}
    start = float(random.uniform(20, 90))
    rows = f"start = {start!r}, stop = {start + 7 * 5!r}, step = 5"
    try:
        comparison = judged(loads(text.format(**own, driven=f'link = "{driven}"', rows=rows)))
    except MechanismError as error:
        assert "cannot be joined" in str(error) or "lies between" in str(error) or "too large" in str(error)
        pytest.skip("no such rack")
    assert comparison.agrees and comparison.worst < 1e-9, comparison

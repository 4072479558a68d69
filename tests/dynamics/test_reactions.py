"""Joint forces from the equations: against all reactions at once, against closed forms by hand, and against each other."""

import re

import numpy as np
import pytest

from chosen import ALL, LISTED, but, some
from folders import TEMPLATE_FILES
from in_line import IN_LINE
from mechsheet import reference
from mechsheet.description import loads
from mechsheet.diagnostics import MechsheetError
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.dyads.solved import DEAD
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.sweep import rough_poses, sweep
from random_mechanisms import Grower


def weighed(text, seed, static=False):
    """A description with random masses and loads on all its links, in the layout that has forces."""
    random = np.random.default_rng(seed)
    text = re.sub(r"(?m)^layout *=.*$", "", text)
    links, cam, besides = text.partition("\n[cam]\n")  # whose centre stays
    text = (
        re.sub(r"(?m)^(mass|center|inertia) *=.*$", "", links) + cam + besides
    )  # its own go: the layouts are what is wanted
    others = "loads|dynamics|flywheel|outputs|summary|tolerance|charts|tables|exercise|study"
    text = re.sub(rf"(?ms)^\[\[?({others})\]\]?$.*?(?=^\[|\Z)", "", text)
    mechanism = loads(text)
    if not static:
        text = re.sub(r"(?m)^(speed|acceleration) *=.*$", "", text)
        text = re.sub(r"(?m)^\[driver\]", "[driver]\nspeed = 2.5\nacceleration = -1.7", text)
    size = 60.0
    extra = "[dynamics]\ngravity = [0.4, -9.81]\n" if mechanism.length_unit in ("mm", "cm", "m") else ""
    for link in mechanism.links[1:]:
        if mechanism.cam and link.name == mechanism.cam.link:
            continue  # which no heading describes
        heading = rf'(?m)^\[links\.(?:{re.escape(link.name)}|"{re.escape(link.name)}")\]'
        assert re.search(heading, text), link.name
        keys = ""
        if random.random() < 0.75:
            place = np.round(random.uniform(-size, size, 2), 2).tolist()
            center = f'"{random.choice(list(link.points))}"' if link.points and random.random() < 0.3 else str(place)
            keys = f"\nmass = {random.uniform(0.2, 3):.3f}\ncenter = {center}"
            keys += f"\ninertia = {random.uniform(1e-4, 2e-3):.2e}" if random.random() < 0.7 else ""
        text = re.sub(heading, lambda found, keys=keys: found.group() + keys, text)
        if random.random() < 0.5:
            place = np.round(random.uniform(-size, size, 2), 2).tolist()
            force = np.round(random.uniform(-90, 90, 2), 2).tolist()
            frame = random.choice(["ground", "link"])
            extra += f'[[loads]]\nname = "W{link.number}"\nlink = "{link.name}"\n'
            extra += f'point = {place}\nforce = {force}\nframe = "{frame}"\n'
        if random.random() < 0.4:
            extra += f'[[loads]]\nname = "V{link.number}"\nlink = "{link.name}"\ntorque = {random.uniform(-3, 3):.2f}\n'
    owners = {point: link.name for link in reversed(mechanism.links) for point in link.points}
    if random.random() < 0.6:
        one, other = random.choice(list(owners), 2, replace=False)
        if owners[one] != owners[other]:
            extra += (
                f'[[loads]]\nname = "K"\nbetween = ["{one}", "{other}"]\nstiffness = {random.uniform(0.1, 2):.2f}\n'
            )
            extra += f"free_length = {random.uniform(10, 90):.1f}\ndamping = {random.uniform(0, 0.05):.3f}\n"
    return text + "\n" + extra


def solved(text):
    mechanism = loads(text)
    equations = solve(mechanism)
    driver = driver_values(mechanism, dimension_values(mechanism))
    return mechanism, equations, driver, sweep(mechanism, equations, driver)


def sines(equations, values):
    """Row by row the least sine of the angle at which a group is driven."""
    found = np.ones(len(next(iter(values.values()))))
    for equation in equations.columns:
        for condition in equation.exists if equation.role == "coefficient" else ():
            found = np.fmin(found, np.abs(DEAD * value(condition.margin, values) / value(condition.least, values)))
    return found


def worst_of(text):
    """The largest difference from the reference, as a part of the row's largest; how many columns were compared."""
    mechanism, equations, _, values = solved(text)
    solution = reference.solve(mechanism, start=rough_poses(mechanism, equations))
    theirs = reference.forces(solution)
    found = {equation.symbol: equation.unit.kind for equation in equations.columns if equation.role == "force"}
    assert not [name for name in set(theirs) - set(found) if np.nanmax(np.abs(theirs[name])) > 1e-9]
    sine = sines(equations, values)
    rows = solution.exists & (sine > 1e-3)
    effort, by_work = equations.efforts
    theirs[by_work] = theirs[effort]
    told = np.isfinite(theirs[effort])
    assert np.isnan(values[by_work][rows & ~told]).all()
    rows &= told  # but where the ends of a spring coincide
    worst = 0.0
    for kind in ("force", "moment"):
        names = [name for name, unit in found.items() if unit == kind]
        scale = np.max([np.abs(theirs[name]) for name in names], axis=0, initial=1e-9)
        for name in names:
            gap = (np.abs(values[name] - theirs[name]) * sine**2 / scale)[rows]
            assert np.isfinite(gap).all(), name
            worst = max(worst, float(gap.max(initial=0.0)))
    return worst, len(found)


@pytest.mark.slow
@pytest.mark.cases(5)
@pytest.mark.parametrize(
    "template", some(but(TEMPLATE_FILES, *LISTED, "four-bar-forces"), 4), ids=lambda path: path.stem
)
def test_templates_against_all_reactions_at_once(template):
    for seed, static in ((1, False), (2, True)):
        worst, count = worst_of(weighed(template.read_text(encoding="utf-8"), seed, static))
        assert count > 2
        assert worst < 1e-11


@pytest.mark.slow
def test_random_mechanisms_of_all_dyads_against_all_reactions_at_once():
    kinds = set()
    for seed in range(60 if ALL else 10):
        text = weighed(Grower(seed, 1 + seed % 3).text(), seed)
        try:
            worst, _ = worst_of(text)
        except MechsheetError:  # it closes nowhere: a random one may
            continue
        kinds |= {group.kind for group in solve(loads(text)).groups}
        assert worst < 1e-11, f"seed {seed}"
    assert kinds == {"RRR", "RRP", "RPR", "PRP", "RPP"}


PISTON_LOAD = '[[loads]]\nname = "P"\nlink = "piston"\nforce = [-500, 0]\n'


def test_static_slider_crank_by_its_closed_form():
    _, _, theta, values = solved(IN_LINE + PISTON_LOAD)
    root = np.sqrt(200**2 - (50 * np.sin(theta)) ** 2)
    way = -50 * np.sin(theta) - 50**2 * np.sin(theta) * np.cos(theta) / root
    assert values["T12"] == pytest.approx(500 * way / 1000, abs=1e-12)
    assert values["T12.work"] == pytest.approx(values["T12"], abs=1e-12)
    # the rod is a two-force link: its force lies along it; the guide takes the part across
    assert values["F34.y"] * (values["B.x"] - values["A.x"]) == pytest.approx(
        values["F34.x"] * (values["B.y"] - values["A.y"]), abs=1e-9
    )
    assert values["F14.n"] == pytest.approx(500 * 50 * np.sin(theta) / root, abs=1e-9)
    assert "F14.c" not in values  # no couple: all forces pass through the pin


def test_loads_along_the_link_and_expressions():
    """A load that works against the piston's motion, as an expression and in the link's frame."""
    moving = IN_LINE.replace("step = 15", "step = 15\nspeed = 4")
    one = moving + '[[loads]]\nlink = "piston"\nforce = ["-500*where(s14.v, 1, -1)", 0]\n'
    values = solved(one)[3]
    still = solved(IN_LINE + PISTON_LOAD)[3]
    forwards = np.where(values["s14.v"] > 0, 1, -1)
    assert values["T12"] == pytest.approx(still["T12"] * forwards, abs=1e-12)
    other = moving + '[[loads]]\nlink = "crank"\npoint = "A"\nframe = "link"\nforce = [0, 30]\n'
    assert solved(other)[3]["T12"] == pytest.approx(np.full(25, -1.5), rel=1e-12)


MASSES = {
    "crank": "mass = 1.1\ncenter = [20, 5]\ninertia = 3e-4",
    "rod": "mass = 0.7\ncenter = { r = 90, angle = 4 }\ninertia = 2e-3",
    "piston": "mass = 0.9",
}


def with_masses(more="", speed="speed = 12\nacceleration = 5"):
    text = IN_LINE.replace("step = 15", f"step = 15\n{speed}")
    for link, keys in MASSES.items():
        text = text.replace(f"[links.{link}]", f"[links.{link}]\n{keys}")
    return text + more


def test_power_is_what_the_energies_gain():
    """T12 omega12 and what a load does, against kinetic and potential energy, from places alone, by differences."""
    text = with_masses("[dynamics]\ngravity = 9.81\n" + PISTON_LOAD, "speed = 12").replace("step = 15", "step = 0.5")
    mechanism, _, theta, values = solved(text)
    omega, step = 12.0, theta[1] - theta[0]

    def rate(column):
        weights = {1: 4 / 5, 2: -1 / 5, 3: 4 / 105, 4: -1 / 280}
        found = sum(w * (np.roll(column, -n) - np.roll(column, n)) for n, w in weights.items()) / step * omega
        found[:5] = found[-5:] = np.nan
        return found

    places = {"G2": 1.1, "G3": 0.7, "B": 0.9}
    known = {symbol.symbol: symbol.value for symbol in mechanism.dimensions}
    energy = sum(
        m * (rate(values[f"{g}.x"]) ** 2 + rate(values[f"{g}.y"]) ** 2) / 2e6 for g, m in places.items()
    )  # fmt: skip
    energy = energy + known["J_2"] * omega**2 / 2 + known["J_3"] * rate(values["theta13"]) ** 2 / 2
    energy = energy + sum(m * 9.81 * values[f"{g}.y"] / 1000 for g, m in places.items())
    gained = rate(energy)
    inside = np.isfinite(gained)
    assert inside.sum() > 700
    given = values["T12"] * omega - 500 * values["s14.v"] / 1000
    assert given[inside] == pytest.approx(gained[inside], abs=1e-8 * np.nanmax(np.abs(gained)))


def test_forces_of_inertia_grow_with_the_square_of_the_speed():
    slow, fast = (solved(with_masses(speed=f"speed = {speed}"))[3] for speed in (7, 14))
    for name in ("T12", "F12.x", "F23.y", "F34", "F14.n"):
        assert fast[name] == pytest.approx(4 * slow[name], rel=1e-11, abs=1e-12)


def test_forces_are_linear_in_the_loads():
    """Two loads together do what each does alone, and a load five times as large five times as much."""
    other = '[[loads]]\nlink = "rod"\npoint = [60, 9]\nforce = [30, -80]\n[[loads]]\nlink = "crank"\ntorque = 2.5\n'
    one, two, both = (solved(IN_LINE + load)[3] for load in (PISTON_LOAD, other, PISTON_LOAD + other))
    fivefold = solved(IN_LINE + PISTON_LOAD.replace("-500", "-2500"))[3]
    for name in ("T12", "F12.x", "F12.y", "F23.x", "F23.y", "F34.x", "F34.y", "F14.n"):
        size = np.abs(both[name]).max()
        assert both[name] == pytest.approx(one[name] + two[name], abs=1e-13 * size), name
        assert fivefold[name] == pytest.approx(5 * one[name], abs=1e-13 * 5 * size), name


def test_consistent_units_of_ones_own():
    """Lengths in m with kg and N, and the same numbers as units of one's own."""
    text = with_masses("[dynamics]\ngravity = 9.81\n")
    metres = text.replace('name = "in-line"', 'name = "in-line"\nlength_unit = "m"')
    own = metres.replace('"m"', '"ell"').replace("9.81", '9.81\nforce_unit = "F"\nmass_unit = "M"')
    one, other = solved(metres)[3], solved(own)[3]
    assert other["T12"] == pytest.approx(one["T12"], rel=1e-14)
    assert solved(own)[1].of("T12").unit.text == "F ell"


def test_three_links_at_a_pin():
    """Two rods on one crank pin: each has its own force, and the crank gets both."""
    text = IN_LINE.replace(
        "[[joints]]",
        "[links.rod2]\npoints = { A = [0, 0], C = [180, 0] }\n[links.piston2]\npoints = { C = [0, 0] }\n[[joints]]",
    ).replace(
        "[driver]",
        '[[joints]]\ntype = "prismatic"\nlink = "piston2"\non = "ground"\npoint = "C"\nthrough = [0, 0]\nangle = 90\n'
        'orientation = 0\nsymbol = "s16"\n[driver]',
    ).replace("B = [250, 0]", "B = [250, 0]\nC = [0, 170]")  # fmt: skip
    text += PISTON_LOAD + '[[loads]]\nlink = "piston2"\nforce = [0, -200]\n'
    values = solved(text)[3]
    assert values["F12.x"] == pytest.approx(values["F23.x"] + values["F25.x"], abs=1e-9)
    assert worst_of(text)[0] < 1e-12


def test_a_pin_slot_is_a_block_with_a_pin_and_a_slide():
    lever = """
format = 1
[mechanism]
name = "lever"
[links.ground]
points = { A0 = [0, 0], B0 = [0, -120] }
[links.crank]
points = { A0 = [0, 0], A = [40, 0] }
[links.lever]
points = { B0 = [0, 0] }
mass = 2
center = [60, 10]
inertia = 3e-3
BLOCK[[joints]]
JOINT
on = "lever"
point = "A"
through = [0, 8]
symbol = "s"
[driver]
link = "crank"
start = 0
stop = 360
step = 20
speed = 9
[dynamics]
gravity = 9.81
[[loads]]
link = "lever"
torque = 3
[assembly]
theta13 = 80
"""
    slot = lever.replace("BLOCK", "").replace("JOINT", 'type = "pin-slot"')
    block = lever.replace("BLOCK", "[links.block]\npoints = { A = [0, 0] }\n").replace(
        "JOINT", 'type = "prismatic"\nlink = "block"'
    )
    one, other = solved(slot)[3], solved(block)[3]
    for rate in ("omega13", "alpha13", "s.v", "s.a"):
        assert one[rate] == pytest.approx(other[rate], abs=1e-12 * np.abs(other[rate]).max()), rate
    assert one["T12"] == pytest.approx(other["T12"], rel=1e-11)
    assert np.abs(one["F32.n"]) == pytest.approx(np.abs(other["F34.n"]), rel=1e-11)
    assert other["F24"] == pytest.approx(np.abs(other["F34.n"]), rel=1e-11)
    assert worst_of(slot)[0] < 1e-12


@pytest.mark.slow
def test_a_driver_between_moving_links():
    """The effort of a cylinder is a force along it, of a turning pair a torque between the two."""
    for name in ("cylinder-boom", "elliptic-trammel", "scissor-lift"):
        path = next(path for path in TEMPLATE_FILES if path.stem == name)
        text = weighed(path.read_text(encoding="utf-8"), 5)
        worst, _ = worst_of(text)
        assert worst < 1e-12
        assert len(solve(loads(text)).efforts) == 2


def test_a_spring_that_balances_a_weight():
    """A spring of free length 0 from a point above the pivot: k h = m g r / a, and the lever is in balance everywhere."""
    text = """
format = 1
[mechanism]
name = "lever"
[links.ground]
points = { A0 = [0, 0], H = [0, 120] }
[links.lever]
points = { A0 = [0, 0], C = [80, 0] }
mass = 2
center = [100, 0]
[driver]
link = "lever"
start = -60
stop = 60
step = 20
[dynamics]
gravity = 9.81
[[loads]]
name = "K"
between = ["C", "H"]
stiffness = "2*9.81*100/(80*120)"
"""
    values = solved(text)[3]
    assert values["T12"] == pytest.approx(np.zeros(7), abs=1e-14)
    assert values["T12.work"] == pytest.approx(np.zeros(7), abs=1e-14)
    assert values["K"] == pytest.approx(2 * 9.81 * 100 / (80 * 120) * values["K_l"])
    stretched = text.replace('stiffness = "2*9.81*100/(80*120)"', "stiffness = 0.5\nfree_length = 40")
    assert np.max(np.abs(solved(stretched)[3]["T12"])) > 0.5

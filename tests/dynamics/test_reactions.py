"""Joint forces from the equations: against all reactions at once, against closed forms by hand, and against each other."""

import re
from pathlib import Path

import numpy as np
import pytest

from chosen import IN_CI, some
from mechsheet import reference
from mechsheet.description import loads
from mechsheet.diagnostics import MechsheetError
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dyads import DEAD
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.solve import dimension_values, driver_values
from mechsheet.kinematics.sweep import rough_poses, sweep
from random_mechanisms import Grower

TEMPLATES = sorted((Path(__file__).parent.parent.parent / "templates").glob("*.toml"))


def weighed(text, seed, static=False):
    """A description with random masses and loads on all its links, in the layout that has forces."""
    random = np.random.default_rng(seed)
    text = re.sub(r"(?m)^layout *=.*$", "", text)
    mechanism = loads(text)
    if not static:
        text = re.sub(r"(?m)^(speed|acceleration) *=.*$", "", text)
        text = re.sub(r"(?m)^\[driver\]", "[driver]\nspeed = 2.5\nacceleration = -1.7", text)
    size = 60.0
    extra = "[dynamics]\ngravity = [0.4, -9.81]\n" if mechanism.length_unit in ("mm", "cm", "m") else ""
    for link in mechanism.links[1:]:
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
            extra += f'[[loads]]\nlink = "{link.name}"\npoint = {place}\nforce = {force}\nframe = "{frame}"\n'
        if random.random() < 0.4:
            extra += f'[[loads]]\nlink = "{link.name}"\ntorque = {random.uniform(-3, 3):.2f}\n'
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
    modes = {group.mode: group.mode_value for group in equations.groups if group.mode}
    solution = reference.solve(mechanism, start=rough_poses(mechanism, modes))
    theirs = reference.forces(solution)
    found = {equation.symbol: equation.unit.kind for equation in equations.columns if equation.role == "force"}
    sine = sines(equations, values)
    rows = solution.exists & (sine > 1e-3)
    worst = 0.0
    for kind in ("force", "moment"):
        names = [name for name, unit in found.items() if unit == kind]
        scale = (
            np.max(
                [
                    np.abs(theirs[name.replace(".work", "") if name in theirs else effort(name, theirs)])
                    for name in names
                ],
                axis=0,
            )
            if names
            else 1.0
        )
        for name in names:
            gap = np.abs(values[name] - theirs[effort(name, theirs)])[rows] * sine[rows] ** 2 / scale[rows]
            assert np.isfinite(gap).all(), name
            worst = max(worst, float(gap.max(initial=0.0)))
    return worst, len(found), set(theirs) - set(found)


def effort(name, theirs):
    """The name that the reference has for what virtual work gives."""
    whole = name.removesuffix(".work")
    return whole if whole in theirs and (name == whole or "T" in whole) else name.replace(".work", ".t")


@pytest.mark.parametrize("template", some(TEMPLATES, 4), ids=lambda path: path.stem)
def test_templates_against_all_reactions_at_once(template):
    for seed, static in ((1, False), (2, True)):
        worst, count, _ = worst_of(weighed(template.read_text(encoding="utf-8"), seed, static))
        assert count > 2
        assert worst < 1e-11


def test_random_mechanisms_of_all_dyads_against_all_reactions_at_once():
    kinds = set()
    for seed in range(60 if IN_CI else 10):
        text = weighed(Grower(seed, 1 + seed % 3).text(), seed)
        try:
            worst, _, _ = worst_of(text)
        except MechsheetError:  # it closes nowhere: a random one may
            continue
        kinds |= {group.kind for group in solve(loads(text)).groups}
        assert worst < 1e-11, f"seed {seed}"
    assert kinds == {"RRR", "RRP", "RPR", "PRP", "RPP"}

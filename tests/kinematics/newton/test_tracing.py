"""A sketch drawn at some value of the driver: its assembly is the one that moves, or the description is refused."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from mechsheet.compiled import Compiled
from mechsheet.description import loads
from mechsheet.description.templates import template_text
from mechsheet.diagnostics import MechanismError
from mechsheet.kinematics.build_equations import standing, write_equations
from mechsheet.kinematics.driving import at_values
from mechsheet.kinematics.sweep import sweep

SWEEPS = {"stephenson-iii-output": (-100, 120, 10), "double-butterfly": (100, 160, 4), "planar-3rpr": (1, 9, 0.5)}
"""Wider than those of the templates, so that assemblies exist in some part of them only."""


def described(name):
    """A template with another sweep; behind it, the sketch; the names of its points."""
    start, stop, step = SWEEPS[name]
    text = template_text(name)
    for key, value in (("start", start), ("stop", stop), ("step", step)):
        text = re.sub(rf"(?m)^{key} = .*$", f"{key} = {value}", text, count=1)
    before, sketch, behind = re.split(r"(?m)^(\[assembly\]\n(?:\w+ = .*\n)+)", text)
    return before, re.findall(r"(?m)^(\w+) = \[", sketch), behind


def assemblies(mechanism, at, points):
    """The places of points in each assembly of the one group at a value of the driver."""
    there = standing(mechanism, at)
    for mode in range(1, 9):
        equations = write_equations(there, {"mode_1": mode}, outputs=False)
        if mode > len(equations.groups[0].assemblies):
            return
        values = sweep(there, equations, np.array([at]))
        yield {point: tuple(float(values[f"{point}.{axis}"][0]) for axis in "xy") for point in points}


DRAWN = [
    *(("stephenson-iii-output", at) for at in (-70, 50, 90, 120)),
    *(("double-butterfly", at) for at in (130, 145)),
    *(("planar-3rpr", at) for at in (5, 8)),
]
"""At these values of the driver there are several assemblies; not all can be followed to the first row."""


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize(("name", "at"), DRAWN)
def test_the_assembly_drawn_is_the_one_that_moves(name, at):
    before, points, behind = described(name)
    whole = loads(before + "[assembly]\n" + behind)
    inside = whole.driver.unit.to_internal(at)
    taken = refused = 0
    sketches = list(assemblies(whole, inside, points))
    for places in sketches:
        sketch = "".join(f"{point} = [{x!r}, {y!r}]\n" for point, (x, y) in places.items())
        try:
            compiled = Compiled(loads(f"{before}[assembly]\nat = {at}\n{sketch}\n{behind}"))
            home = compiled.equations.groups[0].system.home
        except MechanismError as error:
            refused += 1
            assert "cannot be followed to the first one" in str(error)
            assert f"= {at:.4g}, where it exists" in str(error)
            continue
        taken += 1
        path = np.linspace(home, inside, 400)
        back = replace(compiled.mechanism, driver=at_values(compiled.mechanism.driver, path), dynamics=None)
        values = sweep(back, compiled.equations.positions, path)
        for point, place in places.items():
            assert math.dist([values[f"{point}.{axis}"][-1] for axis in "xy"], place) < 1e-3
    assert taken + refused == len(sketches)


@pytest.mark.slow
def test_a_position_that_is_none_is_not_shown():
    before, points, behind = described("planar-3rpr")
    sketch = "".join(f"{point} = [3, 4]\n" for point in points)
    with pytest.raises(MechanismError, match="the sketch cannot show this position"):
        _ = Compiled(loads(f"{before}[assembly]\nat = 60\n{sketch}\n{behind}")).equations

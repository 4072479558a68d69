"""Gears, belts and racks without a phase stand as the sketch shows them, at whatever value of the driver it was drawn."""

import math
import warnings

import numpy as np
import pytest

from chosen import part
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.doubts.sketched import doubts
from mechsheet.kinematics.driving import driver_values
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep
from mechsheet.library.changed import loads

DRAG_LINK = """format = 1
[mechanism]
name = "geared"
[links.ground]
points = {{ A0 = [0, 0], B0 = [20, 0], C0 = [90, 0] }}
[links.crank]
points = {{ A0 = [0, 0], A = [{crank!r}, 0] }}
[links.coupler]
points = {{ A = [0, 0], B = [{coupler!r}, 0] }}
[links.output]
points = {{ B0 = [0, 0], B = [{output!r}, 0] }}
{last}
[driver]
link = "crank"
start = {start}
stop = {stop}
step = 5
[assembly]
{sketch}
"""

WHEEL = """[links.wheel]
points = {{ C0 = [0, 0], C = [20, 0] }}
[[joints]]
type = "{kind}"
link = "wheel"
on = "output"
ratio = {ratio}
"""

RACK = """[links.bar]
points = { C = [0, 0] }
[[joints]]
type = "prismatic"
name = "guide"
link = "bar"
on = "ground"
point = "C"
through = [20, -12]
[[joints]]
type = "rack"
joint = "guide"
link = "output"
radius = 12
"""

COUNT = 300


def sizes(random):
    """A drag link: the shortest link stands, and both cranks turn all around."""
    return {"crank": random.uniform(45, 60), "coupler": random.uniform(45, 60), "output": random.uniform(45, 60)}


def position(mechanism, degrees):
    """Every symbol where the driver has gone to this angle, from the first row on."""
    first = float(driver_values(mechanism, dimension_values(mechanism))[0])
    path = np.linspace(first, math.radians(degrees), 300)
    return {name: float(column[-1]) for name, column in sweep(mechanism, solve(mechanism), path).items()}


def drawn(random, last, key, start, at):
    """(text without the entry of what the gear or rack moves, the name of that entry, its value at `at`)."""
    numbers = {**sizes(random), "start": start, "stop": start + 360}
    whole = DRAG_LINK.format(**numbers, last=last + f"phase = {random.uniform(-90, 90)!r}\n", sketch="")
    mechanism = loads(whole)
    there = position(mechanism, at)
    sketch = f"at = {at}\nB = [{there['B.x']!r}, {there['B.y']!r}]\n"
    return DRAG_LINK.format(**numbers, last=last, sketch=sketch), there


@pytest.mark.parametrize("seed", part(range(COUNT), 20))
def test_a_wheel_stands_as_it_is_sketched(seed):
    """The wheel that it reads may have gone through half a turn by then: half of it counts."""
    random = np.random.default_rng([4, seed])
    kind = str(random.choice(["gear", "belt"]))
    last = WHEEL.format(kind=kind, ratio=float(random.choice([-1.5, -0.5, 0.5, 0.75, 1 / 3])))
    start = int(random.integers(0, 360))
    at = start + int(random.integers(-200, 500))
    text, there = drawn(random, last, "theta15", start, at)
    rough = math.degrees(there["theta15"]) + random.uniform(-5, 5)
    found = position(loads(text + f"theta15 = {rough!r}\n"), at)
    assert abs(math.remainder(found["theta15"] - there["theta15"], math.tau)) < math.radians(16)


@pytest.mark.parametrize("entry", ["point", "displacement"])
@pytest.mark.parametrize("seed", part(range(COUNT // 2), 20))
def test_a_rack_stands_as_it_is_sketched(seed, entry):
    random = np.random.default_rng([5, seed])
    start = int(random.integers(0, 360))
    at = start + int(random.integers(-200, 500))
    text, there = drawn(random, RACK, "s15", start, at)
    slid = there["s15"] + random.uniform(-2, 2)
    sketch = f"C = [{20 + slid!r}, -12]\n" if entry == "point" else f"s15 = {slid!r}\n"
    found = position(loads(text + sketch), at)
    assert abs(found["s15"] - there["s15"]) < 8


def test_a_phase_that_the_sketch_contradicts_is_told_at_any_value_of_the_driver():
    random = np.random.default_rng(6)
    for last, key, off, said in (
        (WHEEL.format(kind="gear", ratio=0.5), "theta15", 90, "theta15 is sketched 90 degrees away"),
        (RACK, "s15", 40, "s15 is sketched 40 mm away"),
    ):
        text, there = drawn(random, last, key, 10, 250)
        value = math.degrees(there[key]) if key == "theta15" else there[key]
        right = loads(text + f"{key} = {value!r}\n")
        phase = next(dim for dim in right.dimensions if dim.symbol.startswith("phase"))
        given = text.replace("ratio = 0.5\n", "ratio = 0.5\nphase = PHASE\n").replace(
            "radius = 12\n", "radius = 12\nphase = PHASE\n"
        )
        shown = phase.unit.to_shown(dimension_values(right)[phase.symbol])
        for wrong, messages in ((0, []), (off, [said])):
            mechanism = loads(given.replace("PHASE", repr(shown + wrong)) + f"{key} = {value!r}\n")
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                faults = doubts(mechanism, solve(mechanism))
            assert [fault.message.partition(" from")[0] for fault in faults if "phase" in fault.message] == messages
            assert all(f"write phase = {shown:.2g}"[:16] in fault.hint for fault in faults if "phase" in fault.message)

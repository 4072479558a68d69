"""Belts and gears in the drawing: whose circles they join, how large these are, and each circle once."""

import pytest
from planned import planned

from livesheet.formula.scalar import evaluate
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.shapes.listing import wheels_of

TRAIN = """
format = 1
[mechanism]
name = "train"
[links.ground]
points = {{ A = [0, 0], B = [60, 0] }}
[links.driving]
points = {{ A = [0, 0] }}
[links.driven]
points = {{ B = [0, 0] }}
[[joints]]
type = "{kind}"
link = "driven"
on = "driving"
ratio = {ratio}
[driver]
link = "driving"
start = 0
stop = 90
step = 15
"""


@pytest.mark.parametrize(("kind", "ratio", "radii", "crossed"), [
    ("belt", 2.0, (20, 10), 1.0), ("belt", -2.0, (20, 10), -1.0), ("gear", -2.0, (40, 20), None),
    ("gear", 3.0, (90, 30), None), ("gear", 1.0, (15, 15), 1.0),
])  # fmt: skip
def test_two_wheels_and_their_belt(kind, ratio, radii, crossed):
    """`ratio` is speed of the driven by that of the driving one, so the driving one is larger in that ratio."""
    plan = planned(TRAIN.format(kind=kind, ratio=ratio))
    values = dimension_values(plan.mechanism)
    wheels, belts = wheels_of(plan.mechanism, plan.equations.poses, values)
    assert [(wheel.link.name, wheel.axis) for wheel in wheels] == [("driving", "A"), ("driven", "B")]
    assert [evaluate(wheel.radius, values) for wheel in wheels] == pytest.approx(radii)
    assert [(belt.wheels, belt.crossed) for belt in belts] == ([(tuple(wheels), crossed)] if crossed else [])

"""The driver between the rows, where the sheet looks for extremes: by one step, or in time by a motion law."""

import pytest
from planned import planned

from livesheet.formula.nodes import Number, Symbol, symbols, transform
from livesheet.formula.scalar import evaluate
from mechsheet.description.templates import template_text
from mechsheet.sheet.driving import driver_at

SWEEP = "start = 0\nstop = 360\nstep = 15\n"
LAW = 'start = 20\nstop = 200\nmotion = { law = "cycloidal", duration = 3, rows = 7 }\n'


@pytest.mark.parametrize(("motion", "places"), [
    (SWEEP, {1: 0, 2.5: 22.5, 25: 360}),
    # halfway at half time; after a quarter of the time a quarter of the way less sin(pi/2) / (2 pi)
    (LAW, {1: 20, 2.5: 20 + 180 * (0.25 - 0.15915494309189535), 4: 110, 7: 200}),
])  # fmt: skip
def test_places_are_counted_in_rows_from_1(motion, places):
    plan = planned(template_text("four-bar").replace(SWEEP, motion))
    given = {"start": 0, "step": 15, "duration": 3, "SHOWN start": 20, "SHOWN stop": 200}
    cells = {spot.cell: Symbol(name) for name in ("start", "step") if (spot := getattr(plan.places, name))}
    for place, value in places.items():
        node = transform(driver_at(plan, Number(place)), lambda part: cells.get(part, part))
        assert evaluate(node, {name: given[name] for name in symbols(node)}) == pytest.approx(value)

"""Values on the sheet of synthesis: angles as people read them, in degrees or radians; everything else as it is."""

import math

import pytest
from planned import planned

from livesheet.formula.nodes import Number
from livesheet.formula.scalar import evaluate
from mechsheet.description.templates import template_text
from mechsheet.sheet.synthesis.page import Page


@pytest.mark.parametrize(("unit", "angle"), [("deg", math.degrees(0.3)), ("rad", 0.3)])
def test_only_angles_are_shown_in_degrees_and_only_where_the_description_has_degrees(unit, angle):
    plan = planned(template_text("quick-return-slider").replace("[mechanism]", f'[mechanism]\nangle_unit = "{unit}"'))
    page = Page(plan, plan.mechanism.synthesis, plan.synthesis)
    for kind, seen in (("angle", angle), ("length", 0.3), ("number", 0.3)):
        value, otherwise = page.shown(Number(0.3), kind).args
        assert evaluate(value, {}) == pytest.approx(seen), kind
        assert otherwise.name == "NA"
        assert evaluate(page.read(Number(seen), kind), {}) == pytest.approx(0.3), kind
        assert page.unit_text(kind) == {"angle": "°" if unit == "deg" else "rad", "length": "mm", "number": ""}[kind]

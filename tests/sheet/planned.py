"""What a workbook is laid out by, without the workbook: a few milliseconds."""

import re

from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.dynamics.solve import solve
from mechsheet.sheet.planning import plan_of


def planned(text, **overrides):
    """The plan of a description's workbook."""
    mechanism = loads(text, overrides=Overrides(overrides))
    return plan_of(mechanism, solve(mechanism))


def moving(name):
    """A template's text with a driver that turns at an even speed."""
    text = re.sub(r"(?m)^(layout|speed) *=.*$", "", template_text(name))
    return text.replace("[driver]", "[driver]\nspeed = 10", 1)

"""The table of positions against the reference, for what is typed into the cells."""

import pytest
from laid import Laid

from livesheet.evaluation import book_of
from mechsheet.checking.against_reference import against_plan
from mechsheet.description.templates import template_text

pytestmark = pytest.mark.slow


@pytest.mark.cases(1)
@pytest.mark.parametrize("mode", [1, -1])
def test_a_rack_keeps_the_turns_that_the_workbook_began_with(mode):
    """Assembled the other way the rocker is a turn further on by the formulas, and the rack with it."""
    laid = Laid(template_text("rack-slider"))
    laid.change(mode_1=mode)
    comparison, _ = against_plan(book_of(laid.workbook), laid.values, laid.plan, "rack-slider")
    assert comparison.agrees, comparison


OSCILLATING = """
format = 1
mechanism.name = "oscillating"
links.ground.points = { O = [0, 0], P = [120, 0] }
links.crank.points = { O = [0, 0], A = [30, 0] }
links.cylinder.points = { P = [0, 0] }
links.piston.points = { A = [0, 0] }
joints = [{ type = "prismatic", link = "piston", on = "cylinder", point = "A", through = "P", symbol = "s" }]
driver = { link = "crank", start = 0, stop = 360, step = 15, speed = "3 rad/s" }
loads = [{ name = "F", link = "piston", point = "A", frame = "link", force = ["-50*where(s.v, 1, -1)", 0] }]
"""


def test_at_a_dead_centre_rounding_may_decide_a_load_that_changes_with_the_velocity():
    """At 0 degrees the piston stands still: whether the force pushes or pulls there hangs on the last digit of s.v."""
    laid = Laid(OSCILLATING)
    comparison, _ = against_plan(book_of(laid.workbook), laid.values, laid.plan, "oscillating")
    assert comparison.agrees, comparison


def test_elsewhere_such_a_load_is_compared():
    """Other rows, or another size of the load, are no matter of rounding."""
    laid = Laid(OSCILLATING)
    plan = Laid(OSCILLATING.replace("-50*where(s.v, 1, -1)", "-50*where(s.v, 1, -2)")).plan
    comparison, _ = against_plan(book_of(laid.workbook), laid.values, plan, "oscillating")
    assert not comparison.agrees

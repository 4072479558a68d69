"""What a motion does between the rows: held against the triangle in which a four-bar stops."""

import math
from dataclasses import replace

import numpy as np
import pytest

from mechsheet.description import Overrides, loads
from mechsheet.description.templates import template_text
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.search import Search, edges
from mechsheet.kinematics.solve import solve
from parallel_slides import COTANGENT


def searched(text):
    mechanism = loads(text)
    return Search(mechanism, solve(mechanism), given_values(mechanism, dimension_values(mechanism)))


@pytest.mark.parametrize("step", [15, 7, -15])
def test_it_closes_up_to_where_crank_and_coupler_are_in_line_with_the_rocker(step):
    """A triangle of a1, a2 and a3 + a4: the crank stops at this angle, on both sides of the line of the pivots."""
    text = template_text("four-bar").replace("value = 35,", "value = 50,").replace("step = 15", f"step = {step}")
    search = searched(text.replace("stop = 360", "stop = -360") if step < 0 else text)
    a1, a2, a3, a4 = 70, 50, 62.3, 56
    angle = math.acos((a1**2 + a2**2 - (a3 + a4) ** 2) / (2 * a1 * a2))
    expected = sorted(math.copysign(each, step) for each in (angle, math.tau - angle))
    assert sorted(search.driver(search.edges)) == pytest.approx(expected, abs=1e-9)
    assert search.exists(search.known(search.edges)).all()
    assert not search.exists(search.known(search.edges + np.array([1e-6, -1e-6]))).any()
    assert search.dips == []


def test_a_crank_that_turns_fully_has_no_edges():
    search = searched(template_text("four-bar"))
    assert search.edges.size == 0
    assert search.there.all()


def test_listed_rows_have_nothing_between_them():
    """Rows without a position are no gap between two rows that close: `check` accused such workbooks of missing one."""
    text = template_text("four-bar").replace("value = 35,", "value = 50,")
    text = text.replace("start = 0\nstop = 360\nstep = 15\n", "values = [0, 60, 180, 300, 360]\n")
    mechanism = loads(text)
    given = given_values(mechanism, dimension_values(mechanism))
    search = Search(mechanism, solve(mechanism), given)
    assert search.row_there.tolist() == [True, True, False, True, True]
    assert search.holes == []


@pytest.mark.parametrize("starts", [True, False])
def test_edges_lie_on_the_closing_side(starts):
    def exists(u):
        return (u >= 2.3) if starts else (u <= 2.3)

    places = np.array([1.0, 2.0, 3.0, 4.0])
    (found,) = edges(places, exists(places), exists, 45)
    assert found == pytest.approx(2.3, abs=1e-12)
    assert exists(found)
    (row,) = edges(places, exists(places), exists, 0)
    assert row == (3 if starts else 2)


@pytest.mark.parametrize("start", [-40, 7.5, 90, 200])
def test_a_rack_goes_as_far_as_its_pinion_turns_wherever_the_sweep_begins(start):
    """s = r theta14 + phase: between the rows, too, theta14 is counted on from the rows and not from elsewhere."""
    text = (
        template_text("rack-slider")
        .replace("start = 0", f"start = {start}")
        .replace("stop = 360", f"stop = {start + 360}")
    )
    search = searched(text.replace("value = 20,", "value = 30,"))
    slider, rocker = search.extremes("s15"), search.extremes("theta14")
    assert (slider[1], slider[3]) == pytest.approx((rocker[1], rocker[3]), abs=1e-4)
    assert slider[2] - slider[0] == pytest.approx(25 * (rocker[2] - rocker[0]), rel=1e-9)


def test_where_the_lines_of_two_slides_turn_parallel_it_does_not_close():
    """s = h cot(theta) has no value at 180 degrees, between two rows, nor at 360, between the last and the first again."""
    search = searched(COTANGENT.replace("start = 10\nstop = 330", "start = 10.5\nstop = 350.5"))
    assert search.row_there.all() and not search.closes_everywhere
    assert np.degrees(search.driver(np.array(search.holes))) == pytest.approx([180, 360], abs=0.1)


def test_what_is_divided_by_0_at_a_limit_has_the_sign_it_has_beside_it():
    """The lift falls the faster the nearer it is to its lowest position: without bound downwards, while rounding there gives
    a denominator of either sign."""
    text = template_text("scissor-lift")
    changed = {
        "L": "1224.5386768709998", "x0": "235.0483797891515", "y0": "-39.05173368316974", "L0": "234.98289441433133",
        "u": "531.1815516349145", "v": "-71.7198134438593",
    }  # fmt: skip
    mechanism = loads(text, overrides=Overrides(changed))
    equations = solve(mechanism)
    groups = tuple(
        replace(group, assembly=group.assembly_of(1.0)) if group.mode == "mode_1" else group
        for group in equations.groups
    )
    given = given_values(mechanism, dimension_values(mechanism))
    search = Search(mechanism, replace(equations, groups=groups), given)
    least, _, largest, where = search.extremes("gain")
    assert least < -1e4
    assert (largest, where) == (pytest.approx(-3.7393751483096), search.rows)
    assert search.known(search.edges)["gain"] > 1e9  # what rounding makes of it


@pytest.mark.parametrize("template", ["six-link-dwell", "geared-five-bar"])
def test_a_symbol_asked_for_alone_has_the_values_that_it_has_among_all(template):
    """Else the largest and least values between the rows, which `check` holds a workbook against, would be others."""
    search = searched(template_text(template))
    places = search.u[:-1:7] + 0.3 / search.fine
    among_all = search.known(places)
    for equation in search.equations.columns:
        alone = search.known(places, equation.symbol)
        assert np.array_equal(alone[equation.symbol], among_all[equation.symbol], equal_nan=True)
        assert np.array_equal(search.exists(alone), search.exists(among_all))

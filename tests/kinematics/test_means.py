"""Which rows count alike in a mean over the motion; what sheets and studies make of it: `sheet/first/test_means.py`."""

import numpy as np
import pytest

import mechsheet
from mechsheet.kinematics.whole_turns import mean_of_motion, rows_count_alike


@pytest.mark.parametrize(("degrees", "tied", "alike"), [
    (range(0, 361, 10), False, False),  # the row that closes the turn is there
    (range(0, 360, 10), False, True),
    (range(0, 360, 10), True, False),  # with gears on the way it closes nothing
    (range(0, 350, 10), False, False),
    (range(0, 720, 10), False, True),
    (range(0, 360, 120), False, False),  # three rows are no turn
])  # fmt: skip
def test_rows_count_alike_in_a_turn_without_the_row_that_closes_it(degrees, tied, alike):
    assert rows_count_alike(mechsheet.template("four-bar"), np.radians(degrees), tied) is alike


def test_the_mean_is_by_the_trapezoidal_rule_between_neighbours_that_are_there():
    column = np.array([1.0, 3.0, np.nan, 100.0, np.nan, 5.0, 7.0, 7.0])
    there = np.isfinite(column)
    assert mean_of_motion(column, there, alike=False) == (2 + 6 + 7) / 3
    assert mean_of_motion(column, there, alike=True) == column[there].mean()
    assert mean_of_motion(column[2:5], there[2:5], alike=False) == 100  # no two are neighbours

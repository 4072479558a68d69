"""Rows held against the same motion in smaller steps: what is said of steps that are too large, and what is not."""

import numpy as np
import pytest

from mechsheet.description import loads
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.doubts.sketched import doubts
from mechsheet.kinematics.driving import driver_values, given_values
from mechsheet.kinematics.search import Search
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep

STEPHENSON_II = """format = 1
[mechanism]
name = "stephenson-ii"
[links.ground]
points = { U = [-30, -40], W = [-70, 100] }
[links.crank]
points = { U = [0, 0], P = [50, 0], Q = { r = 136, angle = -36.1 } }
[links.plate]
points = { R = [0, 0], S = [90.6, 0], V = { r = 80.6, angle = 53.9 } }
[links.bar1]
points = { P = [0, 0], R = [63.2, 0] }
[links.bar2]
points = { Q = [0, 0], S = [70.7, 0] }
[links.bar4]
points = { W = [0, 0], V = [133.4, 0] }
[driver]
link = "crank"
start = START
stop = STOP
HOW
[assembly]
at = 53.1
P = [0, 0]
Q = [100, 0]
R = [20, 60]
S = [110, 70]
V = [60, 130]
"""


def driven(start, stop, how):
    mechanism = loads(STEPHENSON_II.replace("START", str(start)).replace("STOP", str(stop)).replace("HOW", how))
    return mechanism, solve(mechanism)


def test_behind_a_limit_no_step_is_too_large():
    """There Newton's method finds another assembly; a smaller step would not lead to it, though it may find one, too."""
    mechanism, equations = driven(60.2, 61.4, "step = 0.2")
    found = sweep(mechanism, equations, driver_values(mechanism, dimension_values(mechanism)))
    assert np.isnan(found["theta13"]).any()  # the limit lies at about 60.6
    assert doubts(mechanism, equations) == ()


@pytest.mark.slow
def test_a_law_with_too_few_rows_is_told_how_many_do():
    """Speeds read the time, which must be there wherever the rows are followed anew: in smaller steps, in a search."""
    law = 'motion = { law = "constant", duration = 2, rows = %d }'
    (fault,) = doubts(*driven(22, 60.3, law % 3))
    assert fault.key == "driver.motion"
    assert fault.hint == "write rows = 17 in motion"
    mechanism, equations = driven(22, 60.3, law % 17)
    assert doubts(mechanism, equations) == ()
    given = given_values(mechanism, dimension_values(mechanism))
    assert Search(mechanism, equations, given).row_there.all()


def test_where_rows_follow_from_one_another_they_are_what_is_searched():
    """In smaller steps Newton's method goes further: `show` counted more rows than the sheet has."""
    mechanism, equations = driven(41.1, 65.1, "step = 1")
    dimensions = dimension_values(mechanism)
    found = sweep(mechanism, equations, driver_values(mechanism, dimensions))
    search = Search(mechanism, equations, given_values(mechanism, dimensions))
    assert search.count == np.isfinite(found["theta13"]).sum() == 20
    assert not search.holes

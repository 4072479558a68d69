"""Groups that only Newton's method solves: what is demanded of them holds where they are known to stand."""

import numpy as np
import pytest

from drawn_chains import Drawn
from mechsheet.description import loads
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep


def test_a_platform_on_a_slide_that_passes_its_pin_stands_where_it_was_drawn():
    """Its lengths and offsets are those of a drawing: in the first row every point is at its place in it."""
    drawn = Drawn(24)
    mechanism = loads(drawn.text(2, 2.0))
    values = sweep(mechanism, solve(mechanism), np.array([drawn.home]))
    for point, place in drawn.sketched.items():
        if f"{point}.x" in values:
            assert [values[f"{point}.{axis}"][0] for axis in "xy"] == pytest.approx(place, abs=1e-6), point

"""Extremes of a cam's columns between rows: no narrow segment is missed, nor what is beside the best row."""

import math

import numpy as np
import pytest
from laid import Laid

from mechsheet.description import loads
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep

FLAT = """
format = 1
mechanism.name = "flat"
links.ground.points = {{ O = [0, 0] }}
links.tappet.points = {{ F = [0, 0] }}
[[joints]]
type = "prismatic"
link = "tappet"
on = "ground"
point = "F"
through = "O"
angle = 90
orientation = -90
symbol = "s"
[driver]
joint = "s"
step = {step}
segments = [{segments}]
[cam]
center = "O"
base_radius = 40
face = {{ link = "tappet", point = "F" }}
[summary]
most = {{ of = "s.d", take = "max" }}
touched = {{ of = "contact", take = "max" }}
"""
NARROW = '{ law = "3-4-5", over = 150, to = 12 }, { law = "cycloidal", over = 6, to = 13 }, { law = "3-4-5", to = 0 }'
TWO = '{ law = "parabolic", over = 109, to = 44.7 }, { law = "cycloidal", over = 40, to = 61.11 }, { law = "3-4-5", to = 0 }'


@pytest.mark.slow
def test_a_segment_narrower_than_a_row_is_seen():
    """Rows of 10 degrees show nothing of a rise within 6: a cycloidal one is fastest in its middle, twice its mean."""
    laid = Laid(FLAT.format(step=10, segments=NARROW))
    assert laid.spot("summary most") == pytest.approx(2 * 1 / math.radians(6), rel=1e-9)


@pytest.mark.slow
def test_beside_the_best_row_is_looked_also_where_a_corner_is_better_than_it():
    text = FLAT.format(step=4, segments=TWO)
    mechanism = loads(text)
    fine = sweep(mechanism, solve(mechanism), {"phi": np.radians(np.arange(0, 360, 0.01))})["contact"]
    laid = Laid(text)
    corner = 2 * 44.70 / math.radians(109)
    assert max(laid.column("contact")) < corner < fine.max()  # else this tests nothing
    assert laid.spot("summary touched") == pytest.approx(fine.max(), rel=1e-6)

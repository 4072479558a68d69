"""What a cam presses on a link that its motion does not move directly: other links lie between, of every kind of group."""

from pathlib import Path

import numpy as np
import pytest

from chosen import part
from driven_by_cams import driven_by_cam
from mechsheet import reference
from mechsheet.description import loads
from mechsheet.dynamics.solve import solve
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.sweep import rough_poses, sweep
from random_cams import cam, loaded
from random_mechanisms import Grower
from test_reactions import sines, weighed

TEMPLATES = Path(__file__).resolve().parents[2] / "templates"

STEEP, DEAD = 0.02, 1e-3
"""Where the cosine of the pressure angle is less, or the sine of the angle at which a group is driven, no digit is asked for."""

CHAINS = ("stephenson-ii-class-iv", "double-butterfly", "planar-3rpr")
DRIVEN_PAIRS = ("stephenson-ii-motor", "cylinder-boom", "scissor-lift-between-arms", "quick-return-lever")
OTHERS = ("geared-five-bar", "rack-slider", "shaper", "klann", "oldham", "six-bar-r-rrr-rrt", "double-wishbone")


def swept(text):
    mechanism = loads(text)
    equations, dimensions = solve(mechanism), dimension_values(mechanism)
    return mechanism, equations, sweep(mechanism, equations, given_values(mechanism, dimensions))


def compared(text):
    """The largest difference from the reference, as a part of the column's size; how many rows, how many columns."""
    mechanism, equations, found = swept(text)
    solution = reference.solve(mechanism, start=rough_poses(mechanism, equations))
    known = reference.further(solution)
    rows = solution.exists & (sines(equations, found) > DEAD) & (np.abs(np.cos(known["alpha"])) > STEEP)
    known[equations.efforts[1]] = known[equations.efforts[0]]
    worst, names = 0.0, (*equations.shown_forces, equations.efforts[1], *mechanism.cam.symbols)
    for name in names if rows.any() else ():
        ours, theirs = found[name][rows], known[name][rows]
        assert np.array_equal(np.isnan(ours), np.isnan(theirs)), name
        kind = [each for each in names if each[0] == name[0]]
        largest = np.nanmax([np.abs(known[each][rows]) for each in kind])
        worst = max(worst, np.nanmax(np.abs(ours - theirs) / (1e-3 + largest), initial=0.0))
    return worst, np.sum(rows), len(names)

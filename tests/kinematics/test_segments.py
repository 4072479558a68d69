"""Segments over a cam's angle: the laws, where segments meet, turns beyond the first, motions that end."""

import math
from itertools import pairwise

import numpy as np
import pytest
from closure_rates import PRIME, rates_over

from mechsheet.description import loads
from mechsheet.description.driving.segment_laws import way_of
from mechsheet.kinematics.dimensions import dimension_values
from mechsheet.kinematics.driving import given_values
from mechsheet.kinematics.numeric import value
from mechsheet.kinematics.solve import solve
from mechsheet.kinematics.sweep import sweep
from mechsheet.model import HALF, PIECE, SEGMENT_LAWS, TAU, WAVE
from mechsheet.reference.segments import law as reference_law

PEAKS = {
    "uniform": (1.0, 0.0, 0.0),
    "parabolic": (2.0, 4.0, 0.0),
    "harmonic": (math.pi / 2, math.pi**2 / 2, math.pi**3 / 2),
    "cycloidal": (2.0, 2 * math.pi, 4 * math.pi**2),
    "3-4-5": (1.875, 10 / math.sqrt(3), 60.0),
    "4-5-6-7": (2.1875, 84 * math.sqrt(5) / 25, 52.5),
    "modified trapezoid": (2.0, 8 * math.pi / (2 + math.pi), 32 * math.pi**2 / (2 + math.pi)),
    "modified sine": (4 * math.pi / (4 + math.pi), 4 * math.pi**2 / (4 + math.pi), 16 * math.pi**3 / (4 + math.pi)),
}


def ways(law, tau):
    nearer = np.minimum(tau, 1 - tau)
    piece = 1 + (nearer > 0.125 + 1e-9) + (nearer > 0.375 + 1e-9)
    known = {TAU: tau, WAVE: 4 * np.pi * nearer, HALF: (tau > 0.5) * 1.0, PIECE: piece}
    return [np.broadcast_to(np.asarray(value(node, known), float), tau.shape) for node in way_of(law)]


@pytest.mark.cases(2)
@pytest.mark.slow
@pytest.mark.parametrize("law", PEAKS)
def test_peaks(law):
    tau = np.linspace(0, 1, 100001)
    found = [float(np.abs(way).max()) for way in ways(law, tau)[1:]]
    assert found == pytest.approx(PEAKS[law], abs=1e-5)


@pytest.mark.parametrize("law", SEGMENT_LAWS)
def test_each_derivative_is_that_of_the_one_before_and_the_references(law):
    tau = np.linspace(0, 1, 2001)
    found = ways(law, tau)
    assert found[0][0] == 0
    assert found[0][-1] == pytest.approx(0 if law == "dwell" else 1, abs=1e-14)
    for ours, theirs in zip(found, reference_law(law, tau), strict=True):
        assert np.max(np.abs(ours - theirs)) < 1e-11
    for lower, higher in pairwise(found):
        steps = np.diff(lower) / np.diff(tau)
        smooth = (np.abs(np.diff(higher)) < 1) & (np.abs(np.diff(lower)) < 1)  # but where they leap
        assert np.max(np.abs(steps - (higher[1:] + higher[:-1]) / 2)[smooth], initial=0) < 2e-3


TEXT = """format = 1
[mechanism]
name = "cam"
[links.ground]
points = { O = [0, 0] }
[links.follower]
points = { C = [0, 0] }
[[joints]]
type = "prismatic"
name = "guide"
link = "follower"
on = "ground"
point = "C"
through = "O"
angle = 90
symbol = "s"
[driver]
joint = "guide"
start = 50
step = 30
"""
PARABOLIC = """[[driver.segments]]
law = "parabolic"
over = 60
by = 10
[[driver.segments]]
law = "dwell"
over = 60
"""


def solved(text):
    mechanism = loads(text)
    found = sweep(mechanism, solve(mechanism), given_values(mechanism, dimension_values(mechanism)))
    return mechanism, found


def test_the_earlier_segment_counts_where_two_meet():
    _, found = solved(TEXT + PARABOLIC + '[[driver.segments]]\nlaw = "harmonic"\nto = 0\n')
    unit = 10 / math.radians(60) ** 2
    assert found["s"].tolist()[:5] == pytest.approx([50, 55, 60, 60, 60])
    assert found["s.dd"].tolist()[:4] == pytest.approx([4 * unit, 4 * unit, -4 * unit, 0])
    assert found["s"][-1] == pytest.approx(50)


def test_a_motion_that_ends():
    mechanism, found = solved(TEXT + "closed = false\n" + PARABOLIC)
    assert np.degrees(found["phi"]).tolist() == pytest.approx([0, 30, 60, 90, 120])
    beyond = sweep(mechanism, solve(mechanism), np.radians([-40.0, 400.0]))
    assert beyond["s"].tolist() == pytest.approx([50, 60])


def test_every_turn_is_like_the_first():
    mechanism, found = solved(TEXT + PARABOLIC + '[[driver.segments]]\nlaw = "3-4-5"\nto = 0\n')
    for turns in (-2, -1, 1, 3):
        again = sweep(mechanism, solve(mechanism), found["phi"] + turns * math.tau)
        for name in ("s", "s.d"):
            assert again[name].tolist() == pytest.approx(found[name].tolist(), abs=1e-9), (turns, name)


def test_ways_and_angles_may_be_expressions():
    text = TEXT.replace("[links.ground]", '[dimensions]\nh1 = 12\nwide = { value = 60, unit = "deg" }\n[links.ground]')
    both = PARABOLIC.replace("over = 60\nby = 10", 'over = "wide"\nby = "h1/2"')
    mechanism, found = solved(text + both + '[[driver.segments]]\nlaw = "3-4-5"\nto = 0\n')
    assert found["s"][2] == pytest.approx(56)
    assert {dim.symbol for dim in mechanism.dimensions} >= {"s_0", "over_2", "over_3", "by_3"}


def test_jerk_by_time():
    text = TEXT.replace("step = 30\n", "step = 30\nspeed = 10\nacceleration = 3\n")
    _, found = solved(text + '[[driver.segments]]\nlaw = "cycloidal"\nover = 180\nby = 10\n' + PARABOLIC.partition("[[")[0]
                      + '[[driver.segments]]\nlaw = "3-4-5"\nto = 0\n')  # fmt: skip
    assert found["s.j"].tolist() == pytest.approx((found["s.ddd"] * 1000 + 3 * found["s.dd"] * 10 * 3).tolist())


@pytest.mark.parametrize("law", ["modified trapezoid", "modified sine"])
@pytest.mark.parametrize("over", [60, 80, 100, 140])
def test_the_formula_of_the_motion_has_one_derivative_where_the_halves_of_a_law_meet(law, over):
    """However the rounding of tau = 1/2 falls; differentiated, the formula of s says what the column of s' says."""
    rise = f'[[driver.segments]]\nlaw = "{law}"\nover = {over}\nby = 10\n'
    text = TEXT.replace("step = 30", "step = 5") + rise + '[[driver.segments]]\nlaw = "3-4-5"\nto = 0\n'
    mechanism, found = solved(text)
    rates = rates_over(solve(mechanism), found, {"phi": (1.0, 0.0)})
    assert rates["s" + PRIME].tolist() == pytest.approx(found["s.d"].tolist(), abs=1e-12)

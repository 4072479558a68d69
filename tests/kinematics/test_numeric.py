"""The numeric meaning of what spreadsheets and programs spell each in their own way."""

import math

import mpmath
import numpy as np
import pytest

from livesheet.formula.nodes import Call, Number, Symbol
from mechsheet.kinematics.numeric import triangle_angle, value, without_jumps


def within_half_a_turn(angles):
    return np.arctan2(np.sin(angles), np.cos(angles))


@pytest.mark.parametrize("seed", range(10))
def test_angles_go_on_without_jumps(seed):
    random = np.random.default_rng(seed)
    angles = random.uniform(-3, 3) + np.concatenate(([0.0], np.cumsum(random.uniform(-3, 3, 200))))
    shown = within_half_a_turn(angles)
    expected = angles - angles[0] + shown[0]
    assert np.allclose(without_jumps(shown), expected, atol=1e-12)


@pytest.mark.parametrize("seed", range(4))
def test_angles_begin_anew_after_positions_without_one(seed):
    """Within half a turn, and on from there: nobody knows how the mechanism came across the gap."""
    random = np.random.default_rng(seed)
    shown = within_half_a_turn(np.cumsum(random.uniform(-3, 3, 201)))
    missing = np.repeat(random.random(101) < 0.3, 2)[:201]
    found = without_jumps(np.where(missing, np.nan, shown))
    assert np.array_equal(np.isnan(found), missing)
    for run in np.split(np.arange(201), np.flatnonzero(np.diff(missing)) + 1):
        if not missing[run[0]]:
            assert np.allclose(found[run], np.unwrap(shown[run]), atol=1e-12)


def test_angles_without_jumps_stay_as_they_are():
    smooth = np.linspace(-3.0, 3.0, 50)
    assert np.array_equal(without_jumps(smooth), smooth)
    assert without_jumps(2.5) == 2.5
    assert np.array_equal(without_jumps([2.5]), [2.5])
    assert np.isnan(without_jumps([np.nan, np.nan])).all()


def test_a_needle_s_angle_keeps_its_digits():
    for o, b, c in ((3.0, 4.0, 5.0), (1e-7, 1.0, 1.0), (2.0 - 1e-12, 1.0, 1.0), (5.0, 3.0, 4.0)):
        with mpmath.workdps(50):
            x, y, z = (mpmath.mpf(side) for side in (o, b, c))
            expected = float(mpmath.acos((y * y + z * z - x * x) / (2 * y * z)))
        assert triangle_angle(o, b, c) == pytest.approx(expected, rel=1e-9 if o > 1.9 else 1e-14)
    assert triangle_angle(3.0, 1.0, 1.0) == pytest.approx(math.pi)  # rounding at a dead centre is no gap


@pytest.mark.parametrize(
    ("node", "expected"),
    [
        (Call("ROUND", (Symbol("x"), Number(0.0))), [-3.0, -1.0, 1.0, 3.0]),
        (Call("ATAN2", (Symbol("x"), Number(1.0))), [math.atan2(1, x) for x in (-2.5, -0.5, 0.5, 2.5)]),
        (Call("SUMSQ", (Symbol("x"), Number(2.0))), [10.25, 4.25, 4.25, 10.25]),
        (Call("MAX", (Symbol("x"), Number(0.0), Number(1.0))), [1.0, 1.0, 1.0, 2.5]),
        (Call("MIN", (Symbol("x"), Number(0.0), Number(1.0))), [-2.5, -0.5, 0.0, 0.0]),
        (Call("SQRT", (Symbol("x"),)), [0.0, 0.0, math.sqrt(0.5), math.sqrt(2.5)]),
    ],
)
def test_functions(node, expected):
    assert np.allclose(value(node, {"x": np.array([-2.5, -0.5, 0.5, 2.5])}, rooted=True), expected, rtol=1e-15)

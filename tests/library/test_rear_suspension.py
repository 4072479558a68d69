"""A rear suspension, written from the manual alone: where its spring is longest, and what its pivot carries."""

from pathlib import Path

import numpy as np
import pytest

import mechsheet

SUSPENSION = Path(__file__).parents[1] / "data" / "rear-suspension.toml"
STIFFNESS, FREE, DAMPING, LOAD = 80.0, 190.0, 1.5, 700.0


def test_the_spring_is_longest_where_the_wheel_is_lowest_and_the_pivot_carries_what_is_left():
    found = mechsheet.load(SUSPENSION).solve()
    shock, height = (np.asarray(found[name]) for name in ("shock", "travel"))
    assert np.argmax(shock) == np.argmin(height)
    e, s = (
        np.column_stack([np.broadcast_to(found[f"{point}.{axis}"], shock.shape) for axis in "xy"]) for point in "ES"
    )
    velocity = np.gradient(shock, np.deg2rad(1.0)) * np.deg2rad(20.0)
    pull = (STIFFNESS * (shock - FREE) + DAMPING * velocity)[:, None] * (s - e) / shock[:, None]
    pivot = np.column_stack([found["F12.x"], found["F12.y"]])  # of the ground on the arm, which has no mass
    rest = pivot + pull + (0.0, LOAD)
    assert np.abs(rest[1:-1]).max() == pytest.approx(0, abs=0.01 * np.abs(pull).max())
